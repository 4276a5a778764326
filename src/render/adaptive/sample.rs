//! What samples of a pixel saw.

use super::tiny_objects::TinyObjects;
use crate::base::film::Pixel;
use crate::base::math::sampling::sobol::Sobol;
use crate::render::shade::{BLOCK, BlockScratch, Tracer};
use crate::world::RayCounts;
use std::ops::Range;

/// The most places that are looked at together.
pub(super) const TOGETHER: usize = (BLOCK * BLOCK) as usize;
/// The surface of samples that met none, or of which it is not known.
const NO_SURFACE: u32 = u32::MAX;
/// Two normals whose product is below this belong to two sides of an edge: they are 37 degrees apart.
const SAME_SIDE: f32 = 0.8;

/// What one sample saw.
#[derive(Clone, Copy, Debug)]
pub(super) struct AdaptiveSample {
    /// Red, green, blue, and what shines through the background.
    pub(super) channels: [f32; 4],
    /// Where in the pixel it lies, in parts of 2^16 of the side.
    pub(super) place: (u16, u16),
    /// The surface it met first, and the direction in which that faces.
    pub(super) leaf: u32,
    normal: [f32; 3],
}

impl AdaptiveSample {
    /// Nothing yet.
    pub(super) const NONE: AdaptiveSample = AdaptiveSample {
        channels: [0.0; 4],
        place: (0, 0),
        leaf: NO_SURFACE,
        normal: [0.0; 3],
    };

    /// Whether both met the same side of the same surface.
    #[inline]
    pub(super) fn is_same_side(&self, other: &AdaptiveSample) -> bool {
        if self.leaf != other.leaf || self.leaf == NO_SURFACE {
            return self.leaf == other.leaf;
        }
        let (a, b) = (self.normal, other.normal);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] >= SAME_SIDE
    }

    /// Where in the pixel it lies, as shares of its side.
    pub(super) fn share(&self) -> [f64; 2] {
        let (x, y) = self.place;
        [x, y].map(|v| (f64::from(v) + 0.5) / 65536.0)
    }

    /// Of a surface with this number.
    #[cfg(test)]
    pub(super) fn on_side(leaf: u32) -> AdaptiveSample {
        AdaptiveSample {
            leaf,
            normal: [0.0, 1.0, 0.0],
            ..AdaptiveSample::NONE
        }
    }

    #[cfg(test)]
    pub(super) fn of(sobol: Sobol, number: u32, value: f32) -> AdaptiveSample {
        AdaptiveSample {
            channels: [value; 4],
            place: place(sobol.point(number)),
            ..AdaptiveSample::NONE
        }
    }
}

/// The mean of looks as a pixel.
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision"
)]
pub(super) fn pixel(mean: [f64; 4]) -> Pixel {
    let [r, g, b, transmit] = mean.map(|c| c as f32);
    Pixel::new(crate::base::color::Rgb::new(r, g, b), transmit)
}

/// Looks at places of a picture.
pub(super) struct Eye<'a> {
    pub(super) tracer: &'a Tracer<'a>,
    /// Width and height of the picture.
    pub(super) size: (u32, u32),
    /// How many of the four channels count.
    pub(super) channels: usize,
    /// What is too small for samples.
    pub(super) specks: &'a TinyObjects,
}

/// Buffers that a thread keeps.
#[derive(Default)]
pub(super) struct EyeScratch {
    block: BlockScratch,
    places: Vec<(f64, f64)>,
    cells: Vec<(u16, u16)>,
}

impl EyeScratch {
    /// How many rays were followed with it since this was last asked.
    pub(super) fn take_rays(&mut self) -> RayCounts {
        self.block.take_rays()
    }

    /// Forgets what has been noted.
    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.cells.clear();
    }

    /// How many places have been noted.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// Notes points of the sequence of a pixel as places to look at.
    pub(super) fn note(&mut self, (x, y): (u32, u32), numbers: Range<u32>, specks: &TinyObjects) {
        let sobol = Sobol::of_pixel(x.cast_signed(), y.cast_signed());
        let share = |v: u32| (f64::from(v) + 0.5) / 2f64.powi(32);
        let specks = specks.of_pixel((x, y));
        for number in numbers {
            let point = sobol.point(number);
            let [dx, dy] = specks.moved_out([share(point.0), share(point.1)]);
            self.places
                .push((f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5));
            self.cells.push(place(point));
        }
    }

    /// Notes points of a sequence of its own in a rectangle of a pixel: what `places` makes of each, one after the other.
    pub(super) fn note_rectangle(
        &mut self,
        (x, y): (u32, u32),
        rectangle: u32,
        numbers: Range<u32>,
        places: impl Fn([f64; 2]) -> ([f64; 2], [f64; 2]),
    ) {
        // Pixels of a picture are fewer than 2^16 on a side: no pixel has this sequence.
        let sobol = Sobol::of_pixel(x.cast_signed(), (y | rectangle << 24).cast_signed());
        let share = |v: u32| (f64::from(v) + 0.5) / 2f64.powi(32);
        for number in numbers {
            let point = sobol.point(number);
            let both = places([share(point.0), share(point.1)]);
            for [dx, dy] in [both.0, both.1] {
                let place = (f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5);
                self.places.push(place);
                self.cells.push(self::place(point));
            }
        }
    }

    /// Notes places of a pixel, given as shares of its side.
    pub(super) fn note_places(
        &mut self,
        (x, y): (u32, u32),
        shares: &[[f64; 2]],
        specks: &TinyObjects,
    ) {
        let specks = specks.of_pixel((x, y));
        for &share in shares {
            let [dx, dy] = specks.moved_out(share);
            let place = (f64::from(x) + dx - 0.5, f64::from(y) + dy - 0.5);
            self.places.push(place);
            self.cells.push((0, 0));
        }
    }
}

impl Eye<'_> {
    /// Samples of these numbers of each of these pixels, pixel by pixel.
    pub(super) fn looks(
        &self,
        pixels: impl Iterator<Item = (u32, u32)>,
        numbers: Range<u32>,
        scratch: &mut EyeScratch,
        looks: &mut Vec<AdaptiveSample>,
    ) {
        scratch.clear();
        for pixel in pixels {
            scratch.note(pixel, numbers.clone(), self.specks);
        }
        self.look(scratch, looks);
    }

    /// Looks at the places that have been noted.
    pub(super) fn look(&self, scratch: &mut EyeScratch, looks: &mut Vec<AdaptiveSample>) {
        let start = looks.len();
        looks.resize(start + scratch.places.len(), AdaptiveSample::NONE);
        let chunks = scratch.places.chunks(TOGETHER);
        for (first, places) in (start..).step_by(TOGETHER).zip(chunks) {
            self.tracer.places(
                places,
                self.size,
                &mut scratch.block,
                |number, seen, met| {
                    let (leaf, normal) = met.map_or((NO_SURFACE, [0.0; 3]), |met| {
                        (met.leaf, met.normal.as_vec3().to_array())
                    });
                    looks[first + number] = AdaptiveSample {
                        channels: [seen.rgb.r, seen.rgb.g, seen.rgb.b, seen.transmit],
                        place: scratch.cells[first - start + number],
                        leaf,
                        normal,
                    };
                },
            );
        }
    }
}

#[allow(clippy::cast_possible_truncation, reason = "sixteen bits are left")]
fn place((x, y): (u32, u32)) -> (u16, u16) {
    ((x >> 16) as u16, (y >> 16) as u16)
}
