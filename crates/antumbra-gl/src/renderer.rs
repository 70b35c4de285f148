//! The renderer: a guest in the host's OpenGL.

mod depth_map;

use crate::frame::{Frame, Surface};
use crate::host_target::{OtherBuffers, refuse_feedback};
use crate::overlay::{Encoding, HostPicture, Overlay};
use crate::pairs::{BATCH_LIGHTS, GROUP_LIGHTS};
use crate::resources::{Target, TargetFormat};
use crate::results::{Counts, MaskBatch, Stats};
use crate::sampler::{Points, Sampler, Sampling};
use crate::samples::Soft;
use crate::scenery::{Area, Light};
use crate::shader::{ProgramId, ProgramSet, Variant};
use crate::state::StateGuard;
use crate::technique::{Batch, Method, Pass, Technique};
use crate::tiles::TileGrid;
use crate::view::View;
use crate::{Caps, Error};
use glow::HasContext;
use std::sync::Arc;

/// Adds shadows to what a host has drawn.
///
/// The first frame compiles the shaders for its kind of surface ([`Renderer::warm_up`] does it
/// before); later frames compile nothing, and allocate nothing while the viewport stays and no more
/// pairs of light and occluder come into sight than before. Memory does not depend on the number of
/// lights. Every piece of OpenGL state is left as it was found. The context the renderer was made
/// in must be current in every call and when it is dropped, which deletes its OpenGL objects.
pub struct Renderer {
    gl: Arc<glow::Context>,
    caps: Caps,
    technique: Technique,
    /// Of each technique that has been chosen, by its index.
    loaded: Vec<Option<Loaded>>,
    overlay: Overlay,
    visibility: [Option<Target>; BATCH_LIGHTS / GROUP_LIGHTS],
    soft: Soft,
    /// Whether the technique paints the frame at hand; it then sees the lights as they are.
    painting: bool,
    /// Made when lights are first sampled.
    sampler: Option<Sampler>,
    /// What stands for the frame's lights where they are sampled.
    points: Points,
    /// For [`Soft::refusal_with`].
    centers: Vec<Light>,
    /// The tiles that shadows touch: in a batch, in the frame.
    batch_tiles: TileGrid,
    frame_tiles: TileGrid,
    stats: Stats,
}

/// A technique's OpenGL objects.
struct Loaded {
    method: Box<dyn Method>,
    programs: ProgramSet,
}

/// What a batch is drawn to and with.
struct Work<'a> {
    masks: [&'a Target; 2],
    tiles: &'a mut TileGrid,
    /// Where lights are sampled.
    sampler: Option<&'a mut Sampler>,
    points: &'a Points,
}

impl Renderer {
    /// A renderer of the technique `analytic`; makes the OpenGL objects that do not depend on the frame.
    ///
    /// # Errors
    /// [`Error::TooOld`], [`Error::Resource`].
    pub fn new(gl: Arc<glow::Context>) -> Result<Self, Error> {
        let caps = Caps::query(&gl)?;
        let overlay = {
            let _guard = StateGuard::new(&gl, caps);
            // SAFETY: the guard is alive.
            unsafe { Overlay::new(&gl)? }
        };
        let mut renderer = Self {
            gl,
            caps,
            technique: Technique::default(),
            loaded: Technique::NAMES.iter().map(|_| None).collect(),
            overlay,
            visibility: [None, None],
            soft: Soft::Native,
            painting: false,
            sampler: None,
            points: Points::default(),
            centers: Vec::new(),
            batch_tiles: TileGrid::default(),
            frame_tiles: TileGrid::default(),
            stats: Stats::default(),
        };
        renderer.set_technique(Technique::default())?;
        Ok(renderer)
    }

    /// Finds shadows in another way from the next frame on. What earlier techniques have made and compiled is
    /// kept, so that changing back is free.
    ///
    /// # Errors
    /// [`Error::Resource`]; the technique is then the one it was.
    pub fn set_technique(&mut self, technique: Technique) -> Result<(), Error> {
        let slot = &mut self.loaded[technique.index()];
        if slot.is_none() {
            let _guard = StateGuard::new(&self.gl, self.caps);
            // SAFETY: the guard is alive.
            let method = unsafe { technique.make(&self.gl, &self.caps)? };
            *slot = Some(Loaded { method, programs: ProgramSet::default() });
        }
        self.technique = technique;
        Ok(())
    }

