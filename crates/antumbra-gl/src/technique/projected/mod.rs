//! `projected`: triangles flattened onto planes and rectangles, kept in bounds by a stencil buffer.
//!
//! For each receiver the stencil buffer marks the pixels that show it; then every caster's triangles are drawn by a
//! matrix that flattens them onto the receiver's plane, and darken each marked pixel once for each light. Theory:
//! docs/theory/projected.md.
//!
//! [`crate::Stats`]: a pair is a light, a receiver that it lights and a caster; polygons are the triangles drawn.

mod plan;
mod receivers;

use super::method::{Behavior, Make, Painter};
use super::options::Field;
use super::{About, Method, Pass};
use crate::gl::{
    Blend, COVERAGE, Caps, MeshCache, ProgramSource, RasterGuard, SURFACE, Stage, StencilBuffer, Target,
    TargetFormat, TileMesh, UploadRing, When, bind_texture, set_color_mask,
};
use crate::input::{Choice, Encoding, Error, Part, Reason, Refusal, Scenery};
use crate::masks::{Batch, Counts, GROUP_LIGHTS, HostPicture};
use crate::screen::{ProxyBuilder, TileGrid};
use glam::DVec4;
use glow::HasContext;
use plan::{Draw, Plan};
use receivers::Receivers;

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "triangles flattened onto the receiver's plane, with a stencil buffer against double blending",
    casts_from: "every shape and mesh, as triangles",
    falls_on: "planes and rectangles",
};

/// What a shadow does to the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shade {
    /// Takes the light's contribution away.
    #[default]
    Physical,
    /// Paints black at half opacity over the displayed picture, as the module of 2002 does, once for each light;
    /// also where a spot does not shine.
    Paper,
}

impl Shade {
    const ALL: [Self; 2] = [Self::Physical, Self::Paper];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new("physical", "Takes the light's contribution away."),
        Choice::new(
            "paper",
            "Paints black at half opacity over the displayed picture, as the module of 2002 does, once for each light; \
             also where a spot does not shine.",
        ),
    ];
}

/// Options of the technique `projected`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// What a shadow does to the picture.
    pub shade: Shade,
    /// Whether a stencil buffer keeps shadows on their receivers and from being blended twice. Without it, to
    /// show what it is for and with `shade=paper` alone, every triangle blends, wherever the receiver's plane
    /// is not hidden.
    pub stencil: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { shade: Shade::Physical, stencil: true }
    }
}

impl Options {
    /// The same with another [`Self::shade`].
    pub fn shade(self, shade: Shade) -> Self {
        Self { shade, ..self }
    }

    /// The same with or without the [`Self::stencil`].
    pub fn stencil(self, stencil: bool) -> Self {
        Self { stencil, ..self }
    }
}

impl super::options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[
        Field::choice(
            "shade",
            "What a shadow does to the picture.",
            Shade::CHOICES,
            |o| o.shade as usize,
            |o, place| o.shade = Shade::ALL[place],
        ),
        Field::switch(
            "stencil",
            "Whether a stencil buffer keeps shadows on their receivers and from being blended twice. Without it, to show \
             what it is for and with `shade=paper` alone, every triangle blends, wherever the receiver's plane is not \
             hidden.",
            |o| o.stencil,
            |o, on| o.stencil = on,
        ),
    ];
}

impl Behavior for Options {
    fn paints(&self) -> bool {
        self.shade == Shade::Paper
    }
}

macro_rules! caster_stage {
    ($file:literal) => {
        Stage { defines: "", parts: &[include_str!(concat!("../../shaders/projected/", $file))] }
    };
}

macro_rules! screen_program {
    ($name:literal, $file:literal, $uniforms:expr) => {
        ProgramSource::screen(
            $name,
            "",
            &[COVERAGE, SURFACE, include_str!(concat!("../../shaders/projected/", $file))],
            $uniforms,
        )
    };
}

