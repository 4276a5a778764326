//! The metrics of `crackle`, by which points are near or far.

use glam::DVec3;

/// How long a way is, by its parts along the axes, and before a root is taken.
#[derive(Debug)]
pub(super) enum Metric {
    /// The sum of their squares and of a number.
    Squares(f64),
    /// That of their sizes.
    Sizes(f64),
    /// That of their sizes to a power.
    Powers(f64, f64),
    /// Their sum.
    Signed,
}

impl Metric {
    /// How long a way is.
    pub(super) fn length(&self, d: DVec3) -> f64 {
        match self {
            Metric::Squares(lift) => d.length_squared() + lift,
            Metric::Sizes(lift) => d.x.abs() + d.y.abs() + d.z.abs() + lift,
            Metric::Powers(exponent, lift) => {
                let d = d.abs();
                d.x.powf(*exponent) + d.y.powf(*exponent) + d.z.powf(*exponent) + lift
            }
            Metric::Signed => d.x + d.y + d.z,
        }
    }

    /// How long a way is at least whose parts have at least these sizes; nothing is known of it where they need not count.
    pub(super) fn least(&self, gap: DVec3) -> f64 {
        match self {
            Metric::Squares(_) | Metric::Sizes(_) => self.length(gap),
            Metric::Powers(exponent, _) if *exponent > 0.0 => self.length(gap),
            Metric::Powers(..) | Metric::Signed => f64::NEG_INFINITY,
        }
    }

    /// Whether a way of this length is surely shorter than one across a whole cell.
    pub(super) fn is_within_a_cell(&self, length: f64) -> bool {
        /// More than what is taken from coordinates is missing to 1.
        const NEARLY_ONE: f64 = 0.99;
        match self {
            Metric::Squares(lift) | Metric::Sizes(lift) => length - lift < NEARLY_ONE,
            Metric::Powers(..) | Metric::Signed => false,
        }
    }

    /// A way of this length has no longer part; endless if nothing is known of it.
    pub(super) fn longest(&self, length: f64) -> f64 {
        match self {
            Metric::Powers(exponent, lift) if *exponent >= LEAST_EXPONENT => {
                (length - lift).powf(1.0 / exponent) * (1.0 + CARE)
            }
            _ => f64::INFINITY,
        }
    }

    /// True if [`crate::base::math::powers::power`] estimates these lengths: distances between cells are too short for their
    /// powers to leave its bounds.
    pub(super) fn has_estimates(&self) -> bool {
        match self {
            Metric::Powers(exponent, lift) => {
                (LEAST_EXPONENT..=MOST_EXPONENT).contains(exponent)
                    && (0.0..=MOST_LIFT).contains(lift)
            }
            _ => false,
        }
    }

    /// How many of the three least lengths a form asks for, at least one. Where each costs several powers the others are
    /// not looked for.
    pub(super) fn counted(&self, form: DVec3) -> usize {
        if form.z != 0.0 || !self.has_estimates() {
            3
        } else if form.y != 0.0 {
            2
        } else {
            1
        }
    }

    /// The distances for such lengths; nothing for those that do not count.
    pub(super) fn distances(&self, lengths: [f64; 3], counted: usize) -> [f64; 3] {
        match self {
            Metric::Squares(_) => lengths.map(f64::sqrt),
            Metric::Sizes(_) | Metric::Signed => lengths,
            Metric::Powers(exponent, _) => {
                let mut distances = [0.0; 3];
                for (distance, length) in distances.iter_mut().zip(lengths).take(counted) {
                    *distance = length.powf(1.0 / exponent);
                }
                distances
            }
        }
    }
}

/// More than the roundings of a power, as a share.
const CARE: f64 = 1e-12;
/// Powers with this exponent or a larger one round less than [`CARE`] to it.
const LEAST_EXPONENT: f64 = 0.01;
/// Larger powers of ways between cells are not estimated.
const MOST_EXPONENT: f64 = 32.0;
/// Nor are they with a larger number added.
const MOST_LIFT: f64 = 1e90;
