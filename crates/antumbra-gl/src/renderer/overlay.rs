//! The batches of a frame over the host's picture.

use super::Renderer;
use super::plan::FramePlan;
use crate::gl::Drawing;
use crate::input::Error;
use crate::masks::{BATCH_LIGHTS, HostPicture};

impl Renderer {
    /// Multiplies the host's pixels where one batch has all lights.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    pub(super) unsafe fn overlay_batch(
        &mut self,
        plan: &FramePlan<'_>,
        host: HostPicture,
    ) -> Result<(), Error> {
        let lights = plan.frame.lights;
        if lights.is_empty() {
            return Ok(());
        }
        // SAFETY: the caller's.
        unsafe {
            self.draw_visibility(plan, 0, lights)?;
            let Self { gl, manner, overlay, masks, .. } = self;
            overlay.multiply(&plan.drawing(gl, &manner.caps), lights, masks, host)
        }
    }

    /// The same where there are several: by way of sums.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    pub(super) unsafe fn overlay_batches(
        &mut self,
        plan: &FramePlan<'_>,
        host: HostPicture,
    ) -> Result<(), Error> {
        let batches = || plan.frame.lights.chunks(BATCH_LIGHTS);
        let gl = self.gl.clone();
        let caps = self.manner.caps;
        let drawing: Drawing<'_> = plan.drawing(&gl, &caps);
        // SAFETY: the caller's.
        unsafe {
            self.overlay.clear_sums(&drawing)?;
            for (i, lights) in batches().enumerate() {
                self.draw_visibility(plan, i * BATCH_LIGHTS, lights)?;
                self.overlay.add_taken(&drawing, lights, &self.masks)?;
            }
            for lights in batches() {
                self.overlay.add_all(&drawing, lights, &self.frame_tiles)?;
            }
            self.overlay.multiply_by_ratio(&drawing, &self.frame_tiles, host)
        }
    }
}
