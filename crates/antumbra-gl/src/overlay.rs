//! From visibility to the host's picture: what the lights send, and what the shadows take of it.

use crate::frame::{Frame, Surface};
use crate::host_target::OtherBuffers;
use crate::lights::LightData;
use crate::resources::{Target, TargetFormat, UploadRing};
use crate::scenery::Light;
use crate::shader::{OVERLAY_PROGRAMS, ProgramId, ProgramSet, Variant};
use crate::state::Blend;
use crate::surface::{bind_texture, set_surface};
use crate::tiles::TileGrid;
use crate::view::View;
use crate::{Caps, Error};
use glow::HasContext;

/// How the host's pixels encode radiance, for [`crate::Renderer::overlay`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    /// Pixels are linear: float targets, or sRGB targets with `GL_FRAMEBUFFER_SRGB`. Exact.
    Linear,
    /// The host wrote radiance^(1/gamma): 2.2 for most hosts that encode in their shader. Exact
    /// for a power curve, close for sRGB's.
    Gamma(f32),
}

impl Encoding {
    /// The exponent's reciprocal: 1 for linear pixels.
    pub(crate) fn gamma(self) -> Result<f32, Error> {
        match self {
            Self::Linear => Ok(1.0),
            Self::Gamma(gamma) if gamma.is_finite() && gamma > 0.0 => Ok(gamma),
            Self::Gamma(_) => Err(Error::BadFrame("the encoding's gamma is not positive")),
        }
    }
}

/// The host's picture and how it is encoded.
#[derive(Clone, Copy)]
pub(crate) struct HostPicture {
    pub(crate) framebuffer: Option<glow::Framebuffer>,
    pub(crate) gamma: f32,
}

/// The passes that turn visibility into a factor on the host's pixels.
pub(crate) struct Overlay {
    programs: ProgramSet,
    screen: UploadRing,
    vertices: Vec<[f32; 2]>,
    /// What shadows take, and what the lights send in all, summed over batches.
    taken: Option<Target>,
    all: Option<Target>,
    light_data: LightData,
}

impl Overlay {
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        Ok(Self {
            programs: ProgramSet::default(),
            // SAFETY: the caller's.
            screen: unsafe { UploadRing::new(gl, size_of::<[f32; 2]>() as i32)? },
            vertices: Vec::new(),
            taken: None,
            all: None,
            light_data: LightData::default(),
        })
    }

    /// Compiles the programs for such surfaces, unless it was done.
    pub(crate) fn warm_up(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        variant: Variant,
        lights: &[Light],
    ) -> Result<(), Error> {
        self.programs.ensure(gl, caps, &OVERLAY_PROGRAMS, variant, lights, false)
    }

    /// Makes and clears the sums over batches, for frames of several.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(crate) unsafe fn clear_sums(
        &mut self,
        gl: &glow::Context,
        view: &View,
        surface: &Surface,
    ) -> Result<(), Error> {
        for slot in [&mut self.taken, &mut self.all] {
            // SAFETY: the caller's.
            unsafe {
                let size = (view.viewport[2], view.viewport[3]);
                Target::ensure(slot, gl, TargetFormat::Rgba32F, size, surface.samples)?;
                let target = slot.as_ref().expect("made above");
                gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(target.framebuffer));
                gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
            }
        }
        Ok(())
    }

    /// Draws one of the passes over the touched tiles.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive, the surface's textures exist, [`Self::warm_up`] was called for it.
    #[expect(clippy::too_many_arguments, reason = "everything about a pass, each once")]
    pub(crate) unsafe fn draw(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        pass: ProgramId,
        lights: &[Light],
        frame: &Frame<'_>,
        view: &View,
        tiles: &TileGrid,
        visibility: &[Option<Target>; 2],
        host: HostPicture,
    ) -> Result<(), Error> {
        self.vertices.clear();
        tiles.triangles(&mut self.vertices);
        if self.vertices.is_empty() {
            return Ok(());
        }
        let samples = frame.surface.samples;
        let programs = self.programs.of(Variant::of(&frame.surface));
        let program = programs[pass.index(lights)].as_ref().expect("compiled for the frame's lights");
        let [x, y, width, height] = view.viewport;
        let own_target = match pass {
            ProgramId::Taken => self.taken.as_ref(),
            ProgramId::All => self.all.as_ref(),
            ProgramId::Overlay | ProgramId::Ratio => None,
        };
        // The host's framebuffer has the viewport's corner at (x, y), antumbra's own at (0, 0).
        let (framebuffer, corner, surface_offset, visibility_offset) = match own_target {
            Some(target) => (Some(target.framebuffer), [0, 0], [x, y], [0, 0]),
            None => (host.framebuffer, [x, y], [0, 0], [-x, -y]),
        };
        // SAFETY: the caller's.
        unsafe {
            let vertices = bytemuck::cast_slice(&self.vertices);
            let screen = self.screen.upload(gl, caps, vertices, &mut Vec::new())?;
            gl.bind_vertex_array(Some(screen.vertex_array));
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer);
            gl.viewport(corner[0], corner[1], width, height);
            let blend = if own_target.is_some() { Blend::Add } else { Blend::Multiply };
            blend.apply(gl, *caps);
            set_surface(gl, program, view, &frame.surface, surface_offset);
            let u = &program.uniforms;
            let inputs = match pass {
                ProgramId::All => [(&u.taken, &self.taken), (&u.all, &None)],
                ProgramId::Ratio => [(&u.taken, &self.taken), (&u.all, &self.all)],
                _ => [(&u.visibility_0, &visibility[0]), (&u.visibility_1, &visibility[1])],
            };
            for (unit, (location, target)) in (3..).zip(inputs) {
                if let Some(target) = target {
                    gl.uniform_1_i32(location.as_ref(), unit);
                    bind_texture(gl, unit as u32, samples, target.texture);
                }
            }
            gl.uniform_2_i32(u.visibility_offset.as_ref(), visibility_offset[0], visibility_offset[1]);
            gl.uniform_3_f32_slice(u.ambient.as_ref(), &frame.ambient.to_array());
            gl.uniform_1_f32(u.gamma.as_ref(), host.gamma);
            if !lights.is_empty() {
                let data = self.light_data.pack(lights, view);
                gl.uniform_4_f32_slice(u.lights.as_ref(), bytemuck::cast_slice(data));
                gl.uniform_1_i32(u.light_count.as_ref(), lights.len() as i32);
            }
            let others =
                if own_target.is_none() { OtherBuffers::leave_alone(gl, *caps, framebuffer) } else { None };
            gl.draw_arrays(glow::TRIANGLES, 0, self.vertices.len() as i32);
            if let Some(others) = others {
                others.restore(gl);
            }
        }
        Ok(())
    }

    /// # Safety
    /// The context is current, and the overlay is not used afterwards.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            self.programs.delete(gl);
            self.screen.delete(gl);
            let targets = [&mut self.taken, &mut self.all];
            targets.into_iter().filter_map(Option::take).for_each(|target| target.delete(gl));
        }
    }
}
