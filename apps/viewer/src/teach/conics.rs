//! The numbers of shadows: which curve, where, how large.

use antumbra::math::plane_shadow::{Axes, Conic};
use antumbra::math::soft::PenumbraOutline;
use antumbra::math::{PlaneFrame, PlaneShadow, ShadowKind};
use glam::DVec3;

use super::{Casting, Fact, Situation};

impl Situation<'_> {
    /// The numbers of the shadow of a primitive from a light, a fact for each planar receiver that it falls on, and for
    /// each of umbra, penumbra and antumbra.
    ///
    /// For every shape of the library under a light without area, and for balls under sphere lights; nothing for the
    /// others. Of the whole plane the receiver lies in: a rectangle may have a part of it. The coordinates x and y are
    /// metres along two axes in the receiver, which the fact names.
    pub(crate) fn facts(&self, light: usize, primitive: usize) -> Vec<Fact> {
        let Some(pair) = self.pair(light, primitive) else { return Vec::new() };
        let Casting::Shape(shape) = pair.casting else { return Vec::new() };
        let mut facts = Vec::new();
        for receiver in self.receivers_of(primitive) {
            let mut tell = |what: &str, shadow: &PlaneShadow, more: &[(String, String)]| {
                if shadow.kind() == ShadowKind::Nothing {
                    return;
                }
                let title = format!(
                    "{what} of {} from {} on {}",
                    self.name(primitive),
                    self.light_name(light),
                    self.name(receiver.primitive)
                );
                let mut lines = describe(shadow, &receiver.frame);
                lines.extend_from_slice(more);
                facts.push(Fact { title, lines });
            };
            if pair.is_hard() {
                let shadow = PlaneShadow::cast(&shape, &pair.light.place, &receiver.frame);
                tell("Shadow", &shadow, &[]);
            } else if let Some(outline) =
                pair.balls().and_then(|(light, ball)| PenumbraOutline::new(&light, &ball, &receiver.frame))
            {
                let apex = |at: DVec3| vec![("apex of the cone".to_string(), place(at))];
                let outer = outline.outer_apex().map_or(Vec::new(), apex);
                tell("Penumbra's outer edge", outline.penumbra(), &apex(outline.inner_apex()));
                tell("Umbra", outline.umbra(), &outer);
                tell("Antumbra", outline.antumbra(), &outer);
            }
        }
        facts
    }
}

fn describe(shadow: &PlaneShadow, frame: &PlaneFrame) -> Vec<(String, String)> {
    let mut lines = Vec::new();
    let mut line = |label: &str, value: String| lines.push((label.to_string(), value));
    let axes = shadow.axes();
    let circle = axes.is_some_and(|axes| is_circle(&axes)) && shadow.kind() == ShadowKind::Ellipse;
    let shape = match shadow.kind() {
        ShadowKind::Nothing => "nothing",
        ShadowKind::Segment => "a line: the occluder is seen edge-on",
        ShadowKind::Ellipse if circle => "circle",
        ShadowKind::Ellipse => "ellipse",
        ShadowKind::Parabola => "parabola: the occluder just reaches the light's height",
        ShadowKind::Hyperbola => "one branch of a hyperbola: the occluder reaches above the light",
        ShadowKind::Polygon => "polygon",
        ShadowKind::Hull => "lines and arcs of conics",
        ShadowKind::Everything => "the whole plane",
    };
    line("shape", shape.into());
    if let Some(axes) = axes {
        let (a, b) = (axes.first.length(), axes.second.length());
        line("centre", place(frame.point(axes.center)));
        if circle {
            line("radius", metres(a));
        } else {
            line("semi-axes", format!("{} and {}", metres(a), metres(b)));
            line("long axis along", direction(frame.point(axes.first) - frame.origin));
        }
    }
    if let Some(e) = eccentricity(shadow) {
        line("eccentricity", number(e));
    }
    let area = shadow.area();
    let area = if area.is_finite() { format!("{} m²", number(area)) } else { "infinite".into() };
    line("area", area);
    if let Some(conic) = shadow.conic() {
        line("equation", equation(&conic));
        line("x along", format!("{} from {}", direction(frame.u), place(frame.origin)));
        line("y along", direction(frame.v));
    }
    if shadow.kind() == ShadowKind::Hyperbola {
        for (label, text) in &mut lines {
            if label == "long axis along" {
                *label = "transverse axis along".into();
            } else if label == "semi-axes" {
                *text += " (transverse, conjugate)";
            }
        }
    }
    lines
}

