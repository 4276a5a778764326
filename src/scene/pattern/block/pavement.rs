//! `pavement`: tilings of the xz plane by polyiamonds, polyominoes and polyhexes of up to six cells.
//!
//! The plane is cut into unit squares, or into triangles of side 1, and walls stand where two cells belong to different
//! tiles. The value is 1 at a wall and falls to 0 in the middle of the tile. `pavement.txt` lists the walls of each
//! tiling; they were measured with POV-Ray 3.7.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::rounding::floor;
use crate::base::source::{Diagnostic, Span};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::{DVec2, DVec3};

/// The tilings, one a line: `sides tiles pattern columns shift rows walls`. Cells repeat under `(columns, 0)` and
/// `(shift, rows)`; `walls` has a hexadecimal digit for each column of a row, and rows separated by `/`.
///
/// The bits of a digit, from the lowest: the sides towards +z, +x, -z and -x of a square; the left, the right and the
/// lower side of a triangle, one that points down being turned by half a turn.
const TABLE: &str = include_str!("../pavement.txt");

const ROOT: f64 = 1.732_050_807_568_877_2;
/// Height of a triangle of side 1.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

/// The parameters, each reduced modulo 256 as in POV-Ray.
#[derive(Clone, Copy, Debug)]
struct Pavement {
    sides: u8,
    tiles: u8,
    number: u8,
    exterior: u8,
    interior: u8,
    form: u8,
    /// The parameter read last.
    at: Option<Span>,
}

/// The sides of a cell, and its corners that need a rounding of their own.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Mask of the sides that are walls.
    walls: u8,
    /// Mask of the corners where the tile is concave: both sides are open there, but a wall ends.
    concave: u8,
    /// Mask of the corners of triangles around which the tile covers two cells.
    obtuse: u8,
}

/// The cells of a tiling, up to its translations.
#[derive(Debug)]
struct Lattice {
    columns: i64,
    shift: i64,
    rows: Vec<Vec<Cell>>,
}

/// A corner of a square: signs of x and z.
type Corner = (bool, bool);

/// The corners of a square, clockwise from the one at low x and high z. Corner `i` lies between side `i` (its
/// successor clockwise, see [`TABLE`]) and side `i - 1`.
const CORNERS: [Corner; 4] = [(false, true), (true, true), (true, false), (false, false)];
/// The steps to the cells behind the sides of a square.
const STEPS: [(i64, i64); 4] = [(0, 1), (1, 0), (0, -1), (-1, 0)];

/// The corners of a triangle, each between two sides.
const APEX: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;
const SIDES_AT: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];
/// The corners at the ends of the sides of a triangle.
const ENDS_OF: [[usize; 2]; 3] = [[LEFT, APEX], [RIGHT, APEX], [LEFT, RIGHT]];

#[derive(Debug)]
struct Prepared {
    of: Pavement,
    lattice: Lattice,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Pavement {
        sides: 3,
        tiles: 1,
        number: 1,
        exterior: 0,
        interior: 0,
        form: 0,
        at: None,
    }))
}

/// Reads a number as POV-Ray stores it: the whole part modulo 256.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "in the range of a byte"
)]
pub(super) fn read_byte(args: &mut dyn Args) -> Parse<u8> {
    Ok(args.float()?.trunc().rem_euclid(256.0) as u8)
}

impl Pattern for Pavement {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(Prepared {
            of: *self,
            lattice: Lattice::of(self),
        })
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let value = match word {
            Word::NumberOfSides => &mut self.sides,
            Word::NumberOfTiles => &mut self.tiles,
            Word::Pattern => &mut self.number,
            Word::Exterior => &mut self.exterior,
            Word::Interior => &mut self.interior,
            Word::Form => &mut self.form,
            _ => return Ok(false),
        };
        args.accept(word)?;
        let start = args.last_span();
        *value = read_byte(args)?;
        self.at = Some(start.to(args.last_span()));
        Ok(true)
    }

    fn check(&self, args: &dyn Args) -> Parse<()> {
        let of_sides = |line: &&[&str; 7]| line[0] == self.sides.to_string();
        let of_tiles = |line: &&[&str; 7]| of_sides(line) && line[1] == self.tiles.to_string();
        let lines: Vec<_> = lines().collect();
        let message = if !lines.iter().any(|line| of_sides(&line)) {
            format!("`number_of_sides` is 3, 4 or 6, found {}", self.sides)
        } else if !lines.iter().any(|line| of_tiles(&line)) {
            let most = if self.sides == 6 { 5 } else { 6 };
            format!("`number_of_tiles` is 1 to {most}, found {}", self.tiles)
        } else {
            let most = lines.iter().filter(of_tiles).count();
            if (1..=most).contains(&usize::from(self.number)) {
                return Ok(());
            }
            let Pavement {
                sides,
                tiles,
                number,
                ..
            } = self;
            format!("`pattern` of {tiles} tiles with {sides} sides is 1 to {most}, found {number}")
        };
        let at = self.at.unwrap_or_else(|| args.last_span());
        Err(Box::new(Diagnostic::error(at, message)))
    }
}

