//! The shapes, posed in the world. A type a file.

mod bounds;
mod cone;
mod disc;
mod placing;
mod plane;
mod rectangle;
mod sphere;
mod triangle;

pub use cone::Cone;
pub use disc::Disc;
pub use placing::PlacingError;
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use triangle::Triangle;

/// Any shape that casts a shadow in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// An infinite plane: it takes the light from everything on its other side.
    Plane(Plane),
    /// A flat rectangle.
    Rectangle(Rectangle),
    /// A flat disc.
    Disc(Disc),
    /// A flat triangle.
    Triangle(Triangle),
    /// A ball.
    Sphere(Sphere),
    /// A solid cone.
    Cone(Cone),
}

macro_rules! into_shape {
    ($($shape:ident),*) => {$(
        impl From<$shape> for Shape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        }
    )*};
}
into_shape!(Plane, Rectangle, Disc, Triangle, Sphere, Cone);
