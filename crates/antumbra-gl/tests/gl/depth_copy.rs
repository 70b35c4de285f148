//! Hosts whose depth is no texture of theirs: renderbuffers, and textures that an engine hides.

use crate::cameras::REVERSED;
use crate::context::{Gl, Kind, in_each, in_each_api};
use crate::leaks::live;
use crate::lights::many_lights;
use crate::shot::{Canvas, Shot, VIEWPORT};
use crate::snapshot::{assert_same, snapshot};
use crate::{full_screen, odd_host::OddHost, samples};
use antumbra_gl::{
    DepthFormat, Encoding, Error, Frame, Framebuffer, Renderer, Surface, Texture, Unsupported,
};
use glow::HasContext;

const SIZE: [i32; 2] = [VIEWPORT[2], VIEWPORT[3]];

/// Depth formats, and what they are to the renderer.
const FORMATS: [(u32, DepthFormat); 5] = [
    (glow::DEPTH_COMPONENT16, DepthFormat::fixed(16)),
    (glow::DEPTH_COMPONENT24, DepthFormat::fixed(24)),
    (glow::DEPTH24_STENCIL8, DepthFormat::fixed(24)),
    (glow::DEPTH_COMPONENT32F, DepthFormat::float()),
    (glow::DEPTH32F_STENCIL8, DepthFormat::float()),
];

/// Where a host keeps the depth it draws.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Keeps {
    Texture,
    Renderbuffer,
}

/// A host's framebuffer with white colour and with the depth of a shot, drawn.
struct Host {
    framebuffer: glow::Framebuffer,
    /// Multisampled if the depth is.
    color: Option<glow::Texture>,
    depth: Option<glow::Texture>,
    renderbuffers: Vec<glow::Renderbuffer>,
}

impl Host {
    fn new(gl: &Gl, shot: &Shot<'_>, format: u32, samples: i32, keeps: Keeps) -> Self {
        let context = &gl.gl;
        let [width, height] = SIZE;
        let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
        let attachment = match format {
            glow::DEPTH24_STENCIL8 | glow::DEPTH32F_STENCIL8 => glow::DEPTH_STENCIL_ATTACHMENT,
            _ => glow::DEPTH_ATTACHMENT,
        };
        // SAFETY: fresh objects of this context.
        unsafe {
            let storage = |format: u32| {
                let texture = context.create_texture().expect("a texture");
                context.bind_texture(kind, Some(texture));
                match samples {
                    1 => context.tex_storage_2d(kind, 1, format, width, height),
                    _ => context.tex_image_2d_multisample(kind, samples, format as i32, width, height, true),
                }
                context.bind_texture(kind, None);
                texture
            };
            let framebuffer = context.create_framebuffer().expect("a framebuffer");
            context.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let attach =
                |at, texture| context.framebuffer_texture_2d(glow::FRAMEBUFFER, at, kind, Some(texture), 0);
            let (mut color, mut depth, mut renderbuffers) = (None, None, Vec::new());
            let mut buffer = |at, format| {
                let buffer = context.create_renderbuffer().expect("a renderbuffer");
                context.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                let samples = if samples > 1 { samples } else { 0 };
                context.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, width, height);
                context.bind_renderbuffer(glow::RENDERBUFFER, None);
                context.framebuffer_renderbuffer(glow::FRAMEBUFFER, at, glow::RENDERBUFFER, Some(buffer));
                renderbuffers.push(buffer);
            };
            if samples > 1 && gl.kind != Kind::Gl33 {
                buffer(glow::COLOR_ATTACHMENT0, glow::RGBA8); // OpenGL ES 3.0 has no multisampled textures
            } else {
                let texture = storage(glow::RGBA8);
                attach(glow::COLOR_ATTACHMENT0, texture);
                color = Some(texture);
            }
            if keeps == Keeps::Texture {
                let texture = storage(format);
                attach(attachment, texture);
                depth = Some(texture);
            } else {
                buffer(attachment, format);
            }
            let status = context.check_framebuffer_status(glow::FRAMEBUFFER);
            assert_eq!(status, glow::FRAMEBUFFER_COMPLETE, "a host's framebuffer");
            let program = full_screen::program(
                context,
                "uniform highp sampler2D u_depth; out vec4 color;
                void main() { color = vec4(1.0); gl_FragDepth = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).x; }",
            );
            context.use_program(Some(program));
            context.active_texture(glow::TEXTURE0);
            context.bind_texture(glow::TEXTURE_2D, Some(shot.depth));
            context.enable(glow::DEPTH_TEST);
            context.depth_func(glow::ALWAYS);
            full_screen::draw(context, framebuffer, SIZE);
            context.depth_func(glow::LESS);
            context.disable(glow::DEPTH_TEST);
            context.bind_texture(glow::TEXTURE_2D, None);
            context.use_program(None);
            context.delete_program(program);
            Self { framebuffer, color, depth, renderbuffers }
        }
    }

    fn color(&self) -> glow::Texture {
        self.color.expect("a host that draws to textures")
    }

    fn named(&self) -> Framebuffer {
        // SAFETY: it lives as long as the host.
        unsafe { Framebuffer::from_glow(Some(self.framebuffer)) }
    }

    fn delete(self, gl: &Gl) {
        // SAFETY: made by this host.
        unsafe {
            gl.gl.delete_framebuffer(self.framebuffer);
            self.color.into_iter().chain(self.depth).for_each(|texture| gl.gl.delete_texture(texture));
            self.renderbuffers.into_iter().for_each(|buffer| gl.gl.delete_renderbuffer(buffer));
        }
    }
}

