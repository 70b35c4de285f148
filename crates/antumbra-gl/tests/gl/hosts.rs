//! Hosts of other habits: bindings of their own, targets by name, state that they vouch for, a renderer between threads.

use crate::context::{Kind, in_each, in_each_api};
use crate::lights::{STEP, many_lights};
use crate::odd_host::OddHost;
use crate::sampled::area_lights;
use crate::shot::{Canvas, Shot, VIEWPORT, assert_needs_floats, each_batch, read_texture};
use crate::snapshot::{assert_same, snapshot};
use antumbra_gl::{Camera, Encoding, Error, Frame, Framebuffer, HostState, Light, Occluder, Renderer, Tier};
use glow::HasContext;
use std::ffi::{CString, c_void};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What each kind of context is to the renderer.
#[test]
fn tiers_are_what_the_extensions_say() {
    let kinds = [
        (Kind::Gl33, Tier::Core33Samples),
        (Kind::Gles, Tier::Es3Float),
        (Kind::BareGles, Tier::Es3),
        (Kind::HalfGles, Tier::Es3Half),
    ];
    for (kind, tier) in kinds {
        in_each([kind], |gl| {
            let renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            assert_eq!(renderer.caps().tier, tier, "{kind:?}");
        });
    }
}

/// Penumbrae of half floats where these can be drawn to, though they do not blend; what blends is refused.
#[test]
fn half_floats_are_enough_for_penumbrae() {
    let penumbrae = Mutex::new(Vec::new());
    in_each([Kind::Gles, Kind::HalfGles], |gl| {
        let (few, many) = (area_lights(3), area_lights(11));
        let (shot, many_shot) = (Shot::new(gl, &few), Shot::new(gl, &many));
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let mut texels: Vec<[f32; 4]> = Vec::new();
        each_batch(&mut renderer, &shot.frame(), |batch| {
            texels = read_texture(&gl.gl, batch.textures[0].glow(), [VIEWPORT[2], VIEWPORT[3]]);
        })
        .expect("the frame is right");
        gl.assert_no_complaint("masks of half floats");
        penumbrae.lock().expect("one thread").push(texels);
        let canvas = Canvas::new(gl);
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("one batch");
        assert!(canvas.read(0).iter().filter(|texel| texel[0] < 200).count() > 300, "there are shadows");
        if gl.kind == Kind::HalfGles {
            assert_needs_floats(&mut renderer, &many_shot.frame());
        }
    });
    if let [all, half] = &penumbrae.lock().expect("one thread")[..] {
        assert!(all.iter().filter(|t| t[0] > 0.1 && t[0] < 0.9).count() > 100, "there are penumbrae");
        assert!(all == half, "the same masks");
    }
}

#[test]
fn an_overlay_goes_to_the_framebuffer_that_is_named() {
    in_each_api(|gl| {
        for count in [3, 20] {
            let world = many_lights(count);
            let shot = Shot::new(gl, &world);
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            let (named, bound) = (Canvas::new(gl), OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]));
            let before = snapshot(gl);
            // SAFETY: the canvas lives.
            let target = unsafe { Framebuffer::from_name(named.framebuffer.0.get()) };
            renderer.overlay_to(&shot.frame(), Encoding::Linear, target).expect("the frame is right");
            assert_same(&before, &snapshot(gl), "an overlay to a framebuffer by name");
            let bound = bound.calm_down(gl);
            assert!(bound.read(0).iter().all(|texel| *texel == [255; 4]), "what is bound is left alone");
            world.truth(&shot).assert_overlay(&named.read(0), STEP);
        }
    });
}

/// A host that vouches for its state finds that of a new context, but for what is undefined, whatever it was before.
#[test]
fn a_host_that_vouches_finds_the_state_of_a_new_context() {
    in_each_api(|gl| {
        let new = snapshot(gl);
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        renderer.set_host_state(HostState::Reset);
        assert_eq!(renderer.host_state(), HostState::Reset);
        let canvas = Canvas::new(gl);
        for technique in Shot::able(&shot.frame()) {
            renderer.set_technique(technique).expect("a technique");
            gl.bind(canvas.framebuffer);
            renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
            gl.assert_no_complaint("an overlay");
            // SAFETY: a query.
            let bound = unsafe { gl.gl.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING) };
            assert_eq!(bound, Some(canvas.framebuffer), "{technique}: it is left bound");
            each_batch(&mut renderer, &shot.frame(), |_| {}).expect("the frame is right");
            let found = snapshot(gl);
            let undefined = ["VIEWPORT", "SCISSOR_BOX"];
            // Of stencil masks those bits count that there are.
            let same = |name: &str, was: &[i64], is: &[i64]| {
                was == is || (name.starts_with("STENCIL") && was[0] & 255 == is[0] & 255)
            };
            let pairs = new.iter().zip(&found).filter(|((name, _), _)| !undefined.contains(&name.as_str()));
            let changed: Vec<_> = pairs.filter(|((name, was), (_, is))| !same(name, was, is)).collect();
            assert!(changed.is_empty(), "{technique}: not as in a new context: {changed:?}");
        }
    });
}

