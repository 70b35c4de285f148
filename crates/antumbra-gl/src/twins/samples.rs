//! Points of lights.

use super::random::Random;
use super::{in_each_api, on_gpu};
use glam::{Vec3, Vec4};

/// What a point of a light sends to a surface point with unit normal `normal`, in units of what a point at the
/// light's centre sends straight down: cosine at the receiver, cosine at a flat light (`emitter` is the unit normal of
/// the side that shines and 1; w is 0 for a ball, whose points shine to all sides alike) and falloff with the square
/// of the distance. The twin of `sample_weight` in `samples.glsl`.
pub(crate) fn sample_weight(point: Vec3, center: Vec3, emitter: Vec4, position: Vec3, normal: Vec3) -> f32 {
    let to_point = point - position;
    let square = to_point.dot(to_point).max(1e-30);
    let direction = to_point / square.sqrt();
    let received = normal.dot(direction).max(0.0);
    let sent = if emitter.w > 0.5 { (-direction).dot(emitter.truncate()).max(0.0) } else { 1.0 };
    let to_center = center - position;
    received * sent * (to_center.dot(to_center) / square)
}

/// Near and far points, of either kind of light, above and below horizons.
#[test]
fn sample_weight_is_its_twin() {
    const SAMPLES: &str = include_str!("../shaders/samples.glsl");
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for i in 0..10_000 {
            let [point, center, position] = [0; 3].map(|_| random.vector(8.0).as_vec3());
            let emitter = random.unit().as_vec3().extend((i % 2) as f32);
            let normal = random.unit().as_vec3();
            cpu.push(sample_weight(point, center, emitter, position, normal));
            let [a, b, c, d] = [point, center, position, normal].map(|v| v.extend(0.0));
            inputs.push([a, b, emitter, c, d]);
        }
        let body =
            "o_out = vec4(sample_weight(INPUT(0).xyz, INPUT(1).xyz, INPUT(2), INPUT(3).xyz, INPUT(4).xyz));";
        let gpu = on_gpu(gl, &[SAMPLES], body, &inputs);
        for ((gpu, cpu), input) in gpu.iter().zip(&cpu).zip(&inputs) {
            // A dozen roundings, and dot products whose terms cancel.
            assert!((gpu.x - cpu).abs() <= 4e-6 * (1.0 + cpu), "{} for {cpu}: {input:?}", gpu.x);
        }
        let lit = cpu.iter().filter(|weight| **weight > 0.0).count();
        assert!(lit > 2000 && lit < 8000, "some are lit: {lit}");
    });
}
