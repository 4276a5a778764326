//! The outline of a letter: closed curves of straight and quadratic segments; a point is inside if a line from it
//! crosses them an odd number of times.
//!
//! The side of the ray on which the end of a segment lies is computed once for both segments that share it, so no ray
//! slips in between them.

use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel};
use glam::DVec2;
use smallvec::SmallVec;

/// Upper bound of the error of the distance along a line, in roundings.
const ROUNDINGS: f64 = 32.0;
/// Least squared length of a direction for which such a distance keeps all its digits.
const MIN_SQUARE: f64 = 1e-200;

/// Crossings of a line with an outline, in order: `t`, and the index of the piece.
type CrossingList = SmallVec<[(f64, u32); 8]>;

/// Crossings of a line with an outline on an interval of the line.
pub(super) struct Crossings {
    /// True if an odd number of crossings before the interval was dropped.
    pub(super) starts_inside: bool,
    pub(super) list: CrossingList,
}

/// A piece of an outline: a quadratic Bézier curve.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    points: [DVec2; 3],
    /// True if the inside lies to the left of it.
    is_left_inside: bool,
}

/// The x and y coordinates of the three control points of four pieces.
type PiecePacket = [[[f64; 4]; 2]; 3];

/// The outline of a letter.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outline {
    pieces: Vec<Piece>,
    /// The pieces in packets of four, padded with the last one.
    packets: Vec<PiecePacket>,
    /// The largest absolute coordinate.
    size: f64,
}

/// Kernel that finds the crossings of a line with an outline.
struct CrossingKernel<'a> {
    outline: &'a Outline,
    origin: DVec2,
    dir: DVec2,
    dir_sq: f64,
    /// Distances along the line, times `dir_sq`, outside of which no crossing is needed.
    interval: [f64; 2],
}

impl Outline {
    /// Builds the outline from pieces that form closed curves.
    pub(super) fn new(pieces: Vec<[DVec2; 3]>) -> Self {
        let pieces = pieces.into_iter().filter(|[a, b, c]| a != b || b != c);
        let pieces: Vec<Piece> = pieces
            .map(|points| Piece {
                points,
                is_left_inside: false,
            })
            .collect();
        let packets = pieces.chunks(4).map(|of| {
            let coordinate = |point: usize, axis: usize| {
                std::array::from_fn(|lane| of[lane.min(of.len() - 1)].points[point][axis])
            };
            [0, 1, 2].map(|point| [0, 1].map(|axis| coordinate(point, axis)))
        });
        let mut outline = Outline {
            packets: packets.collect(),
            pieces,
            size: 0.0,
        };
        let (low, high) = outline.bounds();
        outline.size = low.abs().max(high.abs()).max_element();
        for number in 0..outline.pieces.len() {
            let piece = outline.pieces[number];
            let left = piece.slope(0.5).perp();
            // Few pieces of an outline, even of one that crosses itself, are narrower than this share of their length.
            let beside = piece.at(0.5) + 1e-6 * left;
            outline.pieces[number].is_left_inside = outline.contains(beside);
        }
        outline
    }

    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }

    /// The corners of its bounding box; `low` is above `high` if it is empty.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let points = self.pieces.iter().flat_map(|piece| piece.points);
        points.fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), point| (low.min(point), high.max(point)),
        )
    }

    /// Crossings of the line `origin + t · dir` with the outline, at least for `from < t < to`; the others may be
    /// dropped.
    #[inline(always)]
    pub(super) fn crossings(
        &self,
        lanes: SimdLevel,
        [origin, dir]: [DVec2; 2],
        [from, to]: [f64; 2],
    ) -> Crossings {
        let dir_sq = dir.length_squared();
        let reach = self.size + origin.x.abs() + origin.y.abs();
        let size = (dir.x.abs() + dir.y.abs()) * reach;
        let tolerance = |length: f64| ROUNDINGS * f64::EPSILON * (size + length.abs());
        let interval = if dir_sq > MIN_SQUARE {
            let [from, to] = [from, to].map(|t| t * dir_sq);
            [from - tolerance(from), to + tolerance(to)]
        } else {
            [f64::NEG_INFINITY, f64::INFINITY]
        };
        let mut hits = lanes.run(CrossingKernel {
            outline: self,
            origin,
            dir,
            dir_sq,
            interval,
        });
        if hits.list.len() > 1 {
            let order = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
            hits.list.sort_unstable_by(order);
        }
        hits
    }

    /// True if a point lies inside.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let crossings = self
            .pieces
            .iter()
            .map(|piece| piece.crossings_beside(point));
        crossings.sum::<usize>() % 2 == 1
    }

    /// Outward normal of a piece at a point on it.
    pub(super) fn normal(&self, number: u32, point: DVec2) -> DVec2 {
        let piece = &self.pieces[number as usize];
        let left = piece.slope(piece.parameter(point)).perp();
        if piece.is_left_inside { -left } else { left }
    }
}

