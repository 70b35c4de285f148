//! Lights that weaken with the distance as those of other engines do.

use crate::context::in_each_api;
use crate::lights::{STEP, overlay};
use crate::shot::Shot;
use crate::truth::SEAMS;
use crate::world::World;
use antumbra_gl::{Encoding, Falloff, Light, Renderer};
use antumbra_math::Light as Place;
use glam::{DVec3, Vec3};

/// What hosts' shaders multiply an intensity by, at a distance; written after their own sources.
type Formula = fn(f64) -> f64;

/// three.js r150 and later, `getDistanceAttenuation`.
fn three_js(distance: f64, cutoff: f64, decay: f64) -> f64 {
    let falloff = distance.powf(decay).max(0.01).recip();
    let window = (1.0 - (distance / cutoff).powi(4)).clamp(0.0, 1.0);
    if cutoff > 0.0 { falloff * window * window } else { falloff }
}

/// glTF 2.0, `KHR_lights_punctual`.
fn gltf(distance: f64, range: f64) -> f64 {
    (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0) / (distance * distance)
}

fn each() -> Vec<(&'static str, Falloff, f64, Formula)> {
    let endless = f64::INFINITY;
    vec![
        ("physical", Falloff::PHYSICAL, endless, |d| 1.0 / (d * d)),
        ("glTF's range", Falloff::PHYSICAL, 7.2, |d| gltf(d, 7.2)),
        ("none", Falloff::NONE, endless, |_| 1.0),
        ("classic", Falloff::classic(1.0, 0.2, 0.1), endless, |d| 1.0 / (1.0 + 0.2 * d + 0.1 * d * d)),
        ("three-d", Falloff::three_d(0.0, 0.0, 0.03), endless, |d| 1.0 / (0.03 * d * d).max(1.0)),
        ("three.js", Falloff::three_js(2.0), 7.5, |d| three_js(d, 7.5, 2.0)),
        ("three.js without an end", Falloff::three_js(2.0), endless, |d| three_js(d, 0.0, 2.0)),
        ("three.js, decay 1", Falloff::three_js(1.0), 8.0, |d| three_js(d, 8.0, 1.0)),
        ("three.js, decay 1.3", Falloff::three_js(1.3), endless, |d| three_js(d, 0.0, 1.3)),
        ("three.js, decay 0", Falloff::three_js(0.0), 7.2, |d| three_js(d, 7.2, 0.0)),
    ]
}

/// The overlay weighs each light as the host does; and where a light has ended it casts no shadow.
#[test]
fn lights_weaken_as_the_hosts_do() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let Place::Point { position } = world.lights[0].place else { panic!("the first light is a point") };
        for (name, falloff, range, formula) in each() {
            let intensity = 8.0 / formula(6.0) as f32;
            let light = Light::point(position, [intensity; 3]).with_falloff(falloff);
            let light = if range.is_finite() { light.with_range(range) } else { light };
            let lights = [light, world.lights[1]];
            let ambient = Vec3::splat(0.2);
            let frame = shot.frame().lights(&lights).ambient(ambient);
            let picture = overlay(gl, &mut renderer, &frame, Encoding::Linear);
            let (mut judged, mut ended, mut dark, mut wrong) = (0, 0, 0, 0);
            for i in (0..picture.len()).filter(|&i| truth.sure[i]) {
                let Some(seen) = shot.seen[i] else { continue };
                let to_light = position - seen.point;
                let cosine = seen.normal.dot(to_light.normalize()).max(0.0);
                let e = f64::from(intensity) * cosine * formula(to_light.length());
                let own = (truth.lights[0][i].0, DVec3::splat(e));
                let other = (truth.lights[1][i].0, truth.lights[1][i].1.as_dvec3());
                let (mut arrives, mut all) = (ambient.as_dvec3(), ambient.as_dvec3());
                for (visibility, e) in [own, other] {
                    arrives += e * f64::from(visibility);
                    all += e;
                }
                let expected = (arrives / all).as_vec3();
                let [r, g, b, _] = picture[i].map(|c| f32::from(c) / 255.0);
                let off = (Vec3::new(r, g, b) - expected).abs().max_element();
                judged += 1;
                ended += usize::from(to_light.length() > range);
                dark += usize::from(own.0 < 0.5 && e > 0.05);
                wrong += usize::from(off > STEP && !truth.is_sliver(0, i) && !truth.is_sliver(1, i));
            }
            eprintln!("{name}: {wrong} wrong of {judged}, {dark} dark, {ended} beyond the range");
            assert!(judged > 10_000 && dark > 80, "{name}: {judged} judged, {dark} dark");
            assert!(wrong <= (judged as f64 * SEAMS) as usize, "{name}: {wrong} pixels are wrong");
            assert!(range.is_infinite() || ended > 200, "{name}: {ended} beyond the range");
        }
    });
}

/// A light whose range ends before an occluder costs nothing: no pair is drawn.
#[test]
fn what_is_out_of_range_is_not_drawn() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let mut drawn = |range: f64| {
            let lights = [world.lights[0].with_range(range)];
            let picture = overlay(gl, &mut renderer, &shot.frame().lights(&lights), Encoding::Linear);
            (renderer.stats().drawn_pairs, picture)
        };
        let (all, _) = drawn(1e6);
        let (few, _) = drawn(4.5);
        let (none, white) = drawn(0.5);
        assert!(all > few && few > none, "{all} pairs, {few} nearby, {none} out of reach");
        assert_eq!(none, 0, "nothing is in reach");
        assert!(white.iter().all(|texel| *texel == [255; 4]), "and nothing is shadowed");
    });
}
