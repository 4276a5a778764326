//! The distance metrics of `crackle`.

use glam::DVec3;

/// Length of a vector from its components, before the root.
#[derive(Debug)]
pub(super) enum Metric {
    /// The sum of squares, plus an offset.
    Euclidean(f64),
    /// The sum of absolute values, plus an offset.
    Manhattan(f64),
    /// The sum of absolute values to the power of an exponent, plus an offset.
    Minkowski(f64, f64),
    /// The sum of the components.
    SignedSum,
}

impl Metric {
    /// The length of a vector.
    pub(super) fn length(&self, d: DVec3) -> f64 {
        match self {
            Metric::Euclidean(offset) => d.length_squared() + offset,
            Metric::Manhattan(offset) => d.x.abs() + d.y.abs() + d.z.abs() + offset,
            Metric::Minkowski(exponent, offset) => {
                let d = d.abs();
                d.x.powf(*exponent) + d.y.powf(*exponent) + d.z.powf(*exponent) + offset
            }
            Metric::SignedSum => d.x + d.y + d.z,
        }
    }

    /// Lower bound on the length of vectors whose components have at least these absolute values; `-∞` if larger
    /// components can give smaller lengths.
    pub(super) fn lower_bound(&self, gap: DVec3) -> f64 {
        match self {
            Metric::Euclidean(_) | Metric::Manhattan(_) => self.length(gap),
            Metric::Minkowski(exponent, _) if *exponent > 0.0 => self.length(gap),
            Metric::Minkowski(..) | Metric::SignedSum => f64::NEG_INFINITY,
        }
    }

    /// True if the length is surely below that of a vector across a whole cell.
    pub(super) fn is_below_cell_width(&self, length: f64) -> bool {
        /// Below 1 by more than the offset that is subtracted from coordinates.
        const NEARLY_ONE: f64 = 0.99;
        match self {
            Metric::Euclidean(offset) | Metric::Manhattan(offset) => length - offset < NEARLY_ONE,
            Metric::Minkowski(..) | Metric::SignedSum => false,
        }
    }

    /// Upper bound on the components of a vector of this length; infinite if unknown.
    pub(super) fn max_component(&self, length: f64) -> f64 {
        match self {
            Metric::Minkowski(exponent, offset) if *exponent >= MIN_EXPONENT => {
                (length - offset).powf(1.0 / exponent) * (1.0 + MARGIN)
            }
            _ => f64::INFINITY,
        }
    }

    /// True if [`crate::base::math::powers::power`] can estimate the lengths: distances between cells are so short that
    /// their powers stay within its bounds.
    pub(super) fn has_estimates(&self) -> bool {
        match self {
            Metric::Minkowski(exponent, offset) => {
                (MIN_EXPONENT..=MAX_EXPONENT).contains(exponent)
                    && (0.0..=MAX_OFFSET).contains(offset)
            }
            _ => false,
        }
    }

    /// Number of the three smallest lengths that must be exact for these weights, at least one. It is below 3 only
    /// where an exact length costs several powers.
    pub(super) fn needed(&self, form: DVec3) -> usize {
        if form.z != 0.0 || !self.has_estimates() {
            3
        } else if form.y != 0.0 {
            2
        } else {
            1
        }
    }

    /// The distances for these lengths. Those after the first `needed` are unspecified.
    pub(super) fn distances(&self, lengths: [f64; 3], needed: usize) -> [f64; 3] {
        match self {
            Metric::Euclidean(_) => lengths.map(f64::sqrt),
            Metric::Manhattan(_) | Metric::SignedSum => lengths,
            Metric::Minkowski(exponent, _) => {
                let mut distances = [0.0; 3];
                for (distance, length) in distances.iter_mut().zip(lengths).take(needed) {
                    *distance = length.powf(1.0 / exponent);
                }
                distances
            }
        }
    }
}

/// Relative margin, above the rounding error of a power.
const MARGIN: f64 = 1e-12;
/// Smallest exponent for which the rounding error of a power is below [`MARGIN`].
const MIN_EXPONENT: f64 = 0.01;
/// Largest exponent for which powers are estimated.
const MAX_EXPONENT: f64 = 32.0;
/// Largest offset with which powers are estimated.
const MAX_OFFSET: f64 = 1e90;
