//! The controls of the interface as screen readers see them, for programs that drive this one.

use egui::accesskit::{NodeId, Rect, TreeUpdate};
use serde::Serialize;

/// A control of the interface, as screen readers see it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Control {
    /// `Button`, `CheckBox`, `Slider`, ...
    pub(crate) role: String,
    /// Its name.
    pub(crate) label: String,
    /// Its value as text, if it has one.
    pub(crate) value: Option<String>,
    /// x, y, width, height in the window, pixels from the top left.
    pub(crate) rect: [f64; 4],
}

/// The controls of a frame that have a name.
pub(crate) fn controls(update: &TreeUpdate, scale: f64) -> Vec<Control> {
    let named = |id: &NodeId| {
        let (_, node) = update.nodes.iter().find(|(other, _)| other == id)?;
        node.value().or(node.label()).map(str::to_owned)
    };
    let control = |node: &egui::accesskit::Node| {
        let own = node.label().map(str::to_owned);
        let label = own.or_else(|| node.labelled_by().iter().find_map(named))?;
        let Rect { x0, y0, x1, y1 } = node.bounds()?;
        let text = |t: Option<&str>| t.map(str::to_owned);
        let toggled = node.toggled().map(|t| format!("{t:?}").to_lowercase());
        let value = text(node.value()).or(node.numeric_value().map(|v| v.to_string())).or(toggled);
        let rect = [x0, y0, x1 - x0, y1 - y0].map(|x| x * scale);
        Some(Control { role: format!("{:?}", node.role()), label, value, rect })
    };
    update.nodes.iter().filter_map(|(_, node)| control(node)).collect()
}
