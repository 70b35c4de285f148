//! The composite method: the shapes of `antumbra_math::composite` in pixels, painted or taking light.

use crate::context::{Gl, in_each_api};
use crate::shot::{Canvas, Shot, VIEWPORT, bare, texture};
use crate::world::World;
use antumbra_gl::technique::composite::{Options, Shade, SphereForm};
use antumbra_gl::{Encoding, Frame, Light, Occluder, Receiver, ReceiverShape, Renderer, Technique};
use antumbra_math::composite::{CompositeShadow, cast};
use antumbra_math::plane_shadow::PlaneFrame;
use antumbra_math::{Plane, Rectangle};
use glam::{DVec2, DVec3, DVec4, Vec3, Vec4Swizzles};

/// One of everything the papers have over a floor, between heights 0.4 and 2, and a ball so low that its
/// shadow and the cone's overlap.
pub(crate) const SCENE: &str = r#"
ambient = [0.05, 0.05, 0.05]
[camera]
eye = [0.5, 5.0, 7.0]
target = [0.0, 0.3, 0.0]
[[light]]
name = "one"
type = "point"
position = [2.0, 5.0, 1.0]
intensity = 60.0
[[light]]
name = "two"
type = "point"
position = [-3.0, 4.0, 1.5]
intensity = 60.0
[[light]]
name = "three"
type = "point"
position = [0.3, 6.0, -3.0]
intensity = 60.0
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "disc"
shape = { type = "disc", radius = 0.5 }
translation = [-1.6, 1.2, 0.4]
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.5 }
translation = [0.2, 1.4, -0.8]
[[object]]
name = "triangle"
shape = { type = "triangle", vertices = [[-0.5, 0.0, 0.0], [0.5, 0.1, 0.2], [0.0, 0.8, 0.1]] }
translation = [1.3, 0.5, 1.3]
[[object]]
name = "cone"
shape = { type = "cone", radius = 0.4, height = 1.0 }
translation = [1.0, 1.2, -0.3]
[[object]]
name = "spinning top"
shape = { type = "cone", radius = 0.3, height = 0.8 }
translation = [-0.5, 1.0, 1.0]
rotation = [1.0, 0.0, 0.0, 0.0]
"#;

const FLOOR: Plane = Plane { normal: DVec3::Y, offset: 0.0 };

pub(crate) fn floor(id: u32) -> [Receiver; 1] {
    [Receiver::new(ReceiverShape::Plane(FLOOR)).with_id(id)]
}

pub(crate) fn technique(shade: Shade, sphere: SphereForm) -> Technique {
    let mut options = Options::default();
    (options.shade, options.sphere) = (shade, sphere);
    Technique::Composite(options)
}

pub(crate) fn renderer(gl: &Gl, technique: Technique) -> Renderer {
    let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
    renderer.set_technique(technique).expect("composite");
    renderer
}

/// Where the sight through a point of the picture (pixels) meets the floor.
fn on_floor(shot: &Shot<'_>, x: f64, y: f64) -> DVec3 {
    let [_, _, width, height] = shot.viewport.map(f64::from);
    let inverse = (shot.camera.projection * shot.camera.view).inverse();
    let at = |z: f64| {
        let p = inverse * DVec4::new(2.0 * x / width - 1.0, 2.0 * y / height - 1.0, z, 1.0);
        p.xyz() / p.w
    };
    let (near, far) = (at(-1.0), at(0.5));
    near + (far - near) * (near.y / (near.y - far.y))
}

/// Points a side of the grid that measures a pixel.
const GRID: usize = 8;

/// What is seen of a value on the floor over one pixel.
pub(crate) struct Pixel<T> {
    /// At the points of a grid over the pixel; `None` where anything else than the floor is seen.
    pub(crate) values: Option<Vec<T>>,
    /// At points half a pixel apart, to a pixel around it.
    around: Vec<T>,
    /// Whether all these are one.
    pub(crate) sure: bool,
}

pub(crate) fn pixels<'a, T: PartialEq>(
    shot: &'a Shot<'_>,
    value: impl Fn(DVec3) -> T + 'a,
) -> impl Iterator<Item = Pixel<T>> + 'a {
    let width = shot.viewport[2] as usize;
    shot.seen.iter().enumerate().map(move |(i, seen)| {
        if !seen.is_some_and(|s| s.primitive == 0) {
            return Pixel { values: None, around: Vec::new(), sure: true };
        }
        let (x, y) = ((i % width) as f64, (i / width) as f64);
        let of = |k: usize| (k as f64 + 0.5) / GRID as f64;
        let values: Vec<T> =
            (0..GRID * GRID).map(|k| value(on_floor(shot, x + of(k % GRID), y + of(k / GRID)))).collect();
        let offset = |k: usize| k as f64 * 0.5 - 1.0;
        let at = (0..49).map(|k| (x + offset(k % 7), y + offset(k / 7)));
        let around: Vec<T> = at.map(|(x, y)| value(on_floor(shot, x, y))).collect();
        let sure = values.iter().chain(&around).all(|v| *v == values[0]);
        Pixel { values: Some(values), around, sure }
    })
}