    /// How shadows are found.
    pub fn technique(&self) -> Technique {
        self.technique
    }

    /// Draws lights with an area in another way from the next frame on.
    pub fn set_soft(&mut self, soft: Soft) {
        self.soft = soft;
    }

    /// How lights with an area are drawn.
    pub fn soft(&self) -> Soft {
        self.soft
    }

    /// Compiles the shaders for surfaces and lights like these, unless it was done: the first frame with
    /// such a surface, and such kinds of light, does it otherwise.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for surfaces this context cannot read, [`Error::Shader`].
    pub fn warm_up(&mut self, surface: &Surface, lights: &[Light]) -> Result<(), Error> {
        if surface.samples > 1 && !self.caps.sample_shading() {
            return Err(Error::Unsupported {
                what: "a multisampled surface",
                needs: "OpenGL 4.0 or GL_ARB_sample_shading; resolve colour and depth first",
            });
        }
        if surface.samples > self.caps.max_samples {
            return Err(Error::Unsupported {
                what: "a surface of this many samples",
                needs: "a driver that has textures of as many",
            });
        }
        let variant = Variant::of(surface);
        let sampled = self.sampling(lights).is_some();
        let seen = if sampled { &[] } else { lights };
        let loaded = self.loaded[self.technique.index()].as_mut().expect("set_technique has made it");
        let (sources, exact) = (self.technique.programs(), self.technique.is_exact());
        loaded.programs.ensure(&self.gl, &self.caps, sources, variant, seen, exact)?;
        if let (true, Some(sampler)) = (sampled, &mut self.sampler) {
            sampler.warm_up(&self.gl, &self.caps, variant)?;
        }
        self.overlay.warm_up(&self.gl, &self.caps, variant, lights)
    }

    /// What the context can do.
    pub fn caps(&self) -> &Caps {
        &self.caps
    }

    /// What the last frame did.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// Multiplies the pixels of the bound draw framebuffer's first colour buffer by
    /// (Σ V E + ambient) / (Σ E + ambient): what a diffuse host would have drawn with shadows; or, with a
    /// technique that paints shadows, paints them. The framebuffer's other colour buffers are left alone.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Refused`], [`Error::Unsupported`],
    /// [`Error::SurfaceAttached`], [`Error::Resource`]. The picture is then untouched.
    pub fn overlay(&mut self, frame: &Frame<'_>, encoding: Encoding) -> Result<(), Error> {
        let gamma = encoding.gamma()?;
        let view = self.check(frame)?;
        self.painting = self.technique.paints();
        let gl = self.gl.clone();
        let guard = StateGuard::new(&gl, self.caps);
        let host = HostPicture { framebuffer: guard.host_framebuffer(), gamma };
        // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches for
        // the textures of the surface.
        unsafe {
            refuse_feedback(&gl, host.framebuffer, &frame.surface, self.caps)?;
            self.prepare(frame, &view)?;
            if self.paint(frame, &view, encoding, host)? {
                return Ok(());
            }
            if frame.lights.len() > BATCH_LIGHTS && !self.caps.float_targets() {
                return Err(Error::Unsupported {
                    what: "an overlay of more than 8 lights",
                    needs: "floating-point render targets (EXT_color_buffer_float), or masks",
                });
            }
            let one_batch = frame.lights.len() <= BATCH_LIGHTS;
            if !one_batch {
                self.overlay.clear_sums(&gl, &view, &frame.surface)?;
            }
            let program = if one_batch { ProgramId::Overlay } else { ProgramId::Taken };
            for (i, lights) in frame.lights.chunks(BATCH_LIGHTS).enumerate() {
                self.draw_visibility(i * BATCH_LIGHTS, lights, frame, &view)?;
                self.draw_screen(program, lights, frame, &view, host)?;
            }
            if !one_batch {
                std::mem::swap(&mut self.batch_tiles, &mut self.frame_tiles);
                for lights in frame.lights.chunks(BATCH_LIGHTS) {
                    self.draw_screen(ProgramId::All, lights, frame, &view, host)?;
                }
                self.draw_screen(ProgramId::Ratio, &[], frame, &view, host)?;
            }
        }
        Ok(())
    }

