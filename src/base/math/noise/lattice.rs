//! Lattice noise: a linear function at each corner of a cell, selected by a hash and blended with smooth weights.
//!
//! Cells, weights and scalar noise are computed for four points at a time, such as the octaves of a sum: the latency of
//! the hash, four loads that depend on each other, is then paid once. Vector noise has its three components side by
//! side, and the scalar noise of one point its corners. Sums are in POV-Ray's order.

use super::tables::{RANDOM, RANDOMS};
use crate::base::math::sampling::hash::{SIZE, TABLE, wrapped};
use crate::base::math::simd::vec3::{Vec3Lanes, add, from_arrays, to_arrays};
use crate::base::math::simd::{F64Lanes, F64x4};

/// POV-Ray subtracts `1 - EPSILON` from negative coordinates before it truncates them to a cell.
const EPSILON: f64 = 1e-10;
/// Offset that makes cells near the origin positive. The hash, and so the noise, depends on it.
const ORIGIN: i32 = 10_000;
/// From this coordinate on a cell index may not fit into 32 bits.
const FAR: f64 = 1e9;
/// Distance in the random table between the entries of two successive components of a vector.
const COMPONENT: usize = 4;
/// Random table entries for the three components of a vector side by side, halved.
static VECTOR_COEFFICIENTS: Aligned<[[f64; 4]; RANDOMS - 2 * COMPONENT]> =
    Aligned(vector_coefficients());

/// A table whose rows of 32 bytes do not cross cache lines.
#[repr(align(32))]
struct Aligned<T>(T);

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

/// Index of the first coefficient of each corner of the cells of four points. Bits 0, 1 and 2 of a corner's number are
/// x, y and z: set for the high side.
type CornerCoefficients = [[u8; 8]; 4];

/// Four points within their cells.
struct CellPoints<F> {
    /// The offsets of the points from the low and from the high corner.
    offsets: [Vec3Lanes<F>; 2],
    /// The weights of the corners.
    weights: [F; 8],
}

impl<F: F64Lanes> CellPoints<F> {
    /// The first `count` of four points; the others are anything.
    #[inline(always)]
    fn new(points: Vec3Lanes<F>, count: usize, first: &mut CornerCoefficients) -> Self {
        let (cells, low) = cells(points);
        for (point, first) in first.iter_mut().enumerate().take(count) {
            hash_corners([cells[0][point], cells[1][point], cells[2][point]], first);
        }
        let one = F::splat(1.0);
        let [x1, y1, z1] = [smooth(low[0]), smooth(low[1]), smooth(low[2])];
        let [x0, y0, z0] = [one - x1, one - y1, one - z1];
        let [a, b, c, d] = [x0 * y0, x1 * y0, x0 * y1, x1 * y1];
        CellPoints {
            offsets: [low, [low[0] - one, low[1] - one, low[2] - one]],
            weights: [
                a * z0,
                b * z0,
                c * z0,
                d * z0,
                a * z1,
                b * z1,
                c * z1,
                d * z1,
            ],
        }
    }
}

/// Sets the index of the first coefficient of each corner of a cell.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the hash is cut to 256 values"
)]
fn hash_corners([x, y, z]: [i32; 3], first: &mut [u8; 8]) {
    let [x, y, z] = [index(x), index(y), index(z)];
    let (near, far) = (entry(x), entry(x + 1));
    let rows = [
        entry(near ^ y),
        entry(far ^ y),
        entry(near ^ (y + 1)),
        entry(far ^ (y + 1)),
    ];
    for corner in 0..4 {
        first[corner] = entry(rows[corner] ^ z) as u8;
        first[corner + 4] = entry(rows[corner] ^ (z + 1)) as u8;
    }
}

/// The smoothstep in lanes.
#[inline(always)]
fn smooth<F: F64Lanes>(t: F) -> F {
    t * t * (F::splat(3.0) - F::splat(2.0) * t)
}

/// An entry of the hash table; `number` is below twice the table's size.
#[inline(always)]
fn entry(number: usize) -> usize {
    usize::from(TABLE[number % (2 * SIZE)])
}

/// The hash's number of a cell on an axis.
#[inline(always)]
fn index(cell: i32) -> usize {
    wrapped(i64::from(cell.wrapping_add(ORIGIN)))
}

