//! What a host tells antumbra: its camera and what it has drawn.

use super::{Component, Light, MeshOccluder, Occluder, Receiver, Scenery, Surface};
use glam::{DMat4, Mat4, Vec3};

/// One frame of the host, as far as shadows are concerned.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The host's camera.
    pub camera: Camera,
    /// The host's viewport: x, y, width, height, as in `glViewport`.
    pub viewport: [i32; 4],
    /// What the host has drawn. Its textures must exist and be of the kinds [`Surface`] says: what
    /// OpenGL does with others is undefined.
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
    pub bounds: &'a [antumbra_math::Plane],
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
pub struct Camera {
    /// World to view space: a rotation and a translation, nothing else. Right-handed, looking
    /// along -Z.
    pub view: DMat4,
    /// View to clip space: any perspective or orthographic projection, off-centre, infinite and
    /// reversed ones too.
    pub projection: DMat4,
}

impl Camera {
    /// The host's matrices, column-major as OpenGL takes them.
    pub fn new(view: Mat4, projection: Mat4) -> Self {
        Self { view: view.as_dmat4(), projection: projection.as_dmat4() }
    }
}