fn renderer(gl: &Gl) -> Renderer {
    Renderer::new(gl.gl.clone()).expect("a renderer")
}

/// A copy has every bit of the original: the picture is the one with a texture of that format.
#[test]
fn copied_depth_is_the_depth() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let camera = world.camera(VIEWPORT);
        for (format, expected) in FORMATS {
            let shot = Shot::with(gl, &world, camera, VIEWPORT, DepthFormat::fixed(24));
            let [texture, renderbuffer] =
                [Keeps::Texture, Keeps::Renderbuffer].map(|keeps| Host::new(gl, &shot, format, 1, keeps));
            let mut renderer = renderer(gl);
            let surface = Surface::from_framebuffer(&renderer, texture.named()).expect("a depth texture");
            assert_eq!(surface.depth_format, expected, "what OpenGL says of format {format:x}");
            let canvas = Canvas::new(gl);
            renderer.overlay(&shot.frame().surface(surface), Encoding::Linear).expect("the frame is right");
            let read = canvas.read(0);
            assert!(read.iter().filter(|texel| texel[0] < 200).count() > 500, "there are shadows");
            // From whatever is bound, or named, whether its depth is a texture or not.
            let copied = shot.frame().surface(Surface::copied());
            for host in [&texture, &renderbuffer] {
                gl.bind(host.framebuffer);
                renderer.overlay(&copied, Encoding::Linear).expect("the frame is right");
                let [x, y] = SIZE;
                let picture: Vec<[u8; 4]> = crate::shot::read_texture(&gl.gl, host.color(), [x, y]);
                assert!(picture == read, "format {format:x}: the copy differs");
                gl.assert_no_complaint("a copy");
            }
            texture.delete(gl);
            renderbuffer.delete(gl);
        }
    });
}

/// Masks copy from the framebuffer that is bound for drawing.
#[test]
fn masks_copy_depth_too() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let host = Host::new(gl, &shot, glow::DEPTH_COMPONENT24, 1, Keeps::Renderbuffer);
        let mut renderer = renderer(gl);
        gl.bind(host.framebuffer);
        let copied = shot.masks(&mut renderer, &shot.frame().surface(Surface::copied()));
        let read = shot.masks(&mut renderer, &crate::depth_only::without(&shot, false, false));
        // One rounding to 24 bits more: shadows' edges move by less than a step of the mask, but for pixels at silhouettes.
        let off =
            copied.iter().flatten().zip(read.iter().flatten()).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(off <= 10, "{off} texels differ");
        host.delete(gl);
    });
}

