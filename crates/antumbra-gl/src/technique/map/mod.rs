//! `map`: shadow maps, the way renderers do them today.
//!
//! For each light the casters are drawn as it sees them, keeping the depth of the nearest; a point seen by the camera
//! is in shadow if the light saw something nearer. One map is drawn and looked up light after light. Theory:
//! docs/theory/map.md.

mod bounds;
mod depth_map;
mod face;
mod fit;
mod lookup;
mod reach;
mod target;
mod window;

use super::casters::{casters, with_sides};
use super::method::{Behavior, Make};
use super::options::Field;
use super::{About, Method, Pass};
use crate::gl::{
    Blend, COVERAGE, Caps, MeshCache, ProgramSource, RasterGuard, SURFACE, Stage, TileMesh, When,
};
use crate::input::{Area, Choice, Error, Light, Part, Reason, Refusal, Resource, Scenery};
use crate::masks::{Batch, Counts, DepthMap, GROUP_LIGHTS};
use crate::screen::{ProxyBuilder, TileGrid, hides_its_own_shadow};
use antumbra_math::Plane;
use bounds::Surroundings;
use face::Face;
use fit::Fit;
use glam::DVec2;
use glow::HasContext;
use target::MapTarget;

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "shadow maps: depth seen from the light, filtered; soft shadows with filter=pcss",
    casts_from: "anything",
    falls_on: "anything",
};

/// How a map is looked up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Filter {
    /// The nearest texel: in or out, with stairs.
    None,
    /// Percentage-closer filtering: the mean of the answers of a square of texels.
    #[default]
    Pcf,
    /// Percentage-closer soft shadows: the same, as wide as the penumbra of the light's area is estimated to be.
    /// Lights without an area are filtered as with `pcf`.
    Pcss,
}

impl Filter {
    const ALL: [Self; 3] = [Self::None, Self::Pcf, Self::Pcss];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new("none", "The nearest texel: in or out, with stairs."),
        Choice::new("pcf", "Percentage-closer filtering: the mean of the answers of a square of texels."),
        Choice::new(
            "pcss",
            "Percentage-closer soft shadows: the same, as wide as the penumbra of the light's area is estimated to be. \
             Lights without an area are filtered as with `pcf`.",
        ),
    ];
}

/// Options of the technique `map`. Lengths are in texels, so that they shrink as the map grows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Texels of a side of a map; of each of the faces in use for a point light. Four bytes each. 16 to 8192.
    pub size: u32,
    /// How the map is looked up.
    pub filter: Filter,
    /// Half the side of the square of texels that `pcf` takes the mean of; an eighth of the map at most. 0.5 to 8.
    /// Larger: smoother edges, less detail. 0.5 is a bilinear filter, 1.5 the usual 3 by 3 of those.
    pub radius: f32,
    /// How much nearer to the light a point is taken to be. 0 to 1000. Larger: less acne on curved receivers, and a gap
    /// between an object and its shadow.
    pub constant_bias: f32,
    /// The share of the receiver's slope, from its normal, that the comparison follows from texel to texel:
    /// 1 its own plane, 0 a plane that faces the light. Less: acne where light grazes.
    pub slope_bias: f32,
    /// How far a point is moved off its surface, less the more it faces the light. 0 to 1000. Larger: less acne where
    /// normals do not tell the slope, and shadows move.
    pub normal_offset: f32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: 2048,
            filter: Filter::Pcf,
            radius: 1.5,
            constant_bias: 0.1,
            slope_bias: 1.0,
            normal_offset: 0.25,
        }
    }
}

impl Options {
    /// The same with another [`Self::size`].
    pub fn size(self, size: u32) -> Self {
        Self { size, ..self }
    }

    /// The same with another [`Self::filter`].
    pub fn filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// The same with another [`Self::radius`].
    pub fn radius(self, radius: f32) -> Self {
        Self { radius, ..self }
    }

    /// The same with another [`Self::constant_bias`].
    pub fn constant_bias(self, constant_bias: f32) -> Self {
        Self { constant_bias, ..self }
    }

    /// The same with another [`Self::slope_bias`].
    pub fn slope_bias(self, slope_bias: f32) -> Self {
        Self { slope_bias, ..self }
    }

