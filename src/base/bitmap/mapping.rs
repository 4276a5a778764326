//! Image mapping (`map_type`, `interpolate`, `once`): from points in space to pixels of a bitmap.

use super::Bitmap;
use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::base::source::Diagnostic;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Offset in pixels that POV-Ray adds to image coordinates.
const PIXEL_OFFSET: f64 = 1e-10;

/// Palette index of images without a palette; the colour is used instead. Interpolation that overshoots to exactly this
/// value has the same effect.
pub(super) const NO_INDEX: i64 = -1;

/// `map_type`: the surface around which the image is wrapped.
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
    /// 7: an angular map about the z axis, as light probes have; since version 3.8.
    Angular,
}

/// `interpolate`: the filter between pixel centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// 0: the nearest pixel.
    #[default]
    None,
    /// 2: bilinear.
    Bilinear,
    /// 3: bicubic.
    Bicubic,
    /// 4: normalised distance.
    NormalisedDistance,
    /// Any other number where POV-Ray takes it: no pixel contributes, and every colour and index is 0. POV-Ray's bumps
    /// may differ, since they are undefined.
    Unknown,
}

/// The mapping of an image to space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mapping {
    /// The surface.
    pub map_type: MapType,
    /// The filter between pixel centres.
    pub interpolation: Interpolation,
    /// `once`: the image does not repeat.
    pub is_once: bool,
}

