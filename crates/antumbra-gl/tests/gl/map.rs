//! Shadow maps in contexts: every kind of light, seams, awkward casters, options, and what a steady frame makes.

use crate::context::{Gl, in_each_api};
use crate::shot::{Shot, each_batch, known, read_texture};
use crate::truth::Truth;
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::Part;
use antumbra_gl::technique::map::{Filter, Options};
use antumbra_gl::{Area, Error, Frame, Light, Occluder, Renderer, Surface, Technique};
use antumbra_math::Light as Place;
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_6, PI};

pub(crate) fn renderer(gl: &Gl, technique: &str) -> Renderer {
    let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
    renderer.set_technique(Technique::parse(technique).expect("right")).expect("the driver makes it");
    renderer
}

/// Pixels that look at a point on the wrong side of a light's shadow, and pixels in shadow: of those that are sure and
/// that the light would reach.
fn wrong(truth: &Truth<'_>, light: usize, mask: &[u8]) -> (usize, usize) {
    let lights = &truth.lights[light];
    let sure = || (0..mask.len()).filter(|&i| truth.sure[i] && lights[i].1 != Vec3::ZERO);
    let wrong = sure().filter(|&i| (mask[i] > 127) != (lights[i].0 > 0.5)).count();
    (wrong, sure().filter(|&i| lights[i].0 < 0.5).count())
}

/// Masks of a frame of up to four lights with areas, which float textures hold where there are any.
fn soft_masks(gl: &Gl, shot: &Shot<'_>, renderer: &mut Renderer, frame: &Frame<'_>) -> Vec<Vec<u8>> {
    if !gl.has_floats() {
        return shot.masks(renderer, frame);
    }
    let mut texels: Vec<[f32; 4]> = Vec::new();
    let [_, _, width, height] = frame.viewport;
    each_batch(renderer, frame, |batch| {
        texels = read_texture(&gl.gl, batch.textures[0].glow(), [width, height])
    })
    .expect("the frame is right");
    let mask = |light: usize| texels.iter().map(|t| (t[light] * 255.0).round() as u8).collect();
    (0..frame.lights.len()).map(mask).collect()
}

/// The fraction of sure pixels that may be wrong: stairs of texels, and slivers narrower than a texel. At 2048 texels one
/// is a twentieth of these pictures' pixels.
const WRONG: f64 = 2e-4;

#[test]
fn every_kind_of_light_and_filter_is_right() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        for technique in ["map", "map:filter=none", "map:filter=pcss", "map:size=1024:radius=3"] {
            let mut renderer = renderer(gl, technique);
            let masks = shot.masks(&mut renderer, &shot.frame());
            gl.assert_no_complaint(technique);
            for (light, mask) in masks.iter().enumerate() {
                let (wrong, dark) = wrong(&truth, light, mask);
                eprintln!("{:?} {technique} light {light}: {wrong} wrong, {dark} dark", gl.kind);
                assert!(dark > 40, "light {light} has shadows: {dark}");
                let allowed = (mask.len() as f64 * WRONG) as usize;
                assert!(wrong <= allowed, "{technique}, light {light}: {wrong} pixels are wrong");
            }
        }
    });
}