    /// The same with another [`Self::normal_offset`].
    pub fn normal_offset(self, normal_offset: f32) -> Self {
        Self { normal_offset, ..self }
    }
}

impl super::options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[
        Field::whole(
            "size",
            "Texels of a side of a map; of each of the faces in use for a point light. Four bytes each.",
            (16, 8192),
            |o| o.size,
            |o, size| o.size = size,
        ),
        Field::choice(
            "filter",
            "How the map is looked up.",
            Filter::CHOICES,
            |o| o.filter as usize,
            |o, place| o.filter = Filter::ALL[place],
        ),
        Field::number(
            "radius",
            "Half the side of the square of texels that `pcf` takes the mean of; an eighth of the map at most. Larger: \
             smoother edges, less detail. 0.5 is a bilinear filter, 1.5 the usual 3 by 3 of those.",
            (0.5, 8.0),
            |o| o.radius,
            |o, radius| o.radius = radius,
        ),
        Field::number(
            "constant-bias",
            "How much nearer to the light a point is taken to be. Larger: less acne on curved receivers, and a gap \
             between an object and its shadow.",
            (0.0, 1000.0),
            |o| o.constant_bias,
            |o, bias| o.constant_bias = bias,
        ),
        Field::number(
            "slope-bias",
            "The share of the receiver's slope, from its normal, that the comparison follows from texel to texel: 1 its \
             own plane, 0 a plane that faces the light. Less: acne where light grazes.",
            (0.0, 1.0),
            |o| o.slope_bias,
            |o, bias| o.slope_bias = bias,
        ),
        Field::number(
            "normal-offset",
            "How far a point is moved off its surface, less the more it faces the light. Larger: less acne where normals \
             do not tell the slope, and shadows move.",
            (0.0, 1000.0),
            |o| o.normal_offset,
            |o, offset| o.normal_offset = offset,
        ),
    ];
}

impl Behavior for Options {
    fn has_maps(&self) -> bool {
        true
    }
}

/// Indices into [`PROGRAMS`].
const CASTER: usize = 0;
const PLANE: usize = 1;
const LOOKUP: usize = 2;

const RECEIVER: &str = include_str!("../../shaders/map/receiver.glsl");
const SOFT: &str = include_str!("../../shaders/map/soft.glsl");

macro_rules! lookup_program {
    ($name:literal, $define:literal) => {
        ProgramSource::screen(
            $name,
            concat!("#define ", $define, "\n"),
            &[COVERAGE, SURFACE, RECEIVER, SOFT, include_str!("../../shaders/map/lookup.frag.glsl")],
            lookup::UNIFORMS,
        )
    };
}

/// What draws maps, then a lookup for each [`Filter`].
pub(super) const PROGRAMS: &[ProgramSource] = &[
    ProgramSource {
        name: "map of a mesh",
        vertex: Stage { defines: "", parts: &[include_str!("../../shaders/map/caster.vert.glsl")] },
        fragment: Stage { defines: "", parts: &[include_str!("../../shaders/map/caster.frag.glsl")] },
        uniforms: &["u_clip"],
        when: When::ALWAYS,
    },
    ProgramSource {
        name: "map of a plane",
        vertex: Stage { defines: "", parts: &[include_str!("../../shaders/map/plane.vert.glsl")] },
        fragment: Stage { defines: "", parts: &[include_str!("../../shaders/map/plane.frag.glsl")] },
        uniforms: &["u_slope", "u_middle"],
        when: When::ALWAYS,
    },
    lookup_program!("lookup", "NONE"),
    lookup_program!("lookup with PCF", "PCF"),
    lookup_program!("lookup with PCSS", "PCSS"),
];

pub(super) fn refusal(options: &Options, scenery: &Scenery<'_>) -> Option<Refusal> {
    let light = scenery.lights.iter().position(|light| light.area != Area::None)?;
    (options.filter != Filter::Pcss).then(|| Refusal::new(Part::Light(light), Reason::AreaWithoutPcss))
}

/// The OpenGL objects, and the memory of the fitting.
pub(super) struct State {
    options: Options,
    target: MapTarget,
    meshes: MeshCache,
    screen: TileMesh,
    /// Without attributes.
    bare: glow::VertexArray,
    around: Surroundings,
    /// The planes that take a light from something.
    planes: Vec<Plane>,
    proxy: ProxyBuilder,
    tiles: TileGrid,
    /// Of each caster whether it is in the light's map.
    is_drawn: Vec<bool>,
    counts: Counts,
}

