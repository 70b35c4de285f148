//! Flat shapes and the box as triangles: they are the true shapes, except for the disc's rim.

use core::f64::consts::TAU;

use glam::DVec3;

use super::solids::{segments_within, sized};
use super::{MeshError, TriangleMesh};

impl TriangleMesh {
    /// A flat disc in y = 0 that faces +Y: a fan from its centre to `segments` points of the rim
    /// (3 to 4096; others are taken as the nearest of these).
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn disc(radius: f64, segments: u32) -> Result<Self, MeshError> {
        sized(&[radius])?;
        let n = segments_within(segments);
        let mut positions = vec![DVec3::ZERO];
        positions.extend((0..n).map(|i| {
            let (s, c) = (TAU * (f64::from(i) / f64::from(n))).sin_cos();
            DVec3::new(radius * c, 0.0, -radius * s)
        }));
        Self::new(positions, (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect())
    }

    /// A flat rectangle in y = 0 that faces +Y, `width` along X and `depth` along Z: two triangles.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn rectangle(width: f64, depth: f64) -> Result<Self, MeshError> {
        sized(&[width, depth])?;
        let (x, z) = (0.5 * width, 0.5 * depth);
        let corner = |x, z| DVec3::new(x, 0.0, z);
        let positions = vec![corner(-x, z), corner(x, z), corner(x, -z), corner(-x, -z)];
        Self::new(positions, vec![[0, 1, 2], [0, 2, 3]])
    }

    /// One triangle, as given.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`].
    pub fn triangle(vertices: [DVec3; 3]) -> Result<Self, MeshError> {
        Self::new(vertices.to_vec(), vec![[0, 1, 2]])
    }

    /// A box with full sizes along X, Y and Z: twelve triangles.
    ///
    /// # Errors
    /// [`MeshError::BadSize`].
    pub fn cuboid(size: DVec3) -> Result<Self, MeshError> {
        sized(&size.to_array())?;
        let sign = |corner: u32, axis: u32| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 };
        let positions = (0..8).map(|c| size * DVec3::new(sign(c, 0), sign(c, 1), sign(c, 2))).collect();
        // Corners by bit (x 1, y 2, z 4), counter-clockwise seen from outside.
        let sides = [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]];
        Self::new(positions, sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
    }
}
