//! `composite`: the closed forms of the composite method on one plane, as published.
//!
//! Each pair of light and occluder becomes a disc, a triangle, or both, on the receiver
//! (`antumbra_math::composite`), bounded by a polygon on the screen. The papers' shade is painted over the host's
//! pixels; or the same parts take the light's contribution, blended by minimum. Theory: docs/theory/composite.md.

mod components;
mod parts;

use super::method::{Behavior, Make, Painter};
use super::options::Field;
use super::polygons::Vertex;
use super::{About, Method, Pass};
use crate::gl::{Blend, COVERAGE, Caps, Program, ProgramSource, SURFACE, Stage, UploadRing, When};
use crate::input::{Choice, Error, Part, Reason, Receiver, ReceiverShape, Refusal, Scenery, Unsupported};
use crate::masks::{BATCH_LIGHTS, Batch, Counts, HostPicture};
use crate::screen::TileGrid;
use antumbra_math::Light as Place;
pub use antumbra_math::composite::SphereForm;
use antumbra_math::plane_shadow::{Bounds, PlaneFrame};
use components::Collected;
use glow::HasContext;
#[cfg(test)]
pub(crate) use parts::linear_grey;
use parts::{Drawn, PartBuilder};

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "the closed forms and the painted shade of the papers of 2013 and 2017",
    casts_from: "discs parallel to the receiver, triangles, spheres, cones standing upright, and unions of them",
    falls_on: "one plane or rectangle",
};

/// What a shadow does to the receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shade {
    /// The papers': the grey 255 k of Eq. (1), opaque, in all channels. Lights are drawn one after the other: of
    /// two shadows that overlap, the later light's is seen; of one light's, the darker.
    #[default]
    Paper,
    /// It takes the light's contribution, and no other's.
    Physical,
}

impl Shade {
    const ALL: [Self; 2] = [Self::Paper, Self::Physical];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new(
            "paper",
            "The papers': the grey 255 k of Eq. (1), opaque, in all channels. Lights are drawn one after the other: of \
             two shadows that overlap, the later light's is seen; of one light's, the darker.",
        ),
        Choice::new("physical", "It takes the light's contribution, and no other's."),
    ];
}

const SPHERE_FORMS: [SphereForm; 2] = [SphereForm::Circle, SphereForm::Tangent];
/// In the same order.
const SPHERE_CHOICES: &[Choice] = &[
    Choice::new("circle", "The sphere's own radius about its own centre, as in 2013. Always too small."),
    Choice::new(
        "tangent",
        "The circle in which the light's rays touch the sphere, as in 2017. Exact with the light straight above.",
    ),
];

/// Options of the technique `composite`. [`components()`](crate::components()) says where the components of a light with an
/// area are, and [`crate::Frame::components`] puts them elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// What the overlay draws. Masks are the physical visibility either way.
    pub shade: Shade,
    /// The circle that stands for a sphere.
    pub sphere: SphereForm,
    /// Point lights that a light with an area is a collection of, painted: one in its centre, the others on its
    /// rim. 1 to 64.
    pub components: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self { shade: Shade::Paper, sphere: SphereForm::Tangent, components: 3 }
    }
}

impl Options {
    /// The same with another [`Self::shade`].
    pub fn shade(self, shade: Shade) -> Self {
        Self { shade, ..self }
    }

    /// The same with another form of [`Self::sphere`].
    pub fn sphere(self, sphere: SphereForm) -> Self {
        Self { sphere, ..self }
    }

    /// The same with so many [`Self::components`].
    pub fn components(self, components: u32) -> Self {
        Self { components, ..self }
    }
}

impl super::options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[
        Field::choice(
            "shade",
            "What the overlay draws. Masks are the physical visibility either way.",
            Shade::CHOICES,
            |o| o.shade as usize,
            |o, place| o.shade = Shade::ALL[place],
        ),
        Field::choice(
            "sphere",
            "The circle that stands for a sphere.",
            SPHERE_CHOICES,
            |o| usize::from(o.sphere == SphereForm::Tangent),
            |o, place| o.sphere = SPHERE_FORMS[place],
        ),
        Field::whole(
            "components",
            "Point lights that a light with an area is a collection of, painted: one in its centre, the others on its rim.",
            (1, 64),
            |o| o.components,
            |o, count| o.components = count,
        ),
    ];
}

