//! What shadows are made of: which lines are drawn, what they mean, and the numbers.

use std::sync::Arc;

use antumbra_host::Described;
use antumbra_scene::{Moment, Scene, Shape};
use egui::{Align2, Color32, FontId, Grid, Painter, Rect, RichText, Ui, pos2, vec2};

use super::Seen;
use crate::canvas::lines::Stroke;
use crate::canvas::map_view::{CROSS, TEXTURE};
use crate::model::Model;
use crate::model::pick::Item;
use crate::model::settings::Teaching;
use crate::teach::{Drawing, Fact, LineKind, Situation};

/// Tangent rays of a shadow.
const RAYS: usize = 12;

/// Shadows that lines are drawn of, at most: more are a thicket.
const MOST_PAIRS: usize = 200;

/// Facts at most.
const MOST_FACTS: usize = 24;

/// What is shown of a moment; kept until something changes.
#[derive(Default)]
pub(crate) struct Lesson {
    key: Option<Key>,
    /// The lines.
    pub(crate) strokes: Vec<Stroke>,
    /// What the lines are, for the legend.
    kinds: Vec<LineKind>,
    /// The numbers.
    pub(crate) facts: Vec<Fact>,
    /// What is not drawn, and why.
    pub(crate) notes: Vec<String>,
}

struct Key {
    scene: Arc<Scene>,
    time: f64,
    teaching: Teaching,
    light: usize,
    chosen: Option<Item>,
}

impl Lesson {
    /// Whether it is of what the model shows; if not, [`Self::learn`] has to be called.
    pub(crate) fn is_current(&self, model: &Model) -> bool {
        self.key.as_ref().is_some_and(|key| {
            Arc::ptr_eq(&key.scene, model.scene())
                && key.time == model.clock.time
                && key.teaching == model.settings.teaching
                && key.light == model.light
                && key.chosen == model.chosen
        })
    }

    /// Whether there is nothing to teach.
    pub(crate) fn is_empty(teaching: &Teaching) -> bool {
        !(teaching.outlines || teaching.rays || teaching.conics || teaching.volumes)
    }

    /// Finds the lines and numbers.
    pub(crate) fn learn(&mut self, model: &Model, moment: &Moment, described: &Described) {
        let teaching = model.settings.teaching;
        let mut drawing = Drawing::default();
        self.facts.clear();
        self.notes.clear();
        let situation = Situation::new(model.scene(), moment, described);
        let wanted = |&(light, primitive): &(usize, usize)| {
            // An infinite plane hides half of the world, which nobody needs lines for.
            if moment.primitives.get(primitive).is_none_or(|p| p.shape == Shape::Plane) {
                return false;
            }
            let of_light = !teaching.chosen_light || light == model.light;
            let of_object = match model.chosen {
                Some(Item::Object(object)) => {
                    moment.primitives.get(primitive).is_some_and(|p| p.object == object)
                }
                _ => true,
            };
            of_light && of_object
        };
        let pairs: Vec<(usize, usize)> = situation.pairs().filter(wanted).collect();
        if pairs.len() > MOST_PAIRS {
            self.notes.push(format!("{MOST_PAIRS} of {} shadows are drawn; choose an object", pairs.len()));
        }
        let (_, radius) = extent(moment);
        for (light, primitive) in pairs.into_iter().take(MOST_PAIRS) {
            if teaching.outlines {
                situation.outlines(light, primitive, &mut drawing);
            }
            if teaching.rays {
                situation.tangent_rays(light, primitive, RAYS, &mut drawing);
            }
            if teaching.volumes {
                situation.volume(light, primitive, 2.0 * radius, &mut drawing);
            }
            if teaching.conics && self.facts.len() < MOST_FACTS {
                self.facts.extend(situation.facts(light, primitive));
            }
        }
        self.facts.truncate(MOST_FACTS);
        let texts = drawing.notes.into_iter().map(|note| note.text);
        self.notes.extend(texts.take(MOST_FACTS));
        self.kinds = drawing.lines.iter().map(|line| line.kind).collect();
        self.kinds.sort_unstable();
        self.kinds.dedup();
        self.strokes = drawing
            .lines
            .into_iter()
            .map(|line| {
                let (color, width) = look(line.kind);
                Stroke { points: line.points, closed: line.closed, color, width }
            })
            .collect();
        self.key = Some(Key {
            scene: model.scene().clone(),
            time: model.clock.time,
            teaching,
            light: model.light,
            chosen: model.chosen,
        });
    }

