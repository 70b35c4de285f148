//! Progress on standard error, shown on a terminal only.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar that fills as work is done, with the time that is left.
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar named `what`; `unit` is what is counted.
    pub(crate) fn new(what: &str, unit: &str) -> Self {
        // indicatif draws on standard error, and hides itself where that is no terminal.
        let bar = ProgressBar::new(0);
        let template =
            format!("{{prefix:>12}} [{{bar:40}}] {{human_pos}}/{{human_len}} {unit}, {{eta}} left  {{msg}}");
        // A wrong template would be a slip in the line above: then the plain bar does.
        let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style.progress_chars("=> "));
        bar.set_prefix(what.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar }
    }

    /// `done` of `total` are done. May be called from any thread, in any order, as often as one likes.
    pub(crate) fn set(&self, done: u64, total: u64) {
        if self.bar.length() != Some(total) {
            self.bar.set_length(total);
        }
        self.bar.set_position(done);
    }

    /// What is being worked on.
    pub(crate) fn message(&self, text: &str) {
        self.bar.set_message(text.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
