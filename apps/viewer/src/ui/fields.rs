//! Controls of single values, all with names, within what a scene file may say. Each returns whether it was changed.

use antumbra::glam::{DQuat, DVec3, EulerRot};
use antumbra_scene::{Motion, limits};
use egui::{ComboBox, DragValue, TextEdit, Ui};

use crate::model::edit::within;

/// How much of a value a point of dragging is.
const SPEED: f64 = 0.02;

/// A row: a name, then controls that go by it.
pub(crate) fn row<R>(ui: &mut Ui, name: &str, controls: impl FnOnce(&mut Ui, egui::Id) -> R) -> R {
    ui.horizontal(|ui| {
        let label = ui.label(name);
        ui.add_space((72.0 - label.rect.width()).max(0.0));
        controls(ui, label.id)
    })
    .inner
}

/// A number as it is shown: six digits, in the shortest way.
fn shown(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) { format!("{rounded:e}") } else { format!("{rounded}") }
}

/// The number that a text says; none for what is no number and for infinities, which change nothing.
pub(crate) fn finite(text: &str) -> Option<f64> {
    text.trim().replace(',', ".").parse().ok().filter(|number: &f64| number.is_finite())
}

/// Width of a number's field, and of each of three.
const WIDE: f32 = 80.0;
const NARROW: f32 = 56.0;

/// A number, typed or dragged. What is there already stays as it is until something else is written: showing a number
/// neither rounds it nor moves it into the range.
fn number(ui: &mut Ui, name: &str, value: &mut f64, range: (f64, f64), speed: f64, suffix: &str) -> bool {
    sized_number(ui, name, value, range, speed, suffix, WIDE)
}

/// The same with a field of another width.
fn sized_number(
    ui: &mut Ui,
    name: &str,
    value: &mut f64,
    range: (f64, f64),
    speed: f64,
    suffix: &str,
    width: f32,
) -> bool {
    let mut edited = *value;
    let drag = DragValue::new(&mut edited)
        .range(range.0..=range.1)
        .clamp_existing_to_range(false)
        .speed(speed)
        .suffix(suffix)
        .custom_formatter(|value, _| shown(value))
        .custom_parser(finite)
        .update_while_editing(false);
    let height = ui.spacing().interact_size.y;
    let response = ui.add_sized([width, height], drag);
    response.widget_info(|| egui::WidgetInfo::drag_value(true, edited));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(name));
    let changed = response.changed() && edited.is_finite() && shown(edited) != shown(*value);
    if changed {
        *value = edited.clamp(range.0, range.1);
    }
    changed
}

/// A length in metres, above zero.
pub(crate) fn length(ui: &mut Ui, name: &str, value: &mut f64) -> bool {
    let speed = 0.01 * value.clamp(0.01, 100.0);
    row(ui, name, |ui, _| number(ui, name, value, (limits::MIN_LENGTH, limits::MAX_LENGTH), speed, " m"))
}

/// An angle in radians, shown in degrees.
pub(crate) fn angle(ui: &mut Ui, name: &str, value: &mut f64, degrees: (f64, f64)) -> bool {
    row(ui, name, |ui, _| {
        let mut shown = value.to_degrees();
        let changed = number(ui, name, &mut shown, degrees, 0.25, "°");
        if changed {
            *value = shown.to_radians();
        }
        changed
    })
}

/// A brightness: many orders of magnitude, so that dragging is relative.
pub(crate) fn brightness(ui: &mut Ui, name: &str, value: &mut f64, unit: &str) -> bool {
    let speed = 0.01 * value.clamp(0.1, limits::MAX_BRIGHTNESS);
    row(ui, name, |ui, _| number(ui, name, value, (0.0, limits::MAX_BRIGHTNESS), speed, unit))
}

/// Three numbers.
fn triple(ui: &mut Ui, name: &str, value: &mut DVec3, range: (f64, f64), speed: f64) -> bool {
    row(ui, name, |ui, _| {
        let mut changed = false;
        for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let name = format!("{name} {axis}");
            changed |= sized_number(ui, &name, &mut value[i], range, speed, "", NARROW);
        }
        changed
    })
}

/// A point, metres.
pub(crate) fn point(ui: &mut Ui, name: &str, value: &mut DVec3) -> bool {
    let limit = limits::MAX_COORDINATE;
    triple(ui, name, value, (-limit, limit), SPEED)
}

/// Three lengths.
pub(crate) fn lengths(ui: &mut Ui, name: &str, value: &mut DVec3) -> bool {
    triple(ui, name, value, (limits::MIN_LENGTH, limits::MAX_LENGTH), 0.01)
}

/// A direction: any three numbers but zeros, kept at unit length.
pub(crate) fn direction(ui: &mut Ui, name: &str, value: &mut DVec3) -> bool {
    let mut edited = *value;
    if !triple(ui, name, &mut edited, (-1.0, 1.0), 0.01) {
        return false;
    }
    match edited.try_normalize() {
        Some(unit) => {
            *value = unit;
            true
        }
        None => false,
    }
}

