//! Photon positions in structure-of-arrays form, so that distances are computed four at a time.

use super::Photon;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use glam::DVec3;

/// The factor by which distances above or below the surface count more.
const FLATTENING: f64 = 16.0;

/// The number of consecutive photons measured together.
pub(super) const BLOCK: usize = 16;

/// The positions of photons, and the splitting axes of the map.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    /// x, y and z, each with a block of padding at its end.
    positions: [Vec<f32>; 3],
    axes: Vec<u8>,
}

/// The distances of a block of photons.
pub(super) struct Distances {
    /// Squared distances.
    pub(super) squares: [f64; BLOCK],
    /// Mask of the photons within the radius.
    pub(super) near: u32,
}

impl Columns {
    pub(super) fn new(photons: &[Photon]) -> Columns {
        let column = |axis: usize| {
            let nothing = std::iter::repeat_n(f32::INFINITY, BLOCK);
            let positions = photons.iter().map(|photon| photon.position[axis]);
            positions.chain(nothing).collect()
        };
        Columns {
            positions: [0, 1, 2].map(column),
            axes: photons.iter().map(|photon| photon.axis % 3).collect(),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        let positions = self
            .positions
            .iter()
            .map(|positions| size_of_val(&positions[..]));
        positions.sum::<usize>() + self.axes.len()
    }

    /// The coordinate of a point along the splitting axis of a photon, and that of the photon.
    #[inline]
    pub(super) fn split(&self, photon: usize, point: DVec3) -> [f64; 2] {
        let axis = usize::from(self.axes[photon]);
        [point[axis], f64::from(self.positions[axis][photon])]
    }

    /// The squared distance of a photon, as in [`Self::distances`].
    #[inline]
    pub(super) fn distance_sq(&self, photon: usize, point: DVec3, normal: DVec3) -> f64 {
        let [x, y, z] = &self.positions;
        let x = f64::from(x[photon]) - point.x;
        let y = f64::from(y[photon]) - point.y;
        let z = f64::from(z[photon]) - point.z;
        flattened_sq([x, y, z], normal)
    }

    /// The distances of a block of photons from a point on a surface, or in space if the normal is zero.
    #[inline]
    pub(super) fn distances(
        &self,
        first: usize,
        point: DVec3,
        normal: DVec3,
        radius_sq: f64,
    ) -> Distances {
        let [x, y, z] = &self.positions;
        let positions = [block(x, first), block(y, first), block(z, first)];
        with_widest(
            #[inline(always)]
            |lanes| {
                let kernel = DistanceKernel {
                    positions,
                    point,
                    normal,
                    radius_sq,
                };
                lanes.run(kernel)
            },
        )
    }
}

#[inline(always)]
fn block(positions: &[f32], first: usize) -> &[f32; BLOCK] {
    let block = positions[first..].first_chunk();
    block.expect("a block of nothing comes last")
}

/// The distance computation of a block.
struct DistanceKernel<'c> {
    positions: [&'c [f32; BLOCK]; 3],
    point: DVec3,
    normal: DVec3,
    radius_sq: f64,
}

impl SimdKernel for DistanceKernel<'_> {
    type Output = Distances;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Distances {
        let mut answer = Distances {
            squares: [0.0; BLOCK],
            near: 0,
        };
        let point = self.point.to_array();
        let mut first = 0;
        while first < BLOCK {
            let mut to_photon = [F::splat(0.0); 3];
            let mut axis = 0;
            while axis < 3 {
                let x = self.positions[axis];
                let positions = [
                    f64::from(x[first]),
                    f64::from(x[first + 1]),
                    f64::from(x[first + 2]),
                    f64::from(x[first + 3]),
                ];
                to_photon[axis] = F::from_array(&positions) - F::splat(point[axis]);
                axis += 1;
            }
            let square = flattened_sq(to_photon, self.normal);
            answer.squares[first..first + 4].copy_from_slice(&square.to_array());
            answer.near |= F::bitmask(square.lt(F::splat(self.radius_sq))) << first;
            first += 4;
        }
        answer
    }
}

/// A squared distance, larger above or below the surface.
#[inline(always)]
fn flattened_sq<F: F64Lanes>([x, y, z]: [F; 3], normal: DVec3) -> F {
    let square = x * x + y * y + z * z;
    let [a, b, c] = [F::splat(normal.x), F::splat(normal.y), F::splat(normal.z)];
    let above = (a * x + b * y + c * z).abs();
    square + above * square * F::splat(FLATTENING)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn a_block_is_measured_as_each_photon_is() {
        let mut rng = Random::new(11);
        let photons: Vec<Photon> = (0..40)
            .map(|_| Photon::new(rng.vector(1.0), Rgb::WHITE, DVec3::Y))
            .collect();
        let columns = Columns::new(&photons);
        for round in 0..200 {
            let normal = [DVec3::ZERO, rng.vector(1.0)][round % 2];
            let point = rng.vector(1.0);
            let first = round % photons.len();
            let distances = columns.distances(first, point, normal, 0.5);
            for number in first..photons.len().min(first + BLOCK) {
                let square = columns.distance_sq(number, point, normal);
                assert_eq!(distances.squares[number - first], square);
                assert_eq!(distances.near >> (number - first) & 1 == 1, square < 0.5);
            }
        }
    }
}
