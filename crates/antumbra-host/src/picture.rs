//! Pictures and visibilities read back from the stage.

use crate::HostError;
use crate::setting::Setting;
use crate::stage::{Buffers, Picture, Stage};
use crate::state;
use crate::targets::ColorFormat;
use antumbra::glam::{DVec3, Vec3};
use antumbra::math::Light as Place;
use antumbra::{BATCH_LIGHTS, MaskBatch, ShaderLight, Soft, Technique};
use antumbra_scene::Scene;
use glow::{HasContext, PixelPackData};

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderOptions {
    /// Seconds since the motions' start.
    pub time: f64,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel of the picture; visibilities are always of pixel centres.
    pub msaa: u32,
    /// Whether to return visibilities.
    pub visibility: bool,
    /// Whether the picture has shadows.
    pub shadows: bool,
    /// How they are found.
    pub technique: Technique,
    /// How lights with an area cast them.
    pub soft: Soft,
}

/// A picture, rows from top to bottom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rendered {
    /// Linear radiance, no exposure.
    pub image: Vec<[f32; 3]>,
    /// For each light, the visibility of the surface seen through each pixel's centre.
    pub visibility: Vec<Vec<f32>>,
    /// What the shadow renderer did for the picture.
    pub stats: antumbra::Stats,
}

impl Stage {
    /// Draws a scene and reads it back.
    ///
    /// # Errors
    /// [`HostError::Unsupported`] names what cannot be drawn; see also [`Stage::draw`].
    pub fn render(&mut self, scene: &Scene, options: &RenderOptions) -> Result<Rendered, HostError> {
        let RenderOptions { width, height, .. } = *options;
        self.check_size(width, height, options.msaa)?;
        let setting = self.setting(scene, options.time, f64::from(width) / f64::from(height))?;
        if let Some(error) = setting.objection(&options.technique, options.soft) {
            return Err(error);
        }
        self.set_technique(options.technique)?;
        self.set_soft(options.soft);
        self.draw(&setting, width, height, options.msaa, ColorFormat::Rgba16F, Buffers::All)?;
        if options.shadows {
            self.add_shadows(&setting)?;
        }
        let stats = self.shadows().stats();
        let image = self.read_color()?;
        let visibility = if options.visibility {
            if options.msaa > 1 {
                self.draw(&setting, width, height, 1, ColorFormat::Rgba16F, Buffers::All)?;
            }
            self.read_visibility(&setting)?
        } else {
            Vec::new()
        };
        Ok(Rendered { image, visibility, stats })
    }

