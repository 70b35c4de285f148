//! Scenes, and their shadows by ray tracing.

use crate::shot::Shot;
use antumbra_gl::{Camera, Light, MeshOccluder, Occluder, Receiver, ShaderLight};
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
    pub(crate) meshes: Vec<MeshOccluder>,
    pub(crate) receivers: Vec<Receiver>,
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
            meshes: described.meshes,
            receivers: described.receivers,
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
                let [x, y] = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                self.tracer.surface(&ray(camera, [x / f64::from(width), y / f64::from(height)]))
            })
            .collect()
    }

    /// Whether a light reaches a point, 1 or 0; also 0 where the surface faces away from it.
    pub(crate) fn visibility(&self, light: usize, surface: &Surface) -> f32 {
        self.tracer.visibility_at(light, surface, 1, 0) as f32
    }

    /// What a ray meets first.
    pub(crate) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Surface> {
        self.tracer.surface(&Ray::new(origin, direction.normalize()))
    }

    /// The truth for all lights.
    pub(crate) fn truth(&self, shot: &Shot<'_>) -> Truth<'_> {
        let (seen, width) = (&shot.seen, shot.viewport[2]);
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
        Truth { world: self, camera: shot.camera, viewport: shot.viewport, seen: seen.clone(), lights, sure }
    }
}

/// The eye's ray through a point of the picture (0 to 1 each way), for any projection.
fn ray(camera: &Camera, at: [f64; 2]) -> Ray {
    let [x, y] = at.map(|c| c * 2.0 - 1.0);
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

/// By how much antialiasing may be off where a shadow is narrower than a pixel, or its tip ends: it
/// knows one edge exactly and two by their angle. A ball's or a disc's other side it does not know:
/// a thread of shadow through the pixel's centre counts as half of it.
const SLIVER: f32 = 0.5;

/// The fraction of pixels in which, for each light, shadows meet, each with an edge in the pixel: of their visibilities
/// the smaller one is taken, and a little light is left along the seam.
const SEAMS: f64 = 1e-3;

/// Points a side of the grid that measures such a pixel.
const GRID: i32 = 16;

/// What each light does at each pixel.
pub(crate) struct Truth<'w> {
    world: &'w World,
    camera: Camera,
    viewport: [i32; 4],
    seen: Vec<Option<Surface>>,
    /// For each light and pixel: visibility, and irradiance without occluders.
    pub(crate) lights: Vec<Vec<(f32, Vec3)>>,
    /// Pixels without an edge of anything in or next to them, as far as centres tell: there a
    /// picture must be right.
    pub(crate) sure: Vec<bool>,
}

