//! Noise generator 3: Perlin's gradient noise ("An Image Synthesizer", SIGGRAPH 1985) with POV-Ray's tables.

use super::lattice::to_i32;
use super::smooth;
use crate::base::math::rounding::floor;
use crate::base::math::sampling::hash::{bits, next};
use glam::DVec3;
use std::sync::LazyLock;

/// The number of gradients, and the period of the lattice in cells.
const COUNT: usize = 2048;
/// Offset of the lattice, so that its symmetry about the origin is out of sight.
const SHIFT: f64 = 10_000_000.023_157_213;
/// Random vectors shorter than this, squared, are rejected as gradients.
const SHORTEST_SQ: f64 = 1e-5;

/// The gradients, and the permutation that hashes lattice points to them.
#[derive(Debug)]
pub struct Perlin {
    gradients: Vec<DVec3>,
    permutation: Vec<u16>,
}

/// The tables, built on first use.
pub(super) fn tables() -> &'static Perlin {
    static TABLES: LazyLock<Perlin> = LazyLock::new(Perlin::new);
    &TABLES
}

impl Perlin {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the entries are at most 2048"
    )]
    fn new() -> Self {
        let mut state = 1;
        let mut component = || {
            state = next(state);
            (f64::from(bits(state) % 4096) - 2048.0) / 2048.0
        };
        let mut gradients = Vec::with_capacity(2 * COUNT + 2);
        while gradients.len() < COUNT {
            let vector = DVec3::new(component(), component(), component());
            if (SHORTEST_SQ..=1.0).contains(&vector.length_squared()) {
                gradients.push(vector * (1.0 / vector.length()));
            }
        }
        let mut permutation: Vec<u16> = (0..COUNT as u16).collect();
        permutation.push(0);
        for i in (2..=COUNT).rev().step_by(2) {
            state = next(state);
            permutation.swap(i, bits(state) as usize % COUNT);
        }
        permutation.truncate(COUNT);
        permutation.extend_from_within(..COUNT);
        gradients.extend_from_within(..COUNT);
        // An entry below 2049 plus a cell may index up to two entries past the end.
        permutation.extend_from_within(..2);
        gradients.extend_from_within(..2);
        Perlin {
            gradients,
            permutation,
        }
    }

    /// The noise at a point, about -0.7 to 0.7.
    #[inline(never)]
    pub(super) fn noise(&self, point: DVec3) -> f64 {
        let point = point + SHIFT;
        let (x, y, z) = (Axis::new(point.x), Axis::new(point.y), Axis::new(point.z));
        let [low, high] = x.cell.map(|cell| usize::from(self.permutation[cell]));
        let along_x = |dy: usize, dz: usize| {
            let at_corner = |first: usize, above: f64| {
                let row = first + y.cell[dy];
                let column = usize::from(self.permutation[row]) + z.cell[dz];
                let gradient = self.gradients[column];
                above * gradient.x + y.above[dy] * gradient.y + z.above[dz] * gradient.z
            };
            let [at_low, at_high] = x.above;
            mix(x.weight, at_corner(low, at_low), at_corner(high, at_high))
        };
        let along_y = |dz| mix(y.weight, along_x(0, dz), along_x(1, dz));
        mix(z.weight, along_y(0), along_y(1))
    }
}

/// A coordinate on the lattice.
struct Axis {
    /// The cell and its successor.
    cell: [usize; 2],
    /// Offset of the coordinate from either.
    above: [f64; 2],
    weight: f64,
}

impl Axis {
    #[allow(clippy::cast_sign_loss, reason = "the low bits are wanted")]
    #[inline(always)]
    fn new(t: f64) -> Self {
        let floor = to_i32(floor(t));
        let cell = floor as usize % COUNT;
        let above = t - f64::from(floor);
        Axis {
            cell: [cell, (cell + 1) % COUNT],
            above: [above, above - 1.0],
            weight: smooth(above),
        }
    }
}

fn mix(weight: f64, from: f64, to: f64) -> f64 {
    from + weight * (to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_are_those_of_pov_ray() {
        // docs/povray-shapes.md, section 14.
        let perlin = tables();
        let first = DVec3::new(0.604_425_069_4, 0.705_260_289_5, 0.370_510_808_8);
        assert!((perlin.gradients[0] - first).length() < 1e-10);
        assert_eq!(perlin.permutation[..6], [0, 1, 386, 3, 649, 1576]);
        assert_eq!(perlin.permutation.len(), 2 * COUNT + 2);
    }
}
