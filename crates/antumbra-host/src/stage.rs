//! Draws a scene without shadows.

use crate::HostError;
use crate::buffers::Buffers as TriangleBuffers;
use crate::cast::Cast;
use crate::meshes::Meshes;
use crate::program::{Kind, MAX_LIGHTS, Program, Shading};
use crate::setting::Setting;
use crate::state;
use crate::targets::{ColorFormat, Targets};
use antumbra::DepthMap;
use antumbra::glam::{DMat4, DVec3, Mat3, Vec3};
use antumbra::{
    DepthFormat, Encoding, Frame, Framebuffer, NO_SHADOW, NormalSpace, Normals, ShaderLight, Soft, Surface,
    Technique, Texture,
};
use antumbra_scene::{Primitive, Scene};
use glow::HasContext;
use std::f32::consts::PI;
use std::sync::Arc;

/// The host: draws scenes plainly and keeps a shadow renderer beside it.
pub struct Stage {
    pub(crate) gl: Arc<glow::Context>,
    pub(crate) shadows: antumbra::Renderer,
    /// Without and with many samples a pixel, of each kind of shading; compiled when they are first used.
    programs: [Option<[Program; 2]>; 2 * Shading::COUNT],
    meshes: Meshes,
    triangles: TriangleBuffers,
    vertex_array: glow::VertexArray,
    lights: glow::Buffer,
    pub(crate) targets: Option<Targets>,
}

/// Which buffers the host fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buffers {
    /// Colour and depth, as a host without shadows does.
    Color,
    /// Normals and object ids too.
    All,
}

/// A picture in the context's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Linear radiance, one sample a pixel, without mipmaps; read with nearest filtering unless a sampler says otherwise.
    pub texture: glow::Texture,
    /// With the texture as its only colour buffer, and no depth.
    pub framebuffer: glow::Framebuffer,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

const ATTACHMENTS: [u32; 3] = [glow::COLOR_ATTACHMENT0, glow::COLOR_ATTACHMENT1, glow::COLOR_ATTACHMENT2];

impl Stage {
    /// Compiles the shaders of the host and of antumbra.
    ///
    /// # Errors
    /// [`HostError::Driver`], [`HostError::Shadows`].
    pub fn new(gl: &Arc<glow::Context>) -> Result<Self, HostError> {
        let shadows = antumbra::Renderer::new(gl.clone())?;
        // SAFETY: fresh objects in the current context; the buffer is as large as the block.
        unsafe {
            let lights = gl.create_buffer().map_err(HostError::Driver)?;
            gl.bind_buffer(glow::UNIFORM_BUFFER, Some(lights));
            let size = MAX_LIGHTS * size_of::<ShaderLight>();
            gl.buffer_data_size(glow::UNIFORM_BUFFER, size as i32, glow::DYNAMIC_DRAW);
            Ok(Self {
                programs: [const { None }; 2 * Shading::COUNT],
                meshes: Meshes::default(),
                triangles: TriangleBuffers::default(),
                vertex_array: gl.create_vertex_array().map_err(HostError::Driver)?,
                lights,
                targets: None,
                shadows,
                gl: gl.clone(),
            })
        }
    }

    /// Finds shadows in another way from now on.
    ///
    /// # Errors
    /// [`HostError::Shadows`] for what the driver cannot make.
    pub fn set_technique(&mut self, technique: Technique) -> Result<(), HostError> {
        Ok(self.shadows.set_technique(technique)?)
    }

    /// Draws lights with an area in another way from now on.
    pub fn set_soft(&mut self, soft: Soft) {
        self.shadows.set_soft(soft);
    }

    /// The shadow renderer.
    pub fn shadows(&self) -> &antumbra::Renderer {
        &self.shadows
    }

    /// Prepares a scene at `time`, seconds, for a picture of this shape (`aspect`: width over height).
    ///
    /// Meshes are made for shapes that had none in the last setting, nor in one that still exists; the others are the same
    /// meshes as before, so that what a renderer keeps of them is found again.
    ///
    /// # Errors
    /// As [`describe`](crate::describe); [`HostError::BadRequest`] for an aspect that is not positive and finite.
    pub fn setting(&mut self, scene: &Scene, time: f64, aspect: f64) -> Result<Setting, HostError> {
        let setting = Setting::new(scene, time, aspect, &mut self.meshes);
        self.meshes.trim();
        setting
    }

