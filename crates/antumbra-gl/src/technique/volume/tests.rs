//! The geometry of volumes, without OpenGL.

use super::boundary::{Boundary, Cap};
use super::eye::{is_clear, layers};
use super::polygon::{Eye, Front, front};
use crate::technique::casters::Caster;
use antumbra_math::{Sphere, TriangleMesh};
use glam::{DMat4, DVec3, DVec4};

/// Uniform in [-1, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 30) as f64 - 1.0
    }

    fn point(&mut self, center: DVec3, reach: f64) -> DVec3 {
        center + DVec3::new(self.next(), self.next(), self.next()) * reach
    }
}

const AHEAD: DVec3 = DVec3::new(0.0, 0.0, -5.0);

fn eyes() -> [Eye; 2] {
    [Eye::perspective(0.1, 2e-3), Eye::parallel(-0.1, 100.0, 5e-3)]
}

/// Where a sight through a polygon's plane meets it, as a factor or a distance on the way to `p`: below one or negative is in front.
fn meets_before(eye: &Eye, normal: DVec3, offset: f64, p: DVec3) -> bool {
    let here = normal.dot(p) - offset;
    let toward_eye = normal.dot(eye.place.truncate()) - offset * eye.place.w;
    here * toward_eye < 0.0
}

#[test]
fn a_polygon_is_in_front_of_what_its_plane_parts_from_the_eye() {
    let mut random = Random(1);
    for eye in eyes() {
        let mut both = [0; 2];
        for _ in 0..2000 {
            let corners = [0; 3].map(|_| random.point(AHEAD, 2.0));
            let Some(normal) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize()
            else {
                continue;
            };
            let Front::Of(plane) = front(&eye, &corners.map(|c| c.extend(1.0)), normal, corners[0]) else {
                panic!("{corners:?} is nothing special");
            };
            // A point seen through the triangle, before it or beyond.
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let along = 0.3 * random.next();
            let p = if eye.is_perspective() { middle * (1.0 + along) } else { middle - DVec3::Z * along };
            let expected = meets_before(&eye, normal, normal.dot(corners[0]), p);
            assert_eq!(plane.dot(p.extend(1.0)) > 0.0, expected, "{p} through {corners:?}");
            assert_eq!(expected, along > 0.0, "{p} is on the line of sight through {middle}");
            both[usize::from(expected)] += 1;
        }
        assert!(both[0] > 500 && both[1] > 500, "both happen: {both:?}");
    }
}

/// Edge-on, what decides is not the plane, which means nothing, but where in it the polygon is: all that is nearer
/// than every corner is before it, and all that is farther is behind.
#[test]
fn a_polygon_seen_edge_on_is_where_its_corners_are() {
    let mut random = Random(2);
    for eye in eyes() {
        for _ in 0..2000 {
            // In a plane through the eye, or beside it by less than the picture shows.
            let up = random.point(DVec3::ZERO, 1.0).with_z(0.0).normalize();
            let off = up * (1e-7 * random.next());
            let across = up.cross(DVec3::Z);
            let mut corner = || AHEAD + across * random.next() + DVec3::Z * random.next() + off;
            let corners = [corner(), corner(), corner()];
            let Some(normal) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize()
            else {
                continue;
            };
            let Front::Of(plane) = front(&eye, &corners.map(|c| c.extend(1.0)), normal, corners[0]) else {
                panic!("{corners:?} is in sight");
            };
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let sight = if eye.is_perspective() { middle.normalize() } else { DVec3::NEG_Z };
            for (p, expected) in [(middle + sight * 2.5, true), (middle - sight * 2.5, false)] {
                let p = p + up * (1e-6 * random.next());
                assert_eq!(plane.dot(p.extend(1.0)) > 0.0, expected, "{p} with {corners:?}");
            }
        }
    }
}

#[test]
fn an_eye_on_a_polygon_touches_it() {
    let [eye, _] = eyes();
    let around = [DVec3::new(-1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 0.0, -1.0)];
    let found = front(&eye, &around.map(|c| c.extend(1.0)), DVec3::Y, around[0]);
    assert!(matches!(found, Front::Touching(_)), "{found:?}");
    // A side that begins beyond and goes to infinity through the eye's back is edge-on, and elsewhere.
    let strip = [AHEAD.extend(1.0), (AHEAD + DVec3::X).extend(1.0), DVec3::NEG_Z.extend(0.0)];
    assert!(matches!(front(&eye, &strip, DVec3::Y, AHEAD), Front::Of(_)), "beyond");
}

