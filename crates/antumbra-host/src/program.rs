//! The host's shader programs.

use crate::HostError;
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

/// The areas that a scene's lights have; what is there is paid for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Areas {
    /// None.
    None,
    /// Some are balls.
    Balls,
    /// Some are discs or rectangles.
    All,
}

impl Areas {
    /// How many of these there are.
    pub(crate) const COUNT: usize = 3;

    /// Those of a scene.
    pub(crate) fn of(lights: &[antumbra::Light]) -> Self {
        use antumbra::Area;
        let flat = |l: &antumbra::Light| matches!(l.area, Area::Disc { .. } | Area::Rectangle { .. });
        match lights.iter().any(flat) {
            true => Self::All,
            false if lights.iter().any(|l| l.area != Area::None) => Self::Balls,
            false => Self::None,
        }
    }
}

impl Program {
    /// Compiles and links it.
    pub(crate) fn new(
        gl: &glow::Context,
        kind: Kind,
        multisample: bool,
        areas: Areas,
    ) -> Result<Self, HostError> {
        let header = match (gl.version().is_embedded, multisample) {
            (true, _) => "#version 300 es\nprecision highp float;\nprecision highp int;\n",
            (false, false) => "#version 330 core\n",
            (false, true) => {
                "#version 330 core\n#extension GL_ARB_sample_shading : require\n#define MULTISAMPLE\n"
            }
        };
        let (vertex, fragment) = match kind {
            Kind::Cast => {
                (include_str!("shaders/primitive.vert.glsl"), include_str!("shaders/primitive.frag.glsl"))
            }
            Kind::Triangles => {
                (include_str!("shaders/triangles.vert.glsl"), include_str!("shaders/triangles.frag.glsl"))
            }
        };
        // Lights with an area are shaded as antumbra takes them to be.
        let shading = match areas {
            Areas::None => [""; 2],
            Areas::Balls => ["#define BALL_LIGHTS\n", antumbra::IRRADIANCE_GLSL],
            Areas::All => ["#define FLAT_LIGHTS\n", antumbra::IRRADIANCE_GLSL],
        };
        let lit = format!("{}{}", shading.concat(), include_str!("shaders/lit.glsl"));
        let stages = [(glow::VERTEX_SHADER, "", vertex), (glow::FRAGMENT_SHADER, lit.as_str(), fragment)];
        // SAFETY: objects are made, used and deleted in this context.
        unsafe {
            let raw = gl.create_program().map_err(HostError::Driver)?;
            for (stage, shared, source) in stages {
                let shader = gl.create_shader(stage).map_err(HostError::Driver)?;
                gl.shader_source(
                    shader,
                    &format!("{header}#define MAX_LIGHTS {MAX_LIGHTS}\n{shared}{source}"),
                );
                gl.compile_shader(shader);
                let failed = !gl.get_shader_compile_status(shader);
                let log = gl.get_shader_info_log(shader);
                gl.attach_shader(raw, shader);
                gl.delete_shader(shader);
                if failed {
                    gl.delete_program(raw);
                    return Err(HostError::Driver(log));
                }
            }
            gl.link_program(raw);
            if !gl.get_program_link_status(raw) {
                let log = gl.get_program_info_log(raw);
                gl.delete_program(raw);
                return Err(HostError::Driver(log));
            }
            if let Some(block) = gl.get_uniform_block_index(raw, "Lights") {
                gl.uniform_block_binding(raw, block, 0);
            }
            Ok(Self { raw, kind, uniforms: Uniforms::find(gl, raw) })
        }
    }
}
