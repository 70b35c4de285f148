use glam::{DMat4, DVec3};

/// An infinite plane: the points with `normal · p = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: DVec3,
    /// Signed distance of the plane from the origin along the normal, metres.
    pub offset: f64,
}

impl Plane {
    /// The plane through `point` with unit normal `normal`.
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }

    /// Signed distance of `point`, positive on the side of the normal, metres.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// The plane after the rigid motion `transform` (rotation and translation only).
    pub fn transformed(&self, transform: &DMat4) -> Self {
        let point = transform.transform_point3(self.normal * self.offset);
        Self::through(point, transform.transform_vector3(self.normal))
    }

    /// The same plane with its normal on the side of `point`; `None` for a point in the plane, to a
    /// part 1e-9 of its distance and the plane's from the origin.
    pub fn towards(&self, point: DVec3) -> Option<Self> {
        let height = self.height(point);
        let side = height.signum();
        let clear = height.abs() > 1e-9 * (point.length() + self.offset.abs());
        clear.then_some(Self { normal: self.normal * side, offset: self.offset * side })
    }
}
