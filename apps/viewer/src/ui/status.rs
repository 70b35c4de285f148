//! The line at the bottom.

use egui::{Align, Color32, Label, Layout, RichText, Ui};

use super::Seen;
use crate::model::Model;

/// What was said last, and what the techniques did.
pub(crate) fn line(ui: &mut Ui, model: &Model, seen: &Seen) {
    // What matters least goes first where there is no room.
    let room = ui.available_width();
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if room > 1000.0 {
            ui.label(RichText::new(&seen.renderer).weak());
        }
        if let Some([rms, largest]) = seen.error
            && room > 420.0
        {
            ui.separator();
            ui.label(format!("error: {rms:.4} RMS, {largest:.3} at most"));
        }
        if let Some((samples, target, stale)) = seen.traced
            && room > 640.0
        {
            ui.separator();
            let of = if stale { ", of what was" } else { "" };
            ui.label(format!("reference: {samples} of {target} rays a pixel{of}"));
        }
        if let Some(stats) = seen.sides[0].stats
            && room > 760.0
        {
            ui.separator();
            let text = format!(
                "{} of {} pairs, {} polygons, {} of {} tiles",
                stats.drawn_pairs, stats.pairs, stats.polygons, stats.touched_tiles, stats.tiles
            );
            ui.label(text).on_hover_text(
                "Pairs of light and occluder that are drawn, what is drawn for them, and the tiles of 16 by 16 \
                 pixels that shadows may reach; the rest is culled",
            );
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let text = match &model.message {
                Some(message) if message.is_error => {
                    RichText::new(&message.text).color(Color32::from_rgb(255, 110, 90))
                }
                Some(message) => RichText::new(&message.text),
                None => RichText::new("F1 for the keys").weak(),
            };
            ui.add(Label::new(text).truncate());
        });
    });
}