    /// Draws the scene without shadows into the stage's own targets, with the normals and ids that
    /// shadows are drawn from if `buffers` says so.
    ///
    /// # Errors
    /// [`HostError::BadRequest`] for sizes and sample counts the driver does not have.
    pub fn draw(
        &mut self,
        setting: &Setting,
        width: u32,
        height: u32,
        samples: u32,
        format: ColorFormat,
        buffers: Buffers,
    ) -> Result<(), HostError> {
        self.check_size(width, height, samples)?;
        // SAFETY: whoever made the stage keeps its context current.
        unsafe { state::reset(&self.gl) };
        self.ensure_targets(width, height, samples, format)?;
        self.triangles.prepare(&self.gl, setting.moment.primitives.iter().map(|p| &p.shape))?;
        let gl = &self.gl;
        let Some(targets) = &self.targets else { return Ok(()) };
        let shading = Shading::of(&setting.described.lights);
        let which = usize::from(samples > 1) * Shading::COUNT + shading.index();
        if self.programs[which].is_none() {
            let program = |kind| Program::new(gl, kind, samples > 1, shading);
            self.programs[which] = Some([program(Kind::Cast)?, program(Kind::Triangles)?]);
        }
        let Some(programs) = &self.programs[which] else { return Ok(()) };
        let view = setting.camera.view;
        let projection = setting.camera.projection;
        let [px, py] = [projection.x_axis.x, projection.y_axis.y];
        let window = [2.0 / (f64::from(width) * px), 2.0 / (f64::from(height) * py), -1.0 / px, -1.0 / py]
            .map(|x| x as f32);
        // SAFETY: objects of this stage; every uniform and buffer has the size its shader declares.
        unsafe {
            let (framebuffer, draw_buffers) = match buffers {
                Buffers::Color => (targets.plain, &ATTACHMENTS[..1]),
                Buffers::All => (targets.all, &ATTACHMENTS[..]),
            };
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            gl.viewport(0, 0, width as i32, height as i32);
            gl.enable(glow::DEPTH_TEST);
            gl.depth_func(glow::GREATER);
            gl.cull_face(glow::FRONT); // the far side of each box: seen from inside it too
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &setting.background.extend(1.0).to_array());
            if buffers == Buffers::All {
                gl.clear_buffer_f32_slice(glow::COLOR, 1, &[0.0; 4]);
                gl.clear_buffer_u32_slice(glow::COLOR, 2, &[0; 4]);
            }
            gl.clear_buffer_f32_slice(glow::DEPTH, 0, &[0.0]);
            gl.bind_buffer_base(glow::UNIFORM_BUFFER, 0, Some(self.lights));
            // More lights than a uniform block holds are added in further passes.
            let lights = &setting.described.lights;
            let passes = lights.len().div_ceil(MAX_LIGHTS).max(1);
            for pass in 0..passes {
                let some = &lights
                    [(pass * MAX_LIGHTS).min(lights.len())..((pass + 1) * MAX_LIGHTS).min(lights.len())];
                let data: Vec<ShaderLight> = some.iter().map(|light| ShaderLight::new(light, view)).collect();
                gl.bind_buffer(glow::UNIFORM_BUFFER, Some(self.lights));
                gl.buffer_sub_data_u8_slice(glow::UNIFORM_BUFFER, 0, bytemuck::cast_slice(&data));
                let ambient = if pass == 0 { setting.ambient } else { Vec3::ZERO };
                if pass == 1 {
                    gl.draw_buffers(&ATTACHMENTS[..1]);
                    gl.enable(glow::BLEND);
                    gl.blend_func(glow::ONE, glow::ONE);
                    gl.depth_func(glow::EQUAL);
                }
                for program in programs {
                    let u = &program.uniforms;
                    gl.use_program(Some(program.raw));
                    gl.uniform_matrix_4_f32_slice(
                        u.projection.as_ref(),
                        false,
                        &projection.as_mat4().to_cols_array(),
                    );
                    gl.uniform_4_f32_slice(u.window.as_ref(), &window);
                    gl.uniform_1_f32(u.near.as_ref(), setting.near as f32);
                    gl.uniform_1_i32(u.light_count.as_ref(), some.len() as i32);
                    gl.uniform_3_f32_slice(u.ambient.as_ref(), &ambient.to_array());
                    for (i, primitive) in setting.moment.primitives.iter().enumerate() {
                        self.draw_primitive(program, primitive, i as u32 + 1, &view);
                    }
                }
            }
            if passes > 1 {
                gl.draw_buffers(draw_buffers);
                gl.disable(glow::BLEND);
            }
            gl.disable(glow::CULL_FACE);
            gl.disable(glow::DEPTH_TEST);
        }
        Ok(())
    }

    /// # Safety
    /// `program` is in use.
    unsafe fn draw_primitive(&self, program: &Program, primitive: &Primitive, id: u32, view: &DMat4) {
        let gl = &self.gl;
        let u = &program.uniforms;
        let pose = DMat4::from_rotation_translation(primitive.pose.rotation, primitive.pose.translation);
        let mut to_view = *view * pose;
        let albedo = primitive.color.as_vec3() / PI;
        let id = if primitive.receives_shadow { id } else { id | NO_SHADOW };
        // SAFETY: the caller's; buffers hold as many corners as they say.
        unsafe {
            let look = || {
                gl.uniform_3_f32_slice(u.albedo.as_ref(), &albedo.to_array());
                gl.uniform_1_u32(u.id.as_ref(), id);
            };
            match program.kind {
                Kind::Cast => {
                    let Some(cast) = Cast::new(&primitive.shape) else { return };
                    let eye = to_view.inverse().transform_point3(DVec3::ZERO).as_vec3();
                    let from_view = Mat3::from_mat4(to_view.as_mat4()).transpose();
                    look();
                    gl.uniform_matrix_4_f32_slice(
                        u.to_view.as_ref(),
                        false,
                        &to_view.as_mat4().to_cols_array(),
                    );
                    gl.uniform_matrix_3_f32_slice(u.from_view.as_ref(), false, &from_view.to_cols_array());
                    gl.uniform_3_f32_slice(u.eye.as_ref(), &eye.to_array());
                    gl.uniform_3_f32_slice(u.center.as_ref(), &cast.center.to_array());
                    gl.uniform_3_f32_slice(u.half_size.as_ref(), &cast.half_size.to_array());
                    gl.uniform_1_i32(u.shape.as_ref(), cast.shape);
                    gl.uniform_4_f32_slice(u.size.as_ref(), &cast.size.to_array());
                    gl.uniform_3_f32_slice(u.triangle.as_ref(), bytemuck::cast_slice(&cast.triangle));
                    gl.enable(glow::CULL_FACE);
                    gl.bind_vertex_array(Some(self.vertex_array));
                    gl.draw_arrays(glow::TRIANGLES, 0, 36);
                }
                Kind::Triangles => {
                    let Some(buffer) = self.triangles.get(&primitive.shape) else { return };
                    to_view *= DMat4::from_translation(buffer.origin);
                    look();
                    gl.uniform_matrix_4_f32_slice(
                        u.to_view.as_ref(),
                        false,
                        &to_view.as_mat4().to_cols_array(),
                    );
                    gl.disable(glow::CULL_FACE); // both sides are seen
                    gl.bind_vertex_array(Some(buffer.vertex_array));
                    gl.draw_arrays(glow::TRIANGLES, 0, buffer.count);
                }
            }
        }
    }

    /// The frame that antumbra shadows: what [`Self::draw`] has drawn last.
    pub(crate) fn frame<'a>(&self, setting: &'a Setting) -> Option<Frame<'a>> {
        let (width, height, ..) = self.targets.as_ref()?.key;
        let frame = Frame::new(setting.camera, [0, 0, width, height], self.surface()?)
            .lights(&setting.described.lights)
            .occluders(&setting.described.occluders)
            .meshes(&setting.described.meshes)
            .receivers(&setting.described.receivers)
            .bounds(&setting.bounds)
            .components(&setting.components)
            .ambient(setting.ambient);
        Some(frame)
    }

    /// What [`Self::draw`] has drawn last, as antumbra reads it: depth, and normals and ids, which are those of the last
    /// draw with [`Buffers::All`]. `None` before anything was drawn. Good until the next draw.
    pub fn surface(&self) -> Option<Surface> {
        let targets = self.targets.as_ref()?;
        // SAFETY: textures of this stage, which exist as long as its targets are these.
        let [depth, normals, ids] = unsafe {
            [targets.depth, targets.normals, targets.ids].map(|texture| Texture::from_glow(texture))
        };
        let surface = Surface::from_depth(depth)
            .with_samples(targets.key.2)
            .with_format(DepthFormat::float().reversed().zero_to_one())
            .with_normals(Normals::new(normals, NormalSpace::View))
            .with_ids(ids);
        Some(surface)
    }

    /// The colour drawn last, with what shadows were added, one sample a pixel. `None` before anything was drawn. Good
    /// until the next draw.
    pub fn color(&mut self) -> Option<Picture> {
        let targets = self.targets.as_ref()?;
        let (width, height, ..) = targets.key;
        let (texture, framebuffer) = match targets.resolved {
            None => (targets.color, targets.color_only),
            Some(resolved) => {
                let gl = &self.gl;
                // SAFETY: framebuffers of this stage, of one size and format.
                unsafe {
                    state::reset(gl);
                    gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(targets.color_only));
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(resolved.1));
                    let (mask, filter) = (glow::COLOR_BUFFER_BIT, glow::NEAREST);
                    gl.blit_framebuffer(0, 0, width, height, 0, 0, width, height, mask, filter);
                }
                resolved
            }
        };
        Some(Picture { texture, framebuffer, width: width as u32, height: height as u32 })
    }

    /// The shadow map of one of the setting's lights, for what [`Self::draw`] has drawn: see
    /// [`antumbra::Renderer::depth_map`].
    ///
    /// # Errors
    /// [`HostError::Shadows`].
    pub fn depth_map(&mut self, setting: &Setting, light: usize) -> Result<Option<DepthMap>, HostError> {
        match self.frame(setting) {
            Some(frame) => Ok(self.shadows.depth_map(&frame, light)?),
            None => Ok(None),
        }
    }

    /// Adds shadows to what [`Self::draw`] has drawn.
    ///
    /// # Errors
    /// [`HostError::Shadows`].
    pub fn add_shadows(&mut self, setting: &Setting) -> Result<(), HostError> {
        let (Some(frame), Some(targets)) = (self.frame(setting), &self.targets) else { return Ok(()) };
        // SAFETY: a framebuffer of this stage with the colour alone.
        let color_only = unsafe { Framebuffer::from_glow(Some(targets.color_only)) };
        Ok(self.shadows.overlay_to(&frame, Encoding::Linear, color_only)?)
    }

    /// Whether the driver has pictures of this size.
    pub(crate) fn check_size(&self, width: u32, height: u32, samples: u32) -> Result<(), HostError> {
        let caps = self.shadows.caps();
        if width == 0 || height == 0 || width.max(height) > caps.max_texture_size {
            return Err(HostError::BadRequest(format!(
                "{width}x{height} pixels; this driver draws 1 to {0} a side",
                caps.max_texture_size
            )));
        }
        if samples == 0 || samples > caps.max_samples {
            return Err(HostError::BadRequest(format!(
                "{samples} samples a pixel; this driver has 1 to {}",
                caps.max_samples
            )));
        }
        Ok(())
    }

    /// Makes targets of this size, which the driver has, unless they are there.
    fn ensure_targets(
        &mut self,
        width: u32,
        height: u32,
        samples: u32,
        format: ColorFormat,
    ) -> Result<(), HostError> {
        let key = (width as i32, height as i32, samples, format);
        if self.targets.as_ref().is_none_or(|targets| targets.key != key) {
            if let Some(old) = self.targets.take() {
                // SAFETY: nothing else refers to them.
                unsafe { old.delete(&self.gl) };
            }
            self.targets = Some(Targets::new(&self.gl, key.0, key.1, samples, format)?);
        }
        Ok(())
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        // SAFETY: the stage's own objects.
        unsafe {
            if let Some(targets) = self.targets.take() {
                targets.delete(&self.gl);
            }
            self.gl.delete_vertex_array(self.vertex_array);
            self.gl.delete_buffer(self.lights);
            self.triangles.delete(&self.gl);
            for program in self.programs.iter().flatten().flatten() {
                self.gl.delete_program(program.raw);
            }
        }
    }
}
