//! The composite method's soft shadows: lights as collections of point lights.

use crate::composite::{
    SCENE, floor, floor_frame, host_colors, painted, pixels, renderer, shadows, srgb_decoded, technique,
};
use crate::context::in_each_tier;
use crate::leaks::live;
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, assert_needs_floats, each_batch, read_texture};
use crate::snapshot::{assert_same, snapshot};
use crate::world::World;
use antumbra_gl::technique::composite::{Shade, SphereForm};
use antumbra_gl::{Area, Encoding, Light, Renderer, Technique};
use antumbra_gl::{Component, components};
use antumbra_math::Light as Place;
use glam::{DVec3, Vec3};

const BALL: Area = Area::Sphere { radius: 1.0 };

fn paper() -> Technique {
    technique(Shade::Paper, SphereForm::Tangent)
}

fn moved(light: &Light, offset: DVec3) -> Light {
    let Place::Point { position } = light.place else { panic!("a point light") };
    light.with_place(Place::Point { position: position + offset }).with_area(Area::None)
}

#[test]
fn components_are_the_centre_and_the_rim() {
    let of = |area: Area, count: u32| {
        let mut all = Vec::new();
        components(&area, count, |p| all.push(p));
        all
    };
    let row = of(BALL, 3);
    assert!(row[0] == DVec3::ZERO && row.len() == 3, "the central one first: {row:?}");
    assert!(row[1].abs_diff_eq(DVec3::X, 1e-12) && row[2].abs_diff_eq(-DVec3::X, 1e-12), "{row:?}");
    let (half_right, half_up) = (DVec3::X * 2.0, DVec3::Z);
    let rectangle = of(Area::Rectangle { direction: DVec3::NEG_Y, half_right, half_up }, 5);
    for (p, expected) in rectangle.iter().zip([DVec3::ZERO, half_right, half_up, -half_right, -half_up]) {
        assert!(p.abs_diff_eq(expected, 1e-12), "{rectangle:?}");
    }
    let direction = DVec3::new(0.6, -0.8, 0.0);
    for p in &of(Area::Disc { direction, radius: 2.0 }, 7)[1..] {
        assert!((p.length() - 2.0).abs() < 1e-9 && p.dot(direction).abs() < 1e-9, "{p} on the rim");
    }
    assert_eq!(of(BALL, 1), [DVec3::ZERO], "the centre alone");
    assert!(of(BALL, 0).is_empty() && of(Area::None, 3).is_empty(), "nothing of nothing");
}

/// A collection all in one place is a point light, bit by bit; and one nearly in one place is it to a step, where no
/// edges of parts cross: there the point light's shadow covers a pixel with one after the other.
#[test]
fn components_that_coincide_paint_the_hard_shadow() {
    in_each_tier(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let soft: Vec<Light> = world.lights.iter().map(|light| light.with_area(BALL)).collect();
        let at = |offset| -> Vec<Component> {
            (0..soft.len() * 2).map(|i| Component::new(i / 2, offset)).collect()
        };
        let mut renderer = renderer(gl, paper());
        let receivers = floor(1);
        let hard = shot.frame().receivers(&receivers);
        for encoding in [Encoding::Linear, Encoding::Gamma(2.2)] {
            let expected = painted(gl, &mut renderer, &hard, encoding);
            assert_ne!(expected, host_colors(), "there are shadows");
            let components = at(DVec3::ZERO);
            let frame = hard.lights(&soft).components(&components);
            assert_eq!(painted(gl, &mut renderer, &frame, encoding), expected, "{encoding:?}");
            let (hard, soft) = (&world.lights[..1], &soft[..1]);
            let one = frame.lights(hard).occluders(&world.occluders[1..2]);
            let expected = painted(gl, &mut renderer, &one, encoding);
            assert_ne!(expected, host_colors(), "the disc's shadow is seen");
            let components = at(DVec3::splat(1e-9));
            let frame = one.lights(soft).components(&components);
            if !gl.has_floats() {
                return assert_needs_floats(&mut renderer, &frame);
            }
            let nearly = painted(gl, &mut renderer, &frame, encoding);
            let worst =
                nearly.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(worst <= Some(1), "{encoding:?}: {worst:?}");
        }
    });
}