/// In the order of [`MARK`], [`CASTER`] and [`PAINT`].
pub(super) const PROGRAMS: &[ProgramSource] = &[
    screen_program!("projected mark", "mark.frag.glsl", &["u_plane", "u_sides", "u_receiver", "u_beyond"]),
    ProgramSource {
        name: "projected caster",
        vertex: caster_stage!("caster.vert.glsl"),
        fragment: caster_stage!("caster.frag.glsl"),
        uniforms: &["u_to_clip", "u_height", "u_shade"],
        when: When::ALWAYS,
    },
    screen_program!("projected paint", "paint.frag.glsl", &["u_painted", "u_painted_offset", "u_exponent"]),
];
const MARK: usize = 0;
const CASTER: usize = 1;
const PAINT: usize = 2;

/// Bits of the stencil buffer that hold the mark of the receiver a pixel shows.
const MARKS: i32 = 0x0f;
/// The bit that the first light of a target sets where it has darkened a pixel; the next ones are for the next lights.
const DARKENED: i32 = 0x10;
/// What a painted shadow leaves of a displayed value: black at half opacity, as in the module of 2002.
const PAINTED: f32 = 0.5;
/// Displayed values are about the linear ones to the power of 1 / 2.2: sRGB's curve, nearly.
const DISPLAY_GAMMA: f32 = 2.2;

pub(super) fn refusal(options: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    if !options.stencil && options.shade == Shade::Physical {
        return Some(Refusal::new(Part::Options, Reason::PhysicalWithoutStencil));
    }
    Refusal::of_areas(scenery.lights).or_else(|| {
        let refusal = || Refusal::new(Part::Receivers, Reason::NoReceivers);
        scenery.receivers.is_empty().then(refusal)
    })
}

/// The OpenGL objects, and the memory of the planning.
pub(super) struct State {
    options: Options,
    meshes: MeshCache,
    screen: UploadRing,
    tiles: TileMesh,
    stencil: StencilBuffer,
    /// What painted shadows leave of the picture.
    painted: Option<Target>,
    proxy: ProxyBuilder,
    receivers: Receivers,
    /// The receivers' polygons.
    receiver_vertices: Option<glow::VertexArray>,
    plan: Plan,
}

impl Make for State {
    type Options = Options;

    unsafe fn make(gl: &glow::Context, _: &Caps, options: Options) -> Result<Self, Error> {
        // SAFETY: the caller's; the first is deleted if the second cannot be made.
        unsafe {
            let screen = UploadRing::new(gl, size_of::<[f32; 2]>() as i32)?;
            let tiles = TileMesh::new(gl).inspect_err(|_| screen.delete(gl))?;
            Ok(Self {
                options,
                meshes: MeshCache::default(),
                screen,
                tiles,
                stencil: StencilBuffer::default(),
                painted: None,
                proxy: ProxyBuilder::default(),
                receivers: Receivers::default(),
                receiver_vertices: None,
                plan: Plan::default(),
            })
        }
    }

    fn set_options(&mut self, options: Options) {
        self.options = options;
    }
}

impl State {
    /// Draws the shadows of a group of the planned lights, at most [`GROUP_LIGHTS`] from `first_light` on, into a
    /// target, which is left bound.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`].
    unsafe fn draw_group(
        &mut self,
        pass: &Pass<'_>,
        target: &Target,
        first_light: usize,
        shade: impl Fn(usize) -> [f32; 4],
    ) -> Result<(), Error> {
        let lights = first_light..first_light + GROUP_LIGHTS;
        if !self.plan.draws.iter().any(|draw| lights.contains(&draw.light)) {
            return Ok(());
        }
        let gl = pass.gl;
        let once = self.options.stencil;
        let last_mark = if once { MARKS } else { 1 };
        // SAFETY: the caller's; the guard outlives the settings.
        unsafe {
            if let Err(error) = self.stencil.attach(pass, target) {
                StencilBuffer::detach(gl, target);
                return Err(error);
            }
            let raster = RasterGuard::new(gl, pass.host);
            gl.enable(glow::STENCIL_TEST);
            gl.clear_buffer_i32_slice(glow::STENCIL, 0, &[0]);
            let mut mark = 0;
            for draws in self.plan.draws.chunk_by(|a, b| a.receiver == b.receiver) {
                let mut draws = draws.iter().filter(|draw| lights.contains(&draw.light)).peekable();
                let Some(draw) = draws.peek() else { continue };
                if mark == last_mark {
                    gl.stencil_mask(MARKS as u32);
                    gl.clear_buffer_i32_slice(glow::STENCIL, 0, &[0]);
                    mark = 0;
                }
                mark += 1;
                self.mark(pass, draw.receiver, mark, !once);
                gl.stencil_op(glow::KEEP, glow::KEEP, if once { glow::INVERT } else { glow::KEEP });
                self.clip(pass, true);
                for draw in draws {
                    let light = draw.light - first_light;
                    let darkened = DARKENED << light;
                    gl.stencil_func(glow::EQUAL, mark, (MARKS | darkened) as u32);
                    gl.stencil_mask(darkened as u32);
                    self.cast(pass, draw, &shade(light));
                }
                self.clip(pass, false);
            }
            drop(raster);
            StencilBuffer::detach(gl, target);
        }
        Ok(())
    }

