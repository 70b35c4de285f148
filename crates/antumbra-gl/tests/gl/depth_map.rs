//! Maps handed out to be shown: what they keep, and what drawing them leaves behind.

use crate::context::{Gl, in_each_api, in_each_tier};
use crate::full_screen;
use crate::leaks::live;
use crate::map::renderer;
use crate::odd_host::OddHost;
use crate::shot::{Shot, VIEWPORT, assert_needs_floats, read_texture, texture};
use crate::snapshot::{assert_same, snapshot};
use crate::world::World;
use antumbra_gl::{Area, Error, Soft};
use antumbra_gl::{DepthMap, DepthScale, MapFace};
use glam::{DVec3, DVec4, Vec3, Vec4Swizzles};
use glow::HasContext;

/// A ball over a square floor that casts, and balls to the right and behind.
const BALLS: &str = r#"
[camera]
eye = [0.0, 4.0, 8.0]
[[light]]
name = "spot"
type = "spot"
position = [0.0, 5.0, 0.0]
direction = [0.0, -1.0, 0.0]
outer_angle = 30.0
intensity = 60.0
[[light]]
name = "sun"
type = "directional"
direction = [0.0, -1.0, 0.0]
intensity = 2.0
[[light]]
name = "lamp"
type = "point"
position = [0.0, 5.0, 0.0]
intensity = 60.0
[[object]]
name = "floor"
shape = { type = "rectangle", width = 6.0, depth = 6.0 }
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.5 }
translation = [0.0, 1.0, 0.0]
[[object]]
name = "to the right"
shape = { type = "sphere", radius = 0.5 }
translation = [8.0, 5.0, 0.0]
[[object]]
name = "behind"
shape = { type = "sphere", radius = 0.5 }
translation = [0.0, 5.0, -4.0]
"#;

/// What a map keeps, row by row from the bottom, read as a host's shader reads it.
fn read(gl: &Gl, map: &DepthMap) -> Vec<f32> {
    let fragment = "uniform highp sampler2D u_map; out vec4 color;
        void main() { color = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0); }";
    let size = map.size.map(|side| side as i32);
    let kept = texture(
        &gl.gl,
        size,
        [glow::RGBA32F, glow::RGBA, glow::FLOAT],
        &vec![[-1.0f32; 4]; (size[0] * size[1]) as usize],
    );
    // SAFETY: everything is made here, and deleted.
    unsafe {
        let gl = &gl.gl;
        let program = full_screen::program(gl, fragment);
        let framebuffer = full_screen::framebuffer(gl, kept);
        gl.use_program(Some(program));
        gl.active_texture(glow::TEXTURE0);
        gl.bind_texture(glow::TEXTURE_2D, Some(map.texture.glow()));
        full_screen::draw(gl, framebuffer, size);
        gl.bind_texture(glow::TEXTURE_2D, None);
        gl.use_program(None);
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        gl.delete_framebuffer(framebuffer);
        gl.delete_program(program);
        let texels: Vec<[f32; 4]> = read_texture(gl, kept, size);
        gl.delete_texture(kept);
        texels.into_iter().map(|texel| texel[0]).collect()
    }
}

/// The distance that is kept where a face shows a point.
fn distance_at(map: &DepthMap, face: &MapFace, kept: &[f32], point: DVec3) -> Option<f64> {
    let seen = face.to_map * point.extend(1.0);
    assert!(seen.w > 0.0, "{point} is in front of the light");
    let [column, row] = [seen.x, seen.y].map(|at| (at / seen.w).floor() as u32);
    for (at, corner) in [(column, face.corner[0]), (row, face.corner[1])] {
        assert!((corner..corner + map.side).contains(&at), "{point} is in the face: {column}, {row}");
    }
    map.scale.distance(kept[(row * map.size[0] + column) as usize])
}

