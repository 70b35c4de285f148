//! A driver that has little beyond OpenGL ES 3.0: the one that there is, with the answers to a few questions changed.

use antumbra_host::HeadlessContext;
use std::ffi::{CString, c_char, c_void};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

type GetString = extern "system" fn(u32) -> *const c_char;
type GetIntegers = extern "system" fn(u32, *mut i32);

/// The driver's own functions.
static GET_STRING: OnceLock<GetString> = OnceLock::new();
static GET_INTEGERS: OnceLock<GetIntegers> = OnceLock::new();

extern "system" fn get_string(name: u32) -> *const c_char {
    match name {
        glow::VERSION => c"OpenGL ES 3.0 without extensions".as_ptr(),
        _ => GET_STRING.get().expect("it was loaded")(name),
    }
}

extern "system" fn get_integers(name: u32, values: *mut i32) {
    GET_INTEGERS.get().expect("it was loaded")(name, values);
    if name == glow::NUM_EXTENSIONS {
        // SAFETY: OpenGL's caller has a place for the number.
        unsafe { *values = HAS_HALF_FLOATS.load(Ordering::Relaxed).into() };
    }
}

extern "system" fn get_extension(_: u32, _: u32) -> *const c_char {
    c"GL_EXT_color_buffer_half_float".as_ptr()
}

/// Whether there is one extension, for render targets of 16-bit floats. Tests that draw take turns.
static HAS_HALF_FLOATS: AtomicBool = AtomicBool::new(false);

/// The context's functions, with one extension, `EXT_color_buffer_half_float`, or none.
pub(crate) fn context(context: &HeadlessContext, half_floats: bool) -> glow::Context {
    HAS_HALF_FLOATS.store(half_floats, Ordering::Relaxed);
    let load = |name: &str| {
        let found = context.get_proc_address(&CString::new(name).expect("a name without zeros"));
        // SAFETY: functions of these names have these signatures.
        unsafe {
            match name {
                "glGetString" => {
                    GET_STRING.get_or_init(|| std::mem::transmute::<*const c_void, GetString>(found));
                    get_string as *const c_void
                }
                "glGetIntegerv" => {
                    GET_INTEGERS.get_or_init(|| std::mem::transmute::<*const c_void, GetIntegers>(found));
                    get_integers as *const c_void
                }
                "glGetStringi" => get_extension as *const c_void,
                _ => found,
            }
        }
    };
    // SAFETY: the context is current.
    unsafe { glow::Context::from_loader_function(load) }
}
