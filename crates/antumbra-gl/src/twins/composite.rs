//! Parts of composite shadows, and their greys.

use super::random::{Random, footprint_texels};
use super::{COVERAGE, assert_equal, in_each_api, on_gpu};
use crate::technique::composite::linear_grey;
use antumbra_math::PlaneFrame;
use antumbra_math::composite::{PartShape, PlacedPart, part_coverage};
use glam::{DVec2, Vec3, Vec4};

const GREY: &str = include_str!("../shaders/composite/grey.glsl");
const PART: &str = include_str!("../shaders/composite/part.glsl");

#[test]
fn linear_grey_is_its_twin() {
    in_each_api(|gl| {
        let greys = (0..=1000).map(|k| f32::from(k as u16) / 1000.0).chain([0.04045, 0.04046]);
        let inputs: Vec<[Vec4; 1]> = greys.map(|k| [Vec4::splat(k)]).collect();
        let gpu = on_gpu(gl, &[GREY], "o_out = vec4(linear_grey(INPUT(0).x));", &inputs);
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        let cpu: Vec<f32> = inputs.iter().map(|[k]| linear_grey(k.x.into()) as f32).collect();
        // A power by way of logarithms in float32.
        assert_equal("linear_grey", &gpu, &cpu, 1e-6, 0.0);
    });
}

/// Parts of composite shadows, at points in them, beside them and near their edges; of the size of a
/// room and a million times as large.
#[test]
fn part_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        while inputs.len() < 20_000 {
            let plane = antumbra_math::Plane::through(random.vector(3.0), random.unit());
            let frame = PlaneFrame::of_plane(&plane).expect("a plane");
            let mut at = |size: f64| DVec2::new(random.within(-size, size), random.within(-size, size));
            let (a, b, c, edge) = (at(3.0), at(3.0), at(3.0), at(2.0));
            let shape = if random.0.bool() {
                PartShape::Triangle { vertices: [a, b, c] }
            } else {
                // Its edge near the middle of things, however large it is.
                let radius = 10f64.powf(random.within(-1.0, 6.0));
                PartShape::Disc { center: edge + a.normalize_or_zero() * radius, radius }
            };
            let Some(part) = PlacedPart::new(&shape, &frame) else { continue };
            let part = part.to_f32();
            let texels = match part {
                PlacedPart::Disc { center, radius, power } => {
                    [center.extend(radius), Vec4::X * power, Vec4::ZERO, Vec4::Y]
                }
                PlacedPart::Triangle { edges: [a, b, c] } => {
                    let plane = |(n, d): (Vec3, f32)| n.extend(d);
                    [plane(a), plane(b), plane(c), Vec4::ZERO]
                }
            };
            for _ in 0..4 {
                let near = DVec2::new(random.within(-0.3, 0.3), random.within(-0.3, 0.3));
                let footprint = random.footprint(frame.point(edge + near));
                let [p, x, y] = footprint_texels(&footprint);
                inputs.push([p, x, y, texels[0], texels[1], texels[2], texels[3]]);
                cpu.push(part_coverage(&part, &footprint));
            }
        }
        let body = "Footprint f = Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz); \
                    o_out = vec4(part_coverage(INPUT(3), INPUT(4), INPUT(5), INPUT(6), f));";
        let gpu = on_gpu(gl, &[COVERAGE, PART], body, &inputs);
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // As for blockers: units in the last place of some metres, against footprints of centimetres.
        assert_equal("part_coverage", &gpu, &cpu, 1e-3, 1e-3);
    });
}
