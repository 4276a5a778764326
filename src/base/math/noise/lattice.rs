//! Lattice noise: a linear function at each corner of a cell, chosen by a hash and blended by smooth weights.
//!
//! Corners of a cell are worked on four at a time, and the three components of vectors together; the sums are POV-Ray's,
//! in its order.

use super::tables::{RANDOM, RANDOMS};
use crate::base::math::sampling::hash::{SIZE, TABLE, wrapped};
use crate::base::math::simd::{F64Lanes, F64x4};
use glam::DVec3;

/// What is missing to 1 where a negative coordinate is taken to the cell below, as in POV-Ray.
const EPSILON: f64 = 1e-10;
/// Moves cells about the origin into the positive; it also decides which entries they hash to.
const ORIGIN: i32 = 10_000;
/// Cells so far out have no numbers of 32 bits.
const FAR: f64 = 1e9;
/// The lane of a point that holds a half.
const HALF: u32 = 0b0001;
/// A hash chooses among so many entries of the random table.
const CHOICES: usize = 256;
/// How far behind the choice for a component of a vector the one for the next lies.
const COMPONENT: usize = 4;
/// Half of the entries of the random table for the three components of a vector, side by side.
static VECTORS: [[f64; 4]; RANDOMS - 2 * COMPONENT] = vectors();

const fn vectors() -> [[f64; 4]; RANDOMS - 2 * COMPONENT] {
    let mut table = [[0.0; 4]; RANDOMS - 2 * COMPONENT];
    let mut i = 0;
    while i < table.len() {
        table[i] = [
            0.5 * RANDOM[i],
            0.5 * RANDOM[i + COMPONENT],
            0.5 * RANDOM[i + 2 * COMPONENT],
            0.0,
        ];
        i += 1;
    }
    table
}

/// A point as the lattice takes it, in front of its coordinates a half: what the constant of a corner is multiplied by.
#[inline(always)]
pub(super) fn spread<F: F64Lanes>(point: DVec3) -> F {
    F::from_array(&[0.5, point.x, point.y, point.z])
}

/// Such a point at another frequency.
#[inline(always)]
pub(super) fn at_frequency<F: F64Lanes>(point: F, frequency: f64) -> F {
    point * F::select(F::mask_from_bits(HALF), F::splat(1.0), F::splat(frequency))
}

/// A point in a cell of the lattice. The bits of the number of a corner are x, y, z.
struct Place<F> {
    /// Where the coefficients of the corners begin.
    first: [usize; 8],
    /// How far the point lies above the low corner, behind a half.
    low: F,
    /// The same above the high corner.
    high: F,
    /// The weights of the four low corners along z, then of the high ones.
    weights: [F; 2],
}

impl<F: F64Lanes> Place<F> {
    #[inline(always)]
    fn new(point: F) -> Self {
        let ([_, x, y, z], low) = cells(point);
        let of_high = smooth(low);
        let [_, x0, y0, z0] = (F::splat(1.0) - of_high).to_array();
        let [_, x1, y1, z1] = of_high.to_array();
        let flat = F::from_array(&[x0, x1, x0, x1]) * F::from_array(&[y0, y0, y1, y1]);
        Place {
            first: choices([x, y, z]),
            low,
            high: low - F::from_array(&[0.0, 1.0, 1.0, 1.0]),
            weights: [flat * F::splat(z0), flat * F::splat(z1)],
        }
    }

    /// The terms of the linear function of a corner.
    #[inline(always)]
    fn products<const CORNER: u32>(&self) -> F {
        let is_high = F::mask_from_bits(const { CORNER << 1 });
        let place = F::select(is_high, self.high, self.low);
        coefficients::<F>(self.first[CORNER as usize]) * place
    }
}

/// Where the coefficients of the corners of a cell begin.
#[inline(always)]
fn choices([x, y, z]: [usize; 3]) -> [usize; 8] {
    let (near, far) = (entry(x), entry(x + 1));
    let rows = [
        entry(near ^ y),
        entry(far ^ y),
        entry(near ^ (y + 1)),
        entry(far ^ (y + 1)),
    ];
    let mut first = [0; 8];
    for corner in 0..4 {
        first[corner] = entry(rows[corner] ^ z) % CHOICES;
        first[corner + 4] = entry(rows[corner] ^ (z + 1)) % CHOICES;
    }
    first
}

/// [`super::smooth`] in lanes.
#[inline(always)]
fn smooth<F: F64Lanes>(t: F) -> F {
    t * t * (F::splat(3.0) - F::splat(2.0) * t)
}

/// The coefficients of a corner: the constant, x, y, z.
#[inline(always)]
fn coefficients<F: F64Lanes>(first: usize) -> F {
    F::from_array(RANDOM[first..].first_chunk().unwrap_or(&[0.0; 4]))
}

/// An entry of the hash table; what goes in is below twice its size.
#[inline(always)]
fn entry(number: usize) -> usize {
    usize::from(TABLE[number % (2 * SIZE)]) % SIZE
}

