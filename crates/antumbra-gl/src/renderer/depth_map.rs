//! What a light sees, for programs that show it.

use super::Renderer;
use super::drawing::Hands;
use super::plan::{FramePlan, Purpose};
use crate::gl::{StateGuard, bound_framebuffer};
use crate::input::{Error, Frame, LightFault};
use crate::masks::DepthMap;

impl Renderer {
    /// Draws the shadow map of one of the frame's lights and says where it is: the very map that the light's shadows come
    /// from in such a frame. Valid until the next call of the renderer, which may draw another over it; in between it is
    /// the host's to read. [`Self::stats`] stay those of the frame before.
    ///
    /// A light with an area that is drawn as points has a map for each: this is the first one's.
    ///
    /// `None` if the technique has no maps ([`crate::Technique::has_maps`]), and for a light that is off or has no shadow
    /// in sight.
    ///
    /// # Errors
    /// [`Error::BadLight`] for a light that the frame does not have, and the errors of [`Self::masks`].
    pub fn depth_map(&mut self, frame: &Frame<'_>, light: usize) -> Result<Option<DepthMap>, Error> {
        let gl = self.gl.clone();
        // SAFETY: a query; the context is current, as the type's documentation demands.
        let bound = unsafe { bound_framebuffer(&gl) };
        let _guard = StateGuard::new(&gl, self.manner.caps, self.host_state);
        // SAFETY: the guard is alive, and whoever made the handles of textures vouches for them.
        let frame = unsafe { self.with_depth(frame, bound)? };
        let plan = FramePlan::new(&frame, Purpose::Map, &self.manner, &mut self.centers)?;
        let Some(asked) = frame.lights.get(light) else {
            return Err(Error::BadLight { index: light, fault: LightFault::Missing });
        };
        if !self.manner.technique.has_maps() {
            return Ok(None);
        }
        let stats = self.stats;
        // SAFETY: as above, and the frame was checked.
        let prepared = unsafe { self.prepare(&plan) };
        self.stats = stats;
        prepared?;
        let Hands { method, pass, points, .. } = self.hands(&plan);
        let drawn = match plan.sampling {
            None => asked,
            Some(_) => match points.of(light) {
                [first, ..] => first,
                [] => return Ok(None),
            },
        };
        // SAFETY: as above, and the frame was prepared.
        unsafe { method.draw_map(&pass, drawn) }
    }
}
