//! Curved solids as closed meshes. All are turned from a profile, and their vertices lie on the true
//! surface, so that they are inscribed: `n` segments leave a gap of at most r (1 - cos(π/n)) inside.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::{MeshError, TriangleMesh};

/// Above this there is no gap left that a picture could show, and a sphere has 16 million triangles.
const MAX_SEGMENTS: u32 = 4096;

/// A number of segments that makes a solid.
pub(super) fn segments_within(segments: u32) -> u32 {
    segments.clamp(3, MAX_SEGMENTS)
}

/// An error unless all are finite and above zero.
pub(super) fn sized(sizes: &[f64]) -> Result<(), MeshError> {
    let good = sizes.iter().all(|s| *s > 0.0 && s.is_finite());
    if good { Ok(()) } else { Err(MeshError::BadSize) }
}

/// `segments`, the number of points on a circle of the solid, is 3 to 4096 in all of these; other
/// numbers are taken as the nearest of these.
impl TriangleMesh {
    /// A ball, with half as many rings from pole to pole as segments around.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn sphere(radius: f64, segments: u32) -> Result<Self, MeshError> {
        sized(&[radius])?;
        Self::ellipsoid(DVec3::splat(radius), segments)
    }

    /// An ellipsoid with semi-axes along X, Y and Z: a ball, stretched.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn ellipsoid(radii: DVec3, segments: u32) -> Result<Self, MeshError> {
        sized(&radii.to_array())?;
        let n = segments_within(segments);
        let mut profile = Vec::new();
        arc(&mut profile, DVec2::ZERO, 1.0, (-FRAC_PI_2, FRAC_PI_2), n.div_ceil(2));
        revolve(&profile, n, radii)
    }

    /// A solid cone, apex at y = height/2, base at y = -height/2.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn cone(radius: f64, height: f64, segments: u32) -> Result<Self, MeshError> {
        Self::cylinder(radius, height, 0.0, segments)
    }

    /// A solid cylinder or frustum from y = -height/2, where it has `radius`, to y = height/2, where it
    /// has `radius_top`. One of the radii may be zero.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn cylinder(radius: f64, height: f64, radius_top: f64, segments: u32) -> Result<Self, MeshError> {
        sized(&[radius.max(radius_top), height])?;
        if !(radius >= 0.0 && radius_top >= 0.0) {
            return Err(MeshError::BadSize);
        }
        let y = 0.5 * height;
        let profile = [[0.0, -y], [radius, -y], [radius_top, y], [0.0, y]].map(DVec2::from);
        revolve(&profile, segments_within(segments), DVec3::ONE)
    }

    /// A cylinder of `height` with a half ball at each end. The height may be zero.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn capsule(radius: f64, height: f64, segments: u32) -> Result<Self, MeshError> {
        sized(&[radius])?;
        if !(height >= 0.0 && height.is_finite()) {
            return Err(MeshError::BadSize);
        }
        let n = segments_within(segments);
        let (end, rings) = (DVec2::new(0.0, 0.5 * height), n.div_ceil(4));
        let mut profile = Vec::new();
        arc(&mut profile, -end, radius, (-FRAC_PI_2, 0.0), rings);
        arc(&mut profile, end, radius, (0.0, FRAC_PI_2), rings);
        revolve(&profile, n, DVec3::ONE)
    }

    /// A torus around the Y axis: a tube of `minor_radius` whose middle is `major_radius`, at least as
    /// much, from the axis. The tube has as many points around as the ring.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn torus(major_radius: f64, minor_radius: f64, segments: u32) -> Result<Self, MeshError> {
        sized(&[major_radius, minor_radius])?;
        if minor_radius > major_radius {
            return Err(MeshError::BadSize);
        }
        let n = segments_within(segments);
        let mut profile = Vec::new();
        arc(&mut profile, DVec2::new(major_radius, 0.0), minor_radius, (-PI, PI), n);
        revolve(&profile, n, DVec3::ONE)
    }
}

/// Points of an arc (radius from the axis, height) from one angle to the other, in so many steps.
fn arc(profile: &mut Vec<DVec2>, center: DVec2, radius: f64, (from, to): (f64, f64), steps: u32) {
    for i in 0..=steps {
        let (s, c) = (from + (to - from) * (f64::from(i) / f64::from(steps))).sin_cos();
        // The cosine of a rounded right angle is 6e-17: a pole is one point.
        let c = if c.abs() < 1e-15 { 0.0 } else { c };
        // Likewise the sine of π, where a torus closes.
        let s = if s.abs() < 1e-15 { 0.0 } else { s };
        profile.push(center + radius * DVec2::new(c, s));
    }
}

/// Turns a profile, which runs upward outside, round the Y axis, and stretches what results.
fn revolve(profile: &[DVec2], segments: u32, stretch: DVec3) -> Result<TriangleMesh, MeshError> {
    let mut positions = Vec::with_capacity(profile.len() * segments as usize);
    for point in profile {
        for i in 0..segments {
            let (s, c) = (TAU * (f64::from(i) / f64::from(segments))).sin_cos();
            positions.push(stretch * DVec3::new(point.x * c, point.y, -point.x * s));
        }
    }
    let mut triangles = Vec::new();
    for (ring, ends) in (0..).zip(profile.windows(2)) {
        for i in 0..segments {
            let next = (i + 1) % segments;
            let [a, b] = [i, next].map(|i| ring * segments + i);
            let (c, d) = (b + segments, a + segments);
            // Where an end is on the axis, the quad is one triangle.
            if ends[0].x != 0.0 && ends[0] != ends[1] {
                triangles.push([a, b, c]);
            }
            if ends[1].x != 0.0 && ends[0] != ends[1] {
                triangles.push([a, c, d]);
            }
        }
    }
    TriangleMesh::new(positions, triangles)
}
