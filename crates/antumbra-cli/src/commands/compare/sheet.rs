//! The contact sheet: every picture with its error below, labelled.

use std::io::{self, Write};

use super::canvas::{Canvas, Tile, Zoom};
use super::measure::Comparison;
use super::report::{Report, Row};
use super::{Subject, digits, error_map};
use crate::output::png::{encode_srgb, write_rgb8};

const PAPER: [u8; 3] = [24, 25, 28];
const INK: [u8; 3] = [236, 236, 240];
const FAINT: [u8; 3] = [160, 162, 170];

/// Pixels a tile is wide: enough for its caption, and no wider than three beside each other fill a screen.
const TILE: (usize, usize) = (340, 480);
const GAP: usize = 24;
const TITLE: f32 = 30.0;
const NAME: f32 = 24.0;
const SMALL: f32 = 17.0;
/// What a cell has above its pictures: name and two lines of numbers.
const CAPTION: usize = 76;
/// What the sheet has above its cells.
const HEAD: usize = 84;

struct Cell {
    name: String,
    lines: [String; 2],
    picture: Tile,
    error: Option<Tile>,
}

/// Writes the sheet as PNG.
pub(super) fn write(
    subject: &Subject,
    comparison: &Comparison,
    report: &Report,
    to: &mut impl Write,
) -> io::Result<()> {
    let cells = cells(subject, comparison, report);
    let (tile_width, tile_height) =
        cells.first().map_or((1, 1), |cell| (cell.picture.width, cell.picture.height));
    let cell_width = tile_width.max(TILE.0);
    // As wide as a screen rather than tall.
    let columns = match cells.len() {
        4 => 2,
        n => n.clamp(1, 3),
    };
    let rows = cells.len().div_ceil(columns);
    let cell_height = CAPTION + 2 * tile_height + GAP / 2;
    let width = GAP + columns * (cell_width + GAP);
    let height = HEAD + rows * (cell_height + GAP);
    let mut canvas = Canvas::new(width, height, PAPER);
    let room = width - 2 * GAP;
    canvas.text(&super::title(&report.scene), (GAP, 14), room, TITLE, INK);
    let below = format!(
        "{}x{}, time {} s, on {}; below each picture the error of its visibility, black = none",
        report.width, report.height, report.time, report.driver.renderer
    );
    canvas.text(&below, (GAP, 50), room, SMALL, FAINT);
    for (i, cell) in cells.iter().enumerate() {
        let left = GAP + i % columns * (cell_width + GAP);
        let top = HEAD + i / columns * (cell_height + GAP);
        canvas.text(&cell.name, (left, top), cell_width, NAME, INK);
        for (n, line) in cell.lines.iter().enumerate() {
            canvas.text(line, (left, top + 29 + n * 21), cell_width, SMALL, FAINT);
        }
        canvas.put(&cell.picture, (left, top + CAPTION));
        let below = top + CAPTION + tile_height + GAP / 2;
        match &cell.error {
            Some(error) => canvas.put(error, (left, below)),
            None => legend(&mut canvas, (left, below), tile_width),
        }
    }
    write_rgb8(canvas.width, canvas.height, &canvas.bytes, to)
}

fn cells(subject: &Subject, comparison: &Comparison, report: &Report) -> Vec<Cell> {
    let (width, height) = (subject.size.width as usize, subject.size.height as usize);
    let zoom = Zoom::new(width, TILE.0, TILE.1);
    #[expect(clippy::cast_possible_truncation, reason = "pictures are 32-bit")]
    let exposure = subject.scene.image.exposure as f32;
    let picture = |pixels: &[[f32; 3]]| {
        zoom.tile(pixels, width, height, |pixel| pixel.map(|level| encode_srgb(level * exposure)))
    };
    let traced = &report.reference;
    let mut cells = vec![Cell {
        name: "raytraced: the reference".to_owned(),
        lines: [
            format!("{} rays a pixel, on the CPU", traced.samples),
            format!("{} ms a frame with one ray a pixel", digits(traced.timing.median_ms, 1)),
        ],
        picture: picture(&comparison.truth),
        error: None,
    }];
    for (entry, row) in comparison.entries.iter().zip(&report.techniques) {
        let errors: Vec<[f32; 1]> = entry.errors.iter().map(|error| [*error]).collect();
        cells.push(Cell {
            name: row.technique.clone(),
            lines: numbers(row),
            picture: picture(&entry.pixels),
            error: Some(zoom.tile(&errors, width, height, |[error]| error_map::color(error))),
        });
    }
    cells
}

fn numbers(row: &Row) -> [String; 2] {
    let edge = row.edge_rms.map_or_else(|| "–".to_owned(), |rms| digits(rms, 3));
    [
        format!(
            "{} / {} px wrong beyond 1 / 2 px, edge RMS {edge}",
            row.misclassified_1px, row.misclassified_2px
        ),
        format!(
            "FLIP {}, RMSE {}; {} ms, {} without shadows",
            digits(row.flip, 4),
            digits(row.rmse, 4),
            digits(row.timing.median_ms, 2),
            digits(row.timing.plain_ms, 2)
        ),
    ]
}

/// What the colours of the errors mean.
fn legend(canvas: &mut Canvas, (left, top): (usize, usize), width: usize) {
    const HEIGHT: usize = 22;
    for x in 0..width {
        let error = x as f32 / (width - 1).max(1) as f32;
        (0..HEIGHT).for_each(|y| canvas.set(left + x, top + 4 + y, error_map::color(error)));
    }
    let below = top + HEIGHT + 8;
    canvas.text("0", (left, below), width, SMALL, FAINT);
    canvas.text("0.5", ((left + width / 2).saturating_sub(10), below), width, SMALL, FAINT);
    canvas.text("1", ((left + width).saturating_sub(8), below), 20, SMALL, FAINT);
    canvas.text(
        "largest error of any light's visibility",
        (left, below + 24),
        width.max(TILE.0),
        SMALL,
        FAINT,
    );
}