impl Make for State {
    type Options = Options;

    unsafe fn make(gl: &glow::Context, _: &Caps, options: Options) -> Result<Self, Error> {
        // SAFETY: the caller's; the first is deleted if the second cannot be made.
        unsafe {
            let screen = TileMesh::new(gl)?;
            let Ok(bare) = gl.create_vertex_array() else {
                screen.delete(gl);
                return Err(Error::Resource(Resource::Vertices));
            };
            Ok(Self {
                options,
                target: MapTarget::default(),
                meshes: MeshCache::default(),
                screen,
                bare,
                around: Surroundings::default(),
                planes: Vec::new(),
                proxy: ProxyBuilder::default(),
                tiles: TileGrid::default(),
                is_drawn: Vec::new(),
                counts: Counts::default(),
            })
        }
    }

    fn set_options(&mut self, options: Options) {
        self.options = options;
    }
}

impl Method for State {
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        self.counts = Counts::default();
        self.around.begin(pass);
        // SAFETY: the caller's.
        unsafe { self.meshes.begin_frame(pass.gl) };
        Ok(())
    }

    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error> {
        // SAFETY: the caller's.
        unsafe {
            let _raster = RasterGuard::new(pass.gl, pass.host);
            for (index, light) in batch.lights.iter().enumerate() {
                if light.intensity != glam::Vec3::ZERO {
                    self.draw_light(pass, batch, index, light)?;
                }
            }
        }
        Ok(())
    }

    unsafe fn draw_map(&mut self, pass: &Pass<'_>, light: &Light) -> Result<Option<DepthMap>, Error> {
        // SAFETY: the caller's.
        unsafe { self.draw_shown(pass, light) }
    }

    fn counts(&self) -> Counts {
        self.counts
    }

    unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.target.delete(gl);
            self.meshes.delete(gl);
            self.screen.delete(gl);
            gl.delete_vertex_array(self.bare);
        }
    }
}

impl State {
    /// Draws a light's map and looks it up.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`]; a [`RasterGuard`] is alive.
    unsafe fn draw_light(
        &mut self,
        pass: &Pass<'_>,
        batch: &mut Batch<'_>,
        index: usize,
        light: &Light,
    ) -> Result<(), Error> {
        let options = self.options;
        self.counts.pairs += self.around.casters.len() + self.around.planes.len();
        let Some(fit) = self.fit(pass, light) else { return Ok(()) };
        self.tiles.reset(pass.view.size());
        if light.area != Area::None || !self.planes.is_empty() {
            self.tiles.touch_all();
        } else {
            let texel = fit.some_face.texel(f64::from(options.size));
            let Self { tiles, proxy, around, .. } = self;
            reach::touch(tiles, proxy, around, light, (texel, fit::margin(&options)), pass.view);
        }
        if self.tiles.is_untouched() {
            return Ok(());
        }
        batch.tiles.add(&self.tiles);
        // SAFETY: the caller's.
        unsafe {
            self.draw_fitted(pass, &fit)?;
            self.look_up(pass, batch, index, light, &fit)
        }
    }

    /// Fits a light's map, and finds the planes that are in it. `None` if the light has no shadow in sight.
    fn fit(&mut self, pass: &Pass<'_>, light: &Light) -> Option<Fit> {
        if light.intensity == glam::Vec3::ZERO {
            return None; // takes nothing away
        }
        let light_vs = light.place.transformed(&pass.view.view);
        self.planes.clear();
        self.planes.extend(self.around.planes.iter().filter_map(|&(plane, id)| {
            let shape = plane.transformed(&pass.view.view).into();
            (!hides_its_own_shadow(&shape, id, &light_vs, pass.view.eye_vs())).then_some(plane)
        }));
        Fit::new(&light.place, &self.around, &self.planes, &self.options, light.area != Area::None)
    }

