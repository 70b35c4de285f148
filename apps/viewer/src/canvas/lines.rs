//! Lines in the world, drawn over the picture: smooth, and dashed where something is in front of them.

use antumbra::glam::{DVec2, DVec3, Vec2};
use antumbra::{Depth, Surface};
use antumbra_host::{HostError, Setting};
use bytemuck::{Pod, Zeroable};
use glow::HasContext;

use super::program::Program;

/// A line in the world.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stroke {
    /// Its points, metres.
    pub(crate) points: Vec<DVec3>,
    /// Whether the last point is joined to the first.
    pub(crate) closed: bool,
    /// sRGB and opacity.
    pub(crate) color: [f32; 4],
    /// Points of the interface, across.
    pub(crate) width: f32,
}

/// As the shader takes it.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Vertex {
    position: [f32; 2],
    inverse: f32,
    color: [f32; 4],
    edge: [f32; 3],
}

/// What draws lines.
pub(crate) struct Lines {
    /// For depth textures of one sample a pixel, and of several (OpenGL alone has those).
    programs: [Option<Program>; 2],
    vertex_array: glow::VertexArray,
    buffer: glow::Buffer,
    vertices: Vec<Vertex>,
}

/// Where lines are drawn.
pub(crate) struct Place<'a> {
    /// The camera's scene.
    pub(crate) setting: &'a Setting,
    /// What was drawn of it: its depth.
    pub(crate) surface: &'a Surface,
    /// Size of the depth, texels.
    pub(crate) texels: [i32; 2],
    /// The picture in the window: x, y, width, height, pixels from the bottom left.
    pub(crate) rect: [i32; 4],
    /// Pixels for a point of the interface.
    pub(crate) scale: f32,
}

const VERTEX: &str = include_str!("shaders/line.vert.glsl");
const FRAGMENT: &str = include_str!("shaders/line.frag.glsl");

impl Lines {
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, HostError> {
        // SAFETY: the caller's; the attributes are laid out as `Vertex` is.
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(HostError::Driver)?;
            let buffer = gl.create_buffer().map_err(HostError::Driver)?;
            gl.bind_vertex_array(Some(vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let mut offset = 0;
            for (location, floats) in (0..).zip([2, 1, 4, 3]) {
                gl.enable_vertex_attrib_array(location);
                let stride = size_of::<Vertex>() as i32;
                gl.vertex_attrib_pointer_f32(location, floats, glow::FLOAT, false, stride, offset);
                offset += floats * size_of::<f32>() as i32;
            }
            gl.bind_vertex_array(None);
            gl.bind_buffer(glow::ARRAY_BUFFER, None);
            Ok(Self { programs: [None, None], vertex_array, buffer, vertices: Vec::new() })
        }
    }

    /// Draws into the bound framebuffer.
    ///
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// The context is current, and the surface's textures exist.
    pub(crate) unsafe fn draw(
        &mut self,
        gl: &glow::Context,
        strokes: &[Stroke],
        place: &Place<'_>,
    ) -> Result<(), HostError> {
        self.vertices.clear();
        for stroke in strokes {
            push_stroke(&mut self.vertices, stroke, place);
        }
        if self.vertices.is_empty() {
            return Ok(());
        }
        let sampled = usize::from(place.surface.samples > 1);
        let [x, y, w, h] = place.rect;
        let Depth::Texture(depth) = place.surface.depth else { return Ok(()) };
        let depth = depth.glow();
        // SAFETY: the caller's; the buffer holds as many vertices as are drawn.
        unsafe {
            if self.programs[sampled].is_none() {
                let define = if sampled == 1 { "#define SAMPLES\n" } else { "" };
                self.programs[sampled] = Some(Program::new(gl, VERTEX, &format!("{define}{FRAGMENT}"))?);
            }
            let Some(program) = &self.programs[sampled] else { return Ok(()) };
            gl.use_program(Some(program.raw));
            gl.active_texture(glow::TEXTURE0);
            let target = if sampled == 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
            gl.bind_texture(target, Some(depth));
            gl.uniform_1_i32(program.uniform(gl, "u_depth").as_ref(), 0);
            gl.uniform_1_f32(program.uniform(gl, "u_near").as_ref(), place.setting.near() as f32);
            gl.uniform_2_f32(program.uniform(gl, "u_origin").as_ref(), x as f32, y as f32);
            let texels = [place.texels[0] as f32 / w as f32, place.texels[1] as f32 / h as f32];
            gl.uniform_2_f32(program.uniform(gl, "u_texels").as_ref(), texels[0], texels[1]);
            gl.bind_vertex_array(Some(self.vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
            let bytes = bytemuck::cast_slice(&self.vertices);
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::STREAM_DRAW);
            gl.enable(glow::BLEND);
            gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
            gl.draw_arrays(glow::TRIANGLES, 0, self.vertices.len() as i32);
            gl.disable(glow::BLEND);
            gl.bind_vertex_array(None);
            gl.bind_buffer(glow::ARRAY_BUFFER, None);
            gl.bind_texture(target, None);
        }
        Ok(())
    }

    /// # Safety
    /// The context is current, and the lines are not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_vertex_array(self.vertex_array);
            gl.delete_buffer(self.buffer);
            for program in self.programs.iter().flatten() {
                gl.delete_program(program.raw);
            }
        }
    }
}

