//! A finished picture of one side, kept until it has to be drawn anew.

use antumbra_host::HostError;
use glow::HasContext;

/// A texture and the framebuffer that draws to it.
pub(crate) struct Picture {
    pub(crate) texture: glow::Texture,
    pub(crate) framebuffer: glow::Framebuffer,
    pub(crate) size: [i32; 2],
}

impl Picture {
    /// A picture of linear colours, float16.
    ///
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// The context is current; the sizes are within its limits.
    pub(crate) unsafe fn new(gl: &glow::Context, size: [i32; 2]) -> Result<Self, HostError> {
        // SAFETY: fresh objects; no memory is read.
        unsafe {
            let texture = gl.create_texture().map_err(HostError::Driver)?;
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            let none = glow::PixelUnpackData::Slice(None);
            let (w, h) = (size[0], size[1]);
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGBA16F as i32,
                w,
                h,
                0,
                glow::RGBA,
                glow::FLOAT,
                none,
            );
            for (name, value) in [
                (glow::TEXTURE_MIN_FILTER, glow::LINEAR),
                (glow::TEXTURE_MAG_FILTER, glow::LINEAR),
                (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE),
                (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE),
            ] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, name, value as i32);
            }
            gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAX_LEVEL, 0);
            let framebuffer = gl.create_framebuffer().map_err(|error| {
                gl.delete_texture(texture);
                HostError::Driver(error)
            })?;
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let slot = glow::COLOR_ATTACHMENT0;
            gl.framebuffer_texture_2d(glow::FRAMEBUFFER, slot, glow::TEXTURE_2D, Some(texture), 0);
            Ok(Self { texture, framebuffer, size })
        }
    }

    /// The picture in a slot, of this size: made anew if it has another.
    ///
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// As [`Self::new`].
    pub(crate) unsafe fn ensure<'a>(
        slot: &'a mut Option<Self>,
        gl: &glow::Context,
        size: [i32; 2],
    ) -> Result<&'a Self, HostError> {
        // SAFETY: the caller's; a picture that is replaced is not used again.
        unsafe {
            if let Some(old) = slot.take_if(|picture| picture.size != size) {
                old.delete(gl);
            }
            match slot {
                Some(picture) => Ok(picture),
                empty => Ok(empty.insert(Self::new(gl, size)?)),
            }
        }
    }

    /// Takes the pixels of another framebuffer of the same size.
    ///
    /// # Safety
    /// `from` is a complete framebuffer of the context, of one sample and at least this size.
    pub(crate) unsafe fn copy_from(&self, gl: &glow::Context, from: glow::Framebuffer) {
        let [w, h] = self.size;
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(from));
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(self.framebuffer));
            gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, glow::COLOR_BUFFER_BIT, glow::NEAREST);
        }
    }

    /// Takes linear colours, rows from top to bottom.
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn fill(&self, gl: &glow::Context, pixels: &[[f32; 3]]) {
        let [w, h] = self.size;
        if pixels.len() != w as usize * h as usize {
            return;
        }
        let rows: Vec<[f32; 4]> =
            pixels.chunks_exact(w as usize).rev().flatten().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
        // SAFETY: the texture is of this size and format, and so is the memory.
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 4);
            let data = glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(&rows)));
            gl.tex_sub_image_2d(glow::TEXTURE_2D, 0, 0, 0, w, h, glow::RGBA, glow::FLOAT, data);
        }
    }

    /// The colours, rows from top to bottom.
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn read(&self, gl: &glow::Context) -> Vec<[f32; 3]> {
        let [w, h] = self.size;
        let mut pixels = vec![[0.0f32; 4]; w as usize * h as usize];
        // SAFETY: memory of the right size; the framebuffer is complete.
        unsafe {
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(self.framebuffer));
            gl.finish();
            gl.pixel_store_i32(glow::PACK_ALIGNMENT, 4);
            let data = glow::PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut pixels)));
            gl.read_pixels(0, 0, w, h, glow::RGBA, glow::FLOAT, data);
        }
        pixels.chunks_exact(w.max(1) as usize).rev().flatten().map(|[r, g, b, _]| [*r, *g, *b]).collect()
    }

    /// # Safety
    /// The context is current, and the picture is not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_framebuffer(self.framebuffer);
            gl.delete_texture(self.texture);
        }
    }
}
