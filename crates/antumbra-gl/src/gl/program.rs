//! The shader programs: every permutation is data in a list, compiled when it is first needed.

use super::Caps;
use crate::input::{Area, Error, Light, Resource, Surface};
use glow::HasContext;

/// The parts a stage is put together from, in order.
pub(crate) struct Stage {
    /// Preprocessor lines before everything else.
    pub(crate) defines: &'static str,
    /// Sources.
    pub(crate) parts: &'static [&'static str],
}

/// One program: its name and stages.
pub(crate) struct ProgramSource {
    /// For error messages.
    pub(crate) name: &'static str,
    pub(crate) vertex: Stage,
    pub(crate) fragment: Stage,
    /// Names of uniforms of its own, found in [`Program::own`] by their place in this list.
    pub(crate) uniforms: &'static [&'static str],
    /// What it is compiled for.
    pub(crate) when: When,
}

/// What has to be in a frame for a program to be compiled: what others cost to compile is not spent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct When {
    balls: bool,
    flats: bool,
    exact: bool,
    /// Whether lights may weaken in any way, or in the classic one alone; `None` for programs that do not ask.
    falloff: Option<bool>,
}

impl When {
    /// Anything.
    pub(crate) const ALWAYS: Self = Self { balls: false, flats: false, exact: false, falloff: None };
    /// Glowing balls.
    pub(crate) const BALLS: Self = Self { balls: true, ..Self::ALWAYS };
    /// Lights that are discs or rectangles.
    pub(crate) const FLATS: Self = Self { flats: true, ..Self::ALWAYS };

    /// The same, past several occluders at once.
    pub(crate) const fn exactly(self) -> Self {
        Self { exact: true, ..self }
    }

    /// The same with lights that weaken in any way, or in the classic one alone.
    pub(crate) const fn falloff(self, any: bool) -> Self {
        Self { falloff: Some(any), ..self }
    }
}

/// What is in a frame, as far as programs differ by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Needs {
    /// Whether any light is a ball.
    pub(crate) balls: bool,
    /// Whether any light is a disc or a rectangle.
    pub(crate) flats: bool,
    /// Whether several occluders of such lights are looked at at once.
    pub(crate) exact: bool,
    /// Whether any light weakens in another way than the classic one.
    pub(crate) falloff: bool,
}

impl Needs {
    /// Those of some lights.
    pub(crate) fn of(lights: &[Light]) -> Self {
        let any = |has: fn(&Light) -> bool| lights.iter().any(has);
        Self {
            balls: any(|light| matches!(light.area, Area::Sphere { .. })),
            flats: any(|light| matches!(light.area, Area::Disc { .. } | Area::Rectangle { .. })),
            exact: false,
            falloff: any(Light::has_special_falloff),
        }
    }

    fn have(self, when: When) -> bool {
        (self.balls || !when.balls)
            && (self.flats || !when.flats)
            && (self.exact || !when.exact)
            && when.falloff.is_none_or(|any| any == self.falloff)
    }
}

/// A pixel's footprint, and how much of it a half-plane covers.
pub(crate) const COVERAGE: &str = include_str!("../shaders/coverage.glsl");
/// The host's surface behind a pixel; needs [`COVERAGE`].
pub(crate) const SURFACE: &str = include_str!("../shaders/surface.glsl");
/// The vertex stage of passes over tiles of the viewport.
const SCREEN: &str = include_str!("../shaders/screen.vert.glsl");
/// Lights with an area as a point sees them.
pub(crate) const AREA: &str = include_str!("../shaders/area.glsl");
/// What the host's surface is made of. Every program exists for each variant: choosing in the
/// shader would cost software renderers, which run both sides of a branch, a multiple of the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Variant {
    pub(crate) multisample: bool,
    pub(crate) normals: bool,
    pub(crate) ids: bool,
}

impl Variant {
    pub(crate) const COUNT: usize = 8;

    /// The variant for a surface.
    pub(crate) fn of(surface: &Surface) -> Self {
        Self {
            multisample: surface.samples > 1,
            normals: surface.normals.is_some(),
            ids: surface.ids.is_some(),
        }
    }

    /// Below [`Variant::COUNT`].
    pub(crate) fn index(self) -> usize {
        usize::from(self.multisample) * 4 + usize::from(self.normals) * 2 + usize::from(self.ids)
    }

    /// All variants, by index.
    #[cfg(test)]
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT).map(|i| Self { multisample: i & 4 != 0, normals: i & 2 != 0, ids: i & 1 != 0 })
    }
}