/// A rotation, as turns about Y, then X, then Z of the thing itself.
pub(crate) fn rotation(ui: &mut Ui, name: &str, value: &mut DQuat) -> bool {
    let (y, x, z) = value.to_euler(EulerRot::YXZ);
    let mut angles = [y, x, z].map(f64::to_degrees);
    let changed = row(ui, name, |ui, _| {
        let mut changed = false;
        for (axis, angle) in ["about y", "about x", "about z"].into_iter().zip(&mut angles) {
            // Rounding of the conversion shows in the last digits, and a zero's sign: nobody wants to see them.
            let mut shown = (*angle * 1e6).round() / 1e6 + 0.0;
            let name = format!("{name} {axis}");
            if sized_number(ui, &name, &mut shown, (-360.0, 360.0), 0.5, "°", NARROW) {
                *angle = shown;
                changed = true;
            }
        }
        changed
    });
    if changed {
        let [y, x, z] = angles.map(f64::to_radians);
        *value = DQuat::from_euler(EulerRot::YXZ, y, x, z).normalize();
    }
    changed
}

/// A linear colour, shown as the eye sees it.
pub(crate) fn color(ui: &mut Ui, name: &str, value: &mut DVec3) -> bool {
    row(ui, name, |ui, label| {
        // Colours of lights may be brighter than any screen: what is edited is the hue, and how bright stays.
        let bright = value.max_element().max(1.0);
        let mut rgb = (*value / bright).as_vec3().to_array();
        let response = ui.color_edit_button_rgb(&mut rgb).labelled_by(label);
        if response.changed() {
            *value = DVec3::from_array(rgb.map(f64::from)) * bright;
        }
        response.changed()
    })
}

/// A box to tick.
pub(crate) fn tick(ui: &mut Ui, name: &str, value: &mut bool) -> bool {
    ui.checkbox(value, name).changed()
}

/// A name. It changes when the field is left or Enter is pressed, to what `allowed` makes of the text.
pub(crate) fn name(
    ui: &mut Ui,
    label: &str,
    value: &mut String,
    allowed: impl FnOnce(&str) -> Option<String>,
) -> bool {
    row(ui, label, |ui, label| {
        let id = ui.scope_id().with("text");
        let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| value.clone());
        let response = ui.add(TextEdit::singleline(&mut text).desired_width(150.0)).labelled_by(label);
        if response.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, text));
            return false;
        }
        ui.data_mut(|data| data.remove::<String>(id));
        if !response.lost_focus() || text == *value {
            return false;
        }
        match allowed(text.trim()) {
            Some(text) => {
                *value = text;
                true
            }
            None => false,
        }
    })
}

/// How something moves. `rest` is where it is at rest, `target` what the camera looks at.
pub(crate) fn motion(ui: &mut Ui, motion: &mut Motion, rest: DVec3, target: DVec3) -> bool {
    let mut changed = false;
    let kind = match motion {
        Motion::Orbit { .. } => "orbit",
        Motion::Path { .. } => "path",
    };
    row(ui, "motion", |ui, label| {
        let combo = ComboBox::from_id_salt("motion").selected_text(kind).show_ui(ui, |ui| {
            let period = match motion {
                Motion::Orbit { period, .. } => period.abs(),
                Motion::Path { period, .. } => *period,
            };
            if ui.selectable_label(kind == "orbit", "orbit").clicked() && kind != "orbit" {
                let center = DVec3::new(target.x, rest.y, target.z);
                *motion = Motion::Orbit { center, axis: DVec3::Y, period };
                changed = true;
            }
            if ui.selectable_label(kind == "path", "path").clicked() && kind != "path" {
                *motion = Motion::Path { points: vec![rest, within(rest + DVec3::X)], period };
                changed = true;
            }
        });
        combo.response.labelled_by(label);
    });
    let periods = (limits::MIN_PERIOD, limits::MAX_PERIOD);
    match motion {
        Motion::Orbit { center, axis, period } => {
            changed |= point(ui, "center", center);
            changed |= direction(ui, "axis", axis);
            let mut backwards = *period < 0.0;
            let mut length = period.abs();
            let edited = row(ui, "period", |ui, _| number(ui, "period", &mut length, periods, 0.05, " s"));
            if edited | tick(ui, "backwards", &mut backwards) {
                *period = if backwards { -length } else { length };
                changed = true;
            }
        }
        Motion::Path { points, period } => {
            let mut remove = None;
            let several = points.len() > 2;
            for (i, p) in points.iter_mut().enumerate() {
                ui.push_id(i, |ui| {
                    changed |= point(ui, &format!("point {}", i + 1), p);
                    if several && ui.small_button(format!("remove point {}", i + 1)).clicked() {
                        remove = Some(i);
                    }
                });
            }
            if let Some(i) = remove {
                points.remove(i);
                changed = true;
            }
            if points.len() < limits::MAX_PATH_POINTS && ui.small_button("add a point").clicked() {
                let last = points.last().copied().unwrap_or(rest);
                points.push(within(last + DVec3::Z));
                changed = true;
            }
            changed |= row(ui, "period", |ui, _| number(ui, "period", period, periods, 0.05, " s"));
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (number, text) in [
            (0.0, "0"),
            (1.234_567_89, "1.23457"),
            (1.234e-5, "1.234e-5"),
            (-1e6, "-1e6"),
            (0.1 + 0.2, "0.3"),
            (85.0, "85"),
        ] {
            assert_eq!(shown(number), text, "{number:?}");
        }
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        for text in ["nan", "inf", "-infinity", "", "x", "1e999"] {
            assert_eq!(finite(text), None, "{text:?}");
        }
        assert_eq!(finite(" -2,5 "), Some(-2.5), "with a comma too");
    }
}
