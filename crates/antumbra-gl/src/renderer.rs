//! The renderer: a guest in the host's OpenGL.

use crate::frame::{Frame, Light, Surface};
use crate::host_target::{OtherBuffers, refuse_feedback};
use crate::pairs::{BATCH_LIGHTS, GROUP_LIGHTS, PairBuilder, Vertex};
use crate::resources::{Target, TargetFormat, Upload};
use crate::shader::{PROGRAMS, Program, ProgramId, Variant};
use crate::state::{Blend, StateGuard};
use crate::view::View;
use crate::{Caps, Error, lights};
use glow::HasContext;
use std::sync::Arc;

/// Uploads in flight, so that a batch does not wait for the one before it to be drawn.
const UPLOADS: usize = 3;

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
    /// Of each variant that has been used, the programs by [`ProgramId`].
    programs: [Vec<Program>; Variant::COUNT],
    uploads: Vec<Upload>,
    next_upload: usize,
    visibility: [Option<Target>; BATCH_LIGHTS / GROUP_LIGHTS],
    taken: Option<Target>,
    all: Option<Target>,
    pairs: PairBuilder,
    light_data: lights::LightData,
    stats: Stats,
}

/// What the last frame did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Pairs of light and occluder.
    pub pairs: usize,
    /// Bounding polygons drawn for them; pairs out of sight draw none.
    pub polygons: usize,
    /// Batches of lights.
    pub batches: usize,
}

/// How the host's pixels encode radiance, for [`Renderer::overlay`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    /// Pixels are linear: float targets, or sRGB targets with `GL_FRAMEBUFFER_SRGB`. Exact.
    Linear,
    /// The host wrote radiance^(1/gamma): 2.2 for most hosts that encode in their shader. Exact
    /// for a power curve, close for sRGB's.
    Gamma(f32),
}

/// The visibility of up to [`BATCH_LIGHTS`] lights, for the host's own lighting.
#[derive(Clone, Copy, Debug)]
pub struct MaskBatch {
    /// Index in [`Frame::lights`] of the first light.
    pub first_light: usize,
    /// How many lights.
    pub lights: usize,
    /// `RGBA8` textures: light `first_light + i` is channel `i % 4` of texture `i / 4`. One texel
    /// a pixel of the viewport (`texelFetch` with window position minus the viewport's corner),
    /// 1 where the light arrives; multisampled if the surface is. They hold what *cast* shadows
    /// leave: where the surface faces away from the light, it is the host's n·l that is zero.
    pub textures: [glow::Texture; BATCH_LIGHTS / GROUP_LIGHTS],
}

impl Renderer {
    /// Makes the OpenGL objects that do not depend on the frame.
    ///
    /// # Errors
    /// [`Error::TooOld`], [`Error::Resource`].
    pub fn new(gl: Arc<glow::Context>) -> Result<Self, Error> {
        let caps = Caps::query(&gl)?;
        let mut renderer = Self {
            gl: gl.clone(),
            caps,
            programs: Default::default(),
            uploads: Vec::new(),
            next_upload: 0,
            visibility: [None, None],
            taken: None,
            all: None,
            pairs: PairBuilder::default(),
            light_data: lights::LightData::default(),
            stats: Stats::default(),
        };
        let _guard = StateGuard::new(&gl, caps);
        for _ in 0..UPLOADS {
            // SAFETY: the guard is alive.
            renderer.uploads.push(unsafe { Upload::new(&gl, size_of::<Vertex>() as i32)? });
        }
        Ok(renderer)
    }

