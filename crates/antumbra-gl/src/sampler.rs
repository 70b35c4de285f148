//! Averages the visibilities of a light's points in a float target.

use crate::frame::Frame;
use crate::resources::{Target, TargetFormat, UploadRing};
use crate::samples::{Pattern, push_points};
use crate::scenery::{Area, Light};
use crate::shader::{COVERAGE, MASKS, Program, ProgramSet, ProgramSource, SURFACE, Variant};
use crate::state::{Blend, set_color_mask};
use crate::surface::{bind_texture, set_surface};
use crate::technique::composite::push_components;
use crate::technique::{Batch, Method, Pass};
use crate::tiles::TileGrid;
use crate::view::View;
use crate::{BATCH_LIGHTS, Caps, Error};
use glam::{Vec3, Vec4};
use glow::HasContext;

/// GLSL of a point's weight.
pub(crate) const SAMPLES: &str = include_str!("shaders/samples.glsl");

const SUM: &[&str] = &[COVERAGE, SURFACE, MASKS, SAMPLES, include_str!("shaders/samples.frag.glsl")];
const POINTS: &[&str] = &["u_points", "u_point_count", "u_center", "u_emitter"];

/// In the order of [`TAKEN`], [`SENT`] and [`AVERAGE`].
pub(crate) const SAMPLE_PROGRAMS: &[ProgramSource] = &[
    ProgramSource::screen("samples taken", "#define TAKEN\n", SUM, POINTS),
    ProgramSource::screen("samples sent", "", SUM, POINTS),
    ProgramSource::screen(
        "samples average",
        "",
        &[COVERAGE, SURFACE, include_str!("shaders/samples_average.frag.glsl")],
        &["u_sums"],
    ),
];
const TAKEN: usize = 0;
const SENT: usize = 1;
const AVERAGE: usize = 2;

/// The OpenGL objects, made when they are first needed, and the memory of the points.
pub(crate) struct Sampler {
    programs: ProgramSet,
    screen: UploadRing,
    vertices: Vec<[f32; 2]>,
    /// Visibility of some points.
    masks: [Option<Target>; 2],
    /// What shadows take of the light, and what its points send.
    sums: Option<Target>,
    /// Tiles that the shadows of some points touch, and of all.
    some_tiles: TileGrid,
    all_tiles: TileGrid,
    /// A batch's lights, those with an area switched off.
    batch: Vec<Light>,
}

/// Which points stand for lights with an area.
#[derive(Clone, Copy)]
pub(crate) enum Sampling {
    /// So many, in a pattern.
    Spread(u32, Pattern),
    /// The components of the technique `composite`, so many where the frame does not say.
    Components(u32),
}

/// The hard lights that stand for a frame's.
#[derive(Default)]
pub(crate) struct Points {
    /// All of them, in the order of the frame's lights.
    pub(crate) lights: Vec<Light>,
    /// Of each light of the frame where its points begin; then the end.
    first: Vec<usize>,
}

impl Points {
    /// Takes a frame's lights.
    pub(crate) fn of_lights(&mut self, frame: &Frame<'_>, sampling: Sampling) {
        self.lights.clear();
        self.first.clear();
        for (i, light) in frame.lights.iter().enumerate() {
            self.first.push(self.lights.len());
            match sampling {
                Sampling::Spread(count, pattern) => push_points(&mut self.lights, light, count, pattern),
                Sampling::Components(count) => push_components(&mut self.lights, frame, i, count),
            }
        }
        self.first.push(self.lights.len());
    }

    /// Those of one light.
    pub(crate) fn of(&self, light: usize) -> &[Light] {
        &self.lights[self.first[light]..self.first[light + 1]]
    }
}