/// Spots from a needle to all directions: one picture up to 60 degrees, then the faces of a cube.
#[test]
fn spots_of_every_angle_are_right() {
    in_each_api(|gl| {
        // The truth is that of a point light where the spot is, which shines everywhere.
        let spot = "type = \"spot\"\nposition = [-3.0, 6.0, 2.0]\ndirection = [0.5, -1.0, -0.3]\ninner_angle = 15.0\n\
                    outer_angle = 30.0\n";
        let (position, direction) = (DVec3::new(-3.0, 6.0, 2.0), DVec3::new(0.5, -1.0, -0.3).normalize());
        let point = ONE_OF_EACH.replace(spot, "type = \"point\"\nposition = [-3.0, 6.0, 2.0]\n");
        let world = World::parse(&point);
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let lit = &truth.lights[2];
        let mut renderer = renderer(gl, "map");
        let mut before = 0;
        for degrees in [1.0, 20.0, 45.0, 59.9, 60.1, 89.0, 90.0, 120.0, 180.0f64] {
            let angle = degrees.to_radians().min(PI - 1e-6);
            let lights = [Light::spot(position, direction, 0.0, angle as f32, Vec3::ONE)];
            let masks = shot.masks(&mut renderer, &shot.frame().lights(&lights));
            let off_axis = |i: usize| shot.seen[i].map(|s| direction.angle_between(s.point - position));
            let inside = |i: usize| off_axis(i).is_some_and(|at| at < angle - 1e-3);
            let judged: Vec<usize> = (0..masks[0].len())
                .filter(|&i| truth.sure[i] && inside(i) && lit[i].1 != Vec3::ZERO)
                .collect();
            let wrong = judged.iter().filter(|&&i| (masks[0][i] > 127) != (lit[i].0 > 0.5)).count();
            let dark = judged.iter().filter(|&&i| lit[i].0 < 0.5).count();
            let wide = judged.iter().filter(|&&i| off_axis(i) > Some(FRAC_PI_6)).count();
            eprintln!("{degrees} degrees: {wrong} wrong of {}, {dark} dark, {wide} wide", judged.len());
            assert!(judged.len() >= before, "{degrees} degrees: wider spots shine on no less");
            assert!(degrees < 20.0 || dark > 40, "{degrees} degrees: there are shadows");
            assert!(
                degrees < 31.0 || wide > 1000,
                "{degrees} degrees: {wide} are further than 30 off the axis"
            );
            before = judged.len();
            assert!(wrong <= 4, "{degrees} degrees: {wrong} pixels are wrong");
            gl.assert_no_complaint("a spot");
        }
    });
}

/// A lamp low over a wide table that casts: its light meets five faces of the cube, whose borders cross the table.
const LAMP: &str = r#"
camera = { eye = [0.0, 9.0, 0.5], target = [0.0, 0.0, 0.0] }
[[light]]
name = "lamp"
type = "point"
position = [0.1, 1.0, -0.05]
intensity = 10.0
[[object]]
name = "table"
shape = { type = "rectangle", width = 12.0, depth = 12.0 }
"#;

#[test]
fn faces_have_no_seams() {
    in_each_api(|gl| {
        let world = World::parse(LAMP);
        let shot = Shot::new(gl, &world);
        for technique in ["map:size=256", "map", "map:filter=none:size=64", "map:size=512:radius=8"] {
            let mut renderer = renderer(gl, technique);
            let masks = shot.masks(&mut renderer, &shot.frame());
            let dark = masks[0].iter().filter(|&&m| m < 255).count();
            assert_eq!(dark, 0, "{technique}: pixels of the lit table are dark");
        }
        let mut renderer = renderer(gl, "map:filter=pcss:size=512");
        let lamp = world.lights[0].with_area(Area::Sphere { radius: 0.2 });
        let masks = soft_masks(gl, &shot, &mut renderer, &shot.frame().lights(&[lamp]));
        let dark = masks[0].iter().filter(|&&m| m < 255).count();
        assert_eq!(dark, 0, "pixels of the lit table are dark under a ball of light");
        // A ring of balls round the lamp: their shadows cross all borders.
        let mut text = LAMP.to_owned();
        for i in 0..24 {
            let (sin, cos) = (f64::from(i) * 15f64.to_radians()).sin_cos();
            let out = [0.8, 1.0, 1.3][i as usize % 3];
            text += &format!(
                "[[object]]\nname = \"{i}\"\nshape = {{ type = \"sphere\", radius = 0.1 }}\ntranslation = [{}, 0.2, {}]\n",
                cos * out,
                sin * out
            );
        }
        let world = World::parse(&text);
        let viewport = [0, 0, 320, 240];
        let shot = Shot::with(gl, &world, world.camera(viewport), viewport, Default::default());
        let truth = world.truth(&shot);
        for technique in ["map", "map:filter=none"] {
            let mut renderer = self::renderer(gl, technique);
            let (wrong, dark) = wrong(&truth, 0, &shot.masks(&mut renderer, &shot.frame())[0]);
            assert!(dark > 800, "{dark} pixels are dark");
            assert!(wrong <= 8, "{technique}: {wrong} pixels are wrong");
        }
    });
}

