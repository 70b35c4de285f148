//! A point of a receiver in a shadow map, in float32 as on the GPU. Twins: `shaders/map/receiver.glsl`.
//!
//! Light space has the axes of the world and the light at the origin. A map keeps a depth that is affine in the
//! texel on every plane: near distance over distance in a perspective face, 1 at the near end to 0 at the far end
//! in a parallel one. Larger is nearer.

use glam::{Mat4, Vec2, Vec3, Vec4Swizzles};

/// The face of a cube that a direction leaves through: 0 to 5 for +X, -X, +Y, -Y, +Z, -Z. On an edge the earlier
/// axis; zero and NaN count as -Z.
pub fn map_face(p: Vec3) -> usize {
    let a = p.abs();
    if a.x >= a.y && a.x >= a.z {
        return if p.x > 0.0 { 0 } else { 1 };
    }
    if a.y >= a.z {
        return if p.y > 0.0 { 2 } else { 3 };
    }
    if p.z > 0.0 { 4 } else { 5 }
}

/// Tangent of the steepest receiver that is followed: 88.2 degrees. Beyond, light only grazes, and acne stays; to follow
/// it there too (256) lets light through where receivers meet.
const STEEPEST: f32 = 32.0;

/// The normal of the plane that texels are compared with: turned from the light's direction (`share` 0) to the
/// receiver's (`share` 1), and no steeper than a tangent of 32. Unit vectors in, any length out.
pub fn compared_normal(normal: Vec3, to_light: Vec3, share: f32) -> Vec3 {
    let cosine = normal.dot(to_light);
    let across = (normal - to_light * cosine) * share;
    across + to_light * cosine.max(across.length() / STEEPEST)
}

/// Moves a point off its surface: by `offset` metres where the light grazes, less the more it is faced.
pub fn offset_point(position: Vec3, normal: Vec3, to_light: Vec3, offset: f32) -> Vec3 {
    let cosine = normal.dot(to_light);
    position + normal * (offset * (1.0 - cosine * cosine).max(0.0).sqrt())
}

/// A point on a plane, as a face of the map sees the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPoint {
    /// In texels of the map.
    pub texel: Vec2,
    /// Larger is nearer to the light.
    pub depth: f32,
    /// How depth changes on the plane from texel to texel.
    pub slope: Vec2,
    /// Metres along the face's axis, or 1 in a parallel face; not above 0 behind the light, where the rest means
    /// nothing.
    pub w: f32,
}

/// Where a face sees a point and a plane through it. `face` takes light space to the texel and the depth, times w;
/// `planes`, its inverse transposed, takes planes. `normal` is a normal of the plane, of any length, not at right
/// angles to the way to the light (the slope is then not finite).
pub fn map_point(face: &Mat4, planes: &Mat4, position: Vec3, normal: Vec3) -> MapPoint {
    let p = *face * position.extend(1.0);
    let plane = *planes * normal.extend(-normal.dot(position));
    let w = if p.w > 0.0 { p.w } else { 1.0 };
    MapPoint { texel: p.xy() / w, depth: p.z / w, slope: plane.xy() / -plane.z, w: p.w }
}

/// How much of a texel, from its index to the next, is within `radius` of `middle`: 0 to 1.
pub fn box_weight(middle: f32, radius: f32, texel: f32) -> f32 {
    ((middle + radius).min(texel + 1.0) - (middle - radius).max(texel)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weights of all texels add up to the box, wherever it is.
    #[test]
    fn boxes_are_divided_among_texels() {
        for radius in [0.5, 1.0, 1.5, 2.25] {
            for step in 0..40 {
                let middle = 10.0 + 0.07 * step as f32;
                let first = (middle - radius).floor();
                let count = (2.0 * radius).ceil() as i32 + 1;
                let sum: f32 = (0..count).map(|i| box_weight(middle, radius, first + i as f32)).sum();
                assert!((sum - 2.0 * radius).abs() < 1e-5, "radius {radius} at {middle}: {sum}");
            }
        }
    }

    /// Share 0 faces the light, share 1 is the receiver, and no plane contains the way to the light.
    #[test]
    fn the_compared_plane_turns_with_its_share() {
        let light = Vec3::Y;
        for degrees in [0.0f32, 10.0, 60.0, 85.0, 89.9] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let normal = Vec3::new(sin, cos, 0.0);
            let tangent = |share| {
                let n = compared_normal(normal, light, share);
                n.x / n.y
            };
            assert!(tangent(0.0).abs() < 1e-6, "{degrees} degrees: share 0 faces the light");
            let whole = (sin / cos).min(STEEPEST);
            assert!((tangent(1.0) - whole).abs() <= 1e-4 * whole.max(1.0), "{degrees} degrees: the receiver");
        }
    }
}
