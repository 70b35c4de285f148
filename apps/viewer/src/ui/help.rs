//! The keys and what the mouse does, over the picture.

use std::ops::Range;
use std::sync::Arc;

use egui::{
    Align2, Color32, Context, FontId, Galley, Rect, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo, pos2, vec2,
};

use super::dialog;
use super::style::ACCENT;
use crate::model::Model;
use crate::model::command::{Binding, GROUPS, MOUSE};

/// How high things are, points.
const ROW: f32 = 19.0;
const TITLE: f32 = 24.0;
const BETWEEN_GROUPS: f32 = 8.0;
/// Between columns.
const GAP: f32 = 22.0;
/// Between a key and what it does.
const INDENT: f32 = 9.0;
const CAP_HEIGHT: f32 = 16.0;

/// A part of what is before the words.
#[derive(Clone, Debug, PartialEq)]
enum Piece {
    /// A key.
    Cap(String),
    /// A word.
    Word(String),
}

/// A line: keys and what they do.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    pieces: Vec<Piece>,
    help: String,
}

/// Lines with a title.
struct Group {
    title: &'static str,
    rows: Vec<Row>,
}

impl Group {
    fn height(&self) -> f32 {
        TITLE + ROW * self.rows.len() as f32 + BETWEEN_GROUPS
    }
}

/// All there is to say.
fn groups() -> Vec<Group> {
    let keys = GROUPS.iter().map(|group| Group { title: group.title, rows: rows(group.bindings) });
    let mouse = MOUSE.iter().map(|(how, what)| Row {
        pieces: vec![Piece::Word(how.replace("...", "…"))],
        help: (*what).to_owned(),
    });
    keys.chain([Group { title: "Mouse", rows: mouse.collect() }]).collect()
}

/// The lines of some keys: those that go on with what the one before does share its line, and so do single keys that
/// do the same.
fn rows(bindings: &[Binding]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for binding in bindings {
        let caps = caps(&binding.text());
        if let (Some(to), Some(row)) = (binding.help.strip_prefix("... "), rows.last_mut()) {
            row.pieces.truncate(1);
            row.pieces.extend([Piece::Word("to".into())].into_iter().chain(caps));
            let start = row.help.split(" to ").next().unwrap_or_default().to_owned();
            row.help = format!("{start} to {to}");
        } else if let Some(row) =
            rows.iter_mut().find(|row| row.help == binding.help && row.pieces.len() == 1)
            && caps.len() == 1
        {
            row.pieces.push(Piece::Word("or".into()));
            row.pieces.extend(caps);
        } else {
            rows.push(Row { pieces: caps, help: binding.help.to_owned() });
        }
    }
    rows
}

/// The keys of a binding as it is written, each for itself.
fn caps(text: &str) -> Vec<Piece> {
    let (mut caps, mut rest) = (Vec::new(), text);
    for held in ["Ctrl", "Shift"] {
        if let Some(after) = rest.strip_prefix(held).and_then(|after| after.strip_prefix('+')) {
            caps.push(Piece::Cap(held.to_owned()));
            rest = after;
        }
    }
    caps.push(Piece::Cap(rest.to_owned()));
    caps
}

/// Which groups go into which of some columns, in order, so that the highest column is as low as can be.
fn columns(heights: &[f32], count: usize) -> Vec<Range<usize>> {
    let fill = |limit: f32| {
        let (mut columns, mut start, mut sum) = (Vec::new(), 0, 0.0);
        for (i, height) in heights.iter().enumerate() {
            if i > start && sum + height > limit {
                columns.push(start..i);
                (start, sum) = (i, 0.0);
            }
            sum += height;
        }
        columns.push(start..heights.len());
        columns
    };
    // The lowest height that does is the sum of some groups that follow each other.
    let mut limits: Vec<f32> = (0..heights.len())
        .flat_map(|from| (from..heights.len()).map(move |to| heights[from..=to].iter().sum()))
        .collect();
    limits.sort_by(f32::total_cmp);
    limits
        .into_iter()
        .map(|limit| fill(limit + 0.01))
        .find(|columns| columns.len() <= count)
        .unwrap_or_else(|| fill(f32::MAX))
}

