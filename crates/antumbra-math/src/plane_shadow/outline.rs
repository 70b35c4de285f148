//! A convex region of the plane by its boundary: a closed loop of lines and conic arcs.
//!
//! The shadow of a convex occluder is convex: what is above the plane and below the light is convex,
//! and the projection from the light keeps it so. Its boundary is found in chains, in any
//! order; since it is convex, the chains' directions from an inner point put them in order.

use core::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::edge::Edge;
use super::frame::Bounds;

/// Edges whose ends are seen from the inner point within this angle do not decide what is inside. It
/// trades what a right angle in place of such an edge adds to the shadow, this times its size, against
/// what the edge's direction, known to 1e-16 over this, takes away.
const SHORT: f64 = 1e-9;

/// Two ends of neighbouring pieces closer than this, seen from the inner point, are one corner.
const SAME: f64 = 1e-15;

/// A convex region, its boundary counterclockwise. Corners may lie at infinity, and then the region
/// reaches it. A closed loop: every edge ends where the next one starts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    /// In coordinates (p - origin) / scale.
    edges: Vec<Edge>,
    /// A point inside, so that small shadows far from the frame's origin lose nothing.
    origin: DVec2,
    /// About the size of the region, leaving out what is far, metres.
    scale: f64,
}

impl Outline {
    /// The region bounded by the given chains of edges and by straight lines over the gaps between
    /// them. The chains may come in any order and run either way; in a chain every edge ends where the
    /// next one starts. `None` if they bound nothing, if all of their ends lie at infinity (what
    /// rounding leaves of an occluder that just touches the light's height), or if a number is not
    /// finite.
    pub(super) fn from_chains(chains: &[Vec<Edge>]) -> Option<Self> {
        if chains.iter().flatten().all(|edge| edge.start().z <= 0.0 && edge.end().z <= 0.0) {
            return None;
        }
        let lengths = chains.iter().map(Vec::len);
        let mut outline = Self { edges: chains.concat(), origin: DVec2::ZERO, scale: 1.0 }.recentered()?;
        let is_single = chains.len() == 1;
        let mut rest = outline.edges.as_slice();
        let mut chains = Vec::with_capacity(chains.len());
        for length in lengths.filter(|&length| length > 0) {
            let (chain, after) = rest.split_at(length);
            rest = after;
            // The angle that the chain sweeps, seen from inside: a single edge may be too short or too
            // far away to tell which way the chain runs.
            let points = chain.iter().flat_map(|edge| [edge.start(), edge.at(0.5), edge.end()]);
            let points: Vec<DVec2> = points.map(DVec3::truncate).collect();
            let sweep: f64 = points.windows(2).map(|p| p[0].perp_dot(p[1]).atan2(p[0].dot(p[1]))).sum();
            let middle = points[0].to_angle() + 0.5 * sweep;
            // If there is no other chain the shadow may be so thin that the inner point is on its edge
            // by rounding. Then the arcs' own bends tell.
            let bend: f64 = chain.iter().filter(|edge| edge.is_curved()).map(Edge::turn).sum();
            let turns_right = if is_single && bend != 0.0 { bend < 0.0 } else { sweep < 0.0 };
            let mut chain = chain.to_vec();
            if turns_right {
                chain = chain.iter().rev().map(Edge::reversed).collect();
            }
            chains.push((middle.rem_euclid(TAU), chain));
        }
        chains.sort_by(|a, b| a.0.total_cmp(&b.0));
        outline.edges = close(chains.into_iter().flat_map(|(_, chain)| chain), None);
        Some(outline)
    }

    /// The same region in coordinates that suit it. `None` if it has no point that is not at
    /// infinity, no extent, or a number that is not finite.
    fn recentered(&self) -> Option<Self> {
        let samples = || self.edges.iter().flat_map(|edge| [0.0, 0.5, 1.0].map(|t| edge.at(t)));
        // Homogeneous points of weight >= 0 add up to a point between them.
        let sum: DVec3 = samples().sum();
        let center = sum.truncate() / sum.z;
        let spread: f64 = samples().map(|p| (p.truncate() - center * p.z).length()).sum();
        let size = spread / sum.z;
        let local = |p: DVec3| ((p.truncate() - center * p.z) / size).extend(p.z);
        let edges: Vec<Edge> = self.edges.iter().map(|edge| edge.map(local)).collect();
        let outline = Self { edges, origin: self.origin + center * self.scale, scale: self.scale * size };
        let usable = size > 0.0 && outline.origin.is_finite() && outline.scale.is_finite();
        (usable && outline.edges.iter().all(Edge::is_finite)).then_some(outline)
    }