/// With normals and ids beside it, and reversed.
#[test]
fn copied_depth_keeps_what_the_host_says() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let (_, camera, _) =
            crate::cameras::cameras(&world).into_iter().find(|(name, ..)| *name == "reversed").expect("one");
        let shot = Shot::with(gl, &world, camera, VIEWPORT, REVERSED);
        let host = Host::new(gl, &shot, glow::DEPTH_COMPONENT32F, 1, Keeps::Renderbuffer);
        let mut renderer = renderer(gl);
        let mut surface = shot.frame().surface;
        surface.depth = Surface::copied().depth;
        renderer
            .overlay_to(&shot.frame().surface(surface), Encoding::Linear, host.named())
            .expect("the frame is right");
        let picture: Vec<[u8; 4]> = crate::shot::read_texture(&gl.gl, host.color(), SIZE);
        world.truth(&shot).assert_overlay(&picture, crate::lights::STEP);
        host.delete(gl);
    });
}

/// A multisampled host in OpenGL ES, which does not shade samples: one of each pixel is copied.
#[test]
fn one_sample_is_copied_in_opengl_es() {
    in_each([Kind::Gles], |gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let host = Host::new(gl, &shot, glow::DEPTH24_STENCIL8, samples::SAMPLES, Keeps::Renderbuffer);
        let resolved = Canvas::new(gl);
        let mut renderer = renderer(gl);
        let frame = shot.frame().surface(Surface::copied());
        renderer.overlay_to(&frame, Encoding::Linear, host.named()).expect("the frame is right");
        gl.assert_no_complaint("copying a sample");
        // SAFETY: framebuffers of one size.
        unsafe {
            gl.gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(host.framebuffer));
            let [width, height] = SIZE;
            let (mask, filter) = (glow::COLOR_BUFFER_BIT, glow::NEAREST);
            gl.gl.blit_framebuffer(0, 0, width, height, 0, 0, width, height, mask, filter);
        }
        let without = crate::depth_only::without(&shot, false, false);
        let expected = crate::lights::overlay(gl, &mut renderer, &without, Encoding::Linear);
        let picture = resolved.read(0);
        let off = picture.iter().zip(&expected).filter(|(a, b)| a[0].abs_diff(b[0]) > 1).count();
        assert!(off <= 10, "{off} pixels differ");
        host.delete(gl);
    });
}

/// Every sample of a multisampled host.
#[test]
fn multisampled_depth_is_copied() {
    in_each([Kind::Gl33], |gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let [texture, renderbuffer] = [Keeps::Texture, Keeps::Renderbuffer]
            .map(|keeps| Host::new(gl, &shot, glow::DEPTH24_STENCIL8, samples::SAMPLES, keeps));
        let mut renderer = renderer(gl);
        let surface = Surface::from_framebuffer(&renderer, texture.named()).expect("a depth texture");
        assert_eq!(surface.samples, samples::SAMPLES as u32, "asked of OpenGL");
        let (colors, canvas) = samples::multisampled(gl, SIZE, &[glow::RGBA8]);
        // SAFETY: clears the bound framebuffer.
        unsafe { gl.gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]) };
        gl.bind(canvas);
        renderer.overlay(&shot.frame().surface(surface), Encoding::Linear).expect("the frame is right");
        gl.bind(renderbuffer.framebuffer);
        renderer
            .overlay(&shot.frame().surface(Surface::copied()), Encoding::Linear)
            .expect("the frame is right");
        gl.assert_no_complaint("copying samples");
        for sample in 0..samples::SAMPLES {
            let [read, copied] =
                [colors[0], renderbuffer.color()].map(|color| samples::read_sample(gl, color, SIZE, sample));
            assert!(read.iter().filter(|texel| texel.x < 0.8).count() > 500, "there are shadows");
            assert!(read == copied, "sample {sample}: the copy differs");
        }
        texture.delete(gl);
        renderbuffer.delete(gl);
    });
}

