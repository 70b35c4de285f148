//! Axis-aligned boxes around the primitives of a moment.

use glam::{DMat3, DVec3};

use crate::{Primitive, Shape};

impl Primitive {
    /// The smallest axis-aligned box in world space that holds the primitive, as its lowest and
    /// highest corner; `None` for the infinite plane.
    ///
    /// Exact up to rounding, a few units in the last place of the corners' coordinates, for every
    /// shape. Flat shapes give flat boxes where they are parallel to the axes. A mesh without
    /// vertices gives the box of its origin alone.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let axes = DMat3::from_quat(self.pose.rotation);
        let center = self.pose.translation;
        let around = |middle: DVec3, half: DVec3| (middle - half, middle + half);
        // The half size of a disc across the unit axis `n`: along each coordinate the radius times the
        // sine of the angle between the two.
        let disc = |radius: f64| {
            let n = axes.y_axis;
            radius * (DVec3::ONE - n * n).max(DVec3::ZERO).map(f64::sqrt)
        };
        Some(match &self.shape {
            Shape::Plane => return None,
            Shape::Rectangle { width, depth } => {
                around(center, 0.5 * (*width * axes.x_axis.abs() + *depth * axes.z_axis.abs()))
            }
            Shape::Disc { radius } => around(center, disc(*radius)),
            Shape::Triangle { vertices } => hull(vertices.iter().map(|v| self.pose.point(*v)))?,
            Shape::Sphere { radius } => around(center, DVec3::splat(*radius)),
            Shape::Ellipsoid { radii } => {
                let scaled =
                    DMat3::from_cols(axes.x_axis * radii.x, axes.y_axis * radii.y, axes.z_axis * radii.z);
                let rows = scaled.transpose();
                around(center, DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()))
            }
            Shape::Cone { radius, height } => {
                let half = axes.y_axis * (0.5 * height);
                let (low, high) = around(center - half, disc(*radius));
                (low.min(center + half), high.max(center + half))
            }
            Shape::Cylinder { radius, height, radius_top } => {
                let half = axes.y_axis * (0.5 * height);
                union(around(center - half, disc(*radius)), around(center + half, disc(*radius_top)))
            }
            Shape::Capsule { radius, height } => {
                around(center, DVec3::splat(*radius) + axes.y_axis.abs() * (0.5 * height))
            }
            Shape::Box { size } => around(
                center,
                0.5 * (size.x * axes.x_axis.abs() + size.y * axes.y_axis.abs() + size.z * axes.z_axis.abs()),
            ),
            Shape::Torus { major_radius, minor_radius } => {
                around(center, disc(*major_radius) + DVec3::splat(*minor_radius))
            }
            Shape::Mesh(mesh) => {
                hull(mesh.positions.iter().map(|v| self.pose.point(*v))).unwrap_or((center, center))
            }
        })
    }
}

/// The box around two boxes.
fn union(a: (DVec3, DVec3), b: (DVec3, DVec3)) -> (DVec3, DVec3) {
    (a.0.min(b.0), a.1.max(b.1))
}

/// The box around points; `None` if there are none.
fn hull(points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    points.map(|p| (p, p)).reduce(union)
}
