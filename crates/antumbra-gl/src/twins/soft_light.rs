//! What the programs of lights with an area share: the pixel's width, the whole light, points inside of solids.

use super::lights::area;
use super::random::Random;
use super::{AREA, COVERAGE, SOFT, SURFACE, in_each_api, on_gpu};
use crate::Area;
use antumbra_math::blocking::Footprint;
use antumbra_math::soft::{AreaLight, Nodes, Patch, Strips, cap_irradiance};
use glam::{Vec3, Vec4};
use std::f32::consts::PI;

const SOFT_LIGHT: &str = include_str!("../shaders/analytic/soft_light.glsl");
const BALLS: &str = "#define LIGHT_TEXELS 1\n";
const FLATS: &str = "#define LIGHT_TEXELS 4\n";

/// Half the width, in pixels, that a penumbra has at least.
const HALF_WIDTH: f32 = 0.75;

/// A light taken for wide enough that the penumbra of an occluder at the distance `apart` is no narrower than a pixel.
fn antialiased(patch: Patch<Vec3>, f: &Footprint<Vec3>, apart: f32) -> Patch<Vec3> {
    let (a, b) = (patch.origin.cross(f.dx), patch.origin.cross(f.dy));
    let pixel = (0.5 * (a.dot(a) + b.dot(b))).sqrt() * HALF_WIDTH;
    let shift = pixel * (1.0 / apart.max(1e-6 * patch.reach) - 1.0 / patch.reach).max(0.0);
    let widen = (shift / patch.right.dot(patch.right).max(1e-30).sqrt()).max(1.0);
    Patch { right: patch.right * widen, up: patch.up * widen, ..patch }
}

/// The irradiance of the whole light, in the units of [`Strips::irradiance`]; of a ball in closed form.
fn light_whole(patch: &Patch<Vec3>, normal: Vec3, is_ball: bool) -> f32 {
    if !is_ball {
        return Strips::new(patch, normal).whole(&Nodes::new(8));
    }
    let tangent_2 = patch.right.dot(patch.right);
    cap_irradiance((tangent_2 / (1.0 + tangent_2)).sqrt(), normal.dot(patch.origin)) * PI / tangent_2
}

/// Whether a ball with its centre at `center`, as the point sees it, holds the point.
fn ball_holds(center: Vec3, radius: f32, has_id: bool, tolerance: f32) -> bool {
    let reach = radius + if has_id { 0.0 } else { tolerance };
    center.dot(center) < reach * reach
}

/// The same of a cone, with the middle of its base at `center`.
fn cone_holds(center: Vec3, axis: Vec3, [radius, height]: [f32; 2], has_id: bool, tolerance: f32) -> bool {
    let up = -center.dot(axis);
    let width = radius * (1.0 - up / height);
    let side = (width - (center + axis * up).length()) * height / height.hypot(radius);
    up.min(side).min(height - up) > if has_id { 0.0 } else { -tolerance }
}

/// A light, a point that it shines on, its normal and footprint, as Rust and as the shader read them.
fn seen_light(random: &mut Random, kind: u32) -> (Patch<Vec3>, Vec3, Footprint<Vec3>, [Vec4; 5]) {
    loop {
        let (center, area) = (random.vector(8.0), area(random, kind));
        let (light, direction, radius) = match area {
            Area::Sphere { radius } => (AreaLight::Sphere { center, radius }, Vec3::ZERO, radius),
            Area::Disc { direction, radius } => {
                (AreaLight::Disc { center, direction, radius }, direction.as_vec3(), radius)
            }
            _ => continue,
        };
        let point = random.vector(4.0).as_vec3();
        let toward = (center.as_vec3() - point).normalize_or(Vec3::Y);
        let normal = (random.unit().as_vec3() + toward).normalize_or(Vec3::Y);
        let Some(patch) = light.patch(point, normal) else { continue };
        let footprint = random.footprint(point.as_dvec3());
        let texels = [
            center.as_vec3().extend(radius as f32),
            direction.extend(0.0),
            normal.extend(0.0),
            footprint.dx.extend(0.0),
            footprint.dy.extend(0.0),
        ];
        return (patch, normal, footprint, texels);
    }
}