pub(crate) fn floor_frame() -> PlaneFrame {
    PlaneFrame::of_plane(&FLOOR).expect("a plane")
}

/// Every occluder's shadow from a light.
pub(crate) fn shadows(world: &World, light: &Light, form: SphereForm) -> Vec<CompositeShadow> {
    let cast = |o: &Occluder| cast(&o.shape, &light.place, &floor_frame(), form).expect("the papers' pose");
    world.occluders.iter().map(cast).collect()
}

#[test]
fn masks_are_the_published_shapes() {
    in_each_api(|gl| {
        let mut world = World::parse(SCENE);
        // More than a batch, of all kinds.
        world.lights.push(Light::directional(DVec3::new(0.4, -1.0, 0.3), Vec3::ONE));
        world.lights.push(Light::spot(DVec3::new(1.0, 5.0, 2.0), -DVec3::Y, 0.4, 1.3, Vec3::ONE));
        for i in 0..5 {
            let angle = DVec2::from_angle(f64::from(i) * 1.3) * 4.0;
            world.lights.push(Light::point(DVec3::new(angle.x, 4.5, angle.y), Vec3::ONE));
        }
        let shot = Shot::new(gl, &world);
        for form in [SphereForm::Circle, SphereForm::Tangent] {
            let mut renderer = renderer(gl, technique(Shade::Physical, form));
            let receivers = floor(1);
            let frame = shot.frame().receivers(&receivers);
            let masks = shot.masks(&mut renderer, &frame);
            assert_eq!(renderer.stats().pairs, 5 * world.lights.len(), "pairs; the floor is no caster");
            let (mut dark, mut square, mut edges) = (0, 0.0, 0.0);
            for (light, mask) in world.lights.iter().zip(&masks) {
                let shadows = shadows(&world, light, form);
                let lit = |p: DVec3| !shadows.iter().any(|s| s.contains(floor_frame().coordinates(p)));
                for (pixel, &mask) in pixels(&shot, lit).zip(mask) {
                    let Some(values) = pixel.values else {
                        assert_eq!(mask, 255, "nothing falls on anything but the floor");
                        continue;
                    };
                    if pixel.sure {
                        // The grid misses tips of shadows of less than a hundredth of a pixel.
                        let off = if values[0] { 255 - mask } else { mask };
                        assert!(off <= 1, "{mask}, lit {}, by {light:?}", values[0]);
                        dark += usize::from(!values[0]);
                    } else {
                        let area = values.iter().filter(|v| **v).count() as f64 / values.len() as f64;
                        square += (area - f64::from(mask) / 255.0).powi(2);
                        edges += 1.0;
                    }
                }
            }
            let rms = f64::sqrt(square / edges);
            eprintln!("{form:?}: {dark} dark pixels, rms {rms:.4} on {edges} near edges");
            assert!(dark > 2000 && edges > 2000.0, "there are shadows to look at");
            // The grid's own 0.015, corners, and where parts meet the larger coverage for the union.
            assert!(rms < 0.03, "{rms} rms near edges");
        }
    });
}

/// Some host's picture: nowhere the grey of a shadow, and light enough that paint darkens it.
pub(crate) fn host_colors() -> Vec<[u8; 4]> {
    (0..(VIEWPORT[2] * VIEWPORT[3]) as u32)
        .map(|i| [250 + (i % 5) as u8, 255, 252, (i % 251) as u8])
        .collect()
}

/// Paints over that picture.
pub(crate) fn painted(
    gl: &Gl,
    renderer: &mut Renderer,
    frame: &Frame<'_>,
    encoding: Encoding,
) -> Vec<[u8; 4]> {
    let canvas = Canvas::new(gl);
    let rgba8 = [glow::RGBA8, glow::RGBA, glow::UNSIGNED_BYTE];
    let start = texture(&gl.gl, [VIEWPORT[2], VIEWPORT[3]], rgba8, &host_colors());
    use glow::HasContext;
    // SAFETY: the canvas' framebuffer is bound; a texture of its size takes its colour's place.
    unsafe {
        let slot = glow::COLOR_ATTACHMENT0;
        gl.gl.framebuffer_texture_2d(glow::FRAMEBUFFER, slot, glow::TEXTURE_2D, Some(start), 0);
        renderer.overlay(frame, encoding).expect("the frame is right");
        gl.assert_no_complaint("painting");
        let picture = crate::shot::read_texture(&gl.gl, start, [VIEWPORT[2], VIEWPORT[3]]);
        drop(canvas);
        gl.gl.delete_texture(start);
        picture
    }
}

