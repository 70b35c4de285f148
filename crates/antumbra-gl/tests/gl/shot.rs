//! What a host has drawn of a world: its textures, and the target its shadows go to.

use crate::context::Gl;
use crate::world::World;
use antumbra_gl::{
    Camera, DepthFormat, Encoding, Error, Frame, MaskBatch, NO_SHADOW, NormalSpace, Normals, Renderer,
    Surface, Technique, Texture,
};
use antumbra_reference::Surface as Seen;
use bytemuck::Pod;
use glam::DMat3;
use glow::{HasContext, PixelPackData, PixelUnpackData};
use std::sync::Arc;

/// A viewport in the corner of its textures.
pub(crate) const VIEWPORT: [i32; 4] = [0, 0, 160, 120];

/// Depth, normals and ids as a host has them.
pub(crate) struct Shot<'w> {
    gl: Arc<glow::Context>,
    world: &'w World,
    pub(crate) camera: Camera,
    pub(crate) viewport: [i32; 4],
    pub(crate) format: DepthFormat,
    pub(crate) depth: glow::Texture,
    /// View space.
    pub(crate) normals: glow::Texture,
    pub(crate) ids: glow::Texture,
    /// Of the viewport, rows from bottom to top.
    pub(crate) seen: Vec<Option<Seen>>,
}

impl<'w> Shot<'w> {
    /// The world's own camera and the usual depth buffer.
    pub(crate) fn new(gl: &Gl, world: &'w World) -> Self {
        Self::with(gl, world, world.camera(VIEWPORT), VIEWPORT, DepthFormat::default())
    }

    /// Any camera; a depth buffer of 16 or 24 bits, or of floats if it is reversed. Outside the viewport there is depth too: nonsense.
    pub(crate) fn with(
        gl: &Gl,
        world: &'w World,
        camera: Camera,
        viewport: [i32; 4],
        format: DepthFormat,
    ) -> Self {
        let seen = world.see(&camera, viewport);
        let [x, y, width, height] = viewport;
        let (all_width, all_height) = (x + width + x.min(7), y + height + y.min(5));
        let texels = (all_width * all_height) as usize;
        let (mut depth, mut normals, mut ids) =
            (vec![0.3f64; texels], vec![[0.7f32; 4]; texels], vec![77u32; texels]);
        let to_view = DMat3::from_mat4(camera.view);
        for (i, seen) in seen.iter().enumerate() {
            let (px, py) = (i as i32 % width, i as i32 / width);
            let texel = ((y + py) * all_width + x + px) as usize;
            (depth[texel], normals[texel], ids[texel]) = match seen {
                None => (format.background.into(), [0.0; 4], 0),
                Some(s) => {
                    let clip = camera.projection * camera.view * s.point.extend(1.0);
                    let z = clip.z / clip.w;
                    let depth = if format.zero_to_one { z } else { z * 0.5 + 0.5 };
                    let receives = world.receives[s.primitive as usize];
                    let id = (s.primitive + 1) | if receives { 0 } else { NO_SHADOW };
                    let n = (to_view * s.normal).as_vec3();
                    (depth, n.extend(0.0).to_array(), id)
                }
            };
        }
        let size = [all_width, all_height];
        Self {
            gl: gl.gl.clone(),
            world,
            camera,
            viewport,
            format,
            depth: depth_texture(&gl.gl, size, &format, &depth),
            normals: texture(&gl.gl, size, [glow::RGBA32F, glow::RGBA, glow::FLOAT], &normals),
            ids: texture(&gl.gl, size, [glow::R32UI, glow::RED_INTEGER, glow::UNSIGNED_INT], &ids),
            seen,
        }
    }

