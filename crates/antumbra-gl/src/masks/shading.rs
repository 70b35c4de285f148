//! GLSL for hosts: lights with an area, shaded as the overlay takes them to be.

/// GLSL (330 and 300 es) of what arrives from a light without occluders, for a host's own fragment shader:
///
/// ```glsl
/// vec3 antumbra_irradiance(AntumbraLight light, vec3 position, vec3 normal);
/// ```
///
/// `AntumbraLight` is [`crate::ShaderLight`], vector by vector; the space is the caller's. Every name in it begins with
/// `antumbra_`, `Antumbra` or `ANTUMBRA_`. The lights are points, spots and suns; with `ANTUMBRA_BALL_LIGHTS` defined before
/// it they may be balls, with `ANTUMBRA_FLAT_LIGHTS` discs and rectangles too, and with `ANTUMBRA_FALLOFF` they may have a
/// range and any [`crate::Falloff`]. Each costs more. Exact, the part of a light below the surface's horizon cut off.
pub const IRRADIANCE_GLSL: &str =
    concat!(include_str!("../shaders/area.glsl"), include_str!("../shaders/lights.glsl"));
