//! Where shadows are seen, against where the closed forms say they are.

use antumbra::glam::{DVec2, DVec3};
use antumbra::math::plane_shadow::Bounds;
use antumbra::math::{Light, Plane, PlaneFrame, PlaneShadow, ShadowKind, Shape, Sphere};

use crate::screen::Shot;
use crate::viewer::{Desk, Viewer};

/// A ball over a plane, one point light, nothing else.
pub(crate) const BALL: &str = r#"
ambient = [0.02, 0.02, 0.02]
[camera]
eye = [0.0, 6.0, 9.0]
target = [0.0, 0.0, 0.0]
fov_y = 45.0
[[light]]
name = "lamp"
type = "point"
position = [-1.0, 3.5, 0.5]
intensity = 30.0
[[object]]
name = "floor"
shape = { type = "plane" }
color = [0.8, 0.8, 0.8]
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.5 }
translation = [0.0, 1.2, 0.0]
color = [0.3, 0.3, 0.9]
"#;

const RADIUS: f64 = 0.5;

/// The shadow of the state's ball from the state's light, on the floor.
fn shadow(v: &Viewer<'_>) -> (PlaneFrame, PlaneShadow) {
    let plane = Plane { normal: DVec3::Y, offset: 0.0 };
    let frame = PlaneFrame::of_plane(&plane).expect("the floor");
    let ball = Shape::Sphere(Sphere { center: v.vector("/objects/1/position"), radius: RADIUS });
    let shadow = PlaneShadow::cast(&ball, &Light::Point { position: v.light(0) }, &frame);
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the light is above the ball");
    (frame, shadow)
}

/// Whether the ball hides a point of the floor from the eye, or nearly.
fn hidden(v: &Viewer<'_>, point: DVec3) -> bool {
    let (eye, center) = (v.vector("/camera/eye"), v.vector("/objects/1/position"));
    let along = (point - eye).normalize();
    (center - eye).cross(along).length() < 1.15 * RADIUS
}

/// Part of the shadow's size next to its edge that nothing is said of: some pixels.
pub(crate) const MARGIN: f64 = 0.07;

/// Points of the window that lie inside of the shadow, and outside of it but near.
pub(crate) fn probes(v: &Viewer<'_>, margin: f64) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let (frame, shadow) = shadow(v);
    let axes = shadow.axes().expect("an ellipse has axes");
    let outline = shadow.outline(64, &Bounds::EVERYTHING);
    let [left, top, w, h] = v.picture();
    let project = |factor: f64| -> Vec<[f64; 2]> {
        let around = outline.iter().map(|p| axes.center + (*p - axes.center) * factor);
        let seen = around.map(|p: DVec2| frame.point(p)).filter(|p| !hidden(v, *p)).map(|p| v.project(p));
        let inside = |[x, y]: &[f64; 2]| {
            *x > left + 2.0 && *x < left + w - 2.0 && *y > top + 2.0 && *y < top + h - 2.0
        };
        seen.filter(inside).collect()
    };
    let dark: Vec<_> = [0.2, 0.3, 0.6, 1.0 - margin].into_iter().flat_map(&project).collect();
    let lit: Vec<_> = [1.0 + margin, 1.4, 1.6].into_iter().flat_map(&project).collect();
    assert!(dark.len() > 20 && lit.len() > 20, "the shadow is in view: {} and {}", dark.len(), lit.len());
    (dark, lit)
}

/// The shadow is where the closed form says: what is inside is dark, and what is outside is not.
fn check(v: &Viewer<'_>, shot: &Shot, margin: f64) -> Result<(), String> {
    let (dark, lit) = probes(v, margin);
    let darkest = lit.iter().map(|p| shot.light(*p)).min().unwrap_or(0);
    let brightest = dark.iter().map(|p| shot.light(*p)).max().unwrap_or(u32::MAX);
    if brightest + 120 < darkest {
        Ok(())
    } else {
        Err(format!("dark up to {brightest}, lit from {darkest}"))
    }
}

/// Fails unless the shadow that is seen is the closed form's.
pub(crate) fn see(v: &mut Viewer<'_>) {
    see_about(v, MARGIN);
}

/// The same, with a margin next to the shadow's edge for techniques that do not have it exact.
pub(crate) fn see_about(v: &mut Viewer<'_>, margin: f64) {
    v.see("the shadow of the closed form", |v, shot| check(v, shot, margin));
}

#[test]
fn they_move_with_the_light_and_the_ball() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    v.without_marks();
    see(v);
    let (before, _) = probes(v, MARGIN);
    for key in ["N", "N", "N", "N", "N", "N", "N", "N", "V", ","] {
        v.press(key);
    }
    v.wait("the light moved", |state| state["lights"][0]["position"][2].as_f64() > Some(0.55));
    see(v);
    let moved = v.shot();
    let lit = before.iter().filter(|p| moved.light(**p) > 200).count();
    assert!(lit > 5, "where the shadow was there is light now: {lit} of {} points", before.len());
    // The camera moves, and the shadow is where the new camera sees it.
    for key in ["X", "X", "X", "Y", "Y"] {
        v.press(key);
    }
    v.wait("the camera moved", |state| state["camera"]["eye"][1].as_f64() > Some(6.15));
    see(v);
}
