//! The data of a scene, as the file gives it, and the scene at one moment.

use glam::{DQuat, DVec3};

/// A whole scene: what is lit, by what, and seen from where.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Ambient radiance factor, linear RGB: every surface adds `albedo * ambient`.
    pub ambient: DVec3,
    /// The pinhole camera.
    pub camera: Camera,
    /// Size, background and exposure of the picture.
    pub image: Image,
    /// The lights, in the file's order; names are unique.
    pub lights: Vec<Light>,
    /// The objects, in the file's order; names are unique.
    pub objects: Vec<Object>,
}

/// A pinhole camera looking from `eye` to `target`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the eye, metres.
    pub eye: DVec3,
    /// The point in the middle of the picture, metres.
    pub target: DVec3,
    /// Any vector not parallel to the line of sight; it points upwards in the picture.
    pub up: DVec3,
    /// Vertical field of view, radians, in (0, π).
    pub fov_y: f64,
}

/// The picture a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Linear RGB where no object is seen.
    pub background: DVec3,
    /// Factor on linear colour before it is written.
    pub exposure: f64,
}

impl Default for Image {
    /// What a scene file that says nothing about the image gets.
    fn default() -> Self {
        Self { width: 960, height: 540, background: DVec3::new(0.02, 0.02, 0.03), exposure: 1.0 }
    }
}

/// A light as the file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name, usable as a file name and unique even ignoring ASCII case: it names the light's
    /// visibility file.
    pub name: String,
    /// What kind of light, with the parameters only that kind has.
    pub kind: LightKind,
    /// Position at rest, metres. Zero for directional lights, which have none.
    pub position: DVec3,
    /// Linear RGB, multiplied with the intensity.
    pub color: DVec3,
    /// Candela; lux for directional lights. Never negative, but zero for a light that is off.
    pub intensity: f64,
    /// How the position moves; `None` keeps it.
    pub motion: Option<Motion>,
}

/// The kinds of light. Directions are unit vectors that point where the light shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Shines equally to all sides from one point.
    Point,
    /// Parallel light.
    Directional {
        /// Unit vector along which light travels.
        direction: DVec3,
    },
    /// A point light limited to a cone, as in glTF's KHR_lights_punctual.
    Spot {
        /// Unit axis of the cone, away from the light.
        direction: DVec3,
        /// Half-angle, radians, inside which the light is full; at least zero.
        inner_angle: f64,
        /// Half-angle, radians, outside which there is none; above `inner_angle`, at most π/2.
        outer_angle: f64,
    },
    /// A glowing sphere.
    Sphere {
        /// Radius, metres, positive.
        radius: f64,
    },
    /// A one-sided Lambertian disc.
    Disc {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Radius, metres, positive.
        radius: f64,
    },
    /// A one-sided Lambertian rectangle.
    Rectangle {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Unit vector in the rectangle's plane, along which `width` runs.
        right: DVec3,
        /// Full size along `right`, metres, positive.
        width: f64,
        /// Full size across, metres, positive.
        height: f64,
    },
}

impl LightKind {
    /// Its `type` in a scene file.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Directional { .. } => "directional",
            Self::Spot { .. } => "spot",
            Self::Sphere { .. } => "sphere",
            Self::Disc { .. } => "disc",
            Self::Rectangle { .. } => "rectangle",
        }
    }
}

/// An object: one shape or several parts moved as one, and how it looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Unique name, for error messages and statistics.
    pub name: String,
    /// The parts; exactly one, at the identity pose, for an object with a plain `shape`.
    pub parts: Vec<Part>,
    /// Pose of the object at rest; parts are placed inside it.
    pub pose: Pose,
    /// Albedo, linear RGB.
    pub color: DVec3,
    /// Whether the object takes light from others.
    pub casts_shadow: bool,
    /// Whether shadows fall on the object.
    pub receives_shadow: bool,
    /// How the translation moves; `None` keeps it.
    pub motion: Option<Motion>,
}

/// One shape of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The shape, centred on the part's origin with axis +Y.
    pub shape: Shape,
    /// Pose inside the object.
    pub pose: Pose,
}

/// Rotation, then translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Metres.
    pub translation: DVec3,
    /// Unit quaternion.
    pub rotation: DQuat,
}

