//! Averages the visibilities of a light's points in a float target.

use super::batch::{self, BATCH_LIGHTS, Batch, GROUP_LIGHTS};
use super::overlay::MASKS;
use super::samples::push_points;
use crate::gl::{
    Blend, COVERAGE, Caps, Drawing, Needs, Program, ProgramSet, ProgramSource, SURFACE, Target, TargetFormat,
    TileMesh, Variant, bind_texture, set_color_mask,
};
use crate::input::{Area, Error, Frame, Light, Pattern, push_components};
use crate::screen::{TileGrid, View};
use glam::{Vec3, Vec4};
use glow::HasContext;

/// Draws the visibility of hard lights into a batch's masks: the technique's business.
pub(crate) type DrawHard<'a> = dyn FnMut(&mut Batch<'_>) -> Result<(), Error> + 'a;

/// GLSL of a point's weight.
pub(crate) const SAMPLES: &str = include_str!("../shaders/samples.glsl");

const SUM: &[&str] = &[COVERAGE, SURFACE, MASKS, SAMPLES, include_str!("../shaders/samples.frag.glsl")];
const POINTS: &[&str] = &["u_points", "u_point_count", "u_center", "u_emitter"];

/// In the order of [`TAKEN`], [`SENT`] and [`AVERAGE`].
pub(crate) const SAMPLE_PROGRAMS: &[ProgramSource] = &[
    ProgramSource::screen("samples taken", "#define TAKEN\n", SUM, POINTS),
    ProgramSource::screen("samples sent", "", SUM, POINTS),
    ProgramSource::screen(
        "samples average",
        "",
        &[COVERAGE, SURFACE, include_str!("../shaders/samples_average.frag.glsl")],
        &["u_sums"],
    ),
];
const TAKEN: usize = 0;
const SENT: usize = 1;
const AVERAGE: usize = 2;