    /// Draws one caster's shadow where the stencil test passes.
    ///
    /// # Safety
    /// As for [`Self::draw_group`].
    unsafe fn cast(&self, pass: &Pass<'_>, draw: &Draw, shade: &[f32; 4]) {
        let (gl, program) = (pass.gl, pass.program(CASTER));
        let [to_clip_at, height_at, shade_at] = &program.own[..] else { unreachable!("one location a name") };
        let caster = &self.plan.posed[draw.caster];
        // SAFETY: the caller's; the elements are those of the vertex array.
        unsafe {
            gl.use_program(Some(program.raw));
            gl.uniform_matrix_4_f32_slice(to_clip_at.as_ref(), false, &draw.to_clip);
            gl.uniform_4_f32_slice(height_at.as_ref(), &draw.height);
            gl.uniform_4_f32_slice(shade_at.as_ref(), shade);
            gl.bind_vertex_array(Some(caster.vertex_array));
            gl.draw_elements(glow::TRIANGLES, caster.count, glow::UNSIGNED_INT, 0);
        }
    }

    /// Switches the clip distance that casters write for multisampled surfaces; other programs write none.
    ///
    /// # Safety
    /// As for [`Self::draw_group`].
    unsafe fn clip(&self, pass: &Pass<'_>, on: bool) {
        let (gl, distance) = (pass.gl, glow::CLIP_DISTANCE0);
        if pass.frame.surface.samples > 1 {
            // SAFETY: multisampled surfaces are of desktop OpenGL, which has clip distances.
            unsafe { if on { gl.enable(distance) } else { gl.disable(distance) } }
        }
    }

