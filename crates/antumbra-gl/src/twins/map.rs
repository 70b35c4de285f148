//! Receivers of shadow maps, and percentage-closer soft shadows after Randima Fernando, "Percentage-Closer Soft Shadows",
//! 2005.

use super::random::Random;
use super::{assert_equal, assert_vectors, in_each_api, on_gpu};
use glam::{DMat4, Mat4, Vec2, Vec3, Vec4, Vec4Swizzles, vec2};

const RECEIVER: &str = include_str!("../shaders/map/receiver.glsl");
const SOFT: &str = include_str!("../shaders/map/soft.glsl");

/// The face of a cube that a direction leaves through: 0 to 5 for +X, -X, +Y, -Y, +Z, -Z. On an edge the earlier axis;
/// zero and NaN count as -Z.
pub(crate) fn map_face(p: Vec3) -> usize {
    let a = p.abs();
    if a.x >= a.y && a.x >= a.z {
        return if p.x > 0.0 { 0 } else { 1 };
    }
    if a.y >= a.z {
        return if p.y > 0.0 { 2 } else { 3 };
    }
    if p.z > 0.0 { 4 } else { 5 }
}

/// Tangent of the steepest receiver that is followed: 88.2 degrees. Beyond, light only grazes, and acne stays; to follow
/// it there too (256) lets light through where receivers meet.
const STEEPEST: f32 = 32.0;

/// The normal of the plane that texels are compared with: turned from the light's direction (`share` 0) to the
/// receiver's (`share` 1), and no steeper than a tangent of 32. Unit vectors in, any length out.
fn compared_normal(normal: Vec3, to_light: Vec3, share: f32) -> Vec3 {
    let cosine = normal.dot(to_light);
    let across = (normal - to_light * cosine) * share;
    across + to_light * cosine.max(across.length() / STEEPEST)
}

/// Moves a point off its surface: by `offset` metres where the light grazes, less the more it is faced.
fn offset_point(position: Vec3, normal: Vec3, to_light: Vec3, offset: f32) -> Vec3 {
    let cosine = normal.dot(to_light);
    position + normal * (offset * (1.0 - cosine * cosine).max(0.0).sqrt())
}

/// A point on a plane, as a face of the map sees the two.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MapPoint {
    /// In texels of the map.
    texel: Vec2,
    /// Larger is nearer to the light.
    depth: f32,
    /// How depth changes on the plane from texel to texel.
    slope: Vec2,
    /// Metres along the face's axis, or 1 in a parallel face; not above 0 behind the light, where the rest means
    /// nothing.
    w: f32,
}

/// Where a face sees a point and a plane through it. `face` takes light space to the texel and the depth, times w;
/// `planes`, its inverse transposed, takes planes. `normal` is a normal of the plane, of any length, not at right
/// angles to the way to the light (the slope is then not finite).
fn map_point(face: &Mat4, planes: &Mat4, position: Vec3, normal: Vec3) -> MapPoint {
    let p = *face * position.extend(1.0);
    let plane = *planes * normal.extend(-normal.dot(position));
    let w = if p.w > 0.0 { p.w } else { 1.0 };
    MapPoint { texel: p.xy() / w, depth: p.z / w, slope: plane.xy() / -plane.z, w: p.w }
}

/// How much of a texel, from its index to the next, is within `radius` of `middle`: 0 to 1.
fn box_weight(middle: f32, radius: f32, texel: f32) -> f32 {
    ((middle + radius).min(texel + 1.0) - (middle - radius).max(texel)).clamp(0.0, 1.0)
}

const GOLDEN_ANGLE: f32 = 2.399_963_3;

/// The points of a light of size one, `index` below `count`: a disc filled by Vogel's spiral ("A better way to
/// construct the sunflower head", 1979), or a square by the R2 sequence (Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018). The same for every pixel and frame.
fn light_point(index: u32, count: u32, square: bool) -> Vec2 {
    let i = index as f32 + 0.5;
    if square {
        let at = vec2(0.754_877_7, 0.569_840_3) * i;
        return (at - at.floor()) * 2.0 - 1.0;
    }
    let angle = i * GOLDEN_ANGLE;
    vec2(angle.cos(), angle.sin()) * (i / count as f32).sqrt()
}

/// How far from the middle such a point is, in sizes of the light: 0 to 1.
fn light_reach(point: Vec2, square: bool) -> f32 {
    if square { point.abs().max_element() } else { point.length() }
}

/// How much of the light's size the way to a blocker spreads to, seen from the light: the blocker is at `share` of
/// the way from the light to the receiver. It is (d_receiver - d_blocker) / d_blocker of Fernando's estimate: 0 for a
/// blocker at the receiver, a million for one at the light or behind it.
fn penumbra_scale(share: f32) -> f32 {
    1.0 / share.max(1e-6) - 1.0
}

