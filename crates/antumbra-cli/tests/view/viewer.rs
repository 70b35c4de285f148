//! The viewer as a user has it: started on a display, seen in pictures and in the state that it prints, and worked
//! with keys and mouse.

use std::fs;
use std::io::{BufRead, BufReader};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use antumbra::glam::{DMat4, DVec2, DVec3};
use serde_json::Value;
use x11rb::protocol::xproto::Window;

use crate::screen::{Screen, Shot};

/// How long anything may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A display and a folder for what a test writes and the program remembers.
///
/// One test at a time has one: a software renderer takes all cores.
pub(crate) struct Desk {
    pub(crate) screen: Screen,
    folder: tempfile::TempDir,
    _turn: MutexGuard<'static, ()>,
}

impl Desk {
    /// A display, or `None` where there is none to be had and the test is skipped.
    pub(crate) fn new() -> Option<Self> {
        static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
        // A test that failed has said so; the next one has a display of its own.
        let turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        let screen = Screen::start()?;
        Some(Self { screen, folder: tempfile::tempdir().expect("a temporary folder"), _turn: turn })
    }

    /// A file in the folder.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a scene file; its path.
    pub(crate) fn write(&self, name: &str, text: &str) -> PathBuf {
        fs::write(self.file(name), text).expect("a temporary folder is writable");
        self.file(name)
    }

    /// Starts the viewer with these arguments behind `view --json` and waits for its first picture.
    pub(crate) fn view(&self, arguments: &[&str]) -> Viewer<'_> {
        self.view_with(arguments, &[])
    }

    /// The same with environment variables.
    pub(crate) fn view_with(&self, arguments: &[&str], environment: &[(&str, &str)]) -> Viewer<'_> {
        let started = Instant::now();
        let mut command = Command::new(env!("CARGO_BIN_EXE_antumbra"));
        command.args(["view", "--json"]).args(arguments).current_dir(self.folder.path());
        command
            .env("DISPLAY", self.screen.display())
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET");
        command
            .env("XDG_CONFIG_HOME", self.file("config"))
            .env_remove("XMODIFIERS")
            .env_remove("WINIT_X11_SCALE_FACTOR");
        if std::env::var_os("ANTUMBRA_HARDWARE").is_none() {
            command.env("LIBGL_ALWAYS_SOFTWARE", "1");
        }
        command.envs(environment.iter().copied());
        let errors = fs::File::create(self.file("stderr")).expect("a temporary folder is writable");
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(errors)
            .spawn()
            .expect("the program starts");
        let output = BufReader::new(child.stdout.take().expect("it is piped"));
        let (send, lines) = channel();
        std::thread::spawn(move || {
            for line in output.lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        });
        let keys = match lines.recv_timeout(PATIENCE) {
            Ok(line) => serde_json::from_str::<Value>(&line).expect("a line of JSON")["keys"].clone(),
            Err(error) => {
                panic!("no line of output ({error}): {}", errors_of(self.folder.path(), &mut child))
            }
        };
        let mut viewer = Viewer {
            desk: self,
            child,
            lines,
            state: Value::Null,
            keys,
            window: 0,
            first_still: Duration::ZERO,
            pressed: Vec::new(),
        };
        viewer.wait("the first picture", |state| state["still"] == true);
        viewer.first_still = started.elapsed();
        viewer.window = self.screen.window().expect("a window is on the screen");
        self.screen.focus(viewer.window);
        viewer.wait("the keyboard", |state| state["input"]["focused"] == true);
        viewer
    }
}

fn errors_of(folder: &Path, child: &mut Child) -> String {
    let status = child.try_wait().ok().flatten();
    format!("{status:?}, standard error: {}", fs::read_to_string(folder.join("stderr")).unwrap_or_default())
}

/// A running viewer. It is ended with the test.
pub(crate) struct Viewer<'a> {
    desk: &'a Desk,
    child: Child,
    lines: Receiver<String>,
    /// What it printed last.
    pub(crate) state: Value,
    /// Groups, names and helps of all keys.
    pub(crate) keys: Value,
    pub(crate) window: Window,
    /// From the start of the process to its first finished picture.
    pub(crate) first_still: Duration,
    /// The keys that were pressed so far.
    pub(crate) pressed: Vec<String>,
}

