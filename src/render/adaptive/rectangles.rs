//! Rectangles that tiny objects cover in pixels.

use rustc_hash::FxHashMap;

/// A rectangle in a pixel, as shares of its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
}

/// The rectangles of all pixels that have any.
#[derive(Debug, Default)]
pub(super) struct TinyObjects {
    pub(super) of_pixels: FxHashMap<(u32, u32), Vec<Rectangle>>,
}

/// The rectangles of one pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct TinyObjectsOfPixel<'a>(pub(super) &'a [Rectangle]);

impl TinyObjectsOfPixel<'_> {
    /// Moves a point of the pixel out of the rectangle it lies in, if any.
    pub(super) fn moved_out(&self, point: [f64; 2]) -> [f64; 2] {
        let here = self.0.iter().find(|one| one.holds(point));
        here.map_or(point, |rectangle| rectangle.moved_out(point))
    }
}

impl Rectangle {
    pub(super) fn area(&self) -> f64 {
        (self.to[0] - self.from[0]) * (self.to[1] - self.from[1])
    }

    pub(super) fn holds(&self, point: [f64; 2]) -> bool {
        (0..2).all(|i| self.from[i] < point[i] && point[i] < self.to[i])
    }

    pub(super) fn overlaps(&self, other: &Rectangle) -> bool {
        (0..2).all(|i| self.from[i] < other.to[i] && other.from[i] < self.to[i])
    }

    pub(super) fn with(&self, other: &Rectangle) -> Rectangle {
        Rectangle {
            from: [0, 1].map(|i| self.from[i].min(other.from[i])),
            to: [0, 1].map(|i| self.to[i].max(other.to[i])),
        }
    }

    /// The point at a share of the sides.
    pub(super) fn at(&self, share: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.from[i] + share[i] * (self.to[i] - self.from[i]))
    }

    /// Moves a point to the nearest side of the rectangle that is not a side of the pixel.
    pub(super) fn moved_out(&self, point: [f64; 2]) -> [f64; 2] {
        let mut best = (f64::INFINITY, point);
        for i in 0..2 {
            for side in [self.from[i], self.to[i]] {
                let distance = (point[i] - side).abs();
                if side > 0.0 && side < 1.0 && distance < best.0 {
                    best = (distance, point);
                    best.1[i] = side;
                }
            }
        }
        best.1
    }
}