/// A point on the screen: pixels from the middle of the picture, and 1 / distance.
#[derive(Clone, Copy)]
struct Seen {
    at: DVec2,
    inverse: f64,
}

/// Appends the quads of a line, a little longer than its segments so that they join.
fn push_stroke(vertices: &mut Vec<Vertex>, stroke: &Stroke, place: &Place<'_>) {
    let camera = place.setting.camera();
    let size = DVec2::new(f64::from(place.rect[2]), f64::from(place.rect[3]));
    let pixels = DVec2::new(camera.projection.x_axis.x, camera.projection.y_axis.y) * size * 0.5;
    let points: Vec<DVec3> = stroke.points.iter().map(|p| camera.view.transform_point3(*p)).collect();
    let closing = usize::from(stroke.closed && points.len() > 2);
    let half = f64::from(0.5 * stroke.width * place.scale);
    let mut along = 0.0;
    for i in 0..(points.len() + closing).saturating_sub(1) {
        let Some([a, b]) = in_front(points[i], points[(i + 1) % points.len()], place.setting.near()) else {
            continue;
        };
        let seen = |p: DVec3| Seen { at: p.truncate() / -p.z * pixels, inverse: -1.0 / p.z };
        let (a, b) = (seen(a), seen(b));
        let Some([a, b]) = clipped(a, b, size) else { continue };
        let length = a.at.distance(b.at);
        let forward = (b.at - a.at).normalize_or(DVec2::X);
        let across = forward.perp();
        let corner = |end: Seen, side: f64, beyond: f64, along: f64| {
            let reach = half + 1.0;
            let position = (end.at + across * (side * reach) + forward * (beyond * half)) / (0.5 * size);
            Vertex {
                position: position.as_vec2().to_array(),
                inverse: end.inverse as f32,
                color: stroke.color,
                edge: Vec2::new((side * reach) as f32, half as f32).extend(along as f32).to_array(),
            }
        };
        let (start, end) = (along, along + length);
        let quad = [
            corner(a, -1.0, -1.0, start),
            corner(a, 1.0, -1.0, start),
            corner(b, 1.0, 1.0, end),
            corner(b, -1.0, 1.0, end),
        ];
        vertices.extend([quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]]);
        along = end % 4096.0;
    }
}

/// The part of a segment in view space that is in front of the eye; `None` if there is none, or a point is no number.
fn in_front(a: DVec3, b: DVec3, near: f64) -> Option<[DVec3; 2]> {
    let (da, db) = (-a.z - near, -b.z - near);
    if !(a.is_finite() && b.is_finite()) || (da <= 0.0 && db <= 0.0) {
        return None;
    }
    let cut = || a.lerp(b, da / (da - db));
    Some([if da > 0.0 { a } else { cut() }, if db > 0.0 { b } else { cut() }])
}

/// The part of a segment in the picture and a little round it: beyond there is nothing to see, and numbers grow. On the
/// screen 1 / distance is linear.
fn clipped(a: Seen, b: Seen, size: DVec2) -> Option<[Seen; 2]> {
    if !(a.at.is_finite() && b.at.is_finite()) {
        return None;
    }
    let (mut first, mut last) = (0.0f64, 1.0f64);
    for (from, to, limit) in [(a.at.x, b.at.x, size.x), (a.at.y, b.at.y, size.y)] {
        for sign in [1.0, -1.0] {
            // Inside where the distance to this side is above zero.
            let (here, there) = (limit - sign * from, limit - sign * to);
            if here < 0.0 && there < 0.0 {
                return None;
            }
            let crossing = here / (here - there);
            if here < 0.0 {
                first = first.max(crossing);
            } else if there < 0.0 {
                last = last.min(crossing);
            }
        }
    }
    let at = |t: f64| Seen { at: a.at.lerp(b.at, t), inverse: a.inverse + (b.inverse - a.inverse) * t };
    (first < last).then(|| [at(first), at(last)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_ends_are_cut_off() {
        let seen = |x: f64, y: f64, inverse| Seen { at: DVec2::new(x, y), inverse };
        let size = DVec2::new(100.0, 50.0);
        let [a, b] = clipped(seen(0.0, 0.0, 1.0), seen(1e9, 0.0, 1e7), size).expect("a part");
        assert_eq!((a.at, b.at), (DVec2::ZERO, DVec2::new(100.0, 0.0)), "up to the side");
        assert!((b.inverse - 2.0).abs() < 1e-6, "and as far away as it is there: {}", b.inverse);
        assert!(clipped(seen(-200.0, 0.0, 1.0), seen(0.0, 200.0, 1.0), size).is_none(), "past a corner");
        assert!(clipped(seen(-1e9, -1e8, 1.0), seen(1e9, 1e8, 1.0), size).is_some(), "right across");
        assert!(clipped(seen(f64::NAN, 0.0, 1.0), seen(0.0, 0.0, 1.0), size).is_none(), "nowhere");
    }

    #[test]
    fn what_is_behind_is_cut_off() {
        let [a, b] = in_front(DVec3::new(0.0, 0.0, -1.0), DVec3::new(2.0, 0.0, 1.0), 0.5).expect("a part");
        assert_eq!((a, b), (DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.5, 0.0, -0.5)), "up to the near plane");
        assert!(in_front(DVec3::Z, DVec3::Z * 2.0, 0.5).is_none(), "all of it behind");
        assert!(in_front(DVec3::NAN, -DVec3::Z, 0.5).is_none(), "nowhere");
    }
}
