//! Edges across pixels, and hard blockers.

use super::random::{Random, footprint_texels};
use super::{COVERAGE, SURFACE, assert_equal, in_each_api, on_gpu};
use antumbra_math::blocking::{
    Blocker, Blockers, Footprint, PolygonBlocker, half_plane_coverage, polygon_coverage, screen_footprint,
};
use glam::{DVec3, Vec3, Vec4};

const SPHERE: &str = include_str!("../shaders/analytic/sphere.glsl");
const DISC: &str = include_str!("../shaders/analytic/disc.glsl");
const POLYGON: &str = include_str!("../shaders/analytic/polygon.glsl");

#[test]
fn half_plane_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs: Vec<[Vec4; 1]> = (0..20_000)
            .map(|_| [Vec3::from_array([(); 3].map(|()| random.small() as f32)).extend(0.0)])
            .collect();
        // Edges and corners of the cases.
        let few = [0.0, -0.0, 0.25, 0.5, -0.5, 1.0, 1e-20, 1e20];
        inputs.extend(
            few.iter().flat_map(|&v| few.iter().flat_map(move |&x| few.map(|y| [Vec4::new(v, x, y, 0.0)]))),
        );
        let body = "vec4 i = INPUT(0); o_out = vec4(half_plane_coverage(i.x, i.y, i.z));";
        let gpu = on_gpu(gl, &[COVERAGE], body, &inputs);
        let cpu: Vec<f32> = inputs.iter().map(|[i]| half_plane_coverage(i.x, i.y, i.z)).collect();
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // A division and a product or two: some units in the last place; where slopes or their
        // squares leave float32's range, some drivers flush to zero.
        assert_equal("half_plane_coverage", &gpu, &cpu, 2e-6, 1e-3);
    });
}

#[test]
fn screen_footprint_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs = Vec::new();
        for i in 0..10_000u32 {
            let point = random.vector(3.0) - DVec3::Z * random.within(3.0, 40.0);
            let mut normal = random.unit();
            if i % 8 == 0 {
                normal = normal.cross(point).normalize(); // edge-on
            }
            let perspective = (i % 2) as f32;
            inputs.push([
                point.as_vec3().extend(perspective),
                normal.as_vec3().extend(0.0),
                Vec4::new(0.01, 0.02, 0.0, 0.0),
            ]);
        }
        let part = |axis: &str| {
            format!(
                "vec4 p = INPUT(0); Footprint f = screen_footprint(p.xyz, INPUT(1).xyz, vec3(INPUT(2).xy, p.w)); o_out = vec4(f.{axis}, 0.0);"
            )
        };
        for axis in ["dx", "dy"] {
            let gpu = on_gpu(gl, &[COVERAGE], &part(axis), &inputs);
            let mut off = 0;
            for ([p, n, s], gpu) in inputs.iter().zip(&gpu) {
                let f = screen_footprint(p.truncate(), n.truncate(), (s.x, s.y), p.w > 0.5);
                let cpu = if axis == "dx" { f.dx } else { f.dy };
                // Relative to the stretched footprint: edge-on the cosine is rounding error.
                off += usize::from(!((gpu.truncate() - cpu).length() <= 1e-3 * cpu.length()));
            }
            eprintln!("screen_footprint {axis}: {off} off");
            assert!(off <= inputs.len() / 1000, "{axis}: {off} of {} differ", inputs.len());
        }
    });
}

/// Corners by way of a polygon of two edges: the twin is private to its crate.
#[test]
fn corner_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let anywhere = (Vec3::ZERO, 1.0);
        let mut inputs = Vec::new();
        let mut cpu = Vec::new();
        for i in 0..20_000 {
            let mut edge =
                || Vec4::new(random.small() as f32, random.small() as f32, 0.0, random.small() as f32);
            let (a, mut b) = (edge(), edge());
            match i % 16 {
                0 => b = Vec4::new(a.x, a.y, 0.0, b.w),   // the same way
                1 => b = Vec4::new(-a.x, -a.y, 0.0, b.w), // facing each other
                2 => b = Vec4::new(-a.y, a.x, 0.0, b.w),  // at right angles
                _ => {}
            }
            inputs.push([a, b]);
            let plane = |e: Vec4| (e.truncate(), e.w);
            let polygon = PolygonBlocker { base: anywhere, edges: [plane(a), plane(b), anywhere, anywhere] };
            cpu.push(polygon_coverage(&polygon, &Footprint { point: Vec3::ZERO, dx: Vec3::X, dy: Vec3::Y }));
        }
        let body = "Footprint f = Footprint(vec3(0.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)); \
                    vec4 a = INPUT(0); vec4 b = INPUT(1); \
                    o_out = vec4(corner_coverage(edge_of(a.w, a.xyz, f), edge_of(b.w, b.xyz, f)));";
        let gpu = on_gpu(gl, &[COVERAGE], body, &inputs);
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // As for one edge, and a square root. Edges of one coverage, which is the nearer, may swap.
        assert_equal("corner_coverage", &gpu, &cpu, 1e-5, 1e-3);
    });
}

