//! `volume`: stencil shadow volumes.
//!
//! The space that an occluder darkens is bounded by polygons: its silhouette, drawn out away from the light, and
//! caps. A point is in shadow where the line of sight enters such spaces more often than it leaves them, counted in
//! the stencil buffer. There is no depth buffer of the host's to test against, and none is needed: every polygon
//! lies in a plane, and the fragment shader tells on which side the surface is. Theory: docs/theory/volume.md.

mod boundary;
mod buffers;
mod eye;
mod packer;
mod polygon;

use super::method::{Behavior, Make};
use super::options::Field;
use super::{About, Method, Pass};
use crate::gl::{
    Blend, COVERAGE, Caps, ProgramSource, RasterGuard, SURFACE, Stage, StencilBuffer, Target, UploadRing,
    When, set_color_mask,
};
use crate::input::{Choice, Error, Refusal, Scenery};
use crate::masks::{Batch, Counts, GROUP_LIGHTS};
use buffers::VolumeBuffers;
use glow::HasContext;
use packer::{LightDraw, Packer};

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "stencil shadow volumes: hard edges to the pixel, on any surface",
    casts_from: "meshes, open ones too, and every shape; flat ones from both sides",
    falls_on: "anything",
};

/// Which polygons of a volume are counted at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Counting {
    /// Those in front of the point, for volumes that the eye is outside of by a margin; those behind it for
    /// the others. As robust as depth-fail, and nearly as cheap as depth-pass.
    #[default]
    PerVolume,
    /// Those in front of the point, starting from the number of volumes that hold the eye. Within rounding
    /// of a volume's side the eye is on neither, and the picture may be wrong.
    DepthPass,
    /// Those behind the point, caps included.
    DepthFail,
}

impl Counting {
    const ALL: [Self; 3] = [Self::PerVolume, Self::DepthPass, Self::DepthFail];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new(
            "per-volume",
            "Those in front of the point, for volumes that the eye is outside of by a margin; those behind it for the \
             others. As robust as depth-fail, and nearly as cheap as depth-pass.",
        ),
        Choice::new(
            "depth-pass",
            "Those in front of the point, starting from the number of volumes that hold the eye. Within rounding of a \
             volume's side the eye is on neither, and the picture may be wrong.",
        ),
        Choice::new("depth-fail", "Those behind the point, caps included."),
    ];
}

/// Options of the technique `volume`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Which polygons are counted.
    pub counting: Counting,
}

impl Options {
    /// The same with another [`Self::counting`].
    pub fn counting(self, counting: Counting) -> Self {
        Self { counting }
    }
}

impl super::options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[Field::choice(
        "counting",
        "Which polygons are counted.",
        Counting::CHOICES,
        |o| o.counting as usize,
        |o, place| o.counting = Counting::ALL[place],
    )];
}

impl Behavior for Options {}

/// What counts, and what writes where the count is not zero.
pub(super) const PROGRAMS: &[ProgramSource] = &[
    ProgramSource {
        name: "volume_count",
        vertex: Stage { defines: "", parts: &[include_str!("../../shaders/volume/count.vert.glsl")] },
        fragment: Stage {
            defines: "#define SNAP (1.0 / 128.0)\n",
            parts: &[COVERAGE, SURFACE, include_str!("../../shaders/volume/count.frag.glsl")],
        },
        uniforms: &[],
        when: When::ALWAYS,
    },
    ProgramSource::screen(
        "volume_resolve",
        "",
        &[include_str!("../../shaders/volume/resolve.frag.glsl")],
        &[],
    ),
];

/// Indices into [`PROGRAMS`].
const COUNT: usize = 0;
const RESOLVE: usize = 1;

pub(super) fn refusal(_: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    Refusal::of_areas(scenery.lights)
}

/// The OpenGL objects, and the memory of the packing.
pub(super) struct State {
    options: Options,
    stencil: StencilBuffer,
    volumes: VolumeBuffers,
    tiles: UploadRing,
    packer: Packer,
}

impl Make for State {
    type Options = Options;

