//! Objects smaller than a pixel or hardly larger, which samples easily miss.
//!
//! The world knows the boxes of all its objects, and the camera where they are seen. A pixel with something tiny in it
//! gets samples of its own for that: all others are moved out of the rectangle in which it is seen, so that they show the
//! pixel without it, and the samples in there tell how much it adds. That is no estimate of what might hide; the mean is
//! the same however the samples are moved.

use super::band::{Band, FinishedPixel};
use super::estimate::{Estimate, of_all};
use super::sample::{AdaptiveSample, Eye, EyeScratch, pixel};
use super::slope::Slopes;
use crate::base::math::Bounds;
use crate::scene::camera::Camera;
use crate::world::{RayCounts, World};
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// What is wider or higher than so many pixels is met by the samples of all.
const WIDEST: f64 = 2.0;
/// In a pixel of which they cover more together samples of all kinds see enough of them.
const MOST_COVERED: f64 = 0.6;
/// The most in a pixel; if there are more, the largest.
const MOST: usize = 16;
/// What is so many times as bright as white is still looked for if it could count.
const BRIGHTEST: f64 = 8.0;
/// Room around a box, as a share of its size and in pixels: boxes are rounded.
const ROOM: f64 = 0.01;
const LEAST_ROOM: f64 = 1e-6;
/// Samples in a rectangle first, and at most.
const FIRST: u32 = 16;
const MOST_SAMPLES: u32 = 1 << 10;
/// The share of the error asked for that a rectangle may have.
const SHARE: f64 = 0.25;

/// A rectangle in a pixel, as shares of its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rectangle {
    from: [f64; 2],
    to: [f64; 2],
}

/// The rectangles of all pixels that have some.
#[derive(Debug, Default)]
pub(super) struct TinyObjects {
    of_pixels: FxHashMap<(u32, u32), Vec<Rectangle>>,
}

/// The rectangles of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct TinyObjectsOfPixel<'a>(&'a [Rectangle]);

impl TinyObjectsOfPixel<'_> {
    /// Moves a place of the pixel out of what is tiny there, if it is in it.
    pub(super) fn moved_out(&self, place: [f64; 2]) -> [f64; 2] {
        let here = self.0.iter().find(|one| one.holds(place));
        here.map_or(place, |rectangle| rectangle.moved_out(place))
    }
}

impl Rectangle {
    fn area(&self) -> f64 {
        (self.to[0] - self.from[0]) * (self.to[1] - self.from[1])
    }

    fn holds(&self, place: [f64; 2]) -> bool {
        (0..2).all(|i| self.from[i] < place[i] && place[i] < self.to[i])
    }

    fn meets(&self, other: &Rectangle) -> bool {
        (0..2).all(|i| self.from[i] < other.to[i] && other.from[i] < self.to[i])
    }

    fn with(&self, other: &Rectangle) -> Rectangle {
        Rectangle {
            from: [0, 1].map(|i| self.from[i].min(other.from[i])),
            to: [0, 1].map(|i| self.to[i].max(other.to[i])),
        }
    }

    /// The place of a share of its sides.
    fn at(&self, share: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.from[i] + share[i] * (self.to[i] - self.from[i]))
    }

    /// A place in it moved to the nearest side that is not one of the pixel.
    fn moved_out(&self, place: [f64; 2]) -> [f64; 2] {
        let mut best = (f64::INFINITY, place);
        for i in 0..2 {
            for side in [self.from[i], self.to[i]] {
                let way = (place[i] - side).abs();
                if side > 0.0 && side < 1.0 && way < best.0 {
                    best = (way, place);
                    best.1[i] = side;
                }
            }
        }
        best.1
    }
}

impl TinyObjects {
    /// Those of a world in a picture of this size that can count where the error is to be no larger than `error`.
    pub(super) fn of(world: &World, size: (u32, u32), error: f64) -> TinyObjects {
        let mut specks = TinyObjects::default();
        if world.lens.is_some() {
            return specks;
        }
        for bounds in world.boxes() {
            if let Some(seen) = seen(&world.camera, &bounds, size) {
                specks.note(&seen, size, error);
            }
        }
        specks.of_pixels.retain(|_, rectangles| {
            unite(rectangles);
            rectangles.sort_by(|a, b| b.area().total_cmp(&a.area()));
            rectangles.truncate(MOST);
            let covered: f64 = rectangles.iter().map(Rectangle::area).sum();
            covered <= MOST_COVERED
        });
        specks
    }