#[test]
fn a_known_ball_is_at_its_distance() {
    in_each_api(|gl| {
        let world = World::parse(BALLS);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map:size=512");
        // The light's distance to the ball's top, to the floor; its distance scale begins at the origin for a sun.
        for (light, ball, floor) in [(0, 3.5, 5.0), (1, -1.5, 0.0), (2, 3.5, 5.0)] {
            let map = renderer.depth_map(&shot.frame(), light).expect("the frame is right").expect("a map");
            let kept = read(gl, &map);
            gl.assert_no_complaint("a map");
            assert_eq!(map.side, 512, "as large as the option says");
            assert_eq!(map.cube, light == 2, "a point light has six faces");
            assert_eq!(matches!(map.scale, DepthScale::Parallel { .. }), light == 1, "{:?}", map.scale);
            let down = if map.cube { 3 } else { 0 };
            let used: Vec<usize> = (0..6).filter(|&face| map.faces[face].is_some()).collect();
            let seen: &[usize] = if map.cube { &[0, 3, 5] } else { &[0] };
            assert!(
                seen.iter().all(|face| used.contains(face)),
                "light {light}: balls and floor are in {used:?}"
            );
            assert!(!used.contains(&2), "light {light}: nothing is above it");
            let face = map.faces[down].expect("in use");
            // Under the middle of the map. A texel is flat, and the ball is round: so far below its top.
            let found = distance_at(&map, &face, &kept, DVec3::Y * 1.5).expect("the ball");
            assert!((found - ball).abs() < 2e-3, "light {light}: the ball is {found} away, not {ball}");
            let found = distance_at(&map, &face, &kept, DVec3::ZERO).expect("the ball");
            assert!((found - ball).abs() < 2e-3, "light {light}: the ball hides the floor: {found}");
            for corner in [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z] {
                let found = distance_at(&map, &face, &kept, corner * 2.0).expect("the floor");
                assert!(
                    (found - floor).abs() < 1e-4,
                    "light {light}: the floor is {found} away, not {floor}"
                );
            }
            let [low, high] = map.range;
            assert!(low <= ball + 1e-3 && floor <= high + 1e-9, "light {light}: {:?} holds both", map.range);
            if light == 0 {
                assert!(ball - low < 0.01 && high - floor < 0.01, "the range is tight: {:?}", map.range);
            }
        }
    });
}

/// Against the ray tracer, for every kind of light: the point that a texel says is the first that the light meets there.
#[test]
fn every_texel_is_what_the_light_sees() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map:size=256");
        for light in 0..world.lights.len() {
            let map = renderer.depth_map(&shot.frame(), light).expect("the frame is right").expect("a map");
            let kept = read(gl, &map);
            let (mut right, mut empty, mut wrong) = (0, 0, 0);
            for face in map.faces.iter().flatten() {
                let back = face.to_map.inverse();
                let unproject = |x: f64, y: f64, depth: f64| {
                    let p = back * DVec4::new(x, y, depth, 1.0);
                    p.xyz() / p.w
                };
                for (x, y) in
                    (0..map.side).step_by(3).flat_map(|y| (0..map.side).step_by(3).map(move |x| (x, y)))
                {
                    let [column, row] = [face.corner[0] + x, face.corner[1] + y];
                    let depth = kept[(row * map.size[0] + column) as usize];
                    let middle = [column, row].map(|at| f64::from(at) + 0.5);
                    let from = unproject(middle[0], middle[1], 1.0);
                    let way = unproject(middle[0], middle[1], 0.5) - from;
                    // The host's floor is an infinite plane that hides its own shadow, so that it is left out.
                    let met = world.hit(from, way).and_then(|surface| match surface.primitive {
                        0 => world.hit(surface.point + way.normalize() * 1e-6, way),
                        _ => Some(surface),
                    });
                    match (met, map.scale.distance(depth)) {
                        (None, None) => empty += 1,
                        (Some(met), Some(_)) => {
                            let found = unproject(middle[0], middle[1], depth.into());
                            let off = found.distance(met.point);
                            *if off < 0.02 { &mut right } else { &mut wrong } += 1;
                        }
                        _ => wrong += 1,
                    }
                }
            }
            eprintln!("{:?} light {light}: {right} right, {empty} empty, {wrong} wrong", gl.kind);
            assert!(right > 200 && empty > 200, "light {light}: {right} right, {empty} empty");
            // Edges, where triangles are inside of round shapes by a quarter of a texel.
            assert!(wrong * 100 <= right, "light {light}: {wrong} texels are wrong, {right} right");
        }
    });
}

