//! How the host's pixels say what they show.

use super::FrameFault;

/// How the host's pixels encode radiance, for [`crate::Renderer::overlay`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Encoding {
    /// Pixels are linear: float targets, or sRGB targets with `GL_FRAMEBUFFER_SRGB`. Exact.
    Linear,
    /// The host wrote radiance^(1/gamma): 2.2 for most hosts that encode in their shader. Exact
    /// for a power curve, close for sRGB's.
    Gamma(f32),
}

impl Encoding {
    /// The exponent: 1 for linear pixels.
    pub(crate) fn gamma(self) -> f32 {
        match self {
            Self::Linear => 1.0,
            Self::Gamma(gamma) => gamma,
        }
    }

    /// Whether the numbers make sense.
    pub(crate) fn check(self) -> Result<(), FrameFault> {
        let gamma = self.gamma();
        let sane = gamma.is_finite() && gamma > 0.0;
        if sane { Ok(()) } else { Err(FrameFault::Gamma) }
    }
}