impl Mapping {
    /// Reads the next token `word` and its value if it is a mapping parameter; returns false otherwise. An unknown
    /// `map_type` means planar and an unknown `interpolate` colour 0 everywhere, as in POV-Ray, except for
    /// [`Purpose::Colors`], where either is an error.
    ///
    /// # Errors
    /// The number of `map_type` or `interpolate` is unknown.
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
        let (is_known, valid_numbers, substitute) = if word == Word::MapType {
            let entries = [
                (0.0, MapType::Planar),
                (1.0, MapType::Spherical),
                (2.0, MapType::Cylindrical),
                (5.0, MapType::Toroidal),
                (7.0, MapType::Angular),
            ];
            let has_angular = args.is_for_3_8();
            let matching_entry = entries
                .into_iter()
                .find(|entry| entry.0 == number && (has_angular || entry.1 != MapType::Angular));
            self.map_type = matching_entry.map_or(MapType::Planar, |entry| entry.1);
            let valid_numbers = match has_angular {
                true => "0, 1, 2, 5 or 7",
                false => "0, 1, 2 or 5 (7 needs `#version 3.8`)",
            };
            (matching_entry.is_some(), valid_numbers, "it is planar")
        } else {
            let entries = [
                (0.0, Interpolation::None),
                (2.0, Interpolation::Bilinear),
                (3.0, Interpolation::Bicubic),
                (4.0, Interpolation::NormalisedDistance),
            ];
            let matching_entry = entries.into_iter().find(|entry| entry.0 == number);
            self.interpolation = matching_entry.map_or(Interpolation::Unknown, |entry| entry.1);
            (
                matching_entry.is_some(),
                "0, 2, 3 or 4",
                "the picture is 0 everywhere",
            )
        };
        if is_known {
            return Ok(true);
        }
        let span = start.to(args.last_span());
        let message = format!("`{word}` is {valid_numbers}, found {number}");
        if purpose == Purpose::Colors {
            return Err(Box::new(Diagnostic::error(span, message)));
        }
        args.warn(Diagnostic::warning(
            span,
            format!("{message}; {substitute}"),
        ));
        Ok(true)
    }

    /// Image position of a point, in pixels from the top left. `None` outside an image mapped `once`, on the axis of a
    /// cylindrical or toroidal map, and in the centre of a spherical or angular one.
    #[must_use]
    pub fn image_position(&self, bitmap: &Bitmap, point: DVec3) -> Option<DVec2> {
        let at = match self.map_type {
            MapType::Planar => DVec2::new(point.x, point.y),
            MapType::Spherical => {
                let unit = point.try_normalize()?;
                DVec2::new(
                    angle_in_turns(unit.x, unit.z).unwrap_or(0.0),
                    0.5 + unit.y.clamp(-1.0, 1.0).asin() / PI,
                )
            }
            MapType::Angular => {
                let unit = point.try_normalize()?;
                let off_axis = unit.x.hypot(unit.y);
                let radius = match off_axis == 0.0 {
                    true => 0.0,
                    false => unit.z.clamp(-1.0, 1.0).acos() / (TAU * off_axis),
                };
                DVec2::new(0.5 + unit.x * radius, 0.5 + unit.y * radius)
            }
            MapType::Cylindrical => DVec2::new(angle_in_turns(point.x, point.z)?, point.y),
            MapType::Toroidal => {
                let radial_distance = point.x.hypot(point.z) - 1.0;
                let distance = radial_distance.hypot(point.y);
                let angle = if distance == 0.0 {
                    0.0
                } else {
                    (-radial_distance / distance).clamp(-1.0, 1.0).acos()
                };
                let angle = if point.y > 0.0 { TAU - angle } else { angle };
                DVec2::new(angle_in_turns(point.x, point.z)?, angle / TAU)
            }
        };
        // The interval is closed. A length of exactly 1 then wraps to 0; an angle does not.
        let is_inside = |at: f64| (0.0..=1.0).contains(&at);
        if self.is_once && !(is_inside(at.x) && is_inside(at.y)) {
            return None;
        }
        let size = DVec2::new(bitmap.width as f64, bitmap.height as f64);
        let mut at = at * size;
        match self.map_type {
            MapType::Planar => at = DVec2::new(remainder(at.x, size.x), remainder(at.y, size.y)),
            MapType::Cylindrical => at.y = remainder(at.y, size.y),
            MapType::Spherical | MapType::Toroidal | MapType::Angular => {}
        }
        at += PIXEL_OFFSET;
        if self.is_once && at.cmpge(size).any() {
            return None;
        }
        Some(DVec2::new(wrapped(at.x, size.x), wrapped(-at.y, size.y)))
    }

    /// The colour at a point; `None` outside an image mapped `once`.
    #[must_use]
    pub fn color(&self, bitmap: &Bitmap, point: DVec3) -> Option<Color> {
        let at = self.image_position(bitmap, point)?;
        Some(self.color_at(bitmap, at))
    }

    /// The interpolated colour at an image position in pixels from the top left; it may lie outside the image.
    #[must_use]
    pub fn color_at(&self, bitmap: &Bitmap, at: DVec2) -> Color {
        bitmap.divided_by_alpha(self.stored_color_at(bitmap, at))
    }

    /// The same before any division by alpha.
    pub(super) fn stored_color_at(&self, bitmap: &Bitmap, at: DVec2) -> Color {
        if self.interpolation == Interpolation::None {
            let [x, y] = self.pixel(bitmap, at);
            return bitmap.stored_color(x, y);
        }
        let mut sum = Sum::default();
        self.visit_neighbours(bitmap, at, |weight, x, y| {
            sum.add(weight, bitmap.stored_color(x, y));
        });
        sum.color()
    }

    /// The palette index at an image position, interpolated like a colour and truncated to an integer. Without a
    /// palette every pixel is -1; rounding of the weights may change the interpolated value.
    #[must_use]
    pub fn index_at(&self, bitmap: &Bitmap, at: DVec2) -> i64 {
        let index = |x, y| bitmap.index(x, y).map_or(NO_INDEX, i64::from);
        if self.interpolation == Interpolation::None {
            let [x, y] = self.pixel(bitmap, at);
            return index(x, y);
        }
        let mut sum = 0.0;
        self.visit_neighbours(bitmap, at, |weight, x, y| {
            sum += weight * index(x, y) as f64;
        });
        trunc(sum)
    }

    /// Visits the pixels around an image position, with their interpolation weights.
    fn visit_neighbours(&self, bitmap: &Bitmap, at: DVec2, visit: impl FnMut(f64, usize, usize)) {
        match self.interpolation {
            Interpolation::None | Interpolation::Bilinear => {
                self.visit_2x2(bitmap, at, bilinear, visit);
            }
            Interpolation::NormalisedDistance => {
                self.visit_2x2(bitmap, at, normalised_distance, visit);
            }
            Interpolation::Bicubic => self.visit_4x4(bitmap, at, visit),
            Interpolation::Unknown => {}
        }
    }

    /// Column and row of the pixel at an image position.
    fn pixel(&self, bitmap: &Bitmap, at: DVec2) -> [usize; 2] {
        let [x, y] = [at.x, at.y].map(trunc);
        [
            self.wrap_or_clamp(x, bitmap.width),
            self.wrap_or_clamp(y, bitmap.height),
        ]
    }

    /// A column or row clamped to the image if it is mapped `once`, otherwise wrapped around.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "the size is below 2^28, and the result within it"
    )]
    fn wrap_or_clamp(&self, at: i64, size: usize) -> usize {
        let size = size as i64;
        if self.is_once {
            at.clamp(0, size - 1) as usize
        } else if (0..size).contains(&at) {
            at as usize
        } else {
            at.rem_euclid(size) as usize
        }
    }

    /// Visits 2×2 pixels; `weights` are in the order lower right, lower left, upper right, upper left.
    fn visit_2x2(
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
            let column = self.wrap_or_clamp(x - corner % 2, bitmap.width);
            let row = self.wrap_or_clamp(y - corner / 2, bitmap.height);
            visit(weight, column, row);
        }
    }

    /// Visits 4×4 pixels, column by column, with bicubic weights.
    fn visit_4x4(&self, bitmap: &Bitmap, at: DVec2, mut visit: impl FnMut(f64, usize, usize)) {
        let at = at + 0.5;
        let [x, y] = [at.x, at.y].map(trunc);
        let column_weights = cubic(at.x - x as f64);
        let row_weights = cubic(at.y - y as f64);
        for (column, column_weight) in (x - 2..).zip(column_weights) {
            for (row, row_weight) in (y - 2..).zip(row_weights) {
                let column = self.wrap_or_clamp(column, bitmap.width);
                let row = self.wrap_or_clamp(row, bitmap.height);
                visit(row_weight * column_weight, column, row);
            }
        }
    }
}

