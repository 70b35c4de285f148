//! A renderer with shaders of its own gets its shadows from antumbra, both ways.
use antumbra::glam::camera::rh::{proj::opengl::perspective, view::look_at_mat4};
use antumbra::glam::{Mat4, Vec3, Vec4, vec3};
use antumbra::glow::{self, HasContext};
use antumbra::{Camera, Encoding, Frame, Framebuffer, Light, Occluder, Renderer, Surface, Texture};
use antumbra_host::{Api, HeadlessContext};
const SIZE: [i32; 2] = [800, 450];
const LIGHTS: [(Vec3, Vec3); 2] =
    [(vec3(3.0, 5.0, 2.0), vec3(90.0, 75.0, 60.0)), (vec3(-4.0, 4.0, 1.0), vec3(15.0, 30.0, 60.0))];
const BALLS: [(Vec3, f32); 3] =
    [(vec3(0.0, 1.0, 0.0), 1.0), (vec3(1.7, 0.5, 0.6), 0.5), (vec3(-1.2, 0.4, 1.4), 0.4)];
// Balls of 64 x 32 facets, and a floor of one.
const VERTEX: &str = "#version 330 core
uniform mat4 view_projection;
uniform vec4 place; // centre and radius
out vec3 world, normal;
void main() {
    const ivec2 quad[6] = ivec2[6](ivec2(0), ivec2(0, 1), ivec2(1), ivec2(0), ivec2(1), ivec2(1, 0));
    ivec2 at = ivec2(gl_VertexID / 6 % 64, gl_VertexID / 384) + quad[gl_VertexID % 6];
    vec2 angle = vec2(at) * 3.14159265 / 32.0;
    normal = vec3(sin(angle.y) * cos(angle.x), cos(angle.y), sin(angle.y) * sin(angle.x));
    vec3 corner = place.w > 0.0 ? normal : vec3(at.x * 2 - 1, 0, at.y * 2 - 1);
    normal = place.w > 0.0 ? normal : vec3(0, 1, 0);
    world = place.xyz + corner * abs(place.w);
    gl_Position = view_projection * vec4(world, 1);
}";
const FRAGMENT: &str = "#version 330 core
in vec3 world, normal;
uniform vec3 position[2], intensity[2];
uniform sampler2D mask; uniform bool masked;
out vec4 color;
void main() {
    vec3 irradiance = vec3(0.3);
    for (int i = 0; i < 2; i++) {
        vec3 l = position[i] - world;
        float visibility = masked ? texelFetch(mask, ivec2(gl_FragCoord.xy), 0)[i] : 1.0;
        irradiance += visibility * intensity[i] * max(dot(normalize(normal), normalize(l)), 0) / dot(l, l);
    }
    color = vec4(pow(0.8 / 3.14159265 * irradiance, vec3(1 / 2.2)), 1);
}";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let context = HeadlessContext::new(Api::Gl33)?;
    let gl = context.gl().clone();
    let (program, depth, [whole, color_only]) = set_up(&gl)?;
    let view = look_at_mat4(vec3(0.0, 3.0, 7.0), vec3(0.0, 0.7, 0.0), Vec3::Y);
    let projection = perspective(0.8, SIZE[0] as f32 / SIZE[1] as f32, 0.5, 100.0);

    // One call at start-up.
    let mut shadows = Renderer::new(gl.clone())?;

    // A description of lights and occluders, in the host's own terms.
    let lights = LIGHTS.map(|(position, intensity)| Light::point(position, intensity));
    let occluders = BALLS.map(|(center, radius)| Occluder::sphere(center, radius));
    // SAFETY: a depth texture that outlives the frame.
    let surface = Surface::from_depth(unsafe { Texture::from_glow(depth) });
    let frame = Frame::new(Camera::new(view, projection), [0, 0, SIZE[0], SIZE[1]], surface)
        .lights(&lights)
        .occluders(&occluders)
        .ambient([0.3; 3]); // as in the shader

    // Way 1, overlay: one call after drawing.
    draw(&gl, program, whole, projection * view, None);
    // SAFETY: a framebuffer of this context.
    let target = unsafe { Framebuffer::from_glow(Some(color_only)) };
    shadows.overlay_to(&frame, Encoding::Gamma(2.2), target)?;
    save(&gl, "overlay.png")?;

    // Way 2, masks: the host's own shader looks up how much of each light arrives.
    let mut batches = shadows.masks(&frame)?;
    while let Some(batch) = batches.next()? {
        draw(&gl, program, whole, projection * view, Some(batch.textures[0].glow()));
    }
    save(&gl, "masks.png")?;
    println!("wrote overlay.png and masks.png");
    Ok(())
}

