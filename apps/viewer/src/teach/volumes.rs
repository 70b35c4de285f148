//! Shadow volumes as the technique `volume` draws them: silhouettes pushed away from the light.

use antumbra::math::Light as Place;
use glam::DVec3;

use super::silhouette::silhouette;
use super::{Drawing, LineKind, Pair, Situation};

impl Situation<'_> {
    /// Adds the shadow volume of a primitive from a light without area: a [`LineKind::VolumeSide`] for every edge of the
    /// silhouette, and the outlines of both caps. In truth it is infinitely long; it is drawn to the first planar
    /// receiver in the way of each point of the silhouette but the caster itself, and `distance` metres far where there
    /// is none.
    ///
    /// Round shapes have the sides that the techniques tessellate them with. Nothing for area lights, for infinite planes,
    /// and for a distance that is not above zero and finite. A silhouette that the light itself lies on has no sides
    /// there.
    pub(crate) fn volume(&self, light: usize, primitive: usize, distance: f64, drawing: &mut Drawing) {
        let Some(pair) = self.pair(light, primitive) else { return };
        if !(distance > 0.0 && distance.is_finite()) {
            return;
        }
        for near in silhouette(self, &pair) {
            let far: Vec<DVec3> = near.points.iter().map(|&p| self.pushed(&pair, p, distance)).collect();
            let count = near.points.len();
            for a in 0..count - usize::from(!near.closed) {
                let b = (a + 1) % count;
                let side = vec![near.points[a], near.points[b], far[b], far[a]];
                drawing.add(&pair, LineKind::VolumeSide, side, true);
            }
            drawing.add(&pair, LineKind::NearCap, near.points, near.closed);
            drawing.add(&pair, LineKind::FarCap, far, near.closed);
        }
    }

    /// A point of the silhouette at the volume's far end; not finite where the light is.
    fn pushed(&self, pair: &Pair<'_>, p: DVec3, distance: f64) -> DVec3 {
        let away = match pair.light.place {
            Place::Directional { direction } => direction,
            Place::Point { position } | Place::Spot { position, .. } => p - position,
        };
        let Some(away) = away.try_normalize() else { return DVec3::NAN };
        let hits = self.receivers_of(pair.primitive_index).filter_map(|receiver| {
            let t = -receiver.frame.height(p) / receiver.frame.normal.dot(away);
            let q = receiver.frame.coordinates(p + away * t);
            (t >= 0.0 && receiver.bounds.contains(q)).then_some(t)
        });
        let nearest = hits.fold(f64::INFINITY, f64::min);
        p + away * if nearest.is_finite() { nearest } else { distance }
    }
}
