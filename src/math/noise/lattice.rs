//! Lattice noise: a linear function at each corner of a cell, chosen by a hash and blended by smooth weights.
//!
//! Corners of a cell are worked on four at a time, and the three components of vectors together; the sums are POV-Ray's,
//! in its order.

use super::smooth;
use super::tables::{RANDOM, RANDOMS};
use crate::math::hash::{SIZE, TABLE, wrapped};
use crate::math::lanes::{Four, FourKernel, Row};
use glam::DVec3;

/// What is missing to 1 where a negative coordinate is taken to the cell below, as in POV-Ray.
const EPSILON: f64 = 1e-10;
/// Moves cells about the origin into the positive; it also decides which entries they hash to.
const ORIGIN: i32 = 10_000;
/// Cells so far out have no numbers of 32 bits.
const FAR: f64 = 1e9;
/// A hash chooses among so many entries of the random table.
const CHOICES: usize = 256;
/// How far behind the choice for a component of a vector the one for the next lies.
const COMPONENT: usize = 4;
/// The entries of the random table for the three components of a vector, side by side.
static VECTORS: [[f64; 4]; RANDOMS - 2 * COMPONENT] = vectors();

const fn vectors() -> [[f64; 4]; RANDOMS - 2 * COMPONENT] {
    let mut table = [[0.0; 4]; RANDOMS - 2 * COMPONENT];
    let mut i = 0;
    while i < table.len() {
        table[i] = [
            RANDOM[i],
            RANDOM[i + COMPONENT],
            RANDOM[i + 2 * COMPONENT],
            0.0,
        ];
        i += 1;
    }
    table
}

/// A point in a cell of the lattice. The bits of the number of a corner are x, y, z.
struct Place {
    /// Where the coefficients of the corners begin.
    first: [usize; 8],
    /// How far the point lies above the low corner.
    above: DVec3,
    /// By axis, the weights of the low and of the high corners.
    weights: [[f64; 2]; 3],
}

impl Place {
    #[inline(always)]
    fn new(point: DVec3) -> Self {
        let ((x, fx), (y, fy), (z, fz)) = (cell(point.x), cell(point.y), cell(point.z));
        let (low, high) = (entry(x), entry(x + 1));
        let rows = [low ^ y, high ^ y, low ^ (y + 1), high ^ (y + 1)].map(entry);
        let mut first = [0; 8];
        for (corner, row) in rows.into_iter().enumerate() {
            first[corner] = entry(row ^ z) % CHOICES;
            first[corner + 4] = entry(row ^ (z + 1)) % CHOICES;
        }
        let weights = [fx, fy, fz].map(|above| {
            let high = smooth(above);
            [1.0 - high, high]
        });
        Place {
            first,
            above: DVec3::new(fx, fy, fz),
            weights,
        }
    }

    /// The weights of the four low corners along z, but for that of z.
    #[inline(always)]
    fn flat_weights(&self) -> [f64; 4] {
        let [[x0, x1], [y0, y1], _] = self.weights;
        [x0 * y0, x1 * y0, x0 * y1, x1 * y1]
    }

    /// The terms of the linear function of a corner; `ends` are the constant and the place above the low and the high
    /// corner.
    #[inline(always)]
    fn products<F: Four, const CORNER: u32>(&self, [low, high]: [F; 2]) -> F {
        let first = self.first[CORNER as usize];
        let coefficients = RANDOM[first..].first_chunk().unwrap_or(&[0.0; 4]);
        // By lane: the constant, x, y, z.
        let is_high = F::mask(const { CORNER << 1 });
        F::load(coefficients).times(F::pick(is_high, high, low))
    }

    /// What a corner adds to a vector; `ends` are the place above the low and the high corner.
    #[inline(always)]
    fn vector<F: Four, const CORNER: usize>(&self, ends: &[[F; 3]; 2]) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let first = self.first[CORNER];
        let coefficients = VECTORS[first..].first_chunk().unwrap_or(&[[0.0; 4]; 4]);
        let [constant, of_x, of_y, of_z] = coefficients;
        let linear = F::load(constant)
            .times(F::all(0.5))
            .plus(F::load(of_x).times(ends[dx][0]))
            .plus(F::load(of_y).times(ends[dy][1]))
            .plus(F::load(of_z).times(ends[dz][2]));
        let weight = self.weights[0][dx] * self.weights[1][dy] * self.weights[2][dz];
        F::all(weight).times(linear)
    }
}

/// An entry of the hash table; what goes in is below twice its size.
#[inline(always)]
fn entry(number: usize) -> usize {
    usize::from(TABLE[number % (2 * SIZE)])
}

