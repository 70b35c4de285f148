//! What a renderer tells its host.

use super::{BATCH_LIGHTS, GROUP_LIGHTS};
use crate::input::Texture;

/// What the last frame did, and what it could leave undone. A point that stands for a light with an area counts as a
/// light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Pairs of light and occluder; with `projected`, of light, occluder and receiver.
    pub pairs: usize,
    /// Pairs of which anything is drawn. The others are culled: the light does not reach the occluder, or no shadow of
    /// the pair can be in sight; with `map`, the occluder is in no face of the light's map.
    pub drawn_pairs: usize,
    /// Polygons drawn for them: bounds of shadows with `analytic` and `composite`, triangles of shadows with `projected`,
    /// sides and caps with `volume`, occluders in each face of a map with `map`.
    pub polygons: usize,
    /// Batches of [`BATCH_LIGHTS`] lights; 1 where shadows are painted.
    pub batches: usize,
    /// Tiles of 16 by 16 pixels that a shadow of some light may reach. Only there is the screen looked at again.
    pub touched_tiles: usize,
    /// Tiles of the viewport; those at its right and upper border may be smaller.
    pub tiles: usize,
}

/// What a method counts from the beginning of a frame on; see [`Stats`].
#[derive(Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) pairs: usize,
    pub(crate) drawn: usize,
    pub(crate) polygons: usize,
}

/// The visibility of up to [`BATCH_LIGHTS`] lights, for the host's own lighting.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MaskBatch {
    /// Index in [`crate::Frame::lights`] of the first light.
    pub first_light: usize,
    /// How many lights.
    pub lights: usize,
    /// Samples a pixel: of more than one the textures are `TEXTURE_2D_MULTISAMPLE`, otherwise `TEXTURE_2D`.
    pub samples: u32,
    /// `RGBA8` textures (`RGBA16F` in frames with area lights, where the driver draws to it): light
    /// `first_light + i` is channel `i % 4` of texture `i / 4`. One texel a pixel of the viewport
    /// (`texelFetch` with window position minus the viewport's corner), 1 where the light arrives;
    /// multisampled if the surface is. They hold what *cast* shadows
    /// leave: where the surface faces away from the light it is the host's n·l that is zero, and the mask says what other
    /// objects hide; `map` does not look there, and leaves 1.
    pub textures: [Texture; BATCH_LIGHTS / GROUP_LIGHTS],
}
