//! Queries side by side, in the form in which four are answered at once.

use super::query::Query;
use crate::math::lanes::Four;
use crate::shape::FourRays;

/// Four queries. Where there are fewer the last stands in for those that are missing.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct FourQueries {
    origin: [[f64; 4]; 3],
    dir: [[f64; 4]; 3],
    /// Nothing up to here counts.
    pub(super) from: [f64; 4],
    /// Nothing beyond counts.
    pub(super) far: [f64; 4],
    /// The leaves that the rays have just left; [`NO_LEAF`] for none.
    pub(super) left: [u32; 4],
}

/// The number of no leaf.
const NO_LEAF: u32 = u32::MAX;

/// Any number of queries, four by four.
#[derive(Debug, Default)]
pub(super) struct Lot {
    fours: Vec<FourQueries>,
}

impl Lot {
    /// Takes in the queries of the numbers up to `count`; `least` is the distance of each up to which nothing counts.
    #[inline(always)]
    pub(super) fn fill(
        &mut self,
        count: usize,
        query: impl Fn(usize) -> Query,
        least: impl Fn(&Query) -> f64,
    ) {
        self.fours.clear();
        for first in (0..count).step_by(4) {
            let mut four = FourQueries {
                origin: [[0.0; 4]; 3],
                dir: [[0.0; 4]; 3],
                from: [0.0; 4],
                far: [0.0; 4],
                left: [NO_LEAF; 4],
            };
            for lane in 0..4 {
                let query = &query((first + lane).min(count - 1));
                for axis in 0..3 {
                    four.origin[axis][lane] = query.ray.origin[axis];
                    four.dir[axis][lane] = query.ray.dir[axis];
                }
                four.from[lane] = least(query);
                four.far[lane] = query.far;
                four.left[lane] = query.from.map_or(NO_LEAF, |left| left.leaf);
            }
            self.fours.push(four);
        }
    }

    /// The four among which the query of this number is.
    #[inline(always)]
    pub(super) fn four(&self, number: usize) -> &FourQueries {
        &self.fours[number / 4]
    }

    /// Up to here nothing counts for the query of this number.
    #[inline(always)]
    pub(super) fn from(&self, number: usize) -> f64 {
        self.fours[number / 4].from[number % 4]
    }

    /// Beyond this nothing counts for the query of this number.
    #[inline(always)]
    pub(super) fn far(&self, number: usize) -> f64 {
        self.fours[number / 4].far[number % 4]
    }

    /// Lets a query end sooner.
    #[inline(always)]
    pub(super) fn shorten(&mut self, number: usize, far: f64) {
        self.fours[number / 4].far[number % 4] = far;
    }
}

impl FourQueries {
    /// The rays, in lanes.
    #[inline(always)]
    pub(super) fn load<F: Four>(&self) -> FourRays<F> {
        FourRays {
            origin: load(&self.origin),
            dir: load(&self.dir),
        }
    }

    /// Which rays have just left this leaf, one bit each.
    #[inline(always)]
    pub(super) fn have_left(&self, leaf: u32) -> u32 {
        let mut bits = 0;
        for (lane, left) in self.left.iter().enumerate() {
            bits |= u32::from(*left == leaf) << lane;
        }
        bits
    }
}

// A closure would not take part in the wide lanes of its caller.
#[inline(always)]
fn load<F: Four>(from: &[[f64; 4]; 3]) -> [F; 3] {
    [F::load(&from[0]), F::load(&from[1]), F::load(&from[2])]
}