    /// Notes a rectangle of the picture in its pixels.
    fn note(&mut self, seen: &Rectangle, (width, height): (u32, u32), error: f64) {
        // Whole numbers are centres of pixels.
        let range = |i: usize, end: u32| {
            let first = (seen.from[i] + 0.5).floor().clamp(0.0, f64::from(end));
            let last = (seen.to[i] + 0.5).floor().clamp(-1.0, f64::from(end) - 1.0);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between 0 and the side of the picture"
            )]
            let range = first as u32..(last + 1.0) as u32;
            range
        };
        for y in range(1, height) {
            for x in range(0, width) {
                let corner = [f64::from(x) - 0.5, f64::from(y) - 0.5];
                let rectangle = Rectangle {
                    from: [0, 1].map(|i| (seen.from[i] - corner[i]).clamp(0.0, 1.0)),
                    to: [0, 1].map(|i| (seen.to[i] - corner[i]).clamp(0.0, 1.0)),
                };
                if rectangle.area() * BRIGHTEST > error {
                    self.of_pixels.entry((x, y)).or_default().push(rectangle);
                }
            }
        }
    }

    /// Those of a pixel.
    pub(super) fn of_pixel(&self, pixel: (u32, u32)) -> TinyObjectsOfPixel<'_> {
        // Most pictures have none at all.
        if self.of_pixels.is_empty() {
            return TinyObjectsOfPixel(&[]);
        }
        let rectangles = self.of_pixels.get(&pixel);
        TinyObjectsOfPixel(rectangles.map_or(&[][..], Vec::as_slice))
    }

    /// Adds what is tiny to the finished pixels of a rectangle of the picture, with these pixels. Gives samples and rays.
    pub(super) fn add(
        &self,
        band: &Band<'_>,
        pixels: impl Fn((u32, u32)) -> Option<usize>,
        done: &mut [FinishedPixel],
    ) -> (u64, RayCounts) {
        let mut here: Vec<(usize, (u32, u32))> = self
            .of_pixels
            .keys()
            .filter_map(|&pixel| Some((pixels(pixel)?, pixel)))
            .collect();
        here.sort_unstable();
        let added: Vec<(Added, RayCounts)> = here
            .par_iter()
            .map_init(
                || (EyeScratch::default(), Vec::new()),
                |(scratch, looks), &(_, pixel)| {
                    let added = self.added(band, pixel, scratch, looks);
                    (added, scratch.take_rays())
                },
            )
            .collect();
        let (mut samples, mut all_rays) = (0, RayCounts::default());
        for (&(at, _), (added, rays)) in here.iter().zip(added) {
            samples += added.samples;
            all_rays += rays;
            let one = &mut done[at];
            let value = one.value;
            let [r, g, b, transmit] = added.mean;
            let sum = [
                f64::from(value.rgb.r) + r,
                f64::from(value.rgb.g) + g,
                f64::from(value.rgb.b) + b,
                f64::from(value.transmit) + transmit,
            ];
            one.value = pixel(sum);
            one.error = one.error.hypot(added.error);
        }
        (samples, all_rays)
    }

    /// What is tiny in a pixel adds to it.
    fn added(
        &self,
        band: &Band<'_>,
        at: (u32, u32),
        scratch: &mut EyeScratch,
        looks: &mut Vec<AdaptiveSample>,
    ) -> Added {
        let mut added = Added::default();
        for (number, rectangle) in (1u32..).zip(self.of_pixel(at).0) {
            let mut grid = Vec::new();
            looks.clear();
            let mut taken = 0;
            let found = loop {
                let numbers = taken..(2 * taken).max(FIRST);
                taken = numbers.end;
                self.differences(band.eye, at, (number, rectangle), numbers, scratch, looks);
                let found = of_all(looks, band.eye.channels, &Slopes::default(), &mut grid);
                let is_enough = found.error <= band.target.error * SHARE;
                if is_enough || taken >= MOST_SAMPLES || band.target.is_over() {
                    break found;
                }
            };
            added.samples += 2 * u64::from(taken);
            added.take(&found);
        }
        added
    }

    /// What some samples in a rectangle show more than those that are moved out of it.
    fn differences(
        &self,
        eye: &Eye<'_>,
        at: (u32, u32),
        (number, rectangle): (u32, &Rectangle),
        numbers: std::ops::Range<u32>,
        scratch: &mut EyeScratch,
        looks: &mut Vec<AdaptiveSample>,
    ) {
        scratch.clear();
        let all = self.of_pixel(at);
        scratch.note_rectangle(at, number, numbers, |share| {
            let place = rectangle.at(share);
            (place, all.moved_out(place))
        });
        let start = looks.len();
        eye.look(scratch, looks);
        #[allow(
            clippy::cast_possible_truncation,
            reason = "colours are single precision"
        )]
        let area = rectangle.area() as f32;
        let count = (looks.len() - start) / 2;
        for i in 0..count {
            let (inside, outside) = (looks[start + 2 * i], looks[start + 2 * i + 1]);
            let mut difference = inside;
            for c in 0..4 {
                difference.channels[c] = (inside.channels[c] - outside.channels[c]) * area;
            }
            looks[start + i] = difference;
        }
        looks.truncate(start + count);
    }
}

