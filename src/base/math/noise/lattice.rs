//! Lattice noise: a linear function at each corner of a cell, selected by a hash and blended with smooth weights.
//!
//! Cells, weights and scalar noise are computed for four points at a time, such as the octaves of a sum: the latency of
//! the hash, four loads that depend on each other, is then paid once. Four points near each other mostly share a cell,
//! and then its coefficients too. Otherwise vector noise has its three components side by side, and the scalar noise of
//! one point its corners. Sums are in POV-Ray's order.

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

/// Index of the first coefficient of each corner of a cell. Bits 0, 1 and 2 of a corner's number are x, y and z: set for
/// the high side.
type CornerCoefficients = [u8; 8];

/// The cells of four points on each axis.
type Cells = [[i32; 4]; 3];

/// Four points within their cells.
struct CellPoints<F> {
    /// The offsets of the points from the low and from the high corner.
    offsets: [Vec3Lanes<F>; 2],
    /// The weights of the corners.
    weights: [F; 8],
}

impl<F: F64Lanes> CellPoints<F> {
    #[inline(always)]
    fn new(low: Vec3Lanes<F>) -> Self {
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

    /// The offsets of the points from a corner.
    #[inline(always)]
    fn offsets_from<const CORNER: usize>(&self) -> Vec3Lanes<F> {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        [
            self.offsets[dx][0],
            self.offsets[dy][1],
            self.offsets[dz][2],
        ]
    }
}

/// The coefficients of the corners of the first `count` of four cells.
#[inline(always)]
fn hash_cells(cells: &Cells, count: usize) -> [CornerCoefficients; 4] {
    let mut first = [[0; 8]; 4];
    let in_memory = in_memory(&mut first);
    for (point, first) in in_memory.iter_mut().enumerate().take(count) {
        hash_corners([cells[0][point], cells[1][point], cells[2][point]], first);
    }
    first
}

/// True if four points are in the same cell.
#[inline(always)]
fn is_one_cell(cells: &Cells) -> bool {
    let [x, y, z] = cells;
    *x == [x[0]; 4] && *y == [y[0]; 4] && *z == [z[0]; 4]
}

/// Sets the index of the first coefficient of each corner of a cell.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the hash is cut to 256 values"
)]
fn hash_corners([x, y, z]: [i32; 3], first: &mut CornerCoefficients) {
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
fn cells<F: F64Lanes>([x, y, z]: Vec3Lanes<F>) -> (Cells, Vec3Lanes<F>) {
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
fn far_cells(points: [[f64; 4]; 3], shifted: [[f64; 4]; 3]) -> (Cells, [[f64; 4]; 3]) {
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
fn linear<F: F64x4>(first: [u8; 4], offsets: Vec3Lanes<F>) -> F {
    let mut rows = [&[0.0; 4]; 4];
    for (row, first) in rows.iter_mut().zip(first) {
        *row = row_of(first);
    }
    linear_of(F::columns(rows), offsets)
}

/// The coefficients of a linear function.
#[inline(always)]
fn row_of(first: u8) -> &'static [f64; 4] {
    let row = RANDOM[usize::from(first)..].first_chunk();
    row.unwrap_or(&[0.0; 4])
}

#[inline(always)]
fn linear_of<F: F64Lanes>([constant, of_x, of_y, of_z]: [F; 4], [x, y, z]: Vec3Lanes<F>) -> F {
    F::splat(0.5) * constant + of_x * x + of_y * y + of_z * z
}

/// The linear functions at the corners of the cells of four points.
trait Corners {
    fn linear<F: F64x4>(&self, corner: usize, offsets: Vec3Lanes<F>) -> F;
}

/// Each point has a cell of its own.
impl Corners for [CornerCoefficients; 4] {
    #[inline(always)]
    fn linear<F: F64x4>(&self, corner: usize, offsets: Vec3Lanes<F>) -> F {
        let [a, b, c, d] = self;
        linear([a[corner], b[corner], c[corner], d[corner]], offsets)
    }
}

/// All points are in one cell.
impl Corners for CornerCoefficients {
    #[inline(always)]
    fn linear<F: F64x4>(&self, corner: usize, offsets: Vec3Lanes<F>) -> F {
        let [a, b, c, d] = *row_of(self[corner]);
        linear_of(
            [F::splat(a), F::splat(b), F::splat(c), F::splat(d)],
            offsets,
        )
    }
}

/// The raw scalar noise at the first `count` of four points far from each other.
#[inline(always)]
pub(super) fn scalar_apart<F: F64x4>(points: Vec3Lanes<F>, count: usize) -> F {
    let (cells, low) = cells(points);
    let first = hash_cells(&cells, count);
    CellPoints::new(low).scalar(&first)
}

/// The raw scalar noise at four points.
#[inline(always)]
pub(super) fn scalar_x4<F: F64x4>(points: Vec3Lanes<F>) -> F {
    let (cells, low) = cells(points);
    if is_one_cell(&cells) {
        let [first, ..] = hash_cells(&cells, 1);
        return CellPoints::new(low).scalar(&first);
    }
    let first = hash_cells(&cells, 4);
    CellPoints::new(low).scalar(&first)
}

impl<F: F64x4> CellPoints<F> {
    /// The raw scalar noise at each point.
    #[inline(always)]
    fn scalar<C: Corners>(&self, corners: &C) -> F {
        F::splat(0.0)
            + self.scalar_corner::<0b000, C>(corners)
            + self.scalar_corner::<0b001, C>(corners)
            + self.scalar_corner::<0b010, C>(corners)
            + self.scalar_corner::<0b011, C>(corners)
            + self.scalar_corner::<0b100, C>(corners)
            + self.scalar_corner::<0b101, C>(corners)
            + self.scalar_corner::<0b110, C>(corners)
            + self.scalar_corner::<0b111, C>(corners)
    }

    /// The contribution of a corner to the scalar noise of each point.
    #[inline(always)]
    fn scalar_corner<const CORNER: usize, C: Corners>(&self, corners: &C) -> F {
        self.weights[CORNER] * corners.linear(CORNER, self.offsets_from::<CORNER>())
    }
}

/// The vector noise at four points.
#[inline(always)]
pub(super) fn vector_x4<F: F64x4>(points: Vec3Lanes<F>) -> Vec3Lanes<F> {
    let (cells, low) = cells(points);
    if is_one_cell(&cells) {
        let [first, ..] = hash_cells(&cells, 1);
        return CellPoints::doubled(low).vector(&first);
    }
    let points = VectorPoints::new(&cells, low, 4);
    let [a, b, c, d] = [
        points.noise::<F>(0).to_array(),
        points.noise::<F>(1).to_array(),
        points.noise::<F>(2).to_array(),
        points.noise::<F>(3).to_array(),
    ];
    let [x, y, z, _] = F::columns([&a, &b, &c, &d]);
    [x, y, z]
}

impl<F: F64Lanes> CellPoints<F> {
    /// Points with twice their offsets, as vector noise needs them: the coefficients are half of POV-Ray's and the
    /// offsets doubled, both exactly, because the constant term is needed halved.
    #[inline(always)]
    fn doubled(low: Vec3Lanes<F>) -> Self {
        let mut points = CellPoints::new(low);
        let [low, high] = points.offsets;
        points.offsets = [add(low, low), add(high, high)];
        points
    }

    /// The vector noise at points in one cell, from doubled offsets. Each corner is adjacent to the previous one, as in
    /// POV-Ray.
    #[inline(always)]
    fn vector(&self, first: &CornerCoefficients) -> Vec3Lanes<F> {
        let mut sum = [F::splat(0.0); 3];
        self.add_corner::<0b000>(first, &mut sum);
        self.add_corner::<0b001>(first, &mut sum);
        self.add_corner::<0b011>(first, &mut sum);
        self.add_corner::<0b010>(first, &mut sum);
        self.add_corner::<0b110>(first, &mut sum);
        self.add_corner::<0b111>(first, &mut sum);
        self.add_corner::<0b101>(first, &mut sum);
        self.add_corner::<0b100>(first, &mut sum);
        sum
    }

    /// Adds the contribution of a corner.
    #[inline(always)]
    fn add_corner<const CORNER: usize>(&self, first: &CornerCoefficients, sum: &mut Vec3Lanes<F>) {
        let [constant, of_x, of_y, of_z] = vector_rows(first[CORNER]);
        let [x, y, z] = self.offsets_from::<CORNER>();
        for (axis, sum) in sum.iter_mut().enumerate() {
            let linear = F::splat(constant[axis])
                + F::splat(of_x[axis]) * x
                + F::splat(of_y[axis]) * y
                + F::splat(of_z[axis]) * z;
            *sum = *sum + self.weights[CORNER] * linear;
        }
    }
}

/// The coefficients of three linear functions side by side.
#[inline(always)]
fn vector_rows(first: u8) -> &'static [[f64; 4]; 4] {
    let rows = VECTOR_COEFFICIENTS.0[usize::from(first)..].first_chunk();
    rows.unwrap_or(&[[0.0; 4]; 4])
}

/// The points at which vector noise is wanted, one after the other.
pub(super) struct VectorPoints {
    first: [CornerCoefficients; 4],
    /// Twice the offsets of the points from the low and from the high corner.
    offsets: [[[f64; 4]; 3]; 2],
    weights: [[f64; 4]; 8],
}

impl VectorPoints {
    /// The first `count` of four points far from each other.
    #[inline(always)]
    pub(super) fn apart<F: F64Lanes>(points: Vec3Lanes<F>, count: usize) -> Self {
        let (cells, low) = cells(points);
        VectorPoints::new(&cells, low, count)
    }

    #[inline(always)]
    fn new<F: F64Lanes>(cells: &Cells, low: Vec3Lanes<F>, count: usize) -> Self {
        let first = hash_cells(cells, count);
        let points = CellPoints::doubled(low);
        let [low, high] = points.offsets;
        let [a, b, c, d, e, f, g, h] = points.weights;
        VectorPoints {
            first,
            offsets: [to_arrays(low), to_arrays(high)],
            weights: [
                a.to_array(),
                b.to_array(),
                c.to_array(),
                d.to_array(),
                e.to_array(),
                f.to_array(),
                g.to_array(),
                h.to_array(),
            ],
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

    /// The contribution of a corner.
    #[inline(always)]
    fn corner<F: F64Lanes, const CORNER: usize>(&self, point: usize) -> F {
        let [dx, dy, dz] = const { [CORNER & 1, CORNER >> 1 & 1, CORNER >> 2] };
        let [constant, of_x, of_y, of_z] = vector_rows(self.first[point][CORNER]);
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
            let lanes: Vec3Lanes<F> = from_arrays(&lanes);
            let vectors = VectorPoints::apart(lanes, count);
            let mut together = scalar_apart(lanes, count).to_array()[..count].to_vec();
            let mut alone = Vec::new();
            for point in &points[..count] {
                alone.push(scalar::<F>(vec3::splat(*point)));
            }
            let packet = to_arrays(vector_x4(lanes));
            for (number, point) in points[..count].iter().enumerate() {
                let [x, y, z, _] = vectors.noise::<F>(number).to_array();
                together.extend([x, y, z]);
                together.extend(packet.map(|axis| axis[number]));
                let vector = VectorPoints::apart::<F>(vec3::splat(*point), 1);
                let [x, y, z, _] = vector.noise::<F>(0).to_array();
                alone.extend([x, y, z, x, y, z]);
            }
            if count == 4 {
                together.extend(scalar_x4(lanes).to_array());
                alone.extend_from_within(..4);
            }
            [together, alone].map(|all| all.into_iter().map(f64::to_bits).collect())
        }
    }

    #[test]
    fn all_lanes_give_the_same_bits() {
        let mut rng = Random::new(7);
        let mut shared = 0;
        for round in 0..20_000 {
            let size = if round % 8 == 0 { 1e12 } else { 50.0 };
            let first = rng.vector(size);
            let spread = if round % 16 < 8 { size } else { 0.3 };
            let points: [DVec3; 4] = std::array::from_fn(|_| first + rng.vector(spread));
            let floors = points.map(DVec3::floor);
            shared += usize::from(floors == [floors[0]; 4]);
            let count = round % 4 + 1;
            let [together, alone] = SimdLevel::widest().run(All(points, count));
            assert_eq!(together, alone, "{points:?}");
            let [narrow, _] = SimdLevel::NARROW.run(All(points, count));
            assert_eq!(together, narrow, "{points:?}");
        }
        assert!(shared > 1000, "{shared} cells hold all four points");
    }
}
