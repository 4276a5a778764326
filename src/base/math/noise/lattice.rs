//! Lattice noise: a linear function at each corner of a cell, selected by a hash and blended with smooth weights.
//!
//! Scalar noise evaluates four corners per operation, vector noise its three components. Sums are in POV-Ray's order.

use super::tables::{RANDOM, RANDOMS};
use crate::base::math::sampling::hash::{SIZE, TABLE, wrapped};
use crate::base::math::simd::{F64Lanes, F64x4};
use glam::DVec3;

/// POV-Ray subtracts `1 - EPSILON` from negative coordinates before it truncates them to a cell.
const EPSILON: f64 = 1e-10;
/// Offset that makes cells near the origin positive. The hash, and so the noise, depends on it.
const ORIGIN: i32 = 10_000;
/// From this coordinate on a cell index may not fit into 32 bits.
const FAR: f64 = 1e9;
/// Lane of a [`spread`] point that holds 0.5.
const HALF: u32 = 0b0001;
/// The number of entries of the random table that a hash selects from.
const CHOICES: usize = 256;
/// Distance in the random table between the entries of two successive components of a vector.
const COMPONENT: usize = 4;
/// Random table entries for the three components of a vector side by side, halved.
static VECTOR_COEFFICIENTS: [[f64; 4]; RANDOMS - 2 * COMPONENT] = vector_coefficients();

