//! The kinds of blockers: what hides what, each with a program of its own.

use crate::gl::{AREA, Blend, COVERAGE, ProgramSource, SURFACE, Stage, When};
use antumbra_math::Shape;

/// What blocks a light without extent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HardKind {
    Sphere,
    Disc,
    Polygon,
    /// A polygon that touches others along its edges.
    Seamed,
}

/// A light with an area, as far as programs differ by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Emitter {
    /// A ball: one texel.
    Ball,
    /// A disc or a rectangle: four texels.
    Flat,
}

/// What hides a part of a light with an area, in the order in which `union.frag.glsl` takes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum SoftShape {
    Sphere,
    Disc,
    Triangle,
    Rectangle,
    Cone,
    Plane,
}

impl SoftShape {
    pub(super) const COUNT: usize = 6;

    /// That of a shape; `None` if there is none.
    pub(super) fn of(shape: &Shape) -> Option<Self> {
        Some(match shape {
            Shape::Sphere(_) => Self::Sphere,
            Shape::Disc(_) => Self::Disc,
            Shape::Triangle(_) => Self::Triangle,
            Shape::Rectangle(_) => Self::Rectangle,
            Shape::Cone(_) => Self::Cone,
            Shape::Plane(_) => Self::Plane,
            _ => return None,
        })
    }
}

/// A kind of blocker: what is drawn by one program, and blended in one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// One blocker of a light without extent.
    Hard(HardKind),
    /// One shape before a light with an area.
    Soft(Emitter, SoftShape),
    /// All shapes before a light with an area.
    Union(Emitter),
}

impl Kind {
    pub(super) const COUNT: usize = PROGRAMS.len();
    const FIRST_SOFT: usize = 4;
    const FIRST_UNION: usize = Self::FIRST_SOFT + 2 * SoftShape::COUNT;

    /// Its place in [`PROGRAMS`].
    pub(super) fn index(self) -> usize {
        match self {
            Self::Hard(kind) => kind as usize,
            Self::Soft(emitter, shape) => {
                Self::FIRST_SOFT + emitter as usize * SoftShape::COUNT + shape as usize
            }
            Self::Union(emitter) => Self::FIRST_UNION + emitter as usize,
        }
    }

    /// How several of them are put together. Of lights without extent the union of shadows is the darkest; of others
    /// the product is between the least and the most that several can take together.
    pub(super) fn blend(index: usize) -> Blend {
        if index < Self::FIRST_SOFT { Blend::Min } else { Blend::Product }
    }
}

macro_rules! blocker {
    ($texels:literal) => {
        Stage {
            defines: concat!("#define BLOCKER_TEXELS ", $texels, "\n"),
            parts: &[include_str!("../../shaders/analytic/blocker.vert.glsl")],
        }
    };
}

macro_rules! hard {
    ($name:literal, $texels:literal, $file:literal) => {
        ProgramSource {
            name: $name,
            vertex: blocker!($texels),
            fragment: Stage {
                defines: concat!("#define BLOCKER_TEXELS ", $texels, "\n"),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    include_str!("../../shaders/analytic/blocker_data.glsl"),
                    include_str!(concat!("../../shaders/analytic/", $file)),
                    include_str!("../../shaders/analytic/blocker.frag.glsl"),
                ],
            },
            uniforms: &[],
            when: When::ALWAYS,
        }
    };
}

macro_rules! soft {
    ($name:literal, $when:expr, $light:literal, $texels:literal, $shape:literal) => {
        ProgramSource {
            name: $name,
            vertex: blocker!($texels),
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
                    include_str!("../../shaders/analytic/blocker_data.glsl"),
                    include_str!("../../shaders/analytic/soft.glsl"),
                    include_str!("../../shaders/analytic/soft_light.glsl"),
                    include_str!("../../shaders/analytic/soft.frag.glsl"),
                ],
            },
            uniforms: &[],
            when: $when,
        }
    };
}

