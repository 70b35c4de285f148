//! Charts as SVG: milliseconds a frame, on logarithmic axes.

mod soft;

use std::collections::BTreeMap;
use std::io;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::figures::{Axis, Figure, Shown};
use super::report::{Report, Row};

const SIZE: (u32, u32) = (960, 560);
/// Pixels at the right for what the marks mean.
const KEY: u32 = 230;

/// Colours that those who do not see red or green tell apart (Okabe and Ito, "Color Universal Design", 2008).
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
const INK: RGBColor = RGBColor(40, 42, 48);
const FAINT: RGBColor = RGBColor(110, 113, 122);
const GRID: RGBColor = RGBColor(226, 227, 231);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axes = Cartesian2d<Scale, Scale>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Axes>;
type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A linear axis, with labels where they are wanted; logarithms are taken before.
struct Scale {
    range: Range<f64>,
    labels: Vec<f64>,
}

impl Scale {
    fn new(range: Range<f64>, labels: impl IntoIterator<Item = f64>) -> Self {
        let labels = labels.into_iter().filter(|at| range.contains(at)).collect();
        Self { range, labels }
    }
}

impl Ranged for Scale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "a place on the chart")]
    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.range.start) / (self.range.end - self.range.start);
        from + (f64::from(to - from) * part).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.labels.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// The rows of one technique, each with its place on the axis.
struct Series<'a> {
    name: &'a str,
    style: usize,
    points: Vec<(f64, &'a Row)>,
}

/// The chart of a figure.
///
/// # Errors
/// What the drawing library says.
pub(super) fn svg(figure: &Figure, shown: Shown, report: &Report) -> io::Result<String> {
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
    let drawn = match shown {
        Shown::TimeOverAxis => draw(figure, report, &root),
        Shown::TimeOverComponents | Shown::ErrorOverTime => soft::draw(figure, shown, report, &root),
    };
    drop(root);
    drawn.map_err(|error| io::Error::other(error.to_string()))?;
    Ok(text)
}

fn draw(figure: &Figure, report: &Report, root: &Area) -> Outcome {
    let series = series(figure, report);
    head(figure.title, figure, report, root)?;
    let (_, below) = root.split_vertically(78);
    let (left, right) = below.split_horizontally(SIZE.0 - KEY);

    let rows = || series.iter().flat_map(|series| series.points.iter().map(|(_, row)| *row));
    let (low, high) = rows()
        .flat_map(|row| [row.plain_ms, row.median_ms, row.p95_ms])
        .filter(|time| time.is_finite() && *time > 0.0)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), time| (low.min(time), high.max(time)));
    if low > high {
        root.draw(&Text::new("nothing was measured", (24, 120), font(18, INK)))?;
        return Ok(root.present()?);
    }
    let ticks = ticks(low, high);
    let (low, high) = (low.log10() - 0.08, high.log10() + 0.08);
    let at: Vec<f64> = figure.places.iter().map(|place| place_on(figure.axis, place.at)).collect();
    let (first, last) = (at.first().copied().unwrap_or(0.0), at.last().copied().unwrap_or(1.0));
    let margin = match figure.axis {
        Axis::Kinds => 0.5,
        Axis::Number(_) => 0.04 * (last - first),
    };
    let across = Scale::new(first - margin..last + margin, at);
    let mut chart = ChartBuilder::on(&left)
        .margin_left(12)
        .margin_right(8)
        .x_label_area_size(58)
        .y_label_area_size(66)
        .build_cartesian_2d(across, Scale::new(low..high, ticks))?;
    let label = |x: &f64| {
        let nearest = figure.places.iter().find(|place| (place_on(figure.axis, place.at) - x).abs() < 1e-9);
        nearest.map_or_else(String::new, |place| place.label.clone())
    };
    let mut mesh = chart.configure_mesh();
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(FAINT)
        .label_style(font(15, INK))
        .axis_desc_style(font(15, FAINT))
        .y_desc("milliseconds a frame")
        .x_label_formatter(&label)
        .y_label_formatter(&|y| milliseconds(10f64.powf(*y)));
    if let Axis::Number(what) = figure.axis {
        mesh.x_desc(what);
    } else {
        mesh.disable_x_mesh();
    }
    mesh.draw()?;
    match figure.axis {
        Axis::Kinds => dots(&mut chart, &series)?,
        Axis::Number(_) => lines(&mut chart, &series)?,
    }
    let notes: &[&str] = match figure.axis {
        Axis::Kinds => &["stems begin at the same", "frame without shadows;", "whiskers: 95 of 100 frames"],
        Axis::Number(_) => &["whiskers: 95 of 100 frames", "dashed: the same frame", "without shadows"],
    };
    key(&right, &series, notes)?;
    Ok(root.present()?)
}

