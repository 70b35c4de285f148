//! Lights with an area as the paper on soft shadows of 2017 has them: a collection of point lights.
//!
//! The central component's shadow is the umbra, in its shade k of Eq. (3). The others' are penumbra, N times milder
//! for N components: darknesses (1 - k) / N, which add up where they overlap, to the umbra's where all do. Each light
//! is drawn so by itself, then painted over the host's pixels and earlier lights. A pixel that edges run through is
//! covered as much as by the component that covers most of it.

use super::parts::Drawn;
use super::{COVER, GATHER, SOFT_PAINT, State};
use crate::overlay::Encoding;
use crate::pairs::GROUP_LIGHTS;
use crate::resources::{Target, TargetFormat, UploadRing};
use crate::scenery::{Area, Light};
use crate::state::Blend;
use crate::surface::bind_texture;
use crate::technique::Pass;
use crate::tiles::TileGrid;
use crate::{Error, Frame};
use antumbra_math::Light as Place;
use glam::{DVec2, DVec3};
use glow::HasContext;
use std::f64::consts::TAU;

/// A side component that has been put somewhere by hand, for the technique `composite` with [`super::Shade::Paper`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// The light it belongs to: its index in [`Frame::lights`]. Of lights without area, and of lights that are not
    /// there, components are not looked at.
    pub light: usize,
    /// Where it is, from the light's position, metres, world space. One that is not finite is off. At 0 it is the central component, whose shadow
    /// it adds nothing to.
    pub offset: DVec3,
}

/// Calls `each` with the offsets of `count` components from the position of a light with this area: the centre, then
/// the others, evenly on its rim. Of three those are in a row. A ball's rim is its horizontal great circle, a
/// rectangle's the ellipse in it. None for a light without area.
pub fn components(area: &Area, count: u32, mut each: impl FnMut(DVec3)) {
    let (right, up) = match *area {
        Area::None => return,
        Area::Sphere { radius } => (DVec3::X * radius, DVec3::Z * radius),
        Area::Disc { direction, radius } => {
            let right = direction.any_orthonormal_vector();
            (right * radius, direction.cross(right) * radius)
        }
        Area::Rectangle { half_right, half_up, .. } => (half_right, half_up),
    };
    if count > 0 {
        each(DVec3::ZERO);
    }
    for k in 1..count {
        let turn = DVec2::from_angle(TAU * f64::from(k - 1) / f64::from(count - 1));
        each(right * turn.x + up * turn.y);
    }
}

/// Appends the point lights that one of the frame's lights is a collection of, the central one first: itself alone if
/// it has no area. Components that have been put somewhere take the place of those on the rim.
pub(crate) fn push_components(lights: &mut Vec<Light>, frame: &Frame<'_>, index: usize, count: u32) {
    let light = frame.lights[index];
    let Place::Point { position } = light.place else { return lights.push(light) };
    let mut push = |offset: DVec3| {
        let place = Place::Point { position: position + offset };
        lights.push(Light { place, area: Area::None, ..light });
    };
    let mut own = frame.components.iter().filter(|component| component.light == index).peekable();
    if light.area == Area::None {
        push(DVec3::ZERO);
    } else if own.peek().is_some() {
        push(DVec3::ZERO);
        own.for_each(|component| push(component.offset));
    } else {
        components(&light.area, count, push);
    }
}

/// The OpenGL objects of painting such lights, made when they are first needed.
#[derive(Default)]
pub(super) struct Collected {
    /// How much of a pixel the shadows of four components cover, and that times their darkness.
    cover: Option<Target>,
    dark: Option<Target>,
    /// Darkness of the central component, of all, unused, and what they cover.
    sums: Option<Target>,
    screen: Option<UploadRing>,
    vertices: Vec<[f32; 2]>,
    some_tiles: TileGrid,
    tiles: TileGrid,
    /// The components of the light at hand.
    pub(super) lights: Vec<Light>,
}

impl Collected {
    /// Takes the components of one of the frame's lights; whether there are several places among them.
    pub(super) fn take(&mut self, frame: &Frame<'_>, index: usize, count: u32) -> bool {
        self.lights.clear();
        push_components(&mut self.lights, frame, index, count);
        self.lights.iter().any(|light| light.place != self.lights[0].place)
    }

    /// Uploads the triangles of tiles and binds them.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    unsafe fn bind_tiles(&mut self, pass: &Pass<'_>, tiles: fn(&Self) -> &TileGrid) -> Result<(), Error> {
        let mut vertices = std::mem::take(&mut self.vertices);
        vertices.clear();
        tiles(self).triangles(&mut vertices);
        // SAFETY: the caller's.
        unsafe {
            if self.screen.is_none() {
                self.screen = Some(UploadRing::new(pass.gl, size_of::<[f32; 2]>() as i32)?);
            }
            if let Some(screen) = &mut self.screen {
                let bytes = bytemuck::cast_slice(&vertices);
                let upload = screen.upload(pass.gl, pass.caps, bytes, &mut Vec::new())?;
                pass.gl.bind_vertex_array(Some(upload.vertex_array));
            }
        }
        self.vertices = vertices;
        Ok(())
    }

    /// # Safety
    /// The context is current, and the objects are not used afterwards.
    pub(super) unsafe fn delete(&mut self, gl: &glow::Context) {
        let targets = [&mut self.cover, &mut self.dark, &mut self.sums];
        // SAFETY: the caller's.
        unsafe {
            targets.into_iter().filter_map(Option::take).for_each(|target| target.delete(gl));
            if let Some(screen) = &self.screen {
                screen.delete(gl);
            }
        }
    }
}

