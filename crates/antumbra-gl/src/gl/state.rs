//! The host's OpenGL state: read before and put back after, or left as in a new context.

mod blend;
mod raster;

pub(crate) use blend::Blend;
pub(crate) use raster::RasterGuard;

use super::Caps;
use crate::input::HostState;
use glow::HasContext;

/// Texture units that antumbra uses; it binds nothing to others.
const UNITS: usize = 5;

/// A switch that antumbra sets.
struct Switch {
    name: u32,
    /// The value antumbra wants.
    wanted: bool,
    /// That of a new context.
    new: bool,
    /// Whether it is of desktop OpenGL only.
    desktop: bool,
}

const fn off(name: u32) -> Switch {
    Switch { name, wanted: false, new: false, desktop: false }
}

const fn desktop(switch: Switch) -> Switch {
    Switch { desktop: true, ..switch }
}

const SWITCHES: [Switch; 14] = [
    off(glow::DEPTH_TEST),
    off(glow::STENCIL_TEST),
    off(glow::SCISSOR_TEST),
    off(glow::CULL_FACE),
    Switch { new: true, ..off(glow::DITHER) },
    off(glow::RASTERIZER_DISCARD),
    off(glow::SAMPLE_ALPHA_TO_COVERAGE),
    off(glow::SAMPLE_COVERAGE),
    desktop(off(glow::SAMPLE_ALPHA_TO_ONE)),
    desktop(off(glow::SAMPLE_MASK)),
    desktop(off(glow::COLOR_LOGIC_OP)),
    desktop(off(glow::POLYGON_SMOOTH)),
    desktop(off(glow::PRIMITIVE_RESTART)), // the index that restarts may be one of a mesh
    desktop(Switch { wanted: true, new: true, ..off(glow::MULTISAMPLE) }),
];

/// How texels are read from memory: as in a new context, whose value it is. And whether it is of desktop OpenGL only.
const UNPACK: &[(u32, i32, bool)] = &[
    (glow::UNPACK_ALIGNMENT, 4, false),
    (glow::UNPACK_ROW_LENGTH, 0, false),
    (glow::UNPACK_IMAGE_HEIGHT, 0, false),
    (glow::UNPACK_SKIP_ROWS, 0, false),
    (glow::UNPACK_SKIP_PIXELS, 0, false),
    (glow::UNPACK_SKIP_IMAGES, 0, false),
    (glow::UNPACK_SWAP_BYTES, 0, true),
    (glow::UNPACK_LSB_FIRST, 0, true),
    #[cfg(target_arch = "wasm32")]
    (0x9240, 0, false), // UNPACK_FLIP_Y_WEBGL
    #[cfg(target_arch = "wasm32")]
    (0x9241, 0, false), // UNPACK_PREMULTIPLY_ALPHA_WEBGL
    #[cfg(target_arch = "wasm32")]
    (0x9243, 0x9244, false), // UNPACK_COLORSPACE_CONVERSION_WEBGL, BROWSER_DEFAULT_WEBGL
];

const CLIP_DISTANCES: u32 = 8;

/// Blending of draw buffer 0: functions as source and destination of RGB, then of alpha.
#[derive(Clone, Copy)]
struct Blending {
    on: bool,
    function: [u32; 4],
    equation: [u32; 2],
}

/// Everything antumbra touches but objects that are bound.
struct Settings {
    viewport: Option<[i32; 4]>,
    active_texture: u32,
    switches: [bool; SWITCHES.len()],
    clip_distances: [bool; CLIP_DISTANCES as usize],
    unpack: [i32; UNPACK.len()],
    polygon_mode: [i32; 2],
    color_mask: [bool; 4],
    blending: Blending,
}

