//! `analytic`: exact closed forms on any surface.
//!
//! Each pair of light and occluder is bounded by a convex polygon on the screen; in its pixels the closed form of
//! `antumbra_math::blocking` gives the visibility, blended by minimum: for lights without extent that is the
//! union of the occluders. Theory: docs/theory/analytic.md.

use super::options::{choices, options};
use super::{About, Batch, Behavior, Method, Part, Pass, Refusal};
use crate::pairs::{HARD_KINDS, PairBuilder, Vertex};
use crate::resources::UploadRing;
use crate::results::Counts;
use crate::scenery::Scenery;
use crate::shader::{AREA, COVERAGE, LightKind, ProgramSource, SURFACE, Stage};
use crate::state::Blend;
use crate::{Caps, Error};
use glow::HasContext;

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "exact closed forms, antialiased by the area of the pixel, without bias",
    casts_from: "planes, rectangles, discs, triangles, spheres, cones and unions of them",
    falls_on: "anything",
};

choices! {
    /// How the shadows that several occluders cast from one light with an area are put together. Of lights without
    /// area the union is exact in any case.
    pub enum Quality {
        /// By the product of what each leaves: exact where they do not hide the same part of the light.
        Fast = "fast",
        /// By the union of what they hide, on 24 strips of the light: several times the cost.
        Exact = "exact",
    }
}

options! {
    /// Options of the technique `analytic`.
    pub struct Options {
        /// Where the shadows of several occluders overlap.
        pub quality: Quality = Quality::Fast, ();
    }
}

impl Behavior for Options {
    fn is_exact(&self) -> bool {
        self.quality == Quality::Exact
    }
}

macro_rules! blocker_program {
    ($name:literal, $texels:literal, $file:literal) => {
        ProgramSource {
            name: $name,
            vertex: Stage {
                defines: concat!("#define BLOCKER_TEXELS ", $texels, "\n"),
                parts: &[include_str!("../shaders/analytic/blocker.vert.glsl")],
            },
            fragment: Stage {
                defines: concat!("#define BLOCKER_TEXELS ", $texels, "\n"),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    include_str!("../shaders/analytic/blocker_data.glsl"),
                    include_str!(concat!("../shaders/analytic/", $file)),
                    include_str!("../shaders/analytic/blocker.frag.glsl"),
                ],
            },
            uniforms: &[],
            lights: LightKind::Any,
        }
    };
}

macro_rules! soft_program {
    ($name:literal, $kind:ident, $light:literal, $texels:literal, $shape:literal) => {
        ProgramSource {
            name: $name,
            vertex: Stage {
                defines: concat!("#define BLOCKER_TEXELS ", $texels, "\n"),
                parts: &[include_str!("../shaders/analytic/blocker.vert.glsl")],
            },
            fragment: Stage {
                defines: concat!(
                    "#define BLOCKER_TEXELS ",
                    $texels,
                    "\n#define LIGHT_TEXELS ",
                    $light,
                    "\n#define ",
                    $shape,
                    "\n"
                ),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    AREA,
                    include_str!("../shaders/analytic/blocker_data.glsl"),
                    include_str!("../shaders/analytic/soft.glsl"),
                    include_str!("../shaders/analytic/soft_light.glsl"),
                    include_str!("../shaders/analytic/soft.frag.glsl"),
                ],
            },
            uniforms: &[],
            lights: LightKind::$kind,
        }
    };
}

macro_rules! union_program {
    ($name:literal, $kind:ident, $light:literal) => {
        ProgramSource {
            name: $name,
            vertex: Stage {
                defines: "#define BLOCKER_TEXELS 2\n",
                parts: &[include_str!("../shaders/analytic/blocker.vert.glsl")],
            },
            fragment: Stage {
                defines: concat!(
                    "#define BLOCKER_TEXELS 2\n#define CORNERS 4\n#define CONE\n#define LIGHT_TEXELS ",
                    $light,
                    "\n"
                ),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    AREA,
                    include_str!("../shaders/analytic/soft.glsl"),
                    include_str!("../shaders/analytic/soft_light.glsl"),
                    include_str!("../shaders/analytic/union.frag.glsl"),
                ],
            },
            uniforms: &[],
            lights: LightKind::$kind,
        }
    };
}

/// A program for each kind of blocker, in the order of `pairs::pack_blocker`; then for each kind of occluder past a
/// ball, and past a flat light, in the order of `AreaLight::pack_pair`.
pub(super) const PROGRAMS: &[ProgramSource] = &[
    blocker_program!("sphere", "2", "sphere.glsl"),
    blocker_program!("disc", "3", "disc.glsl"),
    blocker_program!("polygon", "5", "polygon.glsl"),
    soft_program!("sphere light, sphere", Ball, "1", "2", "SPHERE"),
    soft_program!("sphere light, disc", Ball, "1", "3", "DISC"),
    soft_program!("sphere light, triangle", Ball, "1", "4", "CORNERS 3"),
    soft_program!("sphere light, rectangle", Ball, "1", "5", "CORNERS 4"),
    soft_program!("sphere light, cone", Ball, "1", "3", "CONE"),
    soft_program!("sphere light, plane", Ball, "1", "2", "PLANE"),
    soft_program!("flat light, sphere", Flat, "4", "5", "SPHERE"),
    soft_program!("flat light, disc", Flat, "4", "6", "DISC"),
    soft_program!("flat light, triangle", Flat, "4", "7", "CORNERS 3"),
    soft_program!("flat light, rectangle", Flat, "4", "8", "CORNERS 4"),
    soft_program!("flat light, cone", Flat, "4", "6", "CONE"),
    soft_program!("flat light, plane", Flat, "4", "5", "PLANE"),
    union_program!("sphere light, all", ExactBall, "1"),
    union_program!("flat light, all", ExactFlat, "4"),
];

pub(super) fn refusal(_: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    let refusal = || Refusal { part: Part::Mesh(0), reason: "has no closed form for meshes".into() };
    (!scenery.meshes.is_empty()).then(refusal)
}

/// The OpenGL objects, and the memory of the packing.
pub(super) struct State {
    uploads: UploadRing,
    pairs: PairBuilder,
}

impl State {
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(super) unsafe fn new(gl: &glow::Context, _: &Caps) -> Result<Self, Error> {
        // SAFETY: the caller's.
        let uploads = unsafe { UploadRing::new(gl, size_of::<Vertex>() as i32)? };
        Ok(Self { uploads, pairs: PairBuilder::default() })
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        self.pairs.begin(pass.frame.occluders, pass.frame.bounds, pass.view);
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        self.pairs.pack(batch.lights, pass.view, batch.tiles, pass.technique.is_exact());
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
                    // Of lights without extent the union of shadows is the darkest; of others the product is between
                    // the least and the most that several can take together.
                    let blend = if draw.kind < HARD_KINDS { Blend::Min } else { Blend::Product };
                    blend.apply(gl, *pass.caps);
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
