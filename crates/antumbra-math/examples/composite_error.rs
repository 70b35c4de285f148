//! How far the composite method is from the exact shadow, over the light's angle: prints CSV.
//!
//! A sphere and a cone over a plane, the light at a fixed distance from the sphere's centre or the
//! cone's base, 0 to 85 degrees from the plane's normal. The error is the area in one of the two shadows
//! and not in the other, over the exact one's. Lines end where the light is no longer above the object:
//! the papers ask for no more.
//!
//! ```text
//! cargo run --release -p antumbra-math --example composite_error
//! ```

#[path = "../tests/composite_support/mod.rs"]
mod composite_support;

use antumbra_math::composite::{self, SphereForm};
use antumbra_math::plane_shadow::PlaneShadow;
use antumbra_math::{Cone, Light, Shape, Sphere};
use composite_support::{error, floor, light_at};
use glam::DVec3;

/// From the object, in its radii.
const DISTANCES: [f64; 3] = [4.0, 16.0, f64::INFINITY];

fn main() {
    let center = DVec3::Y * 1.5;
    let sphere = Sphere { center, radius: 1.0 }.into();
    let cone = |height| Cone { base_center: center, axis: DVec3::Y, radius: 1.0, height }.into();
    let shapes: [(&str, Shape, &[SphereForm]); 3] = [
        ("sphere", sphere, &[SphereForm::Circle, SphereForm::Tangent]),
        ("cone-height-1", cone(1.0), &[SphereForm::Tangent]),
        ("cone-height-2", cone(2.0), &[SphereForm::Tangent]),
    ];
    println!("shape,form,light_distance_radii,angle_degrees,error");
    for (name, shape, forms) in &shapes {
        for form in *forms {
            let form_name = match (shape, form) {
                (Shape::Cone(_), _) => "disc-and-triangle",
                (_, SphereForm::Circle) => "circle",
                (_, SphereForm::Tangent) => "tangent",
            };
            for distance in DISTANCES {
                for angle in (0..=170).map(|half| f64::from(half) * 0.5) {
                    let light = light_at(center, distance, angle);
                    if let Some(error) = measure(shape, &light, *form) {
                        println!("{name},{form_name},{distance},{angle},{error:.5}");
                    }
                }
            }
        }
    }
}

/// `None` where the method draws nothing.
fn measure(shape: &Shape, light: &Light, form: SphereForm) -> Option<f64> {
    let published = composite::cast(shape, light, &floor(), form).ok()?;
    error(&PlaneShadow::cast(shape, light, &floor()), &published)
}