/// The fields of the lines of the table.
fn lines() -> impl Iterator<Item = [&'static str; 7]> {
    TABLE.lines().filter_map(|line| {
        let fields: Vec<&str> = line.split(' ').collect();
        fields.try_into().ok()
    })
}

impl Lattice {
    fn of(pavement: &Pavement) -> Lattice {
        let key = [pavement.sides, pavement.tiles, pavement.number].map(|part| part.to_string());
        let mut lattice = Lattice {
            columns: 1,
            shift: 0,
            rows: vec![vec![Cell::default()]],
        };
        if let Some(line) = lines().find(|line| line[..3] == key) {
            let number = |text: &str| text.parse().unwrap_or(1);
            (lattice.columns, lattice.shift) = (number(line[3]), number(line[4]));
            let cell = |digit: char| Cell {
                walls: digit
                    .to_digit(16)
                    .and_then(|bits| u8::try_from(bits).ok())
                    .unwrap_or(0),
                ..Cell::default()
            };
            let rows = line[6]
                .split('/')
                .map(|row| row.chars().map(cell).collect());
            lattice.rows = rows.collect();
        }
        lattice.mark(pavement.sides);
        lattice
    }

    /// Index of a cell in its row, and of the row.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "the remainder of a small number"
    )]
    fn index(&self, column: i64, row: i64) -> (usize, usize) {
        let count = self.rows.len() as i64;
        let steps = row.div_euclid(count);
        let column = column.wrapping_sub(self.shift.wrapping_mul(steps));
        (
            column.rem_euclid(self.columns) as usize,
            row.rem_euclid(count) as usize,
        )
    }

    fn cell(&self, column: i64, row: i64) -> Cell {
        let (column, row) = self.index(column, row);
        self.rows
            .get(row)
            .and_then(|row| row.get(column))
            .copied()
            .unwrap_or_default()
    }

    fn has_wall(&self, (column, row): (i64, i64), side: usize) -> bool {
        self.cell(column, row).walls >> side & 1 == 1
    }

    /// Sets the marks of all corners.
    fn mark(&mut self, sides: u8) {
        let mut marked = self.rows.clone();
        for (row, cells) in (0..).zip(&mut marked) {
            for (column, cell) in (0..).zip(cells) {
                if sides == 4 {
                    cell.concave = self.concave_corners_of_square((column, row));
                } else {
                    (cell.concave, cell.obtuse) = self.corners_of_triangle((column, row));
                }
            }
        }
        self.rows = marked;
    }

    fn concave_corners_of_square(&self, cell: (i64, i64)) -> u8 {
        let beyond = |side: usize| (cell.0 + STEPS[side].0, cell.1 + STEPS[side].1);
        (0..4).fold(0, |corners, corner| {
            let (first, second) = (corner, (corner + 3) % 4);
            let is_open = !self.has_wall(cell, first) && !self.has_wall(cell, second);
            let ends = self.has_wall(beyond(first), second) || self.has_wall(beyond(second), first);
            corners | u8::from(is_open && ends) << corner
        })
    }

    fn corners_of_triangle(&self, cell: (i64, i64)) -> (u8, u8) {
        (0..3).fold((0, 0), |(concave, obtuse), corner| {
            let [first, second] = SIDES_AT[corner];
            let around = self.borders_around(cell, corner, first);
            let is_open = !around[0] && !self.has_wall(cell, second);
            let after = around.iter().take_while(|is_wall| !**is_wall).count();
            let before = around.iter().rev().take_while(|is_wall| !**is_wall).count();
            (
                concave | u8::from(is_open && after < 6) << corner,
                obtuse | u8::from(after + before == 1) << corner,
            )
        })
    }

    /// Returns true for each of the six borders around a corner of a triangle that is a wall, from this side on.
    fn borders_around(&self, cell: (i64, i64), corner: usize, side: usize) -> [bool; 6] {
        let (mut cell, mut corner, mut side) = (cell, corner, side);
        [(); 6].map(|()| {
            let is_wall = self.has_wall(cell, side);
            let (column, row) = cell;
            let step = if (column - row) % 2 == 0 { 1 } else { -1 };
            cell = match side {
                0 => (column - step, row),
                1 => (column + step, row),
                _ => (column, row - step),
            };
            // The cell behind is turned, which exchanges the ends of the side.
            let [a, b] = ENDS_OF[side];
            corner = if corner == a { b } else { a };
            let [c, d] = SIDES_AT[corner];
            side = if side == c { d } else { c };
            is_wall
        })
    }
}

