//! Axis-aligned boxes that hold things.

use glam::{DAffine3, DVec3};

/// A box with faces along the axes; `min > max` on some axis means it is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Bounds = Bounds {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };
    /// The box that holds all space.
    pub const EVERYTHING: Bounds = Bounds {
        min: DVec3::NEG_INFINITY,
        max: DVec3::INFINITY,
    };

    /// The box between two opposite corners, given in any order.
    #[must_use]
    pub fn new(a: DVec3, b: DVec3) -> Self {
        Bounds {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// Whether no point lies in the box.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Whether every side is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// What the two share, perhaps empty.
    #[must_use]
    pub fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        }
    }

    /// The smallest box that holds this one and a point.
    #[must_use]
    pub fn with_point(&self, point: DVec3) -> Bounds {
        Bounds {
            min: self.min.min(point),
            max: self.max.max(point),
        }
    }

    /// The point in the middle.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The box around the eight transformed corners; everything stays everything and nothing, nothing.
    #[must_use]
    pub fn transformed(&self, to_from: &DAffine3) -> Bounds {
        if self.is_empty() {
            return Bounds::EMPTY;
        }
        if !self.is_finite() {
            return Bounds::EVERYTHING;
        }
        (0..8).fold(Bounds::EMPTY, |sum, corner| {
            let pick = |bit: u8, low: f64, high: f64| if corner & bit == 0 { low } else { high };
            let point = DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            );
            sum.with_point(to_from.transform_point3(point))
        })
    }
}
