//! Convex bodies by their support points, and the planes that touch a light and an occluder.
//!
//! All that a convex occluder hides any part of a convex light from is convex too: it is what lies on the occluder's
//! side of every plane between the two. So on a receiver the penumbra's outer edge is found by turning a plane about a line
//! of the receiver: for each direction of the receiver there is one plane across it that touches both, and the line
//! through the two touching points meets the receiver on the edge. For a light without area this is the hard shadow.

use std::f64::consts::FRAC_PI_2;

use antumbra::math::plane_shadow::Bounds;
use antumbra::math::{Light as Place, PlaneFrame};
use antumbra::{Area, Light};
use antumbra_scene::{Primitive, Shape};
use glam::{DMat3, DVec2, DVec3};

/// An occluder at least this near the light's height, as a fraction of that height, counts as reaching it.
const AS_HIGH: f64 = 1e-6;

/// Heights within this fraction of the coordinates are rounding: an occluder that stands on the receiver.
const RESTING: f64 = 1e-12;

/// A convex body.
#[derive(Clone, Debug)]
pub(super) enum Body {
    /// The hull of points.
    Points(Vec<DVec3>),
    /// The hull of balls: centre, radius.
    Balls(Vec<(DVec3, f64)>),
    /// The hull of discs about a common axis: centre, radius.
    Discs { axis: DVec3, discs: Vec<(DVec3, f64)> },
    /// What a matrix makes of the unit ball, moved.
    Ellipsoid { center: DVec3, axes: DMat3 },
}

/// Where light comes from.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// From infinitely far: the unit vector towards it.
    Direction(DVec3),
    Body(Body),
}

/// A ray on the edge of what an occluder hides from a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// `None` for a light infinitely far away.
    pub(super) on_light: Option<DVec3>,
    pub(super) on_body: DVec3,
    /// Where the ray meets the receiver, in its coordinates.
    pub(super) end: DVec2,
}

/// How an occluder stands between a light and a receiver.
pub(super) enum Standing {
    /// There is no light on the receiver, or the occluder is not before it.
    Apart,
    /// Light or occluder reach through the receiver, or the occluder as high as the light.
    Through,
    /// The edge, counterclockwise in the frame if seen from the light's side.
    Between(Vec<Touch>),
}

impl Body {
    /// `None` for the shapes that are not convex and for infinite planes.
    pub(super) fn of(primitive: &Primitive) -> Option<Self> {
        let pose = &primitive.pose;
        let center = pose.translation;
        let axis = pose.direction(DVec3::Y);
        let discs = |discs: &[(f64, f64)]| {
            let discs = discs.iter().map(|&(y, radius)| (center + axis * y, radius)).collect();
            Self::Discs { axis, discs }
        };
        let points =
            |points: &mut dyn Iterator<Item = DVec3>| Self::Points(points.map(|p| pose.point(p)).collect());
        let signs = [-0.5, 0.5];
        Some(match primitive.shape {
            Shape::Plane | Shape::Torus { .. } | Shape::Mesh(_) => return None,
            Shape::Rectangle { width, depth } => {
                points(&mut signs.iter().flat_map(|x| signs.map(|z| DVec3::new(x * width, 0.0, z * depth))))
            }
            Shape::Disc { radius } => discs(&[(0.0, radius)]),
            Shape::Triangle { vertices } => points(&mut vertices.into_iter()),
            Shape::Sphere { radius } => Self::Balls(vec![(center, radius)]),
            Shape::Ellipsoid { radii } => Self::Ellipsoid {
                center,
                axes: DMat3::from_quat(pose.rotation) * DMat3::from_diagonal(radii),
            },
            Shape::Cone { radius, height } => discs(&[(-0.5 * height, radius), (0.5 * height, 0.0)]),
            Shape::Cylinder { radius, height, radius_top } => {
                discs(&[(-0.5 * height, radius), (0.5 * height, radius_top)])
            }
            Shape::Capsule { radius, height } => {
                Self::Balls(signs.map(|y| (center + axis * (y * height), radius)).to_vec())
            }
            Shape::Box { size } => {
                points(&mut signs.iter().flat_map(|x| {
                    signs.iter().flat_map(move |y| signs.map(|z| DVec3::new(*x, *y, z) * size))
                }))
            }
        })
    }

    /// The point farthest along `n`, of any length.
    pub(super) fn support(&self, n: DVec3) -> DVec3 {
        let farthest = |points: &mut dyn Iterator<Item = DVec3>| {
            points.max_by(|a, b| n.dot(*a).total_cmp(&n.dot(*b))).unwrap_or(DVec3::NAN)
        };
        match self {
            Self::Points(points) => farthest(&mut points.iter().copied()),
            Self::Balls(balls) => {
                let n = n.normalize_or_zero();
                farthest(&mut balls.iter().map(|&(center, radius)| center + n * radius))
            }
            Self::Discs { axis, discs } => {
                let out = (n - *axis * n.dot(*axis)).normalize_or_zero();
                farthest(&mut discs.iter().map(|&(center, radius)| center + out * radius))
            }
            Self::Ellipsoid { center, axes } => *center + *axes * (axes.transpose() * n).normalize_or_zero(),
        }
    }

