//! Rooms of boards that abut, and lamps where people put them: no line of light in a shadow that is whole, and what is in a
//! ceiling, in a ball or flush with a wall shines as it should.

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::{Ray, Sampling, Tracer};
use antumbra_scene::Scene;
use antumbra_testkit::{metrics, penumbra::Penumbra, truth::Truth};
use glam::{DQuat, DVec3};
use std::fmt::Write;

/// Rooms; `ANTUMBRA_SCENES` sets another number.
const ROOMS: u64 = 12;
const SIZE: [u32; 2] = [160, 120];

fn scenes() -> u64 {
    std::env::var("ANTUMBRA_SCENES").map_or(ROOMS, |n| n.parse().expect("a number of scenes"))
}

/// A room somewhere in the world, turned any way.
struct Room {
    text: String,
    turn: DQuat,
    middle: DVec3,
    half: DVec3,
    boards: usize,
}

impl Room {
    fn new(rng: &mut fastrand::Rng) -> Self {
        let mut one = || rng.f64() * 2.0 - 1.0;
        let turn = DQuat::from_xyzw(one(), one(), one(), one()).normalize();
        let middle = DVec3::new(one(), one(), one()) * 5.0;
        let half = DVec3::new(1.0 + one() * 0.4, 1.0 + one() * 0.3, 1.0 + one() * 0.4);
        Self { text: String::new(), turn, middle, half, boards: 0 }
    }

    fn place(&self, local: DVec3) -> DVec3 {
        self.middle + self.turn * local
    }

    fn object(&mut self, shape: &str, at: DVec3, turn: DQuat) {
        let (at, turn) = (self.place(at).to_array(), (self.turn * turn).to_array());
        let name = self.boards;
        self.boards += 1;
        writeln!(
            self.text,
            "[[object]]\nname = \"{name}\"\nshape = {{ {shape} }}\nrotation = {turn:?}\ntranslation = {at:?}"
        )
        .expect("memory");
    }

    /// A wall: the axis that it stands on and which of the two, as one board, two, or two triangles. `hole` leaves a part out.
    fn wall(&mut self, axis: usize, side: f64, rng: &mut fastrand::Rng, hole: bool) {
        let normal = DVec3::AXES[axis] * side;
        let (u, v) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let (a, b) = (self.half.dot(u), self.half.dot(v));
        let at = normal * self.half[axis];
        // Rectangles lie in the plane of x and z.
        let turn = DQuat::from_mat3(&glam::DMat3::from_cols(u, v.cross(u), v));
        let rectangle = |w: f64, d: f64| format!("type = \"rectangle\", width = {w:?}, depth = {d:?}");
        let cut = 0.2 + 0.6 * rng.f64();
        match if hole { 1 } else { rng.usize(0..4) } {
            1 | 2 => {
                let first = 2.0 * a * cut;
                self.object(&rectangle(first, 2.0 * b), at - u * (a - first / 2.0), turn);
                if !hole {
                    self.object(&rectangle(2.0 * a - first, 2.0 * b), at + u * (first / 2.0), turn);
                }
            }
            3 => {
                let corner = |x: f64, z: f64| [x * a, 0.0, z * b];
                let triangle = |p: [f64; 3], q: [f64; 3], r: [f64; 3]| {
                    format!("type = \"triangle\", vertices = [{p:?}, {q:?}, {r:?}]")
                };
                let [p, q, r, s] =
                    [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                self.object(&triangle(p, q, r), at, turn);
                self.object(&triangle(p, r, s), at, turn);
            }
            _ => self.object(&rectangle(2.0 * a, 2.0 * b), at, turn),
        }
    }

    fn walls(&mut self, rng: &mut fastrand::Rng, hole: bool) {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                self.wall(axis, side, rng, hole && axis == 1 && side > 0.0);
            }
        }
    }

    /// The scene, seen from a corner.
    fn scene(&self, lights: &str) -> Scene {
        let eye = self.place(self.half * DVec3::new(0.8, 0.7, 0.85)).to_array();
        let target = self.place(self.half * DVec3::new(-0.6, -0.8, -0.7)).to_array();
        let up = (self.turn * DVec3::Y).to_array();
        let text = format!(
            "[camera]\neye = {eye:?}\ntarget = {target:?}\nup = {up:?}\nfov_y = 75\n{lights}\n{}",
            self.text
        );
        Scene::parse(&text, "room.toml".as_ref()).expect("the room is right")
    }
}

fn visibility(stage: &mut Stage, scene: &Scene, technique: &str) -> Vec<Vec<f32>> {
    let options = RenderOptions {
        time: 0.0,
        width: SIZE[0],
        height: SIZE[1],
        msaa: 1,
        visibility: true,
        shadows: true,
        technique: technique.parse::<Technique>().expect("a technique"),
        soft: Soft::Native,
    };
    stage.render(scene, &options).expect("the scene draws").visibility
}

