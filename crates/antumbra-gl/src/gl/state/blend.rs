//! How passes combine with what is there.

use super::{Blending, set_blending};
use crate::gl::Caps;

/// How a pass combines what it draws with what is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blend {
    /// The smaller of the two, channel by channel.
    Min,
    /// The sum.
    Add,
    /// The product of the colours; the target keeps its alpha.
    Multiply,
    /// The product, channel by channel.
    Product,
    /// What is drawn over what is there, by its alpha; the target keeps its own.
    Over,
    /// What is drawn.
    Replace,
    /// The larger of the two, channel by channel.
    Max,
    /// The sum of the colours, the larger alpha.
    AddAndCover,
}

impl Blend {
    /// Sets the blending of draw buffer 0.
    ///
    /// # Safety
    /// `caps` are the context's, and a [`super::StateGuard`] will put the host's blending back.
    pub(crate) unsafe fn apply(self, gl: &glow::Context, caps: Caps) {
        use glow::{FUNC_ADD, MAX, MIN, ONE, ONE_MINUS_SRC_ALPHA, SRC_ALPHA, SRC_COLOR, ZERO};
        let (function, equation) = match self {
            Self::Min => ([ONE, ONE, ONE, ONE], [MIN; 2]),
            Self::Add => ([ONE, ONE, ONE, ONE], [FUNC_ADD; 2]),
            Self::Product => ([ZERO, SRC_COLOR, ZERO, SRC_ALPHA], [FUNC_ADD; 2]),
            Self::Multiply => ([ZERO, SRC_COLOR, ZERO, ONE], [FUNC_ADD; 2]),
            Self::Max => ([ONE, ONE, ONE, ONE], [MAX; 2]),
            Self::AddAndCover => ([ONE, ONE, ONE, ONE], [FUNC_ADD, MAX]),
            Self::Replace => ([ONE, ZERO, ONE, ZERO], [FUNC_ADD; 2]),
            Self::Over => ([SRC_ALPHA, ONE_MINUS_SRC_ALPHA, ZERO, ONE], [FUNC_ADD; 2]),
        };
        // SAFETY: the caller's.
        unsafe { set_blending(gl, caps, Blending { on: true, function, equation }) }
    }
}