/// What cannot be read where it is says so, and that it can be copied.
#[test]
fn depth_that_is_no_texture_is_refused_where_one_is_asked_for() {
    in_each_api(|gl| {
        let world = many_lights(1);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl);
        let host = Host::new(gl, &shot, glow::DEPTH_COMPONENT24, 1, Keeps::Renderbuffer);
        let refused = Surface::from_framebuffer(&renderer, host.named());
        assert_eq!(refused, Err(Error::Unsupported(Unsupported::DepthNoTexture)));
        let canvas = Canvas::new(gl);
        // SAFETY: the canvas lives.
        let colors_only = unsafe { Framebuffer::from_name(canvas.framebuffer.0.get()) };
        let none = Err(Error::Unsupported(Unsupported::NoDepth));
        assert_eq!(Surface::from_framebuffer(&renderer, colors_only), none);
        let copied = shot.frame().surface(Surface::copied());
        assert_eq!(renderer.overlay(&copied, Encoding::Linear), none.map(|_| ()), "nothing to copy");
        assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "and nothing is drawn");
        // A layer of an array.
        // SAFETY: fresh objects of this context.
        unsafe {
            let array = gl.gl.create_texture().expect("a texture");
            gl.gl.bind_texture(glow::TEXTURE_2D_ARRAY, Some(array));
            gl.gl.tex_storage_3d(glow::TEXTURE_2D_ARRAY, 1, glow::DEPTH_COMPONENT24, SIZE[0], SIZE[1], 3);
            gl.gl.bind_texture(glow::TEXTURE_2D_ARRAY, None);
            gl.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(canvas.framebuffer));
            gl.gl.framebuffer_texture_layer(glow::FRAMEBUFFER, glow::DEPTH_ATTACHMENT, Some(array), 0, 2);
            let refused = Surface::from_framebuffer(&renderer, colors_only);
            assert_eq!(refused, Err(Error::Unsupported(Unsupported::DepthLayer)));
            gl.gl.clear_depth_f32(1.0);
            gl.gl.clear(glow::DEPTH_BUFFER_BIT);
            renderer.overlay(&copied, Encoding::Linear).expect("it is copied");
            gl.gl.delete_texture(array);
        }
        host.delete(gl);
    });
}

/// The copy is the renderer's: made once, replaced when the host's depth changes, gone with it; and the host's state stays.
#[test]
fn copies_are_kept_and_deleted() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let hosts: Vec<Host> =
            FORMATS.map(|(format, _)| Host::new(gl, &shot, format, 1, Keeps::Renderbuffer)).into();
        let before = live(&gl.gl);
        let mut renderer = renderer(gl);
        let frame: Frame<'_> = shot.frame().surface(Surface::copied());
        let mut draw = |host: &Host| {
            let counted = allocation_counter::measure(|| {
                renderer.overlay_to(&frame, Encoding::Linear, host.named()).expect("the frame is right")
            });
            (live(&gl.gl), counted.count_total)
        };
        draw(&hosts[0]);
        let (steady, _) = draw(&hosts[0]);
        for host in hosts.iter().cycle().take(20) {
            draw(host);
            assert_eq!(draw(host), (steady, 0), "a steady frame makes nothing");
        }
        drop(renderer);
        assert_eq!(live(&gl.gl), before, "the copy is gone with the renderer");
        hosts.into_iter().for_each(|host| host.delete(gl));
    });
}

#[test]
fn copying_leaves_the_state_as_it_was() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let host = Host::new(gl, &shot, glow::DEPTH24_STENCIL8, 1, Keeps::Renderbuffer);
        let odd = OddHost::new(gl, SIZE);
        let before = snapshot(gl);
        let mut renderer = renderer(gl);
        let frame = shot.frame().surface(Surface::copied());
        renderer.overlay_to(&frame, Encoding::Linear, host.named()).expect("the frame is right");
        assert_same(&before, &snapshot(gl), "a copy");
        odd.calm_down(gl);
        let picture: Vec<[u8; 4]> = crate::shot::read_texture(&gl.gl, host.color(), SIZE);
        assert!(picture.iter().filter(|texel| texel[0] < 200).count() > 500, "there are shadows");
        host.delete(gl);
    });
}

/// The names that textures have in other bindings.
#[test]
fn textures_have_their_names() {
    in_each_api(|gl| {
        let world = many_lights(1);
        let shot = Shot::new(gl, &world);
        let name = shot.depth.0.get();
        // SAFETY: the shot's texture; zero is none.
        let (texture, none) = unsafe { (Texture::from_name(name).expect("a name"), Texture::from_name(0)) };
        assert_eq!((texture.name(), texture.glow(), none), (name, shot.depth, None));
        // SAFETY: the window's.
        let window = unsafe { Framebuffer::from_name(0) };
        assert_eq!((window, window.name(), window.glow()), (Framebuffer::WINDOW, 0, None));
    });
}