impl Behavior for Options {
    fn paints(&self) -> bool {
        self.shade == Shade::Paper
    }

    fn components(&self) -> Option<u32> {
        self.paints().then_some(self.components)
    }
}

macro_rules! part_program {
    ($name:literal, $defines:literal) => {
        ProgramSource {
            name: $name,
            vertex: Stage {
                defines: "#define BLOCKER_TEXELS 4\n",
                parts: &[include_str!("../../shaders/analytic/blocker.vert.glsl")],
            },
            fragment: Stage {
                defines: concat!("#define BLOCKER_TEXELS 4\n", $defines),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    include_str!("../../shaders/composite/part.glsl"),
                    include_str!("../../shaders/composite/part.frag.glsl"),
                ],
            },
            uniforms: &["u_receiver", "u_receiver_id", "u_darkness"],
            when: When::ALWAYS,
        }
    };
}

macro_rules! screen_program {
    ($name:literal, $file:literal, $uniforms:expr) => {
        ProgramSource::screen(
            $name,
            "",
            &[
                COVERAGE,
                SURFACE,
                include_str!("../../shaders/composite/grey.glsl"),
                include_str!(concat!("../../shaders/composite/", $file)),
            ],
            $uniforms,
        )
    };
}

/// What it compiles, in the order of [`VISIBILITY`] to [`SOFT_PAINT`].
pub(super) const PROGRAMS: &[ProgramSource] = &[
    part_program!("composite visibility", ""),
    part_program!("composite paint", "#define PAINT\n"),
    part_program!("composite components", "#define COVER\n"),
    screen_program!("composite gather", "gather.frag.glsl", &["u_cover", "u_dark", "u_share"]),
    screen_program!("composite soft paint", "soft_paint.frag.glsl", &["u_sums", "u_sums_offset", "u_linear"]),
];
const VISIBILITY: usize = 0;
const PAINT: usize = 1;
const COVER: usize = 2;
const GATHER: usize = 3;
const SOFT_PAINT: usize = 4;

pub(super) fn refusal(options: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    // Painted, they are collections of points.
    if !options.paints()
        && let Some(refusal) = Refusal::of_areas(scenery.lights)
    {
        return Some(refusal);
    }
    let refused = |part, reason| Some(Refusal::new(part, reason));
    let receiver = match scenery.receivers {
        [receiver] => receiver,
        [] => return refused(Part::Receivers, Reason::NoReceiver),
        _ => return refused(Part::Receivers, Reason::SeveralReceivers),
    };
    let Some((frame, _)) = receiver_frame(receiver) else {
        return refused(Part::Receivers, Reason::FlatReceiver);
    };
    if options.paints() {
        let is_point = |place| matches!(place, Place::Point { .. });
        if let Some(light) = scenery.lights.iter().position(|light| !is_point(light.place)) {
            return refused(Part::Light(light), Reason::PaintedPointsAlone);
        }
    }
    if !scenery.meshes.is_empty() {
        return refused(Part::Mesh(0), Reason::NoEquationsForMeshes);
    }
    let others = scenery.occluders.iter().enumerate().filter(|(_, o)| o.id == 0 || o.id != receiver.id);
    let mut refusals = others.filter_map(|(i, o)| {
        let why = antumbra_math::composite::refusal(&o.shape, &frame)?;
        Some(Refusal::new(Part::Occluder(i), Reason::NoEquations(why)))
    });
    refusals.next()
}

/// The receiver's plane, and where in it the receiver lies. `None` for one without extent or with a number that is
/// not finite.
fn receiver_frame(receiver: &Receiver) -> Option<(PlaneFrame, Bounds)> {
    match &receiver.shape {
        ReceiverShape::Plane(plane) => Some((PlaneFrame::of_plane(plane)?, Bounds::EVERYTHING)),
        ReceiverShape::Rectangle(rectangle) => PlaneFrame::of_rectangle(rectangle),
    }
}

/// The OpenGL objects, and the memory of the packing.
pub(super) struct State {
    options: Options,
    uploads: UploadRing,
    parts: PartBuilder,
    collected: Collected,
}

impl Make for State {
    type Options = Options;

