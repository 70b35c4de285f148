//! What occluders hide of lights with an area.

use super::lights::area;
use super::random::Random;
use super::{AREA, SOFT, in_each_api, on_gpu};
use crate::Area;
use antumbra_math::soft::{AreaLight, Nodes, Standing, pair_visibility};
use antumbra_math::{Cone, Disc, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec3, Vec4};

/// What hides, and the GLSL that makes `hidden` of it, from INPUT(6) on.
fn shape(random: &mut Random, kind: usize, center: DVec3, size: f64) -> (Shape, [Vec4; 4]) {
    let axis = random.unit();
    let texel = |v: DVec3, w: f64| v.as_vec3().extend(w as f32);
    let zero = Vec4::ZERO;
    match kind {
        0 => (Sphere { center, radius: size }.into(), [texel(center, size), zero, zero, zero]),
        1 => {
            let disc = Disc { center, normal: axis, radius: size };
            (disc.into(), [texel(center, size), texel(axis, 0.0), zero, zero])
        }
        2 => {
            let vertices = [0; 3].map(|_| center + random.vector(size));
            let [a, b, c] = vertices.map(|v| texel(v, 0.0));
            (Triangle { vertices }.into(), [a, b, c, zero])
        }
        3 => {
            let half_right = axis * size;
            let half_forward = axis.any_orthonormal_vector() * (0.6 * size);
            let rectangle = Rectangle { center, half_right, half_forward };
            (rectangle.into(), rectangle.corners().map(|v| texel(v, 0.0)))
        }
        _ => {
            let height = size * 1.8;
            let cone = Cone { base_center: center, axis, radius: size, height };
            (cone.into(), [texel(center, size), texel(axis, height), zero, zero])
        }
    }
}

/// Whether a point is inside a solid.
fn inside(shape: &Shape, point: DVec3) -> bool {
    match shape {
        Shape::Sphere(s) => point.distance(s.center) < s.radius,
        Shape::Cone(c) => {
            let up = (point - c.base_center).dot(c.axis);
            let out = (point - c.base_center - c.axis * up).length();
            up > 0.0 && out < c.radius * (1.0 - up / c.height)
        }
        _ => false,
    }
}

/// INPUT(10) is how the shape stands to the light: how far that is over it, or the circle they meet in; INPUT(11) the circle's
/// axis.
const MAKE: [(&str, &str); 5] = [
    (
        "#define SPHERE\n",
        "vec3 at = INPUT(6).xyz - point; Hidden hidden = cap_of(conic_of_sphere(at, INPUT(6).w, p));
         for (int k = 0; k < int(INPUT(10).z); k++) {
             hidden = hidden_crossing(at, vec3(INPUT(6).w, INPUT(10).xy), INPUT(11).xyz, p, kept, keeps);
         }",
    ),
    (
        "",
        "vec3 at = INPUT(6).xyz - point; float over = INPUT(10).x; float side = dot(at, INPUT(7).xyz) < 0.0 ? -1.0 : 1.0;
         Hidden hidden = conic_of_disc(at, INPUT(7).xyz, INPUT(6).w, over, p);
         keeps = conic_of_cut(INPUT(7).xyz * side, over * side, p, kept);",
    ),
    (
        "#define CORNERS 3\n",
        "vec3 corners[3] = vec3[3](INPUT(6).xyz - point, INPUT(7).xyz - point, INPUT(8).xyz - point);
         float over = INPUT(10).x; vec3 normal_ = corners_normal(corners);
         float side = dot(normal_, corners[0]) < 0.0 ? -1.0 : 1.0;
         Hidden hidden = polygon_of(corners, over, p); keeps = conic_of_cut(normal_ * side, over * side, p, kept);",
    ),
    (
        "#define CORNERS 4\n",
        "vec3 corners[4] = vec3[4](INPUT(6).xyz - point, INPUT(7).xyz - point, INPUT(8).xyz - point, INPUT(9).xyz - point);
         float over = INPUT(10).x; vec3 normal_ = corners_normal(corners);
         float side = dot(normal_, corners[0]) < 0.0 ? -1.0 : 1.0;
         Hidden hidden = polygon_of(corners, over, p); keeps = conic_of_cut(normal_ * side, over * side, p, kept);",
    ),
    (
        "#define CONE\n",
        "vec3 corners[3]; vec3 base = INPUT(6).xyz - point;
         bool has = cone_triangle(base, INPUT(7).xyz, INPUT(6).w, INPUT(7).w, corners);
         float over = dot(corners_normal(corners), p.origin * p.reach - corners[0]);
         Hidden hidden = Hidden(conic_of_disc(base, INPUT(7).xyz, INPUT(6).w, INPUT(10).x, p),
                                polygon_of(corners, over, p), true, has);",
    ),
];

/// What the shaders take for infinity.
const ALL_OVER: f64 = 1e20;

