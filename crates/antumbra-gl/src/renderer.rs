//! The renderer: a guest in the host's OpenGL.

mod depth_map;
mod drawing;
mod overlay;
mod plan;

use crate::gl::{Caps, StateGuard, refuse_feedback};
use crate::input::{Encoding, Error, Frame, Light, Soft, Surface};
use crate::masks::{BATCH_LIGHTS, HostPicture, MaskBatch, Masks, Overlay, Points, Sampler, Stats};
use crate::screen::TileGrid;
use crate::technique::{Methods, Technique};
use plan::{FramePlan, Manner, Programs, Purpose};
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
    manner: Manner,
    methods: Methods,
    masks: Masks,
    overlay: Overlay,
    /// Made when lights are first sampled.
    sampler: Option<Sampler>,
    /// What stands for the frame's lights where they are sampled.
    points: Points,
    /// For [`FramePlan::new`].
    centers: Vec<Light>,
    /// The tiles that shadows touch in the frame.
    frame_tiles: TileGrid,
    stats: Stats,
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
            manner: Manner { technique: Technique::default(), soft: Soft::Native, caps },
            methods: Methods::default(),
            masks: Masks::default(),
            overlay,
            sampler: None,
            points: Points::default(),
            centers: Vec::new(),
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
    pub fn set_technique(&mut self, technique: impl Into<Technique>) -> Result<(), Error> {
        let technique = technique.into();
        let _guard = StateGuard::new(&self.gl, self.manner.caps);
        // SAFETY: the guard is alive.
        unsafe { self.methods.choose(&technique, &self.gl, &self.manner.caps)? };
        self.manner.technique = technique;
        Ok(())
    }

    /// How shadows are found.
    pub fn technique(&self) -> Technique {
        self.manner.technique
    }

    /// Draws lights with an area in another way from the next frame on.
    pub fn set_soft(&mut self, soft: Soft) {
        self.manner.soft = soft;
    }

    /// How lights with an area are drawn.
    pub fn soft(&self) -> Soft {
        self.manner.soft
    }

    /// Compiles the shaders for surfaces and lights like these, unless it was done: the first frame with
    /// such a surface, and such kinds of light, does it otherwise.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for surfaces this context cannot read, [`Error::Shader`].
    pub fn warm_up(&mut self, surface: &Surface, lights: &[Light]) -> Result<(), Error> {
        plan::check_surface(surface, &self.manner.caps)?;
        let gl = self.gl.clone();
        let _guard = StateGuard::new(&gl, self.manner.caps);
        for paints in [true, false] {
            let sampled = plan::sampling(&self.manner, lights, paints).is_some();
            // SAFETY: the guard is alive.
            unsafe { self.compile(&Programs::new(&self.manner, surface, lights, sampled))? };
        }
        Ok(())
    }

    /// What the context can do.
    pub fn caps(&self) -> &Caps {
        &self.manner.caps
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
        encoding.check().map_err(Error::BadFrame)?;
        let plan = FramePlan::new(frame, Purpose::Overlay, &self.manner, &mut self.centers)?;
        let gl = self.gl.clone();
        let guard = StateGuard::new(&gl, self.manner.caps);
        let host = HostPicture { framebuffer: guard.host_framebuffer(), encoding };
        // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches for
        // the textures of the surface.
        unsafe {
            refuse_feedback(&gl, host.framebuffer, &frame.surface, self.manner.caps)?;
            self.prepare(&plan)?;
            match frame.lights {
                _ if plan.paints => self.paint(&plan, host),
                lights if lights.len() <= BATCH_LIGHTS => self.overlay_batch(&plan, host),
                _ => self.overlay_batches(&plan, host),
            }
        }
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
        let plan = FramePlan::new(frame, Purpose::Masks, &self.manner, &mut self.centers)?;
        let gl = self.gl.clone();
        for (i, lights) in frame.lights.chunks(BATCH_LIGHTS).enumerate() {
            let guard = StateGuard::new(&gl, self.manner.caps);
            // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches
            // for the textures of the surface.
            unsafe {
                if i == 0 {
                    self.prepare(&plan)?;
                }
                self.draw_visibility(&plan, i * BATCH_LIGHTS, lights)?;
            }
            drop(guard);
            shade(&MaskBatch {
                first_light: i * BATCH_LIGHTS,
                lights: lights.len(),
                textures: self.masks.targets().map(|target| target.texture),
            });
        }
        Ok(())
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        let gl = &self.gl;
        // SAFETY: the objects are this renderer's own and not used afterwards; the context is
        // current, as the type's documentation demands.
        unsafe {
            self.methods.delete(gl);
            self.overlay.delete(gl);
            if let Some(sampler) = &mut self.sampler {
                sampler.delete(gl);
            }
            self.masks.delete(gl);
        }
    }
}