    /// Fills visibility textures and hands them to `shade`, [`BATCH_LIGHTS`] lights at a time,
    /// once for each batch. In `shade` the OpenGL state is the host's own. The next batch, and the
    /// next call of the renderer, overwrite the textures: with one batch they may be used until then,
    /// with several only inside `shade`.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Refused`], [`Error::Unsupported`],
    /// [`Error::Resource`].
    pub fn masks(&mut self, frame: &Frame<'_>, mut shade: impl FnMut(&MaskBatch)) -> Result<(), Error> {
        let view = self.check(frame)?;
        self.painting = false;
        let gl = self.gl.clone();
        for (i, lights) in frame.lights.chunks(BATCH_LIGHTS).enumerate() {
            let guard = StateGuard::new(&gl, self.caps);
            // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches
            // for the textures of the surface.
            unsafe {
                if i == 0 {
                    self.prepare(frame, &view)?;
                }
                self.draw_visibility(i * BATCH_LIGHTS, lights, frame, &view)?;
            }
            drop(guard);
            let [Some(a), Some(b)] = &self.visibility else { continue };
            shade(&MaskBatch {
                first_light: i * BATCH_LIGHTS,
                lights: lights.len(),
                textures: [a.texture, b.texture],
            });
        }
        Ok(())
    }

    /// Whether the numbers make sense and the technique can do it.
    fn check(&mut self, frame: &Frame<'_>) -> Result<View, Error> {
        let view = View::new(frame, &self.caps)?;
        match self.soft.refusal_with(&self.technique, &frame.scenery(), &mut self.centers) {
            Some(refusal) => Err(Error::Refused { technique: self.technique.name(), refusal }),
            None => Ok(view),
        }
    }

    /// Which points stand for each light with an area; `None` if the technique is to draw areas itself, or there are
    /// none.
    fn sampling(&self, lights: &[Light]) -> Option<Sampling> {
        if self.painting || lights.iter().all(|light| light.area == Area::None) {
            return None;
        }
        match self.soft {
            Soft::Samples { count, pattern } => Some(Sampling::Spread(count, pattern)),
            // What it paints is no visibility: masks are the average over the same components.
            Soft::Native => self.technique.components().map(Sampling::Components),
        }
    }

    /// Targets of the frame's size; the technique's own preparations.
    ///
    /// # Safety
    /// A [`StateGuard`] is alive.
    unsafe fn prepare(&mut self, frame: &Frame<'_>, view: &View) -> Result<(), Error> {
        let sampling = self.sampling(frame.lights);
        if sampling.is_some() && self.sampler.is_none() {
            // SAFETY: the caller's.
            self.sampler = Some(unsafe { Sampler::new(&self.gl)? });
        }
        self.warm_up(&frame.surface, frame.lights)?;
        if let (Some(sampling), Some(sampler)) = (sampling, &mut self.sampler) {
            self.points.of_lights(frame, sampling);
            // SAFETY: the caller's.
            unsafe { sampler.prepare(&self.gl, &self.caps, frame)? };
        }
        let size = (view.viewport[2], view.viewport[3]);
        let soft = frame.lights.iter().any(|light| light.area != Area::None) && self.caps.float_targets();
        let format = if soft { TargetFormat::Rgba16F } else { TargetFormat::Rgba8 };
        for slot in &mut self.visibility {
            // SAFETY: the caller's.
            unsafe { Target::ensure(slot, &self.gl, format, size, frame.surface.samples)? };
        }
        self.frame_tiles.reset(view.size());
        self.stats = Stats { tiles: self.frame_tiles.len(), ..Stats::default() };
        // SAFETY: the caller's.
        self.with_method(frame, view, |method, pass, _| unsafe { method.begin(pass) })
    }

