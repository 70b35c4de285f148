//! The parts of the screen that any shadow can reach: passes over the screen draw these alone.

use glam::DVec2;

/// Pixels of a tile's side. Smaller tiles fit shadows better and make more vertices; 16 is four
/// times the block that software renderers shade at once.
const TILE: f64 = 16.0;

/// A grid of tiles over the viewport, each touched or not.
#[derive(Default)]
pub(crate) struct TileGrid {
    columns: usize,
    rows: usize,
    size: DVec2,
    touched: Vec<bool>,
    /// Of each row, where the polygon at hand begins and ends.
    spans: Vec<(f64, f64)>,
}

impl TileGrid {
    /// No tile is touched, in a viewport of `size` pixels.
    pub(crate) fn reset(&mut self, size: DVec2) {
        self.size = size;
        self.columns = (size.x / TILE).ceil() as usize;
        self.rows = (size.y / TILE).ceil() as usize;
        self.touched.clear();
        self.touched.resize(self.columns * self.rows, false);
    }

    /// No tile is touched any more, in the same viewport.
    pub(crate) fn reset_touched(&mut self) {
        self.touched.fill(false);
    }

    /// Touches every tile.
    pub(crate) fn touch_all(&mut self) {
        self.touched.fill(true);
    }

    /// Whether no tile is touched.
    pub(crate) fn is_untouched(&self) -> bool {
        !self.touched.contains(&true)
    }

