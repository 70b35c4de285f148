//! Masks where the surface is averted from the light. Of no use to a diffuse host, whose n·l is 0 there; others let light
//! through leaves or skin, and are told what the other objects hide.

use crate::context::in_each_api;
use crate::shot::Shot;
use crate::world::World;
use antumbra_gl::{Renderer, Technique};

/// Everything is lit from behind, through a row of things that hide each other.
const BACKLIT: &str = r#"
camera = { eye = [0.5, 2.0, 7.0], target = [0.0, 1.0, 0.0], fov_y = 40.0 }
[[light]]
name = "lamp"
type = "point"
position = [0.3, 2.2, -7.0]
intensity = 60.0
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -0.15, 1.0]
intensity = 3.0
[[object]]
name = "screen"
shape = { type = "rectangle", width = 5.0, depth = 3.0 }
translation = [0.0, 1.5, -1.0]
rotation = [0.7071068, 0.0, 0.0, 0.7071068]
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.7 }
translation = [-1.1, 1.0, 1.0]
receives_shadow = true
[[object]]
name = "cone"
shape = { type = "cone", radius = 0.6, height = 1.4 }
translation = [1.2, 0.3, 0.8]
[[object]]
name = "card"
shape = { type = "rectangle", width = 1.5, depth = 1.0 }
translation = [0.2, 1.9, -3.0]
rotation = [0.7071068, 0.0, 0.0, 0.7071068]
[[object]]
name = "disc"
shape = { type = "disc", radius = 0.5 }
translation = [-1.5, 1.2, -2.5]
rotation = [0.6, 0.1, 0.0, 0.79]
"#;

#[test]
fn averted_surfaces_show_what_others_hide() {
    in_each_api(|gl| {
        let world = World::parse(BACKLIT);
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        for technique in [Technique::analytic().into(), Technique::parse("volume").expect("a technique")] {
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(technique).expect("a technique");
            for (light, mask) in shot.masks(&mut renderer, &shot.frame()).iter().enumerate() {
                let (mut averted, mut hidden, mut wrong) = (0, 0, 0);
                for (i, seen) in shot.seen.iter().enumerate() {
                    let Some(seen) = seen.filter(|_| truth.sure[i]) else { continue };
                    let to_light = world.lights[light].place.vector_from(seen.point).normalize();
                    // By three degrees at least: nearer to that rounding says which side is lit.
                    if seen.normal.dot(to_light) > -0.05 {
                        continue;
                    }
                    let expected = world.others_hide(light, &seen);
                    averted += 1;
                    hidden += usize::from(expected);
                    wrong += usize::from((mask[i] < 128) != expected);
                }
                eprintln!("{technique}, light {light}: {wrong} wrong of {averted}, {hidden} hidden");
                assert!(hidden > 300 && averted > hidden + 300, "{averted} averted, {hidden} hidden");
                // A shadow's edge through a pixel's very centre.
                assert!(wrong <= 4, "{technique}, light {light}: {wrong} of {averted} are wrong");
            }
        }
    });
}
