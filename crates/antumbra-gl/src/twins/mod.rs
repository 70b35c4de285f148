//! The functions of the shaders in Rust, and that both are the same.
//!
//! What the library itself computes is its own twin: these call it. What only shaders compute has its twin here.

mod blockers;
mod composite;
mod covered;
mod lights;
pub(crate) mod map;
mod random;
pub(crate) mod samples;
mod soft;
mod soft_light;
mod surface;
mod union;

use antumbra_host::{Api, TestContext, link_program};
use bytemuck::Zeroable;
use glam::Vec4;
use glow::{HasContext, PixelPackData, PixelUnpackData};

const COVERAGE: &str = include_str!("../shaders/coverage.glsl");
const SURFACE: &str = include_str!("../shaders/surface.glsl");
const AREA: &str = include_str!("../shaders/area.glsl");
const LIGHTS: &str = include_str!("../shaders/lights.glsl");
const SOFT: &str = include_str!("../shaders/analytic/soft.glsl");

/// Calls side by side in a row of the target.
const ROW: usize = 64;

/// Runs a test in OpenGL and in OpenGL ES.
fn in_each_api(test: impl Fn(&glow::Context)) {
    for api in [Api::Gl33, Api::Gles30] {
        let Some(context) = TestContext::new(api) else { continue };
        test(context.gl());
        // SAFETY: asks for the error flag.
        assert_eq!(unsafe { context.gl().get_error() }, glow::NO_ERROR, "{api:?}");
    }
}

/// Runs `body`, which reads `INPUT(0)` to `INPUT(K - 1)` and writes `o_out`, on each of `inputs`.
fn on_gpu<const K: usize>(gl: &glow::Context, parts: &[&str], body: &str, inputs: &[[Vec4; K]]) -> Vec<Vec4> {
    let prelude = format!(
        "uniform highp sampler2D u_in;\n#define K {K}\n\
         #define INPUT(k) texelFetch(u_in, ivec2(int(gl_FragCoord.x) * K + (k), int(gl_FragCoord.y)), 0)\n\
         vec4 blocker[5];\n#define BLOCKER_DATA blocker\nlayout(location = 0) out vec4 o_out;\n"
    );
    let vertex = "void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }";
    let fragment = format!("{prelude}{}\nvoid main() {{ {body} }}\n", parts.concat());
    let rows = inputs.len().div_ceil(ROW);
    let mut texels = inputs.to_vec();
    texels.resize(rows * ROW, [Vec4::ZERO; K]);
    let size = [ROW as i32, rows as i32];
    let mut results = vec![Vec4::zeroed(); rows * ROW];
    // SAFETY: objects are made, used and deleted in this context; memory has the sizes that are told.
    unsafe {
        let program = link_program(gl, vertex, &fragment).unwrap_or_else(|e| panic!("{e}\n{fragment}"));
        let input = texture(gl, [size[0] * K as i32, size[1]], Some(texels.as_flattened()));
        let output = texture(gl, size, None);
        let framebuffer = gl.create_framebuffer().expect("a framebuffer");
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        let attachment = glow::COLOR_ATTACHMENT0;
        gl.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, Some(output), 0);
        let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
        assert_eq!(status, glow::FRAMEBUFFER_COMPLETE, "results come out in a texture of floats");
        let vertex_array = gl.create_vertex_array().expect("a vertex array");
        gl.bind_vertex_array(Some(vertex_array));
        gl.use_program(Some(program));
        gl.bind_texture(glow::TEXTURE_2D, Some(input));
        gl.uniform_1_i32(gl.get_uniform_location(program, "u_in").as_ref(), 0);
        gl.viewport(0, 0, size[0], size[1]);
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        let bytes = PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut results)));
        gl.read_pixels(0, 0, size[0], size[1], glow::RGBA, glow::FLOAT, bytes);
        gl.use_program(None);
        gl.bind_vertex_array(None);
        gl.delete_vertex_array(vertex_array);
        gl.delete_framebuffer(framebuffer);
        gl.delete_program(program);
        gl.delete_texture(input);
        gl.delete_texture(output);
    }
    results.truncate(inputs.len());
    results
}

/// A texture of float32.
///
/// # Safety
/// The texels, if there are any, are as many as the size says.
unsafe fn texture(gl: &glow::Context, [width, height]: [i32; 2], texels: Option<&[Vec4]>) -> glow::Texture {
    // SAFETY: the caller's.
    unsafe {
        let texture = gl.create_texture().expect("a texture");
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        let (target, format) = (glow::TEXTURE_2D, glow::RGBA32F as i32);
        let data = PixelUnpackData::Slice(texels.map(bytemuck::cast_slice));
        gl.tex_image_2d(target, 0, format, width, height, 0, glow::RGBA, glow::FLOAT, data);
        for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(target, name, glow::NEAREST as i32);
        }
        texture
    }
}

/// Asserts that numbers agree within `close` but for a fraction `over`. A number that is none on the
/// CPU is none, or nothing, on the GPU.
fn assert_equal(what: &str, gpu: &[f32], cpu: &[f32], close: f32, over: f64) {
    assert_eq!(gpu.len(), cpu.len(), "a result a call");
    let same = |g: f32, c: f32| (g - c).abs() <= close || g == c || (c.is_nan() && !(g > 0.0));
    let off: Vec<_> = gpu.iter().zip(cpu).enumerate().filter(|(_, (g, c))| !same(**g, **c)).collect();
    let between = cpu.iter().filter(|c| **c > 0.0 && **c < 1.0).count();
    eprintln!("{what}: {} of {} off, {between} partial", off.len(), cpu.len());
    assert!(between * 20 > cpu.len(), "{what}: {between} results of {} are between 0 and 1", cpu.len());
    let allowed = (cpu.len() as f64 * over) as usize;
    assert!(
        off.len() <= allowed,
        "{what}: {} of {} differ: {:?}",
        off.len(),
        cpu.len(),
        &off[..off.len().min(5)]
    );
}

/// Asserts that vectors agree to `close` of their length or of `unit`, all of them.
fn assert_vectors(what: &str, gpu: &[Vec4], cpu: &[Vec4], close: f32, unit: f32) {
    assert_eq!(gpu.len(), cpu.len(), "{what}: a result a call");
    let off = |g: &Vec4, c: &Vec4| !((*g - *c).length() <= close * c.length().max(unit));
    let wrong: Vec<_> = gpu.iter().zip(cpu).enumerate().filter(|(_, (g, c))| off(g, c)).collect();
    eprintln!("{what}: {} of {} off", wrong.len(), cpu.len());
    assert!(wrong.is_empty(), "{what}: {} differ: {:?}", wrong.len(), &wrong[..wrong.len().min(5)]);
}
