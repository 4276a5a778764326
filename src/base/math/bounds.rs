//! Axis-aligned bounding boxes.

use glam::{DAffine3, DVec3};

/// Relative difference of coordinates or distances that are the same but for the roundings of different transforms, which
/// are a few units in the last digit (2^-52); this is 64 of them.
pub const COINCIDENT: f64 = 1.0 / (1u64 << 46) as f64;

/// An axis-aligned bounding box. It is empty if `min > max` on some axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The empty box.
    pub const EMPTY: Bounds = Bounds {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };
    /// The unbounded box: all of space.
    pub const EVERYTHING: Bounds = Bounds {
        min: DVec3::NEG_INFINITY,
        max: DVec3::INFINITY,
    };

    /// The box spanned by two opposite corners, in any order.
    #[must_use]
    pub fn new(a: DVec3, b: DVec3) -> Self {
        Bounds {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// True if the box contains no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// True if both corners are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The overlap of both boxes, possibly empty.
    #[must_use]
    pub fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        }
    }

    /// The overlap of both boxes; a flat box where they miss each other by no more than the roundings of their
    /// coordinates.
    #[must_use]
    pub fn touching_intersection(&self, other: &Bounds) -> Bounds {
        let shared = self.intersection(other);
        if self.is_empty() || other.is_empty() || !shared.is_empty() {
            return shared;
        }
        let finite =
            |end: DVec3| DVec3::select(end.abs().cmplt(DVec3::INFINITY), end.abs(), DVec3::ZERO);
        let ends = [self.min, self.max, other.min, other.max].map(finite);
        let size = ends.into_iter().fold(DVec3::ZERO, DVec3::max);
        let gap = shared.min - shared.max;
        let is_flat = gap.cmpgt(DVec3::ZERO) & gap.cmple(COINCIDENT * size);
        Bounds {
            min: DVec3::select(is_flat, shared.max, shared.min),
            max: DVec3::select(is_flat, shared.min, shared.max),
        }
    }

    /// The bounds and a few roundings of their largest finite coordinate around them.
    #[must_use]
    pub fn with_slack(&self) -> Bounds {
        let finite = |v: DVec3| DVec3::select(v.abs().cmplt(DVec3::INFINITY), v.abs(), DVec3::ZERO);
        let slack = 8.0 * f64::EPSILON * finite(self.min).max(finite(self.max)).max_element();
        Bounds::new(self.min - slack, self.max + slack)
    }

    /// The smallest box that contains this one and `point`.
    #[must_use]
    pub fn with_point(&self, point: DVec3) -> Bounds {
        Bounds {
            min: self.min.min(point),
            max: self.max.max(point),
        }
    }

    /// The centre of the box.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The bounds of the eight transformed corners. An empty box stays empty, one that is not finite becomes
    /// [`Bounds::EVERYTHING`].
    #[must_use]
    pub fn transformed(&self, to_from: &DAffine3) -> Bounds {
        if self.is_empty() {
            return Bounds::EMPTY;
        }
        if !self.is_finite() {
            return Bounds::EVERYTHING;
        }
        (0..8).fold(Bounds::EMPTY, |bounds, corner| {
            let pick = |bit: u8, low: f64, high: f64| if corner & bit == 0 { low } else { high };
            let point = DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            );
            bounds.with_point(to_from.transform_point3(point))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_but_for_rounding_share_a_flat_box() {
        let low = Bounds::new(DVec3::ZERO, DVec3::new(1.0, 0.3, 1.0));
        let high = Bounds::new(DVec3::new(0.0, 0.1 + 0.2, 0.0), DVec3::ONE);
        let shared = low.touching_intersection(&high);
        assert!(low.intersection(&high).is_empty() && !shared.is_empty());
        assert_eq!((shared.min.y, shared.max.y), (0.3, 0.1 + 0.2));
        let apart = Bounds::new(DVec3::new(0.0, 0.300_001, 0.0), DVec3::ONE);
        assert!(low.touching_intersection(&apart).is_empty());
    }

    #[test]
    fn nothing_shares_nothing() {
        for other in [
            Bounds::EVERYTHING,
            Bounds::EMPTY,
            Bounds::new(DVec3::ZERO, DVec3::ONE),
        ] {
            assert!(Bounds::EMPTY.touching_intersection(&other).is_empty());
            assert!(other.touching_intersection(&Bounds::EMPTY).is_empty());
        }
    }
}