/// The host's frame.
fn draw(
    gl: &glow::Context,
    program: glow::Program,
    to: glow::Framebuffer,
    camera: Mat4,
    mask: Option<glow::Texture>,
) {
    // SAFETY: objects of this context, uniforms of the types the program has.
    unsafe {
        let set = |name: &str| gl.get_uniform_location(program, name);
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(to));
        gl.viewport(0, 0, SIZE[0], SIZE[1]);
        gl.enable(glow::DEPTH_TEST);
        gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        gl.use_program(Some(program));
        gl.uniform_matrix_4_f32_slice(set("view_projection").as_ref(), false, &camera.to_cols_array());
        gl.uniform_3_f32_slice(set("position").as_ref(), &LIGHTS.map(|l| l.0.to_array()).concat());
        gl.uniform_3_f32_slice(set("intensity").as_ref(), &LIGHTS.map(|l| l.1.to_array()).concat());
        gl.uniform_1_i32(set("masked").as_ref(), mask.is_some().into());
        gl.bind_texture(glow::TEXTURE_2D, mask);
        let floor = (Vec4::new(0.0, 0.0, 0.0, -20.0), 6);
        for (place, vertices) in BALLS.map(|(c, r)| (c.extend(r), 64 * 32 * 6)).into_iter().chain([floor]) {
            gl.uniform_4_f32_slice(set("place").as_ref(), &place.to_array());
            gl.draw_arrays(glow::TRIANGLES, 0, vertices);
        }
    }
}

/// A program, a depth texture, and framebuffers with colour and depth and with the same colour alone.
fn set_up(gl: &glow::Context) -> Result<(glow::Program, glow::Texture, [glow::Framebuffer; 2]), String> {
    // SAFETY: fresh objects of this context; no memory is read.
    unsafe {
        let program = gl.create_program()?;
        for (kind, source) in [(glow::VERTEX_SHADER, VERTEX), (glow::FRAGMENT_SHADER, FRAGMENT)] {
            let shader = gl.create_shader(kind)?;
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            gl.attach_shader(program, shader);
        }
        gl.link_program(program);
        gl.bind_vertex_array(Some(gl.create_vertex_array()?));
        let textures = [gl.create_texture()?, gl.create_texture()?];
        for (texture, format) in textures.into_iter().zip([glow::RGBA8, glow::DEPTH_COMPONENT24]) {
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.tex_storage_2d(glow::TEXTURE_2D, 1, format, SIZE[0], SIZE[1]);
        }
        let framebuffers = [gl.create_framebuffer()?, gl.create_framebuffer()?];
        for (framebuffer, depth) in framebuffers.into_iter().zip([Some(textures[1]), None]) {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let attach =
                |at, texture| gl.framebuffer_texture_2d(glow::FRAMEBUFFER, at, glow::TEXTURE_2D, texture, 0);
            attach(glow::COLOR_ATTACHMENT0, Some(textures[0]));
            attach(glow::DEPTH_ATTACHMENT, depth);
        }
        Ok((program, textures[1], framebuffers))
    }
}

fn save(gl: &glow::Context, path: &str) -> Result<(), Box<dyn std::error::Error>> {
    let mut pixels = vec![0; (SIZE[0] * SIZE[1] * 4) as usize];
    let bytes = glow::PixelPackData::Slice(Some(&mut pixels));
    // SAFETY: the memory is as large as the picture.
    unsafe { gl.read_pixels(0, 0, SIZE[0], SIZE[1], glow::RGBA, glow::UNSIGNED_BYTE, bytes) };
    let mut encoder = png::Encoder::new(std::fs::File::create(path)?, SIZE[0] as u32, SIZE[1] as u32);
    encoder.set_color(png::ColorType::Rgba);
    let rows: Vec<u8> = pixels.chunks(SIZE[0] as usize * 4).rev().flatten().copied().collect();
    Ok(encoder.write_header()?.write_image_data(&rows)?)
}