impl Viewer<'_> {
    /// Reads what was printed until `done` breaks or the time is over.
    fn read<T>(&mut self, patience: Duration, mut done: impl FnMut(&Value) -> ControlFlow<T>) -> Option<T> {
        let end = Instant::now() + patience;
        loop {
            match self.lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(line) => self.state = serde_json::from_str(&line).expect("a line of JSON"),
                Err(RecvTimeoutError::Timeout) => return None,
                Err(RecvTimeoutError::Disconnected) => {
                    panic!("the program ended: {}", errors_of(self.desk.folder.path(), &mut self.child))
                }
            }
            if let ControlFlow::Break(found) = done(&self.state) {
                return Some(found);
            }
        }
    }

    /// Waits for a state; it is `self.state` then. Fails with the last one.
    #[track_caller]
    pub(crate) fn wait(&mut self, what: &str, mut wanted: impl FnMut(&Value) -> bool) {
        self.wait_within(PATIENCE, what, &mut wanted);
    }

    /// The same, with less patience.
    #[track_caller]
    pub(crate) fn wait_within(
        &mut self,
        patience: Duration,
        what: &str,
        mut wanted: impl FnMut(&Value) -> bool,
    ) {
        if wanted(&self.state) {
            return;
        }
        let found = self.read(patience, |state| {
            if wanted(state) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if found.is_none() {
            let mut short = self.state.clone();
            short["controls"] = self.labels().join(", ").into();
            panic!("not within {patience:?}: {what}; the last state is {short:#}");
        }
    }

    /// Reads what was printed so far.
    pub(crate) fn catch_up(&mut self) {
        while let Ok(line) = self.lines.try_recv() {
            self.state = serde_json::from_str(&line).expect("a line of JSON");
        }
    }

    /// Waits until nothing changes any more and the picture is final.
    #[track_caller]
    pub(crate) fn still(&mut self) {
        self.wait("a still picture", |state| state["still"] == true);
    }

    /// How many lines it prints in a time.
    pub(crate) fn lines_within(&mut self, time: Duration) -> usize {
        let mut count = 0;
        self.read(time, |_| {
            count += 1;
            ControlFlow::<()>::Continue(())
        });
        count
    }

    /// A number of the state, by its JSON pointer.
    #[track_caller]
    pub(crate) fn number(&self, pointer: &str) -> f64 {
        let found = self.state.pointer(pointer).and_then(Value::as_f64);
        found.unwrap_or_else(|| panic!("no number {pointer} in {:#}", self.state))
    }

    /// A vector of the state.
    #[track_caller]
    pub(crate) fn vector(&self, pointer: &str) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|i| self.number(&format!("{pointer}/{i}"))))
    }

    /// Where a light is.
    #[track_caller]
    pub(crate) fn light(&self, index: usize) -> DVec3 {
        self.vector(&format!("/lights/{index}/position"))
    }

    // Keys and mouse.

    /// Presses keys together, as the help writes them, and releases them.
    pub(crate) fn press(&mut self, keys: &str) {
        self.pressed.push(keys.to_owned());
        self.desk.screen.chord(keys);
    }

    /// Presses keys and waits for what they do.
    #[track_caller]
    pub(crate) fn press_for(&mut self, keys: &str, what: &str, wanted: impl FnMut(&Value) -> bool) {
        self.press(keys);
        self.wait(&format!("{keys}: {what}"), wanted);
    }

    /// Holds Ctrl or Shift, or lets it go.
    #[track_caller]
    pub(crate) fn hold(&mut self, name: &str, down: bool) {
        self.desk.screen.key(name, down);
        self.wait(name, |state| state["input"][name.to_lowercase()] == down);
    }

    /// Writes text into what has the keyboard.
    pub(crate) fn write(&mut self, text: &str) {
        for letter in text.chars() {
            let upper = letter.is_ascii_uppercase();
            let name = letter.to_string();
            self.desk.screen.chord(&if upper { format!("Shift+{name}") } else { name });
        }
    }

    /// Moves the pointer and waits until the program knows.
    #[track_caller]
    pub(crate) fn move_to(&mut self, at: [f64; 2]) {
        let at = at.map(f64::round);
        self.desk.screen.move_to(at);
        self.wait(&format!("the pointer at {at:?}"), |state| {
            (0..2).all(|i| state["input"]["pointer"][i].as_f64().is_some_and(|x| (x - at[i]).abs() < 0.6))
        });
    }

    /// Presses or releases a button and waits until the program knows.
    #[track_caller]
    pub(crate) fn button(&mut self, number: u8, down: bool) {
        self.desk.screen.button(number, down);
        let name = ["primary", "middle", "secondary"][usize::from(number) - 1];
        self.wait(&format!("the {name} button"), |state| state["input"][name] == down);
    }

    /// Turns the wheel by clicks, up (positive) or down.
    pub(crate) fn wheel(&mut self, clicks: i32) {
        for _ in 0..clicks.abs() {
            let button = if clicks > 0 { 4 } else { 5 };
            self.desk.screen.button(button, true);
            self.desk.screen.button(button, false);
        }
    }

    /// Clicks at a point of the window.
    #[track_caller]
    pub(crate) fn click_at(&mut self, at: [f64; 2]) {
        self.move_to(at);
        self.button(1, true);
        self.button(1, false);
    }

    /// Drags with a button from one point of the window to another, in steps.
    #[track_caller]
    pub(crate) fn drag(&mut self, button: u8, from: [f64; 2], to: [f64; 2]) {
        self.move_to(from);
        self.button(button, true);
        for step in 1..=8 {
            let part = f64::from(step) / 8.0;
            self.move_to([0, 1].map(|i| from[i] + (to[i] - from[i]) * part));
        }
        self.button(button, false);
    }

    // What is seen.

    /// The rectangle of the picture: x, y, width, height in the window, pixels.
    pub(crate) fn picture(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| self.number(&format!("/picture/{i}")))
    }

    /// A point of the picture, as parts of its width and height.
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, w, h] = self.picture();
        [left + w * x, top + h * y]
    }

    /// Where a point of the world is seen in the window.
    pub(crate) fn project(&self, point: DVec3) -> [f64; 2] {
        let [left, top, w, h] = self.picture();
        let camera = |name: &str| self.vector(&format!("/camera/{name}"));
        let (eye, target, up) = (camera("eye"), camera("target"), camera("up"));
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        let view = DMat4::from_cols(
            right.extend(0.0),
            right.cross(forward).extend(0.0),
            (-forward).extend(0.0),
            eye.extend(1.0),
        );
        let p = view.inverse().transform_point3(point);
        let scale = 0.5 * h / (0.5 * self.number("/camera/fov_y")).tan();
        let seen = DVec2::new(p.x, -p.y) * (scale / -p.z);
        [left + 0.5 * w + seen.x, top + 0.5 * h + seen.y]
    }

    /// What the window shows once the picture is still.
    #[track_caller]
    pub(crate) fn shot(&mut self) -> Shot {
        self.still();
        self.desk.screen.shot(self.window)
    }

    /// Waits until the window shows what is wanted: the server may be a little behind the program. Fails with what was
    /// said last.
    #[track_caller]
    pub(crate) fn see<T>(
        &mut self,
        what: &str,
        mut wanted: impl FnMut(&Self, &Shot) -> Result<T, String>,
    ) -> T {
        let end = Instant::now() + Duration::from_secs(10);
        loop {
            let shot = self.shot();
            match wanted(self, &shot) {
                Ok(found) => return found,
                Err(why) if Instant::now() < end => drop(why),
                Err(why) => {
                    let file = std::env::temp_dir().join("antumbra-view-failed.png");
                    shot.write(&file);
                    panic!("not seen: {what}: {why}; {} shows it", file.display());
                }
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    // The process.

    /// Its CPU time so far.
    pub(crate) fn cpu(&self) -> Duration {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.child.id())).expect("it runs");
        let behind_name = stat.rsplit(')').next().unwrap_or_default();
        // utime and stime, in ticks of 1/100 s on every Linux.
        let ticks: u64 =
            behind_name.split_whitespace().skip(11).take(2).filter_map(|n| n.parse::<u64>().ok()).sum();
        Duration::from_millis(10 * ticks)
    }

    /// Its resident memory, MiB.
    pub(crate) fn memory(&self) -> f64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).expect("it runs");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("Linux says it");
        line.trim().trim_end_matches(" kB").parse::<f64>().expect("a number") / 1024.0
    }

    /// Waits for its end, which somebody asked for.
    #[track_caller]
    pub(crate) fn wait_for_end(&mut self) -> ExitStatus {
        let end = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.child.try_wait().expect("it is a child") {
                let errors = fs::read_to_string(self.desk.file("stderr")).expect("it is there");
                assert_eq!(errors, "", "nothing on standard error");
                return status;
            }
            assert!(Instant::now() < end, "it does not end; the last state is {:#}", self.state);
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Viewer<'_> {
    fn drop(&mut self) {
        // It may have ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
