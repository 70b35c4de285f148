//! An open window, and one frame after the other in it.

use std::io::Write;
use std::sync::Arc;
use std::time::{Duration, Instant};

use antumbra_scene::Scene;
use winit::dpi::LogicalSize;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window};

use crate::canvas::lines::Stroke;
use crate::canvas::map_view::MapPicture;
use crate::canvas::{Canvas, View};
use crate::clipboard::Clipboard;
use crate::gl_window::GlWindow;
use crate::model::Model;
use crate::model::settings::{Antialiasing, Settings};
use crate::model::way::Way;
use crate::reference::Refinement;
use crate::ui::teaching::Lesson;
use crate::ui::{self, MapImage, Seen};
use crate::wake::Wake;
use crate::{ViewerError, controls, report};

/// What exists while there is a window. Fields are dropped in order: the window with its context last.
pub(crate) struct Running {
    canvas: Canvas,
    painter: egui_glow::Painter,
    pub(crate) state: egui_winit::State,
    pub(crate) clipboard: Clipboard,
    context: egui::Context,
    refinement: Refinement,
    pub(crate) window: GlWindow,
    /// When the next frame is due if nothing happens before.
    pub(crate) due: Option<Instant>,
    last_frame: Instant,
    /// Until when things count as moving.
    busy_until: Instant,
    last_shown: Option<Shown>,
    /// When drawing the frame began, if it was one of something that moves.
    last_moved: Option<Instant>,
    /// How long the last frame that moved took.
    last_cost: Duration,
    seen: Seen,
    vsync: bool,
    pub(crate) hidden: bool,
    printed: Option<String>,
    title: String,
    /// The interface's name of the picture of maps.
    map_id: Option<egui::TextureId>,
    /// Frames drawn so far.
    frames: u64,
}

/// What a frame showed.
struct Shown {
    scene: Arc<Scene>,
    time: f64,
    size: [i32; 2],
    ways: [Way; 2],
}

impl Shown {
    /// Whether nothing has changed.
    fn is(&self, other: &Self) -> bool {
        let Self { scene, time, size, ways } = self;
        Arc::ptr_eq(scene, &other.scene) && *time == other.time && *size == other.size && *ways == other.ways
    }
}

/// What a window is opened with.
pub(crate) struct Opening<'a> {
    /// To wake the loop.
    pub(crate) proxy: &'a EventLoopProxy<Wake>,
    /// Those of the model.
    pub(crate) settings: &'a Settings,
    /// Points.
    pub(crate) size: [u32; 2],
    /// Whether it fills the screen.
    pub(crate) maximized: bool,
    /// Whether the state is printed.
    pub(crate) json: bool,
}

/// How long after a change more samples are worth their time.
const SETTLE: Duration = Duration::from_millis(200);

/// Pictures a second of a screen that does not say.
const USUAL_RATE: f64 = 60.0;

impl Running {
    /// Opens a window of this size, in points, and makes all that is in it.
    ///
    /// # Errors
    /// What the window system or OpenGL has not.
    pub(crate) fn open(events: &ActiveEventLoop, opening: &Opening<'_>) -> Result<Self, ViewerError> {
        let Opening { proxy, settings, size, maximized, json } = *opening;
        let attributes = Window::default_attributes()
            .with_title("antumbra")
            .with_inner_size(LogicalSize::new(size[0], size[1]))
            .with_min_inner_size(LogicalSize::new(480, 320))
            .with_maximized(maximized)
            .with_visible(false);
        let window = GlWindow::new(events, attributes)?;
        let canvas = Canvas::new(&window.gl)?;
        let painter = egui_glow::Painter::new(window.gl.clone(), "", None, true)
            .map_err(|error| antumbra_host::HostError::Driver(error.to_string()))?;
        let context = egui::Context::default();
        ui::style::apply(&context);
        if json {
            context.enable_accesskit();
        }
        let to_loop = proxy.clone();
        // A loop that has ended needs no frames.
        context.set_request_repaint_callback(move |info| drop(to_loop.send_event(Wake::After(info.delay))));
        let state = egui_winit::State::new(
            context.clone(),
            egui::ViewportId::ROOT,
            events,
            None,
            events.system_theme(),
            Some(painter.max_texture_side()),
        );
        let to_loop = proxy.clone();
        let refinement = Refinement::new(move || drop(to_loop.send_event(Wake::Traced)));
        window.set_vsync(settings.vsync);
        let now = Instant::now();
        window.window.set_visible(true);
        window.window.request_redraw();
        Ok(Self {
            seen: Seen::new(canvas.info(), canvas.clock()),
            canvas,
            painter,
            state,
            clipboard: Clipboard::new(),
            context,
            refinement,
            window,
            due: None,
            last_frame: now,
            busy_until: now,
            last_shown: None,
            last_moved: None,
            last_cost: Duration::ZERO,
            vsync: settings.vsync,
            hidden: false,
            printed: None,
            title: String::new(),
            map_id: None,
            frames: 0,
        })
    }

    pub(crate) fn wake_at(&mut self, when: Option<Instant>) {
        self.due = match (self.due, when) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
    }