    /// Draws what painted shadows leave of the picture into `slot`, and touches the tiles they may darken.
    ///
    /// # Safety
    /// As for [`Painter::paint`].
    unsafe fn draw_painted(
        &mut self,
        pass: &Pass<'_>,
        slot: &mut Option<Target>,
        tiles: &mut TileGrid,
    ) -> Result<(), Error> {
        let (gl, [_, _, width, height]) = (pass.gl, pass.view.viewport);
        // SAFETY: the caller's.
        unsafe {
            pass.ensure_target(slot, TargetFormat::Rgba8)?;
            let target = slot.as_ref().expect("made above");
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
            gl.viewport(0, 0, width, height);
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]);
            Blend::Multiply.apply(gl, *pass.caps);
            for lights in pass.frame.lights.chunks(GROUP_LIGHTS) {
                self.plan.find(pass, &self.receivers, lights, &mut self.proxy, tiles);
                self.draw_group(pass, target, 0, |_| [PAINTED; 4])?;
            }
        }
        Ok(())
    }

    /// Marks the pixels that show a receiver; with `beyond` those where its plane is not hidden.
    ///
    /// # Safety
    /// As for [`Self::draw_group`], with the stencil test on.
    unsafe fn mark(&self, pass: &Pass<'_>, receiver: usize, mark: i32, beyond: bool) {
        let gl = pass.gl;
        let placed = &self.receivers.placed[receiver];
        let from_view = pass.view.view.inverse();
        let plane = placed.plane.transformed(&pass.view.view);
        let sides = placed.sides.map(|side| (from_view.transpose() * side).as_vec4());
        // SAFETY: the caller's.
        unsafe {
            let program = pass.use_program(MARK, pass.mask_offset());
            let [plane_at, sides_at, receiver_at, beyond_at] = &program.own[..] else {
                unreachable!("one location a name")
            };
            let DVec4 { x, y, z, w } = plane.normal.extend(-plane.offset);
            gl.uniform_4_f32(plane_at.as_ref(), x as f32, y as f32, z as f32, w as f32);
            gl.uniform_4_f32_slice(sides_at.as_ref(), bytemuck::cast_slice(&sides));
            gl.uniform_1_u32(receiver_at.as_ref(), placed.id);
            gl.uniform_1_i32(beyond_at.as_ref(), i32::from(beyond));
            gl.stencil_func(glow::ALWAYS, mark, u32::MAX);
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::REPLACE);
            gl.stencil_mask(MARKS as u32);
            set_color_mask(gl, *pass.caps, [false; 4]);
            gl.bind_vertex_array(self.receiver_vertices);
            gl.draw_arrays(glow::TRIANGLES, placed.first_vertex, placed.vertex_count);
            set_color_mask(gl, *pass.caps, [true; 4]);
        }
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        let unbounded = !self.options.stencil;
        self.receivers.place(pass.frame.receivers, unbounded, &mut self.proxy, pass.view);
        // SAFETY: the caller's.
        unsafe {
            self.meshes.begin_frame(pass.gl);
            self.plan.begin(pass, &mut self.meshes)?;
            let vertices = bytemuck::cast_slice(&self.receivers.vertices);
            let upload = self.screen.upload(pass.gl, pass.caps, vertices, &mut Vec::new())?;
            self.receiver_vertices = Some(upload.vertex_array);
        }
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        self.plan.find(pass, &self.receivers, batch.lights, &mut self.proxy, batch.tiles);
        for (group, target) in batch.masks.iter().enumerate() {
            // The smaller of what is there and what is drawn: the light's channel becomes 0, the others stay.
            let shade = |light| std::array::from_fn(|channel| if channel == light { 0.0 } else { 1.0 });
            // SAFETY: the caller's.
            unsafe {
                Blend::Min.apply(pass.gl, *pass.caps);
                self.draw_group(pass, target, group * GROUP_LIGHTS, shade)?;
            }
        }
        Ok(())
    }

    fn painter(&mut self) -> Option<&mut dyn Painter> {
        Some(self)
    }

    fn counts(&self) -> Counts {
        self.plan.counts
    }

    unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.meshes.delete(gl);
            self.screen.delete(gl);
            self.tiles.delete(gl);
            self.stencil.delete(gl);
            self.painted.take().into_iter().for_each(|target| target.delete(gl));
        }
    }
}

impl Painter for State {
    /// Multiplies what the shadows leave of the picture in a target of its own, and the picture by that: the host's
    /// framebuffer need not have a stencil buffer.
    unsafe fn paint(
        &mut self,
        pass: &Pass<'_>,
        host: HostPicture,
        tiles: &mut TileGrid,
    ) -> Result<(), Error> {
        let gl = pass.gl;
        let [x, y, width, height] = pass.view.viewport;
        let mut painted = self.painted.take();
        // SAFETY: the caller's.
        unsafe {
            let drawn = self.draw_painted(pass, &mut painted, tiles);
            self.painted = painted;
            drawn?;
            let Some(painted) = &self.painted else { return Ok(()) };
            if !self.tiles.bind(pass, tiles)? {
                return Ok(());
            }
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
            gl.viewport(x, y, width, height);
            let program = pass.use_program(PAINT, [0, 0]);
            let [painted_at, offset_at, exponent_at] = &program.own[..] else {
                unreachable!("one location a name")
            };
            gl.uniform_1_i32(painted_at.as_ref(), 3);
            bind_texture(gl, 3, pass.frame.surface.samples, painted.texture);
            gl.uniform_2_i32(offset_at.as_ref(), -x, -y);
            let exponent = if host.encoding == Encoding::Linear { DISPLAY_GAMMA } else { 1.0 };
            gl.uniform_1_f32(exponent_at.as_ref(), exponent);
            self.tiles.draw(gl);
        }
        Ok(())
    }
}
