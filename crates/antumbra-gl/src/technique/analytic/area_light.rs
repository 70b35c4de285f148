//! Pairs of an area light and an occluder in the shaders' numbers.

use super::kind::{Emitter, SoftShape};
use crate::input::Area;
use antumbra_math::Shape;
use antumbra_math::blocking::Outline;
use antumbra_math::soft::{self, Standing};
use glam::{DMat4, DVec3, Vec4};

/// `ALL_OVER` of `soft.glsl`.
const ALL_OVER: f64 = 1e20;

/// A light with an area, view space.
#[derive(Clone, Copy, Debug)]
pub(super) struct AreaLight {
    center: DVec3,
    /// Radius of a ball that holds it.
    radius: f64,
    area: Area,
}

impl AreaLight {
    /// `None` for a light without an area.
    pub(super) fn new(area: Area, center: DVec3, to_view: &DMat4) -> Option<Self> {
        let turn = |v| to_view.transform_vector3(v);
        let (area, radius) = match area {
            Area::None => return None,
            Area::Sphere { radius } => (area, radius),
            Area::Disc { direction, radius } => (Area::Disc { direction: turn(direction), radius }, radius),
            Area::Rectangle { direction, half_right, half_up } => {
                let area = Area::Rectangle {
                    direction: turn(direction),
                    half_right: turn(half_right),
                    half_up: turn(half_up),
                };
                (area, half_right.length().hypot(half_up.length()))
            }
        };
        Some(Self { center, radius, area })
    }

    /// Whether it is a ball or flat.
    pub(super) fn emitter(&self) -> Emitter {
        match self.area {
            Area::None | Area::Sphere { .. } => Emitter::Ball,
            Area::Disc { .. } | Area::Rectangle { .. } => Emitter::Flat,
        }
    }

    /// Appends its texels.
    pub(super) fn pack(&self, texels: &mut Vec<Vec4>) {
        let texel = |v: DVec3, w: f64| v.as_vec3().extend(w as f32);
        match self.area {
            Area::None | Area::Sphere { .. } => texels.push(texel(self.center, self.radius)),
            Area::Disc { direction, radius } => {
                texels.extend([texel(self.center, radius), texel(direction, 1.0), Vec4::ZERO, Vec4::ZERO]);
            }
            Area::Rectangle { direction, half_right, half_up } => texels.extend([
                texel(self.center, 0.0),
                texel(direction, 0.0),
                texel(half_right, 0.0),
                texel(half_up, 0.0),
            ]),
        }
    }

    /// How a shape stands to it.
    pub(super) fn standing(&self, shape: &Shape) -> Standing {
        let center = self.center;
        let light = match self.area {
            Area::None => return Standing::Behind,
            Area::Sphere { radius } => soft::AreaLight::Sphere { center, radius },
            Area::Disc { direction, radius } => soft::AreaLight::Disc { center, direction, radius },
            Area::Rectangle { direction, half_right, half_up } => {
                soft::AreaLight::Rectangle { center, direction, half_right, half_up }
            }
        };
        Standing::new(&light, shape)
    }

    /// Appends the pair's texels as `soft.frag.glsl` reads them, and says what hides; `None` for shapes without extent,
    /// which hide nothing. With `alone` the shape's texels alone, as `union.frag.glsl` reads them.
    pub(super) fn pack_pair(
        &self,
        shape: &Shape,
        standing: Standing,
        texels: &mut Vec<Vec4>,
        alone: bool,
    ) -> Option<SoftShape> {
        let (_, extent) = shape.bounding_sphere();
        if !(extent > 0.0) {
            return None;
        }
        // What the shaders take for infinity: they have no other.
        let over = match standing {
            Standing::Over(over) => over.clamp(-ALL_OVER, ALL_OVER),
            _ => 0.0,
        };
        let circle = match standing {
            Standing::Circle { along, radius } => Vec4::new(along as f32, radius as f32, 1.0, 0.0),
            _ => Vec4::ZERO,
        };
        let just = Vec4::X * over as f32;
        let kind = SoftShape::of(shape)?;
        let first = texels.len();
        if !alone {
            self.pack(texels);
        }
        let texel = |v: DVec3, w: f64| v.as_vec3().extend(w as f32);
        match *shape {
            Shape::Sphere(s) => texels.extend([texel(s.center, s.radius), circle]),
            Shape::Disc(s) => texels.extend([texel(s.center, s.radius), texel(s.normal, over)]),
            Shape::Triangle(s) => {
                texels.extend(s.vertices.map(|v| texel(v, over)));
                if alone {
                    texels.push(texel(s.vertices[2].midpoint(s.vertices[0]), 0.0));
                }
            }
            Shape::Rectangle(s) => texels.extend(s.corners().map(|v| texel(v, over))),
            Shape::Cone(s) => texels.extend([texel(s.base_center, s.radius), texel(s.axis, s.height), just]),
            Shape::Plane(s) => texels.extend([texel(s.normal, s.offset), just]),
            _ => {} // not of a kind
        }
        if texels[first..].iter().any(|texel| !texel.is_finite()) {
            texels.truncate(first);
            return None;
        }
        Some(kind)
    }

    /// Whether the light is all on one side of a plane.
    pub(super) fn is_beside(&self, shape: &Shape) -> bool {
        !matches!(shape, Shape::Plane(plane) if plane.height(self.center).abs() <= self.radius)
    }

    /// Where the penumbra begins, and points that it is thrown from: the hull of that outline and of all rays away from
    /// those points holds every point that the shape hides any of the light from.
    ///
    /// Two balls apart have a common tangent cone with its apex between them: seen from there the occluder's shadow is
    /// the penumbra. Flat shapes with corners are thrown from the corners of the light's box.
    pub(super) fn outline(&self, shape: &Shape) -> (Outline, SoftOrigins) {
        match shape {
            Shape::Triangle(s) => {
                let [a, b, c] = s.vertices;
                (Outline::Corners { corners: [a, b, c, c], count: 3 }, self.corners())
            }
            Shape::Rectangle(s) => (Outline::Corners { corners: s.corners(), count: 4 }, self.corners()),
            Shape::Sphere(_) | Shape::Disc(_) | Shape::Cone(_) => {
                let (center, radius) = shape.bounding_sphere();
                let apart = center.distance(self.center);
                if !(apart > (self.radius + radius) * 1.001) {
                    return (Outline::Everywhere, SoftOrigins::default());
                }
                let apex = self.center.lerp(center, self.radius / (self.radius + radius));
                (Outline::Ball { center, radius }, SoftOrigins { points: [apex; 8], count: 1 })
            }
            _ => (Outline::Everywhere, SoftOrigins::default()),
        }
    }

    fn corners(&self) -> SoftOrigins {
        let mut points = [self.center; 8];
        for (i, point) in points.iter_mut().enumerate() {
            let side = |bit: usize| if i & bit == 0 { -self.radius } else { self.radius };
            *point += DVec3::new(side(1), side(2), side(4));
        }
        SoftOrigins { points, count: 8 }
    }
}

/// Points that penumbrae are thrown from.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SoftOrigins {
    points: [DVec3; 8],
    count: usize,
}

impl SoftOrigins {
    /// The points, homogeneous.
    pub(super) fn iter(&self) -> impl Iterator<Item = glam::DVec4> {
        self.points.into_iter().take(self.count).map(|p| p.extend(1.0))
    }
}
