//! Draws `docs/theory/images/composite-error.svg` from the table that antumbra-math's example
//! `composite_error` prints:
//!
//! ```text
//! cargo run --release -p antumbra-math --example composite_error |
//!     cargo run --release -p antumbra-testkit --example composite_error_chart > docs/theory/images/composite-error.svg
//! ```

use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;
use std::io::{self, Read, Write};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Pixels.
const SIZE: (u32, u32) = (980, 430);
/// The backend rounds to whole numbers: it draws so many times larger, and the picture is scaled back.
const FINE: i32 = 8;
const TITLE: &str = "<title>The error of the composite method over the light's angle</title>\n";
const INK: RGBColor = RGBColor(0x1f, 0x24, 0x30);
const FAINT: RGBColor = RGBColor(0xe3, 0xe6, 0xeb);
/// Apart for eyes that do not tell red from green (Okabe and Ito, 2008), dark enough on white.
const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
const ORANGE: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
const GREEN: RGBColor = RGBColor(0x00, 0x8f, 0x68);

/// One line of the chart: rows of the table, and how it looks.
struct Line {
    /// Shape, form, and distance of the light as the table has them.
    key: [&'static str; 3],
    color: RGBColor,
    dashed: bool,
    name: &'static str,
}

const fn line(key: [&'static str; 3], color: RGBColor, dashed: bool, name: &'static str) -> Line {
    Line { key, color, dashed, name }
}

/// From the one that is farthest off.
const SPHERE: [Line; 5] = [
    line(["sphere", "circle", "4"], ORANGE, true, "plain circle, light at 4 r"),
    line(["sphere", "tangent", "4"], ORANGE, false, "tangent circle, light at 4 r"),
    line(["sphere", "circle", "16"], BLUE, true, "plain circle, light at 16 r"),
    line(["sphere", "tangent", "16"], BLUE, false, "tangent circle, light at 16 r"),
    line(["sphere", "tangent", "inf"], GREEN, false, "either, directional light"),
];

const CONE: [Line; 6] = [
    line(["cone-height-1", "disc-and-triangle", "4"], ORANGE, true, "height r, light at 4 r"),
    line(["cone-height-2", "disc-and-triangle", "4"], ORANGE, false, "height 2 r, light at 4 r"),
    line(["cone-height-1", "disc-and-triangle", "16"], BLUE, true, "height r, light at 16 r"),
    line(["cone-height-2", "disc-and-triangle", "16"], BLUE, false, "height 2 r, light at 16 r"),
    line(["cone-height-1", "disc-and-triangle", "inf"], GREEN, true, "height r, directional light"),
    line(["cone-height-2", "disc-and-triangle", "inf"], GREEN, false, "height 2 r, directional light"),
];

/// Angle and error of the rows of a line.
fn points(table: &str, key: [&str; 3]) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let mut points = Vec::new();
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        if cells.len() == 5 && cells[..3] == key {
            points.push((cells[3].parse()?, 100.0 * cells[4].parse::<f64>()?));
        }
    }
    if points.is_empty() { Err(format!("the table has no rows of {key:?}").into()) } else { Ok(points) }
}

fn panel(
    area: &Area<'_>,
    table: &str,
    title: &str,
    most: f64,
    lines: &[Line],
    at: SeriesLabelPosition,
) -> Result<(), Box<dyn Error>> {
    let font = |size: i32| ("DejaVu Sans, Verdana, sans-serif", size * FINE).into_font().color(&INK);
    let mut chart = ChartBuilder::on(area)
        .caption(title, font(17))
        .margin(12 * FINE)
        .margin_right(22 * FINE)
        .x_label_area_size(46 * FINE)
        .y_label_area_size(58 * FINE)
        .build_cartesian_2d(0.0..90.0, 0.0..most)?;
    chart
        .configure_mesh()
        .x_labels(10)
        .y_labels(7)
        .max_light_lines(0)
        .bold_line_style(FAINT.stroke_width(FINE as u32))
        .axis_style(INK.stroke_width(FINE as u32))
        .set_all_tick_mark_size(5 * FINE)
        .label_style(font(13))
        .x_label_formatter(&|x| format!("{x:.0}°"))
        .y_label_formatter(&|y| format!("{y:.0} %"))
        .x_desc("angle of the light from the plane's normal")
        .y_desc("wrong area / exact area")
        .draw()?;
    for line in lines {
        let (points, style) = (points(table, line.key)?, line.color.stroke_width(2 * FINE as u32));
        let label = if line.dashed {
            chart.draw_series(DashedLineSeries::new(points, 6 * FINE as u32, 4 * FINE as u32, style))?
        } else {
            chart.draw_series(LineSeries::new(points, style))?
        };
        let dashed = line.dashed;
        label.label(line.name).legend(move |(x, y)| {
            // A dashed line is too short here to tell: two pieces.
            let length = if dashed { 9 * FINE } else { 11 * FINE };
            let pieces = [(x, x + length), (x + 22 * FINE - length, x + 22 * FINE)];
            EmptyElement::at((0, 0))
                + PathElement::new(vec![(pieces[0].0, y), (pieces[0].1, y)], style)
                + PathElement::new(vec![(pieces[1].0, y), (pieces[1].1, y)], style)
        });
    }
    chart
        .configure_series_labels()
        .position(at)
        .legend_area_size(32 * FINE)
        .margin(8 * FINE)
        .background_style(WHITE.mix(0.92))
        .border_style(FAINT.stroke_width(FINE as u32))
        .label_font(font(13))
        .draw()?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut table = String::new();
    io::stdin().read_to_string(&mut table)?;
    let (width, height) = SIZE;
    let mut svg = String::new();
    {
        let fine = (width * FINE as u32, height * FINE as u32);
        let root = SVGBackend::with_string(&mut svg, fine).into_drawing_area();
        root.fill(&WHITE)?;
        let (left, right) = root.split_horizontally(fine.0 / 2);
        panel(&left, &table, "Sphere", 100.0, &SPHERE, SeriesLabelPosition::UpperLeft)?;
        panel(&right, &table, "Cone", 6.0, &CONE, SeriesLabelPosition::UpperLeft)?;
        root.present()?;
    }
    let drawn = format!("width=\"{}\" height=\"{}\"", width * FINE as u32, height * FINE as u32);
    let svg = svg.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1);
    let head = svg.find("<rect").ok_or("the backend has filled a background")?;
    let (head, body) = svg.split_at(head);
    io::stdout().write_all([head, TITLE, body].concat().as_bytes())?;
    Ok(())
}