    /// Teaches nothing.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }
}

/// Middle and radius of what has bounds, metres.
fn extent(moment: &Moment) -> (antumbra::glam::DVec3, f64) {
    let boxes = moment.primitives.iter().filter_map(antumbra_scene::Primitive::bounds);
    match boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) {
        Some((low, high)) => (0.5 * (low + high), 0.5 * low.distance(high).max(0.1)),
        None => (antumbra::glam::DVec3::ZERO, 1.0),
    }
}

/// Colour, sRGB with opacity, and width of a kind of line.
fn look(kind: LineKind) -> ([f32; 4], f32) {
    match kind {
        LineKind::HardEdge => ([1.0, 0.85, 0.2, 1.0], 2.0),
        LineKind::Silhouette => ([1.0, 0.85, 0.2, 0.7], 1.2),
        LineKind::Penumbra => ([1.0, 0.6, 0.15, 1.0], 2.0),
        LineKind::Umbra => ([1.0, 0.25, 0.3, 1.0], 2.0),
        LineKind::Antumbra => ([0.35, 0.85, 1.0, 1.0], 2.0),
        LineKind::TangentRay => ([1.0, 0.95, 0.6, 0.8], 1.2),
        LineKind::PenumbraRay => ([1.0, 0.75, 0.4, 0.8], 1.2),
        LineKind::UmbraRay => ([1.0, 0.45, 0.45, 0.8], 1.2),
        LineKind::VolumeSide => ([0.55, 0.75, 1.0, 0.35], 1.0),
        LineKind::NearCap => ([0.4, 0.65, 1.0, 1.0], 1.6),
        LineKind::FarCap => ([0.4, 0.65, 1.0, 1.0], 1.6),
    }
}

fn kind_name(kind: LineKind) -> &'static str {
    match kind {
        LineKind::HardEdge => "edge of the shadow",
        LineKind::Silhouette => "shadow of the silhouette",
        LineKind::Penumbra => "penumbra, outer edge",
        LineKind::Umbra => "umbra",
        LineKind::Antumbra => "antumbra",
        LineKind::TangentRay => "tangent rays",
        LineKind::PenumbraRay => "rays to the penumbra's edge",
        LineKind::UmbraRay => "rays to the umbra's or antumbra's edge",
        LineKind::VolumeSide => "sides of the volume",
        LineKind::NearCap => "silhouette, near cap",
        LineKind::FarCap => "far cap",
    }
}

/// What the lines in the picture are.
pub(crate) fn legend(painter: &Painter, rect: Rect, lesson: &Lesson) {
    let font = FontId::proportional(12.0);
    let rows: Vec<_> = lesson
        .kinds
        .iter()
        .map(|&kind| (kind, painter.layout_no_wrap(kind_name(kind).to_owned(), font.clone(), Color32::WHITE)))
        .collect();
    let width = rows.iter().map(|(_, text)| text.size().x).fold(0.0, f32::max);
    if rows.is_empty() || rect.height() < 200.0 {
        return;
    }
    let size = vec2(width + 46.0, 18.0 * rows.len() as f32 + 10.0);
    let area = Align2::RIGHT_BOTTOM.anchor_size(rect.right_bottom() - vec2(10.0, 10.0), size);
    painter.rect_filled(area, 4.0, Color32::from_black_alpha(180));
    for (i, (kind, text)) in rows.into_iter().enumerate() {
        let y = area.top() + 14.0 + 18.0 * i as f32;
        let ([r, g, b, a], width) = look(kind);
        let color = egui::Color32::from_rgba_unmultiplied(
            (r * 255.0) as u8,
            (g * 255.0) as u8,
            (b * 255.0) as u8,
            (a * 255.0) as u8,
        );
        painter.line_segment(
            [pos2(area.left() + 8.0, y), pos2(area.left() + 30.0, y)],
            egui::Stroke::new(width.max(1.5), color),
        );
        painter.galley(pos2(area.left() + 38.0, y - 0.5 * text.size().y), text, Color32::WHITE);
    }
}

