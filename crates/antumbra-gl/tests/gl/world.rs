//! Scenes, and their shadows by ray tracing.

use antumbra_gl::{Camera, Light, Occluder, ShaderLight};
use antumbra_host::describe;
use antumbra_reference::{Ray, Surface, Tracer};
use antumbra_scene::{Moment, Scene};
use glam::{DMat4, DVec3, DVec4, Vec3, Vec4Swizzles};

/// One of everything that casts a shadow, over a floor and before a wall, under a point light, a
/// directional light and a spot light of different colours.
pub(crate) const ONE_OF_EACH: &str = r#"
ambient = [0.05, 0.05, 0.05]
[camera]
eye = [1.0, 3.5, 7.0]
target = [0.0, 0.6, 0.0]
[[light]]
name = "point"
type = "point"
position = [2.0, 5.0, 3.0]
color = [1.0, 0.3, 0.2]
intensity = 60.0
[[light]]
name = "sun"
type = "directional"
direction = [0.5, -1.0, -0.4]
color = [0.2, 1.0, 0.3]
intensity = 3.0
[[light]]
name = "spot"
type = "spot"
position = [-3.0, 6.0, 2.0]
direction = [0.5, -1.0, -0.3]
inner_angle = 15.0
outer_angle = 30.0
color = [0.2, 0.3, 1.0]
intensity = 120.0
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "wall"
shape = { type = "rectangle", width = 6.0, depth = 3.0 }
translation = [0.0, 1.0, -2.0]
rotation = [0.7071068, 0.0, 0.0, 0.7071068]
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.6 }
translation = [-1.0, 1.0, 0.3]
[[object]]
name = "cone"
shape = { type = "cone", radius = 0.6, height = 1.2 }
translation = [1.2, 0.7, 0.2]
rotation = [0.2, 0.1, 0.3, 0.9]
[[object]]
name = "disc"
shape = { type = "disc", radius = 0.5 }
translation = [0.2, 1.6, 0.0]
rotation = [0.3, 0.0, 0.2, 0.93]
[[object]]
name = "triangle"
shape = { type = "triangle", vertices = [[-0.5, 0.0, 0.0], [0.5, 0.1, 0.2], [0.0, 0.8, 0.1]] }
translation = [-0.2, 0.3, 1.4]
"#;

/// A scene in antumbra's terms, with its oracle.
pub(crate) struct World {
    pub(crate) lights: Vec<Light>,
    pub(crate) occluders: Vec<Occluder>,
    pub(crate) ambient: Vec3,
    pub(crate) view: DMat4,
    /// Whether shadows fall on a primitive.
    pub(crate) receives: Vec<bool>,
    tracer: Tracer,
}

impl World {
    pub(crate) fn one_of_each() -> Self {
        Self::parse(ONE_OF_EACH)
    }

    pub(crate) fn parse(text: &str) -> Self {
        let scene = Scene::parse(text, "world.toml".as_ref()).expect("the test's scene is right");
        Self::of_moment(&scene, &scene.moment(0.0))
    }

    pub(crate) fn of_moment(scene: &Scene, moment: &Moment) -> Self {
        let described = describe(scene, moment).expect("shapes and lights antumbra has");
        Self {
            lights: described.lights,
            occluders: described.occluders,
            ambient: scene.ambient.as_vec3() * std::f32::consts::PI,
            view: scene.camera.view(),
            receives: moment.primitives.iter().map(|p| p.receives_shadow).collect(),
            tracer: Tracer::from_moment(scene, moment),
        }
    }

    /// The scene's eye, 45 degrees high, nothing too far.
    pub(crate) fn camera(&self, [_, _, width, height]: [i32; 4]) -> Camera {
        let y = 22.5f64.to_radians().tan().recip();
        let projection = DMat4::from_cols(
            DVec4::X * (y * f64::from(height) / f64::from(width)),
            DVec4::Y * y,
            DVec4::new(0.0, 0.0, -1.0, -1.0),
            DVec4::Z * -0.5,
        );
        Camera { view: self.view, projection }
    }

