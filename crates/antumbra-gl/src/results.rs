//! What a renderer tells its host.

use crate::pairs::{BATCH_LIGHTS, GROUP_LIGHTS};

/// What the last frame did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Pairs of light and occluder.
    pub pairs: usize,
    /// Polygons drawn for them; pairs out of sight draw none.
    pub polygons: usize,
    /// Batches of lights.
    pub batches: usize,
}

/// The visibility of up to [`BATCH_LIGHTS`] lights, for the host's own lighting.
#[derive(Clone, Copy, Debug)]
pub struct MaskBatch {
    /// Index in [`crate::Frame::lights`] of the first light.
    pub first_light: usize,
    /// How many lights.
    pub lights: usize,
    /// `RGBA8` textures (`RGBA16F` in frames with area lights, where the driver draws to it): light
    /// `first_light + i` is channel `i % 4` of texture `i / 4`. One texel a pixel of the viewport
    /// (`texelFetch` with window position minus the viewport's corner), 1 where the light arrives;
    /// multisampled if the surface is. They hold what *cast* shadows
    /// leave: where the surface faces away from the light, it is the host's n·l that is zero.
    pub textures: [glow::Texture; BATCH_LIGHTS / GROUP_LIGHTS],
}
