//! How lights weaken with the distance.

/// How a light weakens with the distance d from it, for hosts of every habit. What arrives is its intensity times
///
/// window(d) / max([`least`](Self::least), [`constant`](Self::constant) + [`linear`](Self::linear) d
/// \+ [`quadratic`](Self::quadratic) d² + d^[`exponent`](Self::exponent))
///
/// where the last term counts if its exponent is above 0, and the window is 1 for a light without a range
/// ([`Light::with_range`](crate::Light::with_range)), else max(0, 1 - (d / range)⁴), squared if
/// [`squared_window`](Self::squared_window). Directional lights do not weaken.
///
/// | the host's shader | here |
/// |---|---|
/// | `intensity / (d * d)`: physical, glTF | [`Falloff::PHYSICAL`], the default |
/// | the same with glTF's `range` | `PHYSICAL` and [`Light::with_range`](crate::Light::with_range) |
/// | `intensity`, whatever the distance | [`Falloff::NONE`] |
/// | `intensity / (c + l * d + q * d * d)`: classic OpenGL | [`Falloff::classic`] |
/// | `intensity / max(1.0, c + l * d + q * d * d)`: three-d | [`Falloff::three_d`] |
/// | `getDistanceAttenuation(d, distance, decay)`: three.js | [`Falloff::three_js`], and `with_range(distance)` unless it is 0 |
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Falloff {
    /// Finite, not negative, like the rest; not all of these four zero.
    pub constant: f32,
    /// Times the distance.
    pub linear: f32,
    /// Times the square of the distance.
    pub quadratic: f32,
    /// The power of the distance that is added if it is above 0.
    pub exponent: f32,
    /// The least that the intensity is divided by.
    pub least: f32,
    /// Whether the window that ends the light at its range is squared.
    pub squared_window: bool,
}

impl Falloff {
    /// The inverse square of the distance.
    pub const PHYSICAL: Self = Self::classic(0.0, 0.0, 1.0);

    /// None: a light that the host divides by nothing.
    pub const NONE: Self = Self::classic(1.0, 0.0, 0.0);

    /// Classic OpenGL's: constant, linear and quadratic attenuation.
    pub const fn classic(constant: f32, linear: f32, quadratic: f32) -> Self {
        Self { constant, linear, quadratic, exponent: 0.0, least: 0.0, squared_window: false }
    }

    /// The crate three-d's `Attenuation`: as [`Self::classic`], and never brighter than the intensity.
    pub const fn three_d(constant: f32, linear: f32, quadratic: f32) -> Self {
        Self { least: 1.0, ..Self::classic(constant, linear, quadratic) }
    }

    /// three.js's `decay`: that power of the distance, from 0.01 on. Its `distance` is the light's range.
    pub fn three_js(decay: f32) -> Self {
        let power = match decay {
            0.0 => Self::NONE,
            1.0 => Self::classic(0.0, 1.0, 0.0),
            2.0 => Self::PHYSICAL,
            _ => Self { exponent: decay, ..Self::classic(0.0, 0.0, 0.0) },
        };
        Self { least: 0.01, squared_window: true, ..power }
    }

    /// Whether constant, linear and quadratic are all there is to it.
    pub(crate) fn is_classic(&self) -> bool {
        self.exponent == 0.0 && self.least == 0.0
    }

    /// Whether the numbers make sense.
    pub(super) fn is_sane(&self) -> bool {
        let divisors = [self.constant, self.linear, self.quadratic, self.exponent];
        let sane = |x: &f32| x.is_finite() && *x >= 0.0;
        divisors.iter().all(sane) && sane(&self.least) && divisors != [0.0; 4]
    }
}

impl Default for Falloff {
    fn default() -> Self {
        Self::PHYSICAL
    }
}
