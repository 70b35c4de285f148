//! What arrives from lights without occluders.

use super::random::Random;
use super::{AREA, LIGHTS, in_each_api, on_gpu};
use crate::{Area, Falloff, Light, ShaderLight};
use glam::{DMat4, Vec3};

#[test]
fn irradiance_is_its_twin() {
    in_each_api(|gl| irradiance(gl, "", false));
    in_each_api(|gl| irradiance(gl, "#define ANTUMBRA_FALLOFF\n", true));
}

fn irradiance(gl: &glow::Context, define: &str, falloff: bool) {
    let mut random = Random::new();
    let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
    for i in 0..20_000 {
        let color = random.vector(1.0).abs().as_vec3() * 10.0;
        let mut light = match i % 3 {
            0 => Light::point(random.vector(8.0), color),
            1 => Light::directional(random.unit(), color * 0.1),
            _ => {
                let outer = random.within(0.05, 1.5) as f32;
                Light::spot(
                    random.vector(8.0),
                    random.unit(),
                    outer * random.within(0.0, 1.0) as f32,
                    outer,
                    color,
                )
            }
        };
        let (constant, exponent) = (random.within(0.0, 1.0) as f32, random.within(0.5, 4.0) as f32);
        light.falloff = match i % 7 {
            0 => Falloff::classic(1.0, 0.1, 0.05),
            1 if falloff => Falloff::three_d(constant, 0.1, 0.2),
            2 if falloff => Falloff::three_js(exponent),
            3 if falloff => Falloff::NONE,
            _ => Falloff::PHYSICAL,
        };
        if falloff && i % 2 == 0 {
            light.range = random.within(1.0, 20.0);
        }
        let light = ShaderLight::new(&light, DMat4::IDENTITY);
        let position = if i % 100 == 0 { light.place.truncate() } else { random.vector(4.0).as_vec3() };
        let normal = random.unit().as_vec3();
        cpu.push(light.irradiance(position, normal));
        let ShaderLight { place, color, cone, attenuation, reach, .. } = light;
        inputs.push([place, color, cone, attenuation, reach, position.extend(0.0), normal.extend(0.0)]);
    }
    let body = "AntumbraLight light =
            AntumbraLight(INPUT(0), INPUT(1), INPUT(2), INPUT(3), INPUT(4), vec4(0.0), vec4(0.0));
            o_out = vec4(antumbra_irradiance(light, INPUT(5).xyz, INPUT(6).xyz), 0.0);";
    let gpu = on_gpu(gl, &[define, AREA, LIGHTS], body, &inputs);
    let mut off = Vec::new();
    for (i, (gpu, cpu)) in gpu.iter().zip(&cpu).enumerate() {
        // A few units in the last place, relative; at the rim of a cone the falloff is steep.
        if !((gpu.truncate() - *cpu).abs().max_element() <= 1e-4 * cpu.max_element().max(1e-3)) {
            off.push((i, *gpu, *cpu));
        }
    }
    eprintln!("irradiance: {} of {} off", off.len(), cpu.len());
    let lit = cpu.iter().filter(|e| e.max_element() > 0.0).count();
    assert!(lit > cpu.len() / 4, "{lit} are lit");
    assert!(
        off.len() <= cpu.len() / 1000,
        "{} of {} differ: {:?}",
        off.len(),
        cpu.len(),
        &off[..off.len().min(5)]
    );
}

/// A light, with a size that goes from a thousandth of its distance to most of it.
pub(super) fn area(random: &mut Random, kind: u32) -> Area {
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
    for (define, kinds) in
        [("#define ANTUMBRA_BALL_LIGHTS\n", 0..1), ("#define ANTUMBRA_FLAT_LIGHTS\n", 0..3)]
    {
        in_each_api(|gl| {
            let mut random = Random::new();
            let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
            for _ in 0..10_000 {
                let color = random.vector(1.0).abs().as_vec3() * 10.0;
                let kind = random.0.u32(kinds.clone());
                let light = Light::point(random.vector(8.0), color).with_area(area(&mut random, kind));
                let light = ShaderLight::new(&light, DMat4::IDENTITY);
                let position = random.vector(4.0).as_vec3();
                // Towards the light more often than away from it.
                let toward = (light.place.truncate() - position).normalize_or_zero();
                let normal = (random.unit().as_vec3() + toward * 0.5).normalize_or(Vec3::Y);
                cpu.push(light.irradiance(position, normal));
                let ShaderLight { place, color, cone, attenuation, reach, right, up } = light;
                let (position, normal) = (position.extend(0.0), normal.extend(0.0));
                inputs.push([place, color, cone, attenuation, reach, right, up, position, normal]);
            }
            let body = "AntumbraLight light = AntumbraLight(INPUT(0), INPUT(1), INPUT(2), INPUT(3), INPUT(4), INPUT(5), INPUT(6));
                o_out = vec4(antumbra_irradiance(light, INPUT(7).xyz, INPUT(8).xyz), 0.0);";
            let gpu = on_gpu(gl, &[define, AREA, LIGHTS], body, &inputs);
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