    /// The colour, linear, rows from top to bottom.
    pub(crate) fn read_color(&mut self) -> Result<Vec<[f32; 3]>, HostError> {
        let Some(Picture { framebuffer, width, height, .. }) = self.color() else { return Ok(Vec::new()) };
        let gl = &self.gl;
        // SAFETY: reads into memory of the right size from a framebuffer of this stage.
        let pixels: Vec<[f32; 4]> = unsafe {
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(framebuffer));
            read(gl, width as i32, height as i32, glow::RGBA, glow::FLOAT)
        };
        check(gl)?;
        Ok(flip(&pixels, width as usize).map(|[r, g, b, _]| [r, g, b]).collect())
    }

    /// The visibilities of all lights, 8 at a time.
    fn read_visibility(&mut self, setting: &Setting) -> Result<Vec<Vec<f32>>, HostError> {
        // Visibility says whether the way to the light is free, also outside a spot's cone.
        let lights: Vec<_> = setting.described.lights.iter().map(everywhere).collect();
        let Some(frame) = self.frame(setting) else { return Ok(Vec::new()) };
        let frame = frame.lights(&lights);
        let gl = self.gl.clone();
        let surface = self.read_surface(setting)?;
        let [_, _, width, height] = frame.viewport;
        let mut visibility = vec![Vec::new(); setting.described.lights.len()];
        let soft = lights.iter().any(|light| light.area != antumbra::Area::None);
        // SAFETY: a fresh framebuffer, deleted below.
        let framebuffer = unsafe { gl.create_framebuffer() }.map_err(HostError::Driver)?;
        let mut keep = |batch: &MaskBatch| {
            for (t, texture) in batch.textures.iter().enumerate() {
                // SAFETY: reads a texture that antumbra just filled into memory of its size.
                let pixels: Vec<[f32; 4]> = unsafe {
                    gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(framebuffer));
                    gl.framebuffer_texture_2d(
                        glow::READ_FRAMEBUFFER,
                        glow::COLOR_ATTACHMENT0,
                        glow::TEXTURE_2D,
                        Some(texture.glow()),
                        0,
                    );
                    if soft {
                        read(&gl, width, height, glow::RGBA, glow::FLOAT)
                    } else {
                        // OpenGL ES reads what has 8 bits as such alone.
                        let bytes: Vec<[u8; 4]> = read(&gl, width, height, glow::RGBA, glow::UNSIGNED_BYTE);
                        bytes.into_iter().map(|texel| texel.map(|byte| f32::from(byte) / 255.0)).collect()
                    }
                };
                let channels = batch.lights.saturating_sub(t * 4).min(4);
                for channel in 0..channels {
                    let light = batch.first_light + t * (BATCH_LIGHTS / 2) + channel;
                    let facing = surface.facing(&setting.described.lights[light], setting);
                    visibility[light] = flip(&pixels, width as usize)
                        .zip(flip(&facing, width as usize))
                        .map(|(texel, facing)| texel[channel].min(facing))
                        .collect();
                }
            }
        };
        let result = self.shadows.masks(&frame).and_then(|mut batches| {
            while let Some(batch) = batches.next()? {
                keep(&batch);
            }
            Ok(())
        });
        // SAFETY: made above.
        unsafe { gl.delete_framebuffer(framebuffer) };
        result?;
        check(&gl)?;
        Ok(visibility)
    }

    pub(crate) fn read_surface(&self, setting: &Setting) -> Result<SurfaceCopy, HostError> {
        let gl = &self.gl;
        let Some(targets) = &self.targets else { return Err(HostError::Driver("nothing was drawn".into())) };
        let (width, height, ..) = targets.key;
        // SAFETY: reads into memory of the right size from a framebuffer of this stage.
        let (normals, ids) = unsafe {
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(targets.all));
            gl.read_buffer(glow::COLOR_ATTACHMENT1);
            let normals: Vec<[f32; 4]> = read(gl, width, height, glow::RGBA, glow::FLOAT);
            // OpenGL ES reads unsigned integers as four components.
            gl.read_buffer(glow::COLOR_ATTACHMENT2);
            let ids: Vec<[u32; 4]> = read(gl, width, height, glow::RGBA_INTEGER, glow::UNSIGNED_INT);
            gl.read_buffer(glow::COLOR_ATTACHMENT0);
            (normals, ids)
        };
        check(gl)?;
        let [px, py] = [setting.camera.projection.x_axis.x, setting.camera.projection.y_axis.y];
        let positions = normals
            .iter()
            .enumerate()
            .map(|(i, &[.., distance])| {
                let (x, y) = ((i % width as usize) as f64 + 0.5, (i / width as usize) as f64 + 0.5);
                let sight = DVec3::new(
                    (2.0 * x / f64::from(width) - 1.0) / px,
                    (2.0 * y / f64::from(height) - 1.0) / py,
                    -1.0,
                );
                (sight * f64::from(distance)).as_vec3()
            })
            .collect();
        let normals = normals.iter().map(|n| Vec3::new(n[0], n[1], n[2])).collect();
        Ok(SurfaceCopy {
            width: width as usize,
            positions,
            normals,
            ids: ids.iter().map(|id| id[0]).collect(),
        })
    }
}

/// A light in the same place that shines everywhere.
fn everywhere(light: &antumbra::Light) -> antumbra::Light {
    let place = match light.place {
        Place::Spot { position, .. } => Place::Point { position },
        place => place,
    };
    light.with_place(place).with_intensity(Vec3::ONE)
}

/// A cosine that positions and normals in float32 do not tell from zero: a light in the plane of a
/// surface sends it nothing.
const GRAZING: f32 = 4e-6;

