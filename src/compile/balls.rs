//! Balls that become leaves when the order of the tree is known: where there are a million of them, writing them once less
//! is a tenth of the time it takes to prepare them.

use super::leaf::{Absorb, Extent, Leaf};
use super::row::Row;
use crate::shape::Shape;

/// Balls of one colour in the order of the file, by a number of their own.
#[derive(Debug, Default)]
pub(super) struct Balls {
    stretches: Vec<Stretch>,
    count: u32,
}

/// Balls that follow each other in the file.
#[derive(Debug)]
struct Stretch {
    first: u32,
    /// The looks of the first; those of the others follow.
    surface: u32,
    row: Row,
}

impl Balls {
    /// Adds a row of `count` balls whose looks begin at `surface`; gives the number of the first.
    pub(super) fn add(&mut self, row: Row, count: u32, surface: u32) -> u32 {
        let first = self.count;
        self.count += count;
        self.stretches.push(Stretch {
            first,
            surface,
            row,
        });
        first
    }

    /// Where a ball is: its stretch, and the number in that.
    #[inline]
    fn place(&self, number: u32) -> (&Stretch, u32) {
        let behind = self.stretches.partition_point(|one| one.first <= number);
        let stretch = &self.stretches[behind - 1];
        (stretch, number - stretch.first)
    }

    /// Says that the ball of this number will be asked for soon.
    #[inline]
    pub(super) fn expect(&self, number: u32) {
        let (stretch, at) = self.place(number);
        stretch.row.expect(at as usize);
    }

    /// The leaf of the ball of this number.
    #[inline]
    pub(super) fn leaf(&self, number: u32) -> Leaf {
        let (stretch, at) = self.place(number);
        let sphere = stretch.row.ball(at as usize);
        let shape = Shape::Sphere(sphere.expect("the row is one of balls"));
        let place = (&[][..], Absorb::AllItCan);
        Leaf::new(shape, place, stretch.surface + at, Extent::Surface).0
    }

    /// Lets go of them.
    pub(super) fn forget(self) {
        for stretch in self.stretches {
            stretch.row.forget();
        }
    }
}