#[test]
fn hidden_irradiance_is_its_twin() {
    in_each_api(|gl| {
        let nodes = Nodes::new(8);
        for light_kind in 0..3 {
            for (kind, (define, make)) in MAKE.iter().enumerate() {
                let mut random = Random::new();
                let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
                let mut crossing = 0;
                while inputs.len() < 6000 {
                    let (center, area) = (random.vector(8.0), area(&mut random, light_kind));
                    let point = random.vector(4.0);
                    let size = random.within(0.05, 1.0);
                    // Every third crosses the light or is near to it; of cones that do the outline hangs by roundings.
                    let at = if inputs.len() % 3 == 0 && kind < 4 {
                        random.within(0.9, 1.1)
                    } else {
                        random.within(0.2, 0.8)
                    };
                    let middle = point.lerp(center, at) + random.vector(size);
                    let (shape, texels) = shape(&mut random, kind, middle, size);
                    let normal = (random.unit() + (center - point).normalize_or(DVec3::Y) * 0.7)
                        .normalize_or(DVec3::Y);
                    let (mut cone, mut half) = (Vec4::ZERO, [Vec4::ZERO; 2]);
                    let mut radius = 0.0;
                    let light = match area {
                        Area::Sphere { radius: r } => {
                            radius = r;
                            AreaLight::Sphere { center, radius: r }
                        }
                        Area::Disc { direction, radius: r } => {
                            (radius, cone) = (r, direction.as_vec3().extend(0.0));
                            AreaLight::Disc { center, direction, radius: r }
                        }
                        Area::Rectangle { direction, half_right, half_up } => {
                            cone = direction.as_vec3().extend(0.0);
                            half = [half_right, half_up].map(|v| v.as_vec3().extend(0.0));
                            AreaLight::Rectangle { center, direction, half_right, half_up }
                        }
                        _ => continue,
                    };
                    let (point, normal) = (point.as_vec3(), normal.as_vec3());
                    let v = pair_visibility(&light, &shape, point, normal, &nodes);
                    // Inside a solid nothing arrives, which other tests see to.
                    if inside(&shape, point.as_dvec3()) {
                        continue;
                    }
                    // What says most is what is partly hidden.
                    if light.patch(point, normal).is_none()
                        || ((v == 0.0 || v == 1.0) && random.0.u32(..8) > 0)
                    {
                        continue;
                    }
                    let standing = match Standing::new(&light, &shape) {
                        Standing::Behind | Standing::Around => continue, // not drawn
                        Standing::Over(over) => Vec4::X * over.clamp(-ALL_OVER, ALL_OVER) as f32,
                        Standing::Circle { along, radius } => {
                            crossing += 1;
                            Vec4::new(along as f32, radius as f32, 1.0, 0.0)
                        }
                        Standing::Apart => Vec4::ZERO,
                    };
                    let toward = Standing::toward(&light, middle).as_vec3().extend(0.0);
                    cpu.push(v);
                    let place = center.as_vec3().extend(radius as f32);
                    let [a, b, c, d] = texels;
                    inputs.push([
                        place,
                        cone,
                        half[0],
                        half[1],
                        point.extend(0.0),
                        normal.extend(0.0),
                        a,
                        b,
                        c,
                        d,
                        standing,
                        toward,
                    ]);
                }
                let light = [
                    "antumbra_patch_of_sphere(INPUT(0).xyz, INPUT(0).w, point, normal)",
                    "antumbra_patch_of_disc(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w, point, normal)",
                    "antumbra_patch_of_flat(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz, INPUT(3).xyz, false, point)",
                ][light_kind as usize];
                let body = format!(
                    "vec3 point = INPUT(4).xyz; vec3 normal = INPUT(5).xyz; AntumbraPatch p = {light};
                     Conic kept; bool keeps = false; {make}
                     AntumbraStrips strips = antumbra_strips_of(p, normal); float whole = antumbra_strips_whole(strips);
                     o_out = vec4(whole > 0.0 ? clamp(1.0 - hidden_taken(hidden, strips, kept, keeps ? 1 : 0) / whole, 0.0, 1.0) : 0.0);"
                );
                let gpu = on_gpu(gl, &[define, AREA, SOFT], &body, &inputs);
                let off = (gpu.iter().zip(&cpu)).filter(|(g, c)| !((g.x - **c).abs() <= 2e-3)).count();
                assert!(kind > 0 || crossing > 100, "{crossing} balls cross the light");
                let umbra = cpu.iter().filter(|v| **v == 0.0).count();
                assert!(umbra > cpu.len() / 100, "{umbra} are in the umbra");
                let partial = cpu.iter().filter(|v| **v > 0.0 && **v < 1.0).count();
                eprintln!("light {light_kind}, shape {kind}: {off} of {} off, {partial} partial", cpu.len());
                assert!(partial > cpu.len() / 3, "{partial} are partial");
                assert!(
                    off <= cpu.len() / 500,
                    "light {light_kind}, shape {kind}: {off} of {} differ",
                    cpu.len()
                );
            }
        }
    });
}
