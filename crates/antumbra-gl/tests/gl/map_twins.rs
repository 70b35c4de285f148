//! The functions of shadow maps in the shaders are their Rust twins, in float32.

use crate::context::in_each_api;
use crate::twins::{Random, assert_equal, on_gpu};
use antumbra_gl::technique::map::receiver::{box_weight, compared_normal, map_face, map_point, offset_point};
use antumbra_gl::technique::map::soft::{blocker_weight, light_point, light_reach, penumbra_scale};
use glam::{DMat4, Mat4, Vec3, Vec4};

const RECEIVER: &str = include_str!("../../src/shaders/map/receiver.glsl");
const SOFT: &str = include_str!("../../src/shaders/map/soft.glsl");

/// Asserts that vectors agree to `close` of their length or of `unit`, all of them.
fn assert_vectors(what: &str, gpu: &[Vec4], cpu: &[Vec4], close: f32, unit: f32) {
    assert_eq!(gpu.len(), cpu.len(), "{what}: a result a call");
    let off = |g: &Vec4, c: &Vec4| !((*g - *c).length() <= close * c.length().max(unit));
    let wrong: Vec<_> = gpu.iter().zip(cpu).enumerate().filter(|(_, (g, c))| off(g, c)).collect();
    eprintln!("{what}: {} of {} off", wrong.len(), cpu.len());
    assert!(wrong.is_empty(), "{what}: {} differ: {:?}", wrong.len(), &wrong[..wrong.len().min(5)]);
}

#[test]
fn faces_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs: Vec<[Vec4; 1]> =
            (0..10_000).map(|_| [random.vector(3.0).as_vec3().extend(0.0)]).collect();
        // Edges, corners, axes and the middle of the cube.
        let few = [-1.0f32, -0.0, 0.0, 1.0];
        inputs.extend(
            few.iter().flat_map(|&x| few.iter().flat_map(move |&y| few.map(|z| [Vec4::new(x, y, z, 0.0)]))),
        );
        let Some(gpu) = on_gpu(gl, &[RECEIVER], "o_out = vec4(float(map_face(INPUT(0).xyz)));", &inputs)
        else {
            return;
        };
        for ([p], gpu) in inputs.iter().zip(&gpu) {
            assert_eq!(gpu.x as usize, map_face(p.truncate()), "the face of {p}");
        }
        let seen: std::collections::BTreeSet<usize> = gpu.iter().map(|f| f.x as usize).collect();
        assert_eq!(seen.len(), 6, "every face turns up");
    });
}

/// Normals and lights at all angles, those near a right angle among them.
fn slants(random: &mut Random, count: usize) -> Vec<[Vec4; 3]> {
    (0..count)
        .map(|i| {
            let to_light = random.unit();
            let across = to_light.any_orthonormal_vector();
            let tilt = if i % 3 == 0 { random.within(1e-4, 0.1) } else { random.within(0.0, 20.0) };
            let normal = (to_light * tilt + across).normalize();
            let share = [0.0, 0.5, 1.0, random.within(0.0, 1.0)][i % 4] as f32;
            let position = random.vector(8.0).as_vec3();
            [
                normal.as_vec3().extend(share),
                to_light.as_vec3().extend(random.within(0.0, 0.1) as f32),
                position.extend(0.0),
            ]
        })
        .collect()
}

#[test]
fn biases_are_their_twins() {
    in_each_api(|gl| {
        let inputs = slants(&mut Random::new(), 20_000);
        let body = "o_out = vec4(compared_normal(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w), 0.0);";
        let Some(gpu) = on_gpu(gl, &[RECEIVER], body, &inputs) else { return };
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[n, l, _]| compared_normal(n.truncate(), l.truncate(), n.w).extend(0.0))
            .collect();
        // The scalar product of unit vectors near a right angle has an absolute error of 1e-7.
        assert_vectors("compared_normal", &gpu, &cpu, 1e-5, 0.1);
        let body = "o_out = vec4(offset_point(INPUT(2).xyz, INPUT(0).xyz, INPUT(1).xyz, INPUT(1).w), 0.0);";
        let Some(gpu) = on_gpu(gl, &[RECEIVER], body, &inputs) else { return };
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[n, l, p]| offset_point(p.truncate(), n.truncate(), l.truncate(), l.w).extend(0.0))
            .collect();
        assert_vectors("offset_point", &gpu, &cpu, 1e-5, 0.1);
    });
}

