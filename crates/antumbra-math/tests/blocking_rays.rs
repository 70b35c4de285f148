//! The test of one point against rays: more than a million decided cases a shape, most of them next to
//! something degenerate, in float64 and in float32. ANTUMBRA_CASES=20 runs twenty times as many.

mod blocking_support;
mod plane_shadow_support;

use antumbra_math::blocking::Blockers;
use blocking_support::{CONE, DISC, NAMES, Oracle, PLANE, RECTANGLE, SPHERE, TRIANGLE, ask, cases, setting};
use glam::DVec3;
use plane_shadow_support::Random;

const SETTINGS: usize = 100_000;
const POINTS: usize = 16;

/// Cases that a change of the shape by this part of its size decides differently do not count.
const EDGE: f64 = 1e-9;

fn check(kind: u64) {
    let mut random = Random(kind + 1);
    let (mut decided, mut dark, mut wrong) = (0_u64, 0_u64, 0_u64);
    let (mut decided32, mut wrong32) = (0_u64, 0_u64);
    let k: f64 = std::env::var("K").map_or(4.0, |v| v.parse().unwrap());
    let mut edge = EDGE;
    if let Ok(e) = std::env::var("EDGE") {
        edge = e.parse().unwrap();
    }
    for _ in 0..cases(SETTINGS) {
        let setting = setting(&mut random, kind);
        let Some(oracle) = Oracle::new(&setting.shape, &setting.light, edge * setting.size) else { continue };
        let blockers = Blockers::new(&setting.shape, &setting.light);
        let single: Vec<_> = blockers.iter().map(|(b, _)| b.to_f32()).collect();
        let (mut lit_point, mut dark_point) = (None, None);
        for _ in 0..POINTS {
            // Between a lit and a dark point lies an edge: half the points close in on it.
            let point = match (lit_point, dark_point) {
                (Some(a), Some(b)) if random.choice(2) == 0 => close_in(&oracle, a, b, 3 + random.choice(30)),
                _ => ask(&mut random, &setting),
            };
            *(if oracle.blocks(point) { &mut dark_point } else { &mut lit_point }) = Some(point);
            if let Some(truth) = oracle.decide(point) {
                decided += 1;
                dark += u64::from(truth);
                if blockers.block(point) != truth {
                    wrong += 1;
                    if wrong < 6 {
                        println!("{truth} at {point:?} {:?} {:?} {blockers:?}", setting.shape, setting.light);
                    }
                }
            }
            let rounding =
                k * f64::from(f32::EPSILON) / 2.0 * (point.length() + setting.center.length() + setting.size);
            let Some(coarse) = Oracle::new(&setting.shape, &setting.light, rounding) else { continue };
            if coarse.may_hold(point) {
                continue;
            }
            if let Some(truth) = coarse.decide(point) {
                decided32 += 1;
                if single.iter().any(|b| b.blocks(point.as_vec3())) != truth {
                    wrong32 += 1;
                    if wrong32 < 3 {
                        println!(
                            "f32: {truth} at {point:?} {:?} {:?} {blockers:?}",
                            setting.shape, setting.light
                        );
                    }
                }
            }
        }
    }
    println!(
        "{}: decided {decided}, dark {dark}, wrong {wrong}; float32: {decided32}, wrong {wrong32}",
        NAMES[kind as usize]
    );
}

/// Halves the way between a lit and a dark point, keeping the edge between.
fn close_in(oracle: &Oracle, mut lit: DVec3, mut dark: DVec3, steps: u64) -> DVec3 {
    for _ in 0..steps {
        let middle = lit.midpoint(dark);
        *(if oracle.blocks(middle) { &mut dark } else { &mut lit }) = middle;
    }
    if steps % 2 == 0 { lit } else { dark }
}

#[test]
fn spheres() {
    check(SPHERE);
}

#[test]
fn discs() {
    check(DISC);
}

#[test]
fn triangles() {
    check(TRIANGLE);
}

#[test]
fn cones() {
    check(CONE);
}

#[test]
fn rectangles() {
    check(RECTANGLE);
}

#[test]
fn planes() {
    check(PLANE);
}
