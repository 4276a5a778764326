//! Subdivision of the parameter rectangle of a parametric surface, and the surface points over the corners.
//!
//! The subdivision does not depend on the ray. So the points over the corners of the larger rectangles, and the ranges
//! of the coordinates over them, are computed once, for the first ray; below them each point is computed once for both
//! halves.

use glam::{DVec2, DVec3};

/// Maximum depth of subdivision: more than the face numbers distinguish.
const MAX_HALVINGS: u32 = 40;
/// Depth of subdivision with precomputed corners: 33,000 corners, 1 MB, and 65,000 ranges, 3 MB.
const PRECOMPUTED_HALVINGS: u32 = 15;

/// Surface points over the corners of the larger rectangles, and the ranges over these.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Their parameters.
    u: Vec<f64>,
    v: Vec<f64>,
    /// Row-major: for each u the points of all v.
    points: Vec<DVec3>,
    /// By the number of the rectangle.
    ranges: Vec<Ranges>,
}

/// Where the coordinates of the surface over a rectangle may lie. NaN where they are not known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ranges {
    pub(crate) least: [f64; 3],
    pub(crate) most: [f64; 3],
}

/// A parameter rectangle and the surface over it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// Surface points over the corners: (low u, low v), (low u, high v), (high u, low v), (high u, high v).
    pub(crate) corners: [DVec3; 4],
    /// The number of the rectangle: 1 for the whole; the halves of `n` are `2n` and `2n + 1`.
    pub(crate) number: u64,
}

/// A rectangle of a grid: the first and the last index in u and in v.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells {
    u: (u32, u32),
    v: (u32, u32),
    number: u32,
}

impl Grid {
    /// Grid of the surface `point`, whose rectangles are halved until they are smaller than `accuracy`. It has no
    /// ranges yet.
    pub(crate) fn new(
        low: DVec2,
        high: DVec2,
        accuracy: f64,
        point: impl Fn(DVec2) -> DVec3,
    ) -> Self {
        // Number of cells along u and v at that depth.
        let (mut along_u, mut along_v) = (1, 1);
        let mut size = high - low;
        for _ in 0..PRECOMPUTED_HALVINGS {
            if size.max_element() < accuracy {
                break;
            }
            if size.y > size.x {
                size.y *= 0.5;
                along_v *= 2;
            } else {
                size.x *= 0.5;
                along_u *= 2;
            }
        }
        let u = halved(low.x, high.x, along_u);
        let v = halved(low.y, high.y, along_v);
        let params = u.iter().flat_map(|u| v.iter().map(|v| DVec2::new(*u, *v)));
        let points = params.map(point).collect();
        let ranges = Vec::new();
        Grid {
            u,
            v,
            points,
            ranges,
        }
    }

    /// Stores the ranges of all its rectangles, and of all of up to `halvings`. `ranges` takes a rectangle, and the
    /// ranges of its halves where they are stored too.
    pub(crate) fn store_ranges(
        &mut self,
        halvings: u32,
        point: impl Fn(DVec2) -> DVec3,
        ranges: impl Fn(&Patch, Option<[&Ranges; 2]>) -> Ranges,
    ) {
        let cells = (self.u.len() - 1) * (self.v.len() - 1);
        let count = 2 * cells.max(1 << halvings);
        let unknown = Ranges {
            least: [f64::NAN; 3],
            most: [f64::NAN; 3],
        };
        let mut stored = vec![unknown; count];
        self.fill(
            &mut stored,
            self.patch(self.whole()),
            Some(self.whole()),
            &point,
            &ranges,
        );
        self.ranges = stored;
    }

    fn fill(
        &self,
        stored: &mut [Ranges],
        patch: Patch,
        cells: Option<Cells>,
        point: &impl Fn(DVec2) -> DVec3,
        ranges: &impl Fn(&Patch, Option<[&Ranges; 2]>) -> Ranges,
    ) {
        let index = |number: u64| usize::try_from(number).expect("fewer than are stored");
        let lower = index(2 * patch.number);
        let has_halves = lower < stored.len();
        if has_halves {
            let halves = cells.and_then(|cells| self.halves(cells));
            if let Some(halves) = halves {
                for half in halves {
                    self.fill(stored, self.patch(half), Some(half), point, ranges);
                }
            } else {
                for half in patch.halves(point) {
                    self.fill(stored, half, None, point, ranges);
                }
            }
        }
        let halves = has_halves.then(|| [&stored[lower], &stored[lower + 1]]);
        stored[index(patch.number)] = ranges(&patch, halves);
    }

    /// The ranges over a rectangle, if they are stored.
    #[inline]
    pub(crate) fn ranges_of(&self, number: u64) -> Option<&Ranges> {
        self.ranges.get(usize::try_from(number).ok()?)
    }

    /// The ranges over some cells.
    #[inline]
    pub(crate) fn ranges(&self, cells: Cells) -> &Ranges {
        &self.ranges[cells.number as usize]
    }

    /// Patch over some cells.
    pub(crate) fn patch(&self, cells: Cells) -> Patch {
        let Cells { u, v, number } = cells;
        let point = |u: u32, v: u32| self.points[u as usize * self.v.len() + v as usize];
        let [low, high] = self.limits(cells);
        Patch {
            low,
            high,
            corners: [
                point(u.0, v.0),
                point(u.0, v.1),
                point(u.1, v.0),
                point(u.1, v.1),
            ],
            number: u64::from(number),
        }
    }

    /// The least and the largest parameters of some cells.
    #[inline]
    pub(crate) fn limits(&self, cells: Cells) -> [DVec2; 2] {
        let at = |u: u32, v: u32| DVec2::new(self.u[u as usize], self.v[v as usize]);
        [at(cells.u.0, cells.v.0), at(cells.u.1, cells.v.1)]
    }

