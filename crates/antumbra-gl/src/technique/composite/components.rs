//! Lights with an area as the paper on soft shadows of 2017 has them: a collection of point lights.
//!
//! The central component's shadow is the umbra, in its shade k of Eq. (3). The others' are penumbra, N times milder
//! for N components: darknesses (1 - k) / N, which add up where they overlap, to the umbra's where all do. Each light
//! is drawn so by itself, then painted over the host's pixels and earlier lights. A pixel that edges run through is
//! covered as much as by the component that covers most of it.

use super::parts::Drawn;
use super::{COVER, GATHER, SOFT_PAINT, State};
use crate::gl::{Blend, Target, TargetFormat, TileMesh, bind_texture};
use crate::input::{Encoding, Error, Frame, Light, push_components};
use crate::masks::{GROUP_LIGHTS, HostPicture};
use crate::screen::TileGrid;
use crate::technique::Pass;
use glow::HasContext;

/// The OpenGL objects of painting such lights, made when they are first needed.
#[derive(Default)]
pub(super) struct Collected {
    /// How much of a pixel the shadows of four components cover, and that times their darkness.
    cover: Option<Target>,
    dark: Option<Target>,
    /// Darkness of the central component, of all, unused, and what they cover.
    sums: Option<Target>,
    screen: Option<TileMesh>,
    some_tiles: TileGrid,
    tiles: TileGrid,
    /// The components of the light at hand.
    pub(super) lights: Vec<Light>,
}

impl Collected {
    /// Takes the components of one of the frame's lights; whether there are several places among them.
    pub(super) fn take(&mut self, frame: &Frame<'_>, index: usize, count: u32) -> bool {
        self.lights.clear();
        push_components(&mut self.lights, &frame.lights[index], (frame.components, index), count);
        self.lights.iter().any(|light| light.place != self.lights[0].place)
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
        host: HostPicture,
        tiles: &mut TileGrid,
    ) -> Result<(), Error> {
        let (gl, [x, y, width, height]) = (pass.gl, pass.view.viewport);
        // SAFETY: the caller's.
        unsafe {
            gl.viewport(0, 0, width, height);
            let gathered = self.gather(pass);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, host.framebuffer);
            gl.viewport(x, y, width, height);
            gathered?;
            let Collected { screen: Some(screen), sums: Some(sums), tiles: own, .. } = &mut self.collected
            else {
                return Ok(());
            };
            if !screen.bind(pass, own)? {
                return Ok(());
            }
            tiles.add(own);
            Blend::Over.apply(gl, *pass.caps);
            let program = pass.use_program(SOFT_PAINT, [0, 0]);
            gl.uniform_1_i32(program.own[0].as_ref(), 3);
            bind_texture(gl, 3, pass.frame.surface.samples, sums.texture);
            gl.uniform_2_i32(program.own[1].as_ref(), -x, -y);
            gl.uniform_1_i32(program.own[2].as_ref(), i32::from(host.encoding == Encoding::Linear));
            screen.draw(gl);
        }
        Ok(())
    }

    /// Draws the sums over the components, and leaves the tiles they are in.
    ///
    /// # Safety
    /// As for [`Self::paint_collection`].
    unsafe fn gather(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        let mut own = std::mem::take(&mut self.collected);
        // SAFETY: the caller's.
        let result = unsafe { own.prepare(pass).and_then(|()| self.gather_into(pass, &mut own)) };
        self.collected = own;
        result
    }

    /// # Safety
    /// As for [`Self::gather`].
    unsafe fn gather_into(&mut self, pass: &Pass<'_>, own: &mut Collected) -> Result<(), Error> {
        let (gl, samples) = (pass.gl, pass.frame.surface.samples);
        let Collected {
            cover: Some(cover), dark: Some(dark), sums: Some(sums), screen: Some(screen), ..
        } = own
        else {
            return Ok(());
        };
        own.tiles.reset(pass.view.size());
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
                for (target, darkness) in [(&*cover, 0.0), (&*dark, 1.0)] {
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
                for (unit, target) in (3..).zip([&*cover, &*dark]) {
                    gl.uniform_1_i32(program.own[unit - 3].as_ref(), unit as i32);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
                let central = if first == 0 { 1.0 } else { 0.0 };
                gl.uniform_2_f32(program.own[2].as_ref(), central, 1.0 / count as f32);
                own.tiles.add(&own.some_tiles);
                screen.bind(pass, &own.some_tiles)?;
                screen.draw(gl);
            }
        }
        Ok(())
    }
}

impl Collected {
    /// Objects of the frame's size, cleared.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive.
    unsafe fn prepare(&mut self, pass: &Pass<'_>) -> Result<(), Error> {
        let slots = [
            (&mut self.sums, TargetFormat::Rgba32F),
            (&mut self.cover, TargetFormat::Rgba16F),
            (&mut self.dark, TargetFormat::Rgba16F),
        ];
        // SAFETY: the caller's.
        unsafe {
            for (slot, format) in slots {
                pass.ensure_target(slot, format)?;
                if let Some(target) = slot {
                    clear(pass.gl, target);
                }
            }
            if self.screen.is_none() {
                self.screen = Some(TileMesh::new(pass.gl)?);
            }
        }
        Ok(())
    }
}

/// Binds a target and clears it to 0.
///
/// # Safety
/// A [`crate::gl::StateGuard`] is alive.
unsafe fn clear(gl: &glow::Context, target: &Target) {
    // SAFETY: the caller's.
    unsafe {
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
        gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
    }
}
