//! The host's shader programs.

use crate::HostError;
use crate::link::link_program;
use antumbra::{Area, Falloff, Light};
use glow::HasContext;

/// Lights in one pass: what the smallest uniform block that OpenGL allows can hold.
pub(crate) const MAX_LIGHTS: usize = 128;

/// What a program draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Exact shapes, met by the eye's ray in a box round each.
    Cast,
    /// Triangles.
    Triangles,
}

/// Draws primitives of one kind.
pub(crate) struct Program {
    pub(crate) raw: glow::Program,
    pub(crate) kind: Kind,
    pub(crate) uniforms: Uniforms,
}

macro_rules! uniforms {
    ($($field:ident),* $(,)?) => {
        /// Uniform locations.
        pub(crate) struct Uniforms {
            $(pub(crate) $field: Option<glow::UniformLocation>,)*
        }

        impl Uniforms {
            /// # Safety
            /// `program` is a linked program of the context.
            unsafe fn find(gl: &glow::Context, program: glow::Program) -> Self {
                // SAFETY: the caller's.
                unsafe {
                    Self { $($field: gl.get_uniform_location(program, concat!("u_", stringify!($field))),)* }
                }
            }
        }
    };
}

uniforms!(
    projection,
    to_view,
    center,
    half_size,
    eye,
    from_view,
    window,
    near,
    shape,
    size,
    triangle,
    albedo,
    ambient,
    id,
    light_count,
);

/// What a scene's lights take to shade; what is there is paid for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shading {
    areas: Areas,
    /// Whether some weaken in another way than with the square of the distance.
    falloff: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Areas {
    /// None.
    None,
    /// Some are balls.
    Balls,
    /// Some are discs or rectangles.
    All,
}

impl Shading {
    /// How many of these there are.
    pub(crate) const COUNT: usize = 6;

    /// That of some lights.
    pub(crate) fn of(lights: &[Light]) -> Self {
        let flat = |l: &Light| matches!(l.area, Area::Disc { .. } | Area::Rectangle { .. });
        let areas = match lights.iter().any(flat) {
            true => Areas::All,
            false if lights.iter().any(|l| l.area != Area::None) => Areas::Balls,
            false => Areas::None,
        };
        let falloff = |l: &Light| l.falloff != Falloff::PHYSICAL || l.range.is_finite();
        Self { areas, falloff: lights.iter().any(falloff) }
    }

    /// Below [`Self::COUNT`].
    pub(crate) fn index(self) -> usize {
        2 * self.areas as usize + usize::from(self.falloff)
    }

    /// What comes before the host's own shader. Points that weaken with the square of the distance it shades itself;
    /// others as antumbra takes them to be.
    fn source(self) -> String {
        let areas = match self.areas {
            Areas::None if !self.falloff => return String::new(),
            Areas::None => "",
            Areas::Balls => "#define ANTUMBRA_BALL_LIGHTS\n",
            Areas::All => "#define ANTUMBRA_FLAT_LIGHTS\n",
        };
        let falloff = if self.falloff { "#define ANTUMBRA_FALLOFF\n" } else { "" };
        format!("#define ANY_LIGHTS\n{areas}{falloff}{}", antumbra::IRRADIANCE_GLSL)
    }
}

impl Program {
    /// Compiles and links it.
    pub(crate) fn new(
        gl: &glow::Context,
        kind: Kind,
        multisample: bool,
        shading: Shading,
    ) -> Result<Self, HostError> {
        let extension = if multisample {
            "#extension GL_ARB_sample_shading : require\n#define MULTISAMPLE\n"
        } else {
            ""
        };
        let (vertex, fragment) = match kind {
            Kind::Cast => {
                (include_str!("shaders/primitive.vert.glsl"), include_str!("shaders/primitive.frag.glsl"))
            }
            Kind::Triangles => {
                (include_str!("shaders/triangles.vert.glsl"), include_str!("shaders/triangles.frag.glsl"))
            }
        };
        let lit = format!("{}{}", shading.source(), include_str!("shaders/lit.glsl"));
        let raw = link_program(
            gl,
            &format!("{extension}{vertex}"),
            &format!("{extension}#define MAX_LIGHTS {MAX_LIGHTS}\n{lit}{fragment}"),
        )?;
        // SAFETY: linked above.
        unsafe {
            if let Some(block) = gl.get_uniform_block_index(raw, "Lights") {
                gl.uniform_block_binding(raw, block, 0);
            }
            Ok(Self { raw, kind, uniforms: Uniforms::find(gl, raw) })
        }
    }
}
