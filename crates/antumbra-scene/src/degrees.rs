//! Angles as scene files write them.

/// The angle in degrees with the fewest digits that a reader turns into exactly `radians`.
///
/// Radians that no number of degrees gives become the nearest that one does; it is the same for those.
pub(crate) fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    shortest(radians).or_else(|| shortest(near.to_radians())).unwrap_or(near)
}

/// The shortest decimal whose conversion gives `radians` to the bit.
fn shortest(radians: f64) -> Option<f64> {
    // The two conversions round once each, so every number that gives these radians is within a few
    // steps of where they lead back to.
    const STEPS: usize = 4;
    let gives = |degrees: &f64| degrees.to_radians().to_bits() == radians.to_bits();
    let near = radians.to_degrees();
    let below = core::iter::successors(Some(near), |d| Some(d.next_down())).take(STEPS + 1);
    let above = core::iter::successors(Some(near.next_up()), |d| Some(d.next_up())).take(STEPS);
    let exact: Vec<f64> = below.chain(above).filter(gives).collect();
    // 17 digits tell any two numbers apart.
    (0..17).find_map(|digits| {
        exact.iter().find_map(|d| format!("{d:.digits$e}").parse::<f64>().ok().filter(gives))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_come_back_as_they_were_written() {
        for written in [0.0, -0.0, 0.01, 15.0, 22.5, 29.0, 35.2, 45.0, 60.1, 89.99, 90.0, 123.456, 179.0] {
            assert_eq!(degrees(f64::to_radians(written)).to_bits(), f64::to_bits(written), "{written}");
        }
        for hundredths in 0..18_000 {
            let written = f64::from(hundredths) / 100.0;
            assert_eq!(degrees(written.to_radians()), written, "{written}");
        }
    }

    #[test]
    fn every_angle_of_a_file_is_exact() {
        let mut random = fastrand::Rng::with_seed(3);
        for i in 0..200_000 {
            let size = if i % 2 == 0 { 180.0 } else { 10f64.powi(random.i32(-320..2)) };
            let written = size * random.f64();
            let radians = written.to_radians();
            let degrees = degrees(radians);
            assert_eq!(degrees.to_radians().to_bits(), radians.to_bits(), "{written:?} became {degrees:?}");
            assert!(
                format!("{degrees:e}").len() <= format!("{written:e}").len(),
                "{degrees:?} of {written:?}"
            );
        }
    }

    #[test]
    fn any_angle_is_near_and_stays() {
        let mut random = fastrand::Rng::with_seed(4);
        for _ in 0..200_000 {
            let radians = core::f64::consts::PI * random.f64();
            let once = degrees(radians);
            assert!((once.to_radians() - radians).abs() <= 4.0 * f64::EPSILON, "{radians:?} is {once:?}");
            assert_eq!(degrees(once.to_radians()), once, "{radians:?} moved on");
        }
        for radians in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX] {
            let d = degrees(radians);
            assert!(!d.is_finite() || d.abs() > 1e300, "{radians} became {d}");
        }
    }
}
