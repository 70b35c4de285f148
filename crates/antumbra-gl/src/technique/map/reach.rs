//! The tiles of the screen that a light's shadows can reach.

use super::bounds::Surroundings;
use crate::input::Light;
use crate::screen::{ProxyBuilder, TileGrid, View};
use antumbra_math::Sphere;
use antumbra_math::blocking::Blockers;
use glam::DVec4;

/// Touches the tiles in which a caster of `around` may darken something, its filtered edge included: `texel` is the
/// size of a texel in metres, and more for each metre, and `margin` how many the filter reaches.
pub(super) fn touch(
    tiles: &mut TileGrid,
    proxy: &mut ProxyBuilder,
    around: &Surroundings,
    light: &Light,
    (texel, margin): (DVec4, f64),
    view: &View,
) {
    let light_vs = light.place.transformed(&view.view);
    let at = light.place.homogeneous().truncate();
    for caster in &around.casters {
        // For a directional light texel.w is 0.
        let far = caster.center.distance(at) + caster.radius;
        let blur = margin * (texel.z + texel.w * far);
        let center = view.view.transform_point3(caster.center);
        let ball = Sphere { center, radius: caster.radius + blur };
        if !light.may_reach(&light_vs, ball.center, ball.radius) {
            continue;
        }
        for (_, outline) in Blockers::new(&ball.into(), &light_vs).iter() {
            let polygon = proxy.bound(outline, true, light_vs.homogeneous(), view, &around.half_spaces);
            if polygon.len() >= 3 {
                tiles.touch(polygon);
            }
        }
    }
}