/// A line, measured.
struct Laid {
    pieces: Vec<(bool, Arc<Galley>)>,
    help: Arc<Galley>,
}

impl Laid {
    fn new(ui: &Ui, row: &Row) -> Self {
        let lay = |text: &str, size: f32, color: Color32| {
            ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(size), color)
        };
        let (text, strong) = (ui.visuals().text_color(), ui.visuals().strong_text_color());
        let piece = |piece: &Piece| match piece {
            Piece::Cap(text) => (true, lay(text, 11.0, strong)),
            Piece::Word(word) => (false, lay(word, 12.5, strong)),
        };
        Self { pieces: row.pieces.iter().map(piece).collect(), help: lay(&row.help, 12.5, text) }
    }

    fn piece_width((is_cap, galley): &(bool, Arc<Galley>)) -> f32 {
        // A cap is at least as wide as high.
        if *is_cap { (galley.size().x + 10.0).max(CAP_HEIGHT + 2.0) } else { galley.size().x }
    }

    fn lead(&self) -> f32 {
        self.pieces.iter().map(|piece| Self::piece_width(piece) + 3.0).sum()
    }
}

/// A column, measured: titles, lines, and how far the words are from the left.
struct Column {
    groups: Vec<(usize, Vec<Laid>, f32)>,
    width: f32,
}

fn measure(ui: &Ui, groups: &[Group], range: Range<usize>) -> Column {
    let mut laid: Vec<(usize, Vec<Laid>, f32)> = range
        .map(|i| {
            let rows: Vec<Laid> = groups[i].rows.iter().map(|row| Laid::new(ui, row)).collect();
            let lead = rows.iter().map(Laid::lead).fold(0.0, f32::max);
            (i, rows, lead)
        })
        .collect();
    // Keys above each other have their words above each other; what the mouse does is longer.
    let is_keys = |i: usize| groups[i].title != "Mouse";
    let lead = laid.iter().filter(|(i, ..)| is_keys(*i)).map(|(.., lead)| *lead).fold(0.0, f32::max);
    for (i, _, own) in &mut laid {
        *own = if is_keys(*i) { lead } else { *own };
    }
    let wide = |(_, rows, lead): &(usize, Vec<Laid>, f32)| {
        rows.iter().map(|row| lead + INDENT + row.help.size().x).fold(0.0, f32::max)
    };
    let width = laid.iter().map(wide).fold(0.0, f32::max).ceil();
    Column { groups: laid, width }
}

/// Shows it; closes when the user has seen enough.
pub(crate) fn show(context: &Context, model: &mut Model) {
    let room = dialog::room(context);
    let groups = groups();
    let heights: Vec<f32> = groups.iter().map(Group::height).collect();
    let mut closed = false;
    let response = dialog::modal(context, "Keys and mouse", room.x, |ui| {
        let most = ui.available_width() - 10.0;
        let measured = (1..=4).rev().map(|count| {
            let columns: Vec<Column> =
                columns(&heights, count).into_iter().map(|range| measure(ui, &groups, range)).collect();
            let width = columns.iter().map(|c| c.width).sum::<f32>() + GAP * (columns.len() - 1) as f32;
            (columns, width)
        });
        let mut fitting = measured.filter(|(columns, width)| *width <= most || columns.len() == 1);
        let Some((columns, width)) = fitting.next() else { return };
        ui.set_max_width(width.min(most) + 10.0);
        ui.horizontal(|ui| {
            dialog::title(ui, "Keys and mouse");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                closed = ui.button("Close").clicked();
            });
        });
        ui.add_space(4.0);
        let area = ScrollArea::both().max_height((room.y - 48.0).max(ROW)).auto_shrink([false, true]);
        area.show(ui, |ui| {
            let height =
                columns.iter().map(|column| column.height(&heights)).fold(0.0, f32::max) - BETWEEN_GROUPS;
            let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
            let mut left = rect.left();
            for column in &columns {
                column.paint(ui, &groups, pos2(left, rect.top()));
                left += column.width + GAP;
            }
        });
    });
    if closed || response.backdrop_response.clicked() {
        model.close();
    }
}

impl Column {
    fn height(&self, heights: &[f32]) -> f32 {
        self.groups.iter().map(|(i, ..)| heights[*i]).sum()
    }

