//! How the interface looks: quiet, so that the picture is what is seen.

use egui::{Color32, CornerRadius, Stroke, TextStyle, Theme, Visuals};

/// The colour of what is chosen, sRGB.
pub(crate) const ACCENT: Color32 = Color32::from_rgb(255, 176, 64);

/// Sets the interface up.
pub(crate) fn apply(context: &egui::Context) {
    context.set_theme(Theme::Dark);
    context.style_mut_of(Theme::Dark, |style| {
        let mut visuals = Visuals::dark();
        visuals.panel_fill = Color32::from_gray(27);
        visuals.window_fill = Color32::from_gray(30);
        visuals.selection.bg_fill = Color32::from_rgb(110, 74, 20);
        visuals.selection.stroke = Stroke::new(1.0, ACCENT);
        visuals.hyperlink_color = ACCENT;
        for widget in [
            &mut visuals.widgets.noninteractive,
            &mut visuals.widgets.inactive,
            &mut visuals.widgets.hovered,
            &mut visuals.widgets.active,
            &mut visuals.widgets.open,
        ] {
            widget.corner_radius = CornerRadius::same(3);
        }
        style.visuals = visuals;
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        style.spacing.slider_width = 110.0;
        style.spacing.combo_width = 120.0;
        style.interaction.selectable_labels = false;
        if let Some(font) = style.text_styles.get_mut(&TextStyle::Heading) {
            font.size = 15.0;
        }
    });
}