/// An edge that another polygon continues.
fn seam_edge(edge: Vec3, far: Vec3, behind: f32) -> Vec3 {
    if behind > 0.0 && edge.x > 0.0 { far } else { edge }
}

/// The part of a footprint that does not cross a plane.
fn contact_footprint(footprint: &Footprint<Vec3>, normal: Vec3, behind: f32) -> Footprint<Vec3> {
    let across = normal.dot(footprint.dx).abs() + normal.dot(footprint.dy).abs();
    let share = (behind / across.max(1e-30)).clamp(0.0, 1.0);
    Footprint { point: footprint.point, dx: footprint.dx * share, dy: footprint.dy * share }
}

#[test]
fn contact_footprint_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu, mut less) = (Vec::new(), Vec::new(), 0);
        for _ in 0..4000 {
            let footprint = random.footprint(DVec3::Z);
            let plane = random.unit().as_vec3().extend((random.within(-0.5, 2.0) * 0.05) as f32);
            let contact = contact_footprint(&footprint, plane.truncate(), plane.w);
            less += usize::from(contact.dx.length() < footprint.dx.length());
            cpu.push(contact);
            let [a, b, c] = footprint_texels(&footprint);
            inputs.push([a, b, c, plane]);
        }
        for (axis, pick) in [("dx", 0), ("dy", 1)] {
            let body = format!(
                "Footprint f = Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz);
                 o_out = vec4(contact_footprint(f, INPUT(3).xyz, INPUT(3).w).{axis}, 0.0);"
            );
            let gpu = on_gpu(gl, &[COVERAGE, SURFACE, POLYGON], &body, &inputs);
            let cpu = cpu.iter().map(|f| if pick == 0 { f.dx } else { f.dy });
            let off = gpu
                .iter()
                .zip(cpu)
                .filter(|(g, c)| !((g.truncate() - *c).length() <= 1e-5 * (1.0 + c.length())));
            let off = off.count();
            assert!(off <= 4, "{axis}: {off} of {} differ", inputs.len());
        }
        assert!((200..4000).contains(&less), "{less} are cut");
    });
}

/// How far behind a plane a point has to lie to be behind it.
fn contact_tolerance(base: Vec4, footprint: &Footprint<Vec3>, tolerance: f32, perspective: bool) -> f32 {
    let eye = if perspective { base.w } else { base.z };
    let normal = base.truncate();
    let across = normal.dot(footprint.dx).abs().max(normal.dot(footprint.dy).abs());
    let size = footprint.dx.length().max(footprint.dy.length());
    if eye > 0.0 && across > 0.05 * size { -tolerance } else { tolerance }
}

#[test]
fn contact_tolerance_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for i in 0..4000 {
            let footprint = random.footprint(DVec3::Z);
            let across = random.unit();
            // Every other plane is nearly the receiver's own.
            let own = footprint.dx.cross(footprint.dy).normalize_or(Vec3::Y);
            let normal =
                if i % 2 == 0 { across.as_vec3() } else { (own + across.as_vec3() * 0.06).normalize() };
            let base = normal.extend(random.small() as f32);
            let perspective = i % 3 == 0;
            cpu.push(contact_tolerance(base, &footprint, 0.01, perspective));
            let [a, b, c] = footprint_texels(&footprint);
            inputs.push([a, b, c, base, Vec4::X * f32::from(u8::from(perspective))]);
        }
        let body = "Footprint f = Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz);
                    o_out = vec4(contact_tolerance(INPUT(3), f, 0.01, INPUT(4).x > 0.5));";
        let gpu = on_gpu(gl, &[COVERAGE, SURFACE, POLYGON], body, &inputs);
        let off = gpu.iter().zip(&cpu).filter(|(g, c)| g.x != **c).count();
        let behind = cpu.iter().filter(|tolerance| **tolerance < 0.0).count();
        assert!((400..3600).contains(&behind), "{behind} are on the eye's side");
        assert!(off <= 8, "{off} of {} differ", cpu.len());
    });
}

