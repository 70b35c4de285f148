//! Percentage-closer soft shadows, in float32 as on the GPU. Twins: `shaders/map/soft.glsl`. After Randima Fernando,
//! "Percentage-Closer Soft Shadows", 2005.

use glam::{Vec2, vec2};

const GOLDEN_ANGLE: f32 = 2.399_963_3;

/// The points of a light of size one, `index` below `count`: a disc filled by Vogel's spiral ("A better way to
/// construct the sunflower head", 1979), or a square by the R2 sequence (Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018). The same for every pixel and frame.
pub fn light_point(index: u32, count: u32, square: bool) -> Vec2 {
    let i = index as f32 + 0.5;
    if square {
        let at = vec2(0.754_877_7, 0.569_840_3) * i;
        return (at - at.floor()) * 2.0 - 1.0;
    }
    let angle = i * GOLDEN_ANGLE;
    vec2(angle.cos(), angle.sin()) * (i / count as f32).sqrt()
}

/// How far from the middle such a point is, in sizes of the light: 0 to 1.
pub fn light_reach(point: Vec2, square: bool) -> f32 {
    if square { point.abs().max_element() } else { point.length() }
}

/// How much of the light's size the way to a blocker spreads to, seen from the light: the blocker is at `share` of
/// the way from the light to the receiver. It is (d_receiver - d_blocker) / d_blocker of Fernando's estimate: 0 for a
/// blocker at the receiver, a million for one at the light or behind it.
pub fn penumbra_scale(share: f32) -> f32 {
    1.0 / share.max(1e-6) - 1.0
}

/// How much a blocker counts, seen at so many radii of the cone from the receiver to the light from its middle: 1
/// inside, 0 from `slack`, more than 1, on.
pub fn blocker_weight(beside: f32, slack: f32) -> f32 {
    ((slack - beside) / (slack - 1.0)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each tenth of the light gets its share of the points, to within the few that a count of 48 leaves open.
    #[test]
    fn points_fill_the_light_evenly() {
        const COUNT: u32 = 48;
        for square in [false, true] {
            let points: Vec<Vec2> = (0..COUNT).map(|i| light_point(i, COUNT, square)).collect();
            assert!(points.iter().all(|&p| light_reach(p, square) <= 1.0), "inside the light");
            let mean = points.iter().sum::<Vec2>() / COUNT as f32;
            // Random points would be 0.1 off, in the mean.
            assert!(mean.length() < 0.07, "{mean} is the middle");
            for part in 1..10 {
                let reach = part as f32 * 0.1;
                let inside = points.iter().filter(|&&p| light_reach(p, square) < reach).count() as f32;
                let expected = COUNT as f32 * reach * reach;
                assert!((inside - expected).abs() <= 4.0, "{inside} of {expected} within {reach}");
            }
        }
    }

    #[test]
    fn penumbras_grow_from_the_blocker() {
        assert_eq!(penumbra_scale(1.0), 0.0, "at the receiver");
        assert_eq!(penumbra_scale(0.5), 1.0, "half way: as wide as the light");
        assert!(
            penumbra_scale(0.0).is_finite() && penumbra_scale(-1.0).is_finite(),
            "at the light and behind"
        );
    }
}
