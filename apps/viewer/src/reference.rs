//! The reference picture, refined in the background: a coarse preview at once, then sample after sample, so that
//! the interface never waits for the ray tracer.

#[cfg(test)]
mod tests;

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use antumbra_reference::Tracer;
use antumbra_scene::Scene;
use glam::DVec3;

/// Samples a pixel after which a picture counts as finished.
const TARGET: u32 = 1024;
/// The preview has this share of the pixels in each direction.
const PREVIEW: u32 = 4;
/// Pictures are reported no faster than this.
const REPORT_EVERY: Duration = Duration::from_millis(100);
/// How long a preview may outlive its request. Without this a scene that changes every frame would start previews
/// and show none.
const PREVIEW_GRACE: Duration = Duration::from_millis(250);

/// A picture by the reference, complete or on its way.
#[derive(Clone, Debug)]
pub(crate) struct Traced {
    /// Pixels across; of a preview fewer than asked for.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
    /// Rays through each pixel so far; 0 for a preview, of which one ray goes through each of its larger pixels.
    pub(crate) samples: u32,
    /// Rays through each pixel of the finished picture.
    pub(crate) target: u32,
    /// Linear radiance, rows top to bottom, without exposure.
    pub(crate) pixels: Vec<[f32; 3]>,
    /// Different for every picture of a [`Refinement`]; grows.
    pub(crate) version: u64,
    /// Whether the picture is of something that was asked for earlier.
    pub(crate) stale: bool,
}

/// Refines the reference picture of one scene at one time in the background.
///
/// Works on its own threads, one fewer than the machine has cores, and sleeps when the picture is finished. Should the
/// tracer fail, the pictures so far stay and the next request starts anew.
pub(crate) struct Refinement {
    shared: Arc<Shared>,
    worker: Option<JoinHandle<()>>,
    wanted: Option<Request>,
    /// The newest picture and the ticket it is for.
    latest: Option<(u64, Traced)>,
}

/// What to draw.
#[derive(Clone)]
struct Request {
    /// Number of the request, from 1.
    ticket: u64,
    scene: Arc<Scene>,
    time: f64,
    width: u32,
    height: u32,
}

impl Request {
    /// Whether the picture would be the same.
    fn is_for(&self, scene: &Arc<Scene>, time: f64, width: u32, height: u32) -> bool {
        // Bits: a time that is not a number asks for the same every time.
        (self.width, self.height, self.time.to_bits()) == (width, height, time.to_bits())
            && (Arc::ptr_eq(&self.scene, scene) || self.scene == *scene)
    }
}

/// What the interface and the worker tell each other.
struct Shared {
    inbox: Mutex<Option<Request>>,
    changed: Condvar,
    quit: AtomicBool,
    /// Ticket of the newest request.
    current: AtomicU64,
    /// The newest picture that the interface has not taken, and the ticket it is for.
    outbox: Mutex<Option<(u64, Traced)>>,
    /// How often the worker has looked for something to do.
    #[cfg(test)]
    turns: AtomicU64,
}

/// The data under a lock, though another thread may have panicked with it: everything kept there is replaced whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Refinement {
    /// Starts the worker, asleep. `wake` is called from another thread after every new picture: about ten times a
    /// second, and once more for each request's preview.
    pub(crate) fn new(wake: impl Fn() + Send + 'static) -> Self {
        Self::with_target(TARGET, wake)
    }

    fn with_target(target: u32, wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::new(Shared {
            inbox: Mutex::new(None),
            changed: Condvar::new(),
            quit: AtomicBool::new(false),
            current: AtomicU64::new(0),
            outbox: Mutex::new(None),
            #[cfg(test)]
            turns: AtomicU64::new(0),
        });
        let mut worker = Worker {
            shared: shared.clone(),
            wake: Box::new(wake),
            target,
            version: 0,
            pool: None,
            ready: None,
        };
        let worker = std::thread::Builder::new().name("reference".into()).spawn(move || worker.run());
        let worker = worker
            .inspect_err(|error| log::error!("the reference cannot be traced, no thread for it: {error}"))
            .ok();
        Self { shared, worker, wanted: None, latest: None }
    }

    /// Asks for the picture of a scene at a time, in seconds; the scene's own image size does not matter.
    ///
    /// Costs next to nothing if it is what was last asked for, above all with the same `Arc`. Otherwise the worker
    /// stops what it does within a few rows, or within a quarter of a second during a preview, and starts anew; until
    /// the first pass is there [`latest`](Self::latest) stays the old picture. Without pixels there is no new picture.
    pub(crate) fn request(&mut self, scene: Arc<Scene>, time: f64, width: u32, height: u32) {
        if self.wanted.as_ref().is_some_and(|wanted| wanted.is_for(&scene, time, width, height)) {
            return;
        }
        let ticket = self.shared.current.load(Ordering::Relaxed) + 1;
        let request = Request { ticket, scene, time, width, height };
        self.wanted = Some(request.clone());
        let mut inbox = lock(&self.shared.inbox);
        *inbox = Some(request);
        self.shared.current.store(ticket, Ordering::Relaxed);
        drop(inbox);
        self.shared.changed.notify_one();
    }

    /// Stops until the next request, for when nobody looks. The picture that is there is kept.
    pub(crate) fn rest(&mut self) {
        if let Some(wanted) = self.wanted.take() {
            self.request(wanted.scene, wanted.time, 0, 0);
            self.wanted = None;
        }
    }

    /// The newest picture, if there is one yet.
    pub(crate) fn latest(&mut self) -> Option<&Traced> {
        if let Some(new) = lock(&self.shared.outbox).take() {
            self.latest = Some(new);
        }
        let wanted = self.shared.current.load(Ordering::Relaxed);
        let (ticket, traced) = self.latest.as_mut()?;
        traced.stale = *ticket != wanted;
        Some(traced)
    }
}

