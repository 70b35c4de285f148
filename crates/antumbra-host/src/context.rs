//! OpenGL contexts without a window, by EGL.

use crate::HostError;
use glow::HasContext;
use glutin::api::egl::device::Device;
use glutin::api::egl::display::Display;
use glutin::config::{ConfigSurfaceTypes, ConfigTemplateBuilder};
use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, PossiblyCurrentContext, Version};
use glutin::display::GlDisplay;
use std::ffi::{CStr, c_void};
use std::sync::Arc;

/// The kind of context.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Api {
    /// OpenGL 3.3 core profile (drivers may give a newer one).
    Gl33,
    /// OpenGL ES 3.0 (drivers may give a newer one).
    Gles30,
}

/// A current OpenGL context without a window. One a thread.
pub struct HeadlessContext {
    gl: Arc<glow::Context>,
    _context: PossiblyCurrentContext,
    display: Display,
}

/// What a driver says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContextInfo {
    /// `GL_VENDOR`.
    pub vendor: String,
    /// `GL_RENDERER`.
    pub renderer: String,
    /// `GL_VERSION`.
    pub version: String,
    /// `GL_SHADING_LANGUAGE_VERSION`.
    pub shading_language: String,
    /// Whether the renderer is known to run on the CPU.
    pub software: bool,
    /// Samples a pixel, at most.
    pub max_samples: u32,
}

impl HeadlessContext {
    /// Makes a context on the first device that gives one and makes it current on this thread.
    ///
    /// # Errors
    /// [`HostError::NoOpenGl`] says what each device answered.
    pub fn new(api: Api) -> Result<Self, HostError> {
        let devices = Device::query_devices().map_err(|e| {
            HostError::NoOpenGl(format!("no EGL devices ({e}); install libegl1 and libgl1-mesa-dri"))
        })?;
        let mut answers = Vec::new();
        for device in devices {
            match Self::on_device(&device, api) {
                Ok(context) => return Ok(context),
                Err(e) => answers.push(format!("{}: {e}", device.name().unwrap_or("device"))),
            }
        }
        if answers.is_empty() {
            answers.push("no EGL device; install libegl1 and libgl1-mesa-dri".into());
        }
        Err(HostError::NoOpenGl(answers.join("; ")))
    }

    fn on_device(device: &Device, api: Api) -> Result<Self, glutin::error::Error> {
        let template = ConfigTemplateBuilder::new()
            .with_api(match api {
                Api::Gl33 => glutin::config::Api::OPENGL,
                Api::Gles30 => glutin::config::Api::GLES3,
            })
            .with_surface_type(ConfigSurfaceTypes::empty())
            .build();
        let attributes = ContextAttributesBuilder::new()
            .with_profile(GlProfile::Core)
            .with_context_api(match api {
                Api::Gl33 => ContextApi::OpenGl(Some(Version::new(3, 3))),
                Api::Gles30 => ContextApi::Gles(Some(Version::new(3, 0))),
            })
            .build(None);
        // SAFETY: no native display handle is passed; the config comes from the same display.
        unsafe {
            let display = Display::with_device(device, None)?;
            let no_config = || glutin::error::Error::from(glutin::error::ErrorKind::BadConfig);
            let config = display.find_configs(template)?.next().ok_or_else(no_config)?;
            let context = display.create_context(&config, &attributes)?.make_current_surfaceless()?;
            let gl = glow::Context::from_loader_function_cstr(|name| display.get_proc_address(name));
            Ok(Self { gl: Arc::new(gl), _context: PossiblyCurrentContext::Egl(context), display })
        }
    }

    /// The context's functions.
    pub fn gl(&self) -> &Arc<glow::Context> {
        &self.gl
    }

    /// A function of OpenGL, as hosts with bindings of their own load them; null for one that there is not.
    pub fn get_proc_address(&self, name: &CStr) -> *const c_void {
        self.display.get_proc_address(name)
    }

    /// What the driver says of itself.
    pub fn info(&self) -> ContextInfo {
        ContextInfo::query(&self.gl)
    }
}

impl ContextInfo {
    /// Asks a context.
    pub fn query(gl: &glow::Context) -> Self {
        // SAFETY: strings and limits that every context has.
        unsafe {
            let text = |name| gl.get_parameter_string(name);
            let renderer = text(glow::RENDERER);
            let software = ["llvmpipe", "softpipe", "SwiftShader"].iter().any(|name| renderer.contains(name));
            Self {
                vendor: text(glow::VENDOR),
                version: text(glow::VERSION),
                shading_language: text(glow::SHADING_LANGUAGE_VERSION),
                software,
                renderer,
                max_samples: gl.get_parameter_i32(glow::MAX_SAMPLES).max(1) as u32,
            }
        }
    }
}