    /// One frame: the interface, which may change the model; the scene; and both into the window.
    pub(crate) fn frame(&mut self, model: &mut Model, json: bool) -> Result<(), ViewerError> {
        let Some(size) = self.window.size().filter(|_| !self.hidden) else { return Ok(()) };
        let now = Instant::now();
        let elapsed = now.duration_since(self.last_frame);
        self.last_frame = now;
        if model.is_moving() {
            model.clock.advance(elapsed.as_secs_f64());
        }
        if self.vsync != model.settings.vsync {
            self.vsync = model.settings.vsync;
            self.window.set_vsync(self.vsync);
        }
        if (self.context.zoom_factor() - model.settings.zoom).abs() > 1e-3 {
            self.context.set_zoom_factor(model.settings.zoom);
        }
        let input = self.state.take_egui_input(&self.window.window);
        let mut picture = egui::Rect::ZERO;
        let output = self.context.run_ui(input, |root| picture = ui::show(root, model, &mut self.seen));
        let scale = output.pixels_per_point;
        self.state.handle_platform_output(&self.window.window, {
            let mut platform = output.platform_output;
            if let Some(update) = platform.accesskit_update.take().filter(|_| json) {
                self.seen.controls = controls::controls(&update, f64::from(scale));
            }
            self.clipboard.after(&platform);
            platform
        });
        let rect = pixels(picture, scale, size);
        model.aspect = f64::from(rect[2].max(1)) / f64::from(rect[3].max(1));
        self.show_title(model);

        self.draw(model, rect, scale, size)?;
        ui::timing::note(model, &self.seen.sides, [rect[2], rect[3]]);
        let primitives = self.context.tessellate(output.shapes, scale);
        let mut textures = output.textures_delta;
        self.painter.paint_and_update_textures(size, scale, &primitives, &mut textures);
        self.window.window.pre_present_notify();
        self.window.swap()?;
        if let Some(start) = self.last_moved.take() {
            self.last_cost = start.elapsed();
        }
        self.frames += 1;
        if rect[2] > 0 && rect[3] > 0 && self.seen.wants_frame(model) {
            self.window.window.request_redraw();
        }
        if json {
            self.print(model, rect, size, scale)?;
        }
        if model.is_moving() {
            self.wake_at(Some(now + self.interval()));
        } else if now < self.busy_until {
            self.wake_at(Some(self.busy_until));
        }
        self.wake_at(self.seen.error_due(model));
        Ok(())
    }

    /// The scene in the window's framebuffer.
    fn draw(&mut self, model: &Model, rect: [i32; 4], scale: f32, size: [u32; 2]) -> Result<(), ViewerError> {
        let now = self.last_frame;
        let shown = Shown {
            scene: model.scene().clone(),
            time: model.clock.time,
            size: [rect[2], rect[3]],
            ways: model.settings.ways,
        };
        let same = self.last_shown.as_ref().is_some_and(|last| last.is(&shown));
        if !same {
            self.busy_until = now + SETTLE;
            self.last_shown = Some(shown);
        }
        let still = now >= self.busy_until && !model.is_moving();
        if model.needs_reference() && rect[2] > 0 && rect[3] > 0 {
            let (width, height) = (rect[2] as u32, rect[3] as u32);
            self.refinement.request(model.scene().clone(), model.clock.time, width, height);
        } else {
            self.refinement.rest();
        }
        let strokes = self.strokes(model)?;
        let samples = self.samples(model, still);
        let view = View {
            scene: model.scene(),
            time: model.clock.time,
            settings: &model.settings,
            components: model.document.components(),
            rect,
            samples,
            strokes: &strokes,
            scale,
            traced: if model.needs_reference() { self.refinement.latest() } else { None },
            measure: model.settings.timing,
            redraw: self.seen.wants_frame(model),
        };
        let map = match model.settings.teaching.map && rect[2] > 0 && rect[3] > 0 {
            true => self.canvas.map(&view, model.light)?,
            false => None,
        };
        self.canvas.clear(size);
        let start = Instant::now();
        let sides = self.canvas.draw(&view)?;
        self.seen.traced = view.traced.map(|t| (t.samples, t.target, t.stale));
        self.last_moved = (!still).then_some(start);
        self.show_map(map);
        if self.seen.frame(sides, still) {
            // What is said of a picture is said in the frame after it.
            self.window.window.request_redraw();
        }
        if still && self.seen.wants_error(model) {
            let error = self.canvas.error(model.scene().image.exposure as f32);
            self.seen.found(error);
        }
        Ok(())
    }

    /// Lines over the picture: marks, and what teaches.
    fn strokes(&mut self, model: &Model) -> Result<Vec<Stroke>, ViewerError> {
        let mut strokes = ui::overlay::strokes(model);
        if Lesson::is_empty(&model.settings.teaching) {
            self.seen.lesson.clear();
        } else if !self.seen.lesson.is_current(model) {
            let setting = self.canvas.describe(model.scene(), model.clock.time)?;
            self.seen.lesson.learn(model, setting.moment(), &setting.described);
            // The legend and the numbers are shown in the frame after.
            self.window.window.request_redraw();
        }
        strokes.extend(self.seen.lesson.strokes.iter().cloned());
        Ok(strokes)
    }

