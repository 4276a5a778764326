//! The cubic cells of the irradiance octree.

use glam::DVec3;

/// The coordinate offset of the cells, so that their indices are positive.
const FIRST: f64 = 1e7;
/// The level of the smallest cells: below the rounding error of coordinates with that offset.
const MIN_LEVEL: i32 = -38;
/// Slack for rounding of the size of a cube.
const SLACK: f64 = 1.0 + 1e-9;
/// Relative to coordinates, more than the rounding errors of the centres of cells.
const CENTRE_ERROR: f64 = 4.0 * f64::EPSILON;
/// The level of the single cell that holds everything.
const WHOLE_LEVEL: i32 = 41;

/// A cell of the octree: `corner` in units of its `2^level`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) level: i32,
    pub(super) corner: [i64; 3],
}

/// A cube.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cube {
    centre: DVec3,
    /// The length of an edge; infinite for the cell that holds everything.
    size: f64,
}

impl Cube {
    /// The cube that holds every point.
    pub(super) const EVERYTHING: Cube = Cube {
        centre: DVec3::ZERO,
        size: f64::INFINITY,
    };

    /// Tests if the concentric cube of twice the size may hold a point of a box, given by its centre and half its edge.
    pub(super) fn may_hold(&self, [centre, half]: [DVec3; 2]) -> bool {
        let away = (centre - self.centre).abs() - half;
        away.max_element() < self.size * SLACK
    }

    /// Mask of the octants, by [`Cell::child_index`], that [`Self::may_hold`] a point of a box, and of some that miss it
    /// narrowly.
    pub(super) fn octants_near(&self, [centre, half]: [DVec3; 2]) -> u32 {
        if self.size == f64::INFINITY {
            return 0xff;
        }
        // The centre of an octant is a quarter of the edge away, and its concentric cube reaches half an edge from there.
        let away = centre - self.centre;
        let slack = 0.01 * self.size + CENTRE_ERROR * (self.centre.abs() + FIRST);
        let reach = half + 0.5 * self.size + slack;
        let lower = (away + 0.25 * self.size).abs().cmplt(reach).bitmask();
        let upper = (away - 0.25 * self.size).abs().cmplt(reach).bitmask();
        let mut octants = 0xff;
        // The lower octants of an axis are at indices with its bit clear, the upper ones at the others.
        for (axis, mask) in [0x55, 0x33, 0x0f].into_iter().enumerate() {
            let (has_lower, has_upper) = (lower >> axis & 1, upper >> axis & 1);
            octants &= (has_lower * mask) | (has_upper * (mask << (1 << axis)));
        }
        octants
    }

    /// Tests if a point lies in the concentric cube of twice the size.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        let away = (point - self.centre).abs();
        away.x < self.size && away.y < self.size && away.z < self.size
    }
}

impl Cell {
    /// The cell of a point at a level.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "saturates far beyond any scene"
    )]
    pub(super) fn at(point: DVec3, level: i32) -> Cell {
        let size = f64::from(level).exp2();
        let corner = match level {
            WHOLE_LEVEL => DVec3::ZERO,
            _ => (point + FIRST) / size,
        };
        Cell {
            level,
            corner: corner.to_array().map(|c| c.floor() as i64),
        }
    }

    /// The cell of a sample that may be used within a distance.
    pub(super) fn around(point: DVec3, reach: f64) -> Cell {
        #[allow(clippy::cast_possible_truncation, reason = "an exponent of a double")]
        let level = (2.0 * reach).log2().floor() as i32;
        let level = level.clamp(MIN_LEVEL, WHOLE_LEVEL);
        let mut cell = Cell::at(point, level);
        let holds = |cell: Cell| {
            let cube = cell.cube();
            cube.holds(point - reach) && cube.holds(point + reach)
        };
        while !holds(cell) {
            cell = cell.parent();
        }
        cell
    }

    pub(super) fn parent(self) -> Cell {
        self.at_level(self.level + 1)
    }

    #[allow(
        clippy::cast_precision_loss,
        reason = "cell indices of scenes are smaller"
    )]
    pub(super) fn cube(&self) -> Cube {
        let size = f64::from(self.level).exp2();
        let corner = DVec3::from(self.corner.map(|c| c as f64));
        let (centre, size) = match self.level {
            WHOLE_LEVEL => return Cube::EVERYTHING,
            _ => ((corner + 0.5) * size - FIRST, size),
        };
        Cube { centre, size }
    }

    /// The concentric box whose edges are `2 half` times as long: its centre, and half its edge on each axis.
    pub(super) fn box_around(&self, half: f64) -> [DVec3; 2] {
        let cube = self.cube();
        [cube.centre, DVec3::splat(half * cube.size)]
    }

    /// The ancestor at this level.
    pub(super) fn at_level(self, level: i32) -> Cell {
        if level >= WHOLE_LEVEL {
            return Cell {
                level: WHOLE_LEVEL,
                corner: [0; 3],
            };
        }
        let up = level - self.level;
        Cell {
            level,
            corner: self.corner.map(|c| c >> up),
        }
    }

    /// The child index within its parent.
    pub(super) fn child_index(&self) -> usize {
        let [x, y, z] = self.corner.map(|c| usize::from(c & 1 == 1));
        x | y << 1 | z << 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn octants_near_a_box_are_not_left_out() {
        let mut rng = Random::new(3);
        let mut counts = [0; 2];
        for number in 0..40_000 {
            let level = number % 50 - 38;
            let size = f64::from(level).exp2();
            let mut random = |size: f64| {
                DVec3::new(
                    rng.uniform() - 0.5,
                    rng.uniform() - 0.5,
                    rng.uniform() - 0.5,
                ) * size
            };
            let child = Cell::at(random([100.0, 1e9][number as usize % 2]), level);
            let (cube, parent) = (child.cube(), child.parent().cube());
            let area = [cube.centre + random(3.0 * size), random(0.5 * size).abs()];
            let is_near = parent.octants_near(area) >> child.child_index() & 1 == 1;
            assert!(is_near || !cube.may_hold(area), "{child:?} {area:?}");
            counts[usize::from(is_near)] += 1;
        }
        assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
    }
}
