//! Moving the eye, and points of the picture in the world and back.

use antumbra::glam::{DMat4, DQuat, DVec2, DVec3};
use antumbra_scene::{Camera, Moment, limits};

/// How near the line of sight comes to straight up, radians.
const POLE: f64 = 0.01;

/// How close the eye comes to the target, metres.
const CLOSEST: f64 = 1e-3;

/// Turns the eye round the target: by angles in radians, `right` about the axis that points up in the picture, and
/// `up` towards that axis, never over it.
pub(crate) fn orbit(camera: &Camera, right: f64, up: f64) -> Camera {
    let pole = camera.up.try_normalize().unwrap_or(DVec3::Y);
    let arm = camera.eye - camera.target;
    let (across, ..) = camera.axes();
    let height = pole.angle_between(arm); // 0 above the target
    let up = up.clamp(height - (std::f64::consts::PI - POLE), height - POLE);
    let turned = DQuat::from_axis_angle(pole, -right) * (DQuat::from_axis_angle(across, -up) * arm);
    sane(camera, Camera { eye: camera.target + turned, ..*camera })
}

/// Moves eye and target across the picture by a part of its height at the target's distance.
pub(crate) fn pan(camera: &Camera, by: DVec2) -> Camera {
    let (right, up, _) = camera.axes();
    let height = 2.0 * (0.5 * camera.fov_y).tan() * camera.eye.distance(camera.target);
    let step = (right * by.x + up * by.y) * height;
    sane(camera, Camera { eye: camera.eye + step, target: camera.target + step, ..*camera })
}

/// Moves the eye towards the target: the distance is divided by `factor`.
pub(crate) fn zoom(camera: &Camera, factor: f64) -> Camera {
    let arm = camera.eye - camera.target;
    let length = arm.length();
    let wanted = (length / factor).clamp(CLOSEST, 0.5 * limits::MAX_COORDINATE);
    if !(wanted.is_finite() && length > 0.0) {
        return *camera;
    }
    sane(camera, Camera { eye: camera.target + arm * (wanted / length), ..*camera })
}

/// Moves the eye alone.
pub(crate) fn step(camera: &Camera, by: DVec3) -> Camera {
    sane(camera, Camera { eye: camera.eye + by, ..*camera })
}

/// Looks at everything finite in a scene from the side it is seen from.
pub(crate) fn frame(camera: &Camera, moment: &Moment, aspect: f64) -> Camera {
    let boxes = moment.primitives.iter().filter_map(antumbra_scene::Primitive::bounds);
    let Some((low, high)) = boxes.reduce(|(a, b), (low, high)| (a.min(low), b.max(high))) else {
        return *camera;
    };
    let radius = 0.5 * low.distance(high).max(CLOSEST);
    let half_angle = (0.5 * camera.fov_y).tan().min((0.5 * camera.fov_y).tan() * aspect).atan();
    let (_, _, forward) = camera.axes();
    let target = 0.5 * (low + high);
    sane(camera, Camera { eye: target - forward * (radius / half_angle.sin()), target, ..*camera })
}

/// The new camera, or the old one where the new one is none that a scene file could have.
pub(crate) fn sane(old: &Camera, new: Camera) -> Camera {
    let within = |p: DVec3| p.is_finite() && p.abs().max_element() <= limits::MAX_COORDINATE;
    let arm = new.target - new.eye;
    let looks =
        arm.length() >= CLOSEST && arm.normalize_or_zero().cross(new.up.normalize_or_zero()).length() > 1e-5;
    if within(new.eye) && within(new.target) && looks { new } else { *old }
}

/// A camera and the picture it makes: between points of the picture, pixels from its top left corner, and the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    camera: Camera,
    view: DMat4,
    size: DVec2,
}

impl Lens {
    /// The lens of a picture of this size, pixels (or points: whatever positions are in).
    pub(crate) fn new(camera: &Camera, size: DVec2) -> Self {
        Self { camera: *camera, view: camera.view(), size: size.max(DVec2::ONE) }
    }

    /// Pixels for a unit of length at a unit of distance.
    fn scale(&self) -> f64 {
        self.size.y / (2.0 * (0.5 * self.camera.fov_y).tan())
    }

    /// Where a point of the world is seen; `None` behind the eye.
    pub(crate) fn project(&self, point: DVec3) -> Option<DVec2> {
        let p = self.view.transform_point3(point);
        let seen = DVec2::new(p.x, -p.y) * (self.scale() / -p.z) + 0.5 * self.size;
        (p.z < -1e-9 && seen.is_finite()).then_some(seen)
    }

    /// The direction in which a point of the picture is seen, of unit length; from the camera's eye.
    pub(crate) fn direction(&self, at: DVec2) -> DVec3 {
        let (right, up, forward) = self.camera.axes();
        let offset = (at - 0.5 * self.size) / self.scale();
        (forward + right * offset.x - up * offset.y).normalize_or(forward)
    }

