//! Leaves every piece of OpenGL state as it was found.

mod blend;
mod raster;

pub(crate) use blend::Blend;
pub(crate) use raster::RasterGuard;

use super::Caps;
use glow::HasContext;

/// Texture units that antumbra uses; it binds nothing to others.
pub(crate) const UNITS: usize = 5;

/// The switches that antumbra sets, with the value it wants.
const SWITCHES: [(u32, bool, bool); 14] = [
    // (switch, wanted, desktop OpenGL only)
    (glow::DEPTH_TEST, false, false),
    (glow::STENCIL_TEST, false, false),
    (glow::SCISSOR_TEST, false, false),
    (glow::CULL_FACE, false, false),
    (glow::DITHER, false, false),
    (glow::RASTERIZER_DISCARD, false, false),
    (glow::SAMPLE_ALPHA_TO_COVERAGE, false, false),
    (glow::SAMPLE_COVERAGE, false, false),
    (glow::SAMPLE_ALPHA_TO_ONE, false, true),
    (glow::SAMPLE_MASK, false, true),
    (glow::COLOR_LOGIC_OP, false, true),
    (glow::POLYGON_SMOOTH, false, true),
    (glow::PRIMITIVE_RESTART, false, true), // the index that restarts may be one of a mesh
    (glow::MULTISAMPLE, true, true),
];

/// How texels are read from memory, with the values antumbra wants.
const UNPACK: [(u32, i32, bool); 7] = [
    // (parameter, wanted, desktop OpenGL only)
    (glow::UNPACK_ALIGNMENT, 4, false),
    (glow::UNPACK_ROW_LENGTH, 0, false),
    (glow::UNPACK_SKIP_ROWS, 0, false),
    (glow::UNPACK_SKIP_PIXELS, 0, false),
    (glow::UNPACK_SKIP_IMAGES, 0, false),
    (glow::UNPACK_SWAP_BYTES, 0, true),
    (glow::UNPACK_LSB_FIRST, 0, true),
];

const CLIP_DISTANCES: u32 = 8;

#[derive(Clone, Copy, Default)]
struct Unit {
    texture_2d: Option<glow::Texture>,
    multisample: Option<glow::Texture>,
    sampler: Option<glow::Sampler>,
}

/// Everything antumbra touches, read on creation and put back when dropped.
pub(crate) struct StateGuard<'a> {
    gl: &'a glow::Context,
    caps: Caps,
    program: Option<glow::Program>,
    vertex_array: Option<glow::VertexArray>,
    array_buffer: Option<glow::Buffer>,
    unpack_buffer: Option<glow::Buffer>,
    draw_framebuffer: Option<glow::Framebuffer>,
    read_framebuffer: Option<glow::Framebuffer>,
    viewport: [i32; 4],
    active_texture: u32,
    units: [Unit; UNITS],
    switches: [bool; SWITCHES.len()],
    clip_distances: [bool; CLIP_DISTANCES as usize],
    unpack: [i32; UNPACK.len()],
    polygon_mode: [i32; 2],
    blend: bool,
    color_mask: [bool; 4],
    blend_function: [u32; 4],
    blend_equation: [u32; 2],
}

