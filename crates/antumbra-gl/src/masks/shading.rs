//! GLSL for hosts: lights with an area, shaded as the overlay takes them to be.

/// GLSL (330 and 300 es) of what arrives from a light without occluders, for a host's own fragment shader:
///
/// ```glsl
/// vec3 irradiance(vec4 place, vec4 color, vec4 cone, vec4 attenuation, vec3 position, vec3 normal);
/// ```
///
/// The vectors are those of [`crate::ShaderLight`], the spaces the caller's. With `BALL_LIGHTS` defined before it the
/// lights may be balls; with `FLAT_LIGHTS` discs and rectangles too, and the function takes `vec4 right, vec4 up`
/// after `attenuation`. Both cost more. Exact, the part of a light below the surface's horizon cut off.
pub const IRRADIANCE_GLSL: &str =
    concat!(include_str!("../shaders/area.glsl"), include_str!("../shaders/lights.glsl"));
