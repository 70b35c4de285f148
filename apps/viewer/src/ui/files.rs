//! Choosing a file to open or a place to save to.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align, Align2, Color32, Context, FontId, Id, Key, Label, Layout, Modifiers, Rect, RichText, Role,
    ScrollArea, Sense, Stroke, StrokeKind, TextEdit, Ui, WidgetInfo, pos2, vec2,
};

use super::style::ACCENT;
use super::{Seen, dialog};
use crate::model::document::Source;
use crate::model::files::{Answer, Files, Purpose};
use crate::model::{Dialog, Model, Then};

/// How high a row of the list is, points.
const ROW: f32 = 22.0;

/// While it is asked whether to replace a file, Escape answers that and does not close the dialog.
pub(crate) fn escape(context: &Context, seen: &mut Seen) {
    if let Some(files) = seen.files.as_mut().filter(|files| files.replace.is_some())
        && context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
    {
        files.replace = None;
    }
}

/// Shows the dialog, and opens or saves what the user says.
pub(crate) fn show(context: &Context, model: &mut Model, seen: &mut Seen, purpose: Purpose) {
    let begins = seen.files.as_ref().is_none_or(|files| files.purpose != purpose);
    if begins {
        let mut files = Files::new(purpose, model.document.source());
        // Saving elsewhere was asked for because saving did not work.
        if model.after_save.is_some() && files.error.is_none() {
            files.error = model.message.take_if(|message| message.is_error).map(|message| message.text);
        }
        seen.files = Some(files);
    }
    let Some(files) = &mut seen.files else { return };
    let (name, verb) = match purpose {
        Purpose::Open => ("Open a scene", "Open"),
        Purpose::Save => ("Save the scene as", "Save"),
    };
    let mut cancelled = false;
    let answer = dialog::modal(context, name, 560.0, |ui| {
        ui.set_min_width(ui.available_width());
        dialog::title(ui, name);
        folder(ui, files);
        let entered = list(ui, files);
        let written = path(ui, files, begins);
        if let Some(error) = &files.error {
            ScrollArea::vertical().id_salt("error").max_height(96.0).show(ui, |ui| {
                ui.set_width(ui.available_width());
                ui.label(RichText::new(error).color(dialog::ERROR));
            });
        }
        let asked = dialog::buttons(ui, |ui| match &files.replace {
            Some(path) => {
                let name = Source::File(path.clone()).name();
                let keep = ui.button("Keep it");
                if ui.memory(|memory| memory.focused().is_none()) {
                    keep.request_focus();
                }
                if keep.clicked() {
                    files.replace = None;
                }
                let replace = ui.button(RichText::new("Replace").color(dialog::ERROR));
                let question = Label::new(format!("{name} is there already. Replace it?")).truncate();
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(question));
                if replace.clicked() { files.replace() } else { Answer::Ask }
            }
            None => {
                let accept = ui.button(verb).clicked();
                cancelled = ui.button("Cancel").clicked();
                if accept { files.submit() } else { Answer::Ask }
            }
        });
        [asked, entered, written].into_iter().find(|answer| *answer != Answer::Ask).unwrap_or(Answer::Ask)
    })
    .inner;
    let failed = match answer {
        Answer::Ask if cancelled => {
            model.close();
            false
        }
        Answer::Ask => false,
        Answer::Open(path) => {
            model.message = None;
            model.go_on(Then::Show(Source::File(path)));
            model.message.as_ref().is_some_and(|message| message.is_error)
        }
        Answer::Save(path) => !model.save_here(&path),
    };
    if failed {
        model.dialog = Some(match purpose {
            Purpose::Open => Dialog::Open,
            Purpose::Save => Dialog::SaveAs,
        });
        files.error = model.message.take().map(|message| message.text);
    }
}

/// Where one is, and the ways out of there.
fn folder(ui: &mut Ui, files: &mut Files) {
    ui.horizontal(|ui| {
        if ui
            .add_enabled(files.folder.parent().is_some(), egui::Button::new("Up"))
            .on_hover_text("parent folder")
            .clicked()
        {
            files.go_up();
        }
        if let Some(home) = std::env::home_dir()
            && ui.button("Home").clicked()
        {
            files.go(&home);
        }
        let all = files.folder.display().to_string();
        let font = FontId::proportional(13.0);
        let wide = |ui: &Ui, text: &str| {
            ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE).size().x
        };
        // The end of a path says more than its beginning.
        let mut text = all.clone();
        let mut rest = all.as_str();
        while wide(ui, &text) > ui.available_width()
            && let Some((at, _)) = rest.char_indices().skip(1).find(|(_, c)| std::path::is_separator(*c))
        {
            rest = &rest[at..];
            text = format!("…{rest}");
        }
        ui.add(Label::new(RichText::new(text).font(font)).truncate()).on_hover_text(all);
    });
    ui.add_space(2.0);
}

