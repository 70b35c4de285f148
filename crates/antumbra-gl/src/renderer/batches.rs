//! Masks for the host's own lighting, batch by batch.

use super::Renderer;
use super::plan::{FramePlan, Purpose};
use crate::gl::{StateGuard, bound_framebuffer, refuse_upper_left};
use crate::input::{Error, Frame, Texture};
use crate::masks::{BATCH_LIGHTS, MaskBatch};
use std::fmt;

/// The visibilities of a frame's lights, [`BATCH_LIGHTS`] lights at a time: [`Renderer::masks`].
pub struct MaskBatches<'r, 'f> {
    renderer: &'r mut Renderer,
    plan: FramePlan<'f>,
    /// How many batches were handed out.
    taken: usize,
}

impl Renderer {
    /// Fills textures with the visibilities of a frame's lights, [`BATCH_LIGHTS`] lights at a time, which the host's own
    /// lighting looks up:
    ///
    /// ```no_run
    /// # fn f(mut shadows: antumbra_gl::Renderer, frame: antumbra_gl::Frame<'_>) -> Result<(), antumbra_gl::Error> {
    /// let mut batches = shadows.masks(&frame)?;
    /// while let Some(batch) = batches.next()? {
    ///     // Light with lights batch.first_light .. batch.first_light + batch.lights here.
    /// }
    /// # Ok(()) }
    /// ```
    ///
    /// Between the calls the OpenGL state is the host's own. The next batch, and the next call of the renderer, overwrite
    /// the textures: with one batch they may be used until then, with several only before the next one.
    ///
    /// The first batch is drawn at once, so that whatever is wrong with the frame is an error here.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Refused`], [`Error::Unsupported`],
    /// [`Error::Resource`].
    pub fn masks<'r, 'f>(&'r mut self, frame: &Frame<'f>) -> Result<MaskBatches<'r, 'f>, Error> {
        let gl = self.gl.clone();
        // SAFETY: a query; the context is current, as the type's documentation demands.
        let bound = unsafe { bound_framebuffer(&gl) };
        let _guard = StateGuard::new(&gl, self.manner.caps, self.host_state);
        // SAFETY: the guard is alive, the plan checks the frame, and whoever made the handles of textures vouches for them.
        let plan = unsafe {
            refuse_upper_left(&gl, &self.manner.caps, self.host_state)?;
            let frame = self.with_depth(frame, bound)?;
            let plan = FramePlan::new(&frame, Purpose::Masks, &self.manner, &mut self.centers)?;
            self.prepare(&plan)?;
            if !frame.lights.is_empty() {
                self.draw_visibility(&plan, 0)?;
            }
            plan
        };
        Ok(MaskBatches { renderer: self, plan, taken: 0 })
    }
}

impl fmt::Debug for MaskBatches<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MaskBatches").field("taken", &self.taken).finish_non_exhaustive()
    }
}

impl MaskBatches<'_, '_> {
    /// The next batch; `None` after the last.
    ///
    /// # Errors
    /// [`Error::Resource`].
    #[expect(clippy::should_implement_trait, reason = "a batch lasts until the next one, and may fail")]
    pub fn next(&mut self) -> Result<Option<MaskBatch>, Error> {
        let Self { renderer, plan, taken } = self;
        let batch = *taken;
        let Some(lights) = plan.frame.lights.chunks(BATCH_LIGHTS).nth(batch) else { return Ok(None) };
        if batch > 0 {
            let gl = renderer.gl.clone();
            let _guard = StateGuard::new(&gl, renderer.manner.caps, renderer.host_state);
            // SAFETY: the guard is alive, and the frame was prepared.
            unsafe { renderer.draw_visibility(plan, batch)? };
        }
        *taken += 1;
        Ok(Some(MaskBatch {
            first_light: batch * BATCH_LIGHTS,
            lights: lights.len(),
            samples: plan.frame.surface.samples,
            textures: renderer.masks.targets().map(|target| Texture::own(target.texture)),
        }))
    }
}