/// What a chart is of.
fn head(title: &str, figure: &Figure, report: &Report, root: &Area) -> Outcome {
    root.fill(&WHITE)?;
    root.draw(&Text::new(title.to_owned(), (24, 18), font(24, INK)))?;
    root.draw(&Text::new(subtitle(figure, report), (24, 50), font(15, FAINT)))?;
    Ok(())
}

/// A line for each technique, from median to median, each with a whisker to its 95th percentile; the frames without
/// shadows dashed.
fn lines(chart: &mut Chart, series: &[Series]) -> Outcome {
    let mut plain: BTreeMap<u64, (f64, Vec<f64>)> = BTreeMap::new();
    for series in series {
        for (x, row) in &series.points {
            if row.plain_ms > 0.0 && series.name != "raytraced" {
                plain.entry(x.to_bits()).or_insert((*x, Vec::new())).1.push(row.plain_ms);
            }
        }
    }
    let plain = plain.into_values().map(|(x, mut times)| {
        times.sort_by(f64::total_cmp);
        (x, times[times.len() / 2].log10())
    });
    let mut plain: Vec<(f64, f64)> = plain.collect();
    plain.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart.draw_series(DashedLineSeries::new(plain, 5, 4, FAINT.stroke_width(2)))?;
    for series in series {
        let color = color(series.style);
        let line = series.points.iter().map(|(x, row)| (*x, row.median_ms.log10()));
        chart.draw_series(LineSeries::new(line, color.stroke_width(2)))?;
        for (x, row) in &series.points {
            marks(chart, series.style, *x, row)?;
        }
    }
    Ok(())
}

/// A mark for each technique and kind, on a stem that begins at the frame without shadows: the stem's length is the
/// factor that shadows cost.
fn dots(chart: &mut Chart, series: &[Series]) -> Outcome {
    let count = series.len() as f64;
    for (i, series) in series.iter().enumerate() {
        let offset = 0.76 * ((i as f64 + 0.5) / count - 0.5);
        for (x, row) in &series.points {
            let stem = [row.plain_ms, row.median_ms].map(|time| (x + offset, time.log10()));
            chart.draw_series(LineSeries::new(stem, color(series.style).mix(0.4).stroke_width(4)))?;
            marks(chart, series.style, x + offset, row)?;
        }
    }
    Ok(())
}

/// The mark of a median, with a whisker to the 95th percentile.
fn marks(chart: &mut Chart, style: usize, x: f64, row: &Row) -> Outcome {
    let whisker = [(x, row.median_ms.log10()), (x, row.p95_ms.log10())];
    chart.draw_series(LineSeries::new(whisker, color(style).stroke_width(1)))?;
    mark(chart, style, (x, row.median_ms.log10()))
}

fn mark(chart: &mut Chart, style: usize, at: (f64, f64)) -> Outcome {
    let filled = color(style).filled();
    match style % 3 {
        0 => chart.draw_series([Circle::new(at, 5, filled)])?,
        1 => chart.draw_series([TriangleMarker::new(at, 6, filled)])?,
        _ => {
            let square = EmptyElement::at(at) + Rectangle::new([(-4, -4), (4, 4)], filled);
            chart.draw_series([square])?
        }
    };
    Ok(())
}

