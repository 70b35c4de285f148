//! The host's surface and its pixels.

use super::random::Random;
use super::{COVERAGE, SURFACE, assert_vectors, in_each_api, on_gpu};
use glam::{Vec3, Vec4};

/// Whether a surface of the id `own`, if it has any, is the occluder `id`.
fn is_own(has_id: bool, own: u32, id: u32) -> bool {
    has_id && id != 0 && own == id
}

/// The factor on pixels that are radiance^(1/gamma).
fn host_factor(ratio: Vec3, gamma: f32) -> Vec3 {
    let ratio = ratio.clamp(Vec3::ZERO, Vec3::ONE);
    if gamma == 1.0 { ratio } else { ratio.powf(1.0 / gamma) }
}

#[test]
fn own_surfaces_are_their_twins() {
    in_each_api(|gl| {
        let ids = [0, 1, 2, 0x7fff_ffff];
        let calls: Vec<(bool, u32, u32)> = [false, true]
            .into_iter()
            .flat_map(|has| ids.into_iter().flat_map(move |own| ids.map(|id| (has, own, id))))
            .collect();
        let inputs: Vec<[Vec4; 1]> = calls
            .iter()
            .map(|&(has, own, id)| {
                [Vec4::new(f32::from(u8::from(has)), f32::from_bits(own), f32::from_bits(id), 0.0)]
            })
            .collect();
        let body = "SurfacePoint s; s.has_id = INPUT(0).x > 0.5; s.id = floatBitsToUint(INPUT(0).y); \
                    o_out = vec4(is_own(s, floatBitsToUint(INPUT(0).z)) ? 1.0 : 0.0);";
        let gpu = on_gpu(gl, &[COVERAGE, SURFACE], body, &inputs);
        for (&(has, own, id), gpu) in calls.iter().zip(&gpu) {
            assert_eq!(gpu.x > 0.5, is_own(has, own, id), "{has}, {own}, {id}");
        }
    });
}

#[test]
fn host_factor_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs: Vec<[Vec4; 1]> = (0..5000)
            .map(|i| {
                let gamma = [1.0, 2.2, random.within(0.5, 4.0) as f32][i % 3];
                [(random.vector(0.8) + 0.5).as_vec3().extend(gamma)]
            })
            .collect();
        inputs.push([Vec4::new(0.0, 1.0, 2.0, 2.2)]);
        let gpu = on_gpu(
            gl,
            &[COVERAGE, SURFACE],
            "o_out = vec4(host_factor(INPUT(0).xyz, INPUT(0).w), 0.0);",
            &inputs,
        );
        let cpu: Vec<Vec4> = inputs.iter().map(|[i]| host_factor(i.truncate(), i.w).extend(0.0)).collect();
        // A power by way of logarithms in float32.
        assert_vectors("host_factor", &gpu, &cpu, 1e-5, 1.0);
    });
}
