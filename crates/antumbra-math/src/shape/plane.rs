use glam::{DMat4, DVec3, DVec4};

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

    /// The same of a homogeneous point, times its weight: of a direction, with weight 0, how fast it rises.
    pub fn height_of(&self, point: DVec4) -> f64 {
        self.normal.dot(point.truncate()) - self.offset * point.w
    }

    /// The plane after the rigid motion `transform` (rotation and translation only).
    pub fn transformed(&self, transform: &DMat4) -> Self {
        let point = transform.transform_point3(self.normal * self.offset);
        Self::through(point, transform.transform_vector3(self.normal))
    }

    /// The same plane with its normal on the side of `point`; `None` for a point in the plane, to a
    /// part 1e-9 of its distance and the plane's from the origin, and for a plane that is not finite.
    pub fn towards(&self, point: DVec3) -> Option<Self> {
        self.facing(point.extend(1.0))
    }

    /// The same for a homogeneous point: for a direction, with weight 0, the plane that it rises from.
    pub fn facing(&self, point: DVec4) -> Option<Self> {
        let height = self.height_of(point);
        let rounding = 1e-9 * (point.truncate().length() + self.offset.abs() * point.w);
        let clear = self.normal.is_finite() && height.is_finite() && height.abs() > rounding;
        let side = height.signum();
        clear.then_some(Self { normal: self.normal * side, offset: self.offset * side })
    }
}
