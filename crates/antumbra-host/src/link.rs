//! Shader programs, as every host compiles them.

use crate::HostError;
use glow::HasContext;

/// Compiles and links a vertex and a fragment shader. The version line of the context, and for OpenGL ES precisions, are put
/// before both.
///
/// # Errors
/// [`HostError::Driver`] with the compiler's words; nothing is left behind.
pub fn link_program(gl: &glow::Context, vertex: &str, fragment: &str) -> Result<glow::Program, HostError> {
    let header = match gl.version().is_embedded {
        true => "#version 300 es\nprecision highp float;\nprecision highp int;\n",
        false => "#version 330 core\n",
    };
    // SAFETY: objects are made, used and deleted in this context.
    unsafe {
        let program = gl.create_program().map_err(HostError::Driver)?;
        let failed = |log: String| {
            gl.delete_program(program);
            Err(HostError::Driver(log))
        };
        for (kind, source) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
            let shader = match gl.create_shader(kind) {
                Ok(shader) => shader,
                Err(error) => return failed(error),
            };
            gl.shader_source(shader, &format!("{header}{source}"));
            gl.compile_shader(shader);
            let (compiled, log) = (gl.get_shader_compile_status(shader), gl.get_shader_info_log(shader));
            gl.attach_shader(program, shader);
            gl.delete_shader(shader); // lives on while it is attached
            if !compiled {
                return failed(log);
            }
        }
        gl.link_program(program);
        if !gl.get_program_link_status(program) {
            return failed(gl.get_program_info_log(program));
        }
        Ok(program)
    }
}