/// The cells of points on each axis, and the offsets of the points within them.
// No `array::map`: where the compiler does not inline it, it costs as much as the noise itself.
#[inline(always)]
fn cells<F: F64Lanes>([x, y, z]: Vec3Lanes<F>) -> ([[i32; 4]; 3], Vec3Lanes<F>) {
    let shifted = [shifted(x), shifted(y), shifted(z)];
    let [sx, sy, sz] = shifted;
    let far = F::splat(FAR);
    let is_near = sx.abs().lt(far) & sy.abs().lt(far) & sz.abs().lt(far);
    if F::bitmask(is_near) == 0b1111 {
        let [(x0, i), (y0, j), (z0, k)] = [sx.truncate(), sy.truncate(), sz.truncate()];
        ([i, j, k], [x - x0, y - y0, z - z0])
    } else {
        let (cells, low) = far_cells(to_arrays([x, y, z]), to_arrays(shifted));
        (cells, from_arrays(&low))
    }
}

/// Coordinates of which truncation gives the cell.
#[inline(always)]
fn shifted<F: F64Lanes>(x: F) -> F {
    F::select(x.lt(F::splat(0.0)), x - F::splat(1.0 - EPSILON), x)
}

/// [`cells`] for coordinates beyond [`FAR`] and NaN.
#[cold]
fn far_cells(points: [[f64; 4]; 3], shifted: [[f64; 4]; 3]) -> ([[i32; 4]; 3], [[f64; 4]; 3]) {
    let cells = shifted.map(|shifted| shifted.map(to_i32));
    let low = |axis: usize| std::array::from_fn(|i| points[axis][i] - f64::from(cells[axis][i]));
    (cells, std::array::from_fn(low))
}

/// A number truncated to an integer. What does not fit becomes the least integer, as the processor converts it for
/// POV-Ray (docs/povray-shapes.md, section 8.2).
#[allow(clippy::cast_possible_truncation, reason = "checked to fit")]
pub(super) fn to_i32(number: f64) -> i32 {
    if number.abs() < -f64::from(i32::MIN) {
        number as i32
    } else {
        i32::MIN
    }
}

/// The same, held in memory: the compiler would merge bytes to words and split them again.
#[inline(always)]
fn in_memory<T>(of: &mut T) -> &mut T {
    std::hint::black_box(of)
}

/// The raw scalar noise at a point in all lanes: the sum over the corners of its cell, four of which are side by side.
#[inline(always)]
pub(super) fn scalar<F: F64x4>(point: Vec3Lanes<F>) -> f64 {
    let (cells, low) = cells(point);
    let mut first = [0; 8];
    hash_corners([cells[0][0], cells[1][0], cells[2][0]], &mut first);
    let one = F::splat(1.0);
    let [high_x, high_y, high_z] = [low[0] - one, low[1] - one, low[2] - one];
    let [x1, y1, z1] = [smooth(low[0]), smooth(low[1]), smooth(low[2])];
    let [in_x, in_y] = [F::mask_from_bits(0b1010), F::mask_from_bits(0b1100)];
    let [x, y] = [
        F::select(in_x, high_x, low[0]),
        F::select(in_y, high_y, low[1]),
    ];
    let flat = F::select(in_x, x1, one - x1) * F::select(in_y, y1, one - y1);
    let [a, b, c, d, e, f, g, h] = first;
    let near = flat * (one - z1) * linear([a, b, c, d], [x, y, low[2]]);
    let far = flat * z1 * linear([e, f, g, h], [x, y, high_z]);
    added(added(0.0, near), far)
}

/// Adds four terms to a sum, one after the other.
#[inline(always)]
fn added<F: F64Lanes>(sum: f64, terms: F) -> f64 {
    let [a, b, c, d] = terms.to_array();
    sum + a + b + c + d
}

/// The linear functions with these first coefficients.
#[inline(always)]
fn linear<F: F64x4>(first: [u8; 4], [x, y, z]: Vec3Lanes<F>) -> F {
    let mut rows = [&[0.0; 4]; 4];
    for (row, first) in rows.iter_mut().zip(first) {
        if let Some(coefficients) = RANDOM[usize::from(first)..].first_chunk() {
            *row = coefficients;
        }
    }
    let [constant, of_x, of_y, of_z] = F::columns(rows);
    F::splat(0.5) * constant + of_x * x + of_y * y + of_z * z
}

/// The raw scalar noise at the first `count` of four points.
#[inline(always)]
pub(super) fn scalar_x4<F: F64x4>(points: Vec3Lanes<F>, count: usize) -> [f64; 4] {
    let mut first = [[0; 8]; 4];
    let cells = CellPoints::new(points, count, in_memory(&mut first));
    let sum = F::splat(0.0)
        + cells.scalar::<0b000>(&first)
        + cells.scalar::<0b001>(&first)
        + cells.scalar::<0b010>(&first)
        + cells.scalar::<0b011>(&first)
        + cells.scalar::<0b100>(&first)
        + cells.scalar::<0b101>(&first)
        + cells.scalar::<0b110>(&first)
        + cells.scalar::<0b111>(&first);
    sum.to_array()
}

