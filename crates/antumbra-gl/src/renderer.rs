//! The renderer: a guest in the host's OpenGL.

#[cfg(not(target_arch = "wasm32"))]
mod attachment;
mod batches;
mod depth_map;
mod drawing;
mod overlay;
mod plan;
mod surface;

pub use batches::MaskBatches;

#[cfg(not(target_arch = "wasm32"))]
use crate::gl::load;
use crate::gl::{Caps, DepthCopy, StateGuard};
use crate::input::{Error, HostState, Light, Soft, Surface};
use crate::masks::{Masks, Overlay, Points, Sampler, Stats};
use crate::screen::TileGrid;
use crate::technique::{Methods, Technique};
use plan::{Manner, Programs};
use std::fmt;
use std::sync::Arc;

/// Adds shadows to what a host has drawn.
///
/// The first frame compiles the shaders for its kind of surface ([`Renderer::warm_up`] does it
/// before); later frames compile nothing, and allocate nothing while the viewport stays and no more
/// pairs of light and occluder come into sight than before. Memory does not depend on the number of
/// lights. Every piece of OpenGL state is left as it was found, or as [`HostState`] says.
///
/// The context the renderer was made in must be current in every call and when it is dropped, which deletes its OpenGL
/// objects. Where that is so it may be sent from one thread to another.
pub struct Renderer {
    gl: Arc<glow::Context>,
    manner: Manner,
    host_state: HostState,
    methods: Methods,
    masks: Masks,
    overlay: Overlay,
    /// The host's depth, where it is copied.
    depth_copy: DepthCopy,
    /// Made when lights are first sampled.
    sampler: Option<Sampler>,
    /// What stands for the frame's lights where they are sampled.
    points: Points,
    /// Memory of the check.
    centers: Vec<Light>,
    /// The tiles that shadows touch in the frame.
    frame_tiles: TileGrid,
    stats: Stats,
}

impl fmt::Debug for Renderer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Renderer")
            .field("technique", &self.manner.technique)
            .field("soft", &self.manner.soft)
            .field("caps", &self.manner.caps)
            .finish_non_exhaustive()
    }
}

impl Renderer {
    /// A renderer of the technique `analytic` in the context that is current on this thread, for hosts with any OpenGL
    /// bindings or none: `loader` finds OpenGL's functions by their names, as `eglGetProcAddress`, `glfwGetProcAddress` and
    /// `SDL_GL_GetProcAddress` do; null stands for those that it does not find. A loader that finds extensions alone, as
    /// `wglGetProcAddress` does, has to look in the system's library for the others, and answers null in place of the
    /// small numbers that `wglGetProcAddress` returns for failure.
    ///
    /// # Errors
    /// [`Error::NoContext`] for a loader that does not find the functions of OpenGL or finds them without a current
    /// context, [`Error::TooOld`], [`Error::Resource`].
    ///
    /// # Safety
    /// What `loader` returns are functions of those names of the current context's OpenGL, or null. The context is current
    /// whenever the renderer is called and when it is dropped.
    #[cfg(not(target_arch = "wasm32"))]
    pub unsafe fn from_loader(loader: impl FnMut(&str) -> *const std::ffi::c_void) -> Result<Self, Error> {
        // SAFETY: the caller's.
        Self::new(Arc::new(unsafe { load::context(loader)? }))
    }

    /// The same for a context that glow 0.17 knows.
    ///
    /// # Errors
    /// [`Error::TooOld`], [`Error::Resource`].
    pub fn new(gl: Arc<glow::Context>) -> Result<Self, Error> {
        let caps = Caps::query(&gl)?;
        let host_state = HostState::default();
        let (manner, mut methods) =
            (Manner { technique: Technique::default(), soft: Soft::Native, caps }, Methods::default());
        let overlay = {
            let _guard = StateGuard::new(&gl, caps, host_state);
            // SAFETY: the guard is alive; what was made is deleted if the next cannot be.
            unsafe {
                let mut overlay = Overlay::new(&gl)?;
                if let Err(error) = methods.choose(&manner.technique, &gl, &caps) {
                    overlay.delete(&gl);
                    return Err(error);
                }
                overlay
            }
        };
        Ok(Self {
            gl,
            manner,
            host_state,
            methods,
            masks: Masks::default(),
            overlay,
            depth_copy: DepthCopy::default(),
            sampler: None,
            points: Points::default(),
            centers: Vec::new(),
            frame_tiles: TileGrid::default(),
            stats: Stats::default(),
        })
    }

    /// Finds shadows in another way from the next frame on. What earlier techniques have made and compiled is
    /// kept, so that changing back is free.
    ///
    /// ```no_run
    /// # fn f(mut shadows: antumbra_gl::Renderer) -> Result<(), antumbra_gl::Error> {
    /// use antumbra_gl::{Technique, technique::analytic::Quality};
    /// shadows.set_technique(Technique::analytic().quality(Quality::Exact))?;
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`Error::Resource`]; the technique is then the one it was.
    pub fn set_technique(&mut self, technique: impl Into<Technique>) -> Result<(), Error> {
        let technique = technique.into();
        let _guard = StateGuard::new(&self.gl, self.manner.caps, self.host_state);
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

    /// Does something else about the host's OpenGL state from the next call on.
    pub fn set_host_state(&mut self, host_state: HostState) {
        self.host_state = host_state;
    }

    /// What is done about the host's OpenGL state.
    pub fn host_state(&self) -> HostState {
        self.host_state
    }

    /// Compiles the shaders for surfaces and lights like these, unless it was done: the first frame with
    /// such a surface, and such kinds of light, does it otherwise.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for surfaces this context cannot read, [`Error::Shader`].
    pub fn warm_up(&mut self, surface: &Surface, lights: &[Light]) -> Result<(), Error> {
        plan::check_surface(surface, &self.manner.caps)?;
        let gl = self.gl.clone();
        let _guard = StateGuard::new(&gl, self.manner.caps, self.host_state);
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
}

impl Drop for Renderer {
    fn drop(&mut self) {
        let gl = &self.gl;
        // SAFETY: the objects are this renderer's own and not used afterwards; the context is
        // current, as the type's documentation demands.
        unsafe {
            self.methods.delete(gl);
            self.overlay.delete(gl);
            self.depth_copy.delete(gl);
            if let Some(sampler) = &mut self.sampler {
                sampler.delete(gl);
            }
            self.masks.delete(gl);
        }
    }
}

/// Hosts keep a renderer where threads may meet: in a mutex that a callback locks.
#[cfg(not(target_arch = "wasm32"))]
const _: () = {
    const fn is_send<T: Send>() {}
    is_send::<Renderer>();
};