/// The cell of a coordinate, wrapped, and how far the coordinate lies above it.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, reason = "the whole part is wanted")]
fn cell(t: f64) -> (usize, f64) {
    let shifted = if t >= 0.0 { t } else { t - (1.0 - EPSILON) };
    if shifted.abs() < FAR {
        let whole = shifted as i32;
        (wrapped(i64::from(whole + ORIGIN)), t - f64::from(whole))
    } else {
        far_cell(t, shifted)
    }
}

#[cold]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the cast saturates; so far out there is no pattern left"
)]
fn far_cell(t: f64, shifted: f64) -> (usize, f64) {
    let whole = shifted.trunc();
    let cell = (whole as i64).saturating_add(i64::from(ORIGIN));
    (wrapped(cell), t - whole)
}

/// The sum over the corners of the cell of a point.
pub(super) struct Scalar(pub(super) DVec3);

impl FourKernel for Scalar {
    type Answer = f64;

    #[inline(always)]
    fn run<F: Row>(&self) -> f64 {
        let place = Place::new(self.0);
        let DVec3 { x, y, z } = place.above;
        let ends = [
            F::load(&[0.5, x, y, z]),
            F::load(&[0.5, x - 1.0, y - 1.0, z - 1.0]),
        ];
        let near = F::turned([
            place.products::<F, 0b000>(ends),
            place.products::<F, 0b001>(ends),
            place.products::<F, 0b010>(ends),
            place.products::<F, 0b011>(ends),
        ]);
        let far = F::turned([
            place.products::<F, 0b100>(ends),
            place.products::<F, 0b101>(ends),
            place.products::<F, 0b110>(ends),
            place.products::<F, 0b111>(ends),
        ]);
        let flat = F::load(&place.flat_weights());
        let mut sum = 0.0;
        for ([a, b, c, d], weight) in [near, far].into_iter().zip(place.weights[2]) {
            let linear = a.plus(b).plus(c).plus(d);
            let terms = flat.times(F::all(weight)).times(linear).store();
            for term in terms {
                sum += term;
            }
        }
        sum
    }
}

/// The same sum for the three components of a vector.
pub(super) struct Vector(pub(super) DVec3);

impl Vector {
    /// Each corner is a neighbour of the one before.
    #[inline(always)]
    fn sum<F: Four>(&self) -> F {
        let place = Place::new(self.0);
        let DVec3 { x, y, z } = place.above;
        let low = [F::all(x), F::all(y), F::all(z)];
        let high = [F::all(x - 1.0), F::all(y - 1.0), F::all(z - 1.0)];
        let ends = &[low, high];
        F::all(0.0)
            .plus(place.vector::<F, 0b000>(ends))
            .plus(place.vector::<F, 0b001>(ends))
            .plus(place.vector::<F, 0b011>(ends))
            .plus(place.vector::<F, 0b010>(ends))
            .plus(place.vector::<F, 0b110>(ends))
            .plus(place.vector::<F, 0b111>(ends))
            .plus(place.vector::<F, 0b101>(ends))
            .plus(place.vector::<F, 0b100>(ends))
    }
}

impl FourKernel for Vector {
    type Answer = DVec3;

    #[inline(always)]
    fn run<F: Four>(&self) -> DVec3 {
        vector(self.sum::<F>())
    }
}

/// The sum of such vectors at several frequencies: those above the first with their sizes.
pub(super) struct Octaves<I>(pub(super) DVec3, pub(super) I);

impl<I: Iterator<Item = (f64, f64)> + Clone> FourKernel for Octaves<I> {
    type Answer = DVec3;

    #[inline(always)]
    fn run<F: Four>(&self) -> DVec3 {
        let Octaves(point, above_the_first) = self;
        let mut sum: F = Vector(*point).sum();
        for (size, frequency) in above_the_first.clone() {
            let octave = Vector(*point * frequency).sum();
            sum = sum.plus(F::all(size).times(octave));
        }
        vector(sum)
    }
}

#[inline(always)]
fn vector<F: Four>(lanes: F) -> DVec3 {
    let [x, y, z, _] = lanes.store();
    DVec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::{Lanes, four};
    use crate::math::random::Random;

    #[test]
    fn all_lanes_give_the_same_bits() {
        let mut rng = Random::new(7);
        let (narrow, widest) = (Lanes::NARROW, Lanes::widest());
        for round in 0..10_000 {
            let point = rng.vector(if round % 8 == 0 { 1e12 } else { 50.0 });
            let scalar = |lanes| four(lanes, &Scalar(point)).to_bits();
            let vector = |lanes| four(lanes, &Vector(point)).to_array().map(f64::to_bits);
            assert_eq!(scalar(narrow), scalar(widest), "{point}");
            assert_eq!(vector(narrow), vector(widest), "{point}");
        }
    }
}
