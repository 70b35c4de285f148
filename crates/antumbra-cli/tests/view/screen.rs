//! A display of its own, with a keyboard and a mouse that the test moves, and pictures of what is on it.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::time::{Duration, Instant};

use antumbra_host::TestDisplay;
use x11rb::CURRENT_TIME;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    self, AtomEnum, AutoRepeatMode, ChangeKeyboardControlAux, ChangeWindowAttributesAux, ConfigureWindowAux,
    ConnectionExt as _, CreateWindowAux, EventMask, ImageFormat, InputFocus, MapState, Window, WindowClass,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// Size of the screen, pixels.
const SCREEN: [u16; 2] = [1400, 1000];

/// An X server without hardware (Xvfb), and a connection to it.
pub(crate) struct Screen {
    server: TestDisplay,
    connection: RustConnection,
    root: Window,
    keys: Vec<(u8, Vec<u32>)>,
}

/// What a window showed.
pub(crate) struct Shot {
    pub(crate) size: [usize; 2],
    pub(crate) rgb: Vec<[u8; 3]>,
}

impl Shot {
    /// The colour of a pixel; black outside.
    pub(crate) fn pixel(&self, x: usize, y: usize) -> [u8; 3] {
        let inside = x < self.size[0] && y < self.size[1];
        if inside { self.rgb[y * self.size[0] + x] } else { [0; 3] }
    }

    /// The sum of a pixel's channels.
    pub(crate) fn light(&self, [x, y]: [f64; 2]) -> u32 {
        self.pixel(x.max(0.0) as usize, y.max(0.0) as usize).into_iter().map(u32::from).sum()
    }

    /// How many pixels of a rectangle (x, y, width, height) differ by more than a little from another shot.
    pub(crate) fn difference(&self, other: &Self, [x, y, w, h]: [usize; 4]) -> usize {
        let apart = |(x, y)| {
            let (a, b) = (self.pixel(x, y), other.pixel(x, y));
            (0..3).any(|c| a[c].abs_diff(b[c]) > 8)
        };
        (y..y + h).flat_map(|y| (x..x + w).map(move |x| (x, y))).filter(|&at| apart(at)).count()
    }
}

impl Shot {
    /// Writes it to a PNG, for whoever wonders what a test saw.
    pub(crate) fn write(&self, path: &Path) {
        let file = BufWriter::new(File::create(path).expect("the file can be written"));
        let mut encoder = png::Encoder::new(file, self.size[0] as u32, self.size[1] as u32);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().expect("written");
        writer.write_image_data(self.rgb.as_flattened()).expect("written");
    }
}

impl Screen {
    /// Starts a server; `None` where there is none, said aloud.
    pub(crate) fn start() -> Option<Self> {
        let server = TestDisplay::start(SCREEN)?;
        let (connection, screen) = connect(server.name());
        let root = connection.setup().roots[screen].root;
        let (low, high) = (connection.setup().min_keycode, connection.setup().max_keycode);
        let mapping =
            connection.get_keyboard_mapping(low, high - low + 1).expect("sent").reply().expect("a keyboard");
        let columns = usize::from(mapping.keysyms_per_keycode).max(1);
        let keys = (low..=high).zip(mapping.keysyms.chunks(columns).map(<[u32]>::to_vec)).collect();
        let steady = ChangeKeyboardControlAux::new().auto_repeat_mode(AutoRepeatMode::OFF);
        connection.change_keyboard_control(&steady).expect("sent").check().expect("a keyboard");
        // Requests to a window manager, which there is none of, go to the root window: this test sees them.
        let mask = ChangeWindowAttributesAux::new().event_mask(EventMask::SUBSTRUCTURE_NOTIFY);
        connection.change_window_attributes(root, &mask).expect("sent").check().expect("the root window");
        Some(Self { server, connection, root, keys })
    }

    /// For `DISPLAY`.
    pub(crate) fn display(&self) -> &str {
        self.server.name()
    }

    fn sync(&self) {
        self.connection.get_input_focus().expect("sent").reply().expect("the server answers");
    }

