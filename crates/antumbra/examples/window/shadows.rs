use antumbra::{Camera, Encoding, Error, Frame, Light, Occluder, Renderer, Surface};
use std::ffi::c_void;

/// Position, colour times candela.
pub(crate) const LIGHTS: [([f32; 3], [f32; 3]); 2] =
    [([3.0, 5.0, 2.0], [90.0, 75.0, 60.0]), ([-4.0, 4.0, 1.0], [15.0, 30.0, 60.0])];
/// Centre, radius.
pub(crate) const BALLS: [([f32; 3], f32); 3] =
    [([0.0, 1.0, 0.0], 1.0), ([1.7, 0.5, 0.6], 0.5), ([-1.2, 0.4, 1.4], 0.4)];
pub(crate) const AMBIENT: [f32; 3] = [0.3; 3];

pub(crate) struct Shadows(Renderer);

impl Shadows {
    /// Once, where the window's OpenGL context is current. The loader is the window library's: `glfwGetProcAddress`,
    /// `SDL_GL_GetProcAddress`, glutin's `get_proc_address`.
    pub(crate) fn new(loader: impl FnMut(&str) -> *const c_void) -> Result<Self, Error> {
        // SAFETY: the loader finds functions of the current context, which stays current on this thread.
        Ok(Self(unsafe { Renderer::from_loader(loader)? }))
    }

    /// Every frame, when everything is drawn and before the window shows it.
    pub(crate) fn add(
        &mut self,
        view: [[f32; 4]; 4],
        projection: [[f32; 4]; 4],
        [width, height]: [i32; 2],
    ) -> Result<(), Error> {
        let lights = LIGHTS.map(|(position, intensity)| Light::point(position, intensity));
        let occluders = BALLS.map(|(center, radius)| Occluder::sphere(center, radius));
        // Depth is copied from the window's own, whatever its format and samples are.
        let frame = Frame::new(Camera::new(view, projection), [0, 0, width, height], Surface::copied())
            .lights(&lights)
            .occluders(&occluders)
            .ambient(AMBIENT);
        self.0.overlay(&frame, Encoding::Gamma(2.2)) // as the shader encodes its colours
    }
}
