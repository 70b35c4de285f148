//! Times of frames.

mod common;

use antumbra_host::{Api, FrameTimer, TestContext};
use glow::HasContext;
use std::time::Duration;

/// Whatever the clock, a frame that waits takes that long on it or on the wall; an error is passed on and leaves the
/// timer able to go on.
#[test]
fn frames_take_time_and_may_fail() {
    for api in [Api::Gl33, Api::Gles30] {
        let Some(context) = TestContext::new(api) else { return };
        let gl = context.gl().clone();
        let info = context.info();
        let mut timer = FrameTimer::new(&gl, &info).expect("a timer");
        if info.software {
            assert_eq!(timer.name(), "wall time between glFinish", "the clock of a software renderer");
        }
        let mut clear = |wait: u64| {
            timer.time(|| {
                // SAFETY: no framebuffer is bound and none is needed to wait.
                unsafe { gl.clear_color(0.0, 0.0, 0.0, 1.0) };
                std::thread::sleep(Duration::from_millis(wait));
                if wait == 7 { Err("no frame") } else { Ok(()) }
            })
        };
        let (short, failed, long) = (clear(1), clear(7), clear(40));
        assert_eq!(failed, Err("no frame"), "the frame's own error");
        let (short, long) = (short.expect("a frame"), long.expect("a frame"));
        assert!(short >= 0.0 && short.is_finite() && long.is_finite(), "{short} and {long} ms");
        if info.software {
            assert!(short >= 1.0 && long >= 40.0, "{short} and {long} ms, of frames that wait 1 and 40 ms");
        }
        drop(timer);
        // SAFETY: asks for the error flag.
        assert_eq!(unsafe { gl.get_error() }, glow::NO_ERROR, "no OpenGL error");
    }
}