    /// The corners of a hull of points.
    pub(super) fn corners(&self) -> Option<&[DVec3]> {
        match self {
            Self::Points(points) => Some(points),
            _ => None,
        }
    }
}

impl Source {
    pub(super) fn of(light: &Light) -> Self {
        let position = match light.place {
            Place::Directional { direction } => return Self::Direction(-direction.normalize_or_zero()),
            Place::Point { position } | Place::Spot { position, .. } => position,
        };
        Self::Body(match light.area {
            Area::Sphere { radius } => Body::Balls(vec![(position, radius)]),
            Area::Disc { direction, radius } => {
                Body::Discs { axis: direction.normalize_or_zero(), discs: vec![(position, radius)] }
            }
            Area::Rectangle { half_right, half_up, .. } => Body::Points(
                [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .map(|(x, y)| position + half_right * x + half_up * y)
                    .to_vec(),
            ),
            _ => Body::Points(vec![position]),
        })
    }

    /// Heights over the frame's plane, lowest and highest; infinite for a direction.
    fn heights(&self, frame: &PlaneFrame) -> (f64, f64) {
        match self {
            Self::Direction(to_light) => {
                let cosine = frame.normal.dot(*to_light);
                let height = if cosine.abs() > RESTING { cosine * f64::INFINITY } else { f64::NAN };
                (height, height)
            }
            Self::Body(body) => {
                (frame.height(body.support(-frame.normal)), frame.height(body.support(frame.normal)))
            }
        }
    }

    /// The edge of what `body` hides any of the light from, on the frame's plane: a touching ray for each of `count`
    /// directions around. `Apart` too if all of it lies beside the bounds.
    pub(super) fn edge(&self, body: &Body, frame: &PlaneFrame, bounds: &Bounds, count: usize) -> Standing {
        let (low, high) = self.heights(frame);
        if low.is_nan() || high.is_nan() || (low <= 0.0 && high >= 0.0) {
            return if low < 0.0 && high > 0.0 { Standing::Through } else { Standing::Apart };
        }
        let side = low.signum();
        let up = frame.normal * side;
        let nearest = low.abs().min(high.abs());
        let (top, bottom) = (body.support(up), body.support(-up));
        let (most, least) = (frame.height(top) * side, frame.height(bottom) * side);
        let slack = RESTING * (top.length() + bottom.length() + frame.origin.length());
        if !(most > slack && least < low.abs().max(high.abs())) {
            return Standing::Apart;
        }
        if least < -slack || most >= nearest * (1.0 - AS_HIGH) {
            return Standing::Through;
        }
        // The ends in the directions of the axes are the edge's own bounds.
        let reach = |along: DVec3| self.touch(body, frame, up, along).map(|touch| touch.end);
        let extremes = [reach(-frame.u), reach(-frame.v), reach(frame.u), reach(frame.v)];
        if let [Some(left), Some(down), Some(right), Some(top)] = extremes
            && (right.x < bounds.min.x
                || left.x > bounds.max.x
                || top.y < bounds.min.y
                || down.y > bounds.max.y)
        {
            return Standing::Apart;
        }
        let touches = (0..count).filter_map(|index| {
            let (sin, cos) = (index as f64 * std::f64::consts::TAU / count as f64).sin_cos();
            self.touch(body, frame, up, frame.u * cos + frame.v * sin)
        });
        Standing::Between(touches.collect())
    }

    /// The ray on the plane that touches both and whose trace on the receiver runs across `along`.
    fn touch(&self, body: &Body, frame: &PlaneFrame, up: DVec3, along: DVec3) -> Option<Touch> {
        let normal = |angle: f64| along * angle.cos() + up * angle.sin();
        let light = match self {
            Self::Direction(to_light) => {
                let on_body = body.support(normal((-along.dot(*to_light)).atan2(up.dot(*to_light))));
                let t = up.dot(on_body - frame.origin) / up.dot(*to_light);
                let end = frame.coordinates(on_body - *to_light * t);
                return end.is_finite().then_some(Touch { on_light: None, on_body, end });
            }
            Self::Body(light) => light,
        };
        // How far the occluder reaches over the light's near end: below zero if the plane passes between.
        let overlap = |angle: f64| {
            let n = normal(angle);
            n.dot(body.support(n) - light.support(-n))
        };
        let (mut between, mut across) = (FRAC_PI_2, -FRAC_PI_2);
        for _ in 0..56 {
            let middle = 0.5 * (between + across);
            if overlap(middle) < 0.0 {
                between = middle;
            } else {
                across = middle;
            }
        }
        let n = normal(between);
        let (on_light, on_body) = (light.support(-n), body.support(n));
        let (h, k) = (up.dot(on_light - frame.origin), up.dot(on_body - frame.origin));
        let end = frame.coordinates(on_light + (on_body - on_light) * (h / (h - k)));
        (h > k && end.is_finite()).then_some(Touch { on_light: Some(on_light), on_body, end })
    }
}
