//! A light's shadow map, for programs that show it.

use crate::input::Texture;
use glam::DMat4;

/// What a light sees, as the shadows come from it: [`crate::Renderer::depth_map`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DepthMap {
    /// A `TEXTURE_2D` of `DEPTH_COMPONENT32F`, without filter and comparison: a `sampler2D` has what is kept in its red
    /// channel. Outside of [`Self::faces`] it holds nothing of this light.
    pub texture: Texture,
    /// Width and height of the texture, texels.
    pub size: [u32; 2],
    /// Width and height of a face, texels.
    pub side: u32,
    /// What distance a texel says; the same in all faces.
    pub scale: DepthScale,
    /// Distances, as [`DepthScale::distance`] tells them, between which the occluders are that the map shows: for shades
    /// of grey. Infinite planes go beyond; where there is nothing else, the far end is eight times as far as the near
    /// one.
    pub range: [f64; 2],
    /// Whether the faces are those of a cube round the light, with the axes of the world.
    pub cube: bool,
    /// Those with something in them. Of a cube in the order +X, -X, +Y, -Y, +Z, -Z; else the first alone.
    pub faces: [Option<MapFace>; 6],
}

/// A square of a [`DepthMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MapFace {
    /// The face's first texel: column and row, row 0 at the bottom as in every texture of OpenGL.
    pub corner: [u32; 2],
    /// World space to column, row (a texel's middle is at one half) and kept depth, each times w, and w: metres along the
    /// face's axis, or 1 for a directional light. A point with w not above 0 is behind the light. The inverse leads from
    /// a texel to the point that the light sees there.
    ///
    /// Columns to the right and rows upward show a mirror image of what somebody in the light's place would see.
    pub to_map: DMat4,
}

/// What depth a map keeps: larger is nearer to the light, 1 at the near end, and 0 where the light sees nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepthScale {
    /// Near distance over distance, along the face's axis from the light: there is no far end.
    Central {
        /// Metres, above 0.
        near: f64,
    },
    /// From 1 at `near` to 0 at `far`, along the way of a directional light from the world's origin, so that either may
    /// be below 0.
    Parallel {
        /// Metres.
        near: f64,
        /// Metres, more than `near`.
        far: f64,
    },
}

impl DepthScale {
    /// The distance that a kept depth says, metres along the face's axis; `None` for a depth that says nothing, such as
    /// 0.
    pub fn distance(&self, depth: f32) -> Option<f64> {
        let depth = f64::from(depth);
        if !(depth > 0.0 && depth <= 1.0) {
            return None;
        }
        Some(match self {
            Self::Central { near } => near / depth,
            Self::Parallel { near, far } => far - depth * (far - near),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_says_a_distance_or_nothing() {
        let central = DepthScale::Central { near: 0.01 };
        let parallel = DepthScale::Parallel { near: -3.0, far: 5.0 };
        assert_eq!(central.distance(1.0), Some(0.01), "the near end");
        assert!((central.distance(0.002).expect("a distance") - 5.0).abs() < 1e-6, "a five-hundredth of it");
        assert_eq!(parallel.distance(1.0), Some(-3.0), "the near end");
        assert_eq!(parallel.distance(0.25), Some(3.0), "a quarter of the way from the far end");
        for nothing in [0.0, -0.0, -1.0, 1.5, f32::NAN, f32::INFINITY] {
            assert_eq!((central.distance(nothing), parallel.distance(nothing)), (None, None), "{nothing}");
        }
    }
}
