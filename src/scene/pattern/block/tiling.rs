//! `tiling`: 23 periodic tilings of the xz plane by convex tiles, most with sides of length 1.
//!
//! A tiling has `n` kinds of tiles. In a tile of kind `k` the value is `(k + s) / n`, where `s` is 1 on the sides of
//! the tile and falls to 0 at a depth that is the same for all kinds of the tiling. The tiles, in `tiling.txt`, were
//! derived from images rendered by POV-Ray 3.7. Number 22 ([`super::dodecagons`]) has sides of two slopes, and
//! numbers 25 to 27 ([`super::penrose`]) are not periodic.

use super::dodecagons::Dodecagons;
use super::pavement::read_byte;
use super::penrose::Penrose;
use crate::base::args::{Args, Parse};
use crate::base::math::rounding::floor;
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::{DMat2, DVec2, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// The unit of numbers in the file.
const QUARTER: f64 = 0.25;
/// Number of tilings in POV-Ray.
const COUNT: u32 = 27;
/// The distance within which a point is on a side: a rounding. Points of a face on a side may be farther from it, and belong
/// to the tile that they are in.
const ON_SIDE: f64 = 4e-16;
/// The distance from the lattice cell, in steps, within which tiles touch it.
const TOUCHING: f64 = 1e-9;
/// The tilings whose sides belong to the tile of the higher kind. Those of the others belong to the tile at larger x and
/// z, but for the lines of [`Tiling::on_line`].
const TIES_BY_KIND: [u32; 5] = [8, 16, 17, 23, 24];
/// Largest number of lattice steps to copies of a tile that may overlap the cell.
const MAX_STEPS: i32 = 3;

/// The tilings, each a block of lines:
/// * `tiling number, root, kinds, depth`: the radicand of the square root in its coordinates, the number of kinds, and
///   twelve times the depth;
/// * `cell` and the two lattice vectors;
/// * for each tile of the cell its kind and its corners, anticlockwise.
///
/// A coordinate is a pair: quarters of one and quarters of the root. A point or vector is two coordinates; the depth is
/// a pair of its own, in whole numbers.
const TABLE: &str = include_str!("../tiling.txt");

/// A tiling: all tiles that overlap or touch the lattice cell.
#[derive(Debug)]
struct Tiling {
    number: u32,
    /// Transform from the plane to lattice coordinates.
    cell_from_plane: DMat2,
    /// The inverse.
    plane_from_cell: DMat2,
    tiles: Vec<Tile>,
    kinds: f64,
    depth: f64,
    ties_by_kind: bool,
}

#[derive(Debug)]
struct Tile {
    kind: f64,
    sides: Vec<Side>,
}

/// A side of a tile: the line `normal . p = edge`. The inside is at lower values.
#[derive(Debug)]
struct Side {
    normal: DVec2,
    edge: f64,
}

#[derive(Clone, Debug)]
struct Prepared(Arc<Tiling>);

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let at = args.span();
    let number = u32::from(read_byte(args)?);
    let at = at.to(args.last_span());
    if !(1..=COUNT).contains(&number) {
        let message = format!("the tilings have the numbers 1 to {COUNT}, not {number}");
        return Err(Box::new(Diagnostic::error(at, message)));
    }
    Ok(match (number, Tiling::numbered(number)) {
        (_, Some(tiling)) => Box::new(Prepared(Arc::new(tiling))),
        (22, None) => Box::new(Dodecagons),
        (25, None) => Box::new(Penrose::Pentagons),
        (26, None) => Box::new(Penrose::KitesAndDarts),
        (_, None) => Box::new(Penrose::Rhombs),
    })
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
            number,
            cell_from_plane: plane_from_cell.inverse(),
            plane_from_cell,
            tiles: Vec::new(),
            kinds,
            depth: (whole + roots * root) / 12.0,
            ties_by_kind: TIES_BY_KIND.contains(&number),
        };
        for line in lines.take_while(|line| !line.starts_with("tiling")) {
            tiling.add(line, root);
        }
        Some(tiling)
    }

    /// The value on lines where POV-Ray's is that of no tile beside them, or of the one at smaller z (measured along the
    /// lines). On some it exceeds 1 and wraps round.
    fn on_line(&self, point: DVec3) -> Option<f64> {
        let (has_zero_x, has_zero_z) = (is_zero(point.x), is_zero(point.z));
        match self.number {
            12 if has_zero_x || has_zero_z => Some(1.0 / 3.0),
            13 | 14 if has_zero_z => Some(0.0),
            13 if has_zero_x => Some(match (FRAC_1_SQRT_2 * point.z).rem_euclid(2.0) {
                share @ 0.5..=1.5 => (4.0 - 4.0 * (share - 1.0).abs()) / 3.0 % 1.0,
                _ => 0.0,
            }),
            14 if has_zero_x => Some(match (FRAC_1_SQRT_2 * point.z).rem_euclid(2.0) {
                share @ 0.5..1.0 => 0.2 + 0.8 * share,
                share @ 1.0..=1.5 => (2.0 - 0.8 * share) % 1.0,
                _ => 0.0,
            }),
            19 if has_zero_z => {
                let along = point.x.rem_euclid(7.0);
                let is_behind = (2.5..3.0).contains(&along) || (4.0..5.0).contains(&along);
                is_behind.then_some(2.0 / 3.0)
            }
            _ => None,
        }
    }

    /// Adds the copies of a tile that overlap or touch the cell.
    fn add(&mut self, line: &str, root: f64) {
        let Some((kind, corners)) = line.split_once(": ") else {
            return;
        };
        let kind = kind.parse().unwrap_or(0.0);
        let corners = points(corners, root);
        for (i, j) in
            (-MAX_STEPS..=MAX_STEPS).flat_map(|i| (-MAX_STEPS..=MAX_STEPS).map(move |j| (i, j)))
        {
            let shift = DVec2::new(f64::from(i), f64::from(j));
            let in_cell = corners
                .iter()
                .map(|corner| self.cell_from_plane * *corner + shift);
            let (low, high) = in_cell.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |bounds, at| {
                (bounds.0.min(at), bounds.1.max(at))
            });
            if low.max_element() > 1.0 + TOUCHING || high.min_element() < -TOUCHING {
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

/// True for zero, and for what is so little below that its distance from the whole number below rounds to 1.
fn is_zero(coordinate: f64) -> bool {
    coordinate == 0.0 || coordinate - floor(coordinate) == 1.0
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
    /// Distance of an inner point from the nearest side; negative outside.
    fn depth_at(&self, point: DVec2) -> f64 {
        let distance = |side: &Side| side.edge - side.normal.dot(point);
        self.sides
            .iter()
            .map(distance)
            .fold(f64::INFINITY, f64::min)
    }
}

impl Pattern for Prepared {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let tiling = &*self.0;
        if let Some(value) = tiling.on_line(point) {
            return value;
        }
        let is_swapped = tiling.number == 3 && point.x == floor(point.x);
        let in_cell = tiling.cell_from_plane * DVec2::new(point.x, point.z);
        let point = tiling.plane_from_cell * (in_cell - in_cell.map(floor));
        // Rounding may leave a point in no tile, or in two.
        let mut best: Option<(f64, &Tile)> = None;
        for tile in &tiling.tiles {
            let depth = match tiling.ties_by_kind {
                true => tile.depth_at(point) + ON_SIDE * tile.kind,
                false => tile.depth_at(point + ON_SIDE * DVec2::new(0.8, 0.5)),
            };
            if best.is_none_or(|(deepest, _)| depth > deepest) {
                best = Some((depth, tile));
            }
        }
        let Some((_, tile)) = best else {
            return 0.0;
        };
        let fraction = (tile.depth_at(point) / tiling.depth).clamp(0.0, 1.0);
        let kind = match is_swapped {
            true => 1.0 - tile.kind,
            false => tile.kind,
        };
        (kind + 1.0 - fraction) / tiling.kinds
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
    fn tiles_cover_the_plane_without_overlap() {
        let mut rng = Random::new(3);
        for (number, tiling) in all() {
            for _ in 0..500 {
                let at = tiling.plane_from_cell * DVec2::new(rng.uniform(), rng.uniform());
                let inside = |slack: f64| {
                    let tiles = tiling.tiles.iter();
                    tiles.filter(|tile| tile.depth_at(at) > slack).count()
                };
                assert!(inside(-1e-9) >= 1, "{number}: a hole at {at}");
                assert!(inside(1e-9) <= 1, "{number}: two tiles at {at}");
            }
        }
    }

    #[test]
    fn all_kinds_are_in_the_table() {
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
    fn sides_belong_to_the_tile_at_larger_coordinates_or_of_the_higher_kind() {
        let bricks = Prepared(Arc::new(Tiling::numbered(6).expect("it is in the file")));
        let spot = SurfacePoint::at(DVec3::ZERO);
        let value = |x, z| bricks.value(DVec3::new(x, 0.0, z), &spot);
        for along in [0.137, 0.868] {
            assert_eq!(value(along, 0.0), value(along, 1e-9).round());
            assert_eq!(value(0.0, along), value(1e-9, along).round());
        }
        let triangles = Prepared(Arc::new(Tiling::numbered(8).expect("it is in the file")));
        assert_eq!(triangles.value(DVec3::new(0.3, 0.0, 0.0), &spot), 1.0);
    }

    #[test]
    fn some_lines_have_values_of_their_own() {
        for (number, x, z, expected) in [
            (12, 0.0, 1.3, 0.3333),
            (12, 0.7, 0.0, 0.3333),
            (13, 0.7, 0.0, 0.0),
            (13, 0.0, 1.3872, 0.3079),
            (13, 0.0, -4.4128, 0.1729),
            (13, 0.0, 0.2, 0.0),
            (14, 0.0, -2.0128, 0.6614),
            (14, 0.0, -1.2128, 0.0861),
            (19, 2.6872, 0.0, 0.6667),
            (19, 0.6872, 0.0, 0.3333),
            (3, 1.0, -4.0427, 0.5022),
        ] {
            let tiling = Prepared(Arc::new(
                Tiling::numbered(number).expect("it is in the file"),
            ));
            let value = tiling.value(DVec3::new(x, 0.0, z), &SurfacePoint::at(DVec3::ZERO));
            assert!((value - expected).abs() < 1e-4, "{number} {x} {z}: {value}");
        }
    }

    #[test]
    fn squares_rise_from_the_centre_to_their_sides() {
        let squares = Prepared(Arc::new(Tiling::numbered(1).expect("it is in the file")));
        let spot = SurfacePoint::at(DVec3::ZERO);
        let value = |x, z| squares.value(DVec3::new(x, 7.0, z), &spot);
        assert_eq!((value(0.5, -2.5), value(3.0, 0.4)), (0.0, 1.0));
        assert_eq!(value(0.25, 0.5), 0.5);
    }
}