/// What it finds is set, not trusted to be there.
#[test]
fn a_host_that_vouches_may_leave_anything_set() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        for technique in Shot::able(&shot.frame()) {
            let [plain, odd] = [false, true].map(|odd| {
                let canvas = Canvas::new(gl);
                let host = odd.then(|| OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]));
                let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
                renderer.set_host_state(HostState::Reset);
                renderer.set_technique(technique).expect("a technique");
                // SAFETY: the canvas lives.
                let target = unsafe { Framebuffer::from_glow(Some(canvas.framebuffer)) };
                renderer.overlay_to(&shot.frame(), Encoding::Linear, target).expect("the frame is right");
                host.map(|host| host.calm_down(gl));
                canvas.read(0)
            });
            assert!(plain.iter().any(|texel| texel[0] < 200), "there are shadows");
            assert!(odd == plain, "{technique}: the picture depends on the host's state");
        }
    });
}

/// Questions that drivers answer slowly, some across processes, are not asked of a host that vouches.
#[test]
fn a_host_that_vouches_is_not_asked() {
    static ASKED: AtomicUsize = AtomicUsize::new(0);
    type IsEnabled = extern "system" fn(u32) -> u8;
    type GetIntegers = extern "system" fn(u32, *mut i32);
    static IS_ENABLED: AtomicUsize = AtomicUsize::new(0);
    static GET_INTEGERS: AtomicUsize = AtomicUsize::new(0);
    extern "system" fn is_enabled(switch: u32) -> u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the driver's function of this name, kept below.
        unsafe { std::mem::transmute::<usize, IsEnabled>(IS_ENABLED.load(Ordering::Relaxed))(switch) }
    }
    extern "system" fn get_integers(name: u32, values: *mut i32) {
        ASKED.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe {
            std::mem::transmute::<usize, GetIntegers>(GET_INTEGERS.load(Ordering::Relaxed))(name, values)
        }
    }
    in_each_api(|gl| {
        let load = |name: &str| {
            let found = gl.context.get_proc_address(&CString::new(name).expect("a name without zeros"));
            match name {
                "glIsEnabled" => {
                    IS_ENABLED.store(found as usize, Ordering::Relaxed);
                    is_enabled as *const c_void
                }
                "glGetIntegerv" => {
                    GET_INTEGERS.store(found as usize, Ordering::Relaxed);
                    get_integers as *const c_void
                }
                _ => found,
            }
        };
        // SAFETY: the driver's functions, or others of their signatures; the context stays current.
        let mut renderer = unsafe { Renderer::from_loader(load) }.expect("a renderer");
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let mut questions = |host_state| {
            renderer.set_host_state(host_state);
            let mut draw = || renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
            draw(); // what is made is asked about
            gl.bind(canvas.framebuffer);
            ASKED.store(0, Ordering::Relaxed);
            draw();
            ASKED.load(Ordering::Relaxed)
        };
        let (restoring, resetting) = (questions(HostState::Restore), questions(HostState::Reset));
        eprintln!("{:?}: {restoring} questions, {resetting} of a host that vouches", gl.kind);
        assert!(restoring > 30, "they are counted: {restoring}");
        assert_eq!(resetting, 1, "what is bound for drawing");
    });
}

/// A host without glow: functions by a loader, textures and framebuffers by their names, matrices and vectors as arrays.
#[test]
fn a_loader_and_names_are_enough() {
    in_each_api(|gl| {
        let load = |name: &str| gl.context.get_proc_address(&CString::new(name).expect("no zeros"));
        // SAFETY: the context's own functions; it stays current.
        let mut renderer = unsafe { Renderer::from_loader(load) }.expect("a renderer");
        let world = many_lights(2);
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let camera = Camera::new(
            shot.camera.view.as_mat4().to_cols_array_2d(),
            shot.camera.projection.to_cols_array_2d(),
        );
        let lights = [Light::point([2.0f32, 5.0, 3.0], [60.0f32, 40.0, 20.0])];
        let occluders = [Occluder::sphere([-1.0, 1.0, 0.3], 0.6f32)];
        let frame = Frame::new(camera, VIEWPORT, shot.frame().surface)
            .lights(&lights)
            .occluders(&occluders)
            .ambient([0.1f32; 3]);
        renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
        assert!(canvas.read(0).iter().any(|texel| texel[0] < 100), "the ball has a shadow");
        // SAFETY: a loader of nothing.
        let nothing = unsafe { Renderer::from_loader(|_| std::ptr::null()) };
        assert!(matches!(nothing.err(), Some(Error::NoContext { .. })), "an error, no panic");
    });
}

/// A renderer behind a lock, used by a callback that may be sent anywhere, as user interfaces want them.
#[test]
fn a_renderer_may_be_behind_a_lock() {
    in_each_api(|gl| {
        let renderer = std::sync::Arc::new(Mutex::new(Renderer::new(gl.gl.clone()).expect("a renderer")));
        fn callback<F: Fn(&Frame<'_>) -> Result<(), Error> + Send + Sync + 'static>(callback: F) -> F {
            callback
        }
        let shared = renderer.clone();
        let draw =
            callback(move |frame| shared.lock().expect("not poisoned").overlay(frame, Encoding::Linear));
        let world = many_lights(2);
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        draw(&shot.frame()).expect("the frame is right");
        drop(draw);
        assert!(canvas.read(0).iter().any(|texel| texel[0] < 200), "there are shadows");
    });
}
