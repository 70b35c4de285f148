//! Ray against box.

use glam::DVec3;

use crate::ray::{Chord, Convex, Face, Ray};

/// A box about the origin with edges along the coordinate axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cuboid {
    /// Half the size along each axis.
    pub(crate) half: DVec3,
}

impl Convex for Cuboid {
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let mut chord = Chord::ALL;
        (0..3).all(|axis| chord.clip_slab(ray, axis, self.half[axis])).then_some(chord)
    }

    fn normal(&self, point: DVec3, face: Face) -> DVec3 {
        match face {
            Face::Flat(axis) => {
                let axis = usize::from(axis);
                let mut normal = DVec3::ZERO;
                normal[axis] = if point[axis] < 0.0 { -1.0 } else { 1.0 };
                normal
            }
            // Only a line through no slab at all would end here, and there is none.
            Face::Curved => DVec3::Y,
        }
    }
}