fn has(mask: u8, bit: usize) -> bool {
    mask >> bit & 1 == 1
}

/// The column or row of a coordinate; far out it saturates.
#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
fn whole(coordinate: f64) -> i64 {
    floor(coordinate) as i64
}

impl Prepared {
    /// The value at a point of a square, relative to its corner.
    fn in_square(&self, cell: Cell, p: DVec2) -> f64 {
        let (x, z) = (2.0 * p.x, 2.0 * p.y);
        // Doubled distances from a corner along the axes.
        let from = |(is_right, is_up): Corner| {
            (
                if is_right { 2.0 - x } else { x },
                if is_up { 2.0 - z } else { z },
            )
        };
        let length = |(u, v): (f64, f64)| (u * u + v * v).sqrt();
        let opposite =
            |corner: usize| has(cell.walls, (corner + 1) % 4) && has(cell.walls, (corner + 2) % 4);
        let elbow = (0..4).find(|&corner| has(cell.concave, corner) && opposite(corner));
        if let Some(corner) = elbow {
            let (u, v) = from(CORNERS[corner]);
            match self.of.form {
                0 => return (u - 1.0).max(v - 1.0).max((1.0 - u).min(1.0 - v)),
                1 => return (u + v - 1.0).abs().min(1.0),
                2 => return (length((u, v)) - 1.0).abs().min(1.0),
                _ => {}
            }
        }
        let to_sides = [z - 1.0, x - 1.0, 1.0 - z, 1.0 - x];
        let mut value = 0.0_f64;
        for (side, distance) in to_sides.into_iter().enumerate() {
            if has(cell.walls, side) {
                value = value.max(distance);
            }
        }
        for (corner, &at) in CORNERS.iter().enumerate() {
            let (u, v) = from(at);
            if has(cell.concave, corner) {
                value = value.max(match self.of.interior {
                    1 => 1.0 - (u + v),
                    2 => 1.0 - length((u, v)),
                    _ => (1.0 - u).min(1.0 - v),
                });
            }
            if has(cell.walls, corner) && has(cell.walls, (corner + 3) % 4) {
                match self.of.exterior {
                    1 => value = value.max((2.0 - (u + v)).min(1.0)),
                    2 if u <= 1.0 && v <= 1.0 => {
                        value = value.max(length((x - 1.0, z - 1.0)).min(1.0));
                    }
                    _ => {}
                }
            }
        }
        value
    }

