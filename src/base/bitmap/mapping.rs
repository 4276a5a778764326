//! How a picture is laid over space: which of its pixels show at a point.

use super::{Bitmap, Purpose};
use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::base::source::Diagnostic;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// What POV-Ray adds to coordinates, in pixels.
const NUDGE: f64 = 1e-10;

/// The index of what has no palette: the colour counts instead, as it does where indices interpolated beyond their
/// range come to just this number.
pub(super) const NO_INDEX: i64 = -1;

/// `map_type`: the surface that the picture is wrapped about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapType {
    /// 0: the unit square of the xy plane.
    #[default]
    Planar,
    /// 1: a sphere about the origin.
    Spherical,
    /// 2: a cylinder about the y axis, of height 1.
    Cylindrical,
    /// 5: a torus about the y axis with major radius 1.
    Toroidal,
}

/// `interpolate`: what shows between the middles of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// 0: the nearest pixel.
    #[default]
    None,
    /// 2: bilinear.
    Bilinear,
    /// 3: bicubic.
    Bicubic,
    /// 4: by normalised distance.
    NormalisedDistance,
}

/// How a picture is laid over space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mapping {
    /// The surface.
    pub map_type: MapType,
    /// What shows between pixels.
    pub interpolation: Interpolation,
    /// Whether the picture is there only once, rather than again and again.
    pub is_once: bool,
}

impl Mapping {
    /// Reads `word`, the next token, with its value if it is one of a mapping, and says whether it was. A number of no
    /// map is the flat one, but where colours are read for.
    ///
    /// # Errors
    /// A number that the language does not know.
    pub fn read(&mut self, word: Word, purpose: Purpose, args: &mut dyn Args) -> Parse<bool> {
        if !matches!(word, Word::Once | Word::MapType | Word::Interpolate) {
            return Ok(false);
        }
        args.accept(word)?;
        if word == Word::Once {
            self.is_once = true;
            return Ok(true);
        }
        let start = args.span();
        let number = args.float()?.trunc();
        let (is_known, numbers) = if word == Word::MapType {
            let known = [
                (0.0, MapType::Planar),
                (1.0, MapType::Spherical),
                (2.0, MapType::Cylindrical),
                (5.0, MapType::Toroidal),
            ];
            let found = known.into_iter().find(|entry| entry.0 == number);
            self.map_type = found.map_or(MapType::Planar, |entry| entry.1);
            let is_known = found.is_some() || purpose != Purpose::Colors;
            (is_known, "0, 1, 2 or 5")
        } else {
            let known = [
                (0.0, Interpolation::None),
                (2.0, Interpolation::Bilinear),
                (3.0, Interpolation::Bicubic),
                (4.0, Interpolation::NormalisedDistance),
            ];
            let found = known.into_iter().find(|entry| entry.0 == number);
            self.interpolation = found.map_or(self.interpolation, |entry| entry.1);
            (found.is_some(), "0, 2, 3 or 4")
        };
        if is_known {
            return Ok(true);
        }
        let place = start.to(args.last_span());
        let message = format!("`{word}` is {numbers}, found {number}");
        Err(Box::new(Diagnostic::error(place, message)))
    }

    /// Where in the picture a point lies, in pixels from the left and from the top; `None` outside of a picture that
    /// is there once.
    #[must_use]
    pub fn place(&self, bitmap: &Bitmap, point: DVec3) -> Option<DVec2> {
        let at = match self.map_type {
            MapType::Planar => DVec2::new(point.x, point.y),
            MapType::Spherical => {
                let unit = point.try_normalize()?;
                DVec2::new(
                    turn(unit.x, unit.z),
                    0.5 + unit.y.clamp(-1.0, 1.0).asin() / PI,
                )
            }
            MapType::Cylindrical => DVec2::new(turn(point.x, point.z), point.y),
            MapType::Toroidal => {
                let out = point.x.hypot(point.z) - 1.0;
                let distance = out.hypot(point.y);
                let angle = if distance == 0.0 {
                    0.0
                } else {
                    (-out / distance).clamp(-1.0, 1.0).acos()
                };
                let angle = if point.y > 0.0 { TAU - angle } else { angle };
                DVec2::new(turn(point.x, point.z), angle / TAU)
            }
        };
        // Both ends are inside; lengths, though not angles, then fall from the far end on the near one.
        let is_inside = |at: f64| (0.0..=1.0).contains(&at);
        if self.is_once && !(is_inside(at.x) && is_inside(at.y)) {
            return None;
        }
        let size = DVec2::new(bitmap.width as f64, bitmap.height as f64);
        let mut at = at * size;
        match self.map_type {
            MapType::Planar => at = DVec2::new(rest(at.x, size.x), rest(at.y, size.y)),
            MapType::Cylindrical => at.y = rest(at.y, size.y),
            MapType::Spherical | MapType::Toroidal => {}
        }
        at += NUDGE;
        if self.is_once && at.cmpge(size).any() {
            return None;
        }
        Some(DVec2::new(wrapped(at.x, size.x), wrapped(-at.y, size.y)))
    }

