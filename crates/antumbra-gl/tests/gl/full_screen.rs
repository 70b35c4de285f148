//! One triangle over the whole of a target.

use antumbra_host::link_program;
use glow::HasContext;

const VERTEX: &str = "void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }";

/// The program of a fragment shader without its version line.
pub(crate) fn program(gl: &glow::Context, fragment: &str) -> glow::Program {
    link_program(gl, VERTEX, fragment).unwrap_or_else(|error| panic!("{error}\n{fragment}"))
}

/// Draws with the program that is used, into all of the framebuffer, and leaves it bound.
///
/// # Safety
/// A program of [`program`] with its uniforms is used; the framebuffer is complete and of this size.
pub(crate) unsafe fn draw(gl: &glow::Context, framebuffer: glow::Framebuffer, size: [i32; 2]) {
    // SAFETY: the caller's; the vertex array is deleted again.
    unsafe {
        let vertex_array = gl.create_vertex_array().expect("a vertex array");
        gl.bind_vertex_array(Some(vertex_array));
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        gl.viewport(0, 0, size[0], size[1]);
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        gl.delete_vertex_array(vertex_array);
    }
}

/// A framebuffer around a colour texture.
///
/// # Safety
/// The texture is of this context and can be drawn into.
pub(crate) unsafe fn framebuffer(gl: &glow::Context, color: glow::Texture) -> glow::Framebuffer {
    // SAFETY: the caller's.
    unsafe {
        let framebuffer = gl.create_framebuffer().expect("a framebuffer");
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        let attachment = glow::COLOR_ATTACHMENT0;
        gl.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, Some(color), 0);
        framebuffer
    }
}