    /// The value at a point of a triangle, relative to its left corner.
    fn in_triangle(&self, cell: Cell, p: DVec2) -> f64 {
        let DVec2 { x, y: z } = p;
        let rising = (ROOT * z + x).abs();
        let falling = (ROOT * z - x + 1.0).abs();
        // Positive on the side of the left corner, of the right corner, and of the left corner again.
        let [d1, d2, d3] = [1.0 - rising, 1.0 - falling, 1.0 - x * 2.0];
        let is_near = [
            d1 < 0.0 && d2 < 0.0,
            d1 > 0.0 && d3 > 0.0,
            d3 < 0.0 && d2 > 0.0,
        ];
        let corners = [DVec2::new(0.5, HEIGHT), DVec2::ZERO, DVec2::X];
        let distance = |corner: usize| {
            let d = p - corners[corner];
            (d.x * d.x + d.y * d.y).sqrt()
        };
        let to_sides = [
            1.0 - (ROOT * x - z).abs() * ROOT,
            1.0 - (ROOT * (1.0 - x) - z).abs() * ROOT,
            1.0 - z * 2.0 * ROOT,
        ];
        let mut value = 0.0_f64;
        for (side, distance) in to_sides.into_iter().enumerate() {
            if has(cell.walls, side) {
                value = value.max(distance);
            }
        }
        for corner in (0..3).filter(|&corner| has(cell.concave, corner)) {
            value = value.max(match (self.of.interior, corner) {
                (0, APEX) => 1.0 - (HEIGHT - z) * 2.0 * ROOT,
                (0, LEFT) => 1.0 - (ROOT * x + z).abs() * ROOT,
                (0, _) => 1.0 - (ROOT * (x - 1.0) - z).abs() * ROOT,
                (1, _) if !is_near[corner] => continue,
                (1, APEX) => (1.5 * rising - 2.0).min(1.5 * falling - 2.0),
                (1, LEFT) => (1.0 - 1.5 * rising).min(1.0 - x * 3.0),
                (1, _) => (1.0 - 1.5 * falling).min(x * 3.0 - 2.0),
                (2, _) => 1.0 - distance(corner) * 3.0,
                _ => continue,
            });
        }
        if self.of.sides == 3 {
            value = self
                .exterior_of_triangle(cell, p, to_sides, [d1, d2, d3])
                .unwrap_or(value);
        }
        for corner in (0..3).filter(|&corner| has(cell.obtuse, corner) && is_near[corner]) {
            let [first, second] = SIDES_AT[corner];
            let open = if has(cell.walls, first) {
                second
            } else {
                first
            };
            let [a, b] = ENDS_OF[open];
            let end = if a == corner { b } else { a };
            match self.of.form {
                1 => value = (2.0 * [d1, d2, d3][open].abs()).min(1.0),
                2 => value = (2.0 * ROOT * (distance(end) - ROOT / 3.0)).clamp(0.0, 1.0),
                _ => {}
            }
        }
        value
    }

    /// The value beside a corner of two walls, if `exterior` shapes it.
    fn exterior_of_triangle(
        &self,
        cell: Cell,
        p: DVec2,
        to_sides: [f64; 3],
        [d1, d2, d3]: [f64; 3],
    ) -> Option<f64> {
        let (a, e) = (p.x - 0.5, p.y - HEIGHT / 3.0);
        let is_beside = |corner: usize| SIDES_AT[corner].iter().all(|&side| has(cell.walls, side));
        let is_within = |corner: usize| SIDES_AT[corner].iter().all(|&side| to_sides[side] >= 0.0);
        match self.of.exterior {
            1 => {
                let mut corners = [LEFT, RIGHT, APEX].into_iter();
                let corner = corners.find(|&corner| is_beside(corner) && is_within(corner))?;
                let distance = match corner {
                    APEX => (e * 2.0 * ROOT).abs(),
                    LEFT => (ROOT * a + e).abs() * ROOT,
                    _ => (ROOT * a - e).abs() * ROOT,
                };
                Some(distance.min(1.0))
            }
            2 => {
                let is_near = [
                    d1 <= 0.0 && d2 <= 0.0,
                    d1 >= 0.0 && d3 >= 0.0,
                    d2 >= 0.0 && d3 <= 0.0,
                ];
                (0..3)
                    .any(|corner| is_beside(corner) && is_near[corner])
                    .then(|| (2.0 * ROOT * (a * a + e * e).sqrt()).min(1.0))
            }
            _ => None,
        }
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let (mut x, mut z) = (point.x, point.z);
        if self.of.sides == 4 {
            let cell = self.lattice.cell(whole(x), whole(z));
            return self.in_square(cell, DVec2::new(x - floor(x), z - floor(z)));
        }
        let (mut column, mut row) = (whole(x).wrapping_mul(2), whole(z / ROOT).wrapping_mul(2));
        x -= floor(x);
        z -= ROOT * floor(z / ROOT);
        let mut step = 0;
        if z > HEIGHT {
            z -= HEIGHT;
            row = row.wrapping_add(1);
            let half = if x > 0.5 { 1 } else { -1 };
            x -= 0.5 * f64::from(half);
            step += i64::from(half);
        }
        if x == 0.0 || z / x > ROOT {
            (x, z) = (0.5 - x, HEIGHT - z);
            step -= 1;
        }
        if x == 1.0 || z / (1.0 - x) > ROOT {
            (x, z) = (1.5 - x, HEIGHT - z);
            step += 1;
        }
        column = column.wrapping_add(step);
        self.in_triangle(self.lattice.cell(column, row), DVec2::new(x, z))
    }
}
