//! A display for tests of programs with windows.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// An X server without hardware (Xvfb), which ends with it.
pub struct TestDisplay {
    server: Child,
    name: String,
}

impl TestDisplay {
    /// Starts a server with a screen of so many pixels. `None` where there is no Xvfb, said aloud.
    ///
    /// # Panics
    /// If there is no Xvfb and the environment variable `ANTUMBRA_REQUIRE_GL` is set: a test that is skipped where it is
    /// meant to run has failed.
    pub fn start([width, height]: [u16; 2]) -> Option<Self> {
        let size = format!("{width}x{height}x24");
        let started = Command::new("Xvfb")
            // -r: a key does not repeat, however long a busy machine takes to release it.
            .args(["-r", "-displayfd", "1", "-screen", "0", &size, "-nolisten", "tcp", "-noreset"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut server = match started {
            Ok(server) => server,
            Err(error) => {
                let required = std::env::var_os("ANTUMBRA_REQUIRE_GL").is_some();
                assert!(!required, "Xvfb does not start: {error}");
                eprintln!("SKIPPED: Xvfb does not start ({error}); `cargo xtask setup` installs it");
                return None;
            }
        };
        let mut number = String::new();
        let output = server.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut number).expect("Xvfb says its number");
        Some(Self { server, name: format!(":{}", number.trim()) })
    }

    /// For the environment variable `DISPLAY`.
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Drop for TestDisplay {
    fn drop(&mut self) {
        // Of no use to anybody if it does not end.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