/// A disc of radius 1/2 at height 1 under a light at height 4, components at x = 0, 1, 1 and -1. Eqs. (1), (2): shadows
/// of radius 2/3 at x = 0, -1/3, -1/3 and 1/3. Eq. (3): k = 3/4 for each (distances 1 and 4, or √(10)/3 and 4 √(10)/3).
/// So the umbra is 3/4, the penumbra of one component 1 - 1/16, of two 1 - 2/16.
#[test]
fn shades_worked_by_hand() {
    in_each_tier(|gl| {
        let world = World::parse(
            "ambient = [0, 0, 0]\n[camera]\neye = [0, 2, 2]\ntarget = [0, 0, 0]\n\
             [[light]]\nname = \"light\"\ntype = \"point\"\nposition = [0, 4, 0]\nintensity = 1\n\
             [[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\n\
             [[object]]\nname = \"disc\"\nshape = { type = \"disc\", radius = 0.5 }\ntranslation = [0, 1, 0]\n",
        );
        let shot = Shot::new(gl, &world);
        let lights = [world.lights[0].with_area(BALL)];
        let sides = [1.0, 1.0, -1.0].map(|x| Component::new(0, DVec3::X * x));
        let receivers = floor(1);
        let frame = shot.frame().lights(&lights).components(&sides).receivers(&receivers);
        let mut renderer = renderer(gl, paper());
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &frame);
        }
        let sixteenths = |p: DVec3| {
            let inside = |x: f64| p.distance(DVec3::X * x) < 2.0 / 3.0;
            let penumbra = 2 * i32::from(inside(-1.0 / 3.0)) + i32::from(inside(1.0 / 3.0));
            if inside(0.0) { 4 } else { penumbra }
        };
        for (encoding, decode) in [(Encoding::Gamma(2.2), false), (Encoding::Linear, true)] {
            let picture = painted(gl, &mut renderer, &frame, encoding);
            let mut found = [0; 5];
            for ((i, pixel), was) in pixels(&shot, sixteenths).enumerate().zip(host_colors()) {
                let (Some(values), true) = (pixel.values, pixel.sure) else { continue };
                found[values[0] as usize] += 1;
                let k = 1.0 - f64::from(values[0]) / 16.0;
                let expected = 255.0 * if decode { srgb_decoded(k) } else { k };
                for channel in &picture[i][..3] {
                    let now = f64::from(*channel);
                    if values[0] == 0 {
                        assert_eq!(picture[i], was, "untouched");
                    } else {
                        // Rounding to 8 bits, and the half floats' before: 255 / 2048.
                        assert!((now - expected).abs() <= 0.5 + 0.13, "{now}, not {expected}");
                    }
                }
            }
            let [_, one, two, three, umbra] = found;
            assert!(one > 100 && two > 100 && umbra > 300 && three == 0, "each is seen: {found:?}");
        }
    });
}