/// Points and planes in faces of random lights, perspective and parallel.
#[test]
fn points_in_the_map_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut points, mut slopes) = (Vec::new(), Vec::new(), Vec::new());
        while inputs.len() < 10_000 {
            let turn = DMat4::from_quat(glam::DQuat::from_rotation_arc(random.unit(), random.unit()));
            let size = random.within(0.3, 3.0);
            let near = 1e-3;
            // Rows: right, up, depth times w, w.
            let face = if inputs.len() % 2 == 0 {
                DMat4::from_cols_array_2d(&[
                    [1.0 / size, 0.0, 0.0, 0.0],
                    [0.0, 1.0 / size, 0.0, 0.0],
                    [0.0, 0.0, 0.0, -1.0],
                    [0.0, 0.0, near, 0.0],
                ])
            } else {
                DMat4::from_cols_array_2d(&[
                    [0.1 / size, 0.0, 0.0, 0.0],
                    [0.0, 0.1 / size, 0.0, 0.0],
                    [0.0, 0.0, 0.05, 0.0],
                    [0.0, 0.0, 0.5, 1.0],
                ])
            };
            let texels = DMat4::from_translation(glam::DVec3::new(1536.0, 512.0, 0.0))
                * DMat4::from_scale(glam::DVec3::new(512.0, 512.0, 1.0));
            let face = texels * face * turn;
            let planes = face.inverse().transpose().as_mat4();
            let face = face.as_mat4();
            let position = random.vector(6.0).as_vec3();
            // Not at right angles to the way to the light.
            let to_light =
                if inputs.len() % 2 == 0 { -position.normalize() } else { turn.row(2).truncate().as_vec3() };
            let normal = compared_normal(random.unit().as_vec3(), to_light, 1.0);
            let p = map_point(&face, &planes, position, normal);
            if p.w < 0.05 || p.texel.abs().max_element() > 1e4 {
                continue;
            }
            points.push(Vec4::new(p.texel.x, p.texel.y, p.depth * 1e3, p.w));
            slopes.push(Vec4::new(p.slope.x, p.slope.y, 0.0, 0.0) * 1e3);
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| face.col(i));
            let [e, f, g, h] = [0, 1, 2, 3].map(|i| planes.col(i));
            inputs.push([a, b, c, d, e, f, g, h, position.extend(0.0), normal.extend(0.0)]);
        }
        let call = "MapPoint m = map_point(mat4(INPUT(0), INPUT(1), INPUT(2), INPUT(3)), \
                    mat4(INPUT(4), INPUT(5), INPUT(6), INPUT(7)), INPUT(8).xyz, INPUT(9).xyz);";
        let body = format!("{call} o_out = vec4(m.texel, m.depth * 1e3, m.w);");
        let Some(gpu) = on_gpu(gl, &[RECEIVER], &body, &inputs) else { return };
        // A hundredth of a texel among thousands.
        assert_vectors("map_point", &gpu, &points, 1e-5, 1e3);
        let body = format!("{call} o_out = vec4(m.slope * 1e3, 0.0, 0.0);");
        let Some(gpu) = on_gpu(gl, &[RECEIVER], &body, &inputs) else { return };
        // Steep planes lose the digits that their steepness takes.
        assert_vectors("the slope of map_point", &gpu, &slopes, 2e-3, 1e-3);
        let behind = map_point(&Mat4::ZERO, &Mat4::IDENTITY, Vec3::ZERO, Vec3::Z);
        assert!(behind.w == 0.0 && behind.texel.is_finite(), "behind the light: {behind:?}");
    });
}

#[test]
fn box_weights_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let inputs: Vec<[Vec4; 1]> = (0..20_000)
            .map(|i| {
                let middle = random.within(0.0, 4000.0) as f32;
                let radius = [0.5, 1.0, 1.5, random.within(0.5, 8.0) as f32][i % 4];
                let texel = (middle + random.within(-9.0, 9.0) as f32 * radius * 0.2).floor();
                [Vec4::new(middle, radius, texel, 0.0)]
            })
            .collect();
        let body = "o_out = vec4(box_weight(INPUT(0).x, INPUT(0).y, INPUT(0).z));";
        let Some(gpu) = on_gpu(gl, &[RECEIVER], body, &inputs) else { return };
        let cpu: Vec<f32> = inputs.iter().map(|[i]| box_weight(i.x, i.y, i.z)).collect();
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        assert_equal("box_weight", &gpu, &cpu, 1e-6, 0.0);
    });
}

#[test]
fn soft_shadows_are_their_twins() {
    in_each_api(|gl| {
        let inputs: Vec<[Vec4; 1]> = (0..64u32)
            .flat_map(|i| [32u32, 64].map(|count| (i % count, count)))
            .flat_map(|(i, count)| [0.0, 1.0].map(|square| [Vec4::new(i as f32, count as f32, square, 0.0)]))
            .collect();
        let body = "vec2 p = light_point(int(INPUT(0).x), int(INPUT(0).y), INPUT(0).z > 0.5); \
                    o_out = vec4(p, light_reach(p, INPUT(0).z > 0.5), 0.0);";
        let Some(gpu) = on_gpu(gl, &[SOFT], body, &inputs) else { return };
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[i]| {
                let square = i.z > 0.5;
                let p = light_point(i.x as u32, i.y as u32, square);
                Vec4::new(p.x, p.y, light_reach(p, square), 0.0)
            })
            .collect();
        // The sine of an angle of 150 radians, and the fraction of a number of 50.
        assert_vectors("light_point", &gpu, &cpu, 1e-4, 1.0);
        let mut random = Random::new();
        let mut inputs: Vec<[Vec4; 1]> = (0..10_000)
            .map(|_| {
                let [share, beside] = [random.within(-0.1, 1.3), random.within(0.0, 3.0)].map(|x| x as f32);
                [Vec4::new(share, beside, random.within(1.1, 3.0) as f32, 0.0)]
            })
            .collect();
        inputs.push([Vec4::new(0.0, 0.0, 2.0, 0.0)]);
        let body =
            "vec4 i = INPUT(0); o_out = vec4(penumbra_scale(i.x), blocker_weight(i.y, i.z), 0.0, 0.0);";
        let Some(gpu) = on_gpu(gl, &[SOFT], body, &inputs) else { return };
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[i]| Vec4::new(penumbra_scale(i.x), blocker_weight(i.y, i.z), 0.0, 0.0))
            .collect();
        assert_vectors("penumbra_scale and blocker_weight", &gpu, &cpu, 1e-6, 1.0);
    });
}