#[test]
fn lights_are_widened_and_summed_as_their_twins() {
    in_each_api(|gl| {
        for (define, kind, make) in [
            (BALLS, 0, "antumbra_patch_of_sphere(INPUT(0).xyz, INPUT(0).w, point, normal)"),
            (FLATS, 1, "antumbra_patch_of_disc(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w, point, normal)"),
        ] {
            let mut random = Random::new();
            let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
            let mut widened = 0;
            while inputs.len() < 10_000 {
                let (patch, normal, footprint, [a, b, c, d, e]) = seen_light(&mut random, kind);
                let apart = random.within(0.01, 8.0) as f32;
                let wide = antialiased(patch, &footprint, apart);
                let whole = light_whole(&patch, normal, kind == 0);
                widened += usize::from(wide.right != patch.right);
                cpu.push(Vec4::new(wide.right.length(), wide.up.length(), whole, 0.0));
                inputs.push([a, b, c, d, e, footprint.point.extend(apart)]);
            }
            let body = format!(
                "vec3 point = INPUT(5).xyz; vec3 normal = INPUT(2).xyz; AntumbraPatch p = {make};
                 Footprint f = Footprint(point, INPUT(3).xyz, INPUT(4).xyz);
                 AntumbraPatch wide = antialiased(p, f, INPUT(5).w);
                 float whole = light_whole(p, antumbra_strips_of(p, normal), normal);
                 o_out = vec4(length(wide.right), length(wide.up), whole, 0.0);"
            );
            let gpu = on_gpu(gl, &[define, COVERAGE, SURFACE, AREA, SOFT, SOFT_LIGHT], &body, &inputs);
            assert!(widened > 500 && widened < 9500, "some are widened: {widened}");
            // Where the horizon leaves a sliver, float32 and the driver's arctangents say little of it.
            let off = gpu
                .iter()
                .zip(&cpu)
                .filter(|(g, c)| !((**g - **c).abs().max_element() <= 1e-3 * c.length().max(1e-2)));
            let off = off.count();
            eprintln!("light {kind}: {off} off");
            assert!(off <= cpu.len() / 1000, "light {kind}: {off} differ");
        }
    });
}

#[test]
fn points_inside_of_solids_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for i in 0..20_000 {
            let center = random.vector(1.5).as_vec3();
            let axis = random.unit().as_vec3();
            let [radius, height] = [0; 2].map(|_| random.within(0.3, 2.0) as f32);
            let (has_id, tolerance) = (i % 2 == 0, random.within(0.0, 0.2) as f32);
            let ball = ball_holds(center, radius, has_id, tolerance);
            let cone = cone_holds(center, axis, [radius, height], has_id, tolerance);
            cpu.push(Vec4::new(u8::from(ball).into(), u8::from(cone).into(), 0.0, 0.0));
            inputs.push([
                center.extend(radius),
                axis.extend(height),
                Vec4::new(u8::from(has_id).into(), tolerance, 0.0, 0.0),
            ]);
        }
        let body = "SurfacePoint s; s.has_id = INPUT(2).x > 0.5; s.tolerance = INPUT(2).y;
                    bool ball = ball_holds(INPUT(0).xyz, INPUT(0).w, s);
                    bool cone = cone_holds(INPUT(0).xyz, INPUT(1).xyz, INPUT(0).w, INPUT(1).w, s);
                    o_out = vec4(ball ? 1.0 : 0.0, cone ? 1.0 : 0.0, 0.0, 0.0);";
        let gpu = on_gpu(gl, &[BALLS, COVERAGE, SURFACE, AREA, SOFT, SOFT_LIGHT], body, &inputs);
        let off = gpu.iter().zip(&cpu).filter(|(g, c)| g != c).count();
        let inside = cpu.iter().fold(Vec4::ZERO, |sum, c| sum + *c);
        assert!(inside.x > 2000.0 && inside.y > 500.0, "some are inside: {inside}");
        // On the very surface either answer is right.
        assert!(off <= 4, "{off} differ");
    });
}

/// The twins' own truth: a light that is wide enough stays, and one that is not spans a pixel.
#[test]
fn a_narrow_penumbra_is_a_pixel_wide() {
    let patch = Patch {
        origin: Vec3::Y,
        right: Vec3::X * 1e-4,
        up: Vec3::Z * 1e-4,
        round: true,
        reach: 10.0,
        tangent_2: 100.0,
        radius_2: 1e-6,
    };
    let footprint = Footprint { point: Vec3::ZERO, dx: Vec3::X * 0.02, dy: Vec3::Z * 0.02 };
    // The edge of an occluder half way moves on the light by as much as the point does: 0.02 of 10 metres a pixel.
    let wide = antialiased(patch, &footprint, 5.0);
    assert!((wide.right.length() - HALF_WIDTH * 0.002).abs() < 1e-6, "{}", wide.right.length());
    assert_eq!(antialiased(patch, &Footprint::point(Vec3::ZERO), 5.0), patch, "a pixel without extent");
    let whole = light_whole(&Patch { right: Vec3::X * 0.1, up: Vec3::Z * 0.1, ..patch }, Vec3::Y, true);
    let strips = light_whole(&Patch { right: Vec3::X * 0.1, up: Vec3::Z * 0.1, ..patch }, Vec3::Y, false);
    assert!((whole - strips).abs() < 1e-4 * whole, "the closed form and the strips: {whole}, {strips}");
}
