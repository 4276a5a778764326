//! The outline of a letter: closed curves of straight and quadratic pieces; a place is inside if a line from it crosses
//! them an odd number of times.
//!
//! Which side of the ray the end of a piece lies on is computed once for both pieces that share it, so no ray slips in
//! between them.

use glam::DVec2;
use smallvec::SmallVec;

/// Where a line crosses an outline: its parameter, and the number of the piece.
pub(super) type Crossings = SmallVec<[(f64, u32); 16]>;

/// A piece of an outline: a quadratic Bézier curve.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    points: [DVec2; 3],
    /// Whether the inside lies to the left of it.
    is_left_inside: bool,
}

/// The outline of a letter.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outline {
    pieces: Vec<Piece>,
}

impl Outline {
    /// The outline of these pieces, which come back to where they start.
    pub(super) fn new(pieces: Vec<[DVec2; 3]>) -> Self {
        let pieces = pieces.into_iter().filter(|[a, b, c]| a != b || b != c);
        let mut outline = Outline {
            pieces: pieces
                .map(|points| Piece {
                    points,
                    is_left_inside: false,
                })
                .collect(),
        };
        for number in 0..outline.pieces.len() {
            let piece = outline.pieces[number];
            let left = piece.slope(0.5).perp();
            // Even where it crosses itself, an outline has few pieces as short as this share of their length.
            let beside = piece.at(0.5) + 1e-6 * left;
            outline.pieces[number].is_left_inside = outline.contains(beside);
        }
        outline
    }

    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }

    /// The corners of a box around it; the first is the larger if it is empty.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let points = self.pieces.iter().flat_map(|piece| piece.points);
        points.fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), point| (low.min(point), high.max(point)),
        )
    }

    /// Where the line `origin + t · dir` crosses the outline, in order.
    pub(super) fn crossings(&self, origin: DVec2, dir: DVec2) -> Crossings {
        let mut found = Crossings::new();
        let dir_sq = dir.length_squared();
        for (number, piece) in (0..).zip(&self.pieces) {
            let side = piece.points.map(|point| dir.perp_dot(point - origin));
            let [first, middle, last] = side.map(|side| side < 0.0);
            // Most pieces lie on one side of the line.
            if first == middle && middle == last {
                continue;
            }
            for s in sign_changes(side) {
                let t = dir.dot(piece.at(s) - origin) / dir_sq;
                found.push((t, number));
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found
    }

    /// Whether a place lies inside.
    pub(super) fn contains(&self, place: DVec2) -> bool {
        let crossings = self
            .pieces
            .iter()
            .map(|piece| piece.crossings_beside(place));
        crossings.sum::<usize>() % 2 == 1
    }

    /// The outward normal of a piece at a place on it.
    pub(super) fn normal(&self, number: u32, place: DVec2) -> DVec2 {
        let piece = &self.pieces[number as usize];
        let left = piece.slope(piece.parameter(place)).perp();
        if piece.is_left_inside { -left } else { left }
    }
}

impl Piece {
    fn at(&self, s: f64) -> DVec2 {
        let [a, b, c] = self.points;
        let r = 1.0 - s;
        r * r * a + 2.0 * r * s * b + s * s * c
    }

    /// How often the way from a place along x crosses the piece, give or take two.
    fn crossings_beside(&self, place: DVec2) -> usize {
        let side = self.points.map(|point| point.y - place.y);
        let [first, middle, last] = side.map(|side| side < 0.0);
        if first == middle && middle == last {
            return 0;
        }
        let ahead = self.points.map(|point| point.x - place.x);
        // The piece lies between its points.
        if ahead.iter().all(|ahead| *ahead < 0.0) {
            0
        } else if ahead.iter().all(|ahead| *ahead > 0.0) {
            usize::from(first != last)
        } else {
            let places = sign_changes(side).into_iter();
            places.filter(|s| self.at(*s).x > place.x).count()
        }
    }

    fn slope(&self, s: f64) -> DVec2 {
        let [a, b, c] = self.points;
        let slope = (1.0 - s) * (b - a) + s * (c - b);
        if slope == DVec2::ZERO { c - a } else { slope }
    }

    /// The parameter of a place on the piece: a coordinate of it is a root, the other tells which.
    fn parameter(&self, place: DVec2) -> f64 {
        let [a, _, c] = self.points;
        let away = [a, c].map(|end| (end - place).length_squared());
        let ends = if away[0] < away[1] { 0.0 } else { 1.0 };
        let mut best = (away[0].min(away[1]), ends);
        for axis in [0, 1] {
            let offset = self.points.map(|point| point[axis] - place[axis]);
            for s in roots(offset) {
                let s = s.clamp(0.0, 1.0);
                let away = (self.at(s) - place).length_squared();
                if away < best.0 {
                    best = (away, s);
                }
            }
        }
        best.1
    }
}

/// Where a quadratic of these Bernstein coefficients changes its sign between zero and one.
fn sign_changes(c: [f64; 3]) -> SmallVec<[f64; 2]> {
    let [first, middle, last] = c.map(|c| c < 0.0);
    let mut found = SmallVec::new();
    if first != last {
        // One of the roots lies in between, however the other is rounded.
        let off = |s: &f64| (s - 0.5).abs();
        let root = roots(c)
            .into_iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)));
        found.push(root.unwrap_or(0.5).clamp(0.0, 1.0));
    } else if first != middle {
        let both = roots(c);
        if both.len() == 2 && both.iter().all(|s| (0.0..=1.0).contains(s)) {
            found.extend(both);
        }
    }
    found
}

/// The roots of a quadratic of these Bernstein coefficients, those that are finite.
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
                let found = ring.crossings(from, to - from);
                assert_eq!(found.len() % 2, 0, "{from} {to} {found:?}");
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
            for (at, (t, piece)) in ring.crossings(origin, dir).iter().enumerate() {
                let normal = ring.normal(*piece, origin + *t * dir);
                assert_eq!(normal.dot(dir) > 0.0, at % 2 == 1, "{at}");
            }
        }
    }
}