    unsafe fn make(gl: &glow::Context, _: &Caps, options: Options) -> Result<Self, Error> {
        // SAFETY: the caller's; the first is deleted if the second cannot be made.
        unsafe {
            let mut volumes = VolumeBuffers::new(gl)?;
            let tiles =
                UploadRing::new(gl, size_of::<[f32; 2]>() as i32).inspect_err(|_| volumes.delete(gl))?;
            let (stencil, packer) = (StencilBuffer::default(), Packer::default());
            Ok(Self { options, stencil, volumes, tiles, packer })
        }
    }

    fn set_options(&mut self, options: Options) {
        self.options = options;
    }
}

impl State {
    /// Draws the lights of one mask.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`]; a [`RasterGuard`] is alive, and the mask and stencil are bound.
    unsafe fn draw_mask(
        pass: &Pass<'_>,
        draws: &[LightDraw],
        volumes: glow::VertexArray,
        tiles: glow::VertexArray,
    ) {
        let (gl, caps) = (pass.gl, *pass.caps);
        // SAFETY: the caller's; the ranges are within what was uploaded.
        unsafe {
            for draw in draws {
                let [x, y, width, height] = draw.scissor;
                gl.scissor(x, y, width, height);
                gl.clear_buffer_i32_slice(glow::STENCIL, 0, &[0]);
                set_color_mask(gl, caps, [false; 4]);
                gl.stencil_func(glow::ALWAYS, 0, 0xff);
                gl.stencil_op_separate(glow::FRONT, glow::KEEP, glow::KEEP, glow::INCR_WRAP);
                gl.stencil_op_separate(glow::BACK, glow::KEEP, glow::KEEP, glow::DECR_WRAP);
                pass.use_program(COUNT, pass.mask_offset());
                gl.bind_vertex_array(Some(volumes));
                gl.draw_arrays(glow::TRIANGLES, draw.polygons.0, draw.polygons.1);

                let channel = draw.light % GROUP_LIGHTS;
                set_color_mask(gl, caps, std::array::from_fn(|i| i == channel));
                gl.stencil_func(glow::NOTEQUAL, 0, 0xff);
                gl.stencil_op(glow::KEEP, glow::KEEP, glow::KEEP);
                gl.use_program(Some(pass.program(RESOLVE).raw));
                gl.bind_vertex_array(Some(tiles));
                gl.draw_arrays(glow::TRIANGLES, draw.tiles.0, draw.tiles.1);
            }
        }
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        self.packer.begin(pass);
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        self.packer.pack(pass, self.options.counting, batch);
        if self.packer.draws.is_empty() {
            return Ok(());
        }
        let gl = pass.gl;
        // SAFETY: the caller's.
        unsafe {
            let volumes = self.volumes.upload(gl, &self.packer.vertices)?;
            let tiles = bytemuck::cast_slice(&self.packer.tiles);
            let tiles = self.tiles.upload(gl, pass.caps, tiles, &mut Vec::new())?.vertex_array;
            let _guard = RasterGuard::new(gl, pass.host);
            Blend::Min.apply(gl, *pass.caps);
            gl.enable(glow::STENCIL_TEST);
            gl.enable(glow::SCISSOR_TEST);
            let draws = &self.packer.draws;
            let split = draws.partition_point(|draw| draw.light < GROUP_LIGHTS);
            let (first, second) = draws.split_at(split);
            for (mask, draws) in batch.masks.into_iter().zip([first, second]) {
                if draws.is_empty() {
                    continue;
                }
                let drawn = Self::draw_to(&mut self.stencil, pass, mask, draws, volumes, tiles);
                StencilBuffer::detach(gl, mask);
                drawn?;
            }
        }
        Ok(())
    }

    fn counts(&self) -> Counts {
        self.packer.counts
    }

    unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.stencil.delete(gl);
            self.volumes.delete(gl);
            self.tiles.delete(gl);
        }
    }
}

impl State {
    /// # Safety
    /// As for [`Self::draw_mask`], which it readies the mask for.
    unsafe fn draw_to(
        stencil: &mut StencilBuffer,
        pass: &Pass<'_>,
        mask: &Target,
        draws: &[LightDraw],
        volumes: glow::VertexArray,
        tiles: glow::VertexArray,
    ) -> Result<(), Error> {
        // SAFETY: the caller's; the host's colour mask is the guard's to put back, and all channels are antumbra's.
        unsafe {
            stencil.attach(pass, mask)?;
            Self::draw_mask(pass, draws, volumes, tiles);
            set_color_mask(pass.gl, *pass.caps, [true; 4]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
