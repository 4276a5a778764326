//! Subdivision of the parameter rectangle of a parametric surface, and the surface points over the corners.
//!
//! The subdivision does not depend on the ray. So the points over the corners of the larger rectangles are computed
//! once, for the first ray; below them each point is computed once for both halves.

use glam::{DVec2, DVec3};

/// Maximum depth of subdivision: more than the face numbers distinguish.
const MAX_HALVINGS: u32 = 40;
/// Depth of subdivision with precomputed corners: 33,000 corners, 1 MB.
const PRECOMPUTED_HALVINGS: u32 = 15;

/// Surface points over the corners of the larger rectangles.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Their parameters.
    u: Vec<f64>,
    v: Vec<f64>,
    /// Row-major: for each u the points of all v.
    points: Vec<DVec3>,
}

/// A parameter rectangle and the surface over it.
#[derive(Clone, Copy)]
pub(crate) struct Patch {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// Surface points over the corners: (low u, low v), (low u, high v), (high u, low v), (high u, high v).
    pub(crate) corners: [DVec3; 4],
    /// Its cells in the grid, if all its corners are precomputed.
    cells: Option<Cells>,
    /// Remaining depth of subdivision.
    pub(crate) left: u32,
}

/// A rectangle of a grid: the first and the last index in u and in v.
#[derive(Clone, Copy)]
struct Cells {
    u: (u32, u32),
    v: (u32, u32),
}

impl Grid {
    /// Grid of the surface `point`, whose rectangles are halved until they are smaller than `accuracy`.
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
        Grid { u, v, points }
    }

    /// Patch over some cells.
    fn patch(&self, cells: Cells, left: u32) -> Patch {
        let Cells { u, v } = cells;
        let point = |u: u32, v: u32| self.points[u as usize * self.v.len() + v as usize];
        let at = |u: u32, v: u32| DVec2::new(self.u[u as usize], self.v[v as usize]);
        Patch {
            low: at(u.0, v.0),
            high: at(u.1, v.1),
            corners: [
                point(u.0, v.0),
                point(u.0, v.1),
                point(u.1, v.0),
                point(u.1, v.1),
            ],
            cells: Some(cells),
            left,
        }
    }

    /// Patch over all parameters.
    pub(crate) fn whole(&self) -> Patch {
        let last = |list: &[f64]| u32::try_from(list.len() - 1).expect("at most 2^15 cells");
        let cells = Cells {
            u: (0, last(&self.u)),
            v: (0, last(&self.v)),
        };
        self.patch(cells, MAX_HALVINGS)
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
    /// Splits along the longer side, the lower half first.
    pub(crate) fn halves(&self, grid: &Grid, point: impl Fn(DVec2) -> DVec3) -> [Patch; 2] {
        let &Patch {
            low, high, corners, ..
        } = self;
        let size = high - low;
        let is_along_v = size.y > size.x;
        let left = self.left - 1;
        if let Some(cells) = self.cells {
            let (first, last) = if is_along_v { cells.v } else { cells.u };
            if last - first > 1 {
                let middle = first.midpoint(last);
                return [(first, middle), (middle, last)].map(|range| {
                    let cells = match is_along_v {
                        true => Cells { v: range, ..cells },
                        false => Cells { u: range, ..cells },
                    };
                    grid.patch(cells, left)
                });
            }
        }
        let middle = 0.5 * (low + high);
        let [a, b, c, d] = corners;
        let half = |low, high, corners| Patch {
            low,
            high,
            corners,
            cells: None,
            left,
        };
        if is_along_v {
            let (e, f) = (point(low.with_y(middle.y)), point(high.with_y(middle.y)));
            [
                half(low, high.with_y(middle.y), [a, e, c, f]),
                half(low.with_y(middle.y), high, [e, b, f, d]),
            ]
        } else {
            let (e, f) = (point(low.with_x(middle.x)), point(high.with_x(middle.x)));
            [
                half(low, high.with_x(middle.x), [a, b, e, f]),
                half(low.with_x(middle.x), high, [e, f, c, d]),
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
        let mut with_grid = grid.whole();
        let mut without_grid = Patch {
            cells: None,
            ..with_grid
        };
        for round in 0..24 {
            let [a, b] = with_grid.halves(&grid, point);
            let [c, d] = without_grid.halves(&grid, point);
            for (a, b) in [(a, c), (b, d)] {
                assert_eq!((a.low, a.high, a.corners), (b.low, b.high, b.corners));
                assert_eq!(a.left, b.left);
                assert_eq!(a.cells.is_some(), round < PRECOMPUTED_HALVINGS);
            }
            (with_grid, without_grid) = if round % 3 == 0 { (a, c) } else { (b, d) };
        }
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
            let whole = Grid::new(DVec2::ZERO, high, accuracy, point).whole();
            assert_eq!((whole.low, whole.high), (DVec2::ZERO, high));
            assert_eq!(whole.corners[3], point(high));
        }
    }

    #[test]
    fn a_coarse_surface_has_a_small_grid() {
        let grid = Grid::new(DVec2::ZERO, DVec2::ONE, 0.3, |_| DVec3::ZERO);
        assert_eq!((grid.u.len(), grid.v.len(), grid.points.len()), (5, 5, 25));
    }
}
