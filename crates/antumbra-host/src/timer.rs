//! How long a frame takes.

use crate::{ContextInfo, HostError};
use glow::HasContext;
use std::sync::Arc;
use std::time::Instant;

/// Measures frames one at a time. Each begins and ends with the driver idle (`glFinish`), so that none pays for
/// another's work.
pub struct FrameTimer {
    gl: Arc<glow::Context>,
    query: Option<glow::Query>,
}

impl FrameTimer {
    /// A timer on the current context: the GPU's own clock where there is a GPU and its OpenGL has timer queries (3.3
    /// has, ES 3.0 has not), else the wall clock. On a software renderer timer queries say little of the time that
    /// passes.
    ///
    /// # Errors
    /// [`HostError::Driver`].
    pub fn new(gl: &Arc<glow::Context>, info: &ContextInfo) -> Result<Self, HostError> {
        let queries = !info.software && !gl.version().is_embedded;
        // SAFETY: makes an object of this context.
        let query = queries.then(|| unsafe { gl.create_query() }).transpose().map_err(HostError::Driver)?;
        Ok(Self { gl: gl.clone(), query })
    }

    /// Which clock it is, in words.
    pub fn name(&self) -> &'static str {
        if self.query.is_some() { "GPU timer query" } else { "wall time between glFinish" }
    }

    /// Does the work of one frame; returns how many milliseconds it took, until all of it was drawn.
    ///
    /// # Errors
    /// Those of `frame`.
    pub fn time<E>(&mut self, frame: impl FnOnce() -> Result<(), E>) -> Result<f64, E> {
        let gl = &self.gl;
        // SAFETY: waits for the context of this thread; the query, if any, is its own and not in use.
        unsafe {
            gl.finish();
            if let Some(query) = self.query {
                gl.begin_query(glow::TIME_ELAPSED, query);
            }
        }
        let start = Instant::now();
        let outcome = frame();
        // SAFETY: as above; the result is there once the driver is idle.
        let on_gpu = unsafe {
            if self.query.is_some() {
                gl.end_query(glow::TIME_ELAPSED);
            }
            gl.finish();
            self.query.map(|query| gl.get_query_parameter_u32(query, glow::QUERY_RESULT))
        };
        let on_wall = start.elapsed().as_secs_f64() * 1e3;
        outcome.map(|()| match on_gpu {
            // Nanoseconds, which 32 bits count to 4.3 s: a longer frame is told by the wall clock.
            Some(nanoseconds) if on_wall < 4e3 => f64::from(nanoseconds) * 1e-6,
            _ => on_wall,
        })
    }
}

impl Drop for FrameTimer {
    fn drop(&mut self) {
        if let Some(query) = self.query {
            // SAFETY: the timer's own object.
            unsafe { self.gl.delete_query(query) };
        }
    }
}