impl Sampler {
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        Ok(Self {
            programs: ProgramSet::default(),
            // SAFETY: the caller's.
            screen: unsafe { UploadRing::new(gl, size_of::<[f32; 2]>() as i32)? },
            vertices: Vec::new(),
            masks: [None, None],
            sums: None,
            some_tiles: TileGrid::default(),
            all_tiles: TileGrid::default(),
            batch: Vec::new(),
        })
    }

    /// Compiles the programs for such surfaces, unless it was done.
    pub(crate) fn warm_up(&mut self, gl: &glow::Context, caps: &Caps, variant: Variant) -> Result<(), Error> {
        self.programs.ensure(gl, caps, SAMPLE_PROGRAMS, variant, &[], false)
    }

    /// Targets of the frame's size.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(crate) unsafe fn prepare(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        frame: &Frame<'_>,
    ) -> Result<(), Error> {
        if !caps.float_targets() {
            return Err(Error::Unsupported {
                what: "sampled lights",
                needs: "floating-point render targets (EXT_color_buffer_float)",
            });
        }
        let ([.., width, height], samples) = (frame.viewport, frame.surface.samples);
        // SAFETY: the caller's.
        unsafe {
            for slot in &mut self.masks {
                Target::ensure(slot, gl, TargetFormat::Rgba8, (width, height), samples)?;
            }
            Target::ensure(&mut self.sums, gl, TargetFormat::Rgba32F, (width, height), samples)
        }
    }

    /// Draws the visibility of a batch of which some lights have an area into `masks`, cleared to 1. `first` is the
    /// place of the batch's first light among the frame's.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`]; [`Self::warm_up`] and [`Self::prepare`] were called for the frame.
    pub(crate) unsafe fn draw(
        &mut self,
        method: &mut dyn Method,
        pass: &Pass<'_>,
        batch: &mut Batch<'_>,
        first: usize,
        points: &Points,
    ) -> Result<(), Error> {
        let gl = pass.gl;
        let has_area = |light: &Light| light.area != Area::None;
        // SAFETY: the caller's.
        unsafe {
            if !batch.lights.iter().all(has_area) {
                self.batch.clear();
                self.batch.extend(batch.lights.iter().map(|light| match light.area {
                    Area::None => *light,
                    _ => Light { area: Area::None, intensity: Vec3::ZERO, ..*light },
                }));
                let hard = &mut Batch { lights: &self.batch, masks: batch.masks, tiles: batch.tiles };
                method.draw_visibility(pass, hard)?;
            }
            for (channel, light) in batch.lights.iter().enumerate().filter(|(_, light)| has_area(light)) {
                // Whatever the technique did with a light that is off.
                bind_channel(gl, pass.caps, batch.masks, channel);
                gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
                set_color_mask(gl, *pass.caps, [true; 4]);
                if light.intensity == Vec3::ZERO {
                    continue;
                }
                let points = points.of(first + channel);
                self.sum(method, pass, light, points)?;
                if self.all_tiles.is_untouched() {
                    continue;
                }
                let program = self.programs.of(Variant::of(&pass.frame.surface))[AVERAGE]
                    .as_ref()
                    .expect("compiled by warm_up");
                set_surface(gl, program, pass.view, &pass.frame.surface, pass.mask_offset());
                gl.uniform_1_i32(program.own[0].as_ref(), 3);
                if let Some(sums) = &self.sums {
                    bind_texture(gl, 3, pass.frame.surface.samples, sums.texture);
                }
                bind_channel(gl, pass.caps, batch.masks, channel);
                Blend::Replace.apply(gl, *pass.caps);
                gl.draw_arrays(glow::TRIANGLES, 0, self.vertices.len() as i32);
                set_color_mask(gl, *pass.caps, [true; 4]);
                batch.tiles.add(&self.all_tiles);
            }
        }
        Ok(())
    }

    /// Sums over the points of one light. Leaves the tiles in `all_tiles`, and their vertices bound.
    ///
    /// # Safety
    /// As for [`Self::draw`].
    unsafe fn sum(
        &mut self,
        method: &mut dyn Method,
        pass: &Pass<'_>,
        light: &Light,
        points: &[Light],
    ) -> Result<(), Error> {
        let Self { programs, screen, vertices, masks, sums, some_tiles, all_tiles, .. } = self;
        let ([Some(a), Some(b)], Some(sums)) = (&*masks, &*sums) else { return Ok(()) };
        let masks = [a, b];
        let programs = programs.of(Variant::of(&pass.frame.surface));
        let (gl, samples) = (pass.gl, pass.frame.surface.samples);
        all_tiles.reset(pass.view.size());
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums.framebuffer));
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
            for some in points.chunks(BATCH_LIGHTS) {
                some_tiles.reset(pass.view.size());
                for target in masks {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                    gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
                }
                method.draw_visibility(pass, &mut Batch { lights: some, masks, tiles: some_tiles })?;
                if some_tiles.is_untouched() {
                    continue;
                }
                all_tiles.add(some_tiles);
                bind_tiles(screen, vertices, some_tiles, pass)?;
                let program = use_sum(programs, TAKEN, pass);
                for (unit, (location, target)) in
                    (3..).zip([(&program.uniforms.visibility_0, a), (&program.uniforms.visibility_1, b)])
                {
                    gl.uniform_1_i32(location.as_ref(), unit);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
                set_points(gl, program, light, some, pass.view);
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums.framebuffer));
                Blend::Add.apply(gl, *pass.caps);
                gl.draw_arrays(glow::TRIANGLES, 0, vertices.len() as i32);
            }
            if all_tiles.is_untouched() {
                return Ok(());
            }
            bind_tiles(screen, vertices, all_tiles, pass)?;
            let program = use_sum(programs, SENT, pass);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums.framebuffer));
            Blend::Add.apply(gl, *pass.caps);
            for some in points.chunks(BATCH_LIGHTS) {
                set_points(gl, program, light, some, pass.view);
                gl.draw_arrays(glow::TRIANGLES, 0, vertices.len() as i32);
            }
        }
        Ok(())
    }

    /// # Safety
    /// The context is current, and the sampler is not used afterwards.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.programs.delete(gl);
            self.screen.delete(gl);
            let targets = self.masks.iter_mut().chain([&mut self.sums]);
            targets.filter_map(Option::take).for_each(|target| target.delete(gl));
        }
    }
}