impl Bitmap {
    /// Wraps an image position at most one image size outside back into the image.
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

/// The angle of (x, z) from +x towards +z, in turns from 0 to 1; `None` on the axis.
fn angle_in_turns(x: f64, z: f64) -> Option<f64> {
    let length = x.hypot(z);
    if length == 0.0 {
        return None;
    }
    let angle = (x / length).clamp(-1.0, 1.0).acos();
    Some(if z < 0.0 {
        (TAU - angle) / TAU
    } else {
        angle / TAU
    })
}

/// `at % size`, without the division in the usual case `|at| < size`.
fn remainder(at: f64, size: f64) -> f64 {
    if at.abs() < size { at } else { at % size }
}

/// A coordinate wrapped into `0..size`.
fn wrapped(at: f64, size: f64) -> f64 {
    let remainder = remainder(at, size);
    let at = if remainder < 0.0 {
        remainder + size
    } else {
        remainder
    };
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
    let inverse_distance_sq = |a: f64, b: f64| 1.0 / (a * a + b * b).max(f64::MIN_POSITIVE);
    let (left, above) = (1.0 - p, 1.0 - q);
    let weights = [
        inverse_distance_sq(left, above),
        inverse_distance_sq(p, above),
        inverse_distance_sq(left, q),
        inverse_distance_sq(p, q),
    ];
    let total: f64 = weights.iter().sum();
    weights.map(|weight| weight / total)
}

/// Cubic weights of four consecutive pixels.
fn cubic(p: f64) -> [f64; 4] {
    let q = 1.0 - p;
    [
        -p * q * q / 2.0,
        q * (q * (3.0 * p + 1.0) + 1.0) / 2.0,
        p * (p * (3.0 * q + 1.0) + 1.0) / 2.0,
        -q * p * p / 2.0,
    ]
}

/// A weighted sum of colours.
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

/// The use of an image, which decides its gamma handling and parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Colours: stored values are decoded, and `filter` and `transmit` are accepted.
    Colors,
    /// Values as stored, without gamma decoding.
    Values,
    /// Values for a `bump_map`: also accepts `bump_size`.
    Bumps,
    /// Values for a `material_map`: reading stops at the first `texture` of the block and leaves the block open.
    Textures,
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
    fn coordinates_wrap_or_are_clamped() {
        assert_eq!(wrapped(-1.0, 4.0), 3.0);
        assert_eq!(wrapped(-1e-20, 4.0), 0.0);
        let once = Mapping {
            is_once: true,
            ..Mapping::default()
        };
        assert_eq!(
            (once.wrap_or_clamp(-1, 4), once.wrap_or_clamp(4, 4)),
            (0, 3)
        );
        assert_eq!(Mapping::default().wrap_or_clamp(-1, 4), 3);
    }
}
