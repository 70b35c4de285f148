//! Depth, stencil and the like: state that only some techniques set.

use glow::HasContext;

/// Switches that are off between passes, and may be switched on under a [`RasterGuard`].
const SWITCHES: [u32; 5] =
    [glow::DEPTH_TEST, glow::STENCIL_TEST, glow::SCISSOR_TEST, glow::CULL_FACE, glow::POLYGON_OFFSET_FILL];

/// The stencil test of one face.
#[derive(Clone, Copy, Default)]
struct StencilFace {
    func: u32,
    reference: i32,
    value_mask: u32,
    write_mask: u32,
    ops: [u32; 3],
}

/// The state of the depth, stencil and scissor tests, of culling and of polygon offset: read on creation, put
/// back when dropped, with the switches off. Lives inside a [`super::StateGuard`]. Under it a technique may set
/// any of these; in the beginning the depth test passes nearer fragments and writes, depth runs from 0 to 1, the
/// stencil test passes and writes all bits, counter-clockwise faces are front faces and back faces are culled.
pub(crate) struct RasterGuard<'a> {
    gl: &'a glow::Context,
    depth_func: u32,
    depth_mask: bool,
    depth_range: [f32; 2],
    stencil: [StencilFace; 2],
    cull_face: u32,
    front_face: u32,
    polygon_offset: [f32; 2],
    polygon_offset_fill: bool,
    scissor: [i32; 4],
}

impl<'a> RasterGuard<'a> {
    /// Reads the state and sets the beginning's.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive, and outlives this one.
    pub(crate) unsafe fn new(gl: &'a glow::Context) -> Self {
        // SAFETY: plain queries and settings of state that exists in every tier.
        unsafe {
            let int = |name| gl.get_parameter_i32(name);
            let face = |names: [u32; 7]| {
                let [func, reference, value_mask, write_mask, fail, depth_fail, pass] = names;
                StencilFace {
                    func: int(func) as u32,
                    reference: int(reference),
                    value_mask: int(value_mask) as u32,
                    write_mask: int(write_mask) as u32,
                    ops: [fail, depth_fail, pass].map(|op| int(op) as u32),
                }
            };
            let mut scissor = [0; 4];
            gl.get_parameter_i32_slice(glow::SCISSOR_BOX, &mut scissor);
            let mut depth_range = [0.0; 2];
            gl.get_parameter_f32_slice(glow::DEPTH_RANGE, &mut depth_range);
            let guard = Self {
                gl,
                depth_func: int(glow::DEPTH_FUNC) as u32,
                depth_mask: gl.get_parameter_bool(glow::DEPTH_WRITEMASK),
                depth_range,
                stencil: [
                    face([
                        glow::STENCIL_FUNC,
                        glow::STENCIL_REF,
                        glow::STENCIL_VALUE_MASK,
                        glow::STENCIL_WRITEMASK,
                        glow::STENCIL_FAIL,
                        glow::STENCIL_PASS_DEPTH_FAIL,
                        glow::STENCIL_PASS_DEPTH_PASS,
                    ]),
                    face([
                        glow::STENCIL_BACK_FUNC,
                        glow::STENCIL_BACK_REF,
                        glow::STENCIL_BACK_VALUE_MASK,
                        glow::STENCIL_BACK_WRITEMASK,
                        glow::STENCIL_BACK_FAIL,
                        glow::STENCIL_BACK_PASS_DEPTH_FAIL,
                        glow::STENCIL_BACK_PASS_DEPTH_PASS,
                    ]),
                ],
                cull_face: int(glow::CULL_FACE_MODE) as u32,
                front_face: int(glow::FRONT_FACE) as u32,
                polygon_offset: [
                    gl.get_parameter_f32(glow::POLYGON_OFFSET_FACTOR),
                    gl.get_parameter_f32(glow::POLYGON_OFFSET_UNITS),
                ],
                polygon_offset_fill: gl.is_enabled(glow::POLYGON_OFFSET_FILL),
                scissor,
            };
            gl.disable(glow::POLYGON_OFFSET_FILL);
            gl.depth_func(glow::LESS);
            gl.depth_mask(true);
            gl.depth_range_f32(0.0, 1.0);
            gl.stencil_func(glow::ALWAYS, 0, u32::MAX);
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::KEEP);
            gl.stencil_mask(u32::MAX);
            gl.cull_face(glow::BACK);
            gl.front_face(glow::CCW);
            guard
        }
    }
}

impl Drop for RasterGuard<'_> {
    fn drop(&mut self) {
        let gl = self.gl;
        // SAFETY: puts back values that were read from this context; the switches are off outside this guard
        // but for the one that was read.
        unsafe {
            SWITCHES.iter().for_each(|&switch| gl.disable(switch));
            if self.polygon_offset_fill {
                gl.enable(glow::POLYGON_OFFSET_FILL);
            }
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
            let [x, y, width, height] = self.scissor;
            gl.scissor(x, y, width, height);
        }
    }
}