/// The objects that are bound where antumbra binds its own.
#[derive(Default)]
struct Bindings {
    program: Option<glow::Program>,
    vertex_array: Option<glow::VertexArray>,
    array_buffer: Option<glow::Buffer>,
    unpack_buffer: Option<glow::Buffer>,
    draw_framebuffer: Option<glow::Framebuffer>,
    read_framebuffer: Option<glow::Framebuffer>,
    units: [Unit; UNITS],
}

#[derive(Clone, Copy, Default)]
struct Unit {
    texture_2d: Option<glow::Texture>,
    multisample: Option<glow::Texture>,
    sampler: Option<glow::Sampler>,
}

/// While it lives the state is antumbra's: filled polygons, no tests, nothing unusual about texels. When it is dropped the
/// host's is put back, or that of a new context set, as [`HostState`] says.
pub(crate) struct StateGuard<'a> {
    gl: &'a glow::Context,
    caps: Caps,
    settings: Settings,
    bindings: Bindings,
}

impl<'a> StateGuard<'a> {
    pub(crate) fn new(gl: &'a glow::Context, caps: Caps, host: HostState) -> Self {
        // SAFETY: plain queries and settings of state that exists in the context's tier.
        unsafe {
            let (settings, bindings) = match host {
                #[cfg(not(target_arch = "wasm32"))]
                HostState::Restore => (Settings::read(gl, caps), Bindings::read(gl, caps)),
                HostState::Reset => (Settings::new(), Bindings::default()),
            };
            for unit in 0..UNITS as u32 {
                gl.bind_sampler(unit, None);
            }
            gl.bind_buffer(glow::PIXEL_UNPACK_BUFFER, None);
            for switch in SWITCHES.iter().filter(|switch| !switch.desktop || caps.is_desktop()) {
                set(gl, switch.name, switch.wanted);
            }
            if caps.is_desktop() {
                gl.polygon_mode(glow::FRONT_AND_BACK, glow::FILL);
                (0..CLIP_DISTANCES).for_each(|i| set(gl, glow::CLIP_DISTANCE0 + i, false));
            }
            for (parameter, wanted, desktop) in UNPACK {
                if !desktop || caps.is_desktop() {
                    gl.pixel_store_i32(*parameter, *wanted);
                }
            }
            set_color_mask(gl, caps, [true; 4]);
            Self { gl, caps, settings, bindings }
        }
    }

    /// Leaves this framebuffer bound for drawing and reading, where the host's bindings are not put back.
    pub(crate) fn leave_bound(&mut self, framebuffer: Option<glow::Framebuffer>, host: HostState) {
        if host == HostState::Reset {
            (self.bindings.draw_framebuffer, self.bindings.read_framebuffer) = (framebuffer, framebuffer);
        }
    }
}

impl Drop for StateGuard<'_> {
    fn drop(&mut self) {
        // SAFETY: values that were read from this context, or a new one's.
        unsafe {
            self.bindings.set(self.gl, self.caps);
            self.settings.set(self.gl, self.caps);
        }
    }
}

/// The framebuffer that is bound for drawing: in a browser, where that cannot be asked for, the canvas.
///
/// # Safety
/// The context is current.
pub(crate) unsafe fn bound_framebuffer(gl: &glow::Context) -> Option<glow::Framebuffer> {
    if cfg!(target_arch = "wasm32") {
        return None;
    }
    // SAFETY: the caller's.
    unsafe { gl.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING) }
}

impl Settings {
    /// Those of a new context.
    fn new() -> Self {
        Self {
            viewport: None,
            active_texture: glow::TEXTURE0,
            switches: std::array::from_fn(|i| SWITCHES[i].new),
            clip_distances: [false; CLIP_DISTANCES as usize],
            unpack: std::array::from_fn(|i| UNPACK[i].1),
            polygon_mode: [glow::FILL as i32; 2],
            color_mask: [true; 4],
            blending: Blending {
                on: false,
                function: [glow::ONE, glow::ZERO, glow::ONE, glow::ZERO],
                equation: [glow::FUNC_ADD; 2],
            },
        }
    }

