//! `tiling`: 23 periodic tilings of the xz plane by convex tiles, most with sides of length 1.
//!
//! Tiles are of some kinds, in an order. With kind `k` of `n` the value is `(k + s) / n`, where `s` is 1 on the sides of a
//! tile and falls to 0 at a depth that is the same for all kinds of a tiling. The tiles, in `tiling.txt`, were worked out
//! from pictures of POV-Ray 3.7. Missing: number 22, and the three after
//! Penrose, which do not repeat.

use crate::base::args::{Args, Parse};
use crate::base::math::rounding::floor;
use crate::base::source::{Code, Diagnostic};
use crate::scene::pattern::{Pattern, PatternEval, Preparing, SurfacePoint};
use glam::{DMat2, DVec2, DVec3};
use std::sync::Arc;

/// Numbers in the file count quarters.
const QUARTER: f64 = 0.25;
/// How many tilings POV-Ray has.
const MOST: u32 = 27;
/// Copies of a tile that are looked at, in both directions of the lattice, to find those that reach into the cell.
const REACH: i32 = 3;

/// The tilings. A block of lines each:
/// * `tiling number, root, kinds, depth`: the root that its coordinates are made of, and twelve times the depth;
/// * `cell` and the two vectors of its lattice;
/// * for each tile of the cell its kind, and its corners anticlockwise.
///
/// A number is two: quarters of one, and quarters of the root. A point or vector is two numbers.
const TABLE: &str = include_str!("../tiling.txt");

/// The tiles that reach into the cell of a tiling.
#[derive(Debug)]
struct Tiling {
    /// From the plane to shares of the vectors of the lattice, and back.
    cell_from_plane: DMat2,
    plane_from_cell: DMat2,
    tiles: Vec<Tile>,
    kinds: f64,
    depth: f64,
}

#[derive(Debug)]
struct Tile {
    kind: f64,
    sides: Vec<Side>,
}

/// A side: points at `normal . p = edge` are on it, those below inside.
#[derive(Debug)]
struct Side {
    normal: DVec2,
    edge: f64,
}

#[derive(Clone, Debug)]
struct Prepared(Arc<Tiling>);

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let at = args.span();
    let given = args.float()?.trunc();
    let at = at.to(args.last_span());
    let number = (1..=MOST).find(|number| f64::from(*number) == given);
    let Some(number) = number else {
        let message = format!("the tilings have the numbers 1 to {MOST}, not {given}");
        return Err(Box::new(Diagnostic::error(at, message)));
    };
    match Tiling::numbered(number) {
        Some(tiling) => Ok(Box::new(Prepared(Arc::new(tiling)))),
        None => {
            let error = Diagnostic::error(at, format!("`tiling {number}` is not built yet"));
            Err(Box::new(error.with_code(Code::NotBuilt)))
        }
    }
}

impl Tiling {
    fn numbered(number: u32) -> Option<Tiling> {
        let mut lines = TABLE.lines();
        let head = lines.by_ref().find_map(|line| {
            let numbers: Vec<f64> = numbers(line.strip_prefix("tiling ")?);
            (numbers.first() == Some(&f64::from(number))).then_some(numbers)
        })?;
        let &[_, root, kinds, whole, roots] = head.as_slice() else {
            return None;
        };
        let root = root.sqrt();
        let cell = points(lines.next()?.strip_prefix("cell ")?, root);
        let &[first, second] = cell.as_slice() else {
            return None;
        };
        let plane_from_cell = DMat2::from_cols(first, second);
        let mut tiling = Tiling {
            cell_from_plane: plane_from_cell.inverse(),
            plane_from_cell,
            tiles: Vec::new(),
            kinds,
            depth: (whole + roots * root) / 12.0,
        };
        for line in lines.take_while(|line| !line.starts_with("tiling")) {
            tiling.add(line, root);
        }
        Some(tiling)
    }