    /// Draws what the light sees.
    ///
    /// # Safety
    /// As for [`Self::draw_light`].
    unsafe fn draw_fitted(&mut self, pass: &Pass<'_>, fit: &Fit) -> Result<(), Error> {
        let (gl, options) = (pass.gl, self.options);
        let tiles = fit.faces.iter().flatten().count() as u32;
        // SAFETY: the caller's.
        unsafe { self.target.ensure(gl, pass.caps, options.size, tiles)? };
        let Some((_, framebuffer)) = self.target.objects() else { return Ok(()) };
        let size = options.size as i32;
        self.is_drawn.clear();
        self.is_drawn.resize(self.around.casters.len(), false);
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(framebuffer));
            gl.enable(glow::DEPTH_TEST);
            gl.enable(glow::SCISSOR_TEST);
            gl.depth_func(glow::GREATER);
            for (tile, face) in (0..).zip(fit.faces.iter().flatten()) {
                let corner = self.target.corner(tile);
                gl.viewport(corner.x as i32, corner.y as i32, size, size);
                gl.scissor(corner.x as i32, corner.y as i32, size, size);
                gl.clear_buffer_f32_slice(glow::DEPTH, 0, &[0.0]);
                let program = pass.program(CASTER);
                gl.use_program(Some(program.raw));
                for (i, (caster, bounds)) in casters(&pass.frame).zip(&self.around.casters).enumerate() {
                    if face.misses(bounds) {
                        continue;
                    }
                    self.counts.polygons += 1;
                    self.is_drawn[i] = true;
                    let clip = (face.clip * caster.model).as_mat4();
                    let mesh = with_sides(caster.mesh, face.sides(bounds, f64::from(options.size)));
                    let mesh = self.meshes.get(gl, mesh)?;
                    gl.uniform_matrix_4_f32_slice(program.own[0].as_ref(), false, &clip.to_cols_array());
                    mesh.draw(gl);
                }
                self.draw_planes(pass, face, corner);
            }
            gl.disable(glow::DEPTH_TEST);
            gl.disable(glow::SCISSOR_TEST);
        }
        self.counts.drawn += self.is_drawn.iter().filter(|drawn| **drawn).count() + self.planes.len();
        Ok(())
    }

    /// # Safety
    /// As for [`Self::draw_light`]; the face's viewport is set.
    unsafe fn draw_planes(&mut self, pass: &Pass<'_>, face: &Face, corner: DVec2) {
        let (gl, program) = (pass.gl, pass.program(PLANE));
        let size = f64::from(self.options.size);
        for plane in &self.planes {
            // Texels counted from the middle of the face.
            let Some(slope) = face.depth_of_plane(plane, DVec2::splat(-0.5 * size), size) else { continue };
            self.counts.polygons += 1;
            let middle = corner + 0.5 * size;
            // SAFETY: the caller's.
            unsafe {
                gl.use_program(Some(program.raw));
                gl.uniform_3_f32_slice(program.own[0].as_ref(), &slope.to_array());
                gl.uniform_2_f32_slice(program.own[1].as_ref(), &middle.as_vec2().to_array());
                gl.bind_vertex_array(Some(self.bare));
                gl.draw_arrays(glow::TRIANGLES, 0, 3);
            }
        }
    }

    /// Looks the map up in every pixel of the touched tiles.
    ///
    /// # Safety
    /// As for [`Self::draw_light`].
    unsafe fn look_up(
        &mut self,
        pass: &Pass<'_>,
        batch: &Batch<'_>,
        index: usize,
        light: &Light,
        fit: &Fit,
    ) -> Result<(), Error> {
        let (gl, options) = (pass.gl, &self.options);
        let Some((texture, _)) = self.target.objects() else { return Ok(()) };
        let filter = match (options.filter, light.area) {
            (Filter::Pcss, Area::None) => Filter::Pcf,
            (filter, _) => filter,
        };
        let group = &batch.masks[index / GROUP_LIGHTS];
        let [.., width, height] = pass.view.viewport;
        // SAFETY: the caller's.
        unsafe {
            if !self.screen.bind(pass, &self.tiles)? {
                return Ok(());
            }
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(group.framebuffer));
            gl.viewport(0, 0, width, height);
            let program = pass.use_program(LOOKUP + filter as usize, pass.mask_offset());
            gl.active_texture(glow::TEXTURE3);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            let map = lookup::Map { light, fit, options, target: &self.target, planes: &self.planes };
            map.set(gl, program, pass.view, index);
            Blend::Min.apply(gl, *pass.caps);
            self.screen.draw(gl);
        }
        Ok(())
    }
}