    /// # Safety
    /// `caps` are the context's, which is current.
    #[cfg(not(target_arch = "wasm32"))]
    unsafe fn read(gl: &glow::Context, caps: Caps) -> Self {
        let mut found = Self::new();
        // SAFETY: the caller's; queries of state that exists in the context's tier.
        unsafe {
            let int = |name| gl.get_parameter_i32(name);
            found.active_texture = int(glow::ACTIVE_TEXTURE) as u32;
            let mut viewport = [0; 4];
            gl.get_parameter_i32_slice(glow::VIEWPORT, &mut viewport);
            found.viewport = Some(viewport);
            for (was, switch) in found.switches.iter_mut().zip(&SWITCHES) {
                if !switch.desktop || caps.is_desktop() {
                    *was = gl.is_enabled(switch.name);
                }
            }
            if caps.is_desktop() {
                gl.get_parameter_i32_slice(glow::POLYGON_MODE, &mut found.polygon_mode);
                for (i, was) in (0..).zip(&mut found.clip_distances) {
                    *was = gl.is_enabled(glow::CLIP_DISTANCE0 + i);
                }
            }
            for (was, (parameter, _, desktop)) in found.unpack.iter_mut().zip(UNPACK) {
                if !desktop || caps.is_desktop() {
                    *was = int(*parameter);
                }
            }
            // Queries without an index are of draw buffer 0, the only one antumbra writes.
            found.color_mask = gl.get_parameter_bool_array::<4>(glow::COLOR_WRITEMASK);
            let names =
                [glow::BLEND_SRC_RGB, glow::BLEND_DST_RGB, glow::BLEND_SRC_ALPHA, glow::BLEND_DST_ALPHA];
            found.blending = Blending {
                on: gl.is_enabled(glow::BLEND),
                function: names.map(|name| int(name) as u32),
                equation: [glow::BLEND_EQUATION_RGB, glow::BLEND_EQUATION_ALPHA].map(|name| int(name) as u32),
            };
        }
        found
    }

    /// # Safety
    /// `caps` are the context's, which is current, and the values are OpenGL's.
    unsafe fn set(&self, gl: &glow::Context, caps: Caps) {
        // SAFETY: the caller's.
        unsafe {
            gl.active_texture(self.active_texture);
            for (was, switch) in self.switches.iter().zip(&SWITCHES) {
                if !switch.desktop || caps.is_desktop() {
                    set(gl, switch.name, *was);
                }
            }
            if caps.is_desktop() {
                for (i, was) in (0..).zip(&self.clip_distances) {
                    set(gl, glow::CLIP_DISTANCE0 + i, *was);
                }
                // A core context has one mode for both faces; a compatibility context may have two.
                let [front, back] = self.polygon_mode.map(|mode| mode as u32);
                if back == front || back == 0 {
                    gl.polygon_mode(glow::FRONT_AND_BACK, front);
                } else {
                    gl.polygon_mode(glow::FRONT, front);
                    gl.polygon_mode(glow::BACK, back);
                }
            }
            for (was, (parameter, _, desktop)) in self.unpack.iter().zip(UNPACK) {
                if !desktop || caps.is_desktop() {
                    gl.pixel_store_i32(*parameter, *was);
                }
            }
            set_color_mask(gl, caps, self.color_mask);
            set_blending(gl, caps, self.blending);
            if let Some([x, y, width, height]) = self.viewport {
                gl.viewport(x, y, width, height);
            }
        }
    }
}

