//! `analytic`: exact closed forms on any surface.
//!
//! Each pair of light and occluder is bounded by a convex polygon on the screen; in its pixels the closed form of
//! `antumbra_math::blocking` gives the visibility, blended by minimum: for lights without extent that is the
//! union of the occluders. Theory: docs/theory/analytic.md.

mod area_light;
mod kind;
mod pairs;
mod seams;
mod union;

use super::method::{Behavior, Make};
use super::options::Field;
use super::polygons::Vertex;
use super::{About, Method, Pass};
use crate::gl::{Caps, UploadRing};
use crate::input::{Choice, Error, Part, Reason, Refusal, Scenery};
use crate::masks::{Batch, Counts};
use glow::HasContext;
pub(super) use kind::PROGRAMS;
use kind::{Kind, SoftShape};
use pairs::PairBuilder;

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "exact closed forms, antialiased by the area of the pixel, without bias",
    casts_from: "planes, rectangles, discs, triangles, spheres, cones and unions of them",
    falls_on: "anything",
};

/// How the shadows that several occluders cast from one light with an area are put together. Of lights without
/// area the union is exact in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quality {
    /// By the product of what each leaves: exact where one hides all or nothing, between the least and the most that they
    /// can hide together elsewhere.
    #[default]
    Fast,
    /// By the union of what they hide, on 24 strips of the light: several times the cost.
    Exact,
}

impl Quality {
    const ALL: [Self; 2] = [Self::Fast, Self::Exact];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new(
            "fast",
            "By the product of what each leaves: exact where one hides all or nothing, between the least and the most that \
             they can hide together elsewhere.",
        ),
        Choice::new(
            "exact",
            "By the union of what they hide, on 24 strips of the light: several times the cost.",
        ),
    ];
}

/// Options of the technique `analytic`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Where the shadows of several occluders overlap.
    pub quality: Quality,
}

impl Options {
    /// The same with another [`Self::quality`].
    pub fn quality(self, quality: Quality) -> Self {
        Self { quality }
    }
}

impl super::options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[Field::choice(
        "quality",
        "Where the shadows of several occluders overlap.",
        Quality::CHOICES,
        |o| o.quality as usize,
        |o, place| o.quality = Quality::ALL[place],
    )];
}

impl Behavior for Options {
    fn is_exact(&self) -> bool {
        self.quality == Quality::Exact
    }
}

pub(super) fn refusal(_: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    if !scenery.meshes.is_empty() {
        return Some(Refusal::new(Part::Mesh(0), Reason::NoFormForMeshes));
    }
    let other = scenery.occluders.iter().position(|o| SoftShape::of(&o.shape).is_none())?;
    Some(Refusal::new(Part::Occluder(other), Reason::NoFormForShape))
}

/// The OpenGL objects, and the memory of the packing.
pub(super) struct State {
    options: Options,
    uploads: UploadRing,
    pairs: PairBuilder,
}

impl Make for State {
    type Options = Options;

    unsafe fn make(gl: &glow::Context, _: &Caps, options: Options) -> Result<Self, Error> {
        // SAFETY: the caller's.
        let uploads = unsafe { UploadRing::new(gl, size_of::<Vertex>() as i32)? };
        Ok(Self { options, uploads, pairs: PairBuilder::default() })
    }

    fn set_options(&mut self, options: Options) {
        self.options = options;
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        self.pairs.begin(&pass.frame, pass.view);
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        self.pairs.pack(batch.lights, pass.view, batch.tiles, self.options.is_exact());
        if self.pairs.draws.is_empty() {
            return Ok(());
        }
        let gl = pass.gl;
        // SAFETY: the caller's.
        unsafe {
            let vertices = bytemuck::cast_slice(&self.pairs.vertices);
            let upload = self.uploads.upload(gl, pass.caps, vertices, &mut self.pairs.texels)?;
            gl.bind_vertex_array(Some(upload.vertex_array));
            gl.active_texture(glow::TEXTURE3);
            gl.bind_texture(glow::TEXTURE_2D, Some(upload.texture));
            for (group, target) in batch.masks.iter().enumerate() {
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                for draw in self.pairs.draws.iter().filter(|draw| draw.group == group) {
                    Kind::blend(draw.kind).apply(gl, *pass.caps);
                    let program = pass.use_program(draw.kind, pass.mask_offset());
                    gl.uniform_1_i32(program.uniforms.blockers.as_ref(), 3);
                    gl.draw_arrays(glow::TRIANGLES, draw.first, draw.count);
                }
            }
        }
        Ok(())
    }

    fn counts(&self) -> Counts {
        self.pairs.counts
    }

    unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe { self.uploads.delete(gl) };
    }
}
