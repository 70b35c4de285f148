//! A program that draws to its window with OpenGL of its own, and gets its shadows by one call a frame.
//!
//! `shadows.rs` is all there is of antumbra; the rest is a window (winit, glutin) and a renderer without shadows. The
//! space bar takes the shadows away and brings them back, Escape ends. With a folder as its argument it writes one frame
//! without shadows and one with, `before.png` and `after.png`, and ends.

mod scene;
mod shadows;

use antumbra::glow;
use glutin::config::{ConfigTemplateBuilder, GlConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentContext, Version,
};
use glutin::display::{GetGlDisplay, GlDisplay};
use glutin::surface::{GlSurface, Surface, WindowSurface};
use glutin_winit::{DisplayBuilder, GlWindow};
use scene::Scene;
use shadows::Shadows;
use std::error::Error;
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::raw_window_handle::HasWindowHandle;
use winit::window::{Window, WindowId};

/// What is dropped first comes first: OpenGL's objects need their context, and that its window.
struct Open {
    shadows: Shadows,
    scene: Scene,
    gl: glow::Context,
    surface: Surface<WindowSurface>,
    context: PossiblyCurrentContext,
    window: Window,
}

struct App {
    open: Option<Open>,
    with_shadows: bool,
    start: Instant,
    /// Where pictures go.
    folder: Option<PathBuf>,
    failed: Option<Box<dyn Error>>,
}

fn open(events: &ActiveEventLoop) -> Result<Open, Box<dyn Error>> {
    let attributes = Window::default_attributes()
        .with_title("shadows in a window")
        .with_inner_size(PhysicalSize::new(800, 450));
    let template = ConfigTemplateBuilder::new().with_depth_size(24).with_multisampling(4);
    let (window, config) = DisplayBuilder::new().with_window_attributes(Some(attributes)).build(
        events,
        template,
        |configs| configs.max_by_key(|config| config.num_samples()).expect("a format"),
    )?;
    let window = window.ok_or("no window")?;
    let display = config.display();
    let attributes = ContextAttributesBuilder::new()
        .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
        .build(Some(window.window_handle()?.as_raw()));
    // SAFETY: the window lives longer than context and surface.
    let (context, surface) = unsafe {
        let surface = window.build_surface_attributes(Default::default())?;
        (display.create_context(&config, &attributes)?, display.create_window_surface(&config, &surface)?)
    };
    let context = context.make_current(&surface)?;
    let loader = |name: &str| display.get_proc_address(&CString::new(name).expect("a name without zeros"));
    // SAFETY: the context is current.
    let gl = unsafe { glow::Context::from_loader_function(loader) };
    Ok(Open { shadows: Shadows::new(loader)?, scene: Scene::new(&gl)?, gl, surface, context, window })
}

impl Open {
    fn draw(&mut self, time: f32, with_shadows: bool) -> Result<[i32; 2], Box<dyn Error>> {
        let size = self.window.inner_size();
        let size = [size.width.max(1) as i32, size.height.max(1) as i32];
        let (view, projection) = scene::camera(time, size);
        self.scene.draw(&self.gl, size, projection * view);
        if with_shadows {
            self.shadows.add(view.to_cols_array_2d(), projection.to_cols_array_2d(), size)?;
        }
        Ok(size)
    }

    /// Both pictures of one moment.
    fn save(&mut self, folder: &Path) -> Result<(), Box<dyn Error>> {
        std::fs::create_dir_all(folder)?;
        for (name, with_shadows) in [("before.png", false), ("after.png", true)] {
            let size = self.draw(0.0, with_shadows)?;
            scene::save(&self.gl, size, &folder.join(name))?;
        }
        Ok(())
    }

    fn show(&mut self, time: f32, with_shadows: bool) -> Result<(), Box<dyn Error>> {
        self.draw(time, with_shadows)?;
        self.surface.swap_buffers(&self.context)?;
        self.window.request_redraw();
        Ok(())
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        match (self.open.is_none().then(|| open(events)), &self.folder) {
            (Some(Ok(mut open)), Some(folder)) => {
                self.failed = open.save(folder).err();
                events.exit();
            }
            (Some(Ok(open)), None) => self.open = Some(open),
            (Some(Err(error)), _) => {
                self.failed = Some(error);
                events.exit();
            }
            (None, _) => {}
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        let result = match event {
            WindowEvent::CloseRequested => return events.exit(),
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Pressed => {
                match event.logical_key {
                    Key::Named(NamedKey::Escape) => events.exit(),
                    Key::Named(NamedKey::Space) => self.with_shadows ^= true,
                    _ => {}
                }
                Ok(())
            }
            WindowEvent::Resized(size) => {
                if let (Ok(width), Ok(height)) = (size.width.try_into(), size.height.try_into()) {
                    open.surface.resize(&open.context, width, height);
                }
                Ok(())
            }
            WindowEvent::RedrawRequested => open.show(self.start.elapsed().as_secs_f32(), self.with_shadows),
            _ => Ok(()),
        };
        if let Err(error) = result {
            self.failed = Some(error);
            events.exit();
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let mut app = App { open: None, with_shadows: true, start: Instant::now(), folder, failed: None };
    EventLoop::new()?.run_app(&mut app)?;
    app.failed.map_or(Ok(()), Err)
}