/// The stage's surface on the CPU, rows from bottom to top, view space.
pub(crate) struct SurfaceCopy {
    width: usize,
    pub(crate) positions: Vec<Vec3>,
    pub(crate) normals: Vec<Vec3>,
    pub(crate) ids: Vec<u32>,
}

impl SurfaceCopy {
    /// How much of each pixel faces the light, antialiased inside each primitive.
    fn facing(&self, light: &antumbra::Light, setting: &Setting) -> Vec<f32> {
        let light = ShaderLight::new(light, setting.camera.view);
        if light.color.w > 0.0 || light.right.w > 0.0 {
            // A light with an area leaves by degrees; visibility is what arrives of what could.
            let arrives = |i: usize| light.irradiance(self.positions[i], self.normals[i]) != Vec3::ZERO;
            return (0..self.ids.len())
                .map(|i| f32::from(u8::from(self.ids[i] == 0 || arrives(i))))
                .collect();
        }
        let cosine = |i: usize| {
            let to_light = light.place.truncate() - self.positions[i] * light.place.w;
            self.normals[i].dot(to_light.normalize_or_zero())
        };
        let slope = |i: usize, step: usize, inside: bool| {
            let same = |j: usize| inside && self.ids.get(j) == self.ids.get(i);
            match (same(i.wrapping_sub(step)), same(i + step)) {
                (true, true) => (cosine(i + step) - cosine(i - step)) * 0.5,
                (true, false) => cosine(i) - cosine(i - step),
                (false, true) => cosine(i + step) - cosine(i),
                (false, false) => 0.0,
            }
        };
        (0..self.ids.len())
            .map(|i| {
                if self.ids[i] == 0 {
                    return 1.0;
                }
                let x = i % self.width;
                let value = cosine(i) - GRAZING;
                if value.abs() > 0.5 {
                    return if value > 0.0 { 1.0 } else { 0.0 };
                }
                let inside = x > 0 && x + 1 < self.width;
                share_above(value, slope(i, 1, inside), slope(i, self.width, true))
            })
            .collect()
    }
}

/// The share of a pixel, on a grid of points, where `value + u·slope_x + v·slope_y` is positive: counted, so that what
/// measures has nothing in common with what is measured.
fn share_above(value: f32, slope_x: f32, slope_y: f32) -> f32 {
    // Odd: the middle is a point, so that just over half is more than half.
    const SIDE: i32 = 17;
    if value.abs() > (slope_x.abs() + slope_y.abs()) * 0.5 {
        return if value > 0.0 { 1.0 } else { 0.0 };
    }
    let at = |k: i32| (k as f32 + 0.5) / SIDE as f32 - 0.5;
    let rows = (0..SIDE).map(|row| value + at(row) * slope_y);
    let above = rows.map(|row| (0..SIDE).filter(|column| row + at(*column) * slope_x > 0.0).count());
    above.sum::<usize>() as f32 / (SIDE * SIDE) as f32
}

/// # Safety
/// A framebuffer of this size that can be read in this format is bound; `T` is one pixel of it.
unsafe fn read<T: bytemuck::Pod>(
    gl: &glow::Context,
    width: i32,
    height: i32,
    layout: u32,
    kind: u32,
) -> Vec<T> {
    let mut pixels = vec![T::zeroed(); width as usize * height as usize];
    let bytes = PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut pixels)));
    // SAFETY: the caller's.
    unsafe {
        // Mesa's llvmpipe 22.3 reads what its threads have not drawn yet where another framebuffer
        // has been bound since.
        gl.finish();
        state::reset_packing(gl);
        gl.read_pixels(0, 0, width, height, layout, kind, bytes);
    }
    pixels
}

fn flip<T: Copy>(pixels: &[T], width: usize) -> impl Iterator<Item = T> + '_ {
    pixels.chunks_exact(width).rev().flatten().copied()
}

fn check(gl: &glow::Context) -> Result<(), HostError> {
    // SAFETY: asks for the error flag.
    match unsafe { gl.get_error() } {
        glow::NO_ERROR => Ok(()),
        glow::OUT_OF_MEMORY => Err(HostError::Driver("out of memory".into())),
        error => Err(HostError::Driver(format!("error 0x{error:x}"))),
    }
}
