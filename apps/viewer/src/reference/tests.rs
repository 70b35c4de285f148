//! It converges, starts anew, stops, sleeps and survives.

use std::sync::atomic::AtomicU32;

use super::*;

/// A ball over a floor under a soft light that moves.
fn scene(eye_x: f64) -> Arc<Scene> {
    let text = format!(
        r#"
        camera = {{ eye = [{eye_x}, 4, 8] }}
        [[light]]
        name = "lamp"
        type = "sphere"
        position = [2, 5, 1]
        radius = 0.5
        intensity = 100
        motion = {{ type = "orbit", center = [0, 5, 0], axis = [0, 1, 0], period = 8 }}
        [[object]]
        name = "floor"
        shape = {{ type = "plane" }}
        [[object]]
        name = "ball"
        shape = {{ type = "sphere", radius = 1 }}
        translation = [0, 1.5, 0]
        "#
    );
    Arc::new(Scene::parse(&text, "ball.toml".as_ref()).expect("a good scene"))
}

/// Waits until a picture passes, for at most a minute.
fn wait(refinement: &mut Refinement, what: &str, passes: impl Fn(&Traced) -> bool) -> Traced {
    let began = Instant::now();
    loop {
        if let Some(traced) = refinement.latest()
            && passes(traced)
        {
            return traced.clone();
        }
        assert!(began.elapsed() < Duration::from_secs(60), "waited for {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn same(traced: &Traced, expected: &[[f32; 3]]) -> bool {
    traced.pixels.len() == expected.len()
        && traced.pixels.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// Whether there is nothing more to come for what was last asked.
fn finished(traced: &Traced) -> bool {
    !traced.stale && traced.samples >= traced.target
}

#[test]
fn it_ends_with_what_the_tracer_renders() {
    let mut refinement = Refinement::with_target(8, || {});
    assert!(refinement.latest().is_none(), "nothing has been asked for");
    for (scene, time) in [(scene(0.0), 0.0), (scene(1.0), 0.0), (scene(1.0), 3.0)] {
        refinement.request(scene.clone(), time, 61, 33);
        let traced = wait(&mut refinement, "the end", finished);
        assert_eq!((traced.width, traced.height, traced.samples, traced.target), (61, 33, 8, 8));
        let expected = Tracer::new(&scene, time).render(61, 33, 8, &|_, _| {});
        assert!(same(&traced, &expected), "another picture at {time}");
    }
}

#[test]
fn a_preview_comes_first_and_refinement_after() {
    let mut refinement = Refinement::with_target(1 << 20, || {});
    // Large enough that the first pass takes longer than it takes to look.
    refinement.request(scene(0.0), 0.0, 2001, 999);
    let preview = wait(&mut refinement, "a preview", |_| true).clone();
    assert_eq!(preview.samples, 0, "a preview comes first");
    assert_eq!((preview.width, preview.height, preview.pixels.len()), (501, 250, 501 * 250));
    refinement.request(scene(0.0), 0.0, 201, 99);
    let mut last =
        wait(&mut refinement, "the small one", |traced| !traced.stale && traced.width == 201).clone();
    let began = Instant::now();
    let mut pictures = 0;
    while began.elapsed() < Duration::from_secs(1) {
        if let Some(next) = refinement.latest()
            && next.version != last.version
        {
            assert!(next.version > last.version && next.samples > last.samples, "it only grows");
            assert_eq!((next.width, next.height, next.pixels.len(), next.stale), (201, 99, 201 * 99, false));
            last = next.clone();
            pictures += 1;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!((1..=10).contains(&pictures), "{pictures} pictures in a second");
}

#[test]
fn it_starts_anew_at_once_and_keeps_the_old_picture() {
    let mut refinement = Refinement::with_target(1 << 20, || {});
    // Far too large to end: each pass has 4 million pixels.
    refinement.request(scene(0.0), 0.0, 2000, 2000);
    let old = wait(&mut refinement, "a preview", |_| true);
    refinement.request(scene(0.5), 0.0, 16, 16);
    let shown = refinement.latest().expect("the old picture").clone();
    assert!(shown.stale && (shown.width, shown.version) == (old.width, old.version), "kept, and marked");
    let began = Instant::now();
    wait(&mut refinement, "the new one", |traced| !traced.stale && traced.width == 16);
    assert!(began.elapsed() < Duration::from_secs(2), "not before the old one's pass ended");
    // What is asked for again is not started again.
    let samples = wait(&mut refinement, "some passes", |traced| traced.samples > 10).samples;
    let turns = refinement.shared.turns.load(Ordering::Relaxed);
    for _ in 0..100 {
        refinement.request(scene(0.5), 0.0, 16, 16);
    }
    wait(&mut refinement, "more passes", |traced| traced.samples > samples);
    assert_eq!(
        refinement.shared.turns.load(Ordering::Relaxed),
        turns,
        "it has not turned to another request"
    );
}

/// A scene that changes faster than a preview takes still shows pictures.
#[test]
fn it_shows_what_changes_all_the_time() {
    let mut refinement = Refinement::with_target(64, || {});
    let (scene, began) = (scene(0.0), Instant::now());
    let mut versions = 0;
    while began.elapsed() < Duration::from_secs(2) {
        refinement.request(scene.clone(), began.elapsed().as_secs_f64(), 800, 600);
        versions = refinement.latest().map_or(0, |traced| traced.version);
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(versions >= 3, "{versions} pictures in two seconds");
}

#[test]
fn it_stops_when_dropped() {
    let mut refinement = Refinement::with_target(1 << 20, || {});
    refinement.request(scene(0.0), 0.0, 3000, 3000);
    wait(&mut refinement, "a preview", |_| true);
    let (shared, began) = (Arc::downgrade(&refinement.shared), Instant::now());
    drop(refinement);
    assert!(began.elapsed() < Duration::from_secs(2), "not before the pass ended");
    assert!(shared.upgrade().is_none(), "the worker has ended");
}

#[test]
fn it_sleeps_when_done() {
    let woken = Arc::new(AtomicU32::new(0));
    let counter = woken.clone();
    let mut refinement = Refinement::with_target(4, move || {
        counter.fetch_add(1, Ordering::Relaxed);
    });
    let scene = scene(0.0);
    refinement.request(scene.clone(), 0.0, 16, 16);
    let done = wait(&mut refinement, "the end", finished);
    std::thread::sleep(Duration::from_millis(50));
    let turns = refinement.shared.turns.load(Ordering::Relaxed);
    for _ in 0..100 {
        refinement.request(scene.clone(), 0.0, 16, 16);
        std::thread::sleep(Duration::from_millis(3));
    }
    assert_eq!(refinement.shared.turns.load(Ordering::Relaxed), turns, "the worker did not sleep");
    assert_eq!(refinement.latest().expect("the picture").version, done.version, "a picture of nothing new");
    assert!(woken.load(Ordering::Relaxed) <= 2, "a preview and the end");
}

#[test]
fn it_survives_a_panic() {
    let panicked = Arc::new(AtomicBool::new(false));
    let flag = panicked.clone();
    let mut refinement = Refinement::with_target(4, move || {
        assert!(flag.swap(true, Ordering::Relaxed), "the panic that this test is about");
    });
    refinement.request(scene(0.0), 0.0, 16, 16);
    wait(&mut refinement, "the preview before the panic", |_| true);
    while !panicked.load(Ordering::Relaxed) {
        std::thread::yield_now();
    }
    refinement.request(scene(1.0), 0.0, 16, 16);
    wait(&mut refinement, "the end of the next", finished);
}

#[test]
fn without_pixels_there_is_nothing_new() {
    let mut refinement = Refinement::with_target(4, || {});
    for (width, height) in [(0, 16), (16, 0), (0, 0)] {
        refinement.request(scene(0.0), f64::NAN, width, height);
    }
    refinement.request(scene(0.0), f64::NAN, 1, 1);
    let traced = wait(&mut refinement, "one pixel at no time", finished);
    assert_eq!(traced.pixels.len(), 1);
}
