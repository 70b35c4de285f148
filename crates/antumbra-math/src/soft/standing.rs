//! How an occluder stands to a light, whatever point looks: what is decided once for the pair, in float64.

use super::AreaLight;
use crate::{Cone, Shape};
use glam::DVec3;

/// What lies nearer to a light's plane than this, in sizes of the two, lies in it: what float32 leaves of positions that are
/// meant to.
const FLUSH: f64 = 2e-7;

/// How a shape stands to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// It hides nothing: behind a flat light or flush with it, or inside of a glowing ball.
    Behind,
    /// It holds the light, and hides all of it.
    Around,
    /// A flat shape, or a cone by its base: how far the light's centre is over its plane, along its normal (of corners, the
    /// one that they run around counter-clockwise). Infinite where all of the light is on one side.
    Over(f64),
    /// A ball that crosses the light: so far is the plane of the circle in which they meet before the ball's centre, as
    /// seen from the light's side ([`Self::toward`]), and so large is the circle.
    Circle {
        /// The distance of the plane, metres; negative beyond the ball's centre.
        along: f64,
        /// The circle's radius, metres.
        radius: f64,
    },
    /// A solid that does not meet the light.
    Apart,
}

impl Standing {
    /// How `shape` stands to `light`.
    pub fn new(light: &AreaLight, shape: &Shape) -> Self {
        let (_, extent) = shape.bounding_sphere();
        let extent = if extent.is_finite() { extent } else { 0.0 };
        let near = FLUSH * (light.radius() + extent);
        if light.direction().is_some_and(|direction| highest(shape, light.center(), direction) <= near) {
            return Self::Behind;
        }
        match *shape {
            Shape::Sphere(s) => ball(light, s.center, s.radius, near),
            Shape::Cone(s) if light.is_within(near, |point| cone_depth(&s, point)) => Self::Around,
            Shape::Cone(s) => over(light, s.axis, s.base_center, near),
            Shape::Disc(s) => over(light, s.normal, s.center, near),
            Shape::Plane(s) => over(light, s.normal, s.normal * s.offset, near),
            Shape::Triangle(s) => over_corners(light, s.vertices, near),
            Shape::Rectangle(s) => {
                let [a, b, c, _] = s.corners();
                over_corners(light, [a, b, c], near)
            }
        }
    }

    /// The unit vector from a light towards a ball that crosses it, along which [`Self::Circle`] measures: from a flat light
    /// to where it does not shine.
    pub fn toward(light: &AreaLight, center: DVec3) -> DVec3 {
        match light.direction() {
            Some(direction) => -direction,
            None => (center - light.center()).normalize_or(DVec3::Y),
        }
    }
}

impl AreaLight {
    /// Its centre.
    pub fn center(&self) -> DVec3 {
        match *self {
            Self::Sphere { center, .. } | Self::Disc { center, .. } | Self::Rectangle { center, .. } => {
                center
            }
        }
    }

    /// The radius of the least ball around its centre that holds it, metres.
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Sphere { radius, .. } | Self::Disc { radius, .. } => radius,
            Self::Rectangle { half_right, half_up, .. } => half_right.length().hypot(half_up.length()),
        }
    }

    /// Where a flat light shines to.
    fn direction(&self) -> Option<DVec3> {
        match *self {
            Self::Sphere { .. } => None,
            Self::Disc { direction, .. } | Self::Rectangle { direction, .. } => Some(direction),
        }
    }

    /// How far it reaches from its centre along a unit vector.
    fn support(&self, along: DVec3) -> f64 {
        match *self {
            Self::Sphere { radius, .. } => radius,
            Self::Disc { direction, radius, .. } => radius * direction.cross(along).length(),
            Self::Rectangle { half_right, half_up, .. } => {
                half_right.dot(along).abs() + half_up.dot(along).abs()
            }
        }
    }

    /// Whether it lies in a convex solid, given how deep a point lies in it, but for `near`. Of a disc 32 points of the rim
    /// are asked.
    fn is_within(&self, near: f64, depth: impl Fn(DVec3) -> f64) -> bool {
        match *self {
            Self::Sphere { center, radius } => depth(center) >= radius - near,
            Self::Disc { center, direction, radius } => {
                let (right, up) = direction.any_orthonormal_pair();
                (0..32).all(|i| {
                    let (sine, cosine) = (f64::from(i) * core::f64::consts::TAU / 32.0).sin_cos();
                    depth(center + (right * cosine + up * sine) * radius) >= -near
                })
            }
            Self::Rectangle { center, half_right, half_up, .. } => [-1.0, 1.0].into_iter().all(|x| {
                [-1.0, 1.0].into_iter().all(|y| depth(center + half_right * x + half_up * y) >= -near)
            }),
        }
    }
}

/// How far the highest point of a shape is over a plane through `origin`.
fn highest(shape: &Shape, origin: DVec3, up: DVec3) -> f64 {
    let height = |p: DVec3| (p - origin).dot(up);
    let ring = |center: DVec3, axis: DVec3, radius: f64| height(center) + radius * axis.cross(up).length();
    match *shape {
        Shape::Sphere(s) => height(s.center) + s.radius,
        Shape::Disc(s) => ring(s.center, s.normal, s.radius),
        Shape::Triangle(s) => s.vertices.into_iter().map(height).fold(f64::NEG_INFINITY, f64::max),
        Shape::Rectangle(s) => s.corners().into_iter().map(height).fold(f64::NEG_INFINITY, f64::max),
        Shape::Cone(s) => {
            ring(s.base_center, s.axis, s.radius).max(height(s.base_center + s.axis * s.height))
        }
        // Level to what float32 leaves of the two normals; any other plane is infinitely high somewhere.
        Shape::Plane(s) if s.normal.cross(up).length() <= FLUSH => height(s.normal * s.offset),
        Shape::Plane(_) => f64::INFINITY,
    }
}

/// How deep a point lies in a cone, metres; negative outside.
fn cone_depth(cone: &Cone, point: DVec3) -> f64 {
    let from = point - cone.base_center;
    let up = from.dot(cone.axis);
    let out = (from - cone.axis * up).length();
    let side = (cone.radius * (cone.height - up) - cone.height * out) / cone.radius.hypot(cone.height);
    side.min(up)
}

fn over_corners(light: &AreaLight, [a, b, c]: [DVec3; 3], near: f64) -> Standing {
    match (b - a).cross(c - a).try_normalize() {
        Some(normal) => over(light, normal, a, near),
        None => Standing::Behind, // no area
    }
}

fn over(light: &AreaLight, normal: DVec3, point: DVec3, near: f64) -> Standing {
    let height = (light.center() - point).dot(normal);
    let reach = light.support(normal) - near;
    Standing::Over(if height >= reach {
        f64::INFINITY
    } else if height <= -reach {
        f64::NEG_INFINITY
    } else {
        height
    })
}

fn ball(light: &AreaLight, center: DVec3, radius: f64, near: f64) -> Standing {
    if light.is_within(near, |point| radius - point.distance(center)) {
        return Standing::Around;
    }
    let along = match (light.direction(), *light) {
        (None, AreaLight::Sphere { radius: own, .. }) => {
            let apart = center.distance(light.center());
            if apart + radius <= own + near {
                return Standing::Behind;
            }
            if apart >= own + radius - near {
                return Standing::Apart;
            }
            apart - (apart * apart + own * own - radius * radius) / (2.0 * apart)
        }
        _ => Standing::toward(light, center).dot(center - light.center()),
    };
    if along.abs() < radius {
        Standing::Circle { along, radius: (radius * radius - along * along).sqrt() }
    } else {
        Standing::Apart
    }
}
