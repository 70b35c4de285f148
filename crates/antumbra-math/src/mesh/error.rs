use core::fmt;

/// Why triangles make no mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// There is no triangle.
    NoTriangles,
    /// More triangles than a third of 2^32.
    TooLarge,
    /// A vertex has a coordinate that is infinite or not a number.
    NotFinite {
        /// Its index.
        vertex: usize,
    },
    /// A triangle has a corner that is not among the vertices.
    NoSuchVertex {
        /// Its index.
        triangle: usize,
    },
    /// A size of a shape is not finite, or not above zero.
    BadSize,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTriangles => write!(f, "a mesh needs a triangle"),
            Self::TooLarge => write!(f, "a mesh can have at most 2^32 / 3 triangles"),
            Self::NotFinite { vertex } => write!(f, "vertex {vertex} is not finite"),
            Self::NoSuchVertex { triangle } => {
                write!(f, "triangle {triangle} has a corner that is not among the vertices")
            }
            Self::BadSize => write!(f, "the sizes of a shape must be finite and above zero"),
        }
    }
}

impl core::error::Error for MeshError {}
