//! The lights whose visibility is drawn at once, and where it goes.

use crate::gl::{Drawing, Target, TargetFormat};
use crate::input::{Error, Light};
use crate::screen::TileGrid;
use glow::HasContext;

/// Lights in one batch: two RGBA targets, a channel a light.
pub const BATCH_LIGHTS: usize = 8;

/// Lights in one RGBA target.
pub(crate) const GROUP_LIGHTS: usize = 4;

/// Up to [`BATCH_LIGHTS`] lights whose visibility is drawn at once.
pub(crate) struct Batch<'a> {
    pub(crate) lights: &'a [Light],
    /// The channels they go to: two targets of four, cleared to 1, as large as the viewport.
    pub(crate) masks: [&'a Target; BATCH_LIGHTS / GROUP_LIGHTS],
    /// Where the masks may differ from 1: what draws touches these tiles, and no others are looked at.
    pub(crate) tiles: &'a mut TileGrid,
}

/// The targets of a batch and the tiles that shadows touch in them.
#[derive(Default)]
pub(crate) struct Masks {
    targets: [Option<Target>; BATCH_LIGHTS / GROUP_LIGHTS],
    /// In the batch at hand.
    pub(crate) tiles: TileGrid,
}

impl Masks {
    /// Makes room for a frame of this format.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn ensure(&mut self, drawing: &Drawing<'_>, format: TargetFormat) -> Result<(), Error> {
        for slot in &mut self.targets {
            // SAFETY: the caller's.
            unsafe { drawing.ensure_target(slot, format)? };
        }
        Ok(())
    }

    /// The targets, after [`Self::ensure`].
    pub(crate) fn targets(&self) -> [&Target; BATCH_LIGHTS / GROUP_LIGHTS] {
        self.targets.each_ref().map(|target| target.as_ref().expect("ensure has made it"))
    }

    /// Clears the targets to 1 and the tiles, and makes a batch of the lights.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, and [`Self::ensure`] was called for the frame.
    pub(crate) unsafe fn begin<'a>(&'a mut self, drawing: &Drawing<'_>, lights: &'a [Light]) -> Batch<'a> {
        self.tiles.reset(drawing.view.size());
        let masks = self.targets.each_ref().map(|target| target.as_ref().expect("ensure has made it"));
        // SAFETY: the caller's.
        unsafe {
            clear(drawing, masks);
        }
        Batch { lights, masks, tiles: &mut self.tiles }
    }

    /// # Safety
    /// The context is current, and the masks are not used afterwards.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        self.targets.iter_mut().filter_map(Option::take).for_each(|target| unsafe { target.delete(gl) });
    }
}

/// Sets the viewport that covers a batch's targets, and clears them to 1.
///
/// # Safety
/// A [`crate::gl::StateGuard`] is alive.
pub(super) unsafe fn clear(drawing: &Drawing<'_>, masks: [&Target; BATCH_LIGHTS / GROUP_LIGHTS]) {
    let (gl, [.., width, height]) = (drawing.gl, drawing.view.viewport);
    // SAFETY: the caller's.
    unsafe {
        gl.viewport(0, 0, width, height);
        for target in masks {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
        }
    }
}