/// Of any shapes and any number of components, more than go into one target.
#[test]
fn penumbrae_add_up_and_later_lights_cover_earlier_ones() {
    in_each_tier(|gl| {
        let mut world = World::parse(SCENE);
        world.lights[0].area = BALL;
        world.lights[2].area = Area::Disc { direction: DVec3::NEG_Y, radius: 1.2 };
        let shot = Shot::new(gl, &world);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        for count in [2, 3, 9] {
            let technique = Technique::parse(&format!("composite:components={count}")).expect("an option");
            let mut renderer = renderer(gl, technique);
            if !gl.has_floats() {
                assert_needs_floats(&mut renderer, &frame);
                continue;
            }
            let collections: Vec<Vec<_>> = (world.lights.iter())
                .map(|light| {
                    let mut lights = Vec::new();
                    components(&light.area, count, |offset| lights.push(moved(light, offset)));
                    let lights = if lights.is_empty() { vec![*light] } else { lights };
                    lights.iter().map(|light| shadows(&world, light, SphereForm::Tangent)).collect()
                })
                .collect();
            let shade = |p: DVec3| {
                let at = floor_frame().coordinates(p);
                collections.iter().rev().find_map(|collection| {
                    let dark = collection.iter().map(|of_occluders| {
                        let parts = of_occluders.iter().flat_map(|shadow| shadow.parts());
                        parts.filter(|p| p.shape.contains(at)).map(|p| 1.0 - p.shade).fold(0.0, f64::max)
                    });
                    let dark: Vec<f64> = dark.collect();
                    let all = dark.iter().sum::<f64>() / dark.len() as f64;
                    Some(1.0 - dark[0].max(all)).filter(|k| *k < 1.0)
                })
            };
            let picture = painted(gl, &mut renderer, &frame, Encoding::Gamma(2.2));
            let (mut painted, mut shades) = (0, std::collections::BTreeSet::new());
            for ((i, pixel), was) in pixels(&shot, shade).enumerate().zip(host_colors()) {
                let (Some(values), true) = (pixel.values, pixel.sure) else { continue };
                let Some(k) = values[0] else {
                    assert_eq!(picture[i], was, "lit");
                    continue;
                };
                painted += 1;
                shades.insert((k * 1e6) as u32);
                for channel in &picture[i][..3] {
                    let (now, expected) = (f64::from(*channel), 255.0 * k);
                    assert!(
                        (now - expected).abs() <= 0.5 + 0.13,
                        "{count}: {now}, not {expected}, pixel {i}"
                    );
                }
            }
            assert!(painted > 700 && shades.len() > 8, "{painted} pixels of {} shades", shades.len());
        }
    });
}

/// What is painted is no visibility: masks are the average over the components, by what each sends.
#[test]
fn masks_of_painted_lights_are_the_average_over_the_components() {
    in_each_tier(|gl| {
        let mut world = World::parse(SCENE);
        world.lights.truncate(1);
        world.lights[0].area = BALL;
        let shot = Shot::new(gl, &world);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        let mut renderer = renderer(gl, paper());
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &frame);
        }
        let mut mask: Vec<[f32; 4]> = Vec::new();
        let [_, _, width, height] = VIEWPORT;
        each_batch(&mut renderer, &frame, |batch| {
            mask = read_texture(&gl.gl, batch.textures[0].glow(), [width, height])
        })
        .expect("the frame is right");
        let light = &world.lights[0];
        let of_components: Vec<_> = [0.0, 1.0, -1.0]
            .map(|x| moved(light, DVec3::X * x))
            .map(|light| (light.place, shadows(&world, &light, SphereForm::Tangent)))
            .into();
        let hidden = |p: DVec3| -> Vec<bool> {
            let at = floor_frame().coordinates(p);
            of_components.iter().map(|(_, shadows)| shadows.iter().any(|s| s.contains(at))).collect()
        };
        let at = |place: Place| place.homogeneous().truncate().as_vec3();
        let mut partial = 0;
        for (i, pixel) in pixels(&shot, hidden).enumerate() {
            let (Some(values), true) = (pixel.values, pixel.sure) else { continue };
            let point = shot.seen[i].expect("the floor").point.as_vec3();
            // What a point sends to the floor: the cosine there over the squared distance.
            let weight = |place| {
                let to_point: Vec3 = at(place) - point;
                to_point.y / to_point.length().powi(3)
            };
            let weights: Vec<f32> = of_components.iter().map(|(place, _)| weight(*place)).collect();
            let taken: f32 =
                weights.iter().zip(&values[0]).filter(|(_, hidden)| **hidden).map(|(w, _)| w).sum();
            let expected = 1.0 - taken / weights.iter().sum::<f32>();
            // Half floats, and the grid misses tips of shadows of less than a hundredth of a pixel.
            assert!(
                (mask[i][0] - expected).abs() < 1.0 / 255.0 + 1e-3,
                "{} for {expected}, {:?}",
                mask[i][0],
                values[0]
            );
            partial += usize::from(expected > 0.1 && expected < 0.9);
        }
        assert!(partial > 40, "{partial} pixels in the penumbra");
    });
}