    /// Touches the tiles that a convex polygon inside the viewport meets.
    pub(crate) fn touch(&mut self, polygon: &[DVec2]) {
        self.spans.clear();
        self.spans.resize(self.rows, (f64::INFINITY, f64::NEG_INFINITY));
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let (low, high) = if p.y <= q.y { (p, q) } else { (q, p) };
            let last = ((high.y / TILE) as usize).min(self.rows - 1);
            for row in (low.y / TILE) as usize..=last {
                let at = |y: f64| {
                    let t = (y - low.y) / (high.y - low.y);
                    if t.is_finite() { low.x + (high.x - low.x) * t.clamp(0.0, 1.0) } else { low.x }
                };
                let (a, b) = if high.y > low.y {
                    (at(row as f64 * TILE), at((row + 1) as f64 * TILE))
                } else {
                    (low.x, high.x)
                };
                let span = &mut self.spans[row];
                *span = (span.0.min(a).min(b), span.1.max(a).max(b));
            }
        }
        for (row, &(from, to)) in self.spans.iter().enumerate() {
            if from <= to {
                let columns = (from / TILE) as usize..=((to / TILE) as usize).min(self.columns - 1);
                self.touched[row * self.columns..][columns].fill(true);
            }
        }
    }

    /// Adds the touched tiles of another grid of the same size.
    pub(crate) fn add(&mut self, other: &Self) {
        self.touched.iter_mut().zip(&other.touched).for_each(|(t, o)| *t |= o);
    }

    /// The smallest rectangle that holds all touched tiles: x, y, width, height in pixels; empty if there are none.
    pub(crate) fn rectangle(&self) -> [i32; 4] {
        let (mut low, mut high) = (self.size, DVec2::ZERO);
        self.runs(|a, b| (low, high) = (low.min(a), high.max(b)));
        let size = (high - low).max(DVec2::ZERO);
        [low.x, low.y, size.x, size.y].map(|x| x as i32)
    }

    /// Appends two triangles for each run of touched tiles, in clip space.
    pub(crate) fn triangles(&self, vertices: &mut Vec<[f32; 2]>) {
        self.runs(|a, b| {
            let corners = [a, DVec2::new(b.x, a.y), b, a, b, DVec2::new(a.x, b.y)];
            vertices.extend(corners.map(|p| (p / self.size * 2.0 - 1.0).as_vec2().to_array()));
        });
    }

    /// How many tiles there are.
    pub(crate) fn len(&self) -> usize {
        self.touched.len()
    }

    /// How many tiles are touched.
    pub(crate) fn touched_len(&self) -> usize {
        self.touched.iter().filter(|touched| **touched).count()
    }

    /// The indices of the touched tiles.
    pub(crate) fn touched(&self) -> impl Iterator<Item = usize> {
        self.touched.iter().enumerate().filter_map(|(i, touched)| touched.then_some(i))
    }

    /// The corners of a tile, in pixels, in order.
    pub(crate) fn corners(&self, tile: usize) -> [DVec2; 4] {
        let (x, y) = (tile % self.columns, tile / self.columns);
        let corner = |x: usize, y: usize| (DVec2::new(x as f64, y as f64) * TILE).min(self.size);
        [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)]
    }

    /// Calls `rectangle` with the lower left and the upper right corner, in pixels, of runs of
    /// touched tiles.
    fn runs(&self, mut rectangle: impl FnMut(DVec2, DVec2)) {
        for (y, row) in self.touched.chunks_exact(self.columns.max(1)).enumerate() {
            let mut x = 0;
            for run in row.chunk_by(|a, b| a == b) {
                if run[0] {
                    let corner = |x: usize, y: usize| (DVec2::new(x as f64, y as f64) * TILE).min(self.size);
                    rectangle(corner(x, y), corner(x + run.len(), y + 1));
                }
                x += run.len();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(grid: &TileGrid) -> Vec<(f64, f64, f64, f64)> {
        let mut all = Vec::new();
        grid.runs(|a, b| all.push((a.x, a.y, b.x, b.y)));
        all
    }

    #[test]
    fn a_rectangle_holds_the_touched_tiles_and_no_more() {
        let mut grid = TileGrid::default();
        grid.reset(DVec2::new(200.0, 100.0));
        grid.touch(&[DVec2::new(40.0, 20.0), DVec2::new(60.0, 20.0), DVec2::new(40.0, 30.0)]);
        assert_eq!(grid.rectangle(), [32, 16, 32, 16], "two tiles");
        assert_eq!((grid.touched_len(), grid.len()), (2, 13 * 7), "of all that the viewport has");
        grid.touch(&[DVec2::new(190.0, 90.0), DVec2::new(199.0, 99.0), DVec2::new(195.0, 99.0)]);
        assert_eq!(grid.rectangle(), [32, 16, 168, 84], "up to the corner");
    }

    #[test]
    fn touches_every_tile_a_polygon_meets() {
        let mut random = 1u64;
        let mut next = |below: f64| {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (random >> 33) as f64 / (1u64 << 31) as f64 * below
        };
        let size = DVec2::new(200.0, 100.0);
        for _ in 0..500 {
            let triangle = [0; 3].map(|_| DVec2::new(next(size.x), next(size.y)));
            let mut grid = TileGrid::default();
            grid.reset(size);
            grid.touch(&triangle);
            let runs = covered(&grid);
            for _ in 0..50 {
                let (mut u, mut v) = (next(1.0), next(1.0));
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let [a, b, c] = triangle;
                let p = a + (b - a) * u + (c - a) * v;
                let inside = |&(x0, y0, x1, y1): &(f64, f64, f64, f64)| {
                    x0 <= p.x && p.x <= x1 && y0 <= p.y && p.y <= y1
                };
                assert!(runs.iter().any(inside), "{p} of {triangle:?} is in no run");
            }
        }
    }

    #[test]
    fn the_whole_viewport_is_its_size_and_nothing_is_nothing() {
        let size = DVec2::new(33.0, 17.0);
        let mut grid = TileGrid::default();
        grid.reset(size);
        assert!(covered(&grid).is_empty() && grid.rectangle()[2..] == [0, 0], "no polygon, no tile");
        grid.touch(&[DVec2::ZERO, DVec2::new(33.0, 0.0), size, DVec2::new(0.0, 17.0)]);
        let whole = [(0.0, 0.0, 33.0, 16.0), (0.0, 16.0, 33.0, 17.0)];
        assert_eq!(covered(&grid), whole, "two rows of tiles");
        assert_eq!(grid.rectangle(), [0, 0, 33, 17], "all of it");
        let mut all = TileGrid::default();
        all.reset(size);
        assert!(all.is_untouched(), "nothing yet");
        all.touch_all();
        assert!(covered(&all) == whole && !all.is_untouched(), "the same tiles");
    }
}