impl Truth<'_> {
    /// (Σ V E + ambient) / (Σ E + ambient), with the visibilities given.
    fn ratio_with(&self, pixel: usize, visibility: impl Fn(usize) -> f32) -> Vec3 {
        let (mut arrives, mut all) = (self.world.ambient, self.world.ambient);
        for (i, light) in self.lights.iter().enumerate() {
            let e = light[pixel].1;
            arrives += e * visibility(i);
            all += e;
        }
        Vec3::select(all.cmpgt(Vec3::ZERO), (arrives / all.max(Vec3::splat(1e-30))).min(Vec3::ONE), Vec3::ONE)
    }

    /// (Σ V E + ambient) / (Σ E + ambient).
    pub(crate) fn ratio(&self, pixel: usize) -> Vec3 {
        self.ratio_with(pixel, |light| self.lights[light][pixel].0)
    }

    /// A light's visibility over a pixel's area, of the primitive seen through its centre.
    fn area(&self, light: usize, pixel: usize) -> f32 {
        let [_, _, width, height] = self.viewport;
        let (x, y) = (pixel as i32 % width, pixel as i32 / width);
        let at = |p: i32, k: i32, size: i32| (f64::from(p * GRID + k) + 0.5) / f64::from(size * GRID);
        let of = |k: i32| {
            let at = [at(x, k % GRID, width), at(y, k / GRID, height)];
            self.world.tracer.surface(&ray(&self.camera, at))
        };
        let same = |s: &Surface| self.seen[pixel].is_some_and(|seen| seen.primitive == s.primitive);
        let points: Vec<_> = (0..GRID * GRID).filter_map(of).filter(same).collect();
        points.iter().map(|s| self.world.visibility(light, s)).sum::<f32>() / points.len() as f32
    }

    /// Asserts that a picture that was white is now the ratio, in linear light, wherever that is
    /// sure: within `tolerance` (a step of 8 bits is 0.004) but for [`SEAMS`], and everywhere
    /// within [`SLIVER`] of what it is over the pixel's area.
    pub(crate) fn assert_overlay(&self, picture: &[[u8; 4]], tolerance: f32) {
        assert_eq!(picture.len(), self.sure.len(), "a pixel each");
        let mut count = Count::default();
        for i in (0..picture.len()).filter(|&i| self.sure[i]) {
            let expected = self.ratio(i);
            let [r, g, b, _] = picture[i].map(|c| f32::from(c) / 255.0);
            let off = |from: Vec3| (Vec3::new(r, g, b) - from).abs().max_element();
            let close = off(expected) <= tolerance;
            let area = || {
                let areas: Vec<f32> = (0..self.lights.len()).map(|light| self.area(light, i)).collect();
                let area = self.ratio_with(i, |light| areas[light]);
                (area != expected, off(area))
            };
            count.add(i, close, expected.min_element() < 0.9, area);
        }
        count.assert_right("the overlay", self.lights.len());
        assert!(count.dark > 100 && count.light > 100, "there are shadows and light to look at: {count:?}");
    }

    /// Asserts that a light's mask, of a technique without antialiasing, is on the right side of one half wherever
    /// that is sure and the light would arrive.
    pub(crate) fn assert_classified(&self, light: usize, mask: &[u8], what: &str) {
        assert_eq!(mask.len(), self.sure.len(), "a pixel each");
        let counts = |i: &usize| self.sure[*i] && self.lights[light][*i].1 != Vec3::ZERO;
        let wrong: Vec<usize> = (0..mask.len())
            .filter(counts)
            .filter(|&i| (mask[i] >= 128) != (self.lights[light][i].0 >= 0.5))
            .collect();
        assert!(
            wrong.is_empty(),
            "{what}, light {light}: {} pixels are wrong: {:?}",
            wrong.len(),
            &wrong[..wrong.len().min(99)]
        );
    }

    /// Asserts that a light's mask is its visibility, 0 or 255, wherever that is sure and the
    /// light would arrive at all, but for [`SEAMS`], and everywhere within [`SLIVER`] of what it is
    /// over the pixel's area.
    pub(crate) fn assert_mask(&self, light: usize, mask: &[u8]) {
        assert_eq!(mask.len(), self.sure.len(), "a pixel each");
        let mut count = Count::default();
        for i in (0..mask.len()).filter(|&i| self.sure[i] && self.lights[light][i].1 != Vec3::ZERO) {
            let (m, v) = (f32::from(mask[i]) / 255.0, self.lights[light][i].0);
            let area = || (self.area(light, i) != v, (self.area(light, i) - m).abs());
            // The grid finds a 256th of a pixel, and so do 8 bits.
            count.add(i, (m - v).abs() < 1.5 / 255.0, v < 0.5, area);
        }
        count.assert_right(&format!("light {light}"), 1);
    }
}

/// How many pixels are how.
#[derive(Debug, Default)]
struct Count {
    light: usize,
    dark: usize,
    seams: usize,
    wrong: Vec<(usize, f32)>,
}

impl Count {
    /// `area`: whether the pixel holds a sliver, and how far off its area the renderer is.
    fn add(&mut self, pixel: usize, close: bool, dark: bool, area: impl Fn() -> (bool, f32)) {
        *if dark { &mut self.dark } else { &mut self.light } += 1;
        if close {
            return;
        }
        let (sliver, off) = area();
        if off > SLIVER {
            self.wrong.push((pixel, off));
        } else if !sliver {
            self.seams += 1;
        }
    }

    fn assert_right(&self, what: &str, lights: usize) {
        assert!(self.wrong.is_empty(), "{what}: {} pixels are wrong: {self:?}", self.wrong.len());
        let allowed = ((self.dark + self.light) as f64 * SEAMS * lights as f64) as usize;
        assert!(self.seams <= allowed, "{what}: too many pixels are not quite right: {self:?}");
    }
}