#[test]
fn painting_collections_leaves_the_state_and_allocates_nothing() {
    in_each_tier(|gl| {
        let mut world = World::parse(SCENE);
        world.lights[0].area = BALL;
        world.lights[2].area = BALL;
        let shot = Shot::new(gl, &world);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        let technique = Technique::parse("composite:components=6").expect("an option");
        let host = OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]);
        let before = snapshot(gl);
        let mut renderer = renderer(gl, technique);
        let float = gl.has_floats();
        for encoding in [Encoding::Linear, Encoding::Gamma(2.2)] {
            assert_eq!(renderer.overlay(&frame, encoding).is_ok(), float, "where there are float targets");
            gl.assert_no_complaint("painting a collection");
            assert_same(&before, &snapshot(gl), "painting a collection");
        }
        drop(renderer);
        host.calm_down(gl);
        let _canvas = Canvas::new(gl);
        let before = live(&gl.gl);
        let mut renderer: Renderer = crate::composite::renderer(gl, technique);
        if float {
            let draw = |renderer: &mut Renderer| {
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                each_batch(renderer, &frame, |_| ()).expect("the frame is right");
            };
            (0..4).for_each(|_| draw(&mut renderer));
            let steady = live(&gl.gl);
            let counted = allocation_counter::measure(|| (0..4).for_each(|_| draw(&mut renderer)));
            assert_eq!((live(&gl.gl), counted.count_total), (steady, 0), "objects, and allocations");
        }
        drop(renderer);
        assert_eq!(live(&gl.gl), before, "all are gone");
    });
}

/// Components that are nowhere, of lights that are not there, or of lights without area.
#[test]
fn odd_components_are_off() {
    in_each_tier(|gl| {
        let mut world = World::parse(SCENE);
        let hard = world.lights.clone();
        world.lights[0].area = BALL;
        let shot = Shot::new(gl, &world);
        // One shape and one light: no edges of parts cross.
        let receivers = floor(1);
        let frame =
            shot.frame().receivers(&receivers).occluders(&world.occluders[1..2]).lights(&world.lights[..1]);
        let mut renderer = renderer(gl, paper());
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &frame.components(&[Component::new(0, DVec3::X)]));
        }
        let encoding = Encoding::Gamma(2.2);
        let nowhere = |light| [DVec3::NAN, DVec3::INFINITY].map(|offset| Component::new(light, offset));
        let expected = painted(gl, &mut renderer, &frame.lights(&hard[..1]), encoding);
        // The central component is there, and its umbra is as dark as ever.
        let found = painted(gl, &mut renderer, &frame.components(&nowhere(0)), encoding);
        let worst = found.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst <= Some(1), "{worst:?}");
        let expected = painted(gl, &mut renderer, &frame, encoding);
        for light in [1, 3, usize::MAX] {
            let components = nowhere(light);
            let frame = frame.components(&components);
            assert_eq!(painted(gl, &mut renderer, &frame, encoding), expected, "of light {light}");
        }
        let mut buried = frame.lights.to_vec();
        buried[0] = moved(&buried[0], DVec3::NEG_Y * 50.0).with_area(BALL);
        painted(gl, &mut renderer, &frame.lights(&buried), encoding);
        gl.assert_no_complaint("odd components");
    });
}