    /// The largest window on the screen.
    pub(crate) fn window(&self) -> Option<Window> {
        let children = self.connection.query_tree(self.root).ok()?.reply().ok()?.children;
        let seen = children.into_iter().filter_map(|window| {
            let attributes = self.connection.get_window_attributes(window).ok()?.reply().ok()?;
            let geometry = self.connection.get_geometry(window).ok()?.reply().ok()?;
            let seen =
                attributes.map_state == MapState::VIEWABLE && attributes.class == WindowClass::INPUT_OUTPUT;
            seen.then_some((u32::from(geometry.width) * u32::from(geometry.height), window))
        });
        seen.max().map(|(_, window)| window)
    }

    /// The title of a window.
    pub(crate) fn title(&self, window: Window) -> String {
        let atom = self.atom("_NET_WM_NAME");
        let reply =
            self.connection.get_property(false, window, atom, AtomEnum::ANY, 0, 1024).expect("sent").reply();
        String::from_utf8(reply.expect("a property").value).expect("UTF-8")
    }

    fn atom(&self, name: &str) -> xproto::Atom {
        self.connection.intern_atom(false, name.as_bytes()).expect("sent").reply().expect("an atom").atom
    }

    /// Keys go to this window from now on.
    pub(crate) fn focus(&self, window: Window) {
        let sent = self.connection.set_input_focus(InputFocus::PARENT, window, CURRENT_TIME);
        sent.expect("sent").check().expect("the window takes keys");
    }