#[test]
fn a_balls_boundary_is_where_rays_touch_it() {
    let mut random = Random(3);
    let mut boundary = Boundary::default();
    for _ in 0..200 {
        let ball = Sphere { center: random.point(AHEAD, 3.0), radius: 0.2 + 0.1 * random.next() };
        let light = random.point(DVec3::ZERO, 1.0).normalize() * (random.next() + 1.5);
        for light in [(ball.center + light).extend(1.0), light.extend(0.0)] {
            assert!(boundary.of_ball(&ball, light, 40.0), "the light is outside");
            let mut sum = DVec3::ZERO;
            for &[a, b] in &boundary.edges {
                assert!((a.distance(ball.center) - ball.radius).abs() < 1e-12, "{a} is on the ball");
                let to_light = light.truncate() - a * light.w;
                let cosine = to_light.normalize().dot((a - ball.center) / ball.radius);
                assert!(cosine.abs() < 1e-9, "{a} sees the light on its horizon: {cosine}");
                sum += b - a;
            }
            assert!(sum.length() < 1e-12, "it closes");
            let mut turned = true;
            boundary.caps(|[a, b, c]| {
                turned &= (b - a).cross(c - a).dot(light.truncate() - a * light.w) > 0.0;
            });
            assert!(turned, "caps look at the light");
        }
    }
    let ball = Sphere { center: AHEAD, radius: 1.0 };
    assert!(!boundary.of_ball(&ball, (AHEAD + DVec3::X * 0.5).extend(1.0), 40.0), "a light inside");
    assert!(!boundary.of_ball(&ball, DVec4::NAN, 40.0), "a light nowhere");
    // 1/8 of a pixel: as few as will do.
    for (pixels, corners) in [(1.0, 16), (40.0, 32), (200.0, 64), (1e6, 128), (f64::NAN, 128)] {
        boundary.of_ball(&ball, DVec3::Y.extend(0.0), pixels);
        assert_eq!(boundary.edges.len(), corners, "{pixels} pixels");
    }
}

/// The number of layers the eye is in is one in the shadow of a box and none elsewhere, whatever spans the near end,
/// and where the eye is clear of the volume it is none.
#[test]
fn layers_count_the_volumes_that_hold_the_eye() {
    let mut random = Random(4);
    let mesh = TriangleMesh::cuboid(DVec3::new(1.0, 1.4, 0.8)).expect("a box");
    let mut boundary = Boundary::default();
    let mut seen = [0; 2];
    for _ in 0..4000 {
        let pose =
            DMat4::from_translation(random.point(DVec3::ZERO, 2.0)) * DMat4::from_rotation_x(random.next());
        let mirror = DMat4::from_scale(DVec3::new(random.next().signum(), 1.0, 1.0));
        let to_view = pose * mirror;
        let to_box = to_view.inverse();
        let half = DVec3::new(0.5, 0.7, 0.4);
        let light = random.point(DVec3::ZERO, 4.0);
        if to_box.transform_point3(light).abs().cmple(half).all()
            || to_box.transform_point3(DVec3::ZERO).abs().cmple(half).all()
        {
            continue;
        }
        let sphere = mesh.bounding_sphere();
        let center = to_view.transform_point3(sphere.center);
        for eye in eyes() {
            for light in [light.extend(1.0), light.normalize().extend(0.0)] {
                // Between parallel sight and parallel light there is no way.
                if !eye.is_perspective() && light.w == 0.0 {
                    continue;
                }
                // The way from a to b, or from a along b.
                let (a, b) = if eye.is_perspective() { (eye.place, light) } else { (light, eye.place) };
                let from = to_box.transform_point3(a.truncate());
                let along = if b.w == 0.0 {
                    to_box.transform_vector3(b.truncate())
                } else {
                    to_box.transform_point3(b.truncate()) - from
                };
                let (near, far) = ((-half - from) / along, (half - from) / along);
                let enter = near.min(far).max_element();
                let leave = near.max(far).min_element();
                let blocked = enter < leave && leave > 0.0 && (b.w == 0.0 || enter < 1.0);
                for cap in [Cap::Faces, Cap::Inside] {
                    boundary.of_mesh(
                        &Caster { mesh: &mesh, model: DMat4::IDENTITY, id: 0 },
                        &to_view,
                        light,
                        cap,
                    );
                    let count = layers(&eye, light, &boundary);
                    assert_eq!(count, u32::from(blocked), "{eye:?}, light {light}, {to_view}, {cap:?}");
                }
                if is_clear(&eye, light, center, sphere.radius) {
                    assert!(!blocked, "{eye:?} is not clear of {to_view}, light {light}");
                }
                seen[usize::from(blocked)] += 1;
            }
        }
    }
    assert!(seen[0] > 100 && seen[1] > 100, "both happen: {seen:?}");
}