    /// The polygon with these homogeneous corners, which are in order around it.
    pub(super) fn polygon(corners: &[DVec3]) -> Option<Self> {
        let next = corners.iter().cycle().skip(1);
        let sides: Vec<Edge> = corners.iter().zip(next).map(|(&a, &b)| Edge::Line([a, b])).collect();
        Self::from_chains(&[sides])
    }

    /// The line between two homogeneous points, a region without area.
    pub(super) fn segment(a: DVec3, b: DVec3) -> Option<Self> {
        Self::from_chains(&[vec![Edge::Line([a, b])]])
    }

    /// The half-plane f · (x, y, 1) >= 0; `None` if f has no direction.
    pub(super) fn half_plane(f: DVec3) -> Option<Self> {
        let normal = f.truncate().normalize_or_zero();
        let foot = -normal * (f.z / f.truncate().length());
        // Counterclockwise around the foot, three of the corners at infinity: no two neighbours are
        // opposite.
        let along = normal.perp().extend(0.0);
        let corners = [along, DVec3::Z, -along, normal.extend(0.0)];
        let edges = (0..4).map(|i| Edge::Line([corners[i], corners[(i + 1) % 4]])).collect();
        let scale = if foot == DVec2::ZERO { 1.0 } else { foot.length() };
        (normal != DVec2::ZERO && foot.is_finite()).then_some(Self { edges, origin: foot, scale })
    }

    /// The part of the region where f · (x, y, 1) >= 0; `None` if there is none.
    pub(super) fn clipped(&self, f: DVec3) -> Option<Self> {
        self.cut(f).recentered()
    }

    /// The same in the region's own coordinates; without edges if there is none.
    fn cut(&self, f: DVec3) -> Self {
        let normal = f.truncate();
        let local = (normal * self.scale).extend(normal.dot(self.origin) + f.z);
        // Where the cut runs from infinity to infinity, it takes a finite point to say where.
        let n = local.truncate();
        let foot = (-n * (local.z / n.length_squared())).extend(1.0);
        let edges = close(self.edges.iter().flat_map(|edge| edge.clipped(local)), Some(foot));
        Self { edges, ..*self }
    }

    /// The part of the region in a box; `None` if there is none.
    pub(super) fn within(&self, bounds: &Bounds) -> Option<Self> {
        let mut outline = self.clone();
        if bounds.is_finite() {
            // The box's own coordinates first: the region's middle may be far away.
            let origin = 0.5 * (bounds.min + bounds.max);
            let scale = 0.5 * (bounds.max - bounds.min).length();
            let shift = self.origin - origin;
            let local = |p: DVec3| ((p.truncate() * self.scale + shift * p.z) / scale).extend(p.z);
            let edges: Vec<Edge> = self.edges.iter().map(|edge| edge.map(local)).collect();
            outline = Self { edges, origin, scale };
        }
        bounds.half_planes().fold(outline, |outline, f| outline.cut(f)).recentered()
    }

