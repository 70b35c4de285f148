//! From visibility to the host's picture: what the lights send, and what the shadows take of it.

use super::batch::Masks;
use super::lights::packed;
use crate::gl::{
    AREA, Blend, COVERAGE, Caps, Drawing, HostDraw, Needs, Program, ProgramSet, ProgramSource, SURFACE,
    Target, TargetFormat, TileMesh, Variant, When, bind_texture,
};
use crate::input::{Encoding, Error, Light};
use crate::screen::TileGrid;
use glow::HasContext;

/// What a batch's masks say of a pixel; needs [`SURFACE`].
pub(super) const MASKS: &str = include_str!("../shaders/masks.glsl");

/// The parts of a pass that sums over lights.
const SUMS: &[&str] = &[
    COVERAGE,
    SURFACE,
    MASKS,
    AREA,
    include_str!("../shaders/lights.glsl"),
    include_str!("../shaders/irradiance.frag.glsl"),
];

/// The three passes over lights of one kind.
macro_rules! sums {
    ($name:literal, $lights:literal, $when:expr) => {
        [
            sum(concat!("overlay", $name), concat!($lights, "#define OVERLAY\n"), $when),
            sum(concat!("taken", $name), concat!($lights, "#define TAKEN\n"), $when),
            sum(concat!("all", $name), concat!($lights, "#define ALL\n"), $when),
        ]
    };
}

const fn sum(name: &'static str, defines: &'static str, when: When) -> ProgramSource {
    ProgramSource { when, ..ProgramSource::screen(name, defines, SUMS, &[]) }
}

/// The passes that sum over lights, for points alone, for balls too, and for flat lights too; then the same for lights that
/// weaken in any way.
pub(crate) const SUM_PROGRAMS: &[ProgramSource] = [
    sums!("", "", When::ALWAYS.falloff(false)),
    sums!(", balls", "#define ANTUMBRA_BALL_LIGHTS\n", When::BALLS.falloff(false)),
    sums!(", flat lights", "#define ANTUMBRA_FLAT_LIGHTS\n", When::FLATS.falloff(false)),
    sums!(", any falloff", "#define ANTUMBRA_FALLOFF\n", When::ALWAYS.falloff(true)),
    sums!(
        ", balls, any falloff",
        "#define ANTUMBRA_FALLOFF\n#define ANTUMBRA_BALL_LIGHTS\n",
        When::BALLS.falloff(true)
    ),
    sums!(
        ", flat lights, any falloff",
        "#define ANTUMBRA_FALLOFF\n#define ANTUMBRA_FLAT_LIGHTS\n",
        When::FLATS.falloff(true)
    ),
]
.as_flattened();

/// The ratio of the sums.
pub(crate) const RATIO_PROGRAM: &[ProgramSource] = &[ProgramSource::screen(
    "ratio",
    "",
    &[COVERAGE, SURFACE, include_str!("../shaders/ratio.frag.glsl")],
    &[],
)];

/// What a pass computes; the first three in the order of [`SUM_PROGRAMS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pass {
    /// The factor on the host's pixels, of one batch.
    Overlay,
    /// What shadows take, to be summed.
    Taken,
    /// What lights send, to be summed.
    All,
    /// The factor from the sums.
    Ratio,
}

impl Pass {
    /// The place in [`SUM_PROGRAMS`] for these lights, in a frame in which some weaken in any way or none does: what area
    /// lights send costs more to find.
    fn index(self, lights: &[Light], falloff: bool) -> usize {
        let needs = Needs::of(lights);
        let kind = if needs.flats { 2 } else { usize::from(needs.balls) };
        9 * usize::from(falloff) + 3 * kind + self as usize
    }
}

/// The host's picture and how it is encoded.
#[derive(Clone, Copy)]
pub(crate) struct HostPicture {
    pub(crate) framebuffer: Option<glow::Framebuffer>,
    pub(crate) encoding: Encoding,
}

/// Where a pass draws to.
#[derive(Clone, Copy)]
enum To<'a> {
    /// It adds to a sum, as large as the viewport.
    Sum(Option<&'a Target>),
    /// It multiplies the host's pixels.
    Host(HostPicture),
}

