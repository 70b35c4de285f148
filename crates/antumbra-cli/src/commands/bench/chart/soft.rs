//! Charts of soft shadows, a panel for each place: time over the number of points that stand for the light, and error
//! over time.

use plotters::prelude::*;

use super::super::figures::{Figure, Shown};
use super::super::report::{Report, Row};
use super::{
    Area, FAINT, GRID, INK, KEY, Outcome, SIZE, Scale, Series, color, font, head, key, mark, marks,
    milliseconds, ticks,
};

/// Draws one of the two.
pub(super) fn draw(figure: &Figure, shown: Shown, report: &Report, root: &Area) -> Outcome {
    let over_time = shown == Shown::ErrorOverTime;
    let title = if over_time { "error over time" } else { "time over points of the light" };
    head(&format!("{}: {title}", figure.title), figure, report, root)?;
    let series = families(figure, shown, report);
    let rows = || series.iter().flat_map(|series| series.points.iter());
    let Some(up) = extent(rows().map(|(y, _)| *y)) else {
        root.draw(&Text::new("nothing was measured", (24, 120), font(18, INK)))?;
        return Ok(root.present()?);
    };
    let across = if over_time {
        extent(rows().flat_map(|(_, row)| [row.plain_ms, row.median_ms]))
    } else {
        extent(rows().filter_map(|(_, row)| Some(f64::from(row.components?))).chain([1.0, 2.0]))
    };
    let across = across.unwrap_or((1.0, 10.0));
    let (_, below) = root.split_vertically(78);
    let (left, right) = below.split_horizontally(SIZE.0 - KEY);
    let columns = figure.places.len().div_ceil(2).max(1);
    for (area, place) in left.split_evenly((2, columns)).iter().zip(&figure.places) {
        let panel = Panel { name: &place.label, scene: &place.scene, over_time, across, up };
        panel.draw(area, &series)?;
    }
    let mut notes = if over_time {
        vec![
            "error: root mean square of",
            "the visibility inside the",
            "penumbra; numbers: points",
            "of the light",
        ]
    } else {
        vec!["whiskers: 95 of 100 frames", "without marks: no points,", "the light as it is"]
    };
    notes.extend(["dashed: the same frame", "without shadows"]);
    key(&right, &series, &notes)?;
    Ok(root.present()?)
}

/// The rows of each technique, whatever the number of points; each with what is up in the chart.
fn families<'a>(figure: &Figure, shown: Shown, report: &'a Report) -> Vec<Series<'a>> {
    let mut all: Vec<Series> = Vec::new();
    for row in report.rows.iter().filter(|row| row.figure == figure.name.text()) {
        let style = match all.iter().position(|series| series.name == row.family) {
            Some(at) => at,
            None => {
                all.push(Series { name: &row.family, style: all.len(), points: Vec::new() });
                all.len() - 1
            }
        };
        let up = if shown == Shown::ErrorOverTime { row.penumbra_rmse } else { Some(row.median_ms) };
        // What no logarithm has, has no place.
        let Some(up) = up.filter(|up| has_log(*up)) else { continue };
        if [row.median_ms, row.p95_ms, row.plain_ms].into_iter().all(has_log) {
            all[style].points.push((up, row));
        }
    }
    all.retain(|series| !series.points.is_empty());
    for series in &mut all {
        series.points.sort_by_key(|(_, row)| row.components);
    }
    all
}

fn has_log(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

/// Smallest and largest; `None` for no values.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(start, |(low, high), value| (low.min(value), high.max(value)));
    (low <= high).then_some((low, high))
}

/// One place.
struct Panel<'a> {
    name: &'a str,
    scene: &'a str,
    over_time: bool,
    /// Smallest and largest of all panels, so that they can be compared.
    across: (f64, f64),
    up: (f64, f64),
}