/// How much a blocker counts, seen at so many radii of the cone from the receiver to the light from its middle: 1
/// inside, 0 from `slack`, more than 1, on.
fn blocker_weight(beside: f32, slack: f32) -> f32 {
    ((slack - beside) / (slack - 1.0)).clamp(0.0, 1.0)
}

/// The weights of all texels add up to the box, wherever it is.
#[test]
fn boxes_are_divided_among_texels() {
    for radius in [0.5, 1.0, 1.5, 2.25] {
        for step in 0..40 {
            let middle = 10.0 + 0.07 * step as f32;
            let first = (middle - radius).floor();
            let count = (2.0 * radius).ceil() as i32 + 1;
            let sum: f32 = (0..count).map(|i| box_weight(middle, radius, first + i as f32)).sum();
            assert!((sum - 2.0 * radius).abs() < 1e-5, "radius {radius} at {middle}: {sum}");
        }
    }
}

/// Share 0 faces the light, share 1 is the receiver, and no plane contains the way to the light.
#[test]
fn the_compared_plane_turns_with_its_share() {
    let light = Vec3::Y;
    for degrees in [0.0f32, 10.0, 60.0, 85.0, 89.9] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let normal = Vec3::new(sin, cos, 0.0);
        let tangent = |share| {
            let n = compared_normal(normal, light, share);
            n.x / n.y
        };
        assert!(tangent(0.0).abs() < 1e-6, "{degrees} degrees: share 0 faces the light");
        let whole = (sin / cos).min(STEEPEST);
        assert!((tangent(1.0) - whole).abs() <= 1e-4 * whole.max(1.0), "{degrees} degrees: the receiver");
    }
}

/// Each tenth of the light gets its share of the points, to within the few that a count of 48 leaves open.
#[test]
fn points_fill_the_light_evenly() {
    const COUNT: u32 = 48;
    for square in [false, true] {
        let points: Vec<Vec2> = (0..COUNT).map(|i| light_point(i, COUNT, square)).collect();
        assert!(points.iter().all(|&p| light_reach(p, square) <= 1.0), "inside the light");
        let mean = points.iter().sum::<Vec2>() / COUNT as f32;
        // Random points would be 0.1 off, in the mean.
        assert!(mean.length() < 0.07, "{mean} is the middle");
        for part in 1..10 {
            let reach = part as f32 * 0.1;
            let inside = points.iter().filter(|&&p| light_reach(p, square) < reach).count() as f32;
            let expected = COUNT as f32 * reach * reach;
            assert!((inside - expected).abs() <= 4.0, "{inside} of {expected} within {reach}");
        }
    }
}

#[test]
fn penumbras_grow_from_the_blocker() {
    assert_eq!(penumbra_scale(1.0), 0.0, "at the receiver");
    assert_eq!(penumbra_scale(0.5), 1.0, "half way: as wide as the light");
    assert!(penumbra_scale(0.0).is_finite() && penumbra_scale(-1.0).is_finite(), "at the light and behind");
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
        let gpu = on_gpu(gl, &[RECEIVER], "o_out = vec4(float(map_face(INPUT(0).xyz)));", &inputs);
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
        let gpu = on_gpu(gl, &[RECEIVER], body, &inputs);
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[n, l, _]| compared_normal(n.truncate(), l.truncate(), n.w).extend(0.0))
            .collect();
        // The scalar product of unit vectors near a right angle has an absolute error of 1e-7.
        assert_vectors("compared_normal", &gpu, &cpu, 1e-5, 0.1);
        let body = "o_out = vec4(offset_point(INPUT(2).xyz, INPUT(0).xyz, INPUT(1).xyz, INPUT(1).w), 0.0);";
        let gpu = on_gpu(gl, &[RECEIVER], body, &inputs);
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
        let gpu = on_gpu(gl, &[RECEIVER], &body, &inputs);
        // A hundredth of a texel among thousands.
        assert_vectors("map_point", &gpu, &points, 1e-5, 1e3);
        let body = format!("{call} o_out = vec4(m.slope * 1e3, 0.0, 0.0);");
        let gpu = on_gpu(gl, &[RECEIVER], &body, &inputs);
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
        let gpu = on_gpu(gl, &[RECEIVER], body, &inputs);
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
        let gpu = on_gpu(gl, &[SOFT], body, &inputs);
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
        let gpu = on_gpu(gl, &[SOFT], body, &inputs);
        let cpu: Vec<Vec4> = inputs
            .iter()
            .map(|[i]| Vec4::new(penumbra_scale(i.x), blocker_weight(i.y, i.z), 0.0, 0.0))
            .collect();
        assert_vectors("penumbra_scale and blocker_weight", &gpu, &cpu, 1e-6, 1.0);
    });
}
