//! Draws the scene: each way into a picture of its own, then both into the window.

pub(crate) mod compose;
pub(crate) mod lines;
pub(crate) mod map_view;
mod picture;
mod program;

use std::sync::Arc;

use antumbra::Component;
use antumbra::Stats;
use antumbra_host::{Buffers, ColorFormat, ContextInfo, FrameTimer, HostError, Setting, Stage};
use antumbra_scene::Scene;
use glow::HasContext;

use crate::model::settings::{Layout, Settings};
use crate::model::way::Way;
use crate::reference::Traced;
use compose::{Compose, Composition};
use lines::{Lines, Place, Stroke};
use map_view::{MapPicture, MapView};
use picture::Picture;

/// What one frame shows.
pub(crate) struct View<'a> {
    /// The scene.
    pub(crate) scene: &'a Arc<Scene>,
    /// Its time, seconds.
    pub(crate) time: f64,
    /// What is looked at.
    pub(crate) settings: &'a Settings,
    /// Components that were moved.
    pub(crate) components: &'a [Component],
    /// The picture in the window: x, y, width, height, pixels from the bottom left.
    pub(crate) rect: [i32; 4],
    /// Samples a pixel.
    pub(crate) samples: u32,
    /// Lines over the picture.
    pub(crate) strokes: &'a [Stroke],
    /// Pixels for a point of the interface.
    pub(crate) scale: f32,
    /// The reference, as far as it is.
    pub(crate) traced: Option<&'a Traced>,
    /// Whether to measure, at the cost of waiting for the driver.
    pub(crate) measure: bool,
    /// Whether to draw anew what is still good, to measure it again.
    pub(crate) redraw: bool,
}

/// What became of one side.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Side {
    /// Why the way cannot show the scene; it is then without shadows.
    pub(crate) objection: Option<String>,
    /// What the technique did.
    pub(crate) stats: Option<Stats>,
    /// Milliseconds of the frame without shadows, and with them, if they were measured.
    pub(crate) milliseconds: Option<[f64; 2]>,
    /// Whether it was drawn for this frame, and not for an earlier one that looked the same.
    pub(crate) fresh: bool,
}

/// What a side's picture was drawn of: as long as nothing of this changes it is good.
struct Key {
    scene: Arc<Scene>,
    time: f64,
    way: Way,
    components: Vec<Component>,
    size: [i32; 2],
    samples: u32,
    /// Of the reference.
    version: u64,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        let Self { scene, time, way, components, size, samples, version } = self;
        // A scene that is held is never changed, but replaced: where it is says which it is.
        Arc::ptr_eq(scene, &other.scene)
            && *time == other.time
            && *way == other.way
            && *components == other.components
            && *size == other.size
            && *samples == other.samples
            && *version == other.version
    }
}

/// A side's picture.
#[derive(Default)]
struct Slot {
    picture: Option<Picture>,
    key: Option<Key>,
    side: Side,
}

/// The OpenGL side of the program.
pub(crate) struct Canvas {
    gl: Arc<glow::Context>,
    stage: Stage,
    timer: FrameTimer,
    info: ContextInfo,
    compose: Compose,
    lines: Lines,
    map_view: MapView,
    slots: [Slot; 2],
    /// What the stage's depth is of.
    depth: Option<(Arc<Scene>, f64, [i32; 2])>,
}

/// How dark a picture is whose way cannot show the scene.
const DIMMED: f32 = 0.35;

impl Canvas {
    /// Makes the objects that do not depend on the picture.
    ///
    /// # Errors
    /// Those of the driver.
    pub(crate) fn new(gl: &Arc<glow::Context>) -> Result<Self, HostError> {
        let info = ContextInfo::query(gl);
        let stage = Stage::new(gl)?;
        let timer = FrameTimer::new(gl, &info)?;
        // SAFETY: the context is current on this thread.
        let (compose, lines) = unsafe { (Compose::new(gl)?, Lines::new(gl)?) };
        let gl = gl.clone();
        let (slots, map_view) = Default::default();
        Ok(Self { gl, stage, timer, info, compose, lines, map_view, slots, depth: None })
    }