/// What a later light paints covers an earlier one's; of one light the darkest part stays.
fn grey(shadows: &[Vec<CompositeShadow>], at: DVec2) -> Option<f64> {
    shadows.iter().rev().find_map(|of_light| {
        let parts = of_light.iter().flat_map(CompositeShadow::parts).filter(|part| part.shape.contains(at));
        parts.map(|part| part.shade).min_by(f64::total_cmp)
    })
}

#[test]
fn paint_is_exactly_255_k() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        let all: Vec<_> = world.lights.iter().map(|l| shadows(&world, l, SphereForm::Tangent)).collect();
        let mut renderer = renderer(gl, Technique::parse("composite").expect("the defaults"));
        for (encoding, decode) in [(Encoding::Gamma(2.2), false), (Encoding::Linear, true)] {
            let picture = painted(gl, &mut renderer, &frame, encoding);
            let of_floor = |p: DVec3| grey(&all, floor_frame().coordinates(p));
            let (mut dark, mut overlaps) = (0, 0);
            for ((i, pixel), was) in pixels(&shot, of_floor).enumerate().zip(host_colors()) {
                assert_eq!(picture[i][3], was[3], "alpha stays");
                let Some(values) = pixel.values else {
                    assert_eq!(picture[i], was, "what is not the floor is untouched");
                    continue;
                };
                let value = |k: f64| 255.0 * if decode { srgb_decoded(k) } else { k };
                for (channel, was) in picture[i].iter().zip(was).take(3) {
                    let [now, was] = [*channel, was].map(f64::from);
                    if !pixel.sure {
                        let greys = values.iter().chain(&pixel.around).flatten().map(|&k| value(k));
                        let darkest = greys.fold(was, f64::min);
                        assert!((darkest - 1.0..=was).contains(&now), "{now} of {was}, darkest {darkest}");
                        continue;
                    }
                    let expected = values[0].map_or(was, value);
                    // Rounding to 8 bits, and float32's before.
                    assert!((now - expected).abs() <= 0.502, "{now}, not {expected}");
                }
                if let (Some(k), true) = (values[0], pixel.sure) {
                    dark += 1;
                    let at = floor_frame().coordinates(shot.seen[i].expect("the floor").point);
                    let of_lights = all.iter().filter(|s| s.iter().any(|s| s.contains(at))).count();
                    let shades = all.iter().flatten().flat_map(CompositeShadow::parts);
                    let here = shades.filter(|part| part.shape.contains(at)).count();
                    overlaps += usize::from(here > of_lights || of_lights > 1);
                    assert!(k > 0.0 && k < 1.0, "{k}");
                }
            }
            assert!(dark > 1000 && overlaps > 100, "{dark} painted, {overlaps} by several parts");
        }
    });
}

/// The sRGB curve (IEC 61966-2-1).
pub(crate) fn srgb_decoded(k: f64) -> f64 {
    if k <= 0.04045 { k / 12.92 } else { ((k + 0.055) / 1.055).powf(2.4) }
}

/// Coincident lights, occluders twice, and either order: a union, not a darker one.
#[test]
fn nothing_darkens_twice() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let one = [world.lights[0]];
        let twice = [world.lights[0]; 2];
        let doubled = [world.occluders.clone(), world.occluders.clone()].concat();
        let reversed: Vec<Occluder> = world.occluders.iter().rev().copied().collect();
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers).lights(&one);
        let mut paper = renderer(gl, technique(Shade::Paper, SphereForm::Tangent));
        let mut physical = renderer(gl, technique(Shade::Physical, SphereForm::Tangent));
        let encoding = Encoding::Gamma(2.2);
        let picture = painted(gl, &mut paper, &frame, encoding);
        let masks = shot.masks(&mut physical, &frame);
        let whole = |masks: &[Vec<u8>], i: usize| masks[0][i] == 0 || masks[0][i] == 255;
        for (what, frame) in [
            ("coincident lights", frame.lights(&twice)),
            ("occluders twice", frame.occluders(&doubled)),
            ("the other order", frame.occluders(&reversed)),
        ] {
            let again = painted(gl, &mut paper, &frame, encoding);
            for i in 0..again.len() {
                if whole(&masks, i) {
                    assert_eq!(again[i], picture[i], "{what}: pixel {i}");
                }
            }
            assert_eq!(shot.masks(&mut physical, &frame)[0], masks[0], "{what}: masks");
        }
        let dark = masks[0].iter().filter(|m| **m == 0).count();
        assert!(dark > 300, "{dark} dark pixels");
    });
}

