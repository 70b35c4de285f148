//! The system's clipboard, for text: egui-winit's own would bring decoders of images.

use egui::{OutputCommand, PlatformOutput};
use winit::event::{ElementState, WindowEvent};
use winit::keyboard::{Key, NamedKey};

/// The system's clipboard; where there is none, what is copied stays in the window.
pub(crate) struct Clipboard(Option<arboard::Clipboard>);

impl Clipboard {
    pub(crate) fn new() -> Self {
        let system = arboard::Clipboard::new();
        if let Err(error) = &system {
            log::info!("no system clipboard: {error}");
        }
        Self(system.ok())
    }

    /// Before egui sees an event that may paste: gives it what other programs have copied.
    pub(crate) fn before(&mut self, state: &mut egui_winit::State, event: &WindowEvent) {
        let WindowEvent::KeyboardInput { event, .. } = event else { return };
        let may_paste = match &event.logical_key {
            Key::Character(text) => text.eq_ignore_ascii_case("v"),
            Key::Named(key) => matches!(key, NamedKey::Paste | NamedKey::Insert),
            _ => false,
        };
        if event.state != ElementState::Pressed || !may_paste {
            return;
        }
        // An error is that something other than text was copied.
        if let Some(Ok(text)) = self.0.as_mut().map(arboard::Clipboard::get_text) {
            state.set_clipboard_text(text);
        }
    }

    /// After egui has run: gives other programs what was copied.
    pub(crate) fn after(&mut self, output: &PlatformOutput) {
        let Some(system) = &mut self.0 else { return };
        for command in &output.commands {
            if let OutputCommand::CopyText(text) = command
                && let Err(error) = system.set_text(text)
            {
                log::warn!("nothing was copied: {error}");
            }
        }
    }
}
