//! Errors as colours: black is right, then purple and orange to pale yellow, which is as wrong as can be.

use colorous::INFERNO;

/// The colour of an error in [0, 1]; not-a-number is as wrong as can be. Lightness grows evenly with the error, so the
/// map reads the same in grey and without red and green.
pub(super) fn color(error: f32) -> [u8; 3] {
    let error = if error.is_nan() { 1.0 } else { f64::from(error).clamp(0.0, 1.0) };
    INFERNO.eval_continuous(error).as_array()
}

/// A picture of errors, three bytes a pixel.
pub(super) fn picture(errors: &[f32]) -> Vec<u8> {
    errors.iter().flat_map(|error| color(*error)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worse_is_lighter() {
        let lightness = |error: f32| color(error).iter().map(|c| u32::from(*c)).sum::<u32>();
        let all: Vec<u32> = (0..=10).map(|tenth| lightness(tenth as f32 / 10.0)).collect();
        assert!(all.is_sorted(), "{all:?}");
        assert!(all[0] < 20 && all[10] > 550, "from black to pale: {all:?}");
        assert_eq!(color(f32::NAN), color(1.0), "what is no number is wrong");
        assert_eq!(color(-1.0), color(0.0), "clamped");
        assert_eq!(picture(&[0.0, 1.0]).len(), 6, "three bytes a pixel");
    }
}
