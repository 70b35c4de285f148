//! What dialogs have in common.

use egui::{Align, Color32, Context, Frame, Id, Layout, Margin, Modal, ModalResponse, RichText, Ui, vec2};

/// The colour of what went wrong.
pub(crate) const ERROR: Color32 = Color32::from_rgb(255, 110, 90);
/// Round what a dialog says, points.
const MARGIN: i8 = 16;
/// Between a dialog and the window's edge, points.
const DISTANCE: f32 = 8.0;

/// The most that a dialog can hold in this window: width and height in points.
pub(crate) fn room(context: &Context) -> egui::Vec2 {
    let around = 2.0 * (f32::from(MARGIN) + 1.0 + DISTANCE);
    (context.content_rect().size() - vec2(around, around)).max(vec2(80.0, 60.0))
}

/// A dialog of this width at most.
pub(crate) fn modal<T>(
    context: &Context,
    title: &str,
    width: f32,
    content: impl FnOnce(&mut Ui) -> T,
) -> ModalResponse<T> {
    let frame = Frame::window(&context.global_style()).inner_margin(Margin::same(MARGIN));
    let id = Id::unique(title);
    let room = vec2(width.min(room(context).x), room(context).y);
    let area = Modal::default_area(id).default_size(room);
    let modal = Modal::new(id).area(area).frame(frame).backdrop_color(Color32::from_black_alpha(140));
    modal.show(context, |ui| {
        ui.set_max_width(room.x);
        content(ui)
    })
}

/// The title of a dialog.
pub(crate) fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).size(16.0).strong());
    ui.add_space(4.0);
}

/// Buttons at the right, the first one rightmost.
pub(crate) fn buttons<T>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> T) -> T {
    ui.add_space(6.0);
    let size = vec2(ui.available_width(), 26.0);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().button_padding = vec2(14.0, 5.0);
        add(ui)
    })
    .inner
}