/// What is in the folder.
fn list(ui: &mut Ui, files: &mut Files) -> Answer {
    let height = (dialog::room(ui.ctx()).y - 210.0).clamp(2.0 * ROW, 14.0 * ROW);
    let mut answer = Answer::Ask;
    let frame = egui::Frame::new().fill(ui.visuals().extreme_bg_color).corner_radius(3).inner_margin(4);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.set_height(height);
        if files.entries.is_empty() {
            ui.centered_and_justified(|ui| ui.weak("no folders and no .toml files"));
            return;
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        // A folder begins at its top.
        let area = ScrollArea::vertical().id_salt(&files.folder).auto_shrink(false);
        let moved = std::mem::take(&mut files.moved);
        area.show_rows(ui, ROW, files.entries.len(), |ui, range| {
            if let Some(chosen) = files.chosen.filter(|_| moved) {
                let top = ui.max_rect().top() + ROW * (chosen as f32 - range.start as f32);
                let place = Rect::from_min_size(pos2(ui.max_rect().left(), top), vec2(1.0, ROW));
                ui.scroll_to_rect_animation(place, None, egui::style::ScrollAnimation::none());
            }
            for index in range {
                if let Some(said) = row(ui, files, index) {
                    answer = said;
                    break;
                }
            }
        });
    });
    answer
}

/// One entry; what follows from a double click on it.
fn row(ui: &mut Ui, files: &mut Files, index: usize) -> Option<Answer> {
    let entry = files.entries.get(index)?;
    let chosen = files.chosen == Some(index);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, true, chosen, &entry.name));
    let visuals = ui.visuals();
    let painter = ui.painter_at(rect);
    if chosen {
        painter.rect_filled(rect, 3.0, visuals.selection.bg_fill);
    } else if response.hovered() || response.has_focus() {
        painter.rect_filled(rect, 3.0, visuals.widgets.hovered.weak_bg_fill);
    }
    if response.has_focus() {
        painter.rect_stroke(rect, 3.0, Stroke::new(1.0, ACCENT), StrokeKind::Inside);
    }
    icon(&painter, pos2(rect.left() + 15.0, rect.center().y), entry.is_folder);
    let color = if chosen || response.hovered() { visuals.strong_text_color() } else { visuals.text_color() };
    let job = egui::text::LayoutJob::simple_singleline(entry.name.clone(), FontId::proportional(13.0), color);
    let job = egui::text::LayoutJob {
        wrap: egui::text::TextWrapping::truncate_at_width(rect.width() - 38.0),
        ..job
    };
    let galley = painter.layout_job(job);
    let at = Align2::LEFT_CENTER.anchor_size(pos2(rect.left() + 30.0, rect.center().y), galley.size());
    painter.galley(at.min, galley, color);
    let entered = response.has_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    if response.double_clicked() || entered {
        return Some(files.enter(index));
    }
    if response.clicked() {
        files.choose(index);
    }
    None
}

/// A small picture of a folder or a file.
fn icon(painter: &egui::Painter, at: egui::Pos2, is_folder: bool) {
    if is_folder {
        let color = ACCENT.gamma_multiply(0.8);
        painter.rect_filled(Rect::from_min_size(at - vec2(7.0, 6.0), vec2(6.0, 4.0)), 1.0, color);
        painter.rect_filled(Rect::from_min_size(at - vec2(7.0, 4.0), vec2(14.0, 10.0)), 1.5, color);
    } else {
        let page = Rect::from_center_size(at, vec2(10.0, 13.0));
        painter.rect_stroke(page, 1.5, Stroke::new(1.0, Color32::from_gray(150)), StrokeKind::Inside);
        for y in [-2.5, 0.5, 3.5] {
            painter.hline(at.x - 2.5..=at.x + 2.5, at.y + y, Stroke::new(1.0, Color32::from_gray(110)));
        }
    }
}

/// The path that is written.
fn path(ui: &mut Ui, files: &mut Files, begins: bool) -> Answer {
    ui.add_space(4.0);
    let id = Id::unique("path of a file");
    if ui.memory(|memory| memory.has_focus(id)) {
        let arrow = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let step = if arrow(Key::ArrowDown) { Some(true) } else { arrow(Key::ArrowUp).then_some(false) };
        if let Some(forward) = step {
            files.step(forward);
            let end = files.text.chars().count();
            select(ui, id, end, end);
        }
    }
    let mut answer = Answer::Ask;
    let size = vec2(ui.available_width(), 24.0);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        let label = ui.label("Path");
        let edit = TextEdit::singleline(&mut files.text)
            .id(id)
            .desired_width(ui.available_width())
            .margin(vec2(6.0, 4.0));
        let response = ui.add(edit).labelled_by(label.id);
        if response.changed() {
            files.edited();
        }
        if begins {
            response.request_focus();
            // What is to be replaced first is the name without its ending.
            let name = files.text.rsplit_once('.').map_or(files.text.as_str(), |(name, _)| name);
            select(ui, id, 0, name.chars().count());
        }
        if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            answer = files.submit();
        }
        // Whatever had the keys before is gone.
        if files.replace.is_none() && ui.memory(|memory| memory.focused().is_none()) {
            response.request_focus();
        }
    });
    answer
}

/// Selects a part of what is written, in characters.
fn select(ui: &Ui, id: Id, from: usize, to: usize) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(CCursor::new(from), CCursor::new(to))));
    state.store(ui.ctx(), id);
}
