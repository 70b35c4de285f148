//! The polygon on the screen that bounds a shadow: the only pixels a pair of light and occluder
//! touches.

use super::View;
use antumbra_math::Plane;
use antumbra_math::blocking::Outline;
use glam::{DVec2, DVec3, DVec4};

/// Finds bounding polygons; keeps its memory from one to the next.
#[derive(Default)]
pub(crate) struct ProxyBuilder {
    rays: Vec<(DVec3, DVec3)>,
    near: Vec<DVec4>,
    away: Vec<DVec4>,
    points: Vec<DVec2>,
    hull: Vec<DVec2>,
}

/// Pixels by which a polygon is widened: the ramp of an edge reaches half a pixel beyond it.
const MARGIN: f64 = 1.0;
/// A direction whose clip-space w is this small a part of it never comes nearer or goes away.
const SIDEWAYS: f64 = 1e-9;
/// A point that counts as infinitely far outside the picture. Towards it the sides of a shadow
/// converge by (size of the picture / this) of a pixel a pixel, which the margin covers.
const FAR_PIXELS: f64 = 1e9;

impl ProxyBuilder {
    /// The convex polygon, in pixels of the viewport and clipped to it, that holds every pixel
    /// whose surface the shadow starting at `outline` (view space) can reach, wherever that
    /// surface is inside the half-spaces `bounds_vs`. `hollow` occluders are not drawn by the host, and
    /// what is inside them can be seen. Empty when there is no such pixel.
    pub(crate) fn bound(
        &mut self,
        outline: &Outline,
        hollow: bool,
        light_vs: DVec4,
        view: &View,
        bounds_vs: &[Plane],
    ) -> &[DVec2] {
        self.bound_from(outline, hollow, std::iter::once(light_vs), view, bounds_vs)
    }