    /// The colour at a point; `None` outside of a picture that is there once.
    #[must_use]
    pub fn color(&self, bitmap: &Bitmap, point: DVec3) -> Option<Color> {
        let at = self.place(bitmap, point)?;
        Some(self.color_at(bitmap, at))
    }

    /// The colour at a place in pixels from the left and from the top, which may lie outside.
    #[must_use]
    pub fn color_at(&self, bitmap: &Bitmap, at: DVec2) -> Color {
        if self.interpolation == Interpolation::None {
            let [x, y] = self.pixel(bitmap, at);
            return bitmap.color(x, y);
        }
        let mut sum = Sum::default();
        self.about(bitmap, at, |weight, x, y| {
            sum.add(weight, bitmap.color(x, y));
        });
        sum.color()
    }

    /// The index in the palette at such a place, interpolated like a colour and cut off behind the point. Without a
    /// palette all pixels count as -1, which rounding may spoil.
    #[must_use]
    pub fn index_at(&self, bitmap: &Bitmap, at: DVec2) -> i64 {
        let index = |x, y| bitmap.index(x, y).map_or(NO_INDEX, i64::from);
        if self.interpolation == Interpolation::None {
            let [x, y] = self.pixel(bitmap, at);
            return index(x, y);
        }
        let mut sum = 0.0;
        self.about(bitmap, at, |weight, x, y| {
            sum += weight * index(x, y) as f64;
        });
        trunc(sum)
    }

    /// Visits the pixels whose middles lie about a place, with what each weighs.
    fn about(&self, bitmap: &Bitmap, at: DVec2, visit: impl FnMut(f64, usize, usize)) {
        match self.interpolation {
            Interpolation::None | Interpolation::Bilinear => {
                self.four(bitmap, at, bilinear, visit);
            }
            Interpolation::NormalisedDistance => self.four(bitmap, at, normalised_distance, visit),
            Interpolation::Bicubic => self.sixteen(bitmap, at, visit),
        }
    }

    /// Column and row of the pixel at such a place.
    fn pixel(&self, bitmap: &Bitmap, at: DVec2) -> [usize; 2] {
        let [x, y] = [at.x, at.y].map(trunc);
        [self.kept(x, bitmap.width), self.kept(y, bitmap.height)]
    }

    /// A column or row within the picture.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "the size is below 2^28, and the result within it"
    )]
    fn kept(&self, at: i64, size: usize) -> usize {
        let size = size as i64;
        if self.is_once {
            at.clamp(0, size - 1) as usize
        } else if (0..size).contains(&at) {
            at as usize
        } else {
            at.rem_euclid(size) as usize
        }
    }

    /// Four pixels by the weights of right and left below, right and left above.
    fn four(
        &self,
        bitmap: &Bitmap,
        at: DVec2,
        weights: fn(f64, f64) -> [f64; 4],
        mut visit: impl FnMut(f64, usize, usize),
    ) {
        let at = at + 0.5;
        let [x, y] = [at.x, at.y].map(trunc);
        let (p, q) = (at.x - x as f64, at.y - y as f64);
        for (corner, weight) in (0_i64..).zip(weights(p, q)) {
            let column = self.kept(x - corner % 2, bitmap.width);
            let row = self.kept(y - corner / 2, bitmap.height);
            visit(weight, column, row);
        }
    }

    /// Sixteen pixels, column by column.
    fn sixteen(&self, bitmap: &Bitmap, at: DVec2, mut visit: impl FnMut(f64, usize, usize)) {
        let at = at + 0.5;
        let [x, y] = [at.x, at.y].map(trunc);
        let of_columns = cubic(at.x - x as f64);
        let of_rows = cubic(at.y - y as f64);
        for (column, of_column) in (x - 2..).zip(of_columns) {
            for (row, of_row) in (y - 2..).zip(of_rows) {
                let column = self.kept(column, bitmap.width);
                let row = self.kept(row, bitmap.height);
                visit(of_row * of_column, column, row);
            }
        }
    }
}