    unsafe fn make(gl: &glow::Context, _: &Caps, options: Options) -> Result<Self, Error> {
        // SAFETY: the caller's.
        let uploads = unsafe { UploadRing::new(gl, size_of::<Vertex>() as i32)? };
        Ok(Self { options, uploads, parts: PartBuilder::default(), collected: Collected::default() })
    }

    fn set_options(&mut self, options: Options) {
        self.options = options;
    }
}

impl State {
    /// Uploads the packed parts and binds them.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    unsafe fn upload(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        let gl = pass.gl;
        let vertices = bytemuck::cast_slice(&self.parts.vertices);
        // SAFETY: the caller's.
        unsafe {
            let upload = self.uploads.upload(gl, pass.caps, vertices, &mut self.parts.texels)?;
            gl.bind_vertex_array(Some(upload.vertex_array));
            gl.active_texture(glow::TEXTURE3);
            gl.bind_texture(glow::TEXTURE_2D, Some(upload.texture));
        }
        Ok(())
    }

    /// What the fragment shader reads besides the surface.
    ///
    /// # Safety
    /// The program is in use.
    unsafe fn set_receiver(&self, pass: &Pass<'_>, program: &Program) {
        let id = pass.frame.receivers.first().map_or(0, |receiver| receiver.id);
        let planes: &[f32] = bytemuck::cast_slice(&self.parts.receiver);
        // SAFETY: the caller's.
        unsafe {
            pass.gl.uniform_1_i32(program.uniforms.blockers.as_ref(), 3);
            pass.gl.uniform_4_f32_slice(program.own[0].as_ref(), planes);
            pass.gl.uniform_1_u32(program.own[1].as_ref(), id);
        }
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        self.parts.begin(&pass.frame, pass.view, &self.options);
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        self.parts.pack(batch.lights, pass.view, Drawn::Visibility(batch.tiles));
        if self.parts.vertices.is_empty() {
            return Ok(());
        }
        let gl = pass.gl;
        // SAFETY: the caller's.
        unsafe {
            self.upload(pass)?;
            Blend::Min.apply(gl, *pass.caps);
            for (target, &(first, count)) in batch.masks.iter().zip(&self.parts.groups) {
                if count > 0 {
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                    let program = pass.use_program(VISIBILITY, pass.mask_offset());
                    self.set_receiver(pass, program);
                    gl.draw_arrays(glow::TRIANGLES, first, count);
                }
            }
        }
        Ok(())
    }

    fn painter(&mut self) -> Option<&mut dyn Painter> {
        Some(self)
    }

    fn counts(&self) -> Counts {
        self.parts.counts
    }

    unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.uploads.delete(gl);
            self.collected.delete(gl);
        }
    }
}

impl Painter for State {
    unsafe fn paint(
        &mut self,
        pass: &Pass<'_>,
        host: HostPicture,
        tiles: &mut TileGrid,
    ) -> Result<(), Error> {
        let (gl, all, components) = (pass.gl, pass.frame.lights, self.options.components);
        let mut next = 0;
        // In batches, so that memory does not depend on the number of lights; in their order, since later ones are
        // painted over earlier ones.
        while next < all.len() {
            if self.collected.take(&pass.frame, next, components) {
                if !pass.caps.float_targets() {
                    return Err(Error::Unsupported(Unsupported::PaintedAreas));
                }
                // SAFETY: the caller's.
                unsafe { self.paint_collection(pass, host, tiles)? };
                next += 1;
                continue;
            }
            let first = next;
            next += 1;
            while next < all.len().min(first + BATCH_LIGHTS)
                && !self.collected.take(&pass.frame, next, components)
            {
                next += 1;
            }
            let lights = &all[first..next];
            self.parts.pack(lights, pass.view, Drawn::Shade(host.encoding, tiles));
            if self.parts.vertices.is_empty() {
                continue;
            }
            // SAFETY: the caller's.
            unsafe {
                self.upload(pass)?;
                Blend::Over.apply(gl, *pass.caps);
                let program = pass.use_program(PAINT, [0, 0]);
                self.set_receiver(pass, program);
                // Primitives are drawn in their order: the later one over the earlier.
                gl.draw_arrays(glow::TRIANGLES, 0, self.parts.vertices.len() as i32);
            }
        }
        Ok(())
    }
}