    /// All cells.
    pub(crate) fn whole(&self) -> Cells {
        let last = |list: &[f64]| u32::try_from(list.len() - 1).expect("at most 2^15 cells");
        Cells {
            u: (0, last(&self.u)),
            v: (0, last(&self.v)),
            number: 1,
        }
    }

    /// Splits cells along the longer side, the lower half first; `None` where there is only one on that side.
    #[inline]
    pub(crate) fn halves(&self, cells: Cells) -> Option<[Cells; 2]> {
        let [low, high] = self.limits(cells);
        let size = high - low;
        let is_along_v = size.y > size.x;
        let (first, last) = if is_along_v { cells.v } else { cells.u };
        if last - first <= 1 {
            return None;
        }
        let middle = first.midpoint(last);
        let number = 2 * cells.number;
        let half = |range, number| match is_along_v {
            true => Cells {
                v: range,
                number,
                ..cells
            },
            false => Cells {
                u: range,
                number,
                ..cells
            },
        };
        Some([
            half((first, middle), number),
            half((middle, last), number + 1),
        ])
    }
}

/// Ends of `parts` equal parts of a range, by repeated halving; `parts` is a power of two.
fn halved(low: f64, high: f64, parts: usize) -> Vec<f64> {
    let mut ends = vec![low; parts + 1];
    ends[parts] = high;
    let mut part = parts;
    while part > 1 {
        for first in (0..parts).step_by(part) {
            ends[first + part / 2] = 0.5 * (ends[first] + ends[first + part]);
        }
        part /= 2;
    }
    ends
}

impl Patch {
    /// Number of halvings of the whole that lead to it.
    pub(crate) fn depth(&self) -> u32 {
        self.number.ilog2()
    }

    /// True if it is not to be halved any more.
    pub(crate) fn is_last(&self) -> bool {
        self.depth() >= MAX_HALVINGS
    }

    /// Splits along the longer side, the lower half first.
    pub(crate) fn halves(&self, point: impl Fn(DVec2) -> DVec3) -> [Patch; 2] {
        let &Patch {
            low,
            high,
            corners: [a, b, c, d],
            number,
        } = self;
        let size = high - low;
        let middle = 0.5 * (low + high);
        let half = |low, high, corners, number| Patch {
            low,
            high,
            corners,
            number,
        };
        let numbers = [2 * number, 2 * number + 1];
        if size.y > size.x {
            let (e, f) = (point(low.with_y(middle.y)), point(high.with_y(middle.y)));
            [
                half(low, high.with_y(middle.y), [a, e, c, f], numbers[0]),
                half(low.with_y(middle.y), high, [e, b, f, d], numbers[1]),
            ]
        } else {
            let (e, f) = (point(low.with_x(middle.x)), point(high.with_x(middle.x)));
            [
                half(low, high.with_x(middle.x), [a, b, e, f], numbers[0]),
                half(low.with_x(middle.x), high, [e, f, c, d], numbers[1]),
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_of_the_grid_are_those_without_it() {
        let point = |at: DVec2| DVec3::new(at.x.sin(), at.y.cos(), at.x * at.y);
        let (low, high) = (DVec2::new(-1.0, 0.3), DVec2::new(2.0, 7.1));
        let grid = Grid::new(low, high, 1e-3, point);
        let mut cells = grid.whole();
        let mut without_grid = grid.patch(cells);
        for round in 0..PRECOMPUTED_HALVINGS {
            let [a, b] = grid.halves(cells).unwrap();
            let [c, d] = without_grid.halves(point);
            for (a, b) in [(grid.patch(a), c), (grid.patch(b), d)] {
                assert_eq!((a.low, a.high, a.corners), (b.low, b.high, b.corners));
                assert_eq!(a.number, b.number);
            }
            (cells, without_grid) = if round % 3 == 0 { (a, c) } else { (b, d) };
        }
        assert!(grid.halves(cells).is_none());
    }

    #[test]
    fn a_range_that_no_halving_falls_to_is_one_cell() {
        let point = |at: DVec2| at.extend(0.0);
        for (high, accuracy) in [
            (DVec2::new(0.0, 2.0), 1e-3),
            (DVec2::new(2.0, 0.0), 1e-3),
            (DVec2::new(1.0, 6.0), 9.0),
            (DVec2::new(9e-4, 6.0), 1e-3),
            (DVec2::ZERO, 1e-3),
        ] {
            let grid = Grid::new(DVec2::ZERO, high, accuracy, point);
            let whole = grid.patch(grid.whole());
            assert_eq!((whole.low, whole.high), (DVec2::ZERO, high));
            assert_eq!(whole.corners[3], point(high));
        }
    }

    #[test]
    fn a_coarse_surface_has_a_small_grid() {
        let grid = Grid::new(DVec2::ZERO, DVec2::ONE, 0.3, |_| DVec3::ZERO);
        assert_eq!((grid.u.len(), grid.v.len(), grid.points.len()), (5, 5, 25));
    }

    #[test]
    fn ranges_are_stored_deeper_than_the_grid() {
        let point = |at: DVec2| at.extend(0.0);
        let mut grid = Grid::new(DVec2::ZERO, DVec2::ONE, 0.3, point);
        let corners_alone = |patch: &Patch, halves: Option<[&Ranges; 2]>| {
            assert_eq!(halves.is_some(), patch.depth() < 6);
            Ranges {
                least: patch.corners[0].to_array(),
                most: patch.corners[3].to_array(),
            }
        };
        grid.store_ranges(6, point, corners_alone);
        let last = grid.ranges_of(127).unwrap();
        assert_eq!((last.least[0], last.most[1]), (0.875, 1.0));
        assert!(grid.ranges_of(128).is_none());
    }
}