impl Drop for Refinement {
    /// Stops the worker, within a few rows, and waits for it.
    fn drop(&mut self) {
        let inbox = lock(&self.shared.inbox);
        self.shared.quit.store(true, Ordering::Relaxed);
        drop(inbox);
        self.shared.changed.notify_one();
        if let Some(worker) = self.worker.take() {
            // An error is a panic, which has been reported where it happened.
            let _ = worker.join();
        }
    }
}

/// The background thread.
struct Worker {
    shared: Arc<Shared>,
    wake: Box<dyn Fn() + Send>,
    target: u32,
    version: u64,
    /// Made for the first picture: a viewer that never shows the reference has no threads for it.
    pool: Option<rayon::ThreadPool>,
    /// The last scene, ready for rays.
    ready: Option<Ready>,
}

impl Worker {
    fn run(&mut self) {
        while let Some(request) = self.next() {
            let ticket = request.ticket;
            // What a panic leaves half done is not used again: pool and scene have been taken out.
            if catch_unwind(AssertUnwindSafe(|| self.trace(&request))).is_err() {
                log::error!("the reference stopped tracing picture {ticket}");
            }
        }
    }

    /// Sleeps until there is a request; `None` at the end.
    fn next(&self) -> Option<Request> {
        let mut inbox = lock(&self.shared.inbox);
        loop {
            #[cfg(test)]
            self.shared.turns.fetch_add(1, Ordering::Relaxed);
            if self.shared.quit.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(request) = inbox.take() {
                return Some(request);
            }
            inbox = self.shared.changed.wait(inbox).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn trace(&mut self, request: &Request) {
        let pool = self.pool.take().or_else(make_pool);
        match &pool {
            Some(pool) => pool.install(|| self.refine(request)),
            None => self.refine(request),
        }
        self.pool = pool;
    }

    fn refine(&mut self, request: &Request) {
        let (width, height) = (request.width, request.height);
        if width == 0 || height == 0 {
            return;
        }
        let began = Instant::now();
        let ready = self.ready.take().filter(|ready| ready.serves(request));
        let mut ready = ready.unwrap_or_else(|| Ready::new(request));
        ready.tracer.set_camera(request.scene.camera);

        let shared = self.shared.clone();
        let open = || !shared.quit.load(Ordering::Relaxed);
        let current = || open() && shared.current.load(Ordering::Relaxed) == request.ticket;
        let in_grace = || current() || (open() && began.elapsed() < PREVIEW_GRACE);

        let (preview_width, preview_height) = (width.div_ceil(PREVIEW), height.div_ceil(PREVIEW));
        let mut sums = sums(preview_width, preview_height);
        if ready.tracer.accumulate(preview_width, preview_height, 0, &mut sums, &in_grace) {
            self.report(request.ticket, (preview_width, preview_height), 0, &sums);
            self.sample_by_sample(request, &ready.tracer, &current);
        }
        self.ready = Some(ready);
    }

    fn sample_by_sample(&mut self, request: &Request, tracer: &Tracer, current: &(dyn Fn() -> bool + Sync)) {
        if !current() {
            return;
        }
        let (width, height) = (request.width, request.height);
        let mut sums = sums(width, height);
        let mut reported = Instant::now();
        for sample in 0..self.target {
            if !tracer.accumulate(width, height, sample, &mut sums, current) {
                return;
            }
            let samples = sample + 1;
            if samples == self.target || reported.elapsed() >= REPORT_EVERY {
                self.report(request.ticket, (width, height), samples, &sums);
                reported = Instant::now();
            }
        }
    }

    fn report(&mut self, ticket: u64, (width, height): (u32, u32), samples: u32, sums: &[DVec3]) {
        let scale = 1.0 / f64::from(samples.max(1));
        let pixels = sums.iter().map(|&sum| (sum * scale).as_vec3().to_array()).collect();
        self.version += 1;
        let (target, version) = (self.target, self.version);
        let traced = Traced { width, height, samples, target, pixels, version, stale: false };
        *lock(&self.shared.outbox) = Some((ticket, traced));
        (self.wake)();
    }
}

/// A scene at a time, ready for rays.
struct Ready {
    scene: Arc<Scene>,
    time: f64,
    tracer: Tracer,
}

impl Ready {
    fn new(request: &Request) -> Self {
        let tracer = Tracer::new(&request.scene, request.time);
        Self { scene: request.scene.clone(), time: request.time, tracer }
    }

    /// Whether the request is for the same things, if seen from elsewhere.
    fn serves(&self, request: &Request) -> bool {
        let (old, new) = (&self.scene, &request.scene);
        self.time.to_bits() == request.time.to_bits()
            && (Arc::ptr_eq(old, new)
                || (old.ambient == new.ambient
                    && old.image.background == new.image.background
                    && old.lights == new.lights
                    && old.objects == new.objects))
    }
}

/// A core is left to the interface and to OpenGL.
fn make_pool() -> Option<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    rayon::ThreadPoolBuilder::new()
        .num_threads((cores - 1).max(1))
        .thread_name(|index| format!("reference {index}"))
        .build()
        .inspect_err(|error| log::warn!("the reference shares its threads with others: {error}"))
        .ok()
}

fn sums(width: u32, height: u32) -> Vec<DVec3> {
    vec![DVec3::ZERO; width as usize * height as usize]
}