impl Bitmap {
    /// A place, no farther from the picture than it is large, on one of its copies side by side.
    #[must_use]
    pub fn wrapped(&self, at: DVec2) -> DVec2 {
        let wrapped = |at: f64, size: usize| {
            let size = size as f64;
            if at < 0.0 {
                at + size
            } else if at >= size {
                at - size
            } else {
                at
            }
        };
        DVec2::new(wrapped(at.x, self.width), wrapped(at.y, self.height))
    }
}

/// The angle of (x, z) from +x towards +z, in turns from 0 to 1.
fn turn(x: f64, z: f64) -> f64 {
    let length = x.hypot(z);
    if length == 0.0 {
        return 0.0;
    }
    let angle = (x / length).clamp(-1.0, 1.0).acos();
    if z < 0.0 {
        (TAU - angle) / TAU
    } else {
        angle / TAU
    }
}

/// `at % size`, which mostly is the coordinate itself.
fn rest(at: f64, size: f64) -> f64 {
    if at.abs() < size { at } else { at % size }
}

/// A coordinate taken into `0..size`.
fn wrapped(at: f64, size: f64) -> f64 {
    let rest = rest(at, size);
    let at = if rest < 0.0 { rest + size } else { rest };
    if at < size { at } else { 0.0 }
}

#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
fn trunc(at: f64) -> i64 {
    at as i64
}

fn bilinear(p: f64, q: f64) -> [f64; 4] {
    let (left, above) = (1.0 - p, 1.0 - q);
    [p * q, left * q, p * above, left * above]
}

fn normalised_distance(p: f64, q: f64) -> [f64; 4] {
    let near = |a: f64, b: f64| 1.0 / (a * a + b * b).max(f64::MIN_POSITIVE);
    let (left, above) = (1.0 - p, 1.0 - q);
    let weights = [near(left, above), near(p, above), near(left, q), near(p, q)];
    let total: f64 = weights.iter().sum();
    weights.map(|weight| weight / total)
}

/// The weights of four pixels in a row.
fn cubic(p: f64) -> [f64; 4] {
    let q = 1.0 - p;
    [
        -p * q * q / 2.0,
        q * (q * (3.0 * p + 1.0) + 1.0) / 2.0,
        p * (p * (3.0 * q + 1.0) + 1.0) / 2.0,
        -q * p * p / 2.0,
    ]
}

/// A sum of colours by weight.
#[derive(Default)]
struct Sum([f64; 5]);

impl Sum {
    fn add(&mut self, weight: f64, color: Color) {
        let Rgb { r, g, b } = color.rgb;
        let channels = [r, g, b, color.filter, color.transmit];
        for (sum, channel) in self.0.iter_mut().zip(channels) {
            *sum += weight * f64::from(channel);
        }
    }

    fn color(&self) -> Color {
        Color::from_components(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(weights: &[f64]) -> f64 {
        weights.iter().sum()
    }

    #[test]
    fn weights_add_up_to_one() {
        for (p, q) in [(0.0, 0.0), (0.25, 0.5), (0.9, 0.1)] {
            assert!((sum(&bilinear(p, q)) - 1.0).abs() < 1e-12);
            assert!((sum(&normalised_distance(p, q)) - 1.0).abs() < 1e-12);
            assert!((sum(&cubic(p)) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn places_wrap_or_end() {
        assert_eq!(wrapped(-1.0, 4.0), 3.0);
        assert_eq!(wrapped(-1e-20, 4.0), 0.0);
        let once = Mapping {
            is_once: true,
            ..Mapping::default()
        };
        assert_eq!((once.kept(-1, 4), once.kept(4, 4)), (0, 3));
        assert_eq!(Mapping::default().kept(-1, 4), 3);
    }
}
