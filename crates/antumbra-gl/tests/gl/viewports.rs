//! x
use crate::context::in_each_api;
use crate::shot::{Shot, Canvas};
use crate::lights::many_lights;
use antumbra_gl::*;
use glow::HasContext;

#[test]
fn probe() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let mut r = Renderer::new(gl.gl.clone()).unwrap();
        let mut first: Option<Vec<Vec<u8>>> = None;
        for i in 0..10 {
            r.overlay(&shot.frame(), Encoding::Linear).unwrap();
            if std::env::var_os("FIN0").is_some() { unsafe { gl.gl.finish() }; }
            let mut m = Vec::new();
            r.masks(&shot.frame(), |batch| {
                if std::env::var_os("FIN").is_some() { unsafe { gl.gl.finish() }; }
                let t = crate::shot::read_texture::<[u8; 4]>(&gl.gl, batch.textures[0], [160, 120]);
                let again = crate::shot::read_texture::<[u8; 4]>(&gl.gl, batch.textures[0], [160, 120]);
                if t != again { println!("{:?} frame {i}: another read differs", gl.api); }
                m = (0..3).map(|c| t.iter().map(|t| t[c]).collect::<Vec<u8>>()).collect();
            }).unwrap();
            if let Some(f) = &first {
                if i == 1 { for l in 0..3 {
                    let d = f[l].iter().zip(&m[l]).filter(|(a, b)| a != b).count();
                    if d > 0 { println!("{:?} frame {i} light {l}: {d}", gl.api); }
                } }
            } else { first = Some(m); }
        }
        drop(canvas);
    });
}
