//! A context from the functions that a host's loader finds.

use crate::input::Error;
use std::ffi::{CStr, c_char, c_void};

/// What antumbra calls of the functions that every context has which it runs in: glow panics at a call of one that was not
/// found. The first is called here.
const NEEDED: &[&str] = &[
    "glGetString",
    "glGetIntegerv",
    "glGetError",
    "glGetStringi",
    "glActiveTexture",
    "glAttachShader",
    "glBindBuffer",
    "glBindFramebuffer",
    "glBindRenderbuffer",
    "glBindSampler",
    "glBindTexture",
    "glBindVertexArray",
    "glBlendEquationSeparate",
    "glBlendFuncSeparate",
    "glBlitFramebuffer",
    "glBufferData",
    "glBufferSubData",
    "glCheckFramebufferStatus",
    "glClearBufferfv",
    "glClearBufferiv",
    "glColorMask",
    "glCompileShader",
    "glCreateProgram",
    "glCreateShader",
    "glCullFace",
    "glDeleteBuffers",
    "glDeleteFramebuffers",
    "glDeleteProgram",
    "glDeleteRenderbuffers",
    "glDeleteShader",
    "glDeleteTextures",
    "glDeleteVertexArrays",
    "glDepthFunc",
    "glDepthMask",
    "glDisable",
    "glDrawArrays",
    "glDrawBuffers",
    "glDrawElements",
    "glEnable",
    "glEnableVertexAttribArray",
    "glFramebufferRenderbuffer",
    "glFramebufferTexture2D",
    "glFrontFace",
    "glGenBuffers",
    "glGenFramebuffers",
    "glGenRenderbuffers",
    "glGenTextures",
    "glGenVertexArrays",
    "glGetBooleanv",
    "glGetFloatv",
    "glGetFramebufferAttachmentParameteriv",
    "glGetProgramInfoLog",
    "glGetProgramiv",
    "glGetShaderInfoLog",
    "glGetShaderiv",
    "glGetUniformLocation",
    "glIsEnabled",
    "glIsTexture",
    "glLinkProgram",
    "glPixelStorei",
    "glPolygonOffset",
    "glRenderbufferStorage",
    "glRenderbufferStorageMultisample",
    "glScissor",
    "glShaderSource",
    "glStencilFunc",
    "glStencilFuncSeparate",
    "glStencilMask",
    "glStencilMaskSeparate",
    "glStencilOp",
    "glStencilOpSeparate",
    "glTexImage2D",
    "glTexParameteri",
    "glTexSubImage2D",
    "glUniform1f",
    "glUniform1i",
    "glUniform1ui",
    "glUniform2f",
    "glUniform2fv",
    "glUniform2i",
    "glUniform3fv",
    "glUniform4f",
    "glUniform4fv",
    "glUniform4i",
    "glUniformMatrix3fv",
    "glUniformMatrix4fv",
    "glUseProgram",
    "glVertexAttribIPointer",
    "glVertexAttribPointer",
    "glViewport",
];

/// glow's context of the functions that `load` finds.
///
/// # Errors
/// [`Error::NoContext`], [`Error::TooOld`] for a version that cannot be read.
///
/// # Safety
/// What `load` returns are functions of those names of the current context's OpenGL, or null.
pub(crate) unsafe fn context(mut load: impl FnMut(&str) -> *const c_void) -> Result<glow::Context, Error> {
    if let Some(name) = NEEDED.iter().find(|name| load(name).is_null()) {
        return Err(Error::NoContext { name });
    }
    let (name, get_string) = (NEEDED[0], load(NEEDED[0]));
    // SAFETY: the caller's; OpenGL's functions have the system's calling convention, and this one that signature.
    let version = unsafe {
        let get_string: unsafe extern "system" fn(u32) -> *const c_char = std::mem::transmute(get_string);
        get_string(glow::VERSION)
    };
    // Without a current context there is no answer.
    if version.is_null() {
        return Err(Error::NoContext { name });
    }
    // SAFETY: OpenGL's strings end with a zero, and last as long as the context.
    let version = unsafe { CStr::from_ptr(version) }.to_string_lossy().into_owned();
    // glow reads the version too, and panics at one that it cannot read.
    if !is_version(&version) {
        return Err(Error::TooOld { found: version });
    }
    // SAFETY: the caller's, and a context is current.
    Ok(unsafe { glow::Context::from_loader_function(load) })
}

/// Whether a version is of desktop OpenGL or OpenGL ES, 3.0 or newer.
fn is_version(text: &str) -> bool {
    let numbers = text.strip_prefix("OpenGL ES ").unwrap_or(text);
    let major = numbers.split(['.', ' ']).next().and_then(|major| major.parse::<u32>().ok());
    let minor = numbers.split(['.', ' ']).nth(1).and_then(|minor| minor.parse::<u32>().ok());
    major.is_some_and(|major| major >= 3) && minor.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_told_apart() {
        for good in ["3.3 (Core Profile) Mesa 22.3.6", "4.6.0 NVIDIA 550.54", "OpenGL ES 3.2 Mesa", "3.0"] {
            assert!(is_version(good), "{good}");
        }
        for bad in ["", "2.1 Mesa", "OpenGL ES 2.0", "OpenGL ES-CM 1.1", "WebGL", "three"] {
            assert!(!is_version(bad), "{bad}");
        }
    }

    #[test]
    fn a_loader_that_lacks_a_function_is_an_error_that_names_it() {
        extern "system" fn any() {}
        for missing in NEEDED {
            let load = |name: &str| if name == *missing { std::ptr::null() } else { any as *const c_void };
            // SAFETY: nothing is called where one is missing.
            let lacking = unsafe { context(load) };
            assert!(matches!(lacking, Err(Error::NoContext { name }) if name == *missing), "{lacking:?}");
        }
    }

    #[test]
    fn a_loader_that_finds_nothing_is_an_error() {
        // SAFETY: null is an answer.
        let nothing = unsafe { context(|_| std::ptr::null()) };
        assert!(matches!(nothing, Err(Error::NoContext { name: "glGetString" })), "{nothing:?}");
        extern "system" fn no_string(_: u32) -> *const c_char {
            std::ptr::null()
        }
        // SAFETY: the one function that is called has its signature.
        let silent = unsafe { context(|_| no_string as *const c_void) };
        assert!(matches!(silent, Err(Error::NoContext { name: "glGetString" })), "{silent:?}");
        extern "system" fn old(_: u32) -> *const c_char {
            c"2.1 Mesa".as_ptr()
        }
        // SAFETY: as above.
        let old = unsafe { context(|_| old as *const c_void) };
        assert!(matches!(old, Err(Error::TooOld { ref found }) if found == "2.1 Mesa"), "{old:?}");
    }
}
