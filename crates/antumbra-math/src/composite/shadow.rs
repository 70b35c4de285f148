//! Shadows as discs and triangles.

use glam::{DVec2, DVec3};

use super::equations::{shade, shadow_apex_x, shadow_radius, shadow_x};
use super::frame::PaperFrame;
use super::refusal::{Refusal, heights, refusal, slack};
use crate::{Cone, Disc, Light, PlaneFrame, Shape, Sphere, Triangle};

/// A light counts as above what is lower by this fraction of its height: nearer, the shadow is more
/// than a billion times as large as the object.
const LEVEL: f64 = 1e-9;

/// A triangle of an area below this fraction of its longest side's square is a line.
const FLAT: f64 = 1e-12;

/// The circle whose shadow is drawn for a sphere's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SphereForm {
    /// The sphere's own radius about its own centre (2013). Always too small.
    Circle,
    /// The circle in which the light's rays touch the sphere (2017,
    /// `findCrossSectionCircleByTangents`): of radius r √(1 - r²/D²), r²/D nearer to the light than
    /// the centre, for a light at distance D. Exact with the light straight above.
    ///
    /// That circle faces the light, but the papers draw it by the equations of a circle parallel to
    /// the plane, and say that the shadow is one: so its centre and its radius enter them, its tilt
    /// does not. (With it, the shadow would be the exact ellipse.)
    #[default]
    Tangent,
}

/// A shape in coordinates of a plane, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartShape {
    /// A disc.
    Disc {
        /// Centre.
        center: DVec2,
        /// Radius, positive.
        radius: f64,
    },
    /// A triangle, its corners in either order.
    Triangle {
        /// Corners.
        vertices: [DVec2; 3],
    },
}

impl PartShape {
    /// Whether a point of the plane is inside; on the edge either way. False for a point that is not finite.
    pub fn contains(&self, point: DVec2) -> bool {
        match *self {
            Self::Disc { center, radius } => point.distance(center) < radius,
            Self::Triangle { vertices: [a, b, c] } => {
                let turn = (b - a).perp_dot(c - a).signum();
                [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| (q - p).perp_dot(point - p) * turn > 0.0)
            }
        }
    }

    /// The shape in space, where it lies in the plane.
    pub fn in_world(&self, frame: &PlaneFrame) -> Shape {
        match *self {
            Self::Disc { center, radius } => {
                Disc { center: frame.point(center), normal: frame.normal, radius }.into()
            }
            Self::Triangle { vertices } => Triangle { vertices: vertices.map(|p| frame.point(p)) }.into(),
        }
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Disc { center, radius } => center.is_finite() && radius.is_finite(),
            Self::Triangle { vertices } => vertices.iter().all(|p| p.is_finite()),
        }
    }

    /// Whether it has an inside.
    fn has_area(&self) -> bool {
        match *self {
            Self::Disc { radius, .. } => radius > 0.0,
            Self::Triangle { vertices: [a, b, c] } => {
                let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
                (b - a).perp_dot(c - a).abs() > FLAT * longest * longest
            }
        }
    }
}

/// A piece of a shadow, of one shade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Where it lies.
    pub shape: PartShape,
    /// k of Eq. (1): the grey that the papers paint is 255 k. From 0, black, to 1, white.
    pub shade: f64,
}

/// The shadow of one shape from one light: up to two parts that may overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompositeShadow {
    parts: [Option<Part>; 2],
}

impl CompositeShadow {
    /// The parts; none if there is no shadow.
    pub fn parts(&self) -> impl Iterator<Item = &Part> {
        self.parts.iter().flatten()
    }

    /// Whether there is no shadow.
    pub fn is_empty(&self) -> bool {
        self.parts().next().is_none()
    }

    /// Whether a point of the plane is in the shadow: in any of its parts.
    pub fn contains(&self, point: DVec2) -> bool {
        self.parts().any(|part| part.shape.contains(point))
    }

    /// The parts with an inside, if all numbers are finite.
    fn new(shapes: [Option<PartShape>; 2], shade: f64) -> Self {
        let part =
            |shape: PartShape| (shape.is_finite() && shape.has_area()).then_some(Part { shape, shade });
        Self { parts: shapes.map(|shape| shape.and_then(part)) }
    }
}

