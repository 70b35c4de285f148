//! Rays and what intersecting them yields.

use glam::DVec3;

/// The part of the line `origin + t * direction` with `min < t < max`.
///
/// The direction need not be a unit vector: a shadow ray from P to L has direction L - P and interval (0, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where t = 0 lies, metres.
    pub origin: DVec3,
    /// Change of position as t grows by 1. A zero or non-finite direction hits nothing.
    pub direction: DVec3,
    /// Lower end of the interval, excluded.
    pub min: f64,
    /// Upper end of the interval, excluded; may be infinite.
    pub max: f64,
}

impl Ray {
    /// Everything in front of `origin`.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, min: 0.0, max: f64::INFINITY }
    }

    /// The open segment between two points, t running from 0 to 1.
    pub fn segment(from: DVec3, to: DVec3) -> Self {
        Self { origin: from, direction: to - from, min: 0.0, max: 1.0 }
    }

    /// The point at t.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Whether t lies in the ray's open interval; false for NaN.
    pub fn contains(&self, t: f64) -> bool {
        self.min < t && t < self.max
    }

    /// The same line with its origin moved to the point nearest to the coordinates' origin, and by how much t
    /// shrank. Quadratics lose the digits they would spend on a far-away ray origin (Haines et al.,
    /// Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019).
    pub(crate) fn recentred(&self) -> (Self, f64) {
        let shift = -self.origin.dot(self.direction) / self.direction.length_squared();
        (Self { origin: self.at(shift), min: self.min - shift, max: self.max - shift, ..*self }, shift)
    }
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter.
    pub t: f64,
    /// Unit geometric normal: outwards for solids, +Y of the shape for flat ones, counter-clockwise for
    /// triangles. Never turned towards the ray.
    pub normal: DVec3,
}

/// The stretch of a line inside a convex solid, and which of the solid's faces bound it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chord {
    pub(crate) enter: f64,
    pub(crate) exit: f64,
    pub(crate) enter_face: Face,
    pub(crate) exit_face: Face,
}

/// The part of a convex solid's surface that ends a chord.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    /// The curved part.
    Curved,
    /// A flat part perpendicular to the axis of this index.
    Flat(u8),
}

impl Chord {
    /// The whole line.
    pub(crate) const ALL: Self = Self {
        enter: f64::NEG_INFINITY,
        exit: f64::INFINITY,
        enter_face: Face::Curved,
        exit_face: Face::Curved,
    };

    /// Keeps what lies between two parameters as well.
    pub(crate) fn clip(&mut self, enter: f64, exit: f64, face: Face) {
        if enter > self.enter {
            (self.enter, self.enter_face) = (enter, face);
        }
        if exit < self.exit {
            (self.exit, self.exit_face) = (exit, face);
        }
    }

    /// Keeps what lies within `half` of zero along the coordinate `axis`. Returns false where nothing does.
    pub(crate) fn clip_slab(&mut self, ray: &Ray, axis: usize, half: f64) -> bool {
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        if d == 0.0 {
            return o.abs() < half;
        }
        let (a, b) = ((-half - o) / d, (half - o) / d);
        self.clip(a.min(b), a.max(b), Face::Flat(axis as u8));
        self.enter < self.exit
    }

    /// The same chord of a line whose parameter is larger by `shift`.
    pub(crate) fn shifted(self, shift: f64) -> Self {
        Self { enter: self.enter + shift, exit: self.exit + shift, ..self }
    }
}

/// A convex solid: its chords say everything about it.
pub(crate) trait Convex {
    /// The stretch of the whole line inside the solid; `None` where the line misses or only touches it.
    fn chord(&self, ray: &Ray) -> Option<Chord>;

    /// Outward unit normal at a point of the surface, on the given face.
    fn normal(&self, point: DVec3, face: Face) -> DVec3;

    /// First crossing of the surface inside the ray's interval, from outside or from inside.
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        // Empty once more if the shift of a far-away origin has rounded its ends together.
        let chord = self.chord(ray).filter(|c| c.enter < c.exit)?;
        let (t, face) = if ray.contains(chord.enter) {
            (chord.enter, chord.enter_face)
        } else {
            (chord.exit, chord.exit_face)
        };
        ray.contains(t).then(|| Hit { t, normal: self.normal(ray.at(t), face) })
    }

    /// Whether any of the ray's interval lies inside the solid. Unlike `nearest`, true for an interval wholly
    /// inside: a point inside an opaque body gets no light.
    fn blocks(&self, ray: &Ray) -> bool {
        self.chord(ray).is_some_and(|c| c.enter < ray.max && c.exit > ray.min && c.enter < c.exit)
    }
}