#[test]
fn seam_edge_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs = Vec::new();
        for _ in 0..2000 {
            let mut number = || random.small().clamp(-1.0, 1.0) as f32;
            let edge = Vec4::new(number().max(0.0), number(), number(), number());
            inputs.push([edge, Vec4::new(number(), number(), number(), 0.0)]);
        }
        let body = "o_out = vec4(seam_edge(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w), 0.0);";
        let gpu = on_gpu(gl, &[COVERAGE, SURFACE, POLYGON], body, &inputs);
        let cpu = inputs.iter().map(|[a, b]| seam_edge(a.truncate(), b.truncate(), a.w));
        let (mut pushed, mut off) = (0, 0);
        for ((cpu, gpu), [edge, _]) in cpu.zip(&gpu).zip(&inputs) {
            off += usize::from(cpu != gpu.truncate());
            pushed += usize::from(cpu != edge.truncate());
        }
        assert!(pushed > 200, "{pushed} are pushed");
        assert_eq!(off, 0, "of {} differ", inputs.len());
    });
}

/// Every blocker, of random shapes and lights, at points in and near its shadow.
#[test]
fn blockers_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = ([const { Vec::new() }; 3], [const { Vec::new() }; 3]);
        while inputs.iter().any(|list| list.len() < 20_000) {
            let (shape, light) = (random.shape(), random.light());
            for (blocker, _) in Blockers::new(&shape, &light).iter() {
                let exact = blocker;
                let blocker = blocker.to_f32();
                let (kind, mut texels) = match blocker {
                    Blocker::Sphere(b) => (0, vec![b.center.extend(b.radius), b.light.extend(b.light_w)]),
                    Blocker::Disc(b) => (
                        1,
                        vec![b.center.extend(b.radius), b.normal.extend(b.nearness), b.toward.extend(0.0)],
                    ),
                    Blocker::Polygon(b) => (2, b.planes().map(|(n, d)| n.extend(d)).to_vec()),
                };
                texels.resize(5, Vec4::ZERO);
                if inputs[kind].len() >= 20_000 {
                    continue;
                }
                for _ in 0..8 {
                    // Half way between a lit point and one behind the shape, again and again: near an edge.
                    let center = shape.bounding_sphere().0;
                    let away = light.vector_from(center).normalize_or_zero() * -random.within(0.1, 4.0);
                    let mut dark = center + away;
                    let mut lit = dark + random.vector(4.0);
                    if exact.blocks(lit) != exact.blocks(dark) {
                        for _ in 0..random.0.u32(3..9) {
                            let middle = (lit + dark) * 0.5;
                            let half =
                                if exact.blocks(middle) == exact.blocks(lit) { &mut lit } else { &mut dark };
                            *half = middle;
                        }
                    }
                    let footprint = random.footprint(lit);
                    let [a, b, c] = footprint_texels(&footprint);
                    inputs[kind].push([a, b, c, texels[0], texels[1], texels[2], texels[3], texels[4]]);
                    cpu[kind].push(blocker.coverage(&footprint));
                }
            }
        }
        let body = "for (int i = 0; i < 5; i++) { blocker[i] = INPUT(3 + i); } \
                    SurfacePoint s; s.has_id = true; s.tolerance = 0.0; \
                    o_out = vec4(blocker_coverage(Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz), s));";
        // Units in the last place of coordinates of ten metres are some micrometres, a thousandth of
        // the smaller footprints; for points without extent they decide between 0 and 1, and in a
        // grazing shadow they are stretched.
        for (kind, (name, source)) in
            [("sphere", SPHERE), ("disc", DISC), ("polygon", POLYGON)].iter().enumerate()
        {
            let gpu = on_gpu(gl, &[COVERAGE, SURFACE, source], body, &inputs[kind]);
            let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
            assert_equal(name, &gpu, &cpu[kind], 1e-3, 1e-3);
        }
    });
}