    fn paint(&self, ui: &Ui, groups: &[Group], at: egui::Pos2) {
        let mut top = at.y;
        for (i, rows, lead) in &self.groups {
            let font = FontId::proportional(13.0);
            ui.painter().text(
                pos2(at.x, top + 0.5 * TITLE - 2.0),
                Align2::LEFT_CENTER,
                groups[*i].title,
                font,
                ACCENT,
            );
            let line = Stroke::new(1.0, Color32::from_gray(60));
            ui.painter().hline(at.x..=at.x + self.width, top + TITLE - 4.0, line);
            top += TITLE;
            for (laid, row) in rows.iter().zip(&groups[*i].rows) {
                let rect = Rect::from_min_size(pos2(at.x, top), vec2(self.width, ROW));
                row.name(ui, rect);
                laid.paint(ui, rect, *lead);
                top += ROW;
            }
            top += BETWEEN_GROUPS;
        }
    }
}

impl Row {
    /// Tells screen readers what is painted.
    fn name(&self, ui: &Ui, rect: Rect) {
        let words: Vec<&str> =
            self.pieces.iter().map(|(Piece::Cap(text) | Piece::Word(text))| text.as_str()).collect();
        let name = format!("{}: {}", words.join(" "), self.help);
        let response = ui.interact(rect, ui.scope_id().with(&name), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &name));
    }
}

impl Laid {
    fn paint(&self, ui: &Ui, rect: Rect, lead: f32) {
        let painter = ui.painter();
        let middle = rect.center().y;
        let mut left = rect.left();
        for piece in &self.pieces {
            let (is_cap, galley) = piece;
            let width = Self::piece_width(piece);
            let cap = Rect::from_min_size(pos2(left, middle - 0.5 * CAP_HEIGHT), vec2(width, CAP_HEIGHT));
            if *is_cap {
                // Darker below: a cap that can be pressed.
                painter.rect_filled(cap.translate(vec2(0.0, 1.5)), 3.5, Color32::from_gray(14));
                painter.rect(
                    cap,
                    3.5,
                    Color32::from_gray(52),
                    Stroke::new(1.0, Color32::from_gray(84)),
                    StrokeKind::Inside,
                );
            }
            let text = Align2::CENTER_CENTER.anchor_size(cap.center(), galley.size());
            painter.galley(text.min, galley.clone(), Color32::WHITE);
            left += width + 3.0;
        }
        let text =
            Align2::LEFT_CENTER.anchor_size(pos2(rect.left() + lead + INDENT, middle), self.help.size());
        painter.galley(text.min, self.help.clone(), Color32::WHITE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::command::bindings;

    #[test]
    fn every_key_is_there() {
        let groups = groups();
        let all: Vec<&Piece> = groups.iter().flat_map(|g| &g.rows).flat_map(|row| &row.pieces).collect();
        for binding in bindings().filter(|b| !b.help.starts_with("... ")) {
            let last = caps(&binding.text()).pop().expect("a key");
            assert!(all.contains(&&last), "{}", binding.text());
        }
        let light = groups.iter().find(|g| g.title == "Light").expect("a group");
        let [cap, last] = ["1", "0"].map(|key| Piece::Cap(key.into()));
        let row =
            Row { pieces: vec![cap, Piece::Word("to".into()), last], help: "choose light 1 to 10".into() };
        assert!(light.rows.contains(&row), "ten keys in one line: {:?}", light.rows);
    }

    #[test]
    fn caps_of_keys() {
        let cap = |text: &str| Piece::Cap(text.into());
        assert_eq!(caps("Ctrl+Shift+S"), [cap("Ctrl"), cap("Shift"), cap("S")], "three");
        assert_eq!(caps("+"), [cap("+")], "itself");
        assert_eq!(caps("Ctrl++"), [cap("Ctrl"), cap("+")], "with another");
    }

    #[test]
    fn columns_are_level() {
        assert_eq!(columns(&[4.0, 8.0, 9.0, 4.0], 2), [0..2, 2..4], "12 and 13");
        assert_eq!(columns(&[4.0, 8.0], 4), [0..1, 1..2], "no empty ones");
        assert_eq!(columns(&[1.0, 1.0, 1.0], 1).len(), 1, "one holds all");
    }
}
