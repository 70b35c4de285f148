use antumbra_math::plane_shadow::*;
use antumbra_math::*;
use glam::*;
#[test]
fn dbg() {
    let d = Cone {
        base_center: DVec3::new(-0.8377859578360743, 1.024985591163613, 0.12337007406291609),
        axis: DVec3::new(-0.9955638767655992, 0.08726382370607827, 0.03517943080331967),
        radius: 2.3897984928169755,
        height: 2.3897984934662024,
    };
    let l = Light::Point { position: DVec3::new(1.620637404175795, 6.551575027403234, 15.118818021604971) };
    let f = PlaneFrame {
        origin: DVec3::new(0.002590227119831102, -0.0013670063825225664, 0.07669330331624866),
        u: DVec3::new(0.9994302870367431, 0.00030066910002427753, -0.03374923631351806),
        v: DVec3::new(0.00030066910002427753, 0.999841320255041, 0.017811342137769703),
        normal: DVec3::new(0.03374923631351806, -0.017811342137769703, 0.9992716072917842),
    };
    println!("apex h {:e} base h {:e}", f.height(d.apex()), f.height(d.base_center));
    let s = PlaneShadow::cast(&d.into(), &l, &f);
    println!("{s:#?}");
    println!("{:?}", s.contains(DVec2::new(-1.4873557594436042, 0.05472590732607707)));
}