impl Panel<'_> {
    fn draw(&self, area: &Area, series: &[Series]) -> Outcome {
        let components = || series.iter().flat_map(|s| &s.points).filter_map(|(_, row)| row.components);
        let across = if self.over_time {
            scale(self.across, ticks(self.across.0, self.across.1))
        } else {
            let mut counts: Vec<u32> = components().collect();
            counts.sort_unstable();
            counts.dedup();
            scale(self.across, counts.into_iter().map(|count| f64::from(count).log10()).collect())
        };
        let up = scale(self.up, ticks(self.up.0, self.up.1));
        let (left, right, low, high) = (across.range.start, across.range.end, up.range.start, up.range.end);
        let mut chart = ChartBuilder::on(area)
            .margin(6)
            .caption(self.name, font(16, INK))
            .x_label_area_size(40)
            .y_label_area_size(60)
            .build_cartesian_2d(across, up)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(FAINT)
            .label_style(font(13, INK))
            .axis_desc_style(font(13, FAINT))
            .x_desc(if self.over_time { "milliseconds a frame" } else { "points of the light" })
            .y_desc(if self.over_time { "error" } else { "milliseconds a frame" })
            .x_label_formatter(&|x| milliseconds(10f64.powf(*x)))
            .y_label_formatter(&|y| milliseconds(10f64.powf(*y)))
            .draw()?;
        let here = |series: &Series| -> Vec<(f64, f64)> { self.points(series).map(|(at, _)| at).collect() };
        let plain = series.iter().flat_map(|series| self.points(series)).map(|(_, row)| row.plain_ms);
        let mut plain: Vec<f64> = plain.collect();
        plain.sort_by(f64::total_cmp);
        if let Some(plain) = plain.get(plain.len() / 2).map(|time| time.log10()) {
            let ends =
                if self.over_time { [(plain, low), (plain, high)] } else { [(left, plain), (right, plain)] };
            chart.draw_series(DashedLineSeries::new(ends, 5, 4, FAINT.stroke_width(2)))?;
        }
        for series in series {
            let stroke = color(series.style).stroke_width(2);
            chart.draw_series(LineSeries::new(here(series), stroke))?;
            for (at, row) in self.points(series) {
                match row.components {
                    Some(_) if !self.over_time => marks(&mut chart, series.style, at.0, row)?,
                    None if !self.over_time => {
                        chart.draw_series(LineSeries::new([(left, at.1), (right, at.1)], stroke))?;
                    }
                    _ => mark(&mut chart, series.style, at)?,
                }
            }
            if self.over_time {
                let (first, last) = (self.points(series).next(), self.points(series).last());
                for (at, row) in first.into_iter().chain(last) {
                    let Some(count) = row.components else { continue };
                    let label = Text::new(count.to_string(), (7, -15), font(13, color(series.style)));
                    chart.draw_series([EmptyElement::at(at) + label])?;
                }
            }
        }
        Ok(())
    }

    /// This place's points of a series on logarithmic axes; where there is no number of points, at the left.
    fn points<'a>(&self, series: &'a Series) -> impl Iterator<Item = ((f64, f64), &'a Row)> {
        let (over_time, first) = (self.over_time, self.across.0);
        let here = series.points.iter().filter(move |(_, row)| row.scene == self.scene);
        here.map(move |(up, row)| {
            let across = if over_time { row.median_ms } else { row.components.map_or(first, f64::from) };
            ((across.log10(), up.log10()), *row)
        })
    }
}

/// A logarithmic axis with some room at its ends.
fn scale((low, high): (f64, f64), labels: Vec<f64>) -> Scale {
    let (low, high) = (low.log10(), high.log10());
    let margin = 0.08 * (high - low).max(0.5);
    Scale::new(low - margin..high + margin, labels)
}

#[cfg(test)]
mod tests {
    use super::super::svg;
    use super::super::tests::report;
    use super::*;
    use crate::args::FigureName;
    use crate::args::Size;

    fn soft(value: impl Fn(usize) -> f64) -> [String; 2] {
        let figure = FigureName::Soft.figure(Size { width: 64, height: 64 });
        let names: Vec<String> = figure.techniques.iter().map(ToString::to_string).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut report = report(&figure, &names, |_, t| [1.0, value(t), value(t) * 1.1]);
        for (i, row) in report.rows.iter_mut().enumerate() {
            let technique = figure.techniques[i % names.len()];
            (row.components, row.family) = (technique.components(), technique.family());
            row.penumbra_rmse = Some(0.1 / value(i % names.len()));
        }
        [Shown::TimeOverComponents, Shown::ErrorOverTime]
            .map(|shown| svg(&figure, shown, &report).expect("it is drawn"))
    }

    #[test]
    fn each_place_has_a_panel_and_each_family_a_key() {
        for svg in soft(|t| 2.0 + t as f64) {
            for label in ["circle", "triangle", "sphere", "cone", "milliseconds a frame"] {
                assert!(svg.contains(&format!("\n{label}\n")), "{label} is written");
            }
            for family in ["analytic", "map:filter=pcss", "composite", "analytic+samples:N"] {
                assert_eq!(svg.matches(&format!("\n{family}\n")).count(), 1, "{family} is one thing");
            }
            assert!(svg.matches("\n64\n").count() >= 4, "64 points, in each panel");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "every place is a number");
        }
    }

    #[test]
    fn any_numbers_make_a_chart() {
        let odd = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-300, 1e300, 1.0, 1.0];
        for svg in (0..odd.len()).flat_map(|shift| soft(|t| odd[(t + shift) % odd.len()])) {
            assert!(svg.contains("</svg>") && !svg.contains("NaN"), "{svg}");
        }
        for value in [f64::NAN, 1.0] {
            let [time, error] = soft(|_| value);
            for svg in [time, error] {
                assert_eq!(svg.contains("nothing was measured"), value.is_nan(), "said where it is so");
            }
        }
    }
}