/// The visibility of a light averaged over a pixel, whatever is seen in it.
fn area(scene: &Scene, tracer: &Tracer, light: usize, pixel: usize) -> f32 {
    let (x, y) = ((pixel % SIZE[0] as usize) as f64, (pixel / SIZE[0] as usize) as f64);
    let mut sum = 0.0;
    for n in 0..32 * 32 {
        let at = |k: u32| (f64::from(k) + 0.5) / 32.0;
        let (origin, direction) = scene.camera.ray(x + at(n % 32), y + at(n / 32), SIZE[0], SIZE[1]);
        sum += tracer
            .surface(&Ray::new(origin, direction))
            .map_or(1.0, |s| tracer.visibility_at(light, &s, 1, 0));
    }
    (sum / 1024.0) as f32
}

/// Pixels around which the truth is the same everywhere, whatever is seen there.
fn flat(centers: &[f32]) -> Vec<bool> {
    let [w, h] = SIZE.map(|n| n as usize);
    (0..w * h)
        .map(|i| {
            let (x, y) = (i % w, i / w);
            (y.saturating_sub(1)..(y + 2).min(h))
                .all(|ny| (x.saturating_sub(1)..(x + 2).min(w)).all(|nx| centers[ny * w + nx] == centers[i]))
        })
        .collect()
}

/// A sun outside of a closed room, and one that shines in by a gap in its ceiling; a lamp inside.
#[test]
fn no_light_runs_along_seams() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    // On edges: of closed rooms, and of those with a hole.
    let (mut judged, mut largest, mut squares, mut edges) = (0, 0.0f32, [0.0; 2], [0usize; 2]);
    for seed in 0..scenes() {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut room = Room::new(&mut rng);
        let hole = seed % 3 == 2;
        room.walls(&mut rng, hole);
        // A board in the middle that touches nothing, for edges.
        let tilt = DQuat::from_rotation_x(0.3);
        let board = "type = \"rectangle\", width = 0.5, depth = 0.4";
        room.object(board, DVec3::new(-0.2, -0.3, 0.1) * room.half, tilt);
        let mut one = || rng.f64() - 0.5;
        let sun = (room.turn * DVec3::new(one(), -1.0, one())).to_array();
        let lamp = room.place(room.half * DVec3::new(one(), one() + 0.3, one())).to_array();
        let scene = room.scene(&format!(
            "[[light]]\nname = \"sun\"\ntype = \"directional\"\ndirection = {sun:?}\nintensity = 3\n\
             [[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {lamp:?}\nintensity = 3\n"
        ));
        let tracer = Tracer::new(&scene, 0.0);
        for (light, test) in visibility(&mut stage, &scene, "analytic").iter().enumerate() {
            let centers =
                tracer.visibility(light, SIZE[0], SIZE[1], Sampling::Center { light_samples: 1 }, &|_, _| {});
            let flat = flat(&centers);
            // Where centres do not tell, at tips of shadows, it is a true edge.
            let off: Vec<f32> = (0..test.len())
                .map(|i| {
                    let off = (test[i] - centers[i]).abs();
                    if !flat[i] || off <= 0.1 {
                        return off;
                    }
                    let area = area(&scene, &tracer, light, i);
                    if area > 0.0 && area < 1.0 { 0.0 } else { (test[i] - area).abs() }
                })
                .collect();
            let worst = (0..test.len()).filter(|&i| flat[i]).max_by(|&a, &b| off[a].total_cmp(&off[b]));
            let worst = worst.expect("some of it is flat");
            judged += flat.iter().filter(|flat| **flat).count();
            if off[worst] > 0.05 {
                let (x, y) = (worst % SIZE[0] as usize, worst / SIZE[0] as usize);
                let truth = area(&scene, &tracer, light, worst);
                eprintln!("room {seed}, light {light}: {} for {truth} at ({x}, {y})", test[worst]);
            }
            largest = largest.max(off[worst]);
            let truth = Truth::new(&scene, &tracer, light, SIZE[0], SIZE[1]);
            let rms = metrics::rms(test, &truth.visibility, &truth.edge);
            if std::env::var_os("ANTUMBRA_VERBOSE").is_some() {
                for i in
                    (0..test.len()).filter(|&i| truth.edge[i] && (test[i] - truth.visibility[i]).abs() > 0.08)
                {
                    let (x, y) = (i % SIZE[0] as usize, i / SIZE[0] as usize);
                    eprintln!(
                        "  edge, room {seed}, light {light}: {} for {} at ({x}, {y})",
                        test[i], truth.visibility[i]
                    );
                }
            }
            let count = truth.edge.iter().filter(|edge| **edge).count();
            squares[usize::from(hole)] += rms * rms * count as f64;
            edges[usize::from(hole)] += count;
        }
    }
    let rms = [0, 1].map(|i| (squares[i] / f64::from(edges[i] as u32)).sqrt());
    eprintln!("{judged} pixels, off by at most {largest}; {edges:?} on edges, rms {rms:.4?}");
    assert!(
        judged > 100_000 && edges[0] > 500 && edges[1] > 200,
        "much to judge: {judged}, {edges:?} on edges"
    );
    assert!(largest <= 0.1, "a pixel of a whole shadow or of whole light is off by {largest}");
    assert!(rms[0] <= 0.02, "edges in closed rooms: {rms:?}");
    // Beside a hole the edge of a board is continued in part, and where it ends single pixels are taken whole.
    assert!(rms[1] <= 0.13, "edges in rooms with a hole: {rms:?}");
}

