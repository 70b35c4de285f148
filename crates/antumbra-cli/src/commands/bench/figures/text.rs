//! Pieces of scene files.

use std::fmt::Display;
use std::fmt::Write;

use crate::args::Size;

/// A scene file in the making.
pub(super) struct SceneText(String);

impl SceneText {
    /// Begins with what the file is, the ambient light, a camera and the size of the frame.
    pub(super) fn new(about: impl Display, eye: [f64; 3], target: [f64; 3], size: Size) -> Self {
        let Size { width, height } = size;
        Self(format!(
            "# {about}\nambient = [0.06, 0.06, 0.06]\n\n[camera]\neye = {eye:?}\ntarget = {target:?}\n\n\
             [image]\nwidth = {width}\nheight = {height}\n"
        ))
    }

    /// A point light.
    pub(super) fn light(&mut self, name: impl Display, position: [f64; 3], intensity: f64) {
        self.push(format_args!(
            "\n[[light]]\nname = \"{name}\"\ntype = \"point\"\nposition = {position:?}\nintensity = {intensity:?}\n"
        ));
    }

    /// A ball that shines.
    pub(super) fn ball_light(&mut self, name: impl Display, position: [f64; 3], radius: f64, intensity: f64) {
        self.push(format_args!(
            "\n[[light]]\nname = \"{name}\"\ntype = \"sphere\"\nposition = {position:?}\nradius = {radius:?}\n\
             intensity = {intensity:?}\n"
        ));
    }

    /// The floor that the shadows fall on; it casts none.
    pub(super) fn floor(&mut self) {
        self.push(
            "\n[[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\ncolor = [0.7, 0.68, 0.64]\n\
             casts_shadow = false\n",
        );
    }

    /// An object; `body` says its shape and pose.
    pub(super) fn object(&mut self, name: impl Display, color: [f64; 3], body: impl Display) {
        self.push(format_args!("\n[[object]]\nname = \"{name}\"\n{body}\ncolor = {color:?}\n"));
    }

    /// Spheres over a disc 3.2 m in radius, evenly spread for any number (a sunflower's seeds), the smaller the more
    /// they are, so that they never touch.
    pub(super) fn spheres(&mut self, count: u32) {
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        for i in 0..count {
            let turn = f64::from(i) * golden;
            let out = 3.2 * ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
            let radius = 1.4 / f64::from(count + 3).sqrt();
            let place = [out * turn.cos(), radius * 1.5, out * turn.sin()].map(round);
            let radius = round(radius);
            let hue = f64::from(i % 7) / 7.0;
            self.object(
                format_args!("sphere {i}"),
                [0.75 - 0.4 * hue, 0.35 + 0.2 * hue, 0.2 + 0.5 * hue].map(round),
                format_args!("shape = {{ type = \"sphere\", radius = {radius:?} }}\ntranslation = {place:?}"),
            );
        }
    }

    /// Point lights in a ring 7 m above the floor, as bright together as one alone.
    pub(super) fn ring_of_lights(&mut self, count: u32) {
        for i in 0..count {
            let turn = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            let place = [4.0 * turn.cos(), 7.0, 4.0 * turn.sin()].map(round);
            self.light(format_args!("light {i}"), place, round(200.0 / f64::from(count)));
        }
    }

    fn push(&mut self, text: impl Display) {
        // Writing to a string never fails.
        let _ = write!(self.0, "{text}");
    }

    /// The file.
    pub(super) fn finish(self) -> String {
        self.0
    }
}

/// A tenth of a millimetre is enough, and reads well; a zero has no sign.
fn round(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}