    /// Waits until somebody asks the window manager for the whole screen, or not any more.
    pub(crate) fn wait_for_fullscreen(&self, wanted: bool) {
        let (state, fullscreen) = (self.atom("_NET_WM_STATE"), self.atom("_NET_WM_STATE_FULLSCREEN"));
        let end = Instant::now() + Duration::from_secs(10);
        while Instant::now() < end {
            while let Some(event) = self.connection.poll_for_event().expect("the server is there") {
                if let Event::ClientMessage(message) = event
                    && message.type_ == state
                    && message.data.as_data32()[1..3].contains(&fullscreen)
                {
                    assert_eq!(message.data.as_data32()[0], u32::from(wanted), "1 adds, 0 removes");
                    return;
                }
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("nobody asked the window manager for fullscreen {wanted}");
    }

    fn fake(&self, kind: u8, detail: u8, x: i16, y: i16) {
        let root = if kind == xproto::MOTION_NOTIFY_EVENT { self.root } else { x11rb::NONE };
        self.connection.xtest_fake_input(kind, detail, CURRENT_TIME, root, x, y, 0).expect("sent");
        self.connection.flush().expect("the server is there");
    }

    /// The key that makes a symbol, and whether Shift is held for it.
    fn keycode(&self, symbol: u32) -> (u8, bool) {
        let found =
            |column: usize| self.keys.iter().find(|(_, symbols)| symbols.get(column) == Some(&symbol));
        match (found(0), found(1)) {
            (Some((code, _)), _) => (*code, false),
            (None, Some((code, _))) => (*code, true),
            _ => panic!("the keyboard has no key for the symbol 0x{symbol:x}"),
        }
    }

    /// Presses or releases a key, by its name or what it writes.
    pub(crate) fn key(&self, name: &str, down: bool) {
        let (code, _) = self.keycode(symbol(name));
        self.fake(if down { xproto::KEY_PRESS_EVENT } else { xproto::KEY_RELEASE_EVENT }, code, 0, 0);
    }

    /// Presses keys together and releases them: `K`, `Ctrl+Shift+S`, `?`.
    pub(crate) fn chord(&self, text: &str) {
        let (mut held, mut key) = (Vec::new(), text);
        while let Some((modifier, rest)) = key.split_once('+').filter(|(a, b)| !a.is_empty() && !b.is_empty())
        {
            held.push(modifier);
            key = rest;
        }
        if self.keycode(symbol(key)).1 && !held.contains(&"Shift") {
            held.push("Shift");
        }
        held.iter().for_each(|name| self.key(name, true));
        self.key(key, true);
        self.key(key, false);
        held.iter().rev().for_each(|name| self.key(name, false));
    }

    /// Puts the pointer somewhere.
    pub(crate) fn move_to(&self, [x, y]: [f64; 2]) {
        self.fake(xproto::MOTION_NOTIFY_EVENT, 0, x.round() as i16, y.round() as i16);
    }

    /// Presses or releases a button: 1 left, 2 middle, 3 right; 4 and 5 are the wheel.
    pub(crate) fn button(&self, number: u8, down: bool) {
        self.fake(if down { xproto::BUTTON_PRESS_EVENT } else { xproto::BUTTON_RELEASE_EVENT }, number, 0, 0);
    }

    /// Gives a window another size.
    pub(crate) fn resize(&self, window: Window, [width, height]: [u32; 2]) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.connection.configure_window(window, &size).expect("sent").check().expect("a window");
    }

    /// Takes a window off the screen as minimising does, or puts it back.
    pub(crate) fn show(&self, window: Window, shown: bool) {
        let connection = &self.connection;
        let sent = if shown { connection.map_window(window) } else { connection.unmap_window(window) };
        sent.expect("sent").check().expect("a window");
    }

    /// Closes a window as its title bar's button does.
    pub(crate) fn close(&self, window: Window) {
        let data = [self.atom("WM_DELETE_WINDOW"), CURRENT_TIME, 0, 0, 0];
        let message = xproto::ClientMessageEvent::new(32, window, self.atom("WM_PROTOCOLS"), data);
        self.connection.send_event(false, window, EventMask::NO_EVENT, message).expect("sent");
        self.sync();
    }

    /// Covers the whole screen with a window, and its number to uncover it again.
    pub(crate) fn cover(&self) -> Window {
        let window = self.connection.generate_id().expect("a number");
        let options = CreateWindowAux::new().override_redirect(1).background_pixel(0x00ff_00ff);
        let [w, h] = SCREEN;
        let class = WindowClass::INPUT_OUTPUT;
        let sent = self.connection.create_window(24, window, self.root, 0, 0, w, h, 0, class, 0, &options);
        sent.expect("sent").check().expect("a window");
        self.show(window, true);
        window
    }

    /// Takes the cover away.
    pub(crate) fn uncover(&self, window: Window) {
        self.connection.destroy_window(window).expect("sent").check().expect("the window is there");
    }

    /// What a window shows now.
    pub(crate) fn shot(&self, window: Window) -> Shot {
        let geometry = self.connection.get_geometry(window).expect("sent").reply().expect("a window");
        let (width, height) = (geometry.width, geometry.height);
        let image = self
            .connection
            .get_image(ImageFormat::Z_PIXMAP, window, 0, 0, width, height, !0)
            .expect("sent")
            .reply()
            .expect("a window that is on the screen");
        // 24 bits in 32, the least significant byte first: what Xvfb has on every machine that this is tested on.
        let rgb = image.data.chunks_exact(4).map(|bgrx| [bgrx[2], bgrx[1], bgrx[0]]).collect();
        Shot { size: [usize::from(width), usize::from(height)], rgb }
    }
}

/// Connects to a server that has just said its number: it answers soon.
fn connect(display: &str) -> (RustConnection, usize) {
    let end = Instant::now() + Duration::from_secs(20);
    loop {
        match RustConnection::connect(Some(display)) {
            Ok(connected) => return connected,
            Err(error) => assert!(Instant::now() < end, "display {display}: {error}"),
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The X11 symbol of a key, by its name in the program's help or what it writes.
fn symbol(name: &str) -> u32 {
    let function = name.strip_prefix('F').and_then(|number| number.parse::<u32>().ok());
    match (name, function) {
        (_, Some(number)) => 0xffbd + number,
        ("Ctrl", _) => 0xffe3,
        ("Shift", _) => 0xffe1,
        ("Space", _) => 0x20,
        ("Enter", _) => 0xff0d,
        ("Tab", _) => 0xff09,
        ("Backspace", _) => 0xff08,
        ("Escape", _) => 0xff1b,
        ("Delete", _) => 0xffff,
        ("Home", _) => 0xff50,
        ("End", _) => 0xff57,
        ("PageUp", _) => 0xff55,
        ("PageDown", _) => 0xff56,
        ("Up", _) => 0xff52,
        ("Down", _) => 0xff54,
        ("\u{2212}", _) => u32::from('-'),
        _ => {
            let mut letters = name.chars();
            match (letters.next(), letters.next()) {
                (Some(letter), None) if letter.is_ascii() => u32::from(letter.to_ascii_lowercase()),
                _ => panic!("no key is called {name:?}"),
            }
        }
    }
}