const fn vector_coefficients() -> [[f64; 4]; RANDOMS - 2 * COMPONENT] {
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

/// A point in lanes: 0.5, the factor of a corner's constant term, then the coordinates.
#[inline(always)]
pub(super) fn spread<F: F64Lanes>(point: DVec3) -> F {
    F::from_array(&[0.5, point.x, point.y, point.z])
}

/// A [`spread`] point with its coordinates scaled by `frequency`.
#[inline(always)]
pub(super) fn at_frequency<F: F64Lanes>(point: F, frequency: f64) -> F {
    point * F::select(F::mask_from_bits(HALF), F::splat(1.0), F::splat(frequency))
}

/// A point within its lattice cell. Bits 0, 1 and 2 of a corner's number are x, y and z: set for the high side.
struct CellPoint<F> {
    /// Index of the first coefficient of each corner.
    first: [usize; 8],
    /// 0.5, then the offset of the point from the low corner.
    low: F,
    /// 0.5, then the offset from the high corner.
    high: F,
    /// Weights of the four corners at low z, then of the four at high z.
    weights: [F; 2],
}

impl<F: F64Lanes> CellPoint<F> {
    #[inline(always)]
    fn new(point: F) -> Self {
        let ([_, x, y, z], low) = cells(point);
        let high_weights = smooth(low);
        let [_, x0, y0, z0] = (F::splat(1.0) - high_weights).to_array();
        let [_, x1, y1, z1] = high_weights.to_array();
        let flat = F::from_array(&[x0, x1, x0, x1]) * F::from_array(&[y0, y0, y1, y1]);
        CellPoint {
            first: corner_coefficients([x, y, z]),
            low,
            high: low - F::from_array(&[0.0, 1.0, 1.0, 1.0]),
            weights: [flat * F::splat(z0), flat * F::splat(z1)],
        }
    }

    /// The four terms of a corner's linear function.
    #[inline(always)]
    fn products<const CORNER: u32>(&self) -> F {
        let is_high = F::mask_from_bits(const { CORNER << 1 });
        let offset = F::select(is_high, self.high, self.low);
        coefficients::<F>(self.first[CORNER as usize]) * offset
    }
}

/// Index of the first coefficient of each corner of a cell.
#[inline(always)]
fn corner_coefficients([x, y, z]: [usize; 3]) -> [usize; 8] {
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

/// The coefficients of a corner: constant, x, y, z.
#[inline(always)]
fn coefficients<F: F64Lanes>(first: usize) -> F {
    F::from_array(RANDOM[first..].first_chunk().unwrap_or(&[0.0; 4]))
}

/// An entry of the hash table; `number` is below twice the table's size.
#[inline(always)]
fn entry(number: usize) -> usize {
    usize::from(TABLE[number % (2 * SIZE)]) % SIZE
}

/// The wrapped cell of each coordinate, and the offsets of the coordinates within the cells.
// No `array::map`: where the compiler does not inline it, it costs as much as the noise itself.
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

/// [`cells`] for coordinates beyond [`FAR`] and NaN.
#[cold]
fn far_cells(point: [f64; 4], shifted: [f64; 4]) -> ([usize; 4], [f64; 4]) {
    let cells = shifted.map(to_i32);
    let moved = cells.map(|cell| wrapped(i64::from(cell) + i64::from(ORIGIN)));
    (
        moved,
        std::array::from_fn(|i| point[i] - f64::from(cells[i])),
    )
}

/// A number truncated to an integer. What does not fit becomes the least integer, as the processor converts it for
/// POV-Ray (docs/povray-facts.md, section 8.2).
#[allow(clippy::cast_possible_truncation, reason = "checked to fit")]
pub(super) fn to_i32(number: f64) -> i32 {
    if number.abs() < -f64::from(i32::MIN) {
        number as i32
    } else {
        i32::MIN
    }
}

/// The raw scalar noise: the sum over the corners of the cell.
#[inline(always)]
pub(super) fn scalar<F: F64x4>(point: F) -> f64 {
    let cell = CellPoint::new(point);
    let near = F::transpose([
        cell.products::<0b000>(),
        cell.products::<0b001>(),
        cell.products::<0b010>(),
        cell.products::<0b011>(),
    ]);
    let far = F::transpose([
        cell.products::<0b100>(),
        cell.products::<0b101>(),
        cell.products::<0b110>(),
        cell.products::<0b111>(),
    ]);
    let [low, high] = cell.weights;
    added(added(0.0, low * linear(near)), high * linear(far))
}

#[inline(always)]
fn linear<F: F64Lanes>([constant, x, y, z]: [F; 4]) -> F {
    constant + x + y + z
}

/// Adds four terms to a sum, one after the other.
#[inline(always)]
fn added<F: F64Lanes>(sum: f64, terms: F) -> f64 {
    let [a, b, c, d] = terms.to_array();
    sum + a + b + c + d
}

/// The vector noise: the same sum for three components. Each corner is adjacent to the previous one, as in POV-Ray.
#[inline(always)]
pub(super) fn vector<F: F64Lanes>(point: F) -> F {
    let cell = CellPoint::new(point);
    let corners = Corners {
        first: cell.first,
        offsets: [doubled(cell.low), doubled(cell.high)],
        weights: [cell.weights[0].to_array(), cell.weights[1].to_array()],
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

/// The corners of a cell, with the components of vector noise side by side.
struct Corners<F> {
    first: [usize; 8],
    /// Twice the offsets of the point from the low and from the high corner.
    offsets: [[F; 3]; 2],
    weights: [[f64; 4]; 2],
}

impl<F: F64Lanes> Corners<F> {
    /// The contribution of a corner. The coefficients are half of POV-Ray's and the offsets doubled, both exactly,
    /// because the constant term is needed halved.
    #[inline(always)]
    fn vector<const CORNER: usize>(&self) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let first = self.first[CORNER];
        let coefficients = VECTOR_COEFFICIENTS[first..]
            .first_chunk()
            .unwrap_or(&[[0.0; 4]; 4]);
        let [constant, of_x, of_y, of_z] = coefficients;
        let linear = F::from_array(constant)
            + F::from_array(of_x) * self.offsets[dx][0]
            + F::from_array(of_y) * self.offsets[dy][1]
            + F::from_array(of_z) * self.offsets[dz][2];
        F::splat(self.weights[dz][CORNER % 4]) * linear
    }
}

/// Twice the coordinates of a point, each broadcast to all lanes.
#[inline(always)]
fn doubled<F: F64Lanes>(point: F) -> [F; 3] {
    let [_, x, y, z] = (point + point).to_array();
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
