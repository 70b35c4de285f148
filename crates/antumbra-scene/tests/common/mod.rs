//! What the tests of scene files share.

use glam::DVec3;

use antumbra_scene::{LightKind, Scene, Shape, limits};

/// A scene with every table, every light, every shape but the mesh, parts and both motions.
pub(crate) const EVERYTHING: &str = r#"
ambient = [0.05, 0.06, 0.07]

[camera]
eye = [0.0, 6.0, 12.0]
target = [0.0, 1.0, 0.0]
up = [0.0, 2.0, 0.0]
fov_y = 50.0

[image]
width = 320
height = 180
background = [0.02, 0.02, 0.03]
exposure = 1.5

[[light]]
name = "bulb"
type = "point"
position = [4.0, 8.0, 0.0]
intensity = 120
motion = { type = "orbit", center = [0, 8, 0], axis = [0, 1, 0], period = 8.0 }

[[light]]
name = "sun"
type = "directional"
direction = [1.0, -2.0, 0.5]
color = [1.0, 0.95, 0.9]
intensity = 3.0

[[light]]
name = "stage"
type = "spot"
position = [-4, 6, 1]
direction = [0.5, -1, 0]
intensity = 300.0
inner_angle = 15.0
outer_angle = 25.0
motion = { type = "path", points = [[-4, 6, 1], [-4, 6, 3], [-2, 6, 3]], period = 5.0 }

[[light]]
name = "lantern"
type = "sphere"
position = [0.0, 5.0, 5.0]
radius = 0.5
intensity = 40.0

[[light]]
name = "plate"
type = "disc"
position = [0.0, 5.0, -5.0]
direction = [0.0, -1.0, 1.0]
radius = 0.5
intensity = 40.0

[[light]]
name = "window"
type = "rectangle"
position = [-6.0, 4.0, 0.0]
direction = [1.0, -0.2, 0.0]
right = [0.0, 0.5, 1.0]
width = 2.0
height = 1.0
intensity = 40.0

[[object]]
name = "floor"
shape = { type = "plane" }
casts_shadow = false

[[object]]
name = "wall"
shape = { type = "rectangle", width = 8.0, depth = 4.0 }
translation = [0.0, 2.0, -4.0]
rotation = [0.7071, 0.0, 0.0, 0.7071]
color = [0.5, 0.6, 0.7]

[[object]]
name = "coin"
shape = { type = "disc", radius = 0.5 }
translation = [0.0, 1.5, 0.0]
receives_shadow = false

[[object]]
name = "sail"
shape = { type = "triangle", vertices = [[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [0.0, 1.0, 0.2]] }

[[object]]
name = "snowman"
translation = [2.0, 0.0, 0.0]
rotation = [0.0, 1.0, 0.0, 1.0]
motion = { type = "orbit", center = [0, 0, 0], axis = [0, -1, 0], period = -30 }
parts = [
  { shape = { type = "sphere", radius = 0.6 }, translation = [0.0, 0.6, 0.0] },
  { shape = { type = "ellipsoid", radii = [0.4, 0.5, 0.4] }, translation = [0.0, 1.6, 0.0] },
  { shape = { type = "cone", radius = 0.3, height = 0.6 }, translation = [0.0, 2.3, 0.0], rotation = [0, 0, 0.1, 1] },
  { shape = { type = "cylinder", radius = 0.3, height = 0.6, radius_top = 0.2 } },
  { shape = { type = "capsule", radius = 0.1, height = 0.6 } },
  { shape = { type = "box", size = [0.1, 0.2, 0.3] } },
  { shape = { type = "torus", major_radius = 0.5, minor_radius = 0.1 } },
]
"#;

/// Everything that a scene which was read promises to whoever draws it, at a time.
pub(crate) fn assert_sound(scene: &Scene, time: f64) {
    let unit = |v: DVec3| (v.length() - 1.0).abs() < 1e-12;
    let far = 8.0 * limits::MAX_COORDINATE;
    let near = |v: DVec3| v.is_finite() && v.abs().max_element() <= far;
    assert!((1..=limits::MAX_IMAGE_SIDE).contains(&scene.image.width), "{:?}", scene.image);
    assert!((1..=limits::MAX_IMAGE_SIDE).contains(&scene.image.height), "{:?}", scene.image);
    assert!(scene.image.exposure > 0.0 && scene.image.exposure.is_finite(), "{:?}", scene.image);
    let camera = &scene.camera;
    let (eye, direction) = camera.ray(0.0, 0.0, scene.image.width, scene.image.height);
    assert!(near(eye) && unit(direction), "{camera:?} sees along {direction}");
    let matrix = camera.projection(1.0, 0.1, 100.0) * camera.view();
    assert!(matrix.is_finite(), "{camera:?} has the matrix {matrix}");
    assert!(camera.up.cross(camera.target - camera.eye).length() > 0.0, "{camera:?} has no up");

    let moment = scene.moment(time);
    assert_eq!(moment.lights.len(), scene.lights.len(), "a moment has every light");
    for light in &moment.lights {
        assert!(near(light.position) && light.intensity >= 0.0 && light.intensity.is_finite(), "{light:?}");
        assert!(light.color.min_element() >= 0.0 && light.color.is_finite(), "{light:?}");
        assert!(!light.name.is_empty() && !light.name.contains(['/', '\\', '\0']), "{light:?}");
        match light.kind {
            LightKind::Point => {}
            LightKind::Directional { direction } => assert!(unit(direction), "{light:?}"),
            LightKind::Spot { direction, inner_angle, outer_angle } => {
                assert!(unit(direction) && 0.0 <= inner_angle && inner_angle < outer_angle, "{light:?}");
                assert!(outer_angle <= core::f64::consts::FRAC_PI_2, "{light:?}");
            }
            LightKind::Sphere { radius } => assert!(radius > 0.0 && radius.is_finite(), "{light:?}"),
            LightKind::Disc { direction, radius } => {
                assert!(unit(direction) && radius > 0.0 && radius.is_finite(), "{light:?}");
            }
            LightKind::Rectangle { direction, right, width, height } => {
                assert!(unit(direction) && unit(right) && direction.dot(right).abs() < 1e-9, "{light:?}");
                assert!(width > 0.0 && height > 0.0 && (width * height).is_finite(), "{light:?}");
            }
        }
    }
    let parts: usize = scene.objects.iter().map(|o| o.parts.len()).sum();
    assert_eq!(moment.primitives.len(), parts, "a moment has every part");
    for p in &moment.primitives {
        assert!(near(p.pose.translation) && p.pose.rotation.is_normalized(), "{p:?}");
        assert!(p.color.min_element() >= 0.0 && p.color.max_element() <= 1.0, "{p:?}");
        match p.bounds() {
            None => assert_eq!(p.shape, Shape::Plane, "only the plane has no bounds"),
            Some((low, high)) => {
                assert!(near(low) && near(high) && low.cmple(high).all(), "{p:?}: {low} {high}")
            }
        }
    }
}