    /// What is seen through each pixel's centre, rows from bottom to top.
    pub(crate) fn see(&self, camera: &Camera, [_, _, width, height]: [i32; 4]) -> Vec<Option<Surface>> {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let ndc = |at: i32, size: i32| (f64::from(at) + 0.5) / f64::from(size) * 2.0 - 1.0;
                self.tracer.surface(&ray(camera, ndc(x, width), ndc(y, height)))
            })
            .collect()
    }

    /// Whether a light reaches a point, 1 or 0; also 0 where the surface faces away from it.
    pub(crate) fn visibility(&self, light: usize, surface: &Surface) -> f32 {
        self.tracer.visibility_at(light, surface, 1, 0) as f32
    }

    /// The truth for all lights.
    pub(crate) fn truth(&self, seen: &[Option<Surface>], width: i32) -> Truth {
        let seen_by = |light: usize| {
            let shader_light = ShaderLight::new(&self.lights[light], &DMat4::IDENTITY);
            seen.iter().map(move |surface| {
                surface.as_ref().map_or((1.0, Vec3::ZERO), |s| {
                    let e = shader_light.irradiance(s.point.as_vec3(), s.normal.as_vec3());
                    (self.visibility(light, s), e)
                })
            })
        };
        let lights: Vec<Vec<(f32, Vec3)>> =
            (0..self.lights.len()).map(|light| seen_by(light).collect()).collect();
        let width = width as usize;
        let same = |i: usize, j: usize| {
            seen[i].map(|s| s.primitive) == seen[j].map(|s| s.primitive)
                && lights.iter().all(|l| l[i].0 == l[j].0 && (l[i].1 == Vec3::ZERO) == (l[j].1 == Vec3::ZERO))
        };
        let height = seen.len() / width;
        let sure = (0..seen.len())
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
                inside
                    && [-1isize, 0, 1].iter().all(|dy| {
                        let row = i.wrapping_add_signed(dy * width as isize);
                        [row - 1, row, row + 1].iter().all(|&j| same(i, j))
                    })
            })
            .collect();
        Truth { lights, sure, ambient: self.ambient }
    }
}

/// The eye's ray through a point of the picture, for any projection.
fn ray(camera: &Camera, x: f64, y: f64) -> Ray {
    let to_world = camera.view.inverse();
    let inverse = camera.projection.inverse();
    let middle = inverse * DVec4::new(x, y, 0.5, 1.0);
    let middle = middle.xyz() / middle.w;
    let perspective = camera.projection.row(3) != DVec4::W;
    let (origin, direction) = if perspective {
        (DVec3::ZERO, middle * -middle.z.signum())
    } else {
        (middle * DVec3::new(1.0, 1.0, 0.0), DVec3::NEG_Z)
    };
    let direction = to_world.transform_vector3(direction).normalize();
    Ray::new(to_world.transform_point3(origin), direction)
}

/// What each light does at each pixel.
pub(crate) struct Truth {
    /// For each light and pixel: visibility, and irradiance without occluders.
    pub(crate) lights: Vec<Vec<(f32, Vec3)>>,
    /// Pixels without an edge of anything in or next to them: there a picture must be right.
    pub(crate) sure: Vec<bool>,
    ambient: Vec3,
}

impl Truth {
    /// (Σ V E + ambient) / (Σ E + ambient).
    pub(crate) fn ratio(&self, pixel: usize) -> Vec3 {
        let (mut arrives, mut all) = (self.ambient, self.ambient);
        for light in &self.lights {
            let (v, e) = light[pixel];
            arrives += e * v;
            all += e;
        }
        if all == Vec3::ZERO { Vec3::ONE } else { (arrives / all.max(Vec3::splat(1e-30))).min(Vec3::ONE) }
    }

    /// Asserts that a picture that was white is now the ratio, in linear light, wherever that is
    /// sure: within `tolerance` (a step of 8 bits is 0.004) but for a fraction `over` of pixels.
    pub(crate) fn assert_overlay(&self, picture: &[[u8; 4]], tolerance: f32, over: f64) {
        assert_eq!(picture.len(), self.sure.len(), "a pixel each");
        let (mut wrong, mut dark, mut light) = (Vec::new(), 0, 0);
        for i in (0..picture.len()).filter(|&i| self.sure[i]) {
            let expected = self.ratio(i);
            let [r, g, b, _] = picture[i].map(|c| f32::from(c) / 255.0);
            if (Vec3::new(r, g, b) - expected).abs().max_element() > tolerance {
                wrong.push((i, [r, g, b], expected));
            }
            *if expected.min_element() < 0.9 { &mut dark } else { &mut light } += 1;
        }
        assert!(dark > 100 && light > 100, "{dark} dark and {light} light pixels to look at");
        let allowed = ((dark + light) as f64 * over) as usize;
        let first = &wrong[..wrong.len().min(5)];
        assert!(wrong.len() <= allowed, "{} of {} pixels are wrong: {first:?}", wrong.len(), dark + light);
    }

    /// Asserts that a light's mask is its visibility, 0 or 255, wherever that is sure and the
    /// light would arrive at all.
    pub(crate) fn assert_mask(&self, light: usize, mask: &[u8], over: f64) {
        assert_eq!(mask.len(), self.sure.len(), "a pixel each");
        let counts = |&i: &usize| self.sure[i] && self.lights[light][i].1 != Vec3::ZERO;
        let looked_at: Vec<usize> = (0..mask.len()).filter(counts).collect();
        let wrong: Vec<_> = looked_at
            .iter()
            .map(|&i| (i, mask[i], self.lights[light][i].0))
            .filter(|&(_, mask, v)| f32::from(mask) != v * 255.0)
            .collect();
        let allowed = (looked_at.len() as f64 * over) as usize;
        let first = &wrong[..wrong.len().min(5)];
        assert!(
            wrong.len() <= allowed,
            "light {light}: {} of {} pixels are wrong: {first:?}",
            wrong.len(),
            looked_at.len()
        );
    }
}