    /// Compiles the shaders for surfaces like this one, unless it was done: the first frame with
    /// such a surface does it otherwise.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for surfaces this context cannot read, [`Error::Shader`].
    pub fn warm_up(&mut self, surface: &Surface) -> Result<(), Error> {
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
        let programs = &mut self.programs[variant.index()];
        while programs.len() < PROGRAMS.len() {
            programs.push(Program::new(&self.gl, &self.caps, &PROGRAMS[programs.len()], variant)?);
        }
        Ok(())
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
    /// (Σ V E + ambient) / (Σ E + ambient): what a diffuse host would have drawn with shadows.
    /// The framebuffer's other colour buffers are left alone.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Unsupported`], [`Error::SurfaceAttached`],
    /// [`Error::Resource`]. The picture is then untouched.
    pub fn overlay(&mut self, frame: &Frame<'_>, encoding: Encoding) -> Result<(), Error> {
        let gamma = match encoding {
            Encoding::Linear => 1.0,
            Encoding::Gamma(gamma) if gamma.is_finite() && gamma > 0.0 => gamma,
            Encoding::Gamma(_) => return Err(Error::BadFrame("the encoding's gamma is not positive")),
        };
        let view = View::new(frame, &self.caps)?;
        if frame.lights.len() > BATCH_LIGHTS && !self.caps.float_targets() {
            return Err(Error::Unsupported {
                what: "an overlay of more than 8 lights",
                needs: "floating-point render targets (EXT_color_buffer_float), or masks",
            });
        }
        let gl = self.gl.clone();
        let guard = StateGuard::new(&gl, self.caps);
        // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches for
        // the textures of the surface.
        unsafe {
            refuse_feedback(&gl, guard.host_framebuffer(), &frame.surface, self.caps)?;
            self.prepare(frame, &view)?;
            let one_batch = frame.lights.len() <= BATCH_LIGHTS;
            let size = (view.viewport[2], view.viewport[3]);
            if !one_batch {
                for slot in [&mut self.taken, &mut self.all] {
                    Target::ensure(slot, &gl, TargetFormat::Rgba32F, size, frame.surface.samples)?;
                    let target = slot.as_ref().expect("made above");
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                    gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
                }
            }
            for lights in frame.lights.chunks(BATCH_LIGHTS) {
                self.draw_visibility(lights, &view, &frame.surface)?;
                if !self.pairs.draws.is_empty() {
                    let pass = if one_batch { ProgramId::Overlay } else { ProgramId::Taken };
                    self.draw_screen(pass, lights, frame, &view, gamma, &guard);
                }
            }
            if !one_batch && self.stats.polygons > 0 {
                self.pairs.pack_frame_tiles();
                self.upload()?;
                for lights in frame.lights.chunks(BATCH_LIGHTS) {
                    self.draw_screen(ProgramId::All, lights, frame, &view, gamma, &guard);
                }
                self.draw_screen(ProgramId::Ratio, &[], frame, &view, gamma, &guard);
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
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Unsupported`], [`Error::Resource`].
    pub fn masks(&mut self, frame: &Frame<'_>, mut shade: impl FnMut(&MaskBatch)) -> Result<(), Error> {
        let view = View::new(frame, &self.caps)?;
        let gl = self.gl.clone();
        for (i, lights) in frame.lights.chunks(BATCH_LIGHTS).enumerate() {
            let guard = StateGuard::new(&gl, self.caps);
            // SAFETY: the guard is alive, the frame was checked, and whoever calls this vouches
            // for the textures of the surface.
            unsafe {
                if i == 0 {
                    self.prepare(frame, &view)?;
                }
                self.draw_visibility(lights, &view, &frame.surface)?;
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

    /// Targets of the frame's size, occluders in its view space.
    ///
    /// # Safety
    /// A [`StateGuard`] is alive.
    unsafe fn prepare(&mut self, frame: &Frame<'_>, view: &View) -> Result<(), Error> {
        self.warm_up(&frame.surface)?;
        let size = (view.viewport[2], view.viewport[3]);
        for slot in &mut self.visibility {
            // SAFETY: the caller's.
            unsafe { Target::ensure(slot, &self.gl, TargetFormat::Rgba8, size, frame.surface.samples)? };
        }
        self.pairs.begin(frame.occluders, frame.bounds, view);
        self.stats = Stats::default();
        Ok(())
    }

    /// Draws the visibility of one batch of lights.
    ///
    /// # Safety
    /// A [`StateGuard`] is alive, [`Self::prepare`] was called, the surface's textures exist.
    unsafe fn draw_visibility(
        &mut self,
        lights: &[Light],
        view: &View,
        surface: &Surface,
    ) -> Result<(), Error> {
        self.pairs.pack(lights, view);
        self.stats.batches += 1;
        (self.stats.pairs, self.stats.polygons) = self.pairs.counts;
        // SAFETY: the caller's.
        unsafe {
            if !self.pairs.draws.is_empty() {
                self.upload()?;
            }
            let gl = &self.gl;
            gl.viewport(0, 0, view.viewport[2], view.viewport[3]);
            Blend::Min.apply(gl, self.caps);
            let programs = &self.programs[Variant::of(surface).index()];
            for (group, target) in self.visibility.iter().flatten().enumerate() {
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
                for draw in self.pairs.draws.iter().filter(|draw| draw.group == group) {
                    let program = &programs[draw.program as usize];
                    gl.use_program(Some(program.raw));
                    gl.uniform_1_i32(program.uniforms.blockers.as_ref(), 3);
                    set_surface(gl, program, view, surface, [view.viewport[0], view.viewport[1]]);
                    gl.draw_arrays(glow::TRIANGLES, draw.first, draw.count);
                }
            }
        }
        Ok(())
    }

    /// Uploads what was packed, and binds its vertices, and its blockers to unit 3.
    ///
    /// # Safety
    /// A [`StateGuard`] is alive.
    unsafe fn upload(&mut self) -> Result<(), Error> {
        let vertices = bytemuck::cast_slice(&self.pairs.vertices);
        // SAFETY: the caller's.
        unsafe {
            // All grow together, so that none has to in a later frame.
            for upload in &mut self.uploads {
                upload.reserve(&self.gl, &self.caps, vertices.len(), self.pairs.texels.len())?;
            }
            let upload = &self.uploads[self.next_upload];
            self.next_upload = (self.next_upload + 1) % UPLOADS;
            upload.fill(&self.gl, vertices, &mut self.pairs.texels);
            self.gl.bind_vertex_array(Some(upload.vertex_array));
            bind_texture(&self.gl, 3, 1, upload.texture);
        }
        Ok(())
    }

    /// Draws one of the passes over the tiles that shadows touch.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn draw_screen(
        &mut self,
        pass: ProgramId,
        lights: &[Light],
        frame: &Frame<'_>,
        view: &View,
        gamma: f32,
        guard: &StateGuard<'_>,
    ) {
        let gl = &self.gl;
        let samples = frame.surface.samples;
        let program = &self.programs[Variant::of(&frame.surface).index()][pass as usize];
        let [x, y, width, height] = view.viewport;
        let own_target = match pass {
            ProgramId::Taken => self.taken.as_ref(),
            ProgramId::All => self.all.as_ref(),
            _ => None,
        };
        // The host's framebuffer has the viewport's corner at (x, y), antumbra's own at (0, 0).
        let (framebuffer, corner, surface_offset, visibility_offset) = match own_target {
            Some(target) => (Some(target.framebuffer), [0, 0], [x, y], [0, 0]),
            None => (guard.host_framebuffer(), [x, y], [0, 0], [-x, -y]),
        };
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer);
            gl.viewport(corner[0], corner[1], width, height);
            let blend = if own_target.is_some() { Blend::Add } else { Blend::Multiply };
            blend.apply(gl, self.caps);
            gl.use_program(Some(program.raw));
            set_surface(gl, program, view, &frame.surface, surface_offset);
            let u = &program.uniforms;
            let inputs = match pass {
                ProgramId::All => [(&u.taken, &self.taken), (&u.all, &None)],
                ProgramId::Ratio => [(&u.taken, &self.taken), (&u.all, &self.all)],
                _ => [(&u.visibility_0, &self.visibility[0]), (&u.visibility_1, &self.visibility[1])],
            };
            for (unit, (location, target)) in (3..).zip(inputs) {
                if let Some(target) = target {
                    gl.uniform_1_i32(location.as_ref(), unit);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
            }
            gl.uniform_2_i32(u.visibility_offset.as_ref(), visibility_offset[0], visibility_offset[1]);
            gl.uniform_3_f32_slice(u.ambient.as_ref(), &frame.ambient.to_array());
            gl.uniform_1_f32(u.gamma.as_ref(), gamma);
            if !lights.is_empty() {
                let data = self.light_data.pack(lights, view);
                gl.uniform_4_f32_slice(u.lights.as_ref(), bytemuck::cast_slice(data));
                gl.uniform_1_i32(u.light_count.as_ref(), lights.len() as i32);
            }
            let others = if own_target.is_none() {
                OtherBuffers::leave_alone(gl, self.caps, framebuffer)
            } else {
                None
            };
            let (first, count) = self.pairs.screen_draw;
            gl.draw_arrays(glow::TRIANGLES, first, count);
            if let Some(others) = others {
                others.restore(gl);
            }
        }
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        let gl = &self.gl;
        // SAFETY: the objects are this renderer's own and not used afterwards; the context is
        // current, as the type's documentation demands.
        unsafe {
            self.programs.iter().flatten().for_each(|p| gl.delete_program(p.raw));
            self.uploads.iter().for_each(|upload| upload.delete(gl));
            let targets = self.visibility.iter_mut().chain([&mut self.taken, &mut self.all]);
            targets.filter_map(Option::take).for_each(|target| target.delete(gl));
        }
    }
}

/// # Safety
/// A [`StateGuard`] is alive; the texture has that many samples.
unsafe fn bind_texture(gl: &glow::Context, unit: u32, samples: u32, texture: glow::Texture) {
    // SAFETY: the caller's.
    unsafe {
        gl.active_texture(glow::TEXTURE0 + unit);
        let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
        gl.bind_texture(kind, Some(texture));
    }
}

/// Binds the surface's textures to units 0 to 2 and sets what surface.glsl reads.
///
/// # Safety
/// A [`StateGuard`] is alive, `program` is in use, the surface's textures exist.
unsafe fn set_surface(
    gl: &glow::Context,
    program: &Program,
    view: &View,
    surface: &Surface,
    offset: [i32; 2],
) {
    let u = &program.uniforms;
    let [x, y, width, height] = view.viewport;
    // SAFETY: the caller's.
    unsafe {
        for (unit, (location, texture)) in [
            (&u.depth, Some(surface.depth)),
            (&u.normals, surface.normals.map(|n| n.texture)),
            (&u.ids, surface.ids),
        ]
        .into_iter()
        .enumerate()
        {
            // Samplers of different types may not share a unit, read or not.
            gl.uniform_1_i32(location.as_ref(), unit as i32);
            if let Some(texture) = texture {
                bind_texture(gl, unit as u32, surface.samples, texture);
            }
        }
        gl.uniform_matrix_4_f32_slice(u.unproject.as_ref(), false, &view.unproject.to_cols_array());
        gl.uniform_4_f32_slice(u.pixel_step.as_ref(), &view.pixel_step);
        gl.uniform_3_f32_slice(u.background_depth.as_ref(), &view.background_depth);
        gl.uniform_2_i32(u.surface_offset.as_ref(), offset[0], offset[1]);
        gl.uniform_4_i32(u.surface_range.as_ref(), x, y, x + width - 1, y + height - 1);
        gl.uniform_matrix_3_f32_slice(u.normal_to_view.as_ref(), false, &view.normal_to_view.to_cols_array());
        gl.uniform_2_f32_slice(u.normal_decode.as_ref(), &view.normal_decode);
    }
}