/// The OpenGL objects, made when they are first needed, and the memory of the points.
pub(crate) struct Sampler {
    programs: ProgramSet,
    screen: TileMesh,
    /// Visibility of some points.
    masks: [Option<Target>; BATCH_LIGHTS / GROUP_LIGHTS],
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
                Sampling::Components(count) => {
                    push_components(&mut self.lights, light, (frame.components, i), count)
                }
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
    /// A [`crate::gl::StateGuard`] is alive.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        Ok(Self {
            programs: ProgramSet::default(),
            // SAFETY: the caller's.
            screen: unsafe { TileMesh::new(gl)? },
            masks: [None, None],
            sums: None,
            some_tiles: TileGrid::default(),
            all_tiles: TileGrid::default(),
            batch: Vec::new(),
        })
    }

    /// Compiles the programs for such surfaces, unless it was done.
    pub(crate) fn warm_up(&mut self, gl: &glow::Context, caps: &Caps, variant: Variant) -> Result<(), Error> {
        self.programs.ensure(gl, caps, SAMPLE_PROGRAMS, variant, Needs::default())
    }

    /// Targets of the frame's size.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    pub(crate) unsafe fn prepare(&mut self, drawing: &Drawing<'_>) -> Result<(), Error> {
        // SAFETY: the caller's.
        unsafe {
            for slot in &mut self.masks {
                drawing.ensure_target(slot, TargetFormat::Rgba8)?;
            }
            drawing.ensure_target(&mut self.sums, TargetFormat::Rgba32F)
        }
    }

    /// Draws the visibility of a batch of which some lights have an area into its masks, cleared to 1. `first` is the
    /// place of the batch's first light among the frame's.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, the surface's textures exist; [`Self::warm_up`] and [`Self::prepare`] were
    /// called for the frame. `hard` leaves state that the guard does not keep as it was.
    pub(crate) unsafe fn draw(
        &mut self,
        drawing: &Drawing<'_>,
        batch: &mut Batch<'_>,
        first: usize,
        points: &Points,
        hard: &mut DrawHard<'_>,
    ) -> Result<(), Error> {
        let (gl, caps) = (drawing.gl, *drawing.caps);
        let has_area = |light: &Light| light.area != Area::None;
        if !batch.lights.iter().all(has_area) {
            self.batch.clear();
            self.batch.extend(batch.lights.iter().map(|light| match light.area {
                Area::None => *light,
                _ => Light { area: Area::None, intensity: Vec3::ZERO, ..*light },
            }));
            hard(&mut Batch { lights: &self.batch, masks: batch.masks, tiles: batch.tiles })?;
        }
        for (channel, light) in batch.lights.iter().enumerate().filter(|(_, light)| has_area(light)) {
            // SAFETY: the caller's.
            unsafe {
                // Whatever was done with a light that is off.
                bind_channel(drawing, batch.masks, channel);
                gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
                set_color_mask(gl, caps, [true; 4]);
                if light.intensity == Vec3::ZERO {
                    continue;
                }
                self.sum(drawing, light, points.of(first + channel), hard)?;
                if self.all_tiles.is_untouched() {
                    continue;
                }
                let program = self.use_program(drawing, AVERAGE);
                if let Some(sums) = &self.sums {
                    gl.uniform_1_i32(program.own[0].as_ref(), 3);
                    bind_texture(gl, 3, drawing.frame.surface.samples, sums.texture);
                }
                bind_channel(drawing, batch.masks, channel);
                Blend::Replace.apply(gl, caps);
                self.screen.draw(gl);
                set_color_mask(gl, caps, [true; 4]);
            }
            batch.tiles.add(&self.all_tiles);
        }
        Ok(())
    }

    /// Sums over the points of one light. Leaves the tiles in `all_tiles`, and their triangles bound.
    ///
    /// # Safety
    /// As for [`Self::draw`].
    unsafe fn sum(
        &mut self,
        drawing: &Drawing<'_>,
        light: &Light,
        points: &[Light],
        hard: &mut DrawHard<'_>,
    ) -> Result<(), Error> {
        let (gl, samples) = (drawing.gl, drawing.frame.surface.samples);
        let Some(sums) = self.sums.as_ref().map(|sums| sums.framebuffer) else { return Ok(()) };
        self.all_tiles.reset(drawing.view.size());
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums));
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
            for some in points.chunks(BATCH_LIGHTS) {
                let [Some(a), Some(b)] = &self.masks else { return Ok(()) };
                self.some_tiles.reset(drawing.view.size());
                batch::clear(drawing, [a, b]);
                hard(&mut Batch { lights: some, masks: [a, b], tiles: &mut self.some_tiles })?;
                if !self.screen.bind(drawing, &self.some_tiles)? {
                    continue;
                }
                self.all_tiles.add(&self.some_tiles);
                let program = self.use_program(drawing, TAKEN);
                let locations = [&program.uniforms.visibility_0, &program.uniforms.visibility_1];
                for (unit, (location, target)) in (3..).zip(locations.into_iter().zip([a, b])) {
                    gl.uniform_1_i32(location.as_ref(), unit);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
                set_points(gl, program, light, some, drawing.view);
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums));
                Blend::Add.apply(gl, *drawing.caps);
                self.screen.draw(gl);
            }
            if !self.screen.bind(drawing, &self.all_tiles)? {
                return Ok(());
            }
            let program = self.use_program(drawing, SENT);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums));
            Blend::Add.apply(gl, *drawing.caps);
            for some in points.chunks(BATCH_LIGHTS) {
                set_points(gl, program, light, some, drawing.view);
                self.screen.draw(gl);
            }
        }
        Ok(())
    }

    /// Uses one of the programs, with the frame's surface.
    ///
    /// # Safety
    /// As for [`Self::draw`].
    unsafe fn use_program(&self, drawing: &Drawing<'_>, which: usize) -> &Program {
        let programs = self.programs.of(Variant::of(&drawing.frame.surface));
        let program = programs[which].as_ref().expect("compiled by warm_up");
        // SAFETY: the caller's.
        unsafe { drawing.use_program(program, drawing.mask_offset()) };
        program
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
/// A [`crate::gl::StateGuard`] is alive.
unsafe fn bind_channel(drawing: &Drawing<'_>, masks: [&Target; BATCH_LIGHTS / GROUP_LIGHTS], channel: usize) {
    let target = masks[channel / GROUP_LIGHTS];
    // SAFETY: the caller's.
    unsafe {
        drawing.gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
        set_color_mask(drawing.gl, *drawing.caps, [0, 1, 2, 3].map(|c| c == channel % GROUP_LIGHTS));
    }
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