/// One pass over the touched tiles.
struct Step<'a> {
    pass: Pass,
    lights: &'a [Light],
    tiles: &'a TileGrid,
    /// The masks, or the sums of what is taken and of all.
    inputs: [Option<&'a Target>; 2],
    to: To<'a>,
}

/// The passes that turn visibility into a factor on the host's pixels.
pub(crate) struct Overlay {
    steps: Steps,
    /// What shadows take, and what the lights send in all, summed over batches.
    taken: Option<Target>,
    all: Option<Target>,
}

impl Overlay {
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        // SAFETY: the caller's.
        let screen = unsafe { TileMesh::new(gl)? };
        let steps = Steps { sums: ProgramSet::default(), ratio: ProgramSet::default(), screen };
        Ok(Self { steps, taken: None, all: None })
    }

    /// Compiles the programs for such surfaces, unless it was done.
    pub(crate) fn warm_up(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        variant: Variant,
        needs: Needs,
    ) -> Result<(), Error> {
        self.steps.sums.ensure(gl, caps, SUM_PROGRAMS, variant, needs)?;
        self.steps.ratio.ensure(gl, caps, RATIO_PROGRAM, variant, needs)
    }

    /// Multiplies the host's pixels by the factor, where one batch has all lights.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, the surface's textures exist, [`Self::warm_up`] was called for the frame.
    pub(crate) unsafe fn multiply(
        &mut self,
        drawing: &Drawing<'_>,
        lights: &[Light],
        masks: &Masks,
        host: HostPicture,
    ) -> Result<(), Error> {
        let (inputs, to) = (masks.targets().map(Some), To::Host(host));
        // SAFETY: the caller's.
        unsafe {
            self.steps.draw(drawing, &Step { pass: Pass::Overlay, lights, tiles: &masks.tiles, inputs, to })
        }
    }

    /// Makes and clears the sums over batches, for frames of several.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    pub(crate) unsafe fn clear_sums(&mut self, drawing: &Drawing<'_>) -> Result<(), Error> {
        for slot in [&mut self.taken, &mut self.all] {
            // SAFETY: the caller's.
            unsafe {
                drawing.ensure_target(slot, TargetFormat::Rgba32F)?;
                let target = slot.as_ref().expect("made above");
                drawing.gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                drawing.gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
            }
        }
        Ok(())
    }

    /// Adds what shadows take of a batch's lights.
    ///
    /// # Safety
    /// As for [`Self::multiply`]; [`Self::clear_sums`] was called for the frame.
    pub(crate) unsafe fn add_taken(
        &mut self,
        drawing: &Drawing<'_>,
        lights: &[Light],
        masks: &Masks,
    ) -> Result<(), Error> {
        let (inputs, to) = (masks.targets().map(Some), To::Sum(self.taken.as_ref()));
        // SAFETY: the caller's.
        unsafe {
            self.steps.draw(drawing, &Step { pass: Pass::Taken, lights, tiles: &masks.tiles, inputs, to })
        }
    }

    /// Adds what a batch's lights send, in the tiles that shadows of any batch touch.
    ///
    /// # Safety
    /// As for [`Self::add_taken`], which was called for all batches.
    pub(crate) unsafe fn add_all(
        &mut self,
        drawing: &Drawing<'_>,
        lights: &[Light],
        tiles: &TileGrid,
    ) -> Result<(), Error> {
        let (inputs, to) = ([self.taken.as_ref(), None], To::Sum(self.all.as_ref()));
        // SAFETY: the caller's.
        unsafe { self.steps.draw(drawing, &Step { pass: Pass::All, lights, tiles, inputs, to }) }
    }

    /// Multiplies the host's pixels by the factor that follows from the sums.
    ///
    /// # Safety
    /// As for [`Self::add_all`], which was called for all batches.
    pub(crate) unsafe fn multiply_by_ratio(
        &mut self,
        drawing: &Drawing<'_>,
        tiles: &TileGrid,
        host: HostPicture,
    ) -> Result<(), Error> {
        let (inputs, to) = ([self.taken.as_ref(), self.all.as_ref()], To::Host(host));
        // SAFETY: the caller's.
        unsafe { self.steps.draw(drawing, &Step { pass: Pass::Ratio, lights: &[], tiles, inputs, to }) }
    }

    /// # Safety
    /// The context is current, and the overlay is not used afterwards.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.steps.sums.delete(gl);
            self.steps.ratio.delete(gl);
            self.steps.screen.delete(gl);
            let targets = [&mut self.taken, &mut self.all];
            targets.into_iter().filter_map(Option::take).for_each(|target| target.delete(gl));
        }
    }
}

