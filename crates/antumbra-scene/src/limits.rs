//! What a scene file may ask for at most. Each limit is far above what a picture needs and far
//! below what would exhaust memory or overflow the arithmetic of anything that draws the scene.

/// Largest absolute coordinate, metres: past the size of the Earth. Its sixth power still fits into
/// float32, and products of four coordinates are the most that a shadow test multiplies.
pub const MAX_COORDINATE: f64 = 1e6;

/// Smallest length, metres: a radius, a side, the distance of the eye from its target. Its sixth
/// power is still a normal float32.
pub const MIN_LENGTH: f64 = 1e-6;

/// Largest length, metres.
pub const MAX_LENGTH: f64 = 1e6;

/// Largest intensity (candela or lux), radiance, ambient factor and exposure: sunlight is 1e5 lux, a
/// lighthouse 1e6 candela.
pub const MAX_BRIGHTNESS: f64 = 1e9;

/// Largest component of a light's colour; 1 is usual.
pub const MAX_LIGHT_COLOR: f64 = 1e3;

/// Shortest period of a motion, seconds.
pub const MIN_PERIOD: f64 = 1e-3;

/// Longest period of a motion, seconds: thirty years.
pub const MAX_PERIOD: f64 = 1e9;

/// Narrowest and widest vertical field of view, degrees. Beyond, the tangent loses its digits.
pub const FOV_Y_DEGREES: (f64, f64) = (0.01, 179.0);

/// Most pixels across or down.
pub const MAX_IMAGE_SIDE: u32 = 16384;

/// Most bytes in a scene file. Parsing takes some 150 times that in memory at worst, where the file is
/// nothing but commas and brackets.
pub const MAX_SCENE_BYTES: usize = 2 << 20;

/// Most lights in a scene.
pub const MAX_LIGHTS: usize = 4096;

/// Most objects in a scene.
pub const MAX_OBJECTS: usize = 16384;

/// Most parts in all objects of a scene together.
pub const MAX_PARTS: usize = 65536;

/// Most points in a path.
pub const MAX_PATH_POINTS: usize = 4096;

/// Most bytes in the name of a light or an object: a file name of 255 bytes with room for a suffix.
pub const MAX_NAME_BYTES: usize = 128;

/// Most dots in one key. The format needs one (`camera.eye`); the tables of a key of a million dots
/// would overflow the stack when they are dropped.
pub const MAX_KEY_DOTS: usize = 8;

/// Most bytes in a mesh file, and in each file it refers to.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Most vertices, and most triangles, in all meshes of a scene together.
pub const MAX_MESH_ELEMENTS: usize = 1 << 24;