/// Hosts without normals: they come from the depth buffer, and so does the receiver's plane.
#[test]
fn depth_alone_gives_no_acne() {
    in_each_api(|gl| {
        for text in [LAMP, ONE_OF_EACH] {
            let world = World::parse(text);
            let shot = Shot::new(gl, &world);
            let truth = world.truth(&shot);
            let surface = Surface::from_depth(known(shot.depth)).with_format(shot.format);
            for technique in ["map:size=256", "map", "map:filter=none"] {
                let mut renderer = renderer(gl, technique);
                let masks = shot.masks(&mut renderer, &shot.frame().surface(surface));
                for (light, mask) in masks.iter().enumerate() {
                    let lights = &truth.lights[light];
                    let lit = |&i: &usize| truth.sure[i] && lights[i].0 > 0.5 && lights[i].1 != Vec3::ZERO;
                    let dark = (0..mask.len()).filter(lit).filter(|&i| mask[i] < 128).count();
                    eprintln!("{:?} {technique} light {light}: {dark} wrongly dark", gl.kind);
                    assert!(dark <= 4, "{technique}, light {light}: {dark} pixels are wrongly dark");
                    let shadowed =
                        |&i: &usize| truth.sure[i] && lights[i].0 < 0.5 && lights[i].1 != Vec3::ZERO;
                    let shadows: Vec<usize> = (0..mask.len()).filter(shadowed).collect();
                    let seen = shadows.iter().filter(|&&i| mask[i] < 128).count();
                    assert!(
                        text == LAMP || shadows.len() > 40,
                        "light {light} has shadows: {}",
                        shadows.len()
                    );
                    assert!(
                        seen * 10 >= shadows.len() * 9,
                        "{technique}, light {light}: {seen} of {}",
                        shadows.len()
                    );
                }
            }
        }
    });
}

/// Dark pixels among those that see something.
pub(crate) fn dark(shot: &Shot<'_>, mask: &[u8]) -> (usize, usize) {
    let seen = || (0..mask.len()).filter(|&i| shot.seen[i].is_some());
    (seen().filter(|&i| mask[i] < 128).count(), seen().count())
}

pub(crate) const FLOOR: &str = r#"
camera = { eye = [0.0, 5.0, 6.0], target = [0.0, 0.0, 0.0] }
[[light]]
name = "lamp"
type = "point"
position = [0.0, 4.0, 0.0]
intensity = 10.0
[[object]]
name = "floor"
shape = { type = "plane" }
"#;

#[test]
fn lights_in_on_and_under_casters() {
    in_each_api(|gl| {
        let world = World::parse(FLOOR);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map");
        let mut dark_under = |what: &str, light: &Light, occluders: &[Occluder]| {
            let these_lights = [*light];
            let frame = shot.frame().lights(&these_lights).occluders(occluders);
            let (dark, all) = dark(&shot, &shot.masks(&mut renderer, &frame)[0]);
            gl.assert_no_complaint(what);
            dark as f64 / all as f64
        };
        let lamp = world.lights[0];
        let at = DVec3::Y * 4.0;
        let sun = Light::directional(DVec3::NEG_Y, Vec3::ONE);
        let spot = Light::spot(at, DVec3::NEG_Y, 0.5, 0.9, Vec3::ONE);
        assert_eq!(dark_under("nothing", &lamp, &[]), 0.0, "no casters");
        assert_eq!(dark_under("nothing", &sun, &[]), 0.0, "no casters");
        for solid in [Occluder::sphere(at * 1.02, 0.5), Occluder::cone(at * 0.97, at * 1.2, 1.0)] {
            assert_eq!(dark_under("inside", &lamp, &[solid]), 1.0, "a light inside {solid:?}");
        }
        let above = dark_under("touching", &lamp, &[Occluder::sphere(at + DVec3::Y, 1.0)]);
        assert_eq!(above, 0.0, "a ball that touches the light from above");
        let below = dark_under("touching", &lamp, &[Occluder::sphere(at - DVec3::Y, 1.0)]);
        assert!(below > 0.999, "a ball that touches the light from below leaves {below} dark");
        let sheet = Occluder::rectangle(at, DVec3::X, DVec3::Z);
        assert_eq!(dark_under("flat", &lamp, &[sheet]), 0.0, "a sheet with the light in its plane");
        let upright = Occluder::rectangle(DVec3::Y, DVec3::X, DVec3::Y * 0.5);
        assert!(dark_under("edge-on", &sun, &[upright]) < 0.01, "a sheet along the light");
        // Planes have no end: between light and floor, beyond the light, through the light, below the floor.
        for light in [lamp, sun, spot] {
            let plane = |height: f64| Occluder::plane(DVec3::Y * height, DVec3::Y);
            let ceiling = dark_under("a ceiling", &light, &[plane(2.0)]);
            // Outside a spot's cone there is no light to take.
            let whole = if matches!(light.place, Place::Spot { .. }) { 0.8 } else { 1.0 };
            assert!(ceiling >= whole, "a plane under {light:?} leaves {ceiling} dark");
            assert_eq!(dark_under("a cellar", &light, &[plane(-3.0)]), 0.0, "a plane below the floor");
            let tilted = Occluder::plane(DVec3::Y * 2.0, DVec3::new(0.3, 1.0, 0.1));
            assert!(dark_under("a roof", &light, &[tilted]) > 0.5, "a tilted plane under {light:?}");
        }
        let roof = Occluder::plane(DVec3::Y * 6.0, DVec3::Y);
        assert_eq!(dark_under("a roof", &lamp, &[roof]), 0.0, "a plane above the lamp");
        assert_eq!(dark_under("a roof", &sun, &[roof]), 1.0, "a plane under the sun");
        assert_eq!(
            dark_under("a level", &lamp, &[Occluder::plane(at, DVec3::Y)]),
            0.0,
            "a plane through the lamp"
        );
    });
}