    /// The same for the shadow of a light that is the hull of `lights_vs`.
    pub(crate) fn bound_from(
        &mut self,
        outline: &Outline,
        hollow: bool,
        lights_vs: impl Iterator<Item = DVec4>,
        view: &View,
        bounds_vs: &[Plane],
    ) -> &[DVec2] {
        self.hull.clear();
        let size = view.size();
        if matches!(outline, Outline::Everywhere) {
            self.hull.extend([DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)]);
            return &self.hull;
        }
        self.near.clear();
        self.away.clear();
        self.rays.clear();
        let clip = |p: DVec3| view.projection * p.extend(1.0);
        for (i, light_vs) in lights_vs.enumerate() {
            outline.near_end(light_vs, hollow, |p, extends| {
                // Flat outlines begin at the same points whatever they are thrown from.
                if i == 0 {
                    self.near.push(clip(p));
                }
                if extends {
                    self.rays.push((p, p * light_vs.w - light_vs.truncate()));
                }
            });
        }
        match nearest_end(&self.rays, bounds_vs) {
            Some(end) => self.near.extend(self.rays.iter().map(|&(p, d)| clip(p + d * crossing(end, p, d)))),
            None => self.away.extend(self.rays.iter().map(|&(_, d)| view.projection * d.extend(0.0))),
        }
        self.bound_ends(view, size)
    }

    /// The same for a flat convex shape of these corners (view space) and nothing behind it.
    pub(crate) fn bound_flat(&mut self, corners_vs: &[DVec3], view: &View) -> &[DVec2] {
        self.bound_hull(corners_vs.iter().map(|p| view.projection * p.extend(1.0)), [], view)
    }

    /// The same for the convex hull of corners and of the directions in which it goes on without end, both in
    /// clip space.
    pub(crate) fn bound_hull(
        &mut self,
        corners_cs: impl IntoIterator<Item = DVec4>,
        away_cs: impl IntoIterator<Item = DVec4>,
        view: &View,
    ) -> &[DVec2] {
        self.hull.clear();
        self.near.clear();
        self.away.clear();
        self.near.extend(corners_cs);
        self.away.extend(away_cs);
        self.bound_ends(view, view.size())
    }

    /// The polygon of what is in `near` and `away`.
    fn bound_ends(&mut self, view: &View, size: DVec2) -> &[DVec2] {
        if self.outside_one_side(size) {
            return &self.hull;
        }
        self.project(view.near_w, size);
        convex_hull(&mut self.points, &mut self.hull);
        if self.hull.is_empty() {
            return &self.hull;
        }
        self.widen();
        self.clip_to(size);
        &self.hull
    }

    /// Whether the shadow lies beyond one side of the view frustum, widening included.
    fn outside_one_side(&self, size: DVec2) -> bool {
        let edge = DVec2::ONE + 4.0 / size;
        let beyond = |side: &dyn Fn(&DVec4) -> f64| {
            self.near.iter().all(|p| side(p) > 0.0) && self.away.iter().all(|d| side(d) >= 0.0)
        };
        beyond(&|p| p.x - edge.x * p.w)
            || beyond(&|p| -p.x - edge.x * p.w)
            || beyond(&|p| p.y - edge.y * p.w)
            || beyond(&|p| -p.y - edge.y * p.w)
            || beyond(&|p| -p.w)
    }

    /// The corners, in pixels, of what lies in front of the near plane: corners of the near end,
    /// vanishing points of the directions, crossings of edges with the near plane, and, where the
    /// shadow leaves the picture without a vanishing point, points far outside.
    fn project(&mut self, near_w: f64, size: DVec2) {
        self.points.clear();
        let half = size * 0.5;
        let pixel = |p: DVec4| (DVec2::new(p.x, p.y) / p.w + 1.0) * half;
        let at_near = |p: DVec4, along: DVec4| {
            let mut at = p + along * ((near_w - p.w) / along.w);
            at.w = near_w;
            pixel(at)
        };
        let side = |d: &DVec4| if d.w.abs() <= SIDEWAYS * d.length() { 0.0 } else { d.w };
        for (i, &p) in self.near.iter().enumerate() {
            let inside = p.w >= near_w;
            if inside {
                self.points.push(pixel(p));
            }
            for &q in &self.near[..i] {
                if inside != (q.w >= near_w) {
                    self.points.push(at_near(p, q - p));
                }
            }
            for &d in &self.away {
                if (inside && side(&d) < 0.0) || (!inside && side(&d) > 0.0) {
                    self.points.push(at_near(p, d));
                }
            }
        }
        let Some(&start) = self.points.first() else { return };
        let far = |d: DVec4| start + (DVec2::new(d.x, d.y) * half).normalize_or_zero() * FAR_PIXELS;
        for (i, &d) in self.away.iter().enumerate() {
            let here = side(&d);
            if here > 0.0 {
                self.points.push(pixel(d));
            } else if here == 0.0 {
                self.points.push(far(d));
            }
            for &e in &self.away[..i] {
                if here * side(&e) < 0.0 {
                    // Between the one that goes away and the one that comes nearer.
                    self.points.push(far((e * d.w - d * e.w) * here.signum()));
                }
            }
        }
    }

    /// Moves every side of the polygon outwards; sharp corners are cut off beyond the margin.
    fn widen(&mut self) {
        std::mem::swap(&mut self.hull, &mut self.points);
        self.hull.clear();
        let count = self.points.len();
        if let [dot] = self.points[..] {
            let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            self.hull.extend(square.map(|(x, y)| dot + DVec2::new(x, y) * MARGIN));
            return;
        }
        let outward = |i: usize| {
            let side = self.points[(i + 1) % count] - self.points[i % count];
            DVec2::new(side.y, -side.x).normalize_or_zero()
        };
        for (i, &corner) in self.points.iter().enumerate() {
            let (before, after) = (outward(i + count - 1), outward(i));
            let cosine = before.dot(after);
            if cosine > 0.0 {
                self.hull.push(corner + (before + after) * (MARGIN / (1.0 + cosine)));
            } else {
                let tip = (before.perp() - after.perp()).normalize_or_zero();
                self.hull.extend([before, tip, after].map(|to| corner + to * MARGIN));
            }
        }
    }

    /// Clips the convex polygon to the viewport.
    fn clip_to(&mut self, size: DVec2) {
        type Distance = fn(DVec2, DVec2) -> f64;
        const SIDES: [Distance; 4] = [|p, _| p.x, |p, s| s.x - p.x, |p, _| p.y, |p, s| s.y - p.y];
        for side in SIDES {
            std::mem::swap(&mut self.hull, &mut self.points);
            self.hull.clear();
            for (i, &p) in self.points.iter().enumerate() {
                let q = self.points[(i + 1) % self.points.len()];
                let (a, b) = (side(p, size), side(q, size));
                if a >= 0.0 {
                    self.hull.push(p);
                }
                if (a >= 0.0) != (b >= 0.0) {
                    self.hull.push(p + (q - p) * (a / (a - b)));
                }
            }
        }
        if self.hull.len() < 3 {
            self.hull.clear();
        }
    }
}

/// Where a ray leaves a half-space, in lengths of `d`; 0 for a ray that starts outside.
pub(crate) fn crossing(plane: &Plane, p: DVec3, d: DVec3) -> f64 {
    plane.height(p).max(0.0) / -plane.normal.dot(d)
}

/// The half-space that all rays leave, and leave soonest. One is enough: every half-space alone
/// makes a polygon that holds the shadow.
pub(crate) fn nearest_end<'a>(rays: &[(DVec3, DVec3)], bounds: &'a [Plane]) -> Option<&'a Plane> {
    let reach = |plane: &Plane| {
        rays.iter().try_fold(0.0, |longest: f64, &(p, d)| {
            let leaves = plane.normal.dot(d) < -1e-6 * d.length();
            leaves.then(|| longest.max(crossing(plane, p, d)))
        })
    };
    bounds.iter().filter_map(|b| Some((b, reach(b)?))).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(b, _)| b)
}

/// Andrew's monotone chain; `hull` is counter-clockwise, and empty for fewer than one point.
fn convex_hull(points: &mut [DVec2], hull: &mut Vec<DVec2>) {
    hull.clear();
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    for upper in [false, true] {
        let start = hull.len();
        let mut add = |p: DVec2| {
            while hull.len() >= start + 2 {
                let (a, b) = (hull[hull.len() - 2], hull[hull.len() - 1]);
                if (b - a).perp_dot(p - a) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(p);
        };
        if upper {
            points.iter().rev().for_each(|&p| add(p))
        } else {
            points.iter().for_each(|&p| add(p))
        }
        hull.pop(); // the next chain starts with it
    }
    if hull.is_empty() && !points.is_empty() {
        hull.push(points[0]);
    }
}
