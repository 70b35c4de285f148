//! What is wrong with numbers.

/// What is wrong with a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LightFault {
    /// Its intensity.
    #[error("its intensity is negative or not finite")]
    Intensity,
    /// Its falloff.
    #[error("its falloff is negative, not finite, or divides by nothing at all")]
    Falloff,
    /// Its range.
    #[error("its range is not positive")]
    Range,
    /// Its area.
    #[error("its area has a size that is not positive, or a direction that is not of unit length")]
    Area,
    /// An area around a light that has no place.
    #[error("only a light at a point has an area around it")]
    AreaAround,
    /// A spot's angles.
    #[error("a spot's half-angles must be 0 <= inner <= outer <= π")]
    SpotAngles,
    /// The frame does not have it.
    #[error("the frame has no such light")]
    Missing,
}

/// What is wrong with a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameFault {
    /// The camera's matrices.
    #[error("the camera's matrices are not finite")]
    Camera,
    /// The view matrix.
    #[error("the view matrix is more than a rotation and a translation")]
    View,
    /// The projection matrix.
    #[error("the projection matrix cannot be inverted")]
    Projection,
    /// The projection's near plane.
    #[error("the projection matrix has its near plane behind the eye")]
    NearPlane,
    /// Which way depth runs.
    #[error(
        "the projection matrix makes depth run the other way than the surface says; see DepthFormat::reversed"
    )]
    DepthDirection,
    /// The viewport.
    #[error("the viewport is empty, negative or larger than the driver's textures")]
    Viewport,
    /// The rectangle that the overlay is confined to.
    #[error("the clip rectangle has a negative size")]
    Clip,
    /// The surface's samples.
    #[error("the surface has no samples; plain textures have 1")]
    Samples,
    /// An occluder's or a mesh's id.
    #[error("an occluder's id is not below NO_SHADOW")]
    Id,
    /// A mesh's matrix.
    #[error("a mesh's model matrix is not affine, not finite, or flat")]
    MeshModel,
    /// The ambient light.
    #[error("the ambient light is negative or not finite")]
    Ambient,
    /// The encoding of the host's pixels.
    #[error("the encoding's gamma is not positive")]
    Gamma,
}
