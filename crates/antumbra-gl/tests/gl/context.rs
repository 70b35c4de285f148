//! Contexts, and what the driver says against a test's calls.

use crate::bare_gles;
use antumbra_host::{Api, TestContext};
use glow::HasContext;
use std::sync::Arc;

/// A context of one kind, with the driver's complaints collected.
pub(crate) struct Gl {
    pub(crate) kind: Kind,
    pub(crate) gl: Arc<glow::Context>,
    pub(crate) context: TestContext,
}

/// A kind of context.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Gl33,
    /// OpenGL ES with all that the driver has to offer.
    Gles,
    /// OpenGL ES 3.0 without any extension, which no driver here is: it is told so.
    BareGles,
    /// The same with render targets of 16-bit floats, which do not blend as 32-bit floats would.
    HalfGles,
}

/// Runs a test in OpenGL 3.3 and in OpenGL ES; afterwards the driver must have had nothing to
/// complain about. Where there is no OpenGL the test says so and is skipped; with
/// `ANTUMBRA_REQUIRE_GL` that is a failure.
pub(crate) fn in_each_api(test: impl Fn(&Gl)) {
    in_each([Kind::Gl33, Kind::Gles], test);
}

/// The same, and where there are no render targets of floats.
pub(crate) fn in_each_tier(test: impl Fn(&Gl)) {
    in_each([Kind::Gl33, Kind::Gles, Kind::BareGles], test);
}

pub(crate) fn in_each<const N: usize>(kinds: [Kind; N], test: impl Fn(&Gl)) {
    for kind in kinds {
        if let Some(gl) = Gl::new(kind) {
            test(&gl);
            gl.assert_no_complaint("the test's end");
        }
    }
}

impl Gl {
    fn new(kind: Kind) -> Option<Self> {
        let context = TestContext::new(if kind == Kind::Gl33 { Api::Gl33 } else { Api::Gles30 })?;
        let gl = match kind {
            Kind::BareGles => Arc::new(bare_gles::context(&context, false)),
            Kind::HalfGles => Arc::new(bare_gles::context(&context, true)),
            _ => context.gl().clone(),
        };
        if gl.supports_debug() {
            // SAFETY: switches of contexts with KHR_debug.
            unsafe {
                gl.enable(glow::DEBUG_OUTPUT);
                gl.enable(glow::DEBUG_OUTPUT_SYNCHRONOUS);
                let any = glow::DONT_CARE;
                gl.debug_message_control(any, any, any, &[], false);
                for kind in [glow::DEBUG_TYPE_ERROR, glow::DEBUG_TYPE_UNDEFINED_BEHAVIOR] {
                    gl.debug_message_control(any, kind, any, &[], true);
                }
            }
        }
        Some(Self { kind, gl, context })
    }

    pub(crate) fn is_desktop(&self) -> bool {
        self.kind == Kind::Gl33
    }

    /// The version, as (major, minor).
    pub(crate) fn version(&self) -> (u32, u32) {
        (self.gl.version().major, self.gl.version().minor)
    }

    /// Whether 32-bit floats can be drawn to, and blend.
    pub(crate) fn has_floats(&self) -> bool {
        matches!(self.kind, Kind::Gl33 | Kind::Gles)
    }

    /// Binds a framebuffer for drawing and reading.
    pub(crate) fn bind(&self, framebuffer: glow::Framebuffer) {
        // SAFETY: a framebuffer of this context.
        unsafe { self.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer)) };
    }

    /// Everything the driver has reported since the last time: error flags, and debug messages
    /// about errors and undefined behaviour.
    pub(crate) fn complaints(&self) -> Vec<String> {
        let mut complaints = Vec::new();
        // SAFETY: asks for flags and messages.
        unsafe {
            loop {
                match self.gl.get_error() {
                    glow::NO_ERROR => break,
                    error => complaints.push(format!("error 0x{error:x}")),
                }
            }
            while self.gl.supports_debug() {
                let messages = self.gl.get_debug_message_log(1);
                if messages.is_empty() {
                    break;
                }
                complaints.extend(messages.iter().map(|message| format!("{message:?}")));
            }
        }
        complaints
    }

    pub(crate) fn assert_no_complaint(&self, after: &str) {
        let complaints = self.complaints();
        assert!(complaints.is_empty(), "{:?}, after {after}: {complaints:?}", self.kind);
    }
}

/// The collecting itself: a wrong call is noticed, by flag and, where there are messages, in words.
#[test]
fn a_wrong_call_is_a_complaint() {
    in_each_api(|gl| {
        // SAFETY: a call that OpenGL answers with an error.
        unsafe { gl.gl.enable(0xdead) };
        let complaints = gl.complaints();
        let expected = if gl.gl.supports_debug() { 2 } else { 1 };
        assert_eq!(complaints.len(), expected, "{complaints:?}");
        assert!(gl.complaints().is_empty(), "each is reported once");
    });
}
