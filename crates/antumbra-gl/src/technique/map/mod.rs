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
mod options;
mod reach;
mod target;
mod window;

use super::casters::{casters, with_sides};
use super::method::{Behavior, Make};
use super::{About, Method, Pass};
use crate::gl::{
    Blend, COVERAGE, Caps, MeshCache, ProgramSource, RasterGuard, SURFACE, Stage, TileMesh, When,
};
use crate::input::{Area, Error, Light, Part, Reason, Refusal, Resource, Scenery};
use crate::masks::{Batch, Counts, DepthMap, GROUP_LIGHTS};
use crate::screen::{ProxyBuilder, TileGrid, hides_its_own_shadow};
use antumbra_math::Plane;
use bounds::Surroundings;
use face::Face;
use fit::Fit;
use glam::DVec2;
use glow::HasContext;
pub use options::{Filter, Options};
use target::MapTarget;

/// What it is.
pub(super) const ABOUT: About = About {
    summary: "shadow maps: depth seen from the light, filtered; soft shadows with filter=pcss",
    casts_from: "anything",
    falls_on: "anything",
};

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
