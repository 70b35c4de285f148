//! What a light sees, for programs that show it.

use super::Renderer;
use crate::Error;
use crate::frame::Frame;
use crate::state::StateGuard;
use crate::technique::map::DepthMap;

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
        let view = self.check(frame)?;
        let Some(asked) = frame.lights.get(light) else {
            return Err(Error::BadLight { index: light, reason: "the frame has no such light" });
        };
        if !self.technique.has_maps() {
            return Ok(None);
        }
        self.painting = false;
        let gl = self.gl.clone();
        let _guard = StateGuard::new(&gl, self.caps);
        let stats = self.stats;
        // SAFETY: the guard is alive, and the frame was checked.
        let drawn = unsafe {
            self.prepare(frame, &view).and_then(|()| {
                self.with_method(frame, &view, |method, pass, work| {
                    let points = work.sampler.map(|_| work.points.of(light));
                    match points {
                        Some([first, ..]) => method.draw_map(pass, first),
                        Some([]) => Ok(None),
                        None => method.draw_map(pass, asked),
                    }
                })
            })
        };
        self.stats = stats;
        drawn
    }
}