    /// What the driver says of itself.
    pub(crate) fn info(&self) -> &ContextInfo {
        &self.info
    }

    /// The most samples a pixel that can be drawn.
    pub(crate) fn most_samples(&self) -> u32 {
        self.stage.shadows().caps().max_samples.max(1)
    }

    /// Which clock frame times are of.
    pub(crate) fn clock(&self) -> &'static str {
        self.timer.name()
    }

    /// Makes the whole window black.
    pub(crate) fn clear(&self, size: [u32; 2]) {
        // SAFETY: the context is current.
        unsafe { self.gl.bind_framebuffer(glow::FRAMEBUFFER, None) };
        egui_glow::painter::clear(&self.gl, size, [0.0, 0.0, 0.0, 1.0]);
    }

    /// Draws a frame into the window's framebuffer; what became of the first side, and of the second if there is one.
    ///
    /// # Errors
    /// Those of the driver.
    pub(crate) fn draw(&mut self, view: &View<'_>) -> Result<[Side; 2], HostError> {
        let [.., w, h] = view.rect;
        let [mut first, mut second] = [Side::default(), Side::default()];
        if w < 1 || h < 1 {
            return Ok([first, second]);
        }
        let ways = view.settings.shown();
        // The same way twice is drawn once.
        let twice = ways.len() == 2 && ways[0] == ways[1];
        for (i, side) in [&mut first, &mut second].into_iter().take(ways.len()).enumerate() {
            *side =
                if i == 1 && twice { self.slots[0].side.clone() } else { self.draw_side(i, ways[i], view)? };
        }
        let both = if twice || ways.len() == 1 { [0, 0] } else { [0, 1] };
        let textures = both.map(|i| self.slots[i].picture.as_ref().map(|p| p.texture));
        let [Some(left), Some(right)] = textures else { return Ok([first, second]) };
        let dim = [&first, &second].map(|side| if side.objection.is_some() { DIMMED } else { 1.0 });
        let settings = view.settings;
        // There is no error of a technique that refuses: its side is without shadows.
        let refused = first.objection.is_some() || second.objection.is_some();
        let layout = match settings.layout {
            Layout::Difference if refused => Layout::Single,
            layout => layout,
        };
        let composition = Composition {
            textures: [left, right],
            dim: if layout == settings.layout { dim } else { [DIMMED; 2] },
            layout,
            dither: settings.dither,
            divider: settings.divider,
            exposure: view.scene.image.exposure as f32,
            error_scale: settings.error_scale,
            rect: view.rect,
        };
        // SAFETY: the context is current; textures are those of this canvas.
        unsafe {
            self.gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            self.compose.draw(&self.gl, &composition);
        }
        self.draw_strokes(view)?;
        Ok([first, second])
    }

    fn draw_side(&mut self, index: usize, way: Way, view: &View<'_>) -> Result<Side, HostError> {
        let size = [view.rect[2], view.rect[3]];
        let traced = if way == Way::Raytraced { view.traced } else { None };
        let key = Key {
            scene: view.scene.clone(),
            time: view.time,
            way,
            components: view.components.to_vec(),
            size,
            samples: view.samples,
            version: traced.map_or(0, |traced| traced.version),
        };
        // The reference shows what it has, however old; without any, the host's picture stands in, dimmed.
        if let Some(traced) = traced.filter(|t| t.width > 0 && t.height > 0) {
            let slot = &mut self.slots[index];
            let fresh = slot.key.as_ref().is_none_or(|old| old.version != key.version || old.way != way);
            if fresh {
                let size = [traced.width as i32, traced.height as i32];
                // SAFETY: the context is current; the picture's memory is of its size.
                unsafe { Picture::ensure(&mut slot.picture, &self.gl, size)?.fill(&self.gl, &traced.pixels) };
                slot.key = Some(key);
                slot.side = Side::default();
            }
            return Ok(Side { fresh, ..slot.side.clone() });
        }
        let slot = &self.slots[index];
        let good = slot.key.as_ref() == Some(&key) && !view.redraw;
        if good && !(view.measure && slot.side.milliseconds.is_none()) {
            return Ok(Side { fresh: false, ..slot.side.clone() });
        }
        let side = self.draw_way(index, way, view, size)?;
        let slot = &mut self.slots[index];
        slot.side = side.clone();
        slot.key = Some(key);
        Ok(side)
    }

    /// Draws the host's picture and the shadows of one way into a side's picture.
    fn draw_way(
        &mut self,
        index: usize,
        way: Way,
        view: &View<'_>,
        size: [i32; 2],
    ) -> Result<Side, HostError> {
        let setting = self.setting(view)?;
        let mut side = Side { fresh: true, ..Side::default() };
        let technique = match way {
            Way::Technique(technique, soft) => match setting.objection(&technique, soft) {
                Some(objection) => {
                    side.objection = Some(objection.in_words());
                    None
                }
                None => Some((technique, soft)),
            },
            Way::Raytraced => {
                side.objection = Some("the first rays are on their way".into());
                None
            }
            Way::None => None,
        };
        if let Some((technique, soft)) = technique {
            self.stage.set_technique(technique)?;
            self.stage.set_soft(soft);
        }
        let (stage, timer) = (&mut self.stage, &mut self.timer);
        let [w, h] = size.map(|side| side as u32);
        let plain =
            |stage: &mut Stage| stage.draw(&setting, w, h, view.samples, ColorFormat::Rgba16F, Buffers::All);
        let shadows = |stage: &mut Stage| match technique {
            Some(_) => stage.add_shadows(&setting),
            None => Ok(()),
        };
        if view.measure {
            let before = timer.time(|| plain(stage))?;
            let after = timer.time(|| shadows(stage))?;
            side.milliseconds = Some([before, before + after]);
        } else {
            plain(stage)?;
            shadows(stage)?;
        }
        side.stats = technique.map(|_| stage.shadows().stats());
        self.depth = Some((view.scene.clone(), view.time, size));
        if let Some(color) = self.stage.color() {
            // SAFETY: the context is current; the stage's picture has this size and one sample.
            unsafe {
                Picture::ensure(&mut self.slots[index].picture, &self.gl, size)?
                    .copy_from(&self.gl, color.framebuffer);
            }
        }
        Ok(side)
    }

    fn setting(&mut self, view: &View<'_>) -> Result<Setting, HostError> {
        let aspect = f64::from(view.rect[2]) / f64::from(view.rect[3]);
        let mut setting = self.stage.setting(view.scene, view.time, aspect)?;
        setting.components = view.components.to_vec();
        Ok(setting)
    }

    /// A scene at a time in antumbra's terms.
    ///
    /// # Errors
    /// Those of a mesh that is none.
    pub(crate) fn describe(&mut self, scene: &Scene, time: f64) -> Result<Setting, HostError> {
        self.stage.setting(scene, time, 1.0)
    }

    /// The shadow map of a light as the first way has it; `None` if that has no maps, or the light none.
    ///
    /// # Errors
    /// Those of the driver.
    pub(crate) fn map(&mut self, view: &View<'_>, light: usize) -> Result<Option<MapPicture>, HostError> {
        let setting = self.setting(view)?;
        let Way::Technique(technique, soft) = view.settings.ways[0] else { return Ok(None) };
        let is_there = technique.has_maps() && light < setting.described.lights.len();
        if !is_there || setting.objection(&technique, soft).is_some() {
            return Ok(None);
        }
        self.ensure_depth(view, &setting)?;
        self.stage.set_technique(technique)?;
        self.stage.set_soft(soft);
        let Some(map) = self.stage.depth_map(&setting, light)? else { return Ok(None) };
        // SAFETY: the context is current, and the map was just drawn.
        unsafe { self.map_view.draw(&self.gl, &map).map(Some) }
    }

    /// Draws the scene if its depth is not there.
    fn ensure_depth(&mut self, view: &View<'_>, setting: &Setting) -> Result<(), HostError> {
        let size = [view.rect[2], view.rect[3]];
        let current = self.depth.as_ref().is_some_and(|(scene, time, of)| {
            Arc::ptr_eq(scene, view.scene) && *time == view.time && *of == size
        });
        if !current {
            let [w, h] = size.map(|side| side as u32);
            self.stage.draw(setting, w, h, 1, ColorFormat::Rgba16F, Buffers::All)?;
            self.depth = Some((view.scene.clone(), view.time, size));
        }
        Ok(())
    }

    fn draw_strokes(&mut self, view: &View<'_>) -> Result<(), HostError> {
        if view.strokes.is_empty() {
            return Ok(());
        }
        let setting = self.setting(view)?;
        let size = [view.rect[2], view.rect[3]];
        self.ensure_depth(view, &setting)?;
        let Some(surface) = self.stage.surface() else { return Ok(()) };
        let place =
            Place { setting: &setting, surface: &surface, texels: size, rect: view.rect, scale: view.scale };
        let [x, y, w, h] = view.rect;
        // SAFETY: the context is current; the surface is the stage's own.
        unsafe {
            let gl = &self.gl;
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            gl.viewport(x, y, w, h);
            gl.enable(glow::SCISSOR_TEST);
            gl.scissor(x, y, w, h);
            let outcome = self.lines.draw(gl, view.strokes, &place);
            gl.disable(glow::SCISSOR_TEST);
            outcome
        }
    }

    /// How far the two sides are apart in what the eye sees: root mean square and largest difference of encoded
    /// colours. `None` unless there are two pictures of one size.
    pub(crate) fn error(&self, exposure: f32) -> Option<[f32; 2]> {
        let [Some(a), Some(b)] = [&self.slots[0].picture, &self.slots[1].picture] else { return None };
        if a.size != b.size {
            return None;
        }
        // SAFETY: the context is current; both pictures are this canvas's.
        let (a, b) = unsafe { (a.read(&self.gl), b.read(&self.gl)) };
        let (mut sum, mut largest) = (0.0f64, 0.0f32);
        for (p, q) in a.iter().zip(&b) {
            for c in 0..3 {
                let apart = (srgb(p[c] * exposure) - srgb(q[c] * exposure)).abs();
                sum += f64::from(apart * apart);
                largest = largest.max(apart);
            }
        }
        Some([(sum / (3.0 * a.len().max(1) as f64)).sqrt() as f32, largest])
    }

    /// The composed picture as it is in the window: width, height and rows of RGB from the top.
    ///
    /// # Errors
    /// Those of the driver.
    pub(crate) fn screenshot(&mut self, view: &View<'_>) -> Result<(u32, u32, Vec<u8>), HostError> {
        self.draw(view)?;
        let [x, y, w, h] = view.rect;
        let mut bytes = vec![0u8; (w.max(0) as usize) * (h.max(0) as usize) * 4];
        // SAFETY: reads memory of the size that is asked for from the window.
        unsafe {
            let gl = &self.gl;
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, None);
            gl.finish();
            gl.pixel_store_i32(glow::PACK_ALIGNMENT, 4);
            let data = glow::PixelPackData::Slice(Some(&mut bytes));
            gl.read_pixels(x, y, w, h, glow::RGBA, glow::UNSIGNED_BYTE, data);
        }
        let rows = bytes.chunks_exact(w.max(1) as usize * 4).rev();
        let rgb = rows.flat_map(|row| row.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]])).collect();
        Ok((w as u32, h as u32, rgb))
    }
}

fn srgb(linear: f32) -> f32 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

impl Drop for Canvas {
    fn drop(&mut self) {
        // SAFETY: the canvas's own objects.
        unsafe {
            for picture in self.slots.iter().filter_map(|slot| slot.picture.as_ref()) {
                picture.delete(&self.gl);
            }
            self.compose.delete(&self.gl);
            self.lines.delete(&self.gl);
            self.map_view.delete(&self.gl);
        }
    }
}
