//! What a technique cannot do where lights with an area are drawn as points.

use super::Technique;
use crate::input::{Area, Light, Part, Reason, Refusal, Scenery, Soft};

impl Technique {
    /// What it cannot do of a scenery if areas are drawn in such a way; `None` if it can do all of it. Needs no OpenGL.
    pub fn refusal_with(&self, soft: Soft, scenery: &Scenery<'_>) -> Option<Refusal> {
        let mut centers = Vec::new();
        self.refusal_in(soft, scenery, &mut centers)
    }

    /// The same with memory that is kept.
    pub(crate) fn refusal_in(
        &self,
        soft: Soft,
        scenery: &Scenery<'_>,
        centers: &mut Vec<Light>,
    ) -> Option<Refusal> {
        let Soft::Samples { count, .. } = soft else { return self.refusal(scenery) };
        if !(1..=Soft::MOST).contains(&count) {
            return Some(Refusal::new(Part::Options, Reason::SampleCount(count)));
        }
        centers.clear();
        centers.extend(scenery.lights.iter().map(|light| Light { area: Area::None, ..*light }));
        let first_area = scenery.lights.iter().position(|light| light.area != Area::None);
        if let (Some(light), true) = (first_area, self.paints()) {
            return Some(Refusal::new(Part::Light(light), Reason::PaintedSamples));
        }
        self.refusal(&Scenery { lights: centers, ..*scenery })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Receiver, ReceiverShape};
    use glam::{DVec3, Vec3};

    #[test]
    fn techniques_are_asked_about_hard_lights() {
        let light = Light::point([0.0, 5.0, 0.0], Vec3::ONE);
        let lights = [light, light.with_area(Area::Sphere { radius: 0.7 })];
        let receivers = [Receiver {
            shape: ReceiverShape::Plane(antumbra_math::Plane::through(DVec3::ZERO, DVec3::Y)),
            id: 0,
        }];
        let scenery = Scenery { lights: &lights, receivers: &receivers, ..Scenery::default() };
        let refusal = |technique: &str, soft: Soft| {
            let technique = Technique::parse(technique).expect(technique);
            technique.refusal_with(soft, &scenery).map(|refusal| refusal.part)
        };
        assert_eq!(refusal("projected", Soft::Native), Some(Part::Light(1)), "it has hard shadows alone");
        assert_eq!(refusal("projected", Soft::samples(4)), None, "and those it can average");
        assert_eq!(refusal("composite:shade=physical", Soft::samples(4)), None, "the same");
        assert_eq!(refusal("composite", Soft::samples(4)), Some(Part::Light(1)), "paint is not averaged");
        for count in [0, Soft::MOST + 1] {
            assert_eq!(refusal("analytic", Soft::samples(count)), Some(Part::Options), "{count} samples");
        }
    }
}