    /// With normals and ids.
    pub(crate) fn frame(&self) -> Frame<'w> {
        let surface = Surface::from_depth(known(self.depth))
            .with_format(self.format)
            .with_normals(Normals::new(known(self.normals), NormalSpace::View))
            .with_ids(known(self.ids));
        Frame::new(self.camera, self.viewport, surface)
            .lights(&self.world.lights)
            .occluders(&self.world.occluders)
            .meshes(&self.world.meshes)
            .receivers(&self.world.receivers)
            .ambient(self.world.ambient)
    }

    /// The techniques that can do a frame, with their default options; but maps are small, because software draws
    /// them, and what is asked of these techniques does not depend on it.
    pub(crate) fn able(frame: &Frame<'_>) -> Vec<Technique> {
        let able = Technique::all().filter(|t| t.refusal(&frame.scenery()).is_none());
        let able: Vec<_> = able
            .map(|mut technique| {
                if let Technique::Map(options) = &mut technique {
                    options.size = 64;
                }
                technique
            })
            .collect();
        let names: Vec<&str> = able.iter().map(Technique::name).collect();
        let most = ["analytic", "projected", "volume", "map"];
        assert!(most.iter().all(|name| names.contains(name)), "all that need no single plane: {names:?}");
        able
    }

    /// Masks of all lights, a byte a pixel; as many vectors as lights.
    pub(crate) fn masks(&self, renderer: &mut Renderer, frame: &Frame<'_>) -> Vec<Vec<u8>> {
        let mut masks: Vec<Vec<u8>> = Vec::new();
        let [_, _, width, height] = frame.viewport;
        let read = |batch: &MaskBatch| {
            assert_eq!(batch.first_light, masks.len(), "batches come in order");
            let textures =
                batch.textures.map(|t| read_texture::<[u8; 4]>(&self.gl, t.glow(), [width, height]));
            for light in 0..batch.lights {
                masks.push(textures[light / 4].iter().map(|texel| texel[light % 4]).collect());
            }
        };
        each_batch(renderer, frame, read).expect("the frame is right");
        assert_eq!(masks.len(), frame.lights.len(), "a mask a light");
        assert!(masks.iter().all(|mask| mask.len() == (width * height) as usize), "a value a pixel");
        masks
    }
}

/// A texture of the test's.
pub(crate) fn known(texture: glow::Texture) -> Texture {
    // SAFETY: textures of tests last as long as the frames they are in.
    unsafe { Texture::from_glow(texture) }
}

/// The same surface without normals and ids.
pub(crate) fn bare(surface: &Surface) -> Surface {
    let mut bare = *surface;
    (bare.normals, bare.ids) = (None, None);
    bare
}

/// Asserts that an overlay is refused for want of render targets of floats.
pub(crate) fn assert_needs_floats(renderer: &mut Renderer, frame: &Frame<'_>) {
    let refused = renderer.overlay(frame, Encoding::Linear);
    assert!(matches!(refused, Err(Error::Unsupported(_))), "{}: {refused:?}", renderer.technique());
}

/// Asks for the masks of a frame, all of them.
pub(crate) fn each_batch(
    renderer: &mut Renderer,
    frame: &Frame<'_>,
    mut look: impl FnMut(&MaskBatch),
) -> Result<(), Error> {
    let mut batches = renderer.masks(frame)?;
    while let Some(batch) = batches.next()? {
        look(&batch);
    }
    Ok(())
}

impl Drop for Shot<'_> {
    fn drop(&mut self) {
        for texture in [self.depth, self.normals, self.ids] {
            // SAFETY: made by this shot.
            unsafe { self.gl.delete_texture(texture) };
        }
    }
}

fn depth_texture(gl: &glow::Context, size: [i32; 2], format: &DepthFormat, depth: &[f64]) -> glow::Texture {
    let layout = glow::DEPTH_COMPONENT;
    if format.background == 0.0 {
        let depth: Vec<f32> = depth.iter().map(|&d| d as f32).collect();
        texture(gl, size, [glow::DEPTH_COMPONENT32F, layout, glow::FLOAT], &depth)
    } else if format.bits == 16 {
        let depth: Vec<u32> =
            depth.iter().map(|&d| (d * f64::from(u16::MAX)).round() as u32 * 0x1_0001).collect();
        texture(gl, size, [glow::DEPTH_COMPONENT16, layout, glow::UNSIGNED_INT], &depth)
    } else {
        let depth: Vec<u32> = depth.iter().map(|&d| (d * f64::from(u32::MAX)).round() as u32).collect();
        texture(gl, size, [glow::DEPTH_COMPONENT24, layout, glow::UNSIGNED_INT], &depth)
    }
}

