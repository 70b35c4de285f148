//! The host's camera and picture in numbers, and which pixels a shadow can reach: geometry in float64, without OpenGL.

mod check;
mod half_spaces;
mod proxy;
mod surface;
mod tiles;
mod view;

pub(crate) use check::check_viewport;
pub(crate) use half_spaces::{hides_its_own_shadow, seen_half_spaces};
pub(crate) use proxy::{ProxyBuilder, crossing, nearest_end};
pub(crate) use tiles::TileGrid;
pub(crate) use view::View;