#[test]
fn areas_need_pcss() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let areas = [
            Area::Sphere { radius: 0.3 },
            Area::Disc { direction: DVec3::NEG_Y, radius: 0.3 },
            Area::Rectangle { direction: DVec3::NEG_Y, half_right: DVec3::X * 0.4, half_up: DVec3::Z * 0.1 },
        ];
        for area in areas {
            let lights = [world.lights[1], world.lights[0].with_area(area)];
            let frame = shot.frame().lights(&lights);
            for technique in ["map", "map:filter=none"] {
                let refused = each_batch(&mut renderer(gl, technique), &frame, |_| {}).expect_err("an area");
                let Error::Refused { refusal, .. } = &refused else { panic!("{refused}") };
                assert_eq!(refusal.part, Part::Light(1), "{refused}");
                assert!(refused.to_string().contains("filter is pcss"), "{refused}");
            }
            let mut renderer = renderer(gl, "map:filter=pcss");
            let masks = soft_masks(gl, &shot, &mut renderer, &frame);
            let partial = |mask: &[u8]| mask.iter().filter(|&&m| m > 20 && m < 235).count();
            let hard = partial(&masks[0]);
            let soft = partial(&masks[1]);
            assert!(soft > 10 * hard && soft > 200, "{area:?}: {soft} pixels of penumbra, {hard} of edges");
        }
    });
}

#[test]
fn options_are_read_and_refused() {
    let written = "map:size=1024:filter=none:radius=0.5:constant-bias=0:slope-bias=0.5:normal-offset=2";
    let technique = Technique::parse(written).expect("right");
    assert_eq!(technique.to_string(), written, "as written");
    let Technique::Map(options) = technique else { panic!("another technique") };
    assert_eq!((options.size, options.filter, options.normal_offset), (1024, Filter::None, 2.0), "as read");
    for (text, says) in [
        ("map:size=8", "a number from 16 to 8192"),
        ("map:size=9000", "a number from 16 to 8192"),
        ("map:filter=vsm", "none or pcf or pcss"),
        ("map:radius=0", "a number from 0.5 to 8"),
        ("map:slope-bias=2", "a number from 0 to 1"),
        ("map:constant-bias=NaN", "a number from 0 to 1000"),
        ("map:bias=1", "the options are size, filter, radius"),
    ] {
        let error = Technique::parse(text).expect_err(text).to_string();
        assert!(error.contains(says), "{text}: {error}");
    }
    let mut options = Options::default();
    options.constant_bias = f32::INFINITY;
    let refusal = Technique::Map(options).refusal(&Default::default()).expect("set by a program");
    assert_eq!(refusal.part, Part::Options, "{refusal:?}");
}

/// The smallest and the largest settings draw, or say what is too large.
#[test]
fn extreme_options_work() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        for technique in ["map:size=16:radius=8", "map:size=16:filter=none", "map:radius=8:size=32"] {
            let mut renderer = renderer(gl, technique);
            for mask in shot.masks(&mut renderer, &shot.frame()) {
                let dark = mask.iter().filter(|&&m| m < 200).count();
                assert!(dark > 20 && dark < mask.len() / 2, "{technique}: {dark} pixels are dark");
            }
        }
        let mut renderer = renderer(gl, "map:size=8192");
        let limit = renderer.caps().max_texture_size;
        let sun = &world.lights[1..2];
        let drawn = each_batch(&mut renderer, &shot.frame().lights(sun), |_| {});
        assert_eq!(drawn.is_ok(), limit >= 8192, "{drawn:?}");
        gl.assert_no_complaint("large maps");
    });
}