/// A rectangle in the floor receives: neither what lies beside it in its plane, nor what stands on it, is
/// touched; by ids and without them.
#[test]
fn shadows_stay_on_their_receiver() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let (half_right, half_forward) = (DVec3::X * 1.2, DVec3::Z * 0.9);
        let rectangle = Rectangle { center: DVec3::new(-0.4, 0.0, 0.2), half_right, half_forward };
        let inside = |p: DVec3| {
            let d = p - rectangle.center;
            d.x.abs() < 1.2 && d.z.abs() < 0.9
        };
        let receivers = [Receiver::new(ReceiverShape::Rectangle(rectangle)).with_id(1)];
        for form in
            [technique(Shade::Physical, SphereForm::Tangent), technique(Shade::Paper, SphereForm::Tangent)]
        {
            let mut renderer = renderer(gl, form);
            let frame = shot.frame().receivers(&receivers);
            let depth_only = bare(&frame.surface);
            let no_id = [receivers[0].with_id(0)];
            for (what, frame) in [
                ("ids", frame),
                ("a receiver without id", frame.receivers(&no_id)),
                ("depth alone", frame.surface(depth_only)),
            ] {
                let masks = shot.masks(&mut renderer, &frame);
                let picture = painted(gl, &mut renderer, &frame, Encoding::Gamma(2.2));
                let all: Vec<_> =
                    world.lights.iter().map(|l| shadows(&world, l, SphereForm::Tangent)).collect();
                let value = |p: DVec3| {
                    let at = floor_frame().coordinates(p);
                    let dark = |s: &Vec<CompositeShadow>| s.iter().any(|s| s.contains(at));
                    (inside(p), all.iter().map(dark).collect::<Vec<bool>>())
                };
                let (mut dark, mut outside) = (0, 0);
                for ((i, pixel), was) in pixels(&shot, value).enumerate().zip(host_colors()) {
                    if !pixel.sure {
                        continue;
                    }
                    let (is_inside, of_lights) =
                        pixel.values.map_or((false, vec![false; 3]), |mut values| values.swap_remove(0));
                    for (mask, is_dark) in masks.iter().zip(&of_lights) {
                        let expected = if is_inside && *is_dark { 0 } else { 255 };
                        assert_eq!(mask[i], expected, "{what}: pixel {i}");
                        dark += usize::from(expected == 0);
                        outside += usize::from(!is_inside && *is_dark);
                    }
                    if !is_inside {
                        assert_eq!(picture[i], was, "{what}: pixel {i} is not the receiver's");
                    }
                }
                assert!(dark > 150 && outside > 300, "{what}: {dark} dark, {outside} outside");
            }
        }
    });
}

/// Lights that sink, the underside of the floor, lights that are off: no shadow, and nothing breaks.
#[test]
fn what_has_no_shadow_paints_nothing() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, Technique::parse("composite").expect("the defaults"));
        let mut polygons = Vec::new();
        for height in [6.0, 3.0, 2.0, 1.5, 1.0, 0.4, 0.0, -1.0, f64::NAN] {
            let lights = [Light::point(DVec3::new(2.5, height, 1.0), Vec3::ONE)];
            let receivers = floor(1);
            let frame = shot.frame().lights(&lights).receivers(&receivers);
            let picture = painted(gl, &mut renderer, &frame, Encoding::Linear);
            polygons.push(renderer.stats().polygons);
            if height.is_nan() || height <= 0.4 {
                assert!(picture == host_colors(), "a light at {height} paints something");
            }
        }
        assert!(polygons.is_sorted_by(|a, b| a >= b), "one after the other is lost: {polygons:?}");
        assert!(polygons[0] >= 6 && polygons[6] == 0, "all, and none: {polygons:?}");
        let off = [Light::point(DVec3::new(2.0, 5.0, 1.0), Vec3::ZERO)];
        let receivers = floor(1);
        let frame = shot.frame().lights(&off).receivers(&receivers);
        assert!(painted(gl, &mut renderer, &frame, Encoding::Linear) == host_colors(), "a light that is off");
        // From below the floor is seen from the side that has no light.
        let text = SCENE.replace("eye = [0.5, 5.0, 7.0]", "eye = [0.5, -5.0, 7.0]");
        let below = World::parse(&text);
        let shot = Shot::new(gl, &below);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        assert!(painted(gl, &mut renderer, &frame, Encoding::Linear) == host_colors(), "the underside");
        assert!(
            shot.masks(&mut renderer, &frame).iter().flatten().all(|m| *m == 255),
            "the underside's masks"
        );
    });
}
