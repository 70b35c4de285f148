//! The planar projection matrix against rays.

mod plane_shadow_support;

use antumbra_math::Plane;
use antumbra_math::mesh::planar_projection;
use glam::{DVec3, DVec4, Vec4Swizzles};
use plane_shadow_support::Random;

#[test]
fn points_land_where_rays_meet_the_plane() {
    let mut random = Random(3);
    let (mut between, mut beyond, mut behind) = (0, 0, 0);
    for _ in 0..100_000 {
        let plane = Plane { normal: random.direction(), offset: random.within(-3.0, 3.0) };
        let directional = random.choice(2) == 0;
        let light = if directional { random.direction().extend(0.0) } else { random.vector(6.0).extend(1.0) };
        let light =
            light * random.decades(-1.0, 1.0) * if directional || random.choice(2) == 0 { 1.0 } else { -1.0 };
        let point = random.vector(6.0);
        // From the light through the point to the plane.
        let along = if directional { -light.xyz() } else { point - light.xyz() / light.w };
        let to_light =
            if directional { light.xyz() } else { light.xyz() / light.w - plane.normal * plane.offset };
        let side = plane.normal.dot(to_light);
        let slope = plane.normal.dot(along);
        if side.abs() < 0.01 || slope.abs() < 0.01 {
            continue; // grazing: the shadow is far away
        }
        let t = -plane.height(point) / slope;
        let expected = point + along * t;
        let shadow = planar_projection(&plane, light) * point.extend(1.0);
        let got = shadow.xyz() / shadow.w;
        let size = 1.0 + expected.length();
        assert!(got.distance(expected) < 1e-9 * size, "{got} is not {expected}: {plane:?}, {light}, {point}");
        assert!(plane.height(got).abs() < 1e-9 * size, "{got} is in the plane");
        let height = plane.height(point) * side.signum();
        let below_light = slope * side < 0.0;
        assert_eq!(shadow.w > 0.0, below_light, "weight {}: {plane:?}, {light}, {point}", shadow.w);
        // A shadow is cast forward, by what is on the light's side and below it.
        assert_eq!(t > 0.0, (height > 0.0) == below_light, "{t} forward at {height}");
        between += usize::from(below_light && height > 0.0);
        beyond += usize::from(!below_light);
        behind += usize::from(height < 0.0);
    }
    assert!(between.min(beyond).min(behind) > 5000, "{between} between, {beyond} beyond, {behind} behind");
}

#[test]
fn known_shadows_and_degenerate_ones() {
    let floor = Plane { normal: DVec3::Y, offset: 0.0 };
    let matrix = planar_projection(&floor, DVec4::new(0.0, 4.0, 0.0, 1.0));
    assert_eq!(matrix.project_point3(DVec3::new(1.0, 2.0, 0.0)), DVec3::X * 2.0, "half way up, twice as far");
    assert_eq!((matrix * DVec4::new(1.0, 4.0, 0.0, 1.0)).w, 0.0, "at the light's height there is no shadow");
    assert_eq!(
        matrix.project_point3(DVec3::new(1.0, 0.0, 3.0)),
        DVec3::new(1.0, 0.0, 3.0),
        "the plane stays"
    );
    let flipped = Plane { normal: DVec3::NEG_Y, offset: -0.0 };
    let same = planar_projection(&flipped, DVec4::new(0.0, 4.0, 0.0, 1.0));
    assert_eq!(same, matrix, "which way the plane faces means nothing");
    let inside = planar_projection(&floor, DVec4::new(1.0, 0.0, 2.0, 1.0));
    let shadow = inside * DVec4::new(3.0, 1.0, -2.0, 1.0);
    assert_eq!(shadow / shadow.w, DVec4::new(1.0, 0.0, 2.0, 1.0), "light in the plane: all goes to it");
    assert!(!planar_projection(&floor, DVec4::NAN).is_finite(), "no number in, no number out");
}