impl Bindings {
    /// # Safety
    /// `caps` are the context's, which is current.
    #[cfg(not(target_arch = "wasm32"))]
    unsafe fn read(gl: &glow::Context, caps: Caps) -> Self {
        // SAFETY: the caller's; the active unit is put back with the settings.
        unsafe {
            let mut units = [Unit::default(); UNITS];
            for (i, unit) in (0..).zip(&mut units) {
                gl.active_texture(glow::TEXTURE0 + i);
                unit.texture_2d = gl.get_parameter_texture(glow::TEXTURE_BINDING_2D);
                if caps.is_desktop() {
                    unit.multisample = gl.get_parameter_texture(glow::TEXTURE_BINDING_2D_MULTISAMPLE);
                }
                unit.sampler = gl.get_parameter_sampler(glow::SAMPLER_BINDING);
            }
            Self {
                program: gl.get_parameter_program(glow::CURRENT_PROGRAM),
                vertex_array: gl.get_parameter_vertex_array(glow::VERTEX_ARRAY_BINDING),
                array_buffer: gl.get_parameter_buffer(glow::ARRAY_BUFFER_BINDING),
                unpack_buffer: gl.get_parameter_buffer(glow::PIXEL_UNPACK_BUFFER_BINDING),
                draw_framebuffer: gl.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING),
                read_framebuffer: gl.get_parameter_framebuffer(glow::READ_FRAMEBUFFER_BINDING),
                units,
            }
        }
    }

    /// # Safety
    /// The objects are of this context, which is current.
    unsafe fn set(&self, gl: &glow::Context, caps: Caps) {
        // SAFETY: the caller's.
        unsafe {
            for (i, unit) in (0..).zip(&self.units) {
                gl.active_texture(glow::TEXTURE0 + i);
                // One that the host had bound may be a mask of a size that is no more.
                let alive = |texture: &glow::Texture| gl.is_texture(*texture);
                gl.bind_texture(glow::TEXTURE_2D, unit.texture_2d.filter(alive));
                if caps.is_desktop() {
                    gl.bind_texture(glow::TEXTURE_2D_MULTISAMPLE, unit.multisample.filter(alive));
                }
                gl.bind_sampler(i, unit.sampler);
            }
            gl.bind_buffer(glow::PIXEL_UNPACK_BUFFER, self.unpack_buffer);
            gl.use_program(self.program);
            gl.bind_vertex_array(self.vertex_array);
            gl.bind_buffer(glow::ARRAY_BUFFER, self.array_buffer);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, self.draw_framebuffer);
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, self.read_framebuffer);
        }
    }
}

/// # Safety
/// `switch` exists in the context.
unsafe fn set(gl: &glow::Context, switch: u32, on: bool) {
    // SAFETY: the caller's.
    unsafe { if on { gl.enable(switch) } else { gl.disable(switch) } }
}

/// The write mask of draw buffer 0.
///
/// # Safety
/// `caps` are the context's.
pub(crate) unsafe fn set_color_mask(gl: &glow::Context, caps: Caps, [r, g, b, a]: [bool; 4]) {
    // SAFETY: the indexed mask exists.
    unsafe {
        if caps.indexed_switches {
            gl.color_mask_draw_buffer(0, r, g, b, a);
        } else {
            gl.color_mask(r, g, b, a);
        }
    }
}

/// # Safety
/// `caps` are the context's, the values are OpenGL's.
unsafe fn set_blending(gl: &glow::Context, caps: Caps, blending: Blending) {
    let Blending { on, function: [src_rgb, dst_rgb, src_alpha, dst_alpha], equation } = blending;
    // SAFETY: the indexed switches and functions exist.
    unsafe {
        match (caps.indexed_switches, on) {
            (true, true) => gl.enable_draw_buffer(glow::BLEND, 0),
            (true, false) => gl.disable_draw_buffer(glow::BLEND, 0),
            (false, _) => set(gl, glow::BLEND, on),
        }
        if caps.indexed_blend {
            gl.blend_func_separate_draw_buffer(0, src_rgb, dst_rgb, src_alpha, dst_alpha);
            gl.blend_equation_separate_draw_buffer(0, equation[0], equation[1]);
        } else {
            gl.blend_func_separate(src_rgb, dst_rgb, src_alpha, dst_alpha);
            gl.blend_equation_separate(equation[0], equation[1]);
        }
    }
}