    /// Calls `work` with the method, the frame as the technique sees it, and what is drawn to.
    fn with_method<R>(
        &mut self,
        frame: &Frame<'_>,
        view: &View,
        work: impl FnOnce(&mut dyn Method, &Pass<'_>, Work<'_>) -> R,
    ) -> R {
        let sampled = self.sampling(frame.lights).is_some();
        let loaded = self.loaded[self.technique.index()].as_mut().expect("set_technique has made it");
        let hard = if sampled { Frame { lights: &self.points.lights, ..*frame } } else { *frame };
        let pass = Pass {
            gl: &self.gl,
            caps: &self.caps,
            frame: &hard,
            view,
            technique: &self.technique,
            programs: loaded.programs.of(Variant::of(&frame.surface)),
        };
        let masks = self.visibility.each_ref().map(|target| target.as_ref().expect("prepare has made it"));
        let sampler = self.sampler.as_mut().filter(|_| sampled);
        work(
            loaded.method.as_mut(),
            &pass,
            Work { masks, tiles: &mut self.batch_tiles, sampler, points: &self.points },
        )
    }

    /// Draws the visibility of one batch of lights, the first of which is the frame's light `first`.
    ///
    /// # Safety
    /// A [`StateGuard`] is alive, [`Self::prepare`] was called, the surface's textures exist.
    unsafe fn draw_visibility(
        &mut self,
        first: usize,
        lights: &[Light],
        frame: &Frame<'_>,
        view: &View,
    ) -> Result<(), Error> {
        let counts = self.with_method(frame, view, |method, pass, work| {
            let Work { masks, tiles, sampler, points } = work;
            tiles.reset(view.size());
            let gl = pass.gl;
            // SAFETY: the caller's.
            unsafe {
                gl.viewport(0, 0, view.viewport[2], view.viewport[3]);
                for target in masks {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                    gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
                }
                let mut batch = Batch { lights, masks, tiles };
                match sampler {
                    Some(sampler) => sampler.draw(method, pass, &mut batch, first, points)?,
                    None => method.draw_visibility(pass, &mut batch)?,
                }
            }
            Ok(method.counts())
        })?;
        self.count(counts);
        Ok(())
    }

    /// Lets the technique paint, if it does; whether it did.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn paint(
        &mut self,
        frame: &Frame<'_>,
        view: &View,
        encoding: Encoding,
        host: HostPicture,
    ) -> Result<bool, Error> {
        let counts = self.with_method(frame, view, |method, pass, work| {
            let Some(painter) = method.painter(pass) else { return Ok(None) };
            work.tiles.reset(view.size());
            let (gl, [x, y, width, height]) = (pass.gl, view.viewport);
            // SAFETY: the caller's.
            unsafe {
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
                gl.viewport(x, y, width, height);
                let others = OtherBuffers::leave_alone(gl, *pass.caps, host.framebuffer);
                let painted = painter.paint(pass, encoding, work.tiles);
                if let Some(others) = others {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
                    others.restore(gl);
                }
                painted?;
            }
            Ok(Some(method.counts()))
        })?;
        let Some(counts) = counts else { return Ok(false) };
        self.count(counts);
        Ok(true)
    }

    /// Says what the frame has done after one more batch. `counts` are since its beginning.
    fn count(&mut self, counts: Counts) {
        self.frame_tiles.add(&self.batch_tiles);
        self.stats = Stats {
            pairs: counts.pairs,
            drawn_pairs: counts.drawn,
            polygons: counts.polygons,
            batches: self.stats.batches + 1,
            touched_tiles: self.frame_tiles.touched_len(),
            tiles: self.frame_tiles.len(),
        };
    }

    /// Draws one of the overlay's passes over the batch's tiles.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn draw_screen(
        &mut self,
        program: ProgramId,
        lights: &[Light],
        frame: &Frame<'_>,
        view: &View,
        host: HostPicture,
    ) -> Result<(), Error> {
        let Self { gl, caps, overlay, batch_tiles, visibility, .. } = self;
        // SAFETY: the caller's.
        unsafe { overlay.draw(gl, caps, program, lights, frame, view, batch_tiles, visibility, host) }
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        let gl = &self.gl;
        // SAFETY: the objects are this renderer's own and not used afterwards; the context is
        // current, as the type's documentation demands.
        unsafe {
            for loaded in self.loaded.iter_mut().flatten() {
                loaded.method.delete(gl);
                loaded.programs.delete(gl);
            }
            self.overlay.delete(gl);
            if let Some(sampler) = &mut self.sampler {
                sampler.delete(gl);
            }
            self.visibility.iter_mut().filter_map(Option::take).for_each(|target| target.delete(gl));
        }
    }
}
