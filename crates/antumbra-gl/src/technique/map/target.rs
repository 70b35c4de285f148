//! The texture that every light's map is drawn to in turn.

use crate::gl::{Caps, texture_storage};
use crate::input::{Error, Resource, Unsupported};
use glam::DVec2;
use glow::HasContext;

/// A depth texture of one to six square tiles. It grows to the largest number of tiles that a light has needed.
#[derive(Default)]
pub(super) struct MapTarget {
    made: Option<(glow::Texture, glow::Framebuffer)>,
    /// Side of a tile, and columns and rows.
    key: (u32, u32, u32),
}

impl MapTarget {
    /// Makes room for so many tiles, 1 to 6.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive: bindings are changed.
    pub(super) unsafe fn ensure(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        size: u32,
        tiles: u32,
    ) -> Result<(), Error> {
        let (side, columns, rows) = self.key;
        if self.made.is_some() && side == size && columns * rows >= tiles {
            return Ok(());
        }
        // SAFETY: the caller's; what is made is deleted if the next cannot be.
        unsafe {
            self.delete(gl);
            let fits = |(columns, rows): &(u32, u32)| size * columns.max(rows) <= caps.max_texture_size;
            let shapes: &[(u32, u32)] = match tiles {
                0 | 1 => &[(1, 1)],
                2 => &[(2, 1)],
                3 => &[(3, 1), (2, 2)],
                _ => &[(3, 2)],
            };
            let Some(&(columns, rows)) = shapes.iter().find(|shape| fits(shape)) else {
                return Err(Error::Unsupported(Unsupported::LargeMaps));
            };
            let (width, height) = (size * columns, size * rows);
            let refused = || Error::Resource(Resource::ShadowMap { width, height });
            let texture = gl.create_texture().map_err(|_| refused())?;
            let Ok(framebuffer) = gl.create_framebuffer() else {
                gl.delete_texture(texture);
                return Err(refused());
            };
            self.made = Some((texture, framebuffer));
            gl.active_texture(glow::TEXTURE3);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            // Texels are fetched and compared in the shader, each with a depth of its own.
            texture_storage(gl, glow::DEPTH_COMPONENT32F, width as i32, height as i32);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(framebuffer));
            gl.framebuffer_texture_2d(
                glow::DRAW_FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                glow::TEXTURE_2D,
                Some(texture),
                0,
            );
            gl.draw_buffers(&[glow::NONE]);
            if gl.check_framebuffer_status(glow::DRAW_FRAMEBUFFER) != glow::FRAMEBUFFER_COMPLETE {
                self.delete(gl);
                return Err(refused());
            }
            self.key = (size, columns, rows);
        }
        Ok(())
    }

    /// The first texel of a tile.
    pub(super) fn corner(&self, tile: u32) -> DVec2 {
        let (side, columns, _) = self.key;
        let columns = columns.max(1);
        DVec2::new(f64::from(tile % columns * side), f64::from(tile / columns * side))
    }

    /// Width and height, texels.
    pub(super) fn size(&self) -> [u32; 2] {
        let (side, columns, rows) = self.key;
        [side * columns, side * rows]
    }

    /// The texture and the framebuffer that draws to it, after [`Self::ensure`].
    pub(super) fn objects(&self) -> Option<(glow::Texture, glow::Framebuffer)> {
        self.made
    }

    /// # Safety
    /// The context is current.
    pub(super) unsafe fn delete(&mut self, gl: &glow::Context) {
        if let Some((texture, framebuffer)) = self.made.take() {
            // SAFETY: the caller's; they are forgotten here.
            unsafe {
                gl.delete_framebuffer(framebuffer);
                gl.delete_texture(texture);
            }
        }
    }
}