/// What the marks mean, the slowest technique first, as the lines end.
fn key(area: &Area, series: &[Series], notes: &[&str]) -> Outcome {
    let end = |series: &Series| series.points.last().map_or(0.0, |(_, row)| row.median_ms);
    let mut order: Vec<&Series> = series.iter().collect();
    order.sort_by(|a, b| end(b).total_cmp(&end(a)));
    let mut y = 24;
    for series in order {
        let at = (22, y);
        let filled = color(series.style).filled();
        match series.style % 3 {
            0 => area.draw(&Circle::new(at, 5, filled))?,
            1 => area.draw(&TriangleMarker::new(at, 6, filled))?,
            _ => area.draw(&Rectangle::new([(at.0 - 4, at.1 - 4), (at.0 + 4, at.1 + 4)], filled))?,
        }
        area.draw(&Text::new(shortened(series.name, 24), (38, y), middle(15, INK)))?;
        y += 26;
    }
    y += 8;
    for note in notes {
        area.draw(&Text::new(*note, (14, y), middle(13, FAINT)))?;
        y += 19;
    }
    Ok(())
}

fn series<'a>(figure: &Figure, report: &'a Report) -> Vec<Series<'a>> {
    // A technique has one style in all figures of a report.
    let mut names: Vec<&str> = Vec::new();
    for row in &report.rows {
        if !names.contains(&row.technique.as_str()) {
            names.push(&row.technique);
        }
    }
    let mut all: Vec<Series> = Vec::new();
    for row in report.rows.iter().filter(|row| row.figure == figure.name.text()) {
        let Some(place) = figure.places.iter().find(|place| place.scene == row.scene) else { continue };
        // What no logarithm has, such as a frame of no time at all, has no place.
        if !(row.median_ms > 0.0 && row.p95_ms > 0.0 && row.plain_ms > 0.0) {
            continue;
        }
        let point = (place_on(figure.axis, place.at), row);
        match all.iter_mut().find(|series| series.name == row.technique) {
            Some(series) => series.points.push(point),
            None => {
                let style = names.iter().position(|name| *name == row.technique).unwrap_or(0);
                all.push(Series { name: &row.technique, style, points: vec![point] });
            }
        }
    }
    all
}

fn subtitle(figure: &Figure, report: &Report) -> String {
    let rows: Vec<&Row> = report.rows.iter().filter(|row| row.figure == figure.name.text()).collect();
    let on = report.driver.as_ref().map_or("the CPU", |driver| driver.renderer.as_str());
    let size = match (rows.first(), figure.name) {
        (Some(row), name) if name != super::FigureName::Resolution => {
            format!("{}x{}, ", row.width, row.height)
        }
        _ => String::new(),
    };
    let frames = rows.iter().map(|row| row.frames).max().unwrap_or(0);
    let gl = rows.iter().find(|row| row.technique != "raytraced").or(rows.first());
    let timer = gl.map_or("", |row| row.timer);
    let traced =
        if rows.iter().any(|row| row.technique == "raytraced") { "; raytraced on the CPU" } else { "" };
    shortened(&format!("{size}medians of {frames} frames, {timer}, {on}{traced}"), 130)
}

/// Where a place is on a figure's axis.
fn place_on(axis: Axis, at: f64) -> f64 {
    match axis {
        Axis::Kinds => at,
        Axis::Number(_) => at.max(1e-9).log10(),
    }
}

/// Logarithms of round numbers of milliseconds between two: 1, 2, 5, 10, or where there are many, 1, 10, 100.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let wide = (high / low).log10() > 2.5;
    let factors: &[f64] = if wide { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let exponents = -6..=9;
    exponents.flat_map(|e| factors.iter().map(move |f| (f * 10f64.powi(e)).log10())).collect()
}

/// A round number of milliseconds.
fn milliseconds(time: f64) -> String {
    let digits = if time < 0.995 { (-time.log10()).ceil().clamp(0.0, 9.0) as usize } else { 0 };
    format!("{time:.digits$}")
}