/// Lamps flush with a ceiling, a hair before or behind it, half in it, inside of a ball.
#[test]
fn lamps_in_walls_and_balls() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let (mut squares, mut pixels, mut largest, mut whole) = (0.0, 0, 0.0f64, 0);
    for seed in 0..scenes() {
        let mut rng = fastrand::Rng::with_seed(100 + seed);
        let mut room = Room::new(&mut rng);
        let turn = DQuat::IDENTITY;
        let [a, b] = [room.half.x * 2.0, room.half.z * 2.0];
        let rectangle = format!("type = \"rectangle\", width = {a:?}, depth = {b:?}");
        let height = room.half.y;
        room.object(&rectangle, DVec3::Y * -height, turn);
        room.object(&rectangle, DVec3::Y * height, turn);
        room.object("type = \"sphere\", radius = 0.3", DVec3::new(-0.3, -0.3, 0.2), turn);
        let down = (room.turn * -DVec3::Y).to_array();
        let right = (room.turn * DVec3::X).to_array();
        let aside = DVec3::new(rng.f64() - 0.5, 0.0, rng.f64() - 0.5) * 0.4;
        let hair = [0.0, 0.0, -1e-5, 0.03][rng.usize(0..4)];
        let at = room.place(aside + DVec3::Y * (height + hair)).to_array();
        let light = match seed % 4 {
            0 => format!(
                "type = \"rectangle\"\ndirection = {down:?}\nright = {right:?}\nwidth = 0.6\nheight = 0.4\nposition = {at:?}"
            ),
            1 => format!("type = \"disc\"\ndirection = {down:?}\nradius = 0.3\nposition = {at:?}"),
            2 => format!("type = \"sphere\"\nradius = 0.25\nposition = {at:?}"),
            _ => {
                // Of a ball part of which another holds.
                let lamp = room.place(DVec3::new(-0.3, -0.05, 0.2) + aside * 0.3).to_array();
                format!("type = \"sphere\"\nradius = 0.2\nposition = {lamp:?}")
            }
        };
        let scene = room.scene(&format!("[[light]]\nname = \"lamp\"\nintensity = 3\n{light}\n"));
        let tracer = Tracer::new(&scene, 0.0);
        let penumbra = Penumbra::new(&scene, &tracer, 0, SIZE[0], SIZE[1]);
        let truth = Truth::new(&scene, &tracer, 0, SIZE[0], SIZE[1]);
        let ids = tracer.primitives_seen(SIZE[0], SIZE[1]);
        for technique in ["analytic", "analytic:quality=exact"] {
            let test = &visibility(&mut stage, &scene, technique)[0];
            // What is whole is whole. To the ceiling, flush with it, the light may shine or not: nothing of it arrives.
            let band = truth.band(1);
            let off = |i: usize| (test[i] - truth.visibility[i]).abs();
            let judged = |i: &usize| !band[*i] && !truth.edge[*i] && ids[*i] != Some(1);
            let wrong = (0..test.len()).filter(judged).filter(|&i| off(i) > 0.02).count();
            whole += (0..test.len()).filter(judged).count();
            let rmse = penumbra.rmse(test).unwrap_or(0.0);
            eprintln!(
                "room {seed}, {technique}: {wrong} wrong, {} in penumbra, {rmse:.4}",
                penumbra.pixels.len()
            );
            assert_eq!(wrong, 0, "room {seed}, {technique}");
            squares += rmse * rmse * penumbra.pixels.len() as f64;
            pixels += penumbra.pixels.len();
            largest = largest.max(rmse);
        }
    }
    let rmse = (squares / f64::from(pixels as u32)).sqrt();
    eprintln!("{pixels} pixels in penumbrae, rmse {rmse:.4}, of one room at most {largest:.4}");
    assert!(pixels > 2000 && whole > 50_000, "there are penumbrae, {pixels}, and the rest, {whole}");
    assert!(rmse <= 0.006 && largest <= 0.02, "{rmse}, of one room {largest}");
}
