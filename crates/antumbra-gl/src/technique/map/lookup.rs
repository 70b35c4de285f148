//! What the lookup's shader reads of a light and its map.

use super::Options;
use super::fit::{self, Fit};
use super::target::MapTarget;
use crate::gl::Program;
use crate::input::{Area, Light};
use crate::masks::{GROUP_LIGHTS, ShaderLight};
use crate::screen::View;
use antumbra_math::{Light as Place, Plane};
use glam::{DMat4, Mat4, Vec3, Vec4};
use glow::HasContext;

/// The uniforms of a lookup, in the order in which [`Map::set`] sets them.
pub(super) const UNIFORMS: &[&str] = &[
    "u_map",
    "u_to_light",
    "u_faces",
    "u_planes",
    "u_tiles",
    "u_texels",
    "u_cube",
    "u_place",
    "u_bias",
    "u_channel",
    "u_light_right",
    "u_light_up",
    "u_range",
    "u_beyond",
    "u_beyond_count",
];

/// Infinite planes that go on beyond the border of a directional light's map; any others end there.
const MAX_BEYOND: usize = 4;

/// One light's map.
#[derive(Clone, Copy)]
pub(super) struct Map<'a> {
    pub(super) light: &'a Light,
    pub(super) fit: &'a Fit,
    pub(super) options: &'a Options,
    pub(super) target: &'a MapTarget,
    /// Infinite planes that cast.
    pub(super) planes: &'a [Plane],
}

impl Map<'_> {
    /// Sets the uniforms of a lookup that writes the channel of the batch's light `index`.
    ///
    /// # Safety
    /// The program is one of the lookups, and in use.
    pub(super) unsafe fn set(&self, gl: &glow::Context, program: &Program, view: &View, index: usize) {
        let Self { light, fit, options, target, planes: casting } = *self;
        let size = f64::from(options.size);
        let from_light = DMat4::from_translation(fit.origin);
        let texel = fit.some_face.texel(size).as_vec4();
        let (mut faces, mut planes) = ([Mat4::IDENTITY; 6], [Mat4::IDENTITY; 6]);
        // A tile that ends before it begins has no texels.
        let (mut tiles, texels) = ([Vec4::new(1.0, 1.0, 0.0, 0.0); 6], [texel; 6]);
        let mut tile = 0;
        for (i, face) in fit.faces.iter().enumerate() {
            let Some(face) = face else { continue };
            let corner = target.corner(tile);
            tile += 1;
            let to_texels = face.to_texels(corner, size) * from_light;
            faces[i] = to_texels.as_mat4();
            planes[i] = to_texels.inverse().transpose().as_mat4();
            let last = corner + size - 1.0;
            tiles[i] = Vec4::new(corner.x as f32, corner.y as f32, last.x as f32, last.y as f32);
        }
        let to_light = (from_light.inverse() * view.view.inverse()).as_mat4();
        let place = ShaderLight::new(light, from_light.inverse()).place;
        let bias =
            [options.constant_bias, options.slope_bias, options.normal_offset, fit::radius(options) as f32];
        let mut channel = [0.0; GROUP_LIGHTS];
        channel[index % GROUP_LIGHTS] = 1.0;
        let (right, up) = sides(&light.area);
        let (mut beyond, mut beyond_count) = ([Vec3::ZERO; MAX_BEYOND], 0);
        if let (Some(face), Place::Directional { .. }) = (&fit.faces[0], light.place) {
            let corner = target.corner(0);
            let planes = casting.iter().filter_map(|plane| face.depth_of_plane(plane, corner, size));
            beyond.iter_mut().zip(planes).for_each(|(to, plane)| {
                (*to, beyond_count) = (plane, beyond_count + 1);
            });
        }
        let own = &program.own;
        // SAFETY: the caller's; every array has the size its shader declares.
        unsafe {
            gl.uniform_1_i32(own[0].as_ref(), 3);
            gl.uniform_matrix_4_f32_slice(own[1].as_ref(), false, &to_light.to_cols_array());
            gl.uniform_matrix_4_f32_slice(own[2].as_ref(), false, bytemuck::cast_slice(&faces));
            gl.uniform_matrix_4_f32_slice(own[3].as_ref(), false, bytemuck::cast_slice(&planes));
            gl.uniform_4_f32_slice(own[4].as_ref(), bytemuck::cast_slice(&tiles));
            gl.uniform_4_f32_slice(own[5].as_ref(), bytemuck::cast_slice(&texels));
            gl.uniform_1_i32(own[6].as_ref(), i32::from(fit.cube));
            gl.uniform_4_f32_slice(own[7].as_ref(), &place.to_array());
            gl.uniform_4_f32_slice(own[8].as_ref(), &bias);
            gl.uniform_4_f32_slice(own[9].as_ref(), &channel);
            gl.uniform_4_f32_slice(own[10].as_ref(), &right.to_array());
            gl.uniform_4_f32_slice(own[11].as_ref(), &up.to_array());
            gl.uniform_2_f32_slice(own[12].as_ref(), &[fit.near as f32, fit.nearest as f32]);
            gl.uniform_3_f32_slice(own[13].as_ref(), bytemuck::cast_slice(&beyond));
            gl.uniform_1_i32(own[14].as_ref(), beyond_count);
        }
    }
}

/// A light's half sizes as its shader reads them; world space.
fn sides(area: &Area) -> (Vec4, Vec4) {
    match *area {
        Area::None => (Vec4::ZERO, Vec4::ZERO),
        Area::Sphere { radius } => (Vec4::ZERO, Vec4::W * radius as f32),
        Area::Disc { direction, radius } => {
            let right = direction.any_orthonormal_vector();
            let up = direction.cross(right);
            ((right * radius).as_vec3().extend(0.0), (up * radius).as_vec3().extend(0.0))
        }
        Area::Rectangle { half_right, half_up, .. } => {
            (half_right.as_vec3().extend(1.0), half_up.as_vec3().extend(0.0))
        }
    }
}
