//! Unions of what several occluders hide.

use super::random::Random;
use super::{AREA, SOFT, in_each_api, on_gpu};
use antumbra_math::soft::{Conic, Interval, Nodes, Patch};
use glam::{DVec3, Vec2, Vec3, Vec4};

const UNION: &str = include_str!("../shaders/analytic/union.glsl");
const BALLS: &str = "#define UNION\n#define LIGHT_TEXELS 1\n#define CORNERS 4\n#define CONE\n";
const FLATS: &str = "#define UNION\n#define LIGHT_TEXELS 4\n#define CORNERS 4\n#define CONE\n";
const SLOTS: usize = 6;

/// Makes the slots hold an interval too. What it touches becomes one with it; where all are taken it becomes one with the
/// nearest, and with the gap between.
fn join(slots: &mut [Interval<f32>; SLOTS], mut interval: Interval<f32>) {
    if interval.is_empty() {
        return;
    }
    for slot in slots.iter_mut() {
        if slot.low <= interval.high && interval.low <= slot.high {
            interval = interval.hull(*slot);
            *slot = Interval::empty();
        }
    }
    let gap = |slot: &Interval<f32>| {
        if slot.is_empty() { -1.0 } else { (slot.low - interval.high).max(interval.low - slot.high) }
    };
    let nearest = (0..SLOTS).reduce(|a, b| if gap(&slots[b]) < gap(&slots[a]) { b } else { a });
    let slot = &mut slots[nearest.expect("there are slots")];
    *slot = slot.hull(interval);
}

/// The same for an interval without what is inside of another.
fn join_but(slots: &mut [Interval<f32>; SLOTS], hidden: Interval<f32>, kept: Interval<f32>) {
    let kept = hidden.and(kept);
    if kept.is_empty() {
        return join(slots, hidden);
    }
    join(slots, Interval { high: kept.low, ..hidden });
    join(slots, Interval { low: kept.high, ..hidden });
}

/// Of the strip at `y`, what is before a plane that cuts a ball of light.
fn flat_kept(normal: Vec3, over: f32, patch: &Patch<Vec3>, y: f32) -> Interval<f32> {
    Conic::of_cut(normal, over, patch).map_or(Interval::empty(), |cut| cut.interval(y))
}

/// How long the union of intervals is: another way than [`join`]'s, by sorting.
fn union_length(intervals: &[Interval<f32>]) -> f32 {
    let mut sorted: Vec<_> = intervals.iter().filter(|i| !i.is_empty()).collect();
    sorted.sort_by(|a, b| a.low.total_cmp(&b.low));
    let (mut sum, mut at) = (0.0, f32::NEG_INFINITY);
    for interval in sorted {
        sum += (interval.high - interval.low.max(at)).max(0.0);
        at = at.max(interval.high);
    }
    sum
}

fn length(slots: &[Interval<f32>]) -> f32 {
    slots.iter().filter(|slot| !slot.is_empty()).map(|slot| slot.high - slot.low).sum()
}

/// Eight intervals of a strip: of every width, touching, nested, apart and empty.
fn intervals(random: &mut Random) -> [Interval<f32>; 8] {
    let widest = [0.1, 0.3, 1.0][random.0.usize(..3)];
    [(); 8].map(|()| {
        let low = random.within(-1.0, 1.0);
        Interval { low: low as f32, high: (low + random.within(-0.1, 1.0) * widest) as f32 }
    })
}

#[test]
fn joined_intervals_are_their_union() {
    let mut random = Random::new();
    let mut overflows = 0;
    for _ in 0..20_000 {
        let all = intervals(&mut random);
        let mut slots = [Interval::empty(); SLOTS];
        for (count, &interval) in all.iter().enumerate() {
            join(&mut slots, interval);
            let (joined, exact) = (length(&slots), union_length(&all[..=count]));
            if count < SLOTS {
                assert!((joined - exact).abs() < 1e-5, "{joined} of {exact}: {all:?}");
            } else if joined > exact + 1e-5 {
                overflows += 1; // a gap was closed
            } else {
                assert!((joined - exact).abs() < 1e-5, "nothing that is hidden is lost: {joined} of {exact}");
            }
            let used: Vec<_> = slots.iter().filter(|slot| !slot.is_empty()).collect();
            let apart = |a: &Interval<f32>, b: &Interval<f32>| a.high < b.low || b.high < a.low;
            let all_apart = (0..used.len()).all(|i| (0..i).all(|j| apart(used[i], used[j])));
            assert!(all_apart, "nothing counts twice: {used:?}");
        }
    }
    assert!(overflows > 20, "more than {SLOTS} are tried: {overflows}");
}

