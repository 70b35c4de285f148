//! What a technique is to the renderer: how it draws, and what it does out of the ordinary.

use super::options::Options;
use crate::gl::{Caps, Drawing, Program};
use crate::input::{Error, Light};
use crate::masks::{Batch, Counts, DepthMap, HostPicture};
use crate::screen::TileGrid;
use std::ops::Deref;

/// One frame, as the methods see it: lights that are drawn as points are points here.
pub(crate) struct Pass<'a> {
    drawing: Drawing<'a>,
    /// The technique's programs for the frame's surface, in the order of its list.
    programs: &'a [Option<Program>],
}

impl<'a> Pass<'a> {
    pub(crate) fn new(drawing: Drawing<'a>, programs: &'a [Option<Program>]) -> Self {
        Self { drawing, programs }
    }

    /// A program of the technique's list.
    pub(crate) fn program(&self, index: usize) -> &Program {
        self.programs[index].as_ref().expect("compiled for the frame")
    }

    /// Uses a program of the technique's list and gives it the host's surface: `offset` leads from the pixels of
    /// the target that is drawn to to the surface's texels. Takes units 0 to 2; 3 and 4 are the technique's.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    pub(crate) unsafe fn use_program(&self, index: usize, offset: [i32; 2]) -> &Program {
        let program = self.program(index);
        // SAFETY: the caller's.
        unsafe { self.drawing.use_program(program, offset) };
        program
    }
}

impl<'a> Deref for Pass<'a> {
    type Target = Drawing<'a>;

    fn deref(&self) -> &Drawing<'a> {
        &self.drawing
    }
}

/// What a technique with its options does out of the ordinary: its `Options` answer.
pub(crate) trait Behavior {
    /// See [`super::Technique::paints`]; if so, [`Method::painter`] has a painter.
    fn paints(&self) -> bool {
        false
    }

    /// See [`super::Technique::components`].
    fn components(&self) -> Option<u32> {
        None
    }

    /// Whether [`Method::draw_map`] has maps to draw.
    fn has_maps(&self) -> bool {
        false
    }

    /// Whether it looks at several occluders of an area light at once, with the programs of [`When::exactly`].
    ///
    /// [`When::exactly`]: crate::gl::When::exactly
    fn is_exact(&self) -> bool {
        false
    }
}

/// A [`Method`] as the list of techniques makes it.
pub(crate) trait Make: Method + Sized {
    /// The technique's options.
    type Options: Options;

    /// Makes the OpenGL objects that do not depend on the frame.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    unsafe fn make(gl: &glow::Context, caps: &Caps, options: Self::Options) -> Result<Self, Error>;

    /// Draws with these options from the next frame on.
    fn set_options(&mut self, options: Self::Options);
}

/// How a technique draws. One object serves frame after frame.
pub(crate) trait Method {
    /// Prepares a frame that the technique does not refuse.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, and the frame was checked.
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error>;

    /// Draws the visibility of some of the frame's lights. State that the guard does not keep (see
    /// [`crate::gl::RasterGuard`]) is left as it was found.
    ///
    /// # Safety
    /// As for [`Self::begin`], which was called for this frame.
    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error>;

    /// For techniques that paint shadows over the host's pixels instead of taking light from them.
    fn painter(&mut self) -> Option<&mut dyn Painter> {
        None
    }

    /// For techniques with shadow maps: draws the map of a light as [`Self::draw_visibility`] does, which may draw
    /// another over it. `None` if nothing in sight is in the light's shadow.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn draw_map(&mut self, _pass: &Pass<'_>, _light: &Light) -> Result<Option<DepthMap>, Error> {
        Ok(None)
    }

    /// What was done since [`Self::begin`].
    fn counts(&self) -> Counts;

    /// Deletes the OpenGL objects.
    ///
    /// # Safety
    /// The context is current, and the object is not used afterwards.
    unsafe fn delete(&mut self, gl: &glow::Context);
}

/// Paints shadows over the host's pixels.
pub(crate) trait Painter {
    /// Paints the shadows of all lights, and touches the tiles it may paint in, none of which is touched.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`]; the host's framebuffer is bound for drawing, with its first colour
    /// buffer alone, and the viewport is set.
    unsafe fn paint(&mut self, pass: &Pass<'_>, host: HostPicture, tiles: &mut TileGrid)
    -> Result<(), Error>;
}
