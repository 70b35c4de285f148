use antumbra_math::plane_shadow::*;
use antumbra_math::*;
use glam::*;
#[test]
fn dbg() {
    let d = Disc { center: DVec3::new(0.3974534766554598, 0.17403007534481785, 0.10418573685266169), normal: DVec3::new(-0.99999999999998, 1.794727198845247e-7, -8.982537408230802e-8), radius: 0.17288464501623596 };
    let l = Light::Point { position: DVec3::new(0.3974534766554598, 0.11801462949310258, 0.10418573688828747) };
    let f = PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Z)).unwrap();
    let s = PlaneShadow::cast(&d.into(), &l, &f);
    println!("{s:#?}");
    println!("{:?}", s.contains(DVec2::new(-0.6758666530289696, -2.5953456378109463)));
}