impl Pose {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// The pose of something placed at `inner` inside something placed at `self`.
    pub fn then(&self, inner: &Self) -> Self {
        Self { translation: self.point(inner.translation), rotation: self.rotation * inner.rotation }
    }

    /// A point from inside the pose to outside.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.translation
    }

    /// A direction from inside the pose to outside.
    pub fn direction(&self, d: DVec3) -> DVec3 {
        self.rotation * d
    }
}

/// The shapes, centred on their origin with axis +Y. Lengths in metres, all positive and finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The infinite plane y = 0.
    Plane,
    /// A flat rectangle in y = 0.
    Rectangle {
        /// Full size along X.
        width: f64,
        /// Full size along Z.
        depth: f64,
    },
    /// A flat disc in y = 0.
    Disc {
        /// Radius.
        radius: f64,
    },
    /// A flat triangle with any three vertices that are not on one line.
    Triangle {
        /// Its corners.
        vertices: [DVec3; 3],
    },
    /// A ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// An ellipsoid with axes along X, Y and Z.
    Ellipsoid {
        /// Semi-axes.
        radii: DVec3,
    },
    /// A solid cone, apex at y = height/2, base at y = -height/2.
    Cone {
        /// Radius of the base.
        radius: f64,
        /// From base to apex.
        height: f64,
    },
    /// A solid cylinder or frustum from y = -height/2 to y = height/2.
    Cylinder {
        /// Radius at the bottom.
        radius: f64,
        /// From bottom to top.
        height: f64,
        /// Radius at the top.
        radius_top: f64,
    },
    /// A cylinder with a half ball at each end.
    Capsule {
        /// Radius.
        radius: f64,
        /// Height of the cylindrical part alone.
        height: f64,
    },
    /// A box.
    Box {
        /// Full sizes along X, Y and Z.
        size: DVec3,
    },
    /// A torus around the Y axis.
    Torus {
        /// From the axis to the middle of the tube.
        major_radius: f64,
        /// Radius of the tube; at most the major radius.
        minor_radius: f64,
    },
    /// Triangles from a file.
    Mesh(std::sync::Arc<Mesh>),
}

impl Shape {
    /// Its `type` in a scene file.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Rectangle { .. } => "rectangle",
            Self::Disc { .. } => "disc",
            Self::Triangle { .. } => "triangle",
            Self::Sphere { .. } => "sphere",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Cone { .. } => "cone",
            Self::Cylinder { .. } => "cylinder",
            Self::Capsule { .. } => "capsule",
            Self::Box { .. } => "box",
            Self::Torus { .. } => "torus",
            Self::Mesh(_) => "mesh",
        }
    }
}

/// An indexed triangle mesh. It has at least one triangle, and none without area.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Path as the scene file wrote it.
    pub path: String,
    /// Vertices, metres.
    pub positions: Vec<DVec3>,
    /// Corners of each triangle; every index is below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
}

/// How a position moves over time. Positions are absolute: the motion replaces the one at rest.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Around an axis: the position at rest, turned about the axis through `center`.
    Orbit {
        /// A point on the axis, metres.
        center: DVec3,
        /// Unit axis.
        axis: DVec3,
        /// Seconds for one turn; never zero, negative turns the other way.
        period: f64,
    },
    /// Along a closed polygon at the same time for each side.
    Path {
        /// At least two corners, metres.
        points: Vec<DVec3>,
        /// Seconds for one round; positive.
        period: f64,
    },
}

/// The scene at one moment, flattened: every part in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The lights where they are now, in the scene's order; `motion` is `None`.
    pub lights: Vec<Light>,
    /// Every part of every object, in the scene's order.
    pub primitives: Vec<Primitive>,
}

/// One part of one object, placed in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// Index of the object in [`Scene::objects`].
    pub object: usize,
    /// Index of the part in [`Object::parts`].
    pub part: usize,
    /// The shape, centred on its origin.
    pub shape: Shape,
    /// From the shape to the world.
    pub pose: Pose,
    /// Albedo, linear RGB.
    pub color: DVec3,
    /// Whether it takes light from others.
    pub casts_shadow: bool,
    /// Whether shadows fall on it.
    pub receives_shadow: bool,
}