/// The panel's section.
pub(crate) fn section(ui: &mut Ui, model: &mut Model, seen: &Seen) {
    let teaching = &mut model.settings.teaching;
    ui.checkbox(&mut teaching.outlines, "outlines")
        .on_hover_text("Edges of umbra, penumbra and antumbra on flat receivers");
    ui.checkbox(&mut teaching.rays, "tangent rays")
        .on_hover_text("From the light along the occluder to the shadow's edge");
    ui.checkbox(&mut teaching.volumes, "shadow volumes")
        .on_hover_text("The polygons that the technique volume draws");
    ui.checkbox(&mut teaching.map, "map from the light")
        .on_hover_text("What the technique map keeps of the chosen light");
    ui.checkbox(&mut teaching.conics, "conics").on_hover_text("Kind and numbers of the shadows' outlines");
    ui.checkbox(&mut teaching.chosen_light, "of the chosen light alone");
    for note in &seen.lesson.notes {
        ui.label(RichText::new(note).weak().small());
    }
    if model.settings.teaching.conics && seen.lesson.facts.is_empty() {
        ui.label(RichText::new("no shadow with a closed outline on a flat receiver").weak());
    }
    for (i, fact) in seen.lesson.facts.iter().enumerate() {
        ui.separator();
        ui.label(RichText::new(&fact.title).strong());
        let width = (ui.available_width() - 96.0).max(80.0);
        Grid::new(("fact", i)).num_columns(2).spacing([8.0, 2.0]).max_col_width(width).show(ui, |ui| {
            for (label, value) in &fact.lines {
                ui.label(RichText::new(label).weak().small());
                ui.add(egui::Label::new(RichText::new(value).small()).wrap());
                ui.end_row();
            }
        });
    }
}

/// The map of the chosen light, in a window over the picture.
pub(crate) fn map(ui: &Ui, rect: Rect, model: &Model, seen: &Seen) {
    if !model.settings.teaching.map {
        return;
    }
    let name = model.scene().lights.get(model.light).map_or("no light", |light| light.name.as_str());
    egui::Window::new("map from the light")
        .title_bar(false)
        .resizable(false)
        .pivot(Align2::LEFT_BOTTOM)
        .default_pos(rect.left_bottom() + vec2(10.0, -10.0))
        .constrain_to(rect)
        .show(ui.ctx(), |ui| match &seen.map {
            Some(map) => {
                ui.label(format!("The map of {name}"));
                let size = vec2(map.size[0] as f32, map.size[1] as f32);
                let size = size * (rect.width() * 0.35 / size.x).min(rect.height() * 0.4 / size.y).min(1.0);
                // OpenGL's rows go up.
                let [w, h] = [0, 1].map(|i| map.size[i] as f32 / TEXTURE[i] as f32);
                let image =
                    egui::Image::new((map.id, size)).uv(Rect::from_min_max(pos2(0.0, h), pos2(w, 0.0)));
                let place = ui.add(image).rect;
                if map.size == TEXTURE {
                    face_names(ui.painter(), place);
                }
                ui.label(RichText::new(&map.caption).weak().small());
            }
            None => {
                ui.label(format!(
                    "There is no map of {name}: only the technique map has one, and of lights that are on"
                ));
            }
        });
}

/// Which face of an unfolded cube is which.
fn face_names(painter: &Painter, place: Rect) {
    let face = vec2(place.width() / 4.0, place.height() / 3.0);
    for (name, [column, row]) in ["+X", "-X", "+Y", "-Y", "+Z", "-Z"].into_iter().zip(CROSS) {
        let at = place.left_bottom() + vec2(face.x * column as f32 + 4.0, -face.y * row as f32 - 3.0);
        painter.text(at, Align2::LEFT_BOTTOM, name, FontId::proportional(10.0), Color32::from_gray(150));
    }
}
