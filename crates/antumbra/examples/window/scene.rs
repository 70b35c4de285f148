//! Balls on a floor, drawn and lit without shadows.

use crate::shadows::{AMBIENT, BALLS, LIGHTS};
use antumbra::glam::camera::rh::{proj::opengl::perspective, view::look_at_mat4};
use antumbra::glam::{Mat4, Vec3, vec3};
use antumbra::glow::{self, HasContext};
use std::path::Path;

// Balls of 256 x 128 facets, and a floor of one.
const VERTEX: &str = "#version 330 core
uniform mat4 view_projection;
uniform vec4 place; // centre and radius
out vec3 world, normal;
void main() {
    const ivec2 quad[6] = ivec2[6](ivec2(0), ivec2(0, 1), ivec2(1), ivec2(0), ivec2(1), ivec2(1, 0));
    ivec2 at = ivec2(gl_VertexID / 6 % 256, gl_VertexID / 1536) + quad[gl_VertexID % 6];
    vec2 angle = vec2(at) * 3.14159265 / 128.0;
    normal = vec3(sin(angle.y) * cos(angle.x), cos(angle.y), sin(angle.y) * sin(angle.x));
    vec3 corner = place.w > 0.0 ? normal : vec3(at.x * 2 - 1, 0, at.y * 2 - 1);
    normal = place.w > 0.0 ? normal : vec3(0, 1, 0);
    world = place.xyz + corner * abs(place.w);
    gl_Position = view_projection * vec4(world, 1);
}";
const FRAGMENT: &str = "#version 330 core
in vec3 world, normal;
uniform vec3 position[2], intensity[2], ambient;
out vec4 color;
void main() {
    vec3 irradiance = ambient;
    for (int i = 0; i < 2; i++) {
        vec3 l = position[i] - world;
        irradiance += intensity[i] * max(dot(normalize(normal), normalize(l)), 0) / dot(l, l);
    }
    color = vec4(pow(0.8 / 3.14159265 * irradiance, vec3(1 / 2.2)), 1);
}";

pub(crate) struct Scene {
    program: glow::Program,
}

/// View and projection of an eye that goes slowly round.
pub(crate) fn camera(time: f32, [width, height]: [i32; 2]) -> (Mat4, Mat4) {
    let (sin, cos) = (0.2 * time).sin_cos();
    let view = look_at_mat4(vec3(7.0 * sin, 3.0, 7.0 * cos), vec3(0.0, 0.7, 0.0), Vec3::Y);
    (view, perspective(0.8, width as f32 / height as f32, 0.5, 100.0))
}

impl Scene {
    pub(crate) fn new(gl: &glow::Context) -> Result<Self, String> {
        // SAFETY: fresh objects of this context.
        unsafe {
            let program = gl.create_program()?;
            for (kind, source) in [(glow::VERTEX_SHADER, VERTEX), (glow::FRAGMENT_SHADER, FRAGMENT)] {
                let shader = gl.create_shader(kind)?;
                gl.shader_source(shader, source);
                gl.compile_shader(shader);
                gl.attach_shader(program, shader);
            }
            gl.link_program(program);
            if !gl.get_program_link_status(program) {
                return Err(gl.get_program_info_log(program));
            }
            gl.bind_vertex_array(Some(gl.create_vertex_array()?));
            Ok(Self { program })
        }
    }

    pub(crate) fn draw(&self, gl: &glow::Context, [width, height]: [i32; 2], camera: Mat4) {
        // SAFETY: objects of this context, uniforms of the types the program has.
        unsafe {
            let set = |name: &str| gl.get_uniform_location(self.program, name);
            gl.viewport(0, 0, width, height);
            gl.clear_color(0.45, 0.5, 0.55, 1.0);
            gl.enable(glow::DEPTH_TEST);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.use_program(Some(self.program));
            gl.uniform_matrix_4_f32_slice(set("view_projection").as_ref(), false, &camera.to_cols_array());
            gl.uniform_3_f32_slice(set("position").as_ref(), &LIGHTS.map(|light| light.0).concat());
            gl.uniform_3_f32_slice(set("intensity").as_ref(), &LIGHTS.map(|light| light.1).concat());
            gl.uniform_3_f32_slice(set("ambient").as_ref(), &AMBIENT);
            let balls = BALLS.map(|([x, y, z], radius)| ([x, y, z, radius], 256 * 128 * 6));
            for (place, vertices) in balls.into_iter().chain([([0.0, 0.0, 0.0, -20.0], 6)]) {
                gl.uniform_4_f32_slice(set("place").as_ref(), &place);
                gl.draw_arrays(glow::TRIANGLES, 0, vertices);
            }
        }
    }
}

/// What the window is about to show.
pub(crate) fn save(
    gl: &glow::Context,
    [width, height]: [i32; 2],
    path: &Path,
) -> Result<(), Box<dyn std::error::Error>> {
    let mut pixels = vec![0; (width * height * 4) as usize];
    let bytes = glow::PixelPackData::Slice(Some(&mut pixels));
    // SAFETY: objects of this context, deleted again; the memory is as large as the picture.
    unsafe {
        // The window's samples, made one.
        let (resolved, color) = (gl.create_framebuffer()?, gl.create_renderbuffer()?);
        gl.bind_renderbuffer(glow::RENDERBUFFER, Some(color));
        gl.renderbuffer_storage(glow::RENDERBUFFER, glow::RGBA8, width, height);
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(resolved));
        let attachment = glow::COLOR_ATTACHMENT0;
        gl.framebuffer_renderbuffer(glow::DRAW_FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(color));
        let (mask, filter) = (glow::COLOR_BUFFER_BIT, glow::NEAREST);
        gl.blit_framebuffer(0, 0, width, height, 0, 0, width, height, mask, filter);
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(resolved));
        gl.read_pixels(0, 0, width, height, glow::RGBA, glow::UNSIGNED_BYTE, bytes);
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        gl.delete_framebuffer(resolved);
        gl.delete_renderbuffer(color);
    }
    let mut encoder = png::Encoder::new(std::fs::File::create(path)?, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgba);
    // Opaque, whatever the window's alpha is; rows from top to bottom.
    pixels.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
    let rows: Vec<u8> = pixels.chunks(width as usize * 4).rev().flatten().copied().collect();
    Ok(encoder.write_header()?.write_image_data(&rows)?)
}