impl State {
    /// Paints the light whose components [`Collected::take`] has taken.
    ///
    /// # Safety
    /// As for [`crate::technique::Painter::paint`].
    pub(super) unsafe fn paint_collection(
        &mut self,
        pass: &Pass<'_>,
        encoding: Encoding,
        tiles: &mut TileGrid,
    ) -> Result<(), Error> {
        let (gl, [x, y, width, height]) = (pass.gl, pass.view.viewport);
        // SAFETY: the caller's.
        unsafe {
            let host = gl.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING);
            gl.viewport(0, 0, width, height);
            let gathered = self.gather(pass);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host);
            gl.viewport(x, y, width, height);
            gathered?;
            if self.collected.vertices.is_empty() {
                return Ok(());
            }
            tiles.add(&self.collected.tiles);
            Blend::Over.apply(gl, *pass.caps);
            let program = pass.use_program(SOFT_PAINT, [0, 0]);
            if let Some(sums) = &self.collected.sums {
                gl.uniform_1_i32(program.own[0].as_ref(), 3);
                bind_texture(gl, 3, pass.frame.surface.samples, sums.texture);
            }
            gl.uniform_2_i32(program.own[1].as_ref(), -x, -y);
            gl.uniform_1_i32(program.own[2].as_ref(), i32::from(encoding == Encoding::Linear));
            gl.draw_arrays(glow::TRIANGLES, 0, self.collected.vertices.len() as i32);
        }
        Ok(())
    }

    /// Draws the sums over the components, and leaves the vertices of the tiles they are in.
    ///
    /// # Safety
    /// As for [`Self::paint_collection`].
    unsafe fn gather(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        let (gl, samples) = (pass.gl, pass.frame.surface.samples);
        let [_, _, width, height] = pass.view.viewport;
        let mut own = std::mem::take(&mut self.collected);
        // SAFETY: the caller's.
        let result = unsafe {
            let ensure = |slot: &mut Option<Target>, format| {
                Target::ensure(slot, gl, format, (width, height), samples)?;
                slot.as_ref().map(|target| clear(gl, target)).map_or(Ok(()), Ok)
            };
            ensure(&mut own.sums, TargetFormat::Rgba32F)
                .and_then(|()| ensure(&mut own.cover, TargetFormat::Rgba16F))
                .and_then(|()| ensure(&mut own.dark, TargetFormat::Rgba16F))
                .and_then(|()| self.gather_into(pass, &mut own))
        };
        self.collected = own;
        result
    }

    /// # Safety
    /// As for [`Self::gather`].
    unsafe fn gather_into(&mut self, pass: &Pass<'_>, own: &mut Collected) -> Result<(), Error> {
        let (gl, samples) = (pass.gl, pass.frame.surface.samples);
        own.tiles.reset(pass.view.size());
        own.vertices.clear();
        let count = own.lights.len();
        for first in (0..count).step_by(GROUP_LIGHTS) {
            let some = &own.lights[first..count.min(first + GROUP_LIGHTS)];
            own.some_tiles.reset(pass.view.size());
            self.parts.pack(some, pass.view, Drawn::Components(&mut own.some_tiles));
            if self.parts.vertices.is_empty() {
                continue;
            }
            // SAFETY: the caller's.
            unsafe {
                self.upload(pass)?;
                let (Some(cover), Some(dark), Some(sums)) = (&own.cover, &own.dark, &own.sums) else {
                    return Ok(());
                };
                for (target, darkness) in [(cover, 0.0), (dark, 1.0)] {
                    clear(gl, target);
                    Blend::Max.apply(gl, *pass.caps);
                    let program = pass.use_program(COVER, pass.mask_offset());
                    self.set_receiver(pass, program);
                    gl.uniform_1_f32(program.own[2].as_ref(), darkness);
                    gl.draw_arrays(glow::TRIANGLES, 0, self.parts.vertices.len() as i32);
                }
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(sums.framebuffer));
                Blend::AddAndCover.apply(gl, *pass.caps);
                let program = pass.use_program(GATHER, pass.mask_offset());
                for (unit, target) in (3..).zip([cover, dark]) {
                    gl.uniform_1_i32(program.own[unit - 3].as_ref(), unit as i32);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
                gl.uniform_2_f32(
                    program.own[2].as_ref(),
                    if first == 0 { 1.0 } else { 0.0 },
                    1.0 / count as f32,
                );
                own.tiles.add(&own.some_tiles);
                own.bind_tiles(pass, |own| &own.some_tiles)?;
                gl.draw_arrays(glow::TRIANGLES, 0, own.vertices.len() as i32);
            }
        }
        // SAFETY: the caller's.
        unsafe { own.bind_tiles(pass, |own| &own.tiles) }
    }
}

/// Binds a target and clears it to 0.
///
/// # Safety
/// A [`crate::state::StateGuard`] is alive.
unsafe fn clear(gl: &glow::Context, target: &Target) {
    // SAFETY: the caller's.
    unsafe {
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
        gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
    }
}
