//! The rectangles of parameters into which a parametric surface is cut, and the points over their corners.
//!
//! Which rectangles there are does not depend on the ray. So the points over the corners of the larger ones are worked
//! out once, when the first ray comes; below them each is worked out once for both rectangles that a halving leaves.

use glam::{DVec2, DVec3};

/// Halvings of a rectangle: more than the faces of the surface tell apart.
const MOST_HALVINGS: u32 = 40;
/// Halvings of the rectangles whose corners are worked out beforehand: 33,000 corners, 1 MB.
const HALVINGS_KNOWN: u32 = 15;

/// The points of the surface over the corners of the larger rectangles.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Their parameters.
    u: Vec<f64>,
    v: Vec<f64>,
    /// For each u those of all v.
    points: Vec<DVec3>,
}

/// A rectangle of parameters.
#[derive(Clone, Copy)]
pub(crate) struct Patch {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// The surface over its corners: with the lower u that with the lower and that with the upper v, then with the
    /// upper u.
    pub(crate) corners: [DVec3; 4],
    /// Where it lies in the grid, if all its corners are known there.
    cells: Option<Cells>,
    /// Halvings that it may still take.
    pub(crate) left: u32,
}

/// A rectangle in a grid: the first and the last of its u and of its v.
#[derive(Clone, Copy)]
struct Cells {
    u: (u32, u32),
    v: (u32, u32),
}

impl Grid {
    /// The grid of the surface of these points, whose rectangles are halved until they are smaller than `accuracy`.
    pub(crate) fn new(
        low: DVec2,
        high: DVec2,
        accuracy: f64,
        point: impl Fn(DVec2) -> DVec3,
    ) -> Self {
        // The number of cells along u and v that so many halvings lead to.
        let (mut along_u, mut along_v) = (1, 1);
        let mut size = high - low;
        for _ in 0..HALVINGS_KNOWN {
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
        let places = u.iter().flat_map(|u| v.iter().map(|v| DVec2::new(*u, *v)));
        let points = places.map(point).collect();
        Grid { u, v, points }
    }

    /// The rectangle of some of its cells.
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

    /// The rectangle of all parameters.
    pub(crate) fn whole(&self) -> Patch {
        let last = |list: &[f64]| u32::try_from(list.len() - 1).expect("at most 2^15 cells");
        let cells = Cells {
            u: (0, last(&self.u)),
            v: (0, last(&self.v)),
        };
        self.patch(cells, MOST_HALVINGS)
    }
}

/// The ends of a range and of its halves, of their halves, and so on to as many parts: a power of two.
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
    /// Its halves along its longer side, the lower one first.
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
        let mut known = grid.whole();
        let mut unknown = Patch {
            cells: None,
            ..known
        };
        for round in 0..24 {
            let [a, b] = known.halves(&grid, point);
            let [c, d] = unknown.halves(&grid, point);
            for (a, b) in [(a, c), (b, d)] {
                assert_eq!((a.low, a.high, a.corners), (b.low, b.high, b.corners));
                assert_eq!(a.left, b.left);
                assert_eq!(a.cells.is_some(), round < HALVINGS_KNOWN);
            }
            (known, unknown) = if round % 3 == 0 { (a, c) } else { (b, d) };
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
