//! Where the umbra, the penumbra and the antumbra of a ball under a sphere light lie on a plane.
//!
//! Two balls apart (a light with centre L and radius R, an occluder with centre C and radius r) have two
//! common tangent cones. The inner one, with its apex X = (r L + R C) / (R + r) between them, bounds
//! what sees any of the light hidden: the shadow of the occluder from X. The outer one, with its apex
//! Y = (R C - r L) / (R - r), bounds what sees all of the one before the other: of a larger light the
//! umbra is the tip between occluder and Y, and behind Y lies the antumbra; for radii that are equal the
//! cone is a cylinder; of a smaller light Y lies behind the light and the umbra is the shadow from
//! there. Every section is the inside of a conic, but for occluders that reach through the plane.

use glam::{DVec2, DVec3};

use crate::{Light, PlaneFrame, PlaneShadow, Sphere};

/// Radii this close, as a fraction of their sum, are equal: the apex of their outer cone is 1e12
/// distances away, and rounding begins to tell where.
const EQUAL: f64 = 1e-12;

/// Balls that overlap by no more than this, as a fraction of their distance, touch: what rounding leaves
/// of balls meant to.
const TOUCHING: f64 = 1e-12;

/// What a point sees of a light behind an occluder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Zone {
    /// All of the light.
    Lit,
    /// A part of the light; the occluder covers some of its rim.
    Penumbra,
    /// Nothing of the light.
    Umbra,
    /// A ring of the light: the occluder is seen inside it.
    Antumbra,
}

/// The outlines of the soft shadow of a ball under a sphere light on a plane.
///
/// As for [`PlaneShadow`], both sides of the plane receive. The whole light counts, also what of it lies
/// below the plane: a receiver that faces up sees less of a light that reaches through the plane, and
/// in a penumbra perhaps nothing or nothing hidden.
///
/// ```
/// use antumbra_math::soft::{PenumbraOutline, Zone};
/// use antumbra_math::{Plane, PlaneFrame, Sphere};
/// use glam::{DVec2, DVec3};
///
/// let floor = PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).unwrap();
/// let light = Sphere { center: DVec3::Y * 5.0, radius: 2.0 };
/// let ball = Sphere { center: DVec3::Y * 2.0, radius: 0.5 };
/// let outline = PenumbraOutline::new(&light, &ball, &floor).unwrap();
/// // The umbra ends above the floor.
/// assert!((outline.outer_apex().unwrap() - DVec3::Y).length() < 1e-12);
/// assert_eq!(outline.zone(DVec2::ZERO), Zone::Antumbra);
/// assert_eq!(outline.zone(DVec2::X), Zone::Penumbra);
/// assert_eq!(outline.zone(DVec2::X * 4.0), Zone::Lit);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PenumbraOutline {
    penumbra: PlaneShadow,
    umbra: PlaneShadow,
    antumbra: PlaneShadow,
    inner_apex: DVec3,
    outer_apex: Option<DVec3>,
}

impl PenumbraOutline {
    /// The outlines on the plane of `frame`. Radii in metres.
    ///
    /// - `None` for balls that overlap, which have no inner tangent cone, for a radius below 0, and for
    ///   an infinity or a NaN in light or ball. Balls that touch are fine: their inner cone is a plane.
    /// - A light of radius 0 is a point: the umbra is the hard shadow, and so is the penumbra's outer
    ///   edge. A ball of radius 0 casts nothing. A frame with an infinity or a NaN gets nothing.
    /// - A plane through an apex has a single point of that cone, and the region is nothing. If light and
    ///   ball both reach through the plane more of the cone may lie in it; this too is left out.
    pub fn new(light: &Sphere, ball: &Sphere, frame: &PlaneFrame) -> Option<Self> {
        let (big_r, r) = (light.radius, ball.radius);
        // Seen from the ball, so that what is small and far from the origin loses nothing.
        let to_light = light.center - ball.center;
        let distance = to_light.length();
        let is_apart = big_r + r <= distance * (1.0 + TOUCHING) && distance > 0.0;
        if !(is_apart && big_r >= 0.0 && r >= 0.0 && distance.is_finite()) {
            return None;
        }
        let local = PlaneFrame { origin: frame.origin - ball.center, ..*frame };
        let shape = Sphere { center: DVec3::ZERO, radius: r };
        let hard = |light| PlaneShadow::cast(&shape.into(), &light, &local);
        // What has no radius at all is hidden by nothing, wherever its apex is.
        let inner = if r > 0.0 { to_light * (r / (big_r + r)) } else { DVec3::ZERO };
        let outer = to_light * (-r / (big_r - r));
        let is_cylinder = (big_r - r).abs() <= EQUAL * (big_r + r);
        let none = || hard(Light::Point { position: DVec3::NAN });
        let (umbra, antumbra) = if is_cylinder {
            (hard(Light::Directional { direction: -to_light / distance }), none())
        } else if big_r < r {
            (hard(Light::Point { position: outer }), none())
        } else {
            (PlaneShadow::before_apex(&shape, outer, &local), PlaneShadow::past_apex(&shape, outer, &local))
        };
        Some(Self {
            penumbra: hard(Light::Point { position: inner }),
            umbra,
            antumbra,
            inner_apex: ball.center + inner,
            outer_apex: (!is_cylinder).then_some(ball.center + outer),
        })
    }

    /// All that sees any of the light hidden; its boundary is the penumbra's outer edge.
    pub fn penumbra(&self) -> &PlaneShadow {
        &self.penumbra
    }

    /// All that sees nothing of the light; its boundary is the penumbra's inner edge. Of kind `Nothing`
    /// where the plane passes beyond the umbra's tip, or through it.
    pub fn umbra(&self) -> &PlaneShadow {
        &self.umbra
    }

    /// All that sees the whole ball before the light; its boundary is the penumbra's inner edge there.
    /// Of kind `Nothing` unless the light is the larger ball and the plane passes beyond the umbra's tip.
    /// A plane that cuts the ball may have both umbra and antumbra.
    pub fn antumbra(&self) -> &PlaneShadow {
        &self.antumbra
    }

    /// The apex of the inner common tangent cone, between light and ball, metres.
    pub fn inner_apex(&self) -> DVec3 {
        self.inner_apex
    }

    /// The apex of the outer common tangent cone: the tip of the umbra of a larger light; behind a
    /// smaller one. `None` for radii equal to 1e-12 of their sum. Metres.
    pub fn outer_apex(&self) -> Option<DVec3> {
        self.outer_apex
    }

    /// What the point of the plane at these coordinates sees. Points on the very edge may count either
    /// way; one with an infinity or a NaN is lit.
    pub fn zone(&self, point: DVec2) -> Zone {
        if self.umbra.contains(point) {
            Zone::Umbra
        } else if self.antumbra.contains(point) {
            Zone::Antumbra
        } else if self.penumbra.contains(point) {
            Zone::Penumbra
        } else {
            Zone::Lit
        }
    }
}