/// What is added to a pixel.
#[derive(Default)]
struct Added {
    mean: [f64; 4],
    error: f64,
    samples: u64,
}

impl Added {
    fn take(&mut self, found: &Estimate) {
        self.mean = [0, 1, 2, 3].map(|c| self.mean[c] + found.mean[c]);
        self.error = self.error.hypot(found.error);
    }
}

/// Where in the picture a box is seen, if it is smaller than a pixel.
fn seen(camera: &Camera, bounds: &Bounds, (width, height): (u32, u32)) -> Option<Rectangle> {
    if !bounds.is_finite() || bounds.is_empty() {
        return None;
    }
    let mut all = Rectangle {
        from: [f64::INFINITY; 2],
        to: [f64::NEG_INFINITY; 2],
    };
    for corner in 0..8 {
        let of = |bit: u32, min: f64, max: f64| if corner >> bit & 1 == 0 { min } else { max };
        let corner = DVec3::new(
            of(0, bounds.min.x, bounds.max.x),
            of(1, bounds.min.y, bounds.max.y),
            of(2, bounds.min.z, bounds.max.z),
        );
        let (x, y) = camera.place_of(corner, width, height)?;
        all = all.with(&Rectangle {
            from: [x, y],
            to: [x, y],
        });
        let is_small = (0..2).all(|i| all.to[i] - all.from[i] < WIDEST);
        if !is_small {
            return None;
        }
    }
    let room = [0, 1].map(|i| (all.to[i] - all.from[i]) * ROOM + LEAST_ROOM);
    Some(Rectangle {
        from: [0, 1].map(|i| all.from[i] - room[i]),
        to: [0, 1].map(|i| all.to[i] + room[i]),
    })
}

/// Makes one of those that meet each other.
fn unite(rectangles: &mut Vec<Rectangle>) {
    let mut first = 0;
    while first < rectangles.len() {
        let meeting =
            (first + 1..rectangles.len()).find(|&i| rectangles[first].meets(&rectangles[i]));
        match meeting {
            Some(other) => {
                let other = rectangles.swap_remove(other);
                rectangles[first] = rectangles[first].with(&other);
                // What it did not meet before it may meet now.
                first = 0;
            }
            None => first += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(from: [f64; 2], to: [f64; 2]) -> Rectangle {
        Rectangle { from, to }
    }

    #[test]
    fn rectangles_that_meet_become_one() {
        let mut all = vec![
            rectangle([0.1, 0.1], [0.2, 0.2]),
            rectangle([0.6, 0.6], [0.7, 0.7]),
            rectangle([0.3, 0.1], [0.4, 0.2]),
            rectangle([0.15, 0.1], [0.35, 0.15]),
        ];
        unite(&mut all);
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(all.contains(&rectangle([0.1, 0.1], [0.4, 0.2])));
    }

    #[test]
    fn places_are_moved_out_but_not_into_another_pixel() {
        let one = rectangle([0.0, 0.4], [0.2, 0.7]);
        assert_eq!(one.moved_out([0.01, 0.5]), [0.01, 0.4]);
        assert_eq!(one.moved_out([0.19, 0.5]), [0.2, 0.5]);
        assert!(!one.holds(one.moved_out([0.19, 0.5])));
    }

    #[test]
    fn a_speck_lies_in_the_pixels_that_see_it() {
        let mut specks = TinyObjects::default();
        let at_a_corner = rectangle([3.4, 6.3], [3.6, 6.6]);
        specks.note(&at_a_corner, (10, 8), 1e-4);
        let mut pixels: Vec<_> = specks.of_pixels.keys().copied().collect();
        pixels.sort_unstable();
        assert_eq!(pixels, [(3, 6), (3, 7), (4, 6), (4, 7)]);
        let area: f64 = specks
            .of_pixels
            .values()
            .flatten()
            .map(Rectangle::area)
            .sum();
        assert!((area - at_a_corner.area()).abs() < 1e-12);
        let here = specks.of_pixel((3, 6));
        assert_eq!(here.moved_out([0.2, 0.2]), [0.2, 0.2]);
        assert!(here.moved_out([0.95, 0.95]) != [0.95, 0.95]);
    }
}