macro_rules! union {
    ($name:literal, $when:expr, $light:literal) => {
        ProgramSource {
            name: $name,
            vertex: blocker!("2"),
            fragment: Stage {
                defines: concat!(
                    "#define BLOCKER_TEXELS 2\n#define UNION\n#define CORNERS 4\n#define CONE\n#define LIGHT_TEXELS ",
                    $light,
                    "\n"
                ),
                parts: &[
                    COVERAGE,
                    SURFACE,
                    AREA,
                    include_str!("../../shaders/analytic/soft.glsl"),
                    include_str!("../../shaders/analytic/soft_light.glsl"),
                    include_str!("../../shaders/analytic/union.glsl"),
                    include_str!("../../shaders/analytic/union.frag.glsl"),
                ],
            },
            uniforms: &[],
            when: $when,
        }
    };
}

/// A program for each kind, by [`Kind::index`]: its name, when it is compiled, texels of the light, texels of light and
/// shape, and what the shape is.
pub(crate) const PROGRAMS: &[ProgramSource] = &[
    hard!("sphere", "2", "sphere.glsl"),
    hard!("disc", "3", "disc.glsl"),
    hard!("polygon", "5", "polygon.glsl"),
    hard!("polygon with seams", "5\n#define SEAMS", "polygon.glsl"),
    soft!("sphere light, sphere", When::BALLS, "1", "3", "SPHERE"),
    soft!("sphere light, disc", When::BALLS, "1", "3", "DISC"),
    soft!("sphere light, triangle", When::BALLS, "1", "4", "CORNERS 3"),
    soft!("sphere light, rectangle", When::BALLS, "1", "5", "CORNERS 4"),
    soft!("sphere light, cone", When::BALLS, "1", "4", "CONE"),
    soft!("sphere light, plane", When::BALLS, "1", "3", "PLANE"),
    soft!("flat light, sphere", When::FLATS, "4", "6", "SPHERE"),
    soft!("flat light, disc", When::FLATS, "4", "6", "DISC"),
    soft!("flat light, triangle", When::FLATS, "4", "7", "CORNERS 3"),
    soft!("flat light, rectangle", When::FLATS, "4", "8", "CORNERS 4"),
    soft!("flat light, cone", When::FLATS, "4", "7", "CONE"),
    soft!("flat light, plane", When::FLATS, "4", "6", "PLANE"),
    union!("sphere light, all", When::BALLS.exactly(), "1"),
    union!("flat light, all", When::FLATS.exactly(), "4"),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Each kind has the program of its name, and no two have one.
    #[test]
    fn kinds_are_rows_of_the_table() {
        let emitters = [(Emitter::Ball, "sphere light"), (Emitter::Flat, "flat light")];
        let shapes = [
            (SoftShape::Sphere, "sphere"),
            (SoftShape::Disc, "disc"),
            (SoftShape::Triangle, "triangle"),
            (SoftShape::Rectangle, "rectangle"),
            (SoftShape::Cone, "cone"),
            (SoftShape::Plane, "plane"),
        ];
        assert_eq!(shapes.len(), SoftShape::COUNT, "all shapes");
        let hard = [
            (HardKind::Sphere, "sphere"),
            (HardKind::Disc, "disc"),
            (HardKind::Polygon, "polygon"),
            (HardKind::Seamed, "polygon with seams"),
        ];
        let mut kinds = hard.map(|(kind, name)| (Kind::Hard(kind), name.to_owned())).to_vec();
        for (emitter, light) in emitters {
            kinds
                .extend(shapes.map(|(shape, name)| (Kind::Soft(emitter, shape), format!("{light}, {name}"))));
        }
        kinds.extend(emitters.map(|(emitter, light)| (Kind::Union(emitter), format!("{light}, all"))));
        let found: Vec<_> = kinds.iter().map(|(kind, _)| PROGRAMS[kind.index()].name).collect();
        let expected: Vec<_> = PROGRAMS.iter().map(|program| program.name).collect();
        assert_eq!(found, expected, "in the table's order");
        assert!(kinds.iter().all(|(kind, name)| PROGRAMS[kind.index()].name == name), "by their names");
    }
}