impl ProgramSource {
    /// A pass over tiles of the viewport that every frame needs.
    pub(crate) const fn screen(
        name: &'static str,
        defines: &'static str,
        parts: &'static [&'static str],
        uniforms: &'static [&'static str],
    ) -> Self {
        Self {
            name,
            vertex: Stage { defines: "", parts: &[SCREEN] },
            fragment: Stage { defines, parts },
            uniforms,
            when: When::ALWAYS,
        }
    }

    /// The two stages' whole sources.
    pub(crate) fn sources(&self, embedded: bool, variant: Variant) -> [String; 2] {
        [&self.vertex, &self.fragment].map(|stage| {
            let mut source = String::from(if embedded {
                include_str!("../shaders/header_300es.glsl")
            } else {
                "#version 330 core\n"
            });
            if variant.multisample {
                source.push_str("#extension GL_ARB_sample_shading : require\n#define MULTISAMPLE\n");
            }
            if variant.normals {
                source.push_str("#define NORMALS\n");
            }
            if variant.ids {
                source.push_str("#define IDS\n");
            }
            source.push_str(stage.defines);
            stage.parts.iter().for_each(|part| source.push_str(part));
            source
        })
    }
}

/// A linked program and where its uniforms are.
pub(crate) struct Program {
    pub(crate) raw: glow::Program,
    pub(crate) uniforms: Uniforms,
    /// Where [`ProgramSource::uniforms`] are.
    pub(crate) own: Vec<Option<glow::UniformLocation>>,
}

/// Programs of one list for each variant, compiled when they are first asked for.
#[derive(Default)]
pub(crate) struct ProgramSet {
    variants: [Vec<Option<Program>>; Variant::COUNT],
}

impl ProgramSet {
    /// Compiles the programs of a variant that a frame needs, unless it was done.
    pub(crate) fn ensure(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        sources: &[ProgramSource],
        variant: Variant,
        needs: Needs,
    ) -> Result<(), Error> {
        let programs = &mut self.variants[variant.index()];
        if programs.is_empty() {
            programs.extend(sources.iter().map(|_| None));
        }
        let missing = programs.iter_mut().zip(sources).filter(|(slot, _)| slot.is_none());
        for (slot, source) in missing.filter(|(_, source)| needs.have(source.when)) {
            *slot = Some(Program::new(gl, caps, source, variant)?);
        }
        Ok(())
    }

    /// The programs of a variant, in the order of their list; those that [`Self::ensure`] was asked for are there.
    pub(crate) fn of(&self, variant: Variant) -> &[Option<Program>] {
        &self.variants[variant.index()]
    }

    /// # Safety
    /// The context is current, and the programs are not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        self.variants.iter().flatten().flatten().for_each(|p| unsafe { gl.delete_program(p.raw) });
    }
}

macro_rules! uniforms {
    ($($field:ident),* $(,)?) => {
        /// Locations; `None` for uniforms a program does not have, which OpenGL ignores.
        #[derive(Clone, Default)]
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
    depth,
    normals,
    ids,
    unproject,
    pixel_step,
    background_depth,
    surface_offset,
    surface_range,
    normal_to_view,
    normal_decode,
    blockers,
    visibility_0,
    visibility_1,
    visibility_offset,
    ambient,
    gamma,
    lights,
    light_count,
    all,
    taken,
);

impl Program {
    /// Compiles and links one program.
    pub(crate) fn new(
        gl: &glow::Context,
        caps: &Caps,
        source: &ProgramSource,
        variant: Variant,
    ) -> Result<Self, Error> {
        let raw = link(gl, source.name, &source.sources(!caps.is_desktop(), variant))?;
        // SAFETY: linked above.
        let (uniforms, own) = unsafe {
            let own = source.uniforms.iter().map(|name| gl.get_uniform_location(raw, name)).collect();
            (Uniforms::find(gl, raw), own)
        };
        Ok(Self { raw, uniforms, own })
    }
}

/// Compiles and links a vertex and a fragment shader, leaving no object behind on failure.
fn link(gl: &glow::Context, name: &'static str, sources: &[String; 2]) -> Result<glow::Program, Error> {
    let refused = || Error::Resource(Resource::Program { name });
    // SAFETY: objects are made, used and deleted in this context; every one is valid when used.
    unsafe {
        let program = gl.create_program().map_err(|_| refused())?;
        for (kind, source) in [glow::VERTEX_SHADER, glow::FRAGMENT_SHADER].into_iter().zip(sources) {
            let Ok(shader) = gl.create_shader(kind) else {
                gl.delete_program(program);
                return Err(refused());
            };
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            if !gl.get_shader_compile_status(shader) {
                let log = gl.get_shader_info_log(shader);
                gl.delete_shader(shader);
                gl.delete_program(program);
                return Err(Error::Shader { name, log });
            }
            gl.attach_shader(program, shader);
            gl.delete_shader(shader); // lives on while it is attached
        }
        gl.link_program(program);
        if !gl.get_program_link_status(program) {
            let log = gl.get_program_info_log(program);
            gl.delete_program(program);
            return Err(Error::Shader { name, log });
        }
        Ok(program)
    }
}
