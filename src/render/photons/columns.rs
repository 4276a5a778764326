//! Where photons lie, number by number, so that the distances of many are worked out together.

use super::Photon;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use glam::DVec3;

/// By this the distance of photons counts more that lie above or below the surface.
const FLATTENING: f64 = 16.0;

/// So many photons that follow one another are measured together.
pub(super) const BLOCK: usize = 16;

/// The places of photons, and the axes by which the map is divided there.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    /// x, y and z, each with a block of nothing at its end.
    places: [Vec<f32>; 3],
    axes: Vec<u8>,
}

/// How far away a few photons lie.
pub(super) struct Distances {
    /// Their squares.
    pub(super) squares: [f64; BLOCK],
    /// One bit for each that is near enough.
    pub(super) near: u32,
}

impl Columns {
    pub(super) fn new(photons: &[Photon]) -> Columns {
        let column = |axis: usize| {
            let nothing = std::iter::repeat_n(f32::INFINITY, BLOCK);
            let places = photons.iter().map(|photon| photon.place[axis]);
            places.chain(nothing).collect()
        };
        Columns {
            places: [0, 1, 2].map(column),
            axes: photons.iter().map(|photon| photon.axis % 3).collect(),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        let places = self.places.iter().map(|places| size_of_val(&places[..]));
        places.sum::<usize>() + self.axes.len()
    }

    /// How far behind a photon a point lies, along the axis by which it divides.
    #[inline]
    pub(super) fn beyond(&self, photon: usize, point: DVec3) -> f64 {
        let axis = usize::from(self.axes[photon]);
        point[axis] - f64::from(self.places[axis][photon])
    }

    /// The square of the distance of a photon, as in [`Self::distances`].
    #[inline]
    pub(super) fn distance_sq(&self, photon: usize, (point, normal): (DVec3, DVec3)) -> f64 {
        let [x, y, z] = &self.places;
        let x = f64::from(x[photon]) - point.x;
        let y = f64::from(y[photon]) - point.y;
        let z = f64::from(z[photon]) - point.z;
        measured([x, y, z], normal)
    }

    /// The distances of a block of photons from a point on a surface, or anywhere if the normal is zero.
    #[inline]
    pub(super) fn distances(
        &self,
        first: usize,
        (point, normal): (DVec3, DVec3),
        reach_sq: f64,
    ) -> Distances {
        let [x, y, z] = &self.places;
        let places = [block(x, first), block(y, first), block(z, first)];
        with_widest(
            #[inline(always)]
            |lanes| {
                let measuring = Measuring {
                    places,
                    point,
                    normal,
                    reach_sq,
                };
                lanes.run(measuring)
            },
        )
    }
}

#[inline(always)]
fn block(places: &[f32], first: usize) -> &[f32; BLOCK] {
    let block = places[first..].first_chunk();
    block.expect("a block of nothing comes last")
}

/// A block to be measured.
struct Measuring<'c> {
    places: [&'c [f32; BLOCK]; 3],
    point: DVec3,
    normal: DVec3,
    reach_sq: f64,
}

impl SimdKernel for Measuring<'_> {
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
                let x = self.places[axis];
                let places = [
                    f64::from(x[first]),
                    f64::from(x[first + 1]),
                    f64::from(x[first + 2]),
                    f64::from(x[first + 3]),
                ];
                to_photon[axis] = F::from_array(&places) - F::splat(point[axis]);
                axis += 1;
            }
            let square = measured(to_photon, self.normal);
            answer.squares[first..first + 4].copy_from_slice(&square.to_array());
            answer.near |= F::bitmask(square.lt(F::splat(self.reach_sq))) << first;
            first += 4;
        }
        answer
    }
}

/// The square of a distance, larger above or below the surface.
#[inline(always)]
fn measured<F: F64Lanes>([x, y, z]: [F; 3], normal: DVec3) -> F {
    let square = x * x + y * y + z * z;
    let [a, b, c] = [F::splat(normal.x), F::splat(normal.y), F::splat(normal.z)];
    let above = (a * x + b * y + c * z).abs();
    square * (F::splat(1.0) + F::splat(FLATTENING) * above)
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
            let place = (rng.vector(1.0), normal);
            let first = round % photons.len();
            let distances = columns.distances(first, place, 0.5);
            for number in first..photons.len().min(first + BLOCK) {
                let square = columns.distance_sq(number, place);
                assert_eq!(distances.squares[number - first], square);
                assert_eq!(distances.near >> (number - first) & 1 == 1, square < 0.5);
            }
        }
    }
}
