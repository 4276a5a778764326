//! The cubic cells of the irradiance octree.

use glam::DVec3;

/// The coordinate offset of the cells, so that their indices are positive.
const FIRST: f64 = 1e7;
/// The level of the smallest cells: below the rounding error of coordinates with that offset.
const MIN_LEVEL: i32 = -38;
/// Slack for rounding of the size of a cube.
const SLACK: f64 = 1.0 + 1e-9;
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
