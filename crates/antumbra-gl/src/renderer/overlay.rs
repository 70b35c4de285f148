//! Shadows over the host's picture.

use super::Renderer;
use super::plan::{FramePlan, Purpose};
use crate::gl::{StateGuard, bound_framebuffer, refuse_feedback, refuse_upper_left};
use crate::input::{Encoding, Error, Frame, Framebuffer};
use crate::masks::{BATCH_LIGHTS, HostPicture};
use glow::HasContext;

impl Renderer {
    /// Multiplies the pixels of the bound draw framebuffer's first colour buffer by
    /// (Σ V E + ambient) / (Σ E + ambient): what a diffuse host would have drawn with shadows; or, with a
    /// technique that paints shadows, paints them. The framebuffer's other colour buffers are left alone.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Refused`], [`Error::Unsupported`],
    /// [`Error::SurfaceAttached`], [`Error::Resource`]. The picture is then untouched.
    pub fn overlay(&mut self, frame: &Frame<'_>, encoding: Encoding) -> Result<(), Error> {
        // SAFETY: a query; the context is current, as the type's documentation demands.
        let bound = unsafe { bound_framebuffer(&self.gl) };
        self.overlay_on(frame, encoding, bound)
    }

    /// The same over the pixels of a framebuffer that need not be bound.
    ///
    /// # Errors
    /// As for [`Self::overlay`].
    pub fn overlay_to(
        &mut self,
        frame: &Frame<'_>,
        encoding: Encoding,
        framebuffer: Framebuffer,
    ) -> Result<(), Error> {
        self.overlay_on(frame, encoding, framebuffer.glow())
    }

    fn overlay_on(
        &mut self,
        frame: &Frame<'_>,
        encoding: Encoding,
        framebuffer: Option<glow::Framebuffer>,
    ) -> Result<(), Error> {
        encoding.check().map_err(Error::BadFrame)?;
        let gl = self.gl.clone();
        let mut guard = StateGuard::new(&gl, self.manner.caps, self.host_state);
        guard.leave_bound(framebuffer, self.host_state);
        let host = HostPicture { framebuffer, encoding };
        // SAFETY: the guard is alive, the plan checks the frame, and whoever made the handles of textures and framebuffers
        // vouches for them.
        unsafe {
            refuse_upper_left(&gl, &self.manner.caps, self.host_state)?;
            let frame = self.with_depth(frame, framebuffer)?;
            let plan = FramePlan::new(&frame, Purpose::Overlay, &self.manner, &mut self.centers)?;
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer);
            refuse_feedback(&plan.drawing(&gl, &self.manner.caps, self.host_state), framebuffer)?;
            self.prepare(&plan)?;
            match frame.lights {
                _ if plan.paints => self.paint(&plan, host),
                [] => Ok(()),
                lights if lights.len() <= BATCH_LIGHTS => self.overlay_batch(&plan, host),
                _ => self.overlay_batches(&plan, host),
            }
        }
    }

    /// Multiplies the host's pixels where one batch has all lights.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn overlay_batch(&mut self, plan: &FramePlan<'_>, host: HostPicture) -> Result<(), Error> {
        let lights = plan.frame.lights;
        // SAFETY: the caller's.
        unsafe {
            self.draw_visibility(plan, 0)?;
            let Self { gl, manner, host_state, overlay, masks, .. } = self;
            overlay.multiply(&plan.drawing(gl, &manner.caps, *host_state), lights, masks, host)
        }
    }

    /// The same where there are several: by way of sums.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn overlay_batches(&mut self, plan: &FramePlan<'_>, host: HostPicture) -> Result<(), Error> {
        let batches = || plan.frame.lights.chunks(BATCH_LIGHTS);
        let (gl, caps) = (self.gl.clone(), self.manner.caps);
        let drawing = plan.drawing(&gl, &caps, self.host_state);
        // SAFETY: the caller's.
        unsafe {
            self.overlay.clear_sums(&drawing)?;
            for (i, lights) in batches().enumerate() {
                self.draw_visibility(plan, i)?;
                self.overlay.add_taken(&drawing, lights, &self.masks)?;
            }
            for lights in batches() {
                self.overlay.add_all(&drawing, lights, &self.frame_tiles)?;
            }
            self.overlay.multiply_by_ratio(&drawing, &self.frame_tiles, host)
        }
    }
}