    /// Adds the copies of a tile that reach into the cell.
    fn add(&mut self, line: &str, root: f64) {
        let Some((kind, corners)) = line.split_once(": ") else {
            return;
        };
        let kind = kind.parse().unwrap_or(0.0);
        let corners = points(corners, root);
        for (i, j) in (-REACH..=REACH).flat_map(|i| (-REACH..=REACH).map(move |j| (i, j))) {
            let shift = DVec2::new(f64::from(i), f64::from(j));
            let in_cell = corners
                .iter()
                .map(|corner| self.cell_from_plane * *corner + shift);
            let (low, high) = in_cell.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |box_of, at| {
                (box_of.0.min(at), box_of.1.max(at))
            });
            if low.max_element() > 1.0 || high.min_element() < 0.0 {
                continue;
            }
            let shift = self.plane_from_cell * shift;
            let next = corners.iter().cycle().skip(1);
            let sides = corners.iter().zip(next).map(|(from, to)| {
                let along = (to - from).normalize_or_zero();
                let normal = DVec2::new(along.y, -along.x);
                Side {
                    normal,
                    edge: normal.dot(from + shift),
                }
            });
            self.tiles.push(Tile {
                kind,
                sides: sides.collect(),
            });
        }
    }
}

/// The numbers of a line.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split([' ', ',']);
    words.filter_map(|word| word.parse().ok()).collect()
}

/// The points of a line.
fn points(line: &str, root: f64) -> Vec<DVec2> {
    let point = |of: &[f64]| DVec2::new(of[0] + of[1] * root, of[2] + of[3] * root) * QUARTER;
    numbers(line).chunks_exact(4).map(point).collect()
}

impl Tile {
    /// How far inside a point lies; below 0 outside.
    fn inside(&self, point: DVec2) -> f64 {
        let far = |side: &Side| side.edge - side.normal.dot(point);
        self.sides.iter().map(far).fold(f64::INFINITY, f64::min)
    }
}

impl Pattern for Prepared {
    fn prepare(&self, _with: &Preparing<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let tiling = &*self.0;
        let in_cell = tiling.cell_from_plane * DVec2::new(point.x, point.z);
        let point = tiling.plane_from_cell * (in_cell - in_cell.map(floor));
        // Rounding may leave a point in no tile, or in two.
        let mut best: Option<(f64, &Tile)> = None;
        for tile in &tiling.tiles {
            let inside = tile.inside(point);
            if best.is_none_or(|(most, _)| inside > most) {
                best = Some((inside, tile));
            }
        }
        let Some((inside, tile)) = best else {
            return 0.0;
        };
        let share = (inside / tiling.depth).clamp(0.0, 1.0);
        (tile.kind + 1.0 - share) / tiling.kinds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    fn all() -> impl Iterator<Item = (u32, Tiling)> {
        (1..=24)
            .filter(|number| *number != 22)
            .map(|number| (number, Tiling::numbered(number).expect("it is in the file")))
    }

    #[test]
    fn tiles_fill_the_plane_once() {
        let mut rng = Random::new(3);
        for (number, tiling) in all() {
            for _ in 0..500 {
                let at = tiling.plane_from_cell * DVec2::new(rng.share(), rng.share());
                let inside = |slack: f64| {
                    let tiles = tiling.tiles.iter();
                    tiles.filter(|tile| tile.inside(at) > slack).count()
                };
                assert!(inside(-1e-9) >= 1, "{number}: a hole at {at}");
                assert!(inside(1e-9) <= 1, "{number}: two tiles at {at}");
            }
        }
    }

    #[test]
    fn all_kinds_are_there() {
        for (number, tiling) in all() {
            let mut kinds: Vec<f64> = tiling.tiles.iter().map(|tile| tile.kind).collect();
            kinds.sort_by(f64::total_cmp);
            kinds.dedup();
            let expected: Vec<f64> = (0u32..)
                .map(f64::from)
                .take_while(|k| *k < tiling.kinds)
                .collect();
            assert_eq!(kinds, expected, "{number}");
        }
    }

    #[test]
    fn squares_rise_from_the_middle_to_their_sides() {
        let squares = Prepared(Arc::new(Tiling::numbered(1).expect("it is in the file")));
        let spot = SurfacePoint::at(DVec3::ZERO);
        let value = |x, z| squares.value(DVec3::new(x, 7.0, z), &spot);
        assert_eq!((value(0.5, -2.5), value(3.0, 0.4)), (0.0, 1.0));
        assert_eq!(value(0.25, 0.5), 0.5);
    }
}
