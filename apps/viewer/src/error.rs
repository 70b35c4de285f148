//! What ends the program early.

use antumbra_host::HostError;
use antumbra_scene::SceneError;
use thiserror::Error;

/// Why the viewer could not start, or stopped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// There is no window system, or it gives no window.
    #[error("no window: {0}; `antumbra render SCENE -o OUT.png` needs none")]
    NoDisplay(String),
    /// OpenGL, or what is drawn with it.
    #[error(transparent)]
    OpenGl(#[from] HostError),
    /// The scene file.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An option that makes no sense.
    #[error(transparent)]
    Option(#[from] antumbra::OptionError),
    /// There is nothing to show.
    #[error("there is no gallery; give a scene file")]
    NoScene,
    /// Standard output does not take the state.
    #[error("standard output: {0}")]
    Stdout(std::io::Error),
}

impl ViewerError {
    /// There is no window, because of what the window system said.
    pub(crate) fn no_display(error: impl ToString) -> Self {
        let text = error.to_string();
        // winit puts the line of its own source first, which says nothing to anybody here.
        let words =
            text.strip_prefix("os error at ").and_then(|rest| rest.split_once(": ")).map(|(_, words)| words);
        Self::NoDisplay(words.unwrap_or(&text).trim_end_matches('.').to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_are_left_out() {
        let error =
            ViewerError::no_display("os error at /a/b/mod.rs:788: Failed to open connection to X server.");
        assert_eq!(
            error.to_string(),
            "no window: Failed to open connection to X server; `antumbra render SCENE -o OUT.png` needs none"
        );
    }
}
