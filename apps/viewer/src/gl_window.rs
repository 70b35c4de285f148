//! A window and the OpenGL context that draws to it.

use std::num::NonZeroU32;
use std::sync::Arc;

use antumbra_host::HostError;
use glutin::config::{Config, ConfigTemplateBuilder, GlConfig as _};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, GlProfile, NotCurrentContext, NotCurrentGlContext as _,
    PossiblyCurrentContext, PossiblyCurrentGlContext as _, Version,
};
use glutin::display::{GetGlDisplay as _, GlDisplay as _};
use glutin::surface::{GlSurface as _, Surface, SwapInterval, WindowSurface};
use glutin_winit::{ApiPreference, DisplayBuilder, GlWindow as _};
use winit::event_loop::ActiveEventLoop;
use winit::raw_window_handle::HasWindowHandle as _;
use winit::window::{Window, WindowAttributes};

use crate::ViewerError;

/// A window with a current context. Dropped last, after everything that was made in the context.
pub(crate) struct GlWindow {
    pub(crate) gl: Arc<glow::Context>,
    surface: Surface<WindowSurface>,
    context: PossiblyCurrentContext,
    config: Config,
    pub(crate) window: Window,
}

/// OpenGL first, and OpenGL ES where a driver has only that.
const APIS: [ContextApi; 2] =
    [ContextApi::OpenGl(Some(Version::new(3, 3))), ContextApi::Gles(Some(Version::new(3, 0)))];

impl GlWindow {
    /// Opens a window.
    ///
    /// # Errors
    /// [`ViewerError::NoDisplay`], [`ViewerError::OpenGl`] with what the driver said.
    pub(crate) fn new(events: &ActiveEventLoop, attributes: WindowAttributes) -> Result<Self, ViewerError> {
        // Depth and stencil are in textures of the host; what the window needs is colour.
        let template = ConfigTemplateBuilder::new().with_depth_size(0).with_stencil_size(0);
        let builder = DisplayBuilder::new()
            .with_preference(ApiPreference::PreferEgl)
            .with_window_attributes(Some(attributes.clone()));
        let (window, config) = builder
            .build(events, template, |configs| {
                // glutin-winit asks only where there is one. One sample is enough: the host's targets have their own.
                let mut configs: Vec<Config> = configs.collect();
                configs.sort_by_key(|config| (config.num_samples(), !config.hardware_accelerated()));
                configs.swap_remove(0)
            })
            .map_err(ViewerError::no_display)?;
        let display = config.display();
        let window = match window {
            Some(window) => window,
            None => {
                glutin_winit::finalize_window(events, attributes, &config).map_err(ViewerError::no_display)?
            }
        };
        let context = Self::context(&config, &window)?;
        let surface = Self::surface(&config, &window)?;
        let context = context.make_current(&surface).map_err(driver)?;
        // SAFETY: the context is current, and the functions are of its display.
        let gl = unsafe { glow::Context::from_loader_function_cstr(|name| display.get_proc_address(name)) };
        Ok(Self { gl: Arc::new(gl), surface, context, config, window })
    }

    fn context(config: &Config, window: &Window) -> Result<NotCurrentContext, ViewerError> {
        let handle = window.window_handle().map_err(ViewerError::no_display)?.as_raw();
        let mut answers = Vec::new();
        for api in APIS {
            let attributes = ContextAttributesBuilder::new()
                .with_profile(GlProfile::Core)
                .with_context_api(api)
                .build(Some(handle));
            // SAFETY: the handle is that of a window that lives as long as the context.
            match unsafe { config.display().create_context(config, &attributes) } {
                Ok(context) => return Ok(context),
                Err(error) => answers.push(error.to_string()),
            }
        }
        Err(HostError::NoOpenGl(answers.join("; ")).into())
    }

    fn surface(config: &Config, window: &Window) -> Result<Surface<WindowSurface>, ViewerError> {
        let attributes =
            window.build_surface_attributes(Default::default()).map_err(ViewerError::no_display)?;
        // SAFETY: the window lives as long as the surface.
        unsafe { config.display().create_window_surface(config, &attributes) }.map_err(driver)
    }

    /// Size in pixels; `None` while the window is minimized.
    pub(crate) fn size(&self) -> Option<[u32; 2]> {
        let size = self.window.inner_size();
        (size.width > 0 && size.height > 0).then_some([size.width, size.height])
    }

    /// Fits the surface to the window.
    pub(crate) fn resize(&self) {
        if let Some([width, height]) = self.size()
            && let (Some(width), Some(height)) = (NonZeroU32::new(width), NonZeroU32::new(height))
        {
            self.surface.resize(&self.context, width, height);
        }
    }

    /// Whether showing a frame waits for the screen. Drivers that cannot are left as they are.
    pub(crate) fn set_vsync(&self, vsync: bool) {
        let interval = if vsync { SwapInterval::Wait(NonZeroU32::MIN) } else { SwapInterval::DontWait };
        if let Err(error) = self.surface.set_swap_interval(&self.context, interval) {
            log::info!("vsync {vsync}: {error}");
        }
    }

    /// Shows what was drawn. A surface that was lost is made again, and the frame with it is lost.
    ///
    /// # Errors
    /// [`ViewerError::OpenGl`] where the new surface is of no use either.
    pub(crate) fn swap(&mut self) -> Result<(), ViewerError> {
        let Err(error) = self.surface.swap_buffers(&self.context) else { return Ok(()) };
        log::warn!("the window's surface was lost: {error}");
        self.surface = Self::surface(&self.config, &self.window)?;
        self.context.make_current(&self.surface).map_err(driver)?;
        self.window.request_redraw();
        Ok(())
    }
}

fn driver(error: glutin::error::Error) -> ViewerError {
    HostError::Driver(error.to_string()).into()
}
