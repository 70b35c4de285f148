//! Scene files of the antumbra shadow library: what a scene is, reading and writing one, and the scene at
//! a time.
//!
//! A [`Scene`] is read from TOML by [`Scene::load`] and validated on the way: whatever comes back can
//! be drawn, and whatever cannot be is a [`SceneError`] that names the file, line and column, says
//! what is wrong and what to write instead. [`Scene::moment`] places everything in the world at a
//! time. [`Scene::save`] writes it, and leaves what a person wrote as it is where it still holds;
//! [`Scene::validate`] tells whether a scene that was changed in memory is one that a file can hold. Units
//! are metres, seconds and linear RGB; angles are degrees in the file and radians here.
//!
//! ```
//! use antumbra_scene::Scene;
//!
//! let text = r#"
//! camera = { eye = [0.0, 6.0, 12.0] }
//!
//! [[light]]
//! name = "key"
//! type = "point"
//! position = [4.0, 8.0, 0.0]
//! intensity = 120.0
//! motion = { type = "orbit", center = [0.0, 8.0, 0.0], axis = [0.0, 1.0, 0.0], period = 8.0 }
//!
//! [[object]]
//! name = "ball"
//! shape = { type = "sphere", radius = 0.5 }
//! translation = [0.0, 1.5, 0.0]
//! "#;
//! let scene = Scene::parse(text, "ball.toml".as_ref())?;
//! let half_way = scene.moment(4.0);
//! assert!((half_way.lights[0].position.x + 4.0).abs() < 1e-12, "the light is on the other side");
//!
//! let error = Scene::parse(&text.replace("0.5", "-0.5"), "ball.toml".as_ref()).unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "ball.toml:13:37: \"radius\" of \"shape\" of object \"ball\" is -0.5, but a length is above zero; \
//!      write radius = 0.5"
//! );
//!
//! let mut dimmed = scene.clone();
//! dimmed.lights[0].intensity = 60.0;
//! assert_eq!(dimmed.validate(), Ok(()));
//! assert_eq!(dimmed.update_toml(text), text.replace("120.0", "60.0"), "one number has changed");
//! assert_eq!(Scene::parse(&dimmed.to_toml(), "ball.toml".as_ref())?, dimmed);
//! # Ok::<(), antumbra_scene::SceneError>(())
//! ```
//!
//! # The format
//!
//! | Table | Required | Optional, with what it is otherwise |
//! |---|---|---|
//! | the file | `camera` | `ambient` (0), `image`, any number of `[[light]]` and `[[object]]` |
//! | `[camera]` | `eye` | `target` (origin), `up` (+Y), `fov_y` (45°) |
//! | `[image]` | | `width` (960), `height` (540), `background`, `exposure` (1) |
//! | `[[light]]` | `name`, `type`, `intensity`, `position` (not directional), `direction` (not point, sphere), and of its type `radius`, `right`, `width`, `height` | `color` (white), `motion`, `inner_angle` (0°), `outer_angle` (45°) |
//! | `[[object]]` | `name`, either `shape` or `parts` | `translation`, `rotation`, `color` (0.8 grey), `casts_shadow`, `receives_shadow` (true), `motion` |
//! | a part | `shape` | `translation`, `rotation` |
//! | `motion` | `type`, `period`, and `center`, `axis` (orbit) or `points` (path) | |
//!
//! Directions and rotations may have any length but zero. How much a file may ask for is in [`limits`].
#![forbid(unsafe_code)]

mod bounds;
mod camera;
mod degrees;
mod error;
pub mod limits;
mod mesh;
mod mesh_builder;
mod mesh_gltf;
mod mesh_obj;
mod model;
mod motion;
mod names;
mod parse;
mod parse_light;
mod parse_motion;
mod parse_object;
mod parse_shape;
mod save;
mod table;
mod text;
mod tree;
mod unit;
mod update;
mod values;
mod write;

pub use error::SceneError;
pub use model::*;