/// What every pass draws with.
struct Steps {
    sums: ProgramSet,
    ratio: ProgramSet,
    screen: TileMesh,
}

impl Steps {
    /// Draws one of the passes; nothing where no tile is touched.
    ///
    /// # Safety
    /// As for [`Overlay::multiply`].
    unsafe fn draw(&mut self, drawing: &Drawing<'_>, step: &Step<'_>) -> Result<(), Error> {
        let (gl, caps) = (drawing.gl, *drawing.caps);
        let [x, y, width, height] = drawing.view.viewport;
        // SAFETY: the caller's.
        unsafe {
            if !self.screen.bind(drawing, step.tiles)? {
                return Ok(());
            }
            let variant = Variant::of(&drawing.frame.surface);
            let program = match step.pass {
                Pass::Ratio => &self.ratio.of(variant)[0],
                pass => &self.sums.of(variant)[pass.index(step.lights, drawing.needs.falloff)],
            };
            let program = program.as_ref().expect("compiled for the frame");
            // The host's framebuffer has the viewport's corner at (x, y), antumbra's own at (0, 0).
            match step.to {
                To::Sum(target) => {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, target.map(|t| t.framebuffer));
                    gl.viewport(0, 0, width, height);
                    Blend::Add.apply(gl, caps);
                    drawing.use_program(program, drawing.mask_offset());
                    set(drawing, program, step, [0, 0]);
                    self.screen.draw(gl);
                }
                To::Host(host) => {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
                    gl.viewport(x, y, width, height);
                    Blend::Multiply.apply(gl, caps);
                    drawing.use_program(program, [0, 0]);
                    set(drawing, program, step, [-x, -y]);
                    gl.uniform_1_f32(program.uniforms.gamma.as_ref(), host.encoding.gamma());
                    let host = HostDraw::begin(drawing, host.framebuffer);
                    self.screen.draw(gl);
                    host.end(gl);
                }
            }
        }
        Ok(())
    }
}

/// Sets what the passes read beside the surface; `offset` leads from the target's pixels to the inputs' texels.
///
/// # Safety
/// The program is the pass's, and in use.
unsafe fn set(drawing: &Drawing<'_>, program: &Program, step: &Step<'_>, offset: [i32; 2]) {
    let (gl, u, lights) = (drawing.gl, &program.uniforms, step.lights);
    let locations = match step.pass {
        Pass::Overlay | Pass::Taken => [&u.visibility_0, &u.visibility_1],
        Pass::All | Pass::Ratio => [&u.taken, &u.all],
    };
    // SAFETY: the caller's.
    unsafe {
        for (unit, (location, target)) in (3..).zip(locations.into_iter().zip(step.inputs)) {
            if let Some(target) = target {
                gl.uniform_1_i32(location.as_ref(), unit);
                bind_texture(gl, unit as u32, drawing.frame.surface.samples, target.texture);
            }
        }
        gl.uniform_2_i32(u.visibility_offset.as_ref(), offset[0], offset[1]);
        gl.uniform_3_f32_slice(u.ambient.as_ref(), &drawing.frame.ambient.to_array());
        if !lights.is_empty() {
            let data = packed(lights, drawing.view);
            gl.uniform_4_f32_slice(u.lights.as_ref(), bytemuck::cast_slice(&data));
            gl.uniform_1_i32(u.light_count.as_ref(), lights.len() as i32);
        }
    }
}
