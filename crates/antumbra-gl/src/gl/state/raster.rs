//! Depth, stencil and the like: state that only some techniques set.

use crate::input::HostState;
use glow::HasContext;

/// Switches that are off between passes, and may be switched on under a [`RasterGuard`].
const SWITCHES: [u32; 5] =
    [glow::DEPTH_TEST, glow::STENCIL_TEST, glow::SCISSOR_TEST, glow::CULL_FACE, glow::POLYGON_OFFSET_FILL];

/// The stencil test of one face.
#[derive(Clone, Copy)]
struct StencilFace {
    func: u32,
    reference: i32,
    value_mask: u32,
    write_mask: u32,
    ops: [u32; 3],
}

/// The names of a face's values, in the order of the struct.
#[cfg(not(target_arch = "wasm32"))]
const STENCIL_NAMES: [[u32; 7]; 2] = [
    [
        glow::STENCIL_FUNC,
        glow::STENCIL_REF,
        glow::STENCIL_VALUE_MASK,
        glow::STENCIL_WRITEMASK,
        glow::STENCIL_FAIL,
        glow::STENCIL_PASS_DEPTH_FAIL,
        glow::STENCIL_PASS_DEPTH_PASS,
    ],
    [
        glow::STENCIL_BACK_FUNC,
        glow::STENCIL_BACK_REF,
        glow::STENCIL_BACK_VALUE_MASK,
        glow::STENCIL_BACK_WRITEMASK,
        glow::STENCIL_BACK_FAIL,
        glow::STENCIL_BACK_PASS_DEPTH_FAIL,
        glow::STENCIL_BACK_PASS_DEPTH_PASS,
    ],
];

/// The values of all that a technique may set.
struct Raster {
    depth_func: u32,
    depth_mask: bool,
    depth_range: [f32; 2],
    stencil: [StencilFace; 2],
    cull_face: u32,
    front_face: u32,
    polygon_offset: [f32; 2],
    polygon_offset_fill: bool,
    /// Unknown of a new context: as large as the window.
    scissor: Option<[i32; 4]>,
}

/// The state of the depth, stencil and scissor tests, of culling and of polygon offset: under it a technique may set
/// any of these, and the switches; when it is dropped the switches are off and the rest is the host's again, or a new
/// context's, as [`HostState`] says. Lives inside a [`super::StateGuard`]. In the beginning all is as in a new context: the
/// depth test passes nearer fragments and writes, depth runs from 0 to 1, the stencil test passes and writes all bits,
/// counter-clockwise faces are front faces and back faces are culled.
pub(crate) struct RasterGuard<'a> {
    gl: &'a glow::Context,
    found: Raster,
}

impl<'a> RasterGuard<'a> {
    /// # Safety
    /// A [`super::StateGuard`] is alive, and outlives this one.
    pub(crate) unsafe fn new(gl: &'a glow::Context, host: HostState) -> Self {
        // SAFETY: the caller's.
        unsafe {
            let found = match host {
                #[cfg(not(target_arch = "wasm32"))]
                HostState::Restore => Raster::read(gl),
                HostState::Reset => Raster::new(),
            };
            Raster::new().set(gl);
            Self { gl, found }
        }
    }
}

impl Drop for RasterGuard<'_> {
    fn drop(&mut self) {
        // SAFETY: values that were read from this context, or a new one's; the switches are off outside this guard but
        // for the one that is among the values.
        unsafe {
            SWITCHES.iter().for_each(|&switch| self.gl.disable(switch));
            self.found.set(self.gl);
        }
    }
}

impl Raster {
    /// As in a new context.
    fn new() -> Self {
        let face = StencilFace {
            func: glow::ALWAYS,
            reference: 0,
            value_mask: u32::MAX,
            write_mask: u32::MAX,
            ops: [glow::KEEP; 3],
        };
        Self {
            depth_func: glow::LESS,
            depth_mask: true,
            depth_range: [0.0, 1.0],
            stencil: [face; 2],
            cull_face: glow::BACK,
            front_face: glow::CCW,
            polygon_offset: [0.0; 2],
            polygon_offset_fill: false,
            scissor: None,
        }
    }

    /// # Safety
    /// The context is current.
    #[cfg(not(target_arch = "wasm32"))]
    unsafe fn read(gl: &glow::Context) -> Self {
        // SAFETY: the caller's; queries of state that exists in every tier.
        unsafe {
            let int = |name| gl.get_parameter_i32(name);
            let face =
                |[func, reference, value_mask, write_mask, fail, depth_fail, pass]: [u32; 7]| StencilFace {
                    func: int(func) as u32,
                    reference: int(reference),
                    value_mask: int(value_mask) as u32,
                    write_mask: int(write_mask) as u32,
                    ops: [fail, depth_fail, pass].map(|op| int(op) as u32),
                };
            let mut scissor = [0; 4];
            gl.get_parameter_i32_slice(glow::SCISSOR_BOX, &mut scissor);
            let mut depth_range = [0.0; 2];
            gl.get_parameter_f32_slice(glow::DEPTH_RANGE, &mut depth_range);
            Self {
                depth_func: int(glow::DEPTH_FUNC) as u32,
                depth_mask: gl.get_parameter_bool(glow::DEPTH_WRITEMASK),
                depth_range,
                stencil: STENCIL_NAMES.map(face),
                cull_face: int(glow::CULL_FACE_MODE) as u32,
                front_face: int(glow::FRONT_FACE) as u32,
                polygon_offset: [glow::POLYGON_OFFSET_FACTOR, glow::POLYGON_OFFSET_UNITS]
                    .map(|name| gl.get_parameter_f32(name)),
                polygon_offset_fill: gl.is_enabled(glow::POLYGON_OFFSET_FILL),
                scissor: Some(scissor),
            }
        }
    }

    /// # Safety
    /// The context is current, and the values are OpenGL's.
    unsafe fn set(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            super::set(gl, glow::POLYGON_OFFSET_FILL, self.polygon_offset_fill);
            gl.depth_func(self.depth_func);
            gl.depth_mask(self.depth_mask);
            gl.depth_range_f32(self.depth_range[0], self.depth_range[1]);
            for (face, s) in [glow::FRONT, glow::BACK].into_iter().zip(self.stencil) {
                gl.stencil_func_separate(face, s.func, s.reference, s.value_mask);
                gl.stencil_mask_separate(face, s.write_mask);
                gl.stencil_op_separate(face, s.ops[0], s.ops[1], s.ops[2]);
            }
            gl.cull_face(self.cull_face);
            gl.front_face(self.front_face);
            gl.polygon_offset(self.polygon_offset[0], self.polygon_offset[1]);
            if let Some([x, y, width, height]) = self.scissor {
                gl.scissor(x, y, width, height);
            }
        }
    }
}
