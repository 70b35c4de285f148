//! One frame of the host, as far as shadows are concerned.

use super::{Color, Component, Light, Matrix, MeshOccluder, Occluder, Receiver, Scenery, Surface};
use antumbra_math::Plane;
use glam::{DMat4, Vec3};

/// One frame of the host, as far as shadows are concerned.
///
/// ```
/// # use antumbra_gl::{Camera, Frame, Light, Occluder, Surface};
/// # let (view, projection, width, height) = ([0.0f32; 16], [0.0f32; 16], 640, 480);
/// let lights = [Light::point([3.0, 5.0, 2.0], [90.0, 75.0, 60.0])];
/// let occluders = [Occluder::sphere([0.0, 1.0, 0.0], 1.0)];
/// let frame = Frame::new(Camera::new(view, projection), [0, 0, width, height], Surface::copied())
///     .lights(&lights)
///     .occluders(&occluders)
///     .ambient([0.3, 0.3, 0.3]);
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Frame<'a> {
    /// The host's camera.
    pub camera: Camera,
    /// The host's viewport: x, y, width, height, as in `glViewport`.
    pub viewport: [i32; 4],
    /// Window pixels that the overlay may change, as in `glScissor`; `None` for all of the viewport. The host's own
    /// scissor test is not asked for: where it cuts off what the host draws, such as a widget half scrolled out of sight,
    /// hand over the same rectangle.
    pub clip: Option<[i32; 4]>,
    /// What the host has drawn.
    pub surface: Surface,
    /// The lights, any number of them.
    pub lights: &'a [Light],
    /// What blocks them.
    pub occluders: &'a [Occluder],
    /// Meshes that block them too, for the techniques that cast from triangles.
    pub meshes: &'a [MeshOccluder],
    /// The flat surfaces that techniques confined to planes draw shadows on; others do not ask.
    pub receivers: &'a [Receiver],
    /// Half-spaces (the sides that the normals point to) that hold everything the host shows, such
    /// as the space above a floor that nothing is seen below; empty if there are none to tell. They
    /// save time where shadows would go on unseen. Opaque planes among the occluders, with an id,
    /// count by themselves.
    pub bounds: &'a [Plane],
    /// Where the technique `composite` has the components of lights with an area, if not on their rims: for
    /// viewers that move them one by one. Of lights named here these are all but the central one. Other techniques do
    /// not ask.
    pub components: &'a [Component],
    /// Light from everywhere that no shadow takes away, linear RGB, in units of irradiance: a
    /// host that adds `albedo * ambient` to `albedo / π * Σ E` gives π times its `ambient`.
    pub ambient: Vec3,
}

impl<'a> Frame<'a> {
    /// What a host has drawn, with no lights, nothing that blocks them and no ambient light yet.
    pub fn new(camera: Camera, viewport: [i32; 4], surface: Surface) -> Self {
        Self {
            camera,
            viewport,
            clip: None,
            surface,
            lights: &[],
            occluders: &[],
            meshes: &[],
            receivers: &[],
            bounds: &[],
            components: &[],
            ambient: Vec3::ZERO,
        }
    }

    /// The same with another [`Self::camera`].
    pub fn camera(self, camera: Camera) -> Self {
        Self { camera, ..self }
    }

    /// The same with another [`Self::viewport`].
    pub fn viewport(self, viewport: [i32; 4]) -> Self {
        Self { viewport, ..self }
    }

    /// The same with another [`Self::clip`].
    pub fn clip(self, clip: [i32; 4]) -> Self {
        Self { clip: Some(clip), ..self }
    }

    /// The same with another [`Self::surface`].
    pub fn surface(self, surface: Surface) -> Self {
        Self { surface, ..self }
    }

    /// The same with these [`Self::lights`].
    pub fn lights(self, lights: &'a [Light]) -> Self {
        Self { lights, ..self }
    }

    /// The same with these [`Self::occluders`].
    pub fn occluders(self, occluders: &'a [Occluder]) -> Self {
        Self { occluders, ..self }
    }

    /// The same with these [`Self::meshes`].
    pub fn meshes(self, meshes: &'a [MeshOccluder]) -> Self {
        Self { meshes, ..self }
    }

    /// The same with these [`Self::receivers`].
    pub fn receivers(self, receivers: &'a [Receiver]) -> Self {
        Self { receivers, ..self }
    }

    /// The same with these [`Self::bounds`].
    pub fn bounds(self, bounds: &'a [Plane]) -> Self {
        Self { bounds, ..self }
    }

    /// The same with these [`Self::components`].
    pub fn components(self, components: &'a [Component]) -> Self {
        Self { components, ..self }
    }

    /// The same with this [`Self::ambient`] light.
    pub fn ambient(self, ambient: impl Into<Color>) -> Self {
        Self { ambient: ambient.into().glam(), ..self }
    }

    /// The part of the frame that says what a technique is asked to do.
    pub fn scenery(&self) -> Scenery<'a> {
        Scenery {
            lights: self.lights,
            occluders: self.occluders,
            meshes: self.meshes,
            receivers: self.receivers,
        }
    }
}

/// The host's view and projection.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Camera {
    /// World to view space: a rotation and a translation, nothing else. Right-handed, looking
    /// along -Z.
    pub view: DMat4,
    /// View to clip space: any perspective or orthographic projection, off-centre, infinite and
    /// reversed ones too.
    pub projection: DMat4,
}

impl Camera {
    /// The host's matrices, column-major as OpenGL takes them, of either precision.
    pub fn new(view: impl Into<Matrix>, projection: impl Into<Matrix>) -> Self {
        Self { view: view.into().glam(), projection: projection.into().glam() }
    }
}