    /// Whether a point lies inside.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let p = ((point - self.origin) / self.scale).extend(1.0);
        // Directions of edges this short, less than a thousand times the rounding of the corners, are
        // unknown, and next to nothing lies outside them that does not lie outside others.
        let short = SHORT.max(1e3 * self.rounding()).min(1e-3);
        p.is_finite() && self.edges.iter().all(|edge| edge.admits(p, short))
    }

    /// The rounding of the coordinates that the region's own were computed from, in units of its own.
    fn rounding(&self) -> f64 {
        f64::EPSILON * (1.0 + self.origin.length() / self.scale)
    }

    /// Whether all of the boundary is seen from inside along one line, to rounding: an inside that
    /// only rounding has opened.
    pub(super) fn is_collapsed(&self) -> bool {
        let sine = |a: DVec3, b: DVec3| a.truncate().perp_dot(b.truncate()).abs() / (a.length() * b.length());
        let widest = self.edges.iter().flat_map(|edge| {
            let middle = edge.at(0.5);
            [sine(edge.start(), middle), sine(middle, edge.end())]
        });
        widest.fold(0.0, f64::max) <= 4.0 * self.rounding()
    }

    /// Whether a part of the boundary bends.
    pub(super) fn is_curved(&self) -> bool {
        self.edges.iter().any(Edge::is_curved)
    }

    /// Whether it reaches infinity.
    fn is_unbounded(&self) -> bool {
        self.edges.iter().any(|edge| edge.start().z <= 0.0 || edge.end().z <= 0.0)
    }

    /// Square metres: the polygon of the chords, and a segment for each arc. Infinite for a region
    /// that reaches infinity.
    pub(super) fn area(&self) -> f64 {
        if self.is_unbounded() {
            return f64::INFINITY;
        }
        let part = |edge: &Edge| {
            let (a, b) = (edge.start(), edge.end());
            0.5 * (a.x * b.y - a.y * b.x) / (a.z * b.z) + edge.bulge()
        };
        self.edges.iter().map(part).sum::<f64>().max(0.0) * self.scale * self.scale
    }

    /// The point farthest along `direction`, homogeneous, and its coordinate along it.
    pub(super) fn support(&self, direction: DVec2) -> (f64, DVec3) {
        let supports = self.edges.iter().map(|edge| edge.support(direction));
        let (value, p) = supports.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NEG_INFINITY, DVec3::Z));
        let point = (p.truncate() * self.scale + self.origin * p.z).extend(p.z);
        (value * self.scale + direction.dot(self.origin), point)
    }

    /// The smallest box around the region.
    pub(super) fn bounds(&self) -> Bounds {
        let reach = |direction: DVec2| self.support(direction).0;
        Bounds {
            min: -DVec2::new(reach(-DVec2::X), reach(-DVec2::Y)),
            max: DVec2::new(reach(DVec2::X), reach(DVec2::Y)),
        }
    }

    /// Points of the boundary in order, at least `count` if a part of it bends: every corner, and
    /// the others on the arcs by their length. The region must be bounded: corners at infinity are
    /// left out.
    pub(super) fn points(&self, count: usize) -> Vec<DVec2> {
        let length = |edge: &Edge| {
            let to = |a: DVec3, b: DVec3| (a.truncate() / a.z).distance(b.truncate() / b.z);
            let (a, middle, b) = (edge.start(), edge.at(0.5), edge.end());
            if edge.is_curved() { to(a, middle) + to(middle, b) } else { 0.0 }
        };
        let total: f64 = self.edges.iter().map(length).sum();
        let mut points = Vec::new();
        for edge in &self.edges {
            let share = (count as f64 * length(edge) / total).ceil();
            // The middle of the arc's parameter is its shoulder once its end weights are equal.
            let balance = (edge.start().z / edge.end().z).sqrt();
            let steps = if share.is_finite() && balance.is_finite() { share.max(1.0) as usize } else { 1 };
            for i in 0..steps {
                let s = i as f64 / steps as f64;
                let t = s * balance / (1.0 - s + s * balance);
                let p = edge.at(t);
                if p.z > 0.0 {
                    points.push(p.truncate() / p.z * self.scale + self.origin);
                }
            }
        }
        points.dedup();
        points
    }
}

/// The pieces with a line over every gap, from the last to the first too; over a gap between opposite
/// points at infinity, by way of `foot`.
fn close(pieces: impl Iterator<Item = Edge>, foot: Option<DVec3>) -> Vec<Edge> {
    let mut edges: Vec<Edge> = Vec::new();
    let bridge = |edges: &mut Vec<Edge>, to: DVec3| {
        let Some(from) = edges.last().map(Edge::end) else { return };
        if from.cross(to).length() > SAME * from.length() * to.length() {
            edges.push(Edge::Line([from, to]));
        } else if from.dot(to) < 0.0 {
            edges.extend(foot.into_iter().flat_map(|p| [Edge::Line([from, p]), Edge::Line([p, to])]));
        }
    };
    for piece in pieces {
        bridge(&mut edges, piece.start());
        edges.push(piece);
    }
    if let Some(first) = edges.first().map(Edge::start) {
        bridge(&mut edges, first);
    }
    edges
}
