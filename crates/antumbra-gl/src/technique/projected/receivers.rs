//! The receivers that are seen: their planes, their bounds, and where they are on the screen.

use crate::input::{Receiver, ReceiverShape};
use crate::screen::{ProxyBuilder, View};
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
        let eye = view.eye_ws();
        for receiver in receivers {
            let Some(plane) = receiver.plane().facing(eye) else { continue };
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
                self.vertices.extend([polygon[0], corners[0], corners[1]].map(|p| view.clip_position(p)));
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