/// Semi-axes equal to a millionth.
fn is_circle(axes: &Axes) -> bool {
    let (a, b) = (axes.first.length(), axes.second.length());
    (a - b).abs() <= 1e-6 * a.max(b)
}

/// Of an ellipse below 1, of a parabola 1, of a hyperbola above; `None` for what is no conic.
fn eccentricity(shadow: &PlaneShadow) -> Option<f64> {
    let ratio = || shadow.axes().map(|axes| axes.second.length() / axes.first.length());
    match shadow.kind() {
        ShadowKind::Ellipse => {
            let ratio = ratio()?;
            Some(((1.0 - ratio) * (1.0 + ratio)).max(0.0).sqrt())
        }
        ShadowKind::Parabola => Some(1.0),
        ShadowKind::Hyperbola => Some(ratio()?.hypot(1.0)),
        _ => None,
    }
}

/// The equation in x and y, its largest coefficient 1.
fn equation(conic: &Conic) -> String {
    let k = &conic.matrix;
    let coefficients = [
        (k.x_axis.x, "x²"),
        (2.0 * k.y_axis.x, "xy"),
        (k.y_axis.y, "y²"),
        (2.0 * k.z_axis.x, "x"),
        (2.0 * k.z_axis.y, "y"),
        (k.z_axis.z, ""),
    ];
    let largest = coefficients.iter().fold(0.0_f64, |most, (value, _)| most.max(value.abs()));
    let mut text = String::new();
    for (value, unknown) in coefficients {
        let value = value / largest;
        if !(value.abs() >= 5e-7) {
            continue;
        }
        let sign = match (text.is_empty(), value < 0.0) {
            (true, true) => "−",
            (true, false) => "",
            (false, true) => " − ",
            (false, false) => " + ",
        };
        let size = number(value.abs());
        let size = if size == "1" && !unknown.is_empty() { "" } else { &size };
        text += sign;
        text += size;
        if !size.is_empty() && !unknown.is_empty() {
            text += " ";
        }
        text += unknown;
    }
    if text.is_empty() { "0 = 0".into() } else { text + " = 0" }
}

/// Four significant digits, without zeros at the end; powers of ten for what is very large or small.
fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { format!("{value}") };
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&magnitude) {
        return format!("{value:.3e}").replace('-', "−");
    }
    let digits = (3.0 - magnitude).max(0.0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

fn metres(value: f64) -> String {
    format!("{} m", number(value))
}

/// A point of the world, to a tenth of a millimetre.
fn place(p: DVec3) -> String {
    triple(p, 4) + " m"
}

/// A direction as a unit vector.
fn direction(d: DVec3) -> String {
    triple(d.normalize_or_zero(), 3)
}

fn triple(v: DVec3, digits: usize) -> String {
    let text = v.to_array().map(|x| {
        let scale = 10f64.powi(digits as i32);
        let rounded = (x * scale).round() / scale;
        // Without a minus before zero.
        number_plain(if rounded == 0.0 { 0.0 } else { rounded }, digits)
    });
    format!("({})", text.join(", "))
}

fn number_plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};

    #[test]
    fn numbers_are_short() {
        let expected = [
            (0.0, "0"),
            (2.0, "2"),
            (1.5, "1.5"),
            (-0.125, "−0.125"),
            (1.0 / 3.0, "0.3333"),
            (123456.7, "123457"),
            (1e9, "1.000e9"),
            (1e-7, "1.000e−7"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in expected {
            assert_eq!(number(value), text);
        }
        assert_eq!(place(DVec3::new(-1e-9, 1.25, 10.0)), "(0, 1.25, 10) m");
    }

    #[test]
    fn equations_read_as_equations() {
        let circle = Conic { matrix: DMat3::from_diagonal(DVec3::new(0.25, 0.25, -1.0)) };
        assert_eq!(equation(&circle), "0.25 x² + 0.25 y² − 1 = 0");
        let mut matrix = DMat3::from_diagonal(DVec3::new(-1.0, 0.0, 0.0));
        matrix.z_axis.y = 0.5;
        assert_eq!(equation(&Conic { matrix }), "−x² + y = 0");
        assert_eq!(equation(&Conic { matrix: DMat3::ZERO }), "0 = 0");
    }
}