impl SimdKernel for CrossingKernel<'_> {
    type Output = Crossings;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Crossings {
        let mut crossings = Crossings {
            starts_inside: false,
            list: CrossingList::new(),
        };
        let (origin, dir) = (self.origin, self.dir);
        let (origin_x, origin_y) = (F::splat(origin.x), F::splat(origin.y));
        let (dir_x, dir_y) = (F::splat(dir.x), F::splat(dir.y));
        for (of, first) in self.outline.packets.iter().zip((0..).step_by(4)) {
            // Written out: `map` is not always inlined.
            let x0 = F::from_array(&of[0][0]) - origin_x;
            let y0 = F::from_array(&of[0][1]) - origin_y;
            let x1 = F::from_array(&of[1][0]) - origin_x;
            let y1 = F::from_array(&of[1][1]) - origin_y;
            let x2 = F::from_array(&of[2][0]) - origin_x;
            let y2 = F::from_array(&of[2][1]) - origin_y;
            let side0 = dir_x * y0 - dir_y * x0;
            let side1 = dir_x * y1 - dir_y * x1;
            let side2 = dir_x * y2 - dir_y * x2;
            let zero = F::splat(0.0);
            let negative0 = F::bitmask(side0.lt(zero));
            let negative1 = F::bitmask(side1.lt(zero));
            let negative2 = F::bitmask(side2.lt(zero));
            // Most pieces lie on one side of the line.
            let mut lanes = negative0 ^ negative1 | negative1 ^ negative2;
            if lanes == 0 {
                continue;
            }
            let along0 = dir_x * x0 + dir_y * y0;
            let along1 = dir_x * x1 + dir_y * y1;
            let along2 = dir_x * x2 + dir_y * y2;
            let least = along0.lane_min(along1).lane_min(along2);
            let most = along0.lane_max(along1).lane_max(along2);
            let before = F::bitmask(most.lt(F::splat(self.interval[0])));
            let beyond = F::bitmask(F::splat(self.interval[1]).lt(least));
            let pieces = self.outline.pieces.len() - first;
            if pieces < 4 {
                lanes &= (1 << pieces) - 1;
            }
            let passed = lanes & before & (negative0 ^ negative2);
            crossings.starts_inside ^= passed.count_ones() % 2 == 1;
            lanes &= !(before | beyond);
            let side = [side0.to_array(), side1.to_array(), side2.to_array()];
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let number = first + lane;
                let piece = &self.outline.pieces[number];
                for s in sign_changes([side[0][lane], side[1][lane], side[2][lane]]) {
                    let t = dir.dot(piece.at(s) - origin) / self.dir_sq;
                    crossings
                        .list
                        .push((t, u32::try_from(number).unwrap_or(u32::MAX)));
                }
            }
        }
        crossings
    }
}

impl Piece {
    #[inline]
    fn at(&self, s: f64) -> DVec2 {
        let [a, b, c] = self.points;
        let r = 1.0 - s;
        r * r * a + 2.0 * r * s * b + s * s * c
    }

    /// Number of crossings of the piece with the line from a point towards +x, modulo two.
    fn crossings_beside(&self, target: DVec2) -> usize {
        let side = self.points.map(|point| point.y - target.y);
        let [first, middle, last] = side.map(|side| side < 0.0);
        if first == middle && middle == last {
            return 0;
        }
        let ahead = self.points.map(|point| point.x - target.x);
        // The piece lies within the hull of its points.
        if ahead.iter().all(|ahead| *ahead < 0.0) {
            0
        } else if ahead.iter().all(|ahead| *ahead > 0.0) {
            usize::from(first != last)
        } else {
            let params = sign_changes(side).into_iter();
            params.filter(|s| self.at(*s).x > target.x).count()
        }
    }

    fn slope(&self, s: f64) -> DVec2 {
        let [a, b, c] = self.points;
        let slope = (1.0 - s) * (b - a) + s * (c - b);
        if slope == DVec2::ZERO { c - a } else { slope }
    }

    /// The parameter of a point on the piece: a root of one coordinate, chosen by the other.
    fn parameter(&self, target: DVec2) -> f64 {
        let [a, _, c] = self.points;
        let away = [a, c].map(|end| (end - target).length_squared());
        let ends = if away[0] < away[1] { 0.0 } else { 1.0 };
        let mut best = (away[0].min(away[1]), ends);
        for axis in [0, 1] {
            let offset = self.points.map(|point| point[axis] - target[axis]);
            for s in roots(offset) {
                let s = s.clamp(0.0, 1.0);
                let away = (self.at(s) - target).length_squared();
                if away < best.0 {
                    best = (away, s);
                }
            }
        }
        best.1
    }
}

