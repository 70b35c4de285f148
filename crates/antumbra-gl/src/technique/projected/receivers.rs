//! The receivers that are seen: their planes, their bounds, and where they are on the screen.

use crate::proxy::ProxyBuilder;
use crate::scenery::{Receiver, ReceiverShape};
use crate::view::View;
use antumbra_math::Plane;
use glam::{DMat4, DVec2, DVec3, DVec4};
use std::ops::Range;

/// A receiver with the eye off its plane. World space but for the polygon.
pub(super) struct Placed {
    /// Its plane, the normal on the eye's side: the side that is seen.
    pub(super) plane: Plane,
    pub(super) id: u32,
    /// Of a rectangle: affine functions that are -1 and 1 at opposite sides. Zero for a plane, inside everywhere.
    pub(super) sides: [DVec4; 2],
    /// The pixels that may show it: a part of [`Receivers::points`].
    polygon: Range<usize>,
    /// The same as triangles: a part of [`Receivers::vertices`].
    pub(super) first_vertex: i32,
    pub(super) vertex_count: i32,
}

/// The receivers of a frame; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Receivers {
    pub(super) placed: Vec<Placed>,
    /// Clip space, for the passes that mark.
    pub(super) vertices: Vec<[f32; 2]>,
    points: Vec<DVec2>,
}

impl Receivers {
    /// Finds the receivers that are seen. Those that are edge-on, outside the picture, without area or not finite
    /// are left out; `unbounded` takes rectangles for their whole planes.
    pub(super) fn place(
        &mut self,
        receivers: &[Receiver],
        unbounded: bool,
        proxy: &mut ProxyBuilder,
        view: &View,
    ) {
        self.placed.clear();
        self.vertices.clear();
        self.points.clear();
        let eye = eye(view);
        for receiver in receivers {
            let Some(plane) = facing(&receiver.plane(), eye) else { continue };
            let polygon = match receiver.shape {
                ReceiverShape::Rectangle(r) if !unbounded => {
                    let to_clip = view.projection * view.view;
                    proxy.bound_hull(r.corners().map(|corner| to_clip * corner.extend(1.0)), [], view)
                }
                _ => {
                    let [center, right, forward] = spanned(&plane, view);
                    proxy.bound_hull([center], [right, -right, forward, -forward], view)
                }
            };
            if polygon.len() < 3 {
                continue;
            }
            let first_vertex = self.vertices.len() as i32;
            for corners in polygon[1..].windows(2) {
                let clip = |p: DVec2| (p / view.size() * 2.0 - 1.0).as_vec2().to_array();
                self.vertices.extend([polygon[0], corners[0], corners[1]].map(clip));
            }
            let first = self.points.len();
            self.points.extend_from_slice(polygon);
            self.placed.push(Placed {
                plane,
                id: receiver.id,
                sides: match receiver.shape {
                    ReceiverShape::Plane(_) => [DVec4::ZERO; 2],
                    ReceiverShape::Rectangle(r) => [r.half_right, r.half_forward].map(|half| {
                        let across = half / half.length_squared();
                        across.extend(-across.dot(r.center))
                    }),
                },
                polygon: first..self.points.len(),
                first_vertex,
                vertex_count: self.vertices.len() as i32 - first_vertex,
            });
        }
    }

    /// The pixels that may show a receiver.
    pub(super) fn polygon(&self, placed: &Placed) -> &[DVec2] {
        &self.points[placed.polygon.clone()]
    }
}

/// The eye as a homogeneous point, world space: of a parallel view the direction to it.
pub(super) fn eye(view: &View) -> DVec4 {
    let perspective = view.pixel_step[2] > 0.5;
    view.view.inverse() * if perspective { DVec4::W } else { DVec4::Z }
}

/// The plane with its normal on the side of a homogeneous point; `None` for a point in the plane, to a part 1e-9 of
/// its distance and the plane's from the origin, and for a plane that is not finite.
pub(super) fn facing(plane: &Plane, point: DVec4) -> Option<Plane> {
    let height = height(plane, point);
    let rounding = 1e-9 * (point.truncate().length() + plane.offset.abs() * point.w);
    let clear = plane.normal.is_finite() && height.is_finite() && height.abs() > rounding;
    let side = height.signum();
    clear.then_some(Plane { normal: plane.normal * side, offset: plane.offset * side })
}

/// The signed distance of a homogeneous point from a plane, times the point's weight.
pub(super) fn height(plane: &Plane, point: DVec4) -> f64 {
    plane.normal.dot(point.truncate()) - plane.offset * point.w
}

/// From the square |x| + |z| <= y of the pyramid that stands for an infinite plane to that plane: the tip to the point
/// nearest to the eye, the corners of the base to infinity.
pub(super) fn plane_model(plane: &Plane, view: &View) -> DMat4 {
    let [center, right, forward] = frame(plane, view);
    DMat4::from_cols(right, center, forward, DVec4::ZERO)
}

/// A point of the plane and two directions in it, homogeneous, clip space.
fn spanned(plane: &Plane, view: &View) -> [DVec4; 3] {
    let to_clip = view.projection * view.view;
    frame(plane, view).map(|p| to_clip * p)
}

/// The point nearest to the eye and two directions, homogeneous, world space.
fn frame(plane: &Plane, view: &View) -> [DVec4; 3] {
    let eye = view.view.inverse().transform_point3(DVec3::ZERO);
    let (right, forward) = plane.normal.any_orthonormal_pair();
    let center = eye - plane.normal * plane.height(eye);
    [center.extend(1.0), right.extend(0.0), forward.extend(0.0)]
}