/// A texture for fetching; `[internal, layout, kind]` describe `texels`, one value a texel.
pub(crate) fn texture<T: Pod>(
    gl: &glow::Context,
    [width, height]: [i32; 2],
    [internal, layout, kind]: [u32; 3],
    texels: &[T],
) -> glow::Texture {
    assert_eq!(texels.len(), (width * height) as usize, "a value a texel");
    // SAFETY: the texels have the size and format that is told.
    unsafe {
        let texture = gl.create_texture().expect("a texture");
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        let data = PixelUnpackData::Slice(Some(bytemuck::cast_slice(texels)));
        gl.tex_image_2d(glow::TEXTURE_2D, 0, internal as i32, width, height, 0, layout, kind, data);
        for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, name, glow::NEAREST as i32);
        }
        gl.bind_texture(glow::TEXTURE_2D, None);
        texture
    }
}

/// The texels of a colour texture; `T` is four bytes, four floats or four unsigned integers.
pub(crate) fn read_texture<T: Pod>(gl: &glow::Context, texture: glow::Texture, size: [i32; 2]) -> Vec<T> {
    // SAFETY: the texture is of this context; the framebuffer is deleted again.
    unsafe {
        // Mesa's llvmpipe 22.3 reads what its threads have not drawn yet where another framebuffer
        // has been bound since.
        gl.finish();
        let was = gl.get_parameter_framebuffer(glow::READ_FRAMEBUFFER_BINDING);
        let framebuffer = gl.create_framebuffer().expect("a framebuffer");
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(framebuffer));
        let attachment = glow::COLOR_ATTACHMENT0;
        gl.framebuffer_texture_2d(glow::READ_FRAMEBUFFER, attachment, glow::TEXTURE_2D, Some(texture), 0);
        let pixels = read_pixels(gl, size);
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, was);
        gl.delete_framebuffer(framebuffer);
        pixels
    }
}

/// # Safety
/// A framebuffer with colour of the kind of `T` is bound for reading.
unsafe fn read_pixels<T: Pod>(gl: &glow::Context, [width, height]: [i32; 2]) -> Vec<T> {
    let mut pixels = vec![T::zeroed(); (width * height) as usize];
    let kind = if size_of::<T>() == 4 { glow::UNSIGNED_BYTE } else { glow::FLOAT };
    let data = PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut pixels)));
    // SAFETY: the caller's; the slice has the size that is read.
    unsafe { gl.read_pixels(0, 0, width, height, glow::RGBA, kind, data) };
    pixels
}

/// A host's framebuffer: RGBA8 colour textures.
pub(crate) struct Canvas {
    gl: Arc<glow::Context>,
    pub(crate) framebuffer: glow::Framebuffer,
    pub(crate) colors: Vec<glow::Texture>,
    size: [i32; 2],
}

impl Canvas {
    /// White, bound for drawing and reading, all `buffers` on.
    pub(crate) fn white(gl: &Gl, size: [i32; 2], buffers: usize) -> Self {
        let context = gl.gl.clone();
        let white = vec![[255u8; 4]; (size[0] * size[1]) as usize];
        let rgba8 = [glow::RGBA8, glow::RGBA, glow::UNSIGNED_BYTE];
        let colors: Vec<_> = (0..buffers).map(|_| texture(&context, size, rgba8, &white)).collect();
        // SAFETY: attaches the textures made above.
        let framebuffer = unsafe {
            let framebuffer = context.create_framebuffer().expect("a framebuffer");
            context.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let names: Vec<u32> = (glow::COLOR_ATTACHMENT0..).take(buffers).collect();
            for (&name, &color) in names.iter().zip(&colors) {
                context.framebuffer_texture_2d(glow::FRAMEBUFFER, name, glow::TEXTURE_2D, Some(color), 0);
            }
            context.draw_buffers(&names);
            framebuffer
        };
        Self { gl: context, framebuffer, colors, size }
    }

    /// A white canvas for one viewport of [`VIEWPORT`]'s size.
    pub(crate) fn new(gl: &Gl) -> Self {
        Self::white(gl, [VIEWPORT[2], VIEWPORT[3]], 1)
    }

    /// Rows from bottom to top.
    pub(crate) fn read(&self, buffer: usize) -> Vec<[u8; 4]> {
        read_texture(&self.gl, self.colors[buffer], self.size)
    }
}

impl Drop for Canvas {
    fn drop(&mut self) {
        // SAFETY: made by this canvas.
        unsafe {
            self.gl.delete_framebuffer(self.framebuffer);
            self.colors.iter().for_each(|&color| self.gl.delete_texture(color));
        }
    }
}
