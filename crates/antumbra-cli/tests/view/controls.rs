//! The controls of the interface, found by their names.

use serde_json::Value;

use crate::viewer::Viewer;

impl Viewer<'_> {
    /// The names of all controls.
    pub(crate) fn labels(&self) -> Vec<String> {
        let controls = self.state["controls"].as_array().cloned().unwrap_or_default();
        controls
            .iter()
            .filter_map(|control| {
                Some(format!("{} {:?}", control["role"].as_str()?, control["label"].as_str()?))
            })
            .collect()
    }

    /// A control by its name, and by its role where labels go by the same name; the `index`th of several. Waits for
    /// it.
    #[track_caller]
    pub(crate) fn control(&mut self, role: &str, label: &str, index: usize) -> Value {
        let find = |state: &Value| {
            let controls = state["controls"].as_array()?;
            let mut found =
                controls.iter().filter(|c| c["label"] == label && (role.is_empty() || c["role"] == role));
            found.nth(index).cloned()
        };
        self.wait(&format!("the control {role} {label:?}"), |state| find(state).is_some());
        find(&self.state).expect("it was just there")
    }

    /// Clicks a control by its name; see [`Self::control`]. In the panel it is scrolled to where it can be seen.
    #[track_caller]
    pub(crate) fn click(&mut self, role: &str, label: &str) {
        let bottom = self.number("/window/1") - 45.0;
        for _ in 0..60 {
            self.catch_up();
            let control = self.control(role, label, 0);
            let [x, y] = middle(&control);
            if y < bottom && y > 0.0 {
                self.move_to([x, y]);
                // What was done before may have moved it meanwhile.
                if self.control(role, label, 0)["rect"] == control["rect"] {
                    self.button(1, true);
                    return self.button(1, false);
                }
                continue;
            }
            self.move_to([x, 0.5 * bottom]);
            self.wheel(if y > 0.0 { -1 } else { 1 });
            self.wait("the panel scrolls", |state| {
                let all = state["controls"].as_array().map(Vec::as_slice).unwrap_or_default();
                all.iter().all(|other| other["label"] != label || other["rect"] != control["rect"])
            });
        }
        panic!("{role} {label:?} does not come into view");
    }

    /// Writes something into a field that has a name, and presses Enter.
    #[track_caller]
    pub(crate) fn enter(&mut self, role: &str, label: &str, text: &str) {
        self.click(role, label);
        self.press("Ctrl+A");
        self.write(text);
        self.press("Enter");
    }

    /// Clicks one after another: a menu of the bar, or a list to choose from, and what it opens.
    #[track_caller]
    pub(crate) fn pick(&mut self, controls: &[(&str, &str)]) {
        for (role, label) in controls {
            self.click(role, label);
        }
    }

    /// Switches off the marks that are drawn over the picture.
    #[track_caller]
    pub(crate) fn without_marks(&mut self) {
        self.pick(&[("Button", "View"), ("CheckBox", "Marks")]);
        self.wait("no marks", |state| state["settings"]["marks"] == false);
        self.press("Escape");
        self.wait("the menu is closed", |state| {
            state["controls"].as_array().is_some_and(|all| all.iter().all(|c| c["label"] != "Marks"))
        });
    }
}

/// The middle of a control.
pub(crate) fn middle(control: &Value) -> [f64; 2] {
    let number = |i: usize| control["rect"][i].as_f64().unwrap_or_default();
    [number(0) + 0.5 * number(2), number(1) + 0.5 * number(3)]
}