/// The shadow of `shape` from `light` on the plane of `frame`, in the frame's coordinates. The
/// [module](super) says what degenerate cases give.
///
/// # Errors
/// What [`refusal`] says, for any light.
pub fn cast(
    shape: &Shape,
    light: &Light,
    frame: &PlaneFrame,
    sphere_form: SphereForm,
) -> Result<CompositeShadow, Refusal> {
    if let Some(refusal) = refusal(shape, frame) {
        return Err(refusal);
    }
    let nothing = CompositeShadow::default();
    let (bound, size) = shape.bounding_sphere();
    if !shape.is_finite() || !has_extent(shape) {
        return Ok(nothing);
    }
    let center = match shape {
        Shape::Triangle(triangle) => 0.5 * (triangle.vertices[0] + triangle.vertices[1]),
        Shape::Cone(cone) => cone.base_center,
        _ => bound,
    };
    let Some(paper) = PaperFrame::new(frame, light, center) else { return Ok(nothing) };
    let (low, high) = heights(shape, frame);
    let top = if paper.side < 0.0 { -low } else { high };
    let is_below_light = paper.light.y - paper.light.w * top > LEVEL * paper.light.y * paper.light.w;
    if !(is_below_light && top > slack(frame, bound, size)) {
        return Ok(nothing);
    }
    let shapes = match shape {
        Shape::Disc(disc) => [circle(&paper, disc.radius), None],
        Shape::Sphere(sphere) => [ball(&paper, frame, light, sphere, sphere_form), None],
        Shape::Triangle(triangle) => [corners(frame, light, triangle), None],
        Shape::Cone(cone) => base_and_apex(&paper, cone, frame),
        Shape::Plane(_) | Shape::Rectangle(_) => [None, None],
    };
    let l = light.homogeneous();
    let shadow = frame.point(paper.on_plane(shadow_x(paper.light, paper.d), 0.0));
    let shade = if l.w == 0.0 { 1.0 } else { shade(center, l.truncate(), shadow) };
    Ok(CompositeShadow::new(shapes, shade))
}

/// Whether there is something to cast a shadow; a triangle's area is seen by its shadow's.
fn has_extent(shape: &Shape) -> bool {
    match shape {
        Shape::Disc(disc) => disc.radius > 0.0 && disc.normal != DVec3::ZERO,
        Shape::Sphere(sphere) => sphere.radius > 0.0,
        Shape::Cone(cone) => cone.radius > 0.0 && cone.height >= 0.0 && cone.axis != DVec3::ZERO,
        Shape::Triangle(_) => true,
        Shape::Plane(_) | Shape::Rectangle(_) => false,
    }
}

/// The shadow of a circle of radius `r`, parallel to the plane, about the frame's point.
fn circle(paper: &PaperFrame, r: f64) -> Option<PartShape> {
    let center = paper.on_plane(shadow_x(paper.light, paper.d), 0.0);
    Some(PartShape::Disc { center, radius: shadow_radius(paper.light, r, paper.d) })
}

fn ball(
    paper: &PaperFrame,
    frame: &PlaneFrame,
    light: &Light,
    sphere: &Sphere,
    form: SphereForm,
) -> Option<PartShape> {
    if form == SphereForm::Circle || paper.light.w == 0.0 {
        // Parallel rays touch the sphere in a great circle.
        return circle(paper, sphere.radius);
    }
    let to_light = light.vector_from(sphere.center);
    let distance = to_light.length();
    let sine = sphere.radius / distance;
    let center = sphere.center + to_light * (sine * sine);
    let radius = sphere.radius * ((1.0 - sine) * (1.0 + sine)).sqrt();
    circle(&PaperFrame::new(frame, light, center)?, radius)
}

/// Each corner by Eq. (2) in its own frame: its foot is the origin there.
fn corners(frame: &PlaneFrame, light: &Light, triangle: &Triangle) -> Option<PartShape> {
    let project = |corner: DVec3| {
        let paper = PaperFrame::new(frame, light, corner)?;
        Some(paper.on_plane(shadow_x(paper.light, paper.d), 0.0))
    };
    let [a, b, c] = triangle.vertices;
    Some(PartShape::Triangle { vertices: [project(a)?, project(b)?, project(c)?] })
}

fn base_and_apex(paper: &PaperFrame, cone: &Cone, frame: &PlaneFrame) -> [Option<PartShape>; 2] {
    let disc = circle(paper, cone.radius);
    let h = frame.normal.dot(cone.axis) * paper.side * cone.height;
    let x_s = shadow_x(paper.light, paper.d);
    let half_base = shadow_radius(paper.light, cone.radius, paper.d);
    let x_s3 = shadow_apex_x(paper.light, h, paper.d);
    if (x_s3 - x_s).abs() <= half_base {
        return [disc, None];
    }
    let vertices =
        [paper.on_plane(x_s, -half_base), paper.on_plane(x_s, half_base), paper.on_plane(x_s3, 0.0)];
    [disc, Some(PartShape::Triangle { vertices })]
}