/// The cells of coordinates, wrapped, and how far the coordinates lie above them.
// Arrays are not mapped here: where that is not inlined it costs as much as the noise.
#[inline(always)]
fn cells<F: F64Lanes>(point: F) -> ([usize; 4], F) {
    let below = point - F::splat(1.0 - EPSILON);
    let shifted = F::select(point.lt(F::splat(0.0)), below, point);
    if F::bitmask(shifted.abs().lt(F::splat(FAR))) == 0b1111 {
        let (whole, cells) = shifted.truncate();
        let mut moved = [0; 4];
        for (moved, cell) in moved.iter_mut().zip(cells) {
            *moved = wrapped(i64::from(cell.wrapping_add(ORIGIN)));
        }
        (moved, point - whole)
    } else {
        let far = far_cells(point.to_array(), shifted.to_array());
        (far.0, F::from_array(&far.1))
    }
}

#[cold]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the cast saturates; so far out there is no pattern left"
)]
fn far_cells(point: [f64; 4], shifted: [f64; 4]) -> ([usize; 4], [f64; 4]) {
    let whole = shifted.map(f64::trunc);
    let cells = whole.map(|whole| wrapped((whole as i64).saturating_add(i64::from(ORIGIN))));
    (cells, std::array::from_fn(|i| point[i] - whole[i]))
}

/// The sum over the corners of the cell of a point.
#[inline(always)]
pub(super) fn scalar<F: F64x4>(point: F) -> f64 {
    let place = Place::new(point);
    let near = F::transpose([
        place.products::<0b000>(),
        place.products::<0b001>(),
        place.products::<0b010>(),
        place.products::<0b011>(),
    ]);
    let far = F::transpose([
        place.products::<0b100>(),
        place.products::<0b101>(),
        place.products::<0b110>(),
        place.products::<0b111>(),
    ]);
    let [low, high] = place.weights;
    added(added(0.0, low * linear(near)), high * linear(far))
}

#[inline(always)]
fn linear<F: F64Lanes>([constant, x, y, z]: [F; 4]) -> F {
    constant + x + y + z
}

/// A sum with four more terms, one after the other.
#[inline(always)]
fn added<F: F64Lanes>(sum: f64, terms: F) -> f64 {
    let [a, b, c, d] = terms.to_array();
    sum + a + b + c + d
}

/// The same sum for the three components of a vector. Each corner is a neighbour of the one before.
#[inline(always)]
pub(super) fn vector<F: F64Lanes>(point: F) -> F {
    let place = Place::new(point);
    let corners = Corners {
        first: place.first,
        ends: [doubled(place.low), doubled(place.high)],
        weights: [place.weights[0].to_array(), place.weights[1].to_array()],
    };
    F::splat(0.0)
        + corners.vector::<0b000>()
        + corners.vector::<0b001>()
        + corners.vector::<0b011>()
        + corners.vector::<0b010>()
        + corners.vector::<0b110>()
        + corners.vector::<0b111>()
        + corners.vector::<0b101>()
        + corners.vector::<0b100>()
}

/// The corners of the cell of a point, for the components of a vector side by side.
struct Corners<F> {
    first: [usize; 8],
    /// Twice how far the point lies above the low corner and above the high one.
    ends: [[F; 3]; 2],
    weights: [[f64; 4]; 2],
}

impl<F: F64Lanes> Corners<F> {
    /// What a corner adds to a vector. The coefficients are halves of those of POV-Ray and the place is doubled, both
    /// without rounding: of the constant a half is needed.
    #[inline(always)]
    fn vector<const CORNER: usize>(&self) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let first = self.first[CORNER];
        let coefficients = VECTORS[first..].first_chunk().unwrap_or(&[[0.0; 4]; 4]);
        let [constant, of_x, of_y, of_z] = coefficients;
        let linear = F::from_array(constant)
            + F::from_array(of_x) * self.ends[dx][0]
            + F::from_array(of_y) * self.ends[dy][1]
            + F::from_array(of_z) * self.ends[dz][2];
        F::splat(self.weights[dz][CORNER % 4]) * linear
    }
}

/// Twice the coordinates of a place, each in all lanes.
#[inline(always)]
fn doubled<F: F64Lanes>(place: F) -> [F; 3] {
    let [_, x, y, z] = (place + place).to_array();
    [F::splat(x), F::splat(y), F::splat(z)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel};

    struct Both(DVec3);

    impl SimdKernel for Both {
        type Output = (f64, [f64; 4]);
        #[inline(always)]
        fn run<F: F64x4>(self) -> (f64, [f64; 4]) {
            let point = spread::<F>(self.0);
            (scalar(point), vector(point).to_array())
        }
    }

    #[test]
    fn all_lanes_give_the_same_bits() {
        let mut rng = Random::new(7);
        let (narrow, widest) = (SimdLevel::NARROW, SimdLevel::widest());
        for round in 0..10_000 {
            let point = rng.vector(if round % 8 == 0 { 1e12 } else { 50.0 });
            let bits = |lanes: SimdLevel| {
                let (scalar, vector) = lanes.run(Both(point));
                (scalar.to_bits(), vector.map(f64::to_bits))
            };
            assert_eq!(bits(narrow), bits(widest), "{point}");
        }
    }
}