    /// Gives the interface the picture of a map.
    fn show_map(&mut self, map: Option<MapPicture>) {
        let before = self.seen.map.take();
        self.seen.map = map.map(|map| {
            // The texture stays the same for as long as there is a canvas.
            let id = *self.map_id.get_or_insert_with(|| self.painter.register_native_texture(map.texture));
            MapImage { id, size: map.size, caption: map.caption }
        });
        if before != self.seen.map {
            self.window.window.request_redraw();
        }
    }

    /// How soon after a frame the next one of a motion begins: a little sooner than the screen shows it, which showing it
    /// then waits for; at once where frames do not wait.
    fn interval(&self) -> Duration {
        if !self.vsync {
            return Duration::ZERO;
        }
        let rate = self.window.window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let rate = rate.filter(|rate| *rate > 0).map_or(USUAL_RATE, |rate| f64::from(rate) * 1e-3);
        Duration::from_secs_f64(0.9 / rate)
    }

    /// Samples a pixel.
    fn samples(&self, model: &Model, still: bool) -> u32 {
        let most = self.canvas.most_samples();
        // Frames that are measured are all of one kind, moving or not.
        let still = still && !model.settings.timing;
        match model.settings.antialiasing {
            Antialiasing::Samples(n) => n.clamp(1, most),
            // A software renderer takes as many times as long.
            Antialiasing::Auto if self.canvas.info().software => {
                if still && self.last_cost < Duration::from_millis(150) { 4.min(most) } else { 1 }
            }
            Antialiasing::Auto => {
                if still {
                    8.min(most)
                } else {
                    4.min(most)
                }
            }
        }
    }

    fn show_title(&mut self, model: &Model) {
        let mark = if model.document.is_modified() { "*" } else { "" };
        let title = format!("{}{mark} – antumbra", model.document.source().name());
        if self.title != title {
            self.window.window.set_title(&title);
            self.title = title;
        }
    }

    pub(crate) fn toggle_fullscreen(&self) {
        let window = &self.window.window;
        window.set_fullscreen(window.fullscreen().is_none().then_some(Fullscreen::Borderless(None)));
    }

    /// Writes what the picture shows.
    pub(crate) fn screenshot(&mut self, model: &Model, path: &std::path::Path) -> Result<(), String> {
        let Some(size) = self.last_shown.as_ref().map(|shown| shown.size) else {
            return Err("nothing was drawn yet".into());
        };
        let strokes = self.strokes(model).map_err(|error| error.to_string())?;
        let view = View {
            scene: model.scene(),
            time: model.clock.time,
            settings: &model.settings,
            components: model.document.components(),
            rect: [0, 0, size[0], size[1]],
            samples: self.samples(model, true),
            strokes: &strokes,
            scale: self.context.pixels_per_point(),
            traced: if model.needs_reference() { self.refinement.latest() } else { None },
            measure: false,
            redraw: false,
        };
        let (width, height, pixels) = self.canvas.screenshot(&view).map_err(|error| error.to_string())?;
        crate::screenshot::write(path, width, height, &pixels).map_err(|error| error.to_string())
    }

    /// Prints the state if it is not what was printed last.
    fn print(
        &mut self,
        model: &Model,
        rect: [i32; 4],
        size: [u32; 2],
        scale: f32,
    ) -> Result<(), ViewerError> {
        let top = size[1] as i32 - rect[1] - rect[3];
        let mut state = report::state(model, &self.seen, [rect[0], top, rect[2], rect[3]], size, scale);
        state["fullscreen"] = self.window.window.fullscreen().is_some().into();
        state["input"] = self.context.input(report::input);
        let line = state.to_string();
        if self.printed.as_ref() == Some(&line) {
            return Ok(());
        }
        self.printed = Some(line);
        // A frame that looks like the one before is not worth a line.
        state["frames"] = self.frames.into();
        put(&state)
    }
}

/// Writes a line.
pub(crate) fn put(line: &serde_json::Value) -> Result<(), ViewerError> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{line}").and_then(|()| out.flush()).map_err(ViewerError::Stdout)
}

impl Drop for Running {
    fn drop(&mut self) {
        // It deletes the picture of maps as well, which it was told of; that the canvas does so again does no harm.
        self.painter.destroy();
    }
}

/// A rectangle of the interface in pixels from the bottom left of a window of this size.
fn pixels(rect: egui::Rect, scale: f32, size: [u32; 2]) -> [i32; 4] {
    let [w, h] = size.map(|side| side as f32);
    let (left, right) =
        ((rect.left() * scale).round().clamp(0.0, w), (rect.right() * scale).round().clamp(0.0, w));
    let (top, bottom) =
        ((rect.top() * scale).round().clamp(0.0, h), (rect.bottom() * scale).round().clamp(0.0, h));
    [left, h - bottom, right - left, bottom - top].map(|x| x.max(0.0) as i32)
}