    /// Where the ray through a point of the picture meets a plane, if it does so before the eye and not so far away
    /// that a pixel is nothing any more.
    pub(crate) fn on_plane(&self, at: DVec2, point: DVec3, normal: DVec3) -> Option<DVec3> {
        let direction = self.direction(at);
        let slope = normal.dot(direction);
        let distance = normal.dot(point - self.camera.eye) / slope;
        let reach = 100.0 * self.camera.eye.distance(point).max(self.camera.eye.distance(self.camera.target));
        (slope.abs() > 1e-6 && distance > 0.0 && distance < reach)
            .then(|| self.camera.eye + direction * distance)
    }

    /// The camera.
    pub(crate) fn camera(&self) -> &Camera {
        &self.camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera { eye: DVec3::new(3.0, 4.0, 5.0), target: DVec3::new(0.0, 1.0, 0.0), up: DVec3::Y, fov_y: 0.8 }
    }

    #[test]
    fn orbits_keep_the_distance() {
        let c = camera();
        let length = |c: &Camera| c.eye.distance(c.target);
        for (right, up) in [(0.3, 0.0), (0.0, 0.4), (-2.0, -0.7), (0.0, 100.0), (0.0, -100.0), (1e3, 1e3)] {
            let turned = orbit(&c, right, up);
            assert!((length(&turned) - length(&c)).abs() < 1e-9, "{right}, {up}: {turned:?}");
            let (_, _, forward) = turned.axes();
            assert!(forward.dot(DVec3::Y).abs() < 1.0 - 1e-6, "it stays off the pole: {forward}");
        }
        assert!(orbit(&c, 0.0, 0.1).eye.y > c.eye.y, "up is up");
        let (right, ..) = c.axes();
        assert!(
            (orbit(&c, 0.1, 0.0).eye - c.eye).dot(right) < 0.0,
            "the scene turns to the right with the hand"
        );
    }

    #[test]
    fn zoom_and_pan() {
        let c = camera();
        let near = zoom(&c, 2.0);
        assert!((near.eye.distance(c.target) * 2.0 - c.eye.distance(c.target)).abs() < 1e-12, "half as far");
        for factor in [0.0, f64::INFINITY, f64::NAN, -1.0] {
            let zoomed = zoom(&c, factor);
            assert!(zoomed.eye.is_finite() && zoomed.eye != zoomed.target, "{factor}: {zoomed:?}");
        }
        let lens = Lens::new(&c, DVec2::new(800.0, 600.0));
        let before = lens.project(c.target).expect("seen");
        let after = Lens::new(&pan(&c, DVec2::new(0.1, 0.2)), DVec2::new(800.0, 600.0))
            .project(c.target)
            .expect("seen");
        assert!((after - before - DVec2::new(-60.0, 120.0)).length() < 1e-6, "{before} to {after}");
    }

    #[test]
    fn no_camera_that_sees_nothing() {
        let c = camera();
        let above = step(&c, c.target - c.eye + DVec3::Y * 2.0);
        assert_eq!(above, c, "straight above the target there is no up");
        assert_eq!(step(&c, c.target - c.eye), c, "in the target there is no direction");
        assert_eq!(step(&c, DVec3::splat(1e9)), c, "and nothing lies so far away");
    }

    #[test]
    fn projection_and_rays_agree() {
        let lens = Lens::new(&camera(), DVec2::new(640.0, 360.0));
        for point in [DVec3::ZERO, DVec3::new(1.0, 2.0, -3.0), DVec3::new(-2.0, 0.1, 1.0)] {
            let at = lens.project(point).expect("in front");
            let back = lens.on_plane(at, point, DVec3::Y).expect("not edge-on");
            assert!(back.distance(point) < 1e-9, "{point} came back as {back}");
        }
        assert_eq!(lens.project(DVec3::new(6.0, 8.0, 10.0)), None, "behind the eye");
        assert_eq!(lens.on_plane(DVec2::ZERO, DVec3::Y * 100.0, DVec3::Y), None, "above the view");
    }

    #[test]
    fn everything_in_view() {
        let text = "[camera]\neye = [0, 3, 60]\n[[object]]\nname = \"a\"\nshape = { type = \"sphere\", radius = 2 }\ntranslation = [5, 5, 5]";
        let scene = antumbra_scene::Scene::parse(text, "test".as_ref()).expect("a scene");
        let framed = frame(&scene.camera, &scene.moment(0.0), 0.5);
        let lens = Lens::new(&framed, DVec2::new(300.0, 600.0));
        for offset in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z] {
            let at = lens.project(DVec3::splat(5.0) + offset * 2.0).expect("in front");
            assert!(
                at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::new(300.0, 600.0)).all(),
                "{at} is outside"
            );
        }
    }
}
