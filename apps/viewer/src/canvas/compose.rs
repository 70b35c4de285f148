//! Puts finished pictures into the window: one, two beside each other, or where they differ.

use antumbra_host::HostError;
use colorous::INFERNO;
use glow::HasContext;

use super::program::Program;
use crate::model::settings::Layout;

/// What draws it.
pub(crate) struct Compose {
    program: Program,
    vertex_array: glow::VertexArray,
    /// The colours of errors.
    colors: glow::Texture,
}

/// What is put where.
pub(crate) struct Composition {
    /// The two pictures; the second is not looked at in a single one.
    pub(crate) textures: [glow::Texture; 2],
    /// Factors on their brightness.
    pub(crate) dim: [f32; 2],
    /// How they are put together.
    pub(crate) layout: Layout,
    /// Whether a little noise takes the bands out of dark gradients.
    pub(crate) dither: bool,
    /// Where the divider is, as a part of the width.
    pub(crate) divider: f32,
    /// Factor on linear colour.
    pub(crate) exposure: f32,
    /// The error of the last colour.
    pub(crate) error_scale: f32,
    /// x, y, width, height in the window, pixels from the bottom left.
    pub(crate) rect: [i32; 4],
}

/// How many colours errors have.
const COLORS: usize = 256;

/// The colour of an error, 0 to 1, sRGB: that of `antumbra compare`.
pub(crate) fn error_color(error: f32) -> [u8; 3] {
    INFERNO.eval_continuous(f64::from(error).clamp(0.0, 1.0)).as_array()
}

impl Compose {
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, HostError> {
        let program = include_str!("shaders/screen.vert.glsl");
        let bytes: Vec<u8> = (0..COLORS).flat_map(|i| error_color(i as f32 / (COLORS - 1) as f32)).collect();
        // SAFETY: the caller's; the bytes are as many as the texture has.
        unsafe {
            let program = Program::new(gl, program, include_str!("shaders/compose.frag.glsl"))?;
            let vertex_array = gl.create_vertex_array().map_err(HostError::Driver)?;
            let colors = gl.create_texture().map_err(HostError::Driver)?;
            gl.bind_texture(glow::TEXTURE_2D, Some(colors));
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
            let data = glow::PixelUnpackData::Slice(Some(&bytes));
            let width = COLORS as i32;
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGB8 as i32,
                width,
                1,
                0,
                glow::RGB,
                glow::UNSIGNED_BYTE,
                data,
            );
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 4);
            for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, name, glow::LINEAR as i32);
            }
            gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAX_LEVEL, 0);
            Ok(Self { program, vertex_array, colors })
        }
    }

    /// Draws into the bound framebuffer.
    ///
    /// # Safety
    /// The context is current, and the textures exist.
    pub(crate) unsafe fn draw(&self, gl: &glow::Context, what: &Composition) {
        let [x, y, w, h] = what.rect;
        // SAFETY: the caller's.
        unsafe {
            gl.viewport(x, y, w, h);
            gl.use_program(Some(self.program.raw));
            let textures = [what.textures[0], what.textures[1], self.colors];
            for (unit, (name, texture)) in
                (0..).zip(["u_left", "u_right", "u_colors"].into_iter().zip(textures))
            {
                gl.active_texture(glow::TEXTURE0 + unit);
                gl.bind_texture(glow::TEXTURE_2D, Some(texture));
                gl.bind_sampler(unit, None);
                gl.uniform_1_i32(self.program.uniform(gl, name).as_ref(), unit as i32);
            }
            gl.active_texture(glow::TEXTURE0);
            let uniform = |name| self.program.uniform(gl, name);
            let layout = match what.layout {
                Layout::Single => 0,
                Layout::Split => 1,
                Layout::Difference => 2,
            };
            gl.uniform_1_i32(uniform("u_layout").as_ref(), layout);
            gl.uniform_1_f32(uniform("u_dither").as_ref(), if what.dither { 1.0 / 255.0 } else { 0.0 });
            gl.uniform_1_f32(uniform("u_divider").as_ref(), what.divider);
            gl.uniform_1_f32(uniform("u_exposure").as_ref(), what.exposure);
            gl.uniform_1_f32(uniform("u_scale").as_ref(), what.error_scale);
            gl.uniform_2_f32(uniform("u_dim").as_ref(), what.dim[0], what.dim[1]);
            gl.bind_vertex_array(Some(self.vertex_array));
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
            gl.bind_vertex_array(None);
        }
    }

    /// # Safety
    /// The context is current, and this is not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_program(self.program.raw);
            gl.delete_vertex_array(self.vertex_array);
            gl.delete_texture(self.colors);
        }
    }
}