#[test]
fn join_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for _ in 0..20_000 {
            let all = intervals(&mut random);
            let mut slots = [Interval::empty(); SLOTS];
            all.iter().for_each(|&interval| join(&mut slots, interval));
            cpu.push(length(&slots));
            inputs.push(
                [0, 2, 4, 6].map(|i| Vec4::new(all[i].low, all[i].high, all[i + 1].low, all[i + 1].high)),
            );
        }
        let body = "vec2 slots[SLOTS]; for (int k = 0; k < SLOTS; k++) { slots[k] = EMPTY; }
                    for (int k = 0; k < 4; k++) { join(slots, INPUT(k).xy); join(slots, INPUT(k).zw); }
                    float sum = 0.0;
                    for (int k = 0; k < SLOTS; k++) { sum += max(slots[k].y - slots[k].x, 0.0); }
                    o_out = vec4(sum);";
        let gpu = on_gpu(gl, &[BALLS, AREA, SOFT, UNION], body, &inputs);
        let off = gpu.iter().zip(&cpu).filter(|(g, c)| !((g.x - **c).abs() <= 1e-5)).count();
        assert!(cpu.iter().filter(|sum| **sum > 0.2).count() > 15_000, "most hide something");
        assert_eq!(off, 0, "of {} differ", cpu.len());
    });
}

#[test]
fn what_is_kept_is_not_joined() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu, mut cuts) = (Vec::new(), Vec::new(), 0);
        while inputs.len() < 10_000 {
            let (center, radius) = (random.unit() * random.within(1.0, 4.0), random.within(0.05, 0.9));
            let normal: DVec3 = (center.normalize() + random.unit() * 0.9).normalize();
            let over = random.within(-1.2, 1.2) * radius;
            // The plane is before the point.
            if (center - normal * over).dot(normal) < 0.05 {
                continue;
            }
            let (at, up) = (center.as_vec3(), random.unit().as_vec3());
            let Some(patch) = Patch::of_sphere(at, radius as f32, Vec3::ZERO, up) else { continue };
            let y = random.within(-1.0, 1.0) as f32;
            let kept = flat_kept(normal.as_vec3(), over as f32, &patch, y);
            cuts += usize::from(!kept.is_empty());
            let [first, second, ..] = intervals(&mut random);
            let mut slots = [Interval::empty(); SLOTS];
            join(&mut slots, first);
            join_but(&mut slots, second, kept);
            cpu.push(length(&slots));
            inputs.push([
                at.extend(radius as f32),
                up.extend(y),
                normal.as_vec3().extend(over as f32),
                Vec4::new(first.low, first.high, second.low, second.high),
            ]);
        }
        let body =
            "AntumbraPatch p = antumbra_patch_of_sphere(INPUT(0).xyz, INPUT(0).w, vec3(0.0), INPUT(1).xyz);
                    vec2 slots[SLOTS]; for (int k = 0; k < SLOTS; k++) { slots[k] = EMPTY; }
                    join(slots, INPUT(3).xy);
                    join_but(slots, INPUT(3).zw, flat_kept(INPUT(2).xyz, INPUT(2).w, p, INPUT(1).w));
                    float sum = 0.0;
                    for (int k = 0; k < SLOTS; k++) { sum += max(slots[k].y - slots[k].x, 0.0); }
                    o_out = vec4(sum);";
        let gpu = on_gpu(gl, &[BALLS, AREA, SOFT, UNION], body, &inputs);
        let off = gpu.iter().zip(&cpu).filter(|(g, c)| !((g.x - **c).abs() <= 1e-3)).count();
        assert!(cuts > 3000, "{cuts} strips are cut");
        // Where the strip only just touches the circle, roundings decide.
        assert!(off <= 20, "{off} of {} differ", cpu.len());
    });
}

/// Nodes and weights on [-1, 1], from 1 downwards, as the library integrates with them.
fn nodes(count: usize, round: bool) -> Vec<Vec2> {
    let nodes = Nodes::<f32>::new(count);
    let all = Interval { low: -1.0, high: 1.0 };
    let mut at = Vec::new();
    nodes.integrate(round, all, |y| {
        at.push(y);
        0.0
    });
    let weight = |k: usize| nodes.integrate(round, all, |y| if y == at[k] { 1.0 } else { 0.0 });
    (0..count).map(|k| Vec2::new(at[k], weight(k))).collect()
}

/// The nodes of unions.
fn union_node(round: bool, i: usize) -> Vec2 {
    nodes(24, round)[i]
}

#[test]
fn nodes_are_their_twins() {
    in_each_api(|gl| {
        for (define, round) in [(BALLS, true), (FLATS, true), (FLATS, false)] {
            let few = format!("o_out = vec4(antumbra_nodes_of({round}, int(INPUT(0).x)), 0.0, 0.0);");
            let many = format!("o_out = vec4(union_node({round}, int(INPUT(0).x)), 0.0, 0.0);");
            let union_nodes = (0..24).map(|i| union_node(round, i)).collect();
            for (body, expected) in [(few, nodes(8, round)), (many, union_nodes)] {
                let inputs: Vec<[Vec4; 1]> = (0..expected.len()).map(|i| [Vec4::X * i as f32]).collect();
                let gpu = on_gpu(gl, &[define, AREA, SOFT, UNION], &body, &inputs);
                for (i, (gpu, cpu)) in gpu.iter().zip(&expected).enumerate() {
                    let off = (gpu.truncate().truncate() - *cpu).abs().max_element();
                    assert!(off < 2e-6, "{body}, node {i}: {gpu} for {cpu}");
                }
            }
        }
    });
}
