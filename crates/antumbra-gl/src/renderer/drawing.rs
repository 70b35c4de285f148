//! Drawing a planned frame, batch by batch.

use super::Renderer;
use super::plan::{FramePlan, Programs};
use crate::gl::{Drawing, HostDraw};
use crate::input::{Error, Frame};
use crate::masks::{BATCH_LIGHTS, Batch, Counts, HostPicture, Masks, Points, Sampler, Stats};
use crate::technique::{Method, Pass};
use glow::HasContext;

/// A planned frame in the hands that draw it.
pub(super) struct Hands<'a> {
    pub(super) method: &'a mut dyn Method,
    pub(super) pass: Pass<'a>,
    masks: &'a mut Masks,
    /// Where lights are sampled.
    sampler: Option<&'a mut Sampler>,
    pub(super) points: &'a Points,
}

impl Renderer {
    /// Compiles programs, unless it was done, and makes the sampler if they are its too.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    pub(super) unsafe fn compile(&mut self, programs: &Programs) -> Result<(), Error> {
        let (gl, caps, variant) = (&self.gl, &self.manner.caps, programs.variant);
        self.methods.warm_up(&self.manner.technique, gl, caps, variant, programs.technique)?;
        if programs.sampled {
            if self.sampler.is_none() {
                // SAFETY: the caller's.
                self.sampler = Some(unsafe { Sampler::new(gl)? });
            }
            if let Some(sampler) = &mut self.sampler {
                sampler.warm_up(gl, caps, variant)?;
            }
        }
        self.overlay.warm_up(gl, caps, variant, programs.overlay)
    }

    /// Programs and targets of a frame; the technique's own preparations.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, the surface's textures exist.
    pub(super) unsafe fn prepare(&mut self, plan: &FramePlan<'_>) -> Result<(), Error> {
        // SAFETY: the caller's.
        unsafe {
            self.compile(&plan.programs)?;
            let drawing = plan.drawing(&self.gl, &self.manner.caps, self.host_state);
            if let (Some(sampling), Some(sampler)) = (plan.sampling, &mut self.sampler) {
                self.points.of_lights(&plan.frame, sampling);
                sampler.prepare(&drawing)?;
            }
            self.masks.ensure(&drawing, plan.format)?;
        }
        self.frame_tiles.reset(plan.view.size());
        self.stats = Stats { tiles: self.frame_tiles.len(), ..Stats::default() };
        let Hands { method, pass, .. } = self.hands(plan);
        // SAFETY: the caller's.
        unsafe { method.begin(&pass) }
    }

    /// The frame as the technique sees it, and what is drawn to.
    pub(super) fn hands<'a>(&'a mut self, plan: &'a FramePlan<'_>) -> Hands<'a> {
        let is_sampled = plan.sampling.is_some();
        let lights = if is_sampled { &self.points.lights[..] } else { plan.frame.lights };
        let drawing = plan.drawing(&self.gl, &self.manner.caps, self.host_state);
        let drawing = Drawing { frame: Frame { lights, ..drawing.frame }, ..drawing };
        let (method, pass) = self.methods.begin(&self.manner.technique, drawing);
        let sampler = self.sampler.as_mut().filter(|_| is_sampled);
        Hands { method, pass, masks: &mut self.masks, sampler, points: &self.points }
    }

    /// Draws the visibility of one batch of the frame's lights.
    ///
    /// # Safety
    /// As for [`Self::prepare`], which was called for the frame.
    pub(super) unsafe fn draw_visibility(&mut self, plan: &FramePlan<'_>, batch: usize) -> Result<(), Error> {
        let first = batch * BATCH_LIGHTS;
        let lights = &plan.frame.lights[first..];
        let lights = &lights[..lights.len().min(BATCH_LIGHTS)];
        let Hands { method, pass, masks, sampler, points } = self.hands(plan);
        // SAFETY: the caller's.
        unsafe {
            let mut batch = masks.begin(&pass, lights);
            match sampler {
                Some(sampler) => {
                    let mut hard = |batch: &mut Batch<'_>| method.draw_visibility(&pass, batch);
                    sampler.draw(&pass, &mut batch, first, points, &mut hard)?;
                }
                None => method.draw_visibility(&pass, &mut batch)?,
            }
        }
        let counts = method.counts();
        self.count(counts);
        Ok(())
    }

    /// Lets the technique paint.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    pub(super) unsafe fn paint(&mut self, plan: &FramePlan<'_>, host: HostPicture) -> Result<(), Error> {
        let Hands { method, pass, masks, .. } = self.hands(plan);
        let Some(painter) = method.painter() else { return Ok(()) };
        masks.tiles.reset(plan.view.size());
        let (gl, [x, y, width, height]) = (pass.gl, plan.view.viewport);
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
            gl.viewport(x, y, width, height);
            let draw = HostDraw::begin(&pass, host.framebuffer);
            let painted = painter.paint(&pass, host, &mut masks.tiles);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
            draw.end(gl);
            painted?;
        }
        let counts = method.counts();
        self.count(counts);
        Ok(())
    }

    /// Says what the frame has done after one more batch. `counts` are since its beginning.
    fn count(&mut self, counts: Counts) {
        self.frame_tiles.add(&self.masks.tiles);
        self.stats = Stats {
            pairs: counts.pairs,
            drawn_pairs: counts.drawn,
            polygons: counts.polygons,
            batches: self.stats.batches + 1,
            touched_tiles: self.frame_tiles.touched_len(),
            tiles: self.frame_tiles.len(),
        };
    }
}