/// Sign changes between zero and one of a quadratic with these Bernstein coefficients.
fn sign_changes(c: [f64; 3]) -> SmallVec<[f64; 2]> {
    let [first, middle, last] = c.map(|c| c < 0.0);
    let mut changes = SmallVec::new();
    if first != last {
        // Exactly one root lies in between, however the other is rounded.
        let off = |s: &f64| (s - 0.5).abs();
        let root = roots(c)
            .into_iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)));
        changes.push(root.unwrap_or(0.5).clamp(0.0, 1.0));
    } else if first != middle {
        let both = roots(c);
        if both.len() == 2 && both.iter().all(|s| (0.0..=1.0).contains(s)) {
            changes.extend(both);
        }
    }
    changes
}

/// The finite roots of a quadratic with these Bernstein coefficients.
fn roots([c0, c1, c2]: [f64; 3]) -> SmallVec<[f64; 2]> {
    let (a, half_b) = (c0 - 2.0 * c1 + c2, c1 - c0);
    let quarter = half_b * half_b - a * c0;
    if quarter < 0.0 {
        return SmallVec::new();
    }
    let q = -(half_b + quarter.sqrt().copysign(half_b));
    let both = [q / a, c0 / q];
    both.into_iter().filter(|s| s.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square with a round hole of four quadratic pieces.
    fn ring() -> Outline {
        let p = DVec2::new;
        let line = |a: DVec2, b: DVec2| [a, 0.5 * (a + b), b];
        let corners = [p(-1.0, -1.0), p(1.0, -1.0), p(1.0, 1.0), p(-1.0, 1.0)];
        let mut pieces: Vec<_> = (0..4)
            .map(|i| line(corners[i], corners[(i + 1) % 4]))
            .collect();
        let hole = [p(-0.5, 0.0), p(0.0, 0.5), p(0.5, 0.0), p(0.0, -0.5)];
        let bends = [p(-0.5, 0.5), p(0.5, 0.5), p(0.5, -0.5), p(-0.5, -0.5)];
        pieces.extend((0..4).map(|i| [hole[i], bends[i], hole[(i + 1) % 4]]));
        Outline::new(pieces)
    }

    /// The crossings of the whole line.
    fn whole(outline: &Outline, origin: DVec2, dir: DVec2) -> CrossingList {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let hits = outline.crossings(SimdLevel::widest(), [origin, dir], all);
        assert!(!hits.starts_inside);
        hits.list
    }

    #[test]
    fn an_interval_of_a_line_has_the_crossings_of_the_whole() {
        let ring = ring();
        for lanes in [SimdLevel::NARROW, SimdLevel::widest()] {
            for slope in [-0.7, -0.1, 0.0, 0.3, 1.0] {
                let (origin, dir) = (DVec2::new(-3.0, 0.2 - 3.0 * slope), DVec2::new(1.0, slope));
                let all = whole(&ring, origin, dir);
                for [from, to] in [[2.2, 3.3], [2.7, 2.8], [-1.0, 3.0], [3.9, 9.0]] {
                    let hits = ring.crossings(lanes, [origin, dir], [from, to]);
                    let wanted = |hit: &&(f64, u32)| from < hit.0 && hit.0 < to;
                    let here: Vec<_> = hits.list.iter().filter(wanted).collect();
                    assert_eq!(here, all.iter().filter(wanted).collect::<Vec<_>>());
                    let before = |hit: &&(f64, u32)| hit.0 <= from;
                    let left_out =
                        all.iter().filter(before).count() - hits.list.iter().filter(before).count();
                    assert_eq!(hits.starts_inside, left_out % 2 == 1);
                }
            }
        }
    }

    #[test]
    fn a_hole_is_outside() {
        let ring = ring();
        for (x, y, is_inside) in [
            (0.0, 0.0, false),
            (0.0, 0.6, true),
            (0.7, 0.7, true),
            (1.2, 0.0, false),
            (-0.49, 0.0, false),
        ] {
            assert_eq!(ring.contains(DVec2::new(x, y)), is_inside, "{x} {y}");
        }
    }

    #[test]
    fn lines_through_corners_cross_an_even_number_of_times() {
        let ring = ring();
        for to in [
            DVec2::ONE,
            DVec2::new(0.5, 0.0),
            DVec2::new(0.0, 0.5),
            DVec2::X,
        ] {
            for from in [
                DVec2::new(-3.0, -3.0),
                DVec2::new(-7.0, 0.0),
                DVec2::new(0.1, 9.0),
            ] {
                let crossings = whole(&ring, from, to - from);
                assert_eq!(crossings.len() % 2, 0, "{from} {to} {crossings:?}");
            }
        }
    }

    #[test]
    fn normals_point_out() {
        let ring = ring();
        for (origin, dir) in [
            (DVec2::new(-3.0, 0.2), DVec2::X),
            (DVec2::new(0.2, -3.0), DVec2::new(0.1, 1.0)),
        ] {
            for (at, (t, piece)) in whole(&ring, origin, dir).iter().enumerate() {
                let normal = ring.normal(*piece, origin + *t * dir);
                assert_eq!(normal.dot(dir) > 0.0, at % 2 == 1, "{at}");
            }
        }
    }
}
