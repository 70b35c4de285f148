//! The window's life: events, frames, and when the next one is due.

use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

use crate::model::document::Document;
use crate::model::settings::Settings;
use crate::model::{Model, Request};
use crate::remembered::Remembered;
use crate::running::{Opening, Running, put};
use crate::wake::Wake;
use crate::{Options, ViewerError, report};

/// Opens the window and handles its events until it closes.
///
/// # Errors
/// See [`crate::run`].
pub(crate) fn run(options: Options) -> Result<(), ViewerError> {
    let remembered = if options.fresh { Remembered::default() } else { Remembered::load() };
    let model = model(&options, &remembered)?;
    let events = EventLoop::<Wake>::with_user_event().build().map_err(ViewerError::no_display)?;
    if options.json {
        put(&report::keys())?;
    }
    let proxy = events.create_proxy();
    let size = options.size.or(remembered.size).unwrap_or([1280, 800]);
    let mut app = App {
        json: options.json,
        model,
        proxy,
        size,
        maximized: remembered.maximized && options.size.is_none(),
        running: None,
        kept: None,
        keep_at: None,
        failure: None,
    };
    let outcome = events.run_app(&mut app).map_err(ViewerError::no_display);
    match app.failure.take() {
        Some(failure) => Err(failure),
        None => outcome,
    }
}

/// The scene and the settings that the program starts with.
fn model(options: &Options, remembered: &Remembered) -> Result<Model, ViewerError> {
    let mut settings: Settings = remembered.settings.clone();
    if let Some(technique) = &options.technique {
        settings.ways[0] = technique.parse()?;
    }
    if let Some(path) = &options.scene {
        return Ok(Model::new(Document::load(path)?, settings, options.gallery.clone()));
    }
    let named = options.gallery.iter().find(|entry| Some(entry.name) == options.first.as_deref());
    let document = match named.or(options.gallery.first()) {
        Some(entry) => entry.document()?,
        None => return Err(ViewerError::NoScene),
    };
    let mut model = Model::new(document, settings, options.gallery.clone());
    if let Some(source) = remembered.source() {
        let wanted = source.clone();
        model.show(source);
        if *model.document.source() == wanted {
            remembered.restore(&mut model);
        }
        // A scene that is gone is no reason to begin with a complaint.
        model.message = None;
    }
    Ok(model)
}

struct App {
    json: bool,
    model: Model,
    proxy: EventLoopProxy<Wake>,
    size: [u32; 2],
    maximized: bool,
    running: Option<Running>,
    /// What was last found worth remembering, and when it is to be kept.
    kept: Option<Remembered>,
    keep_at: Option<Instant>,
    failure: Option<ViewerError>,
}

/// How long nothing changes before it is kept.
const QUIET: Duration = Duration::from_secs(2);

impl App {
    fn fail(&mut self, events: &ActiveEventLoop, failure: ViewerError) {
        self.failure = Some(failure);
        self.running = None;
        events.exit();
    }

    fn redraw(&mut self, events: &ActiveEventLoop) {
        let Some(running) = &mut self.running else { return };
        if let Err(failure) = running.frame(&mut self.model, self.json) {
            return self.fail(events, failure);
        }
        self.remember_soon();
        let Some(running) = &mut self.running else { return };
        for request in std::mem::take(&mut self.model.requests) {
            match request {
                Request::Quit => events.exit(),
                Request::Fullscreen => running.toggle_fullscreen(),
                Request::Screenshot(path) => match running.screenshot(&self.model, &path) {
                    Ok(()) => self.model.say(format!("saved {}", path.display())),
                    Err(what) => self.model.complain(format!("{}: {what}", path.display())),
                },
            }
            running.window.window.request_redraw();
        }
    }

    /// Keeps what there is to remember once nothing of it has changed for a while: a program may be ended unasked.
    fn remember_soon(&mut self) {
        // What is looked at while measuring is nobody's choice.
        if self.model.timing.measuring().is_some() {
            return;
        }
        let Some(mut new) = self.remembered() else { return };
        // Time that runs is no change.
        new.forget_time();
        if self.kept.as_ref() != Some(&new) {
            self.kept = Some(new);
            self.keep_at = Some(Instant::now() + QUIET);
        }
        if self.keep_at.is_some_and(|when| when <= Instant::now()) {
            self.keep_at = None;
            self.remember();
        }
        if let Some(running) = &mut self.running {
            running.wake_at(self.keep_at);
        }
    }

    fn remember(&mut self) {
        self.model.stop_measuring();
        if let Some(remembered) = self.remembered() {
            remembered.store();
        }
    }

    fn remembered(&self) -> Option<Remembered> {
        let running = self.running.as_ref()?;
        let window = &running.window.window;
        let size = window.inner_size().to_logical::<u32>(window.scale_factor());
        let maximized = window.is_maximized();
        let size = if maximized || size.width == 0 { self.size } else { [size.width, size.height] };
        Some(Remembered::of(&self.model, Some(size), maximized))
    }
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.running.is_some() {
            return;
        }
        let opening = Opening {
            proxy: &self.proxy,
            settings: &self.model.settings,
            size: self.size,
            maximized: self.maximized,
            json: self.json,
        };
        match Running::open(events, &opening) {
            Ok(running) => self.running = Some(running),
            Err(failure) => self.fail(events, failure),
        }
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        // The surface is gone, and on some systems the context with it.
        self.remember();
        self.running = None;
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(running) = &mut self.running else { return };
        running.clipboard.before(&mut running.state, &event);
        // To egui a frame that is due is a reason for another one.
        if event != WindowEvent::RedrawRequested
            && running.state.on_window_event(&running.window.window, &event).repaint
        {
            running.window.window.request_redraw();
        }
        match event {
            WindowEvent::CloseRequested => {
                self.model.apply(crate::model::command::Command::Quit);
                running.window.window.request_redraw();
            }
            WindowEvent::Resized(_) => {
                running.window.resize();
                running.window.window.request_redraw();
            }
            WindowEvent::Occluded(hidden) => {
                running.hidden = hidden;
                running.window.window.request_redraw();
            }
            WindowEvent::RedrawRequested => self.redraw(events),
            _ => {}
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, wake: Wake) {
        let Some(running) = &mut self.running else { return };
        match wake {
            Wake::After(delay) if delay.is_zero() => running.window.window.request_redraw(),
            Wake::After(delay) => running.wake_at(Instant::now().checked_add(delay)),
            Wake::Traced => running.window.window.request_redraw(),
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(running)) = (cause, &mut self.running) {
            running.due = None;
            running.window.window.request_redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let due = self.running.as_ref().and_then(|running| running.due);
        events.set_control_flow(due.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.remember();
        self.running = None;
    }
}
