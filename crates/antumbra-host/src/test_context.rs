//! Contexts for test programs.

use crate::{Api, HeadlessContext};
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A context for a test, the only one alive in its process: tests of one program that draw take turns.
///
/// With two contexts in one process, one drawing while the other draws, ends or begins, llvmpipe of Mesa 22.3 crashes:
/// one run in ten of a program whose tests had a context each. It draws with all cores anyway.
///
/// What is made in the context is to be gone before it: a local variable declared after it is.
pub struct TestContext {
    // Dropped in this order: the turn is given back once the context is gone.
    context: HeadlessContext,
    _turn: MutexGuard<'static, ()>,
}

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

impl TestContext {
    /// Waits for its turn and makes a context. `None` where there is no OpenGL, said aloud.
    ///
    /// # Panics
    /// If there is no OpenGL and the environment variable `ANTUMBRA_REQUIRE_GL` is set: a test that is skipped where it
    /// is meant to run has failed.
    pub fn new(api: Api) -> Option<Self> {
        // A test that failed has said so; the next one has a context of its own.
        let turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        match HeadlessContext::new(api) {
            Ok(context) => Some(Self { context, _turn: turn }),
            Err(error) => {
                assert!(std::env::var_os("ANTUMBRA_REQUIRE_GL").is_none(), "{api:?}: {error}");
                eprintln!("SKIPPED on {api:?}: {error}");
                None
            }
        }
    }
}

impl Deref for TestContext {
    type Target = HeadlessContext;

    fn deref(&self) -> &HeadlessContext {
        &self.context
    }
}
