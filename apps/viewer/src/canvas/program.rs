//! Small shader programs of the viewer's own.

use antumbra_host::HostError;
use glow::HasContext;

/// A linked program.
pub(crate) struct Program {
    pub(crate) raw: glow::Program,
}

impl Program {
    /// Compiles and links a program; the version line and precisions are put before both shaders.
    ///
    /// # Errors
    /// [`HostError::Driver`] with the compiler's words.
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn new(gl: &glow::Context, vertex: &str, fragment: &str) -> Result<Self, HostError> {
        let header = match gl.version().is_embedded {
            true => "#version 300 es\nprecision highp float;\nprecision highp int;\n",
            false => "#version 330 core\n",
        };
        // SAFETY: the caller's; objects are deleted on the way out if they are of no use.
        unsafe {
            let program = gl.create_program().map_err(HostError::Driver)?;
            let mut shaders = Vec::new();
            let mut failure = None;
            for (kind, source) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
                let shader = match gl.create_shader(kind) {
                    Ok(shader) => shader,
                    Err(error) => {
                        failure = Some(error);
                        break;
                    }
                };
                gl.shader_source(shader, &format!("{header}{source}"));
                gl.compile_shader(shader);
                gl.attach_shader(program, shader);
                shaders.push(shader);
                if !gl.get_shader_compile_status(shader) {
                    failure = Some(gl.get_shader_info_log(shader));
                }
            }
            if failure.is_none() {
                gl.link_program(program);
                if !gl.get_program_link_status(program) {
                    failure = Some(gl.get_program_info_log(program));
                }
            }
            for shader in shaders {
                gl.detach_shader(program, shader);
                gl.delete_shader(shader);
            }
            match failure {
                None => Ok(Self { raw: program }),
                Some(log) => {
                    gl.delete_program(program);
                    Err(HostError::Driver(format!("a shader of the viewer: {log}")))
                }
            }
        }
    }

    /// Where a uniform is.
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn uniform(&self, gl: &glow::Context, name: &str) -> Option<glow::UniformLocation> {
        // SAFETY: the caller's.
        unsafe { gl.get_uniform_location(self.raw, name) }
    }
}