impl<F: F64x4> CellPoints<F> {
    /// The contribution of a corner to the scalar noise of each point.
    #[inline(always)]
    fn scalar<const CORNER: usize>(&self, first: &CornerCoefficients) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let of_points = [
            first[0][CORNER],
            first[1][CORNER],
            first[2][CORNER],
            first[3][CORNER],
        ];
        let offsets = [
            self.offsets[dx][0],
            self.offsets[dy][1],
            self.offsets[dz][2],
        ];
        self.weights[CORNER] * linear(of_points, offsets)
    }
}

/// The points at which vector noise is wanted.
#[derive(Default)]
pub(super) struct VectorPoints {
    first: CornerCoefficients,
    /// Twice the offsets of the points from the low and from the high corner.
    offsets: [[[f64; 4]; 3]; 2],
    weights: [[f64; 4]; 8],
}

impl VectorPoints {
    /// Sets the first `count` of four points.
    #[inline(always)]
    pub(super) fn set<F: F64Lanes>(&mut self, points: Vec3Lanes<F>, count: usize) {
        let cells = CellPoints::new(points, count, in_memory(&mut self.first));
        let [low, high] = cells.offsets;
        self.offsets = [to_arrays(add(low, low)), to_arrays(add(high, high))];
        for (weights, of_cells) in self.weights.iter_mut().zip(cells.weights) {
            *weights = of_cells.to_array();
        }
    }

    /// The vector noise at a point: the same sum for three components. Each corner is adjacent to the previous one, as
    /// in POV-Ray.
    #[inline(always)]
    pub(super) fn noise<F: F64Lanes>(&self, point: usize) -> F {
        F::splat(0.0)
            + self.corner::<F, 0b000>(point)
            + self.corner::<F, 0b001>(point)
            + self.corner::<F, 0b011>(point)
            + self.corner::<F, 0b010>(point)
            + self.corner::<F, 0b110>(point)
            + self.corner::<F, 0b111>(point)
            + self.corner::<F, 0b101>(point)
            + self.corner::<F, 0b100>(point)
    }

    /// The contribution of a corner. The coefficients are half of POV-Ray's and the offsets doubled, both exactly,
    /// because the constant term is needed halved.
    #[inline(always)]
    fn corner<F: F64Lanes, const CORNER: usize>(&self, point: usize) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let first = usize::from(self.first[point][CORNER]);
        let coefficients = VECTOR_COEFFICIENTS.0[first..]
            .first_chunk()
            .unwrap_or(&[[0.0; 4]; 4]);
        let [constant, of_x, of_y, of_z] = coefficients;
        let linear = F::from_array(constant)
            + F::from_array(of_x) * F::splat(self.offsets[dx][0][point])
            + F::from_array(of_y) * F::splat(self.offsets[dy][1][point])
            + F::from_array(of_z) * F::splat(self.offsets[dz][2][point]);
        F::splat(self.weights[CORNER][point]) * linear
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{SimdKernel, SimdLevel, vec3};
    use glam::DVec3;

    /// The noises of one to four points, and each of them alone.
    struct All([DVec3; 4], usize);

    impl SimdKernel for All {
        type Output = [Vec<u64>; 2];
        #[inline(always)]
        fn run<F: F64x4>(self) -> [Vec<u64>; 2] {
            let All(points, count) = self;
            let lanes = [0, 1, 2].map(|axis| points.map(|point| point[axis]));
            let mut vectors = VectorPoints::default();
            vectors.set::<F>(from_arrays(&lanes), count);
            let mut together = scalar_x4::<F>(from_arrays(&lanes), count)[..count].to_vec();
            let mut alone = Vec::new();
            for point in &points[..count] {
                alone.push(scalar::<F>(vec3::splat(*point)));
            }
            for (number, point) in points[..count].iter().enumerate() {
                together.extend(vectors.noise::<F>(number).to_array());
                let mut vector = VectorPoints::default();
                vector.set::<F>(vec3::splat(*point), 1);
                alone.extend(vector.noise::<F>(0).to_array());
            }
            [together, alone].map(|all| all.into_iter().map(f64::to_bits).collect())
        }
    }

    #[test]
    fn all_lanes_give_the_same_bits() {
        let mut rng = Random::new(7);
        for round in 0..10_000 {
            let size = if round % 8 == 0 { 1e12 } else { 50.0 };
            let points = std::array::from_fn(|_| rng.vector(size));
            let count = round % 4 + 1;
            let [together, alone] = SimdLevel::widest().run(All(points, count));
            assert_eq!(together, alone, "{points:?}");
            let [narrow, _] = SimdLevel::NARROW.run(All(points, count));
            assert_eq!(together, narrow, "{points:?}");
        }
    }
}