#[test]
fn showing_a_map_changes_nothing() {
    in_each_api(|gl| {
        let world = World::parse(BALLS);
        let shot = Shot::new(gl, &world);
        let frame = shot.frame();
        let objects = live(&gl.gl);
        let mut short_lived = renderer(gl, "map:size=64");
        short_lived.depth_map(&frame, 2).expect("the frame is right").expect("a map");
        drop(short_lived);
        assert_eq!(live(&gl.gl), objects, "all are gone with the renderer");
        let mut renderer = renderer(gl, "map:size=64");
        let masks = shot.masks(&mut renderer, &frame);
        let stats = renderer.stats();
        let host = OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]);
        let (before, made) = (snapshot(gl), live(&gl.gl));
        for light in [0, 1, 2, 0] {
            renderer.depth_map(&frame, light).expect("the frame is right").expect("a map");
            gl.assert_no_complaint("a map under odd settings");
            assert_same(&before, &snapshot(gl), "depth_map");
        }
        let missing = renderer.depth_map(&frame, 3).expect_err("three lights");
        assert!(matches!(missing, Error::BadLight { index: 3, .. }), "{missing}");
        assert_same(&before, &snapshot(gl), "a light that is not there");
        assert_eq!(live(&gl.gl), made, "nothing is made");
        assert_eq!(renderer.stats(), stats, "those of the frame before");
        drop(host.calm_down(gl));
        assert!(shot.masks(&mut renderer, &frame) == masks, "shadows are what they were");
    });
}

#[test]
fn lights_without_a_map_have_none() {
    in_each_tier(|gl| {
        let world = World::parse(BALLS);
        let shot = Shot::new(gl, &world);
        let frame = shot.frame();
        for technique in Shot::able(&frame) {
            let mut renderer = renderer(gl, &technique.to_string());
            let map = renderer.depth_map(&frame, 0).expect("the frame is right");
            assert_eq!(map.is_some(), technique.name() == "map", "{technique}");
            assert_eq!(map.is_some(), technique.has_maps(), "{technique} says so");
        }
        let mut renderer = renderer(gl, "map:size=64");
        let off = [world.lights[0].with_intensity(Vec3::ZERO)];
        assert_eq!(renderer.depth_map(&frame.lights(&off), 0), Ok(None), "it is off");
        let nothing = frame.occluders(&[]);
        assert_eq!(renderer.depth_map(&nothing, 0), Ok(None), "nothing casts");
        let area = [world.lights[2].with_area(Area::Sphere { radius: 0.5 })];
        let area = frame.lights(&area);
        assert!(matches!(renderer.depth_map(&area, 0), Err(Error::Refused { .. })), "as any frame is");
        renderer.set_soft(Soft::samples(4));
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &area);
        }
        let map = renderer.depth_map(&area, 0).expect("as points").expect("the first point's");
        let below = map.faces[3].expect("the face downward").to_map;
        let at = below.inverse() * DVec4::new(0.0, 0.0, 1.0, 0.0);
        let eye = at.xyz() / at.w;
        // The first of four points of a ball, by docs/theory/samples.md: at 3/4 of the height, and at the median of radii
        // that are dense as 1 / sqrt(1 - r²), the sine of the t with 2 t - sin 2 t = π/2.
        let median = 1.154_940_730_f64;
        assert!((2.0 * median - (2.0 * median).sin() - std::f64::consts::FRAC_PI_2).abs() < 1e-8);
        let first = DVec3::new((1.0 - 0.75f64 * 0.75).sqrt(), 0.75, 0.0) * (0.5 * median.sin());
        let expected = DVec3::Y * 5.0 + first;
        assert!(eye.distance(expected) < 1e-6, "the map is seen from {eye}, not {expected}");
    });
}
