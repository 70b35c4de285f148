//! The shaders' functions of area lights are their Rust twins, in float32.

use crate::context::in_each_api;
use crate::twins::{AREA, LIGHTS, Random, on_gpu};
use antumbra_gl::{Area, Light, ShaderLight};
use antumbra_math::soft::{AreaLight, Nodes, pair_visibility};
use antumbra_math::{Cone, Disc, Rectangle, Shape, Sphere, Triangle};
use glam::{DMat4, DVec3, Vec3, Vec4};

const SOFT: &str = include_str!("../../src/shaders/analytic/soft.glsl");

/// A light, with a size that goes from a thousandth of its distance to most of it.
fn area(random: &mut Random, kind: u32) -> Area {
    let size = 6.0 * 10f64.powf(random.within(-3.0, -0.2));
    let direction = random.unit();
    match kind {
        0 => Area::Sphere { radius: size },
        1 => Area::Disc { direction, radius: size },
        _ => {
            let right = direction.any_orthonormal_vector();
            let half_up = direction.cross(right) * (size * random.within(0.2, 1.0));
            Area::Rectangle { direction, half_right: right * size, half_up }
        }
    }
}

#[test]
fn irradiance_of_areas_is_its_twin() {
    for (define, kinds) in [("#define BALL_LIGHTS\n", 0..1), ("#define FLAT_LIGHTS\n", 0..3)] {
        in_each_api(|gl| {
            let mut random = Random::new();
            let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
            for _ in 0..10_000 {
                let color = random.vector(1.0).abs().as_vec3() * 10.0;
                let kind = random.0.u32(kinds.clone());
                let light = Light::point(random.vector(8.0), color).with_area(area(&mut random, kind));
                let light = ShaderLight::new(&light, &DMat4::IDENTITY);
                let position = random.vector(4.0).as_vec3();
                // Towards the light more often than away from it.
                let toward = (light.place.truncate() - position).normalize_or_zero();
                let normal = (random.unit().as_vec3() + toward * 0.5).normalize_or(Vec3::Y);
                cpu.push(light.irradiance(position, normal));
                let ShaderLight { place, color, cone, attenuation, right, up } = light;
                let (position, normal) = (position.extend(0.0), normal.extend(0.0));
                inputs.push([place, color, cone, attenuation, right, up, position, normal]);
            }
            let sides = if define.contains("FLAT") { "INPUT(4), INPUT(5), " } else { "" };
            let body = format!(
                "o_out = vec4(irradiance(INPUT(0), INPUT(1), INPUT(2), INPUT(3), {sides}INPUT(6).xyz, INPUT(7).xyz), 0.0);"
            );
            let Some(gpu) = on_gpu(gl, &[define, AREA, LIGHTS], &body, &inputs) else { return };
            // Where the horizon leaves a sliver of a light, float32 and the driver's arctangents say little of it.
            let off = (gpu.iter().zip(&cpu))
                .filter(|(g, c)| !((g.truncate() - **c).abs().max_element() <= 2e-4 * c.max_element() + 2e-4))
                .count();
            let lit = cpu.iter().filter(|e| e.max_element() > 0.0).count();
            eprintln!("{define}irradiance: {off} of {} off, {lit} lit", cpu.len());
            assert!(lit > cpu.len() / 4, "{lit} are lit");
            assert!(off <= cpu.len() / 500, "{off} of {} differ", cpu.len());
        });
    }
}

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

const MAKE: [(&str, &str); 5] = [
    ("", "Hidden hidden = sphere_conic(INPUT(6).xyz - point, INPUT(6).w, p);"),
    ("", "Hidden hidden = disc_conic(INPUT(6).xyz - point, INPUT(7).xyz, INPUT(6).w, p);"),
    (
        "#define CORNERS 3\n",
        "Hidden hidden = polygon_of(vec3[3](INPUT(6).xyz - point, INPUT(7).xyz - point, INPUT(8).xyz - point), p);",
    ),
    (
        "#define CORNERS 4\n",
        "Hidden hidden = polygon_of(vec3[4](INPUT(6).xyz - point, INPUT(7).xyz - point, INPUT(8).xyz - point, INPUT(9).xyz - point), p);",
    ),
    (
        "#define CONE\n",
        "vec3 corners[3]; vec3 base = INPUT(6).xyz - point;
         bool has = cone_triangle(base, INPUT(7).xyz, INPUT(6).w, INPUT(7).w, corners);
         Hidden hidden = Hidden(disc_conic(base, INPUT(7).xyz, INPUT(6).w, p), polygon_of(corners, p), true, has);",
    ),
];

#[test]
fn hidden_irradiance_is_its_twin() {
    in_each_api(|gl| {
        let nodes = Nodes::new(8);
        for light_kind in 0..3 {
            for (kind, (define, make)) in MAKE.iter().enumerate() {
                let mut random = Random::new();
                let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
                while inputs.len() < 6000 {
                    let (center, area) = (random.vector(8.0), area(&mut random, light_kind));
                    let point = random.vector(4.0);
                    let size = random.within(0.05, 1.0);
                    let middle = point.lerp(center, random.within(0.2, 0.8)) + random.vector(size);
                    let (shape, texels) = shape(&mut random, kind, middle, size);
                    let normal = (random.unit() + (center - point).normalize_or(DVec3::Y) * 0.7)
                        .normalize_or(DVec3::Y);
                    let (mut cone, mut half) = (Vec4::ZERO, [Vec4::ZERO; 2]);
                    let mut radius = 0.0;
                    let light = match area {
                        Area::None => continue,
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
                    };
                    let (point, normal) = (point.as_vec3(), normal.as_vec3());
                    let v = pair_visibility(&light, &shape, point, normal, &nodes);
                    // What says most is what is partly hidden.
                    if light.patch(point, normal).is_none()
                        || ((v == 0.0 || v == 1.0) && random.0.u32(..8) > 0)
                    {
                        continue;
                    }
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
                    ]);
                }
                let light = [
                    "sphere_patch(INPUT(0).xyz, INPUT(0).w, point, normal)",
                    "disc_patch(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w, point, normal)",
                    "flat_patch(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz, INPUT(3).xyz, false, point)",
                ][light_kind as usize];
                let body = format!(
                    "vec3 point = INPUT(4).xyz; vec3 normal = INPUT(5).xyz; LightPatch p = {light}; {make}
                     Strips strips = strips_of(p, normal); float whole = strips_whole(strips);
                     o_out = vec4(whole > 0.0 ? clamp(1.0 - hidden_irradiance(hidden, strips) / whole, 0.0, 1.0) : 0.0);"
                );
                let Some(gpu) = on_gpu(gl, &[define, AREA, SOFT], &body, &inputs) else { return };
                // Points inside a solid are told apart elsewhere.
                let off =
                    (gpu.iter().zip(&cpu)).filter(|(g, c)| **c > 0.0 && !((g.x - **c).abs() <= 2e-3)).count();
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