/// Binds one channel of a batch's masks for drawing, and it alone.
///
/// # Safety
/// A [`crate::state::StateGuard`] is alive.
unsafe fn bind_channel(gl: &glow::Context, caps: &Caps, masks: [&Target; 2], channel: usize) {
    let target = masks[channel / 4];
    // SAFETY: the caller's.
    unsafe {
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
        set_color_mask(gl, *caps, [0, 1, 2, 3].map(|c| c == channel % 4));
    }
}

/// Uploads the triangles of touched tiles and binds them.
///
/// # Safety
/// A [`crate::state::StateGuard`] is alive.
unsafe fn bind_tiles(
    screen: &mut UploadRing,
    vertices: &mut Vec<[f32; 2]>,
    tiles: &TileGrid,
    pass: &Pass<'_>,
) -> Result<(), Error> {
    vertices.clear();
    tiles.triangles(vertices);
    // SAFETY: the caller's.
    unsafe {
        let upload = screen.upload(pass.gl, pass.caps, bytemuck::cast_slice(vertices), &mut Vec::new())?;
        pass.gl.bind_vertex_array(Some(upload.vertex_array));
    }
    Ok(())
}

/// Uses one of the programs that sum, with the frame's surface.
///
/// # Safety
/// A [`crate::state::StateGuard`] is alive.
unsafe fn use_sum<'a>(programs: &'a [Option<Program>], which: usize, pass: &Pass<'_>) -> &'a Program {
    let program = programs[which].as_ref().expect("compiled by warm_up");
    // SAFETY: the caller's.
    unsafe { set_surface(pass.gl, program, pass.view, &pass.frame.surface, pass.mask_offset()) };
    program
}

/// # Safety
/// The program is in use.
unsafe fn set_points(gl: &glow::Context, program: &Program, light: &Light, points: &[Light], view: &View) {
    let place = |light: &Light| light.place.transformed(&view.view).homogeneous().truncate().as_vec3();
    let mut positions = [Vec3::ZERO; BATCH_LIGHTS];
    positions.iter_mut().zip(points).for_each(|(position, point)| *position = place(point));
    let emitter = match light.area {
        Area::None | Area::Sphere { .. } => Vec4::ZERO,
        Area::Disc { direction, .. } | Area::Rectangle { direction, .. } => {
            view.view.transform_vector3(direction).as_vec3().extend(1.0)
        }
    };
    // SAFETY: the caller's.
    unsafe {
        gl.uniform_3_f32_slice(program.own[0].as_ref(), bytemuck::cast_slice(&positions));
        gl.uniform_1_i32(program.own[1].as_ref(), points.len() as i32);
        gl.uniform_3_f32_slice(program.own[2].as_ref(), &place(light).to_array());
        gl.uniform_4_f32_slice(program.own[3].as_ref(), &emitter.to_array());
    }
}
