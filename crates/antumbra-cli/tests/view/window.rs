//! The window: its size, screens of many pixels, being hidden, and what the program costs.

use std::time::Duration;

use serde_json::json;

use crate::shadows;
use crate::viewer::{Desk, Viewer};

/// The most that the first picture may take: a generous bound for a busy machine without a graphics card.
const START: Duration = Duration::from_secs(15);

/// CPU time in two seconds of nothing: 5 % of a core.
const IDLE: Duration = Duration::from_millis(100);

#[test]
fn resized_hidden_and_shown() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    eprintln!("the first picture is there after {:?}", v.first_still);
    assert!(v.first_still < START, "the first picture after {:?}", v.first_still);
    v.without_marks();
    for size in [[640, 480], [1300, 950], [480, 320], [900, 600]] {
        desk.screen.resize(v.window, size);
        v.wait("the new size", |state| state["window"] == json!(size));
        let [_, _, w, h] = v.picture();
        assert!(w > 100.0 && h > 0.8 * f64::from(size[1]), "the picture fills it: {w} x {h}");
        assert_eq!(v.shot().size, size.map(|x| x as usize), "as large as the window");
        if size[0] > 500 {
            shadows::see(v);
        }
    }
    // Minimised and back.
    desk.screen.show(v.window, false);
    desk.screen.resize(v.window, [800, 560]);
    desk.screen.show(v.window, true);
    v.wait("the size that it got meanwhile", |state| state["window"] == json!([800, 560]));
    desk.screen.focus(v.window);
    shadows::see(v);
    covered(v, &desk);
}

/// Behind another window it draws nothing, and comes back as it should be.
fn covered(v: &mut Viewer<'_>, desk: &Desk) {
    v.press_for("Space", "time runs", |state| state["playing"] == true);
    v.press_for("Space", "time stands", |state| state["playing"] == false);
    let cover = desk.screen.cover();
    // Keys still arrive; the picture that they change is drawn once it can be seen.
    v.press("N");
    v.press("N");
    std::thread::sleep(Duration::from_millis(300));
    desk.screen.uncover(cover);
    v.wait("the light moved", |state| {
        (state["lights"][0]["position"][0].as_f64().unwrap_or(0.0) + 0.8).abs() < 1e-9
    });
    shadows::see(v);
}

#[test]
fn screens_of_many_pixels() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer =
        desk.view_with(&["ball.toml", "--fresh", "--size", "640x420"], &[("WINIT_X11_SCALE_FACTOR", "2")]);
    let v = &mut viewer;
    assert_eq!((v.number("/scale"), &v.state["window"]), (2.0, &json!([1280, 840])), "two pixels a point");
    v.without_marks();
    shadows::see(v);
    v.click("Button", "Split");
    v.wait("clicks hit", |state| state["settings"]["layout"] == "split");
    v.click("Button", "Single");
    v.wait("clicks hit", |state| state["settings"]["layout"] == "single");
    v.click_at(v.project(v.vector("/objects/1/position")));
    v.wait("in the picture too", |state| state["chosen"] == json!({ "object": 1 }));
    let from = v.project(v.light(0));
    v.drag(1, from, [from[0] + 100.0, from[1] + 20.0]);
    let seen = v.project(v.light(0));
    assert!(
        (seen[0] - from[0] - 100.0).abs() < 2.0,
        "what is dragged stays under the pointer: {from:?} to {seen:?}"
    );
    shadows::see(v);
}

/// Nothing happens for two seconds: no frame, and hardly any CPU time.
fn idles(v: &mut Viewer<'_>, when: &str) {
    v.still();
    // What is still on its way: a hover that fades, the last line.
    v.lines_within(Duration::from_millis(1500));
    let before = v.cpu();
    let lines = v.lines_within(Duration::from_secs(2));
    let spent = v.cpu() - before;
    eprintln!("{when}: {spent:?} of CPU time and {lines} lines in two seconds");
    assert!(before > Duration::ZERO, "starting took some CPU time");
    assert!(spent <= IDLE, "{when}: {spent:?} of CPU time in two seconds of nothing");
    assert_eq!(lines, 0, "{when}: nothing changed");
}

#[test]
fn it_rests_when_nothing_happens() {
    let Some(desk) = Desk::new() else { return };
    let motion =
        "intensity = 30.0\nmotion = { type = \"orbit\", center = [0, 4, 0], axis = [0, 1, 0], period = 8 }";
    desk.write("ball.toml", &shadows::BALL.replace("intensity = 30.0", motion));
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "480x320"]);
    let v = &mut viewer;
    idles(v, "after the start");
    v.press_for("Space", "time runs", |state| state["time"].as_f64() > Some(0.2));
    v.press_for("Space", "time stands", |state| state["playing"] == false);
    idles(v, "after a pause");
    v.press_for("E", "the reference", |state| state["settings"]["layout"] == "split");
    v.wait_within(Duration::from_secs(240), "all rays", |state| {
        state["traced"][0].as_u64() > Some(0) && state["traced"][0] == state["traced"][1]
    });
    idles(v, "after the last ray");
}

/// Lets so many frames pass; memory afterwards, MiB.
fn play(v: &mut Viewer<'_>, frames: u64) -> f64 {
    let end = v.state["frames"].as_u64().unwrap_or(0) + frames;
    v.press_for("Space", "time runs", |state| state["playing"] == true);
    v.wait_within(Duration::from_secs(3600), "frames", |state| state["frames"].as_u64() >= Some(end));
    v.press_for("Space", "time stands", |state| state["playing"] == false);
    v.still();
    v.memory()
}

/// Goes through so many scenes of the gallery; memory afterwards, MiB.
fn leaf(v: &mut Viewer<'_>, scenes: usize) -> f64 {
    for _ in 0..scenes {
        let before = v.state["scene"].clone();
        v.press_for("PageDown", "the next scene", |state| state["scene"] != before && state["still"] == true);
    }
    v.memory()
}

/// More frames of a scene, and more scenes after as many, take no more memory.
fn flat(frames: u64, scenes: usize) {
    let Some(desk) = Desk::new() else { return };
    let mut viewer = desk.view(&["--fresh", "--size", "480x320"]);
    let v = &mut viewer;
    let (warm, after) = (play(v, frames.min(500)), play(v, frames));
    eprintln!("{warm:.1} MiB when warm, {after:.1} MiB after {frames} frames more");
    // A frame that kept a kilobyte would take ten of these.
    assert!(
        after < warm + 1.0 + frames as f64 * 1e-4,
        "frames keep memory: {warm:.1} MiB, then {after:.1} MiB"
    );
    // The allocator takes what the largest scene needs, and more where threads happen to take turns in another way; what
    // is kept of each scene grows with every round.
    let mut rounds = vec![leaf(v, scenes)];
    let grows = |pair: &[f64]| pair[1] >= 1.05 * pair[0] + 8.0;
    while rounds.len() < 4 && rounds.windows(2).all(grows) {
        rounds.push(leaf(v, scenes));
        eprintln!("after each {scenes} scenes, in MiB: {rounds:.1?}");
    }
    assert!(!rounds.windows(2).all(grows), "scenes keep memory: {rounds:.1?} MiB");
}

#[test]
fn memory_stays() {
    flat(150, 16);
}

#[test]
#[ignore = "takes minutes"]
fn memory_stays_for_ten_thousand_frames_and_a_hundred_scenes() {
    flat(10_000, 100);
}
