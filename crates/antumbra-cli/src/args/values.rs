//! The values that options take, each checked with an answer that says what to write instead.

/// The longest side of a picture, pixels: what OpenGL drivers allow for a texture, and the reference likewise.
pub(crate) const MAX_SIDE: u32 = 16_384;

/// The most pixels of a picture: 8K (7680x4320) fits, and takes some 8 GB as 4 samples a pixel with OpenGL.
pub(crate) const MAX_PIXELS: u64 = 1 << 25;

/// The most samples a pixel of the ray tracer; beyond it a 24-bit mantissa no longer gains.
const MAX_SAMPLES: u32 = 65_536;

/// The most samples of multisampling that may be asked for; drivers usually have 4 to 16.
const MAX_MSAA: u32 = 64;

/// The most frames to time; a thousand know a median better than a machine keeps still.
const MAX_FRAMES: u32 = 1_000;

/// The most frames of an animation: eight minutes at 20 a second.
pub(crate) const MAX_ANIMATION_FRAMES: u32 = 10_000;

/// Frames a second of an animation. What plays them shows none for less than a hundredth of a second, and the file
/// none for longer than 65535 s.
pub(crate) const FPS: std::ops::RangeInclusive<f64> = 1e-3..=100.0;

/// Width and height of a picture, pixels; each in 1 to [`MAX_SIDE`], together at most [`MAX_PIXELS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
}

impl Size {
    /// A size within the limits.
    ///
    /// # Errors
    /// What is wrong and what to do instead.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, String> {
        if width == 0 || height == 0 {
            return Err(format!("a picture of {width}x{height} has no pixels; give at least 1x1"));
        }
        if width > MAX_SIDE || height > MAX_SIDE {
            return Err(format!("{width}x{height} is too large; a side has at most {MAX_SIDE} pixels"));
        }
        if u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(format!("{width}x{height} is too large; a picture has at most {MAX_PIXELS} pixels"));
        }
        Ok(Self { width, height })
    }

    /// Pixels in all.
    pub(crate) fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

pub(super) fn parse_size(text: &str) -> Result<Size, String> {
    let wrong = || "not a size; write width x height in pixels, such as 960x540".to_owned();
    let digits = |side: &str| -> Result<u32, String> {
        if side.is_empty() || !side.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(wrong());
        }
        // Digits alone, so the only failure left is a number beyond u32, which is too large in any case.
        Ok(side.parse().unwrap_or(u32::MAX))
    };
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let (width, height) = (digits(width)?, digits(height)?);
    if width == u32::MAX || height == u32::MAX {
        return Err(format!("too large; a side has at most {MAX_SIDE} pixels"));
    }
    Size::new(width, height)
}

pub(super) fn parse_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() => Ok(time),
        _ => Err("not a moment; give a finite number of seconds, such as 2.5".to_owned()),
    }
}

pub(super) fn parse_samples(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(samples) if (1..=MAX_SAMPLES).contains(&samples) => Ok(samples),
        _ => Err(format!("not a number of samples; give a whole number from 1 to {MAX_SAMPLES}")),
    }
}

pub(super) fn parse_msaa(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(samples) if samples.is_power_of_two() && samples <= MAX_MSAA => Ok(samples),
        _ => {
            Err("not a number of samples; give 1 (off), 2, 4, 8 or another power of two that the driver has"
                .to_owned())
        }
    }
}

pub(super) fn parse_frames(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(frames) if (1..=MAX_FRAMES).contains(&frames) => Ok(frames),
        _ => Err(format!("not a number of frames; give a whole number from 1 to {MAX_FRAMES}")),
    }
}

pub(super) fn parse_animation_frames(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(frames) if (1..=MAX_ANIMATION_FRAMES).contains(&frames) => Ok(frames),
        _ => Err(format!("not a number of frames; give a whole number from 1 to {MAX_ANIMATION_FRAMES}")),
    }
}

pub(super) fn parse_fps(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(fps) if FPS.contains(&fps) => Ok(fps),
        _ => Err(format!("not a frame rate; give frames a second, from {} to {}", FPS.start(), FPS.end())),
    }
}

pub(super) fn parse_duration(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // As the periods of motions.
        Ok(duration) if (1e-3..=1e9).contains(&duration) => Ok(duration),
        _ => Err("not a duration; give seconds, from 1e-3 to 1e9, such as 2.5".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(parse_size("960x540"), Ok(Size { width: 960, height: 540 }), "the plain case");
        assert_eq!(parse_size("1X1"), Ok(Size { width: 1, height: 1 }), "a capital X, the smallest");
        assert_eq!(parse_size("16384x2048"), Ok(Size { width: 16_384, height: 2_048 }), "the largest");
        for wrong in ["", "x", "10", "10x", "x10", "0x10", "10x0", "-1x10", "1.5x2", "16385x1", "8192x4097"] {
            assert!(parse_size(wrong).is_err(), "{wrong} is no size");
        }
        for wrong in ["99999999999x1", "1x4294967295", "+1x1", "1x1x1", "１x１", "1 x 1"] {
            assert!(parse_size(wrong).is_err(), "{wrong} is no size");
        }
    }

    #[test]
    fn times_are_finite() {
        assert_eq!(parse_time("-2.5"), Ok(-2.5), "time may run backwards");
        for wrong in ["nan", "inf", "-inf", "1e999", "", "1s"] {
            assert!(parse_time(wrong).is_err(), "{wrong} is no moment");
        }
    }

    #[test]
    fn multisampling_is_a_power_of_two() {
        for samples in [1, 2, 4, 8, 16, 32, 64] {
            assert_eq!(parse_msaa(&samples.to_string()), Ok(samples), "{samples} is a power of two");
        }
        for wrong in ["0", "3", "128", "-4", "4.0", ""] {
            assert!(parse_msaa(wrong).is_err(), "{wrong} is none");
        }
    }
}