impl<'a> StateGuard<'a> {
    /// Reads the state and sets what every pass of antumbra wants: fill polygons, no tests.
    pub(crate) fn new(gl: &'a glow::Context, caps: Caps) -> Self {
        // SAFETY: plain queries and settings of state that exists in the context's tier.
        unsafe {
            let int = |name| gl.get_parameter_i32(name);
            let active_texture = int(glow::ACTIVE_TEXTURE) as u32;
            let mut units = [Unit::default(); UNITS];
            for (i, unit) in units.iter_mut().enumerate() {
                gl.active_texture(glow::TEXTURE0 + i as u32);
                unit.texture_2d = gl.get_parameter_texture(glow::TEXTURE_BINDING_2D);
                if caps.is_desktop() {
                    unit.multisample = gl.get_parameter_texture(glow::TEXTURE_BINDING_2D_MULTISAMPLE);
                }
                unit.sampler = gl.get_parameter_sampler(glow::SAMPLER_BINDING);
                gl.bind_sampler(i as u32, None);
            }
            let mut viewport = [0; 4];
            gl.get_parameter_i32_slice(glow::VIEWPORT, &mut viewport);
            let mut polygon_mode = [glow::FILL as i32; 2];
            if caps.is_desktop() {
                gl.get_parameter_i32_slice(glow::POLYGON_MODE, &mut polygon_mode);
                gl.polygon_mode(glow::FRONT_AND_BACK, glow::FILL);
            }
            let mut switches = [false; SWITCHES.len()];
            for (was, (switch, wanted, desktop)) in switches.iter_mut().zip(SWITCHES) {
                if !desktop || caps.is_desktop() {
                    *was = gl.is_enabled(switch);
                    set(gl, switch, wanted);
                }
            }
            let mut clip_distances = [false; CLIP_DISTANCES as usize];
            if caps.is_desktop() {
                for (i, was) in clip_distances.iter_mut().enumerate() {
                    *was = gl.is_enabled(glow::CLIP_DISTANCE0 + i as u32);
                    set(gl, glow::CLIP_DISTANCE0 + i as u32, false);
                }
            }
            let mut unpack = [0; UNPACK.len()];
            for (was, (parameter, wanted, desktop)) in unpack.iter_mut().zip(UNPACK) {
                if !desktop || caps.is_desktop() {
                    *was = int(parameter);
                    gl.pixel_store_i32(parameter, wanted);
                }
            }
            let unpack_buffer = gl.get_parameter_buffer(glow::PIXEL_UNPACK_BUFFER_BINDING);
            gl.bind_buffer(glow::PIXEL_UNPACK_BUFFER, None);
            // Queries without an index are of draw buffer 0, the only one antumbra writes.
            let color_mask = gl.get_parameter_bool_array::<4>(glow::COLOR_WRITEMASK);
            let blend_function =
                [glow::BLEND_SRC_RGB, glow::BLEND_DST_RGB, glow::BLEND_SRC_ALPHA, glow::BLEND_DST_ALPHA]
                    .map(|name| int(name) as u32);
            let blend_equation =
                [glow::BLEND_EQUATION_RGB, glow::BLEND_EQUATION_ALPHA].map(|name| int(name) as u32);
            let blend = gl.is_enabled(glow::BLEND);
            set_color_mask(gl, caps, [true; 4]);
            Self {
                gl,
                caps,
                program: gl.get_parameter_program(glow::CURRENT_PROGRAM),
                vertex_array: gl.get_parameter_vertex_array(glow::VERTEX_ARRAY_BINDING),
                array_buffer: gl.get_parameter_buffer(glow::ARRAY_BUFFER_BINDING),
                unpack_buffer,
                draw_framebuffer: gl.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING),
                read_framebuffer: gl.get_parameter_framebuffer(glow::READ_FRAMEBUFFER_BINDING),
                viewport,
                active_texture,
                units,
                switches,
                clip_distances,
                unpack,
                polygon_mode,
                blend,
                color_mask,
                blend_function,
                blend_equation,
            }
        }
    }

    /// The framebuffer the host had bound for drawing.
    pub(crate) fn host_framebuffer(&self) -> Option<glow::Framebuffer> {
        self.draw_framebuffer
    }
}

impl Drop for StateGuard<'_> {
    fn drop(&mut self) {
        let gl = self.gl;
        // SAFETY: puts back values that were read from this context.
        unsafe {
            for (i, unit) in self.units.iter().enumerate() {
                gl.active_texture(glow::TEXTURE0 + i as u32);
                gl.bind_texture(glow::TEXTURE_2D, unit.texture_2d);
                if self.caps.is_desktop() {
                    gl.bind_texture(glow::TEXTURE_2D_MULTISAMPLE, unit.multisample);
                }
                gl.bind_sampler(i as u32, unit.sampler);
            }
            gl.active_texture(self.active_texture);
            for (was, (switch, _, desktop)) in self.switches.iter().zip(SWITCHES) {
                if !desktop || self.caps.is_desktop() {
                    set(gl, switch, *was);
                }
            }
            if self.caps.is_desktop() {
                for (i, was) in self.clip_distances.iter().enumerate() {
                    set(gl, glow::CLIP_DISTANCE0 + i as u32, *was);
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
                if !desktop || self.caps.is_desktop() {
                    gl.pixel_store_i32(parameter, *was);
                }
            }
            gl.bind_buffer(glow::PIXEL_UNPACK_BUFFER, self.unpack_buffer);
            set_color_mask(gl, self.caps, self.color_mask);
            set_blending(gl, self.caps, self.blend, self.blend_function, self.blend_equation);
            gl.use_program(self.program);
            gl.bind_vertex_array(self.vertex_array);
            gl.bind_buffer(glow::ARRAY_BUFFER, self.array_buffer);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, self.draw_framebuffer);
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, self.read_framebuffer);
            let [x, y, width, height] = self.viewport;
            gl.viewport(x, y, width, height);
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

/// Blending of draw buffer 0: functions as source and destination of RGB, then of alpha.
///
/// # Safety
/// `caps` are the context's, the values are OpenGL's.
unsafe fn set_blending(gl: &glow::Context, caps: Caps, on: bool, function: [u32; 4], equation: [u32; 2]) {
    let [src_rgb, dst_rgb, src_alpha, dst_alpha] = function;
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