fn color(style: usize) -> RGBColor {
    PALETTE[style % PALETTE.len()]
}

fn font(size: i32, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&color)
}

/// Text that stands half above and half below its place.
fn middle(size: i32, color: RGBColor) -> TextStyle<'static> {
    font(size, color).pos(Pos::new(HPos::Left, VPos::Center))
}

fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most.saturating_sub(3)).chain("...".chars()).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::args::FigureName;
    use crate::args::Size;

    pub(super) fn report(
        figure: &Figure,
        techniques: &[&str],
        time: impl Fn(usize, usize) -> [f64; 3],
    ) -> Report {
        let mut report = Report::new(None);
        for (p, place) in figure.places.iter().enumerate() {
            for (t, technique) in techniques.iter().enumerate() {
                let [plain_ms, median_ms, p95_ms] = time(p, t);
                report.rows.push(Row {
                    figure: figure.name.text(),
                    technique: (*technique).to_owned(),
                    soft: None,
                    components: None,
                    family: (*technique).to_owned(),
                    scene: place.scene.clone(),
                    lights: 1,
                    occluders: 1,
                    width: 64,
                    height: 64,
                    median_ms,
                    p95_ms,
                    plain_ms,
                    timer: "clock",
                    frames: 3,
                    penumbra_rmse: None,
                });
            }
        }
        report
    }

    #[test]
    fn a_chart_has_every_technique_and_place() {
        let names = [
            "analytic",
            "composite",
            "map:size=2048:filter=pcf",
            "projected",
            "volume",
            "<odd> & long",
            "raytraced",
            "h",
        ];
        for name in
            [FigureName::Primitives, FigureName::Lights, FigureName::Occluders, FigureName::Resolution]
        {
            let figure = name.figure(Size { width: 64, height: 64 });
            let report = report(&figure, &names, |p, t| {
                let plain = 2.0 + p as f64;
                [plain, plain * (1.2 + t as f64 * 0.6), plain * (1.4 + t as f64 * 0.7)]
            });
            let svg = svg(&figure, Shown::TimeOverAxis, &report).expect("it is drawn");
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "an SVG");
            for label in figure.places.iter().map(|place| place.label.as_str()).chain([
                "map:size=2048:filter=pcf",
                "&lt;odd&gt; &amp; long",
                figure.title,
            ]) {
                assert!(svg.contains(label), "{name:?}: {label} is written");
            }
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "every place is a number");
            if let Some(directory) = std::env::var_os("ANTUMBRA_CHARTS") {
                let path = std::path::Path::new(&directory).join(format!("{}.svg", name.text()));
                std::fs::write(path, svg).expect("the directory is writable");
            }
        }
    }

    #[test]
    fn any_times_make_a_chart() {
        let figure = FigureName::Lights.figure(Size { width: 64, height: 64 });
        let odd = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-300, 1e300, 1.0, 1.0];
        for shift in 0..odd.len() {
            let report =
                report(&figure, &["a", "b"], |p, t| [0, 1, 2].map(|i| odd[(p + t + i * shift) % odd.len()]));
            let svg = svg(&figure, Shown::TimeOverAxis, &report).expect("it is drawn");
            assert!(svg.contains("</svg>") && !svg.contains("NaN"), "{svg}");
        }
        assert!(
            svg(&figure, Shown::TimeOverAxis, &Report::new(None))
                .expect("it is drawn")
                .contains("nothing was measured"),
            "said"
        );
    }

    #[test]
    fn labels_of_milliseconds_are_short() {
        for (time, label) in
            [(0.01, "0.01"), (0.1, "0.1"), (0.5, "0.5"), (1.0, "1"), (20.0, "20"), (1e3, "1000")]
        {
            assert_eq!(milliseconds(time), label, "{time} ms");
        }
        let logs = ticks(3.0, 80.0);
        assert!(logs.contains(&1.0) && logs.contains(&50f64.log10()), "10 and 50: {logs:?}");
        assert!(!ticks(1.0, 1e4).contains(&5f64.log10()), "powers of ten alone, for four of them");
    }
}
