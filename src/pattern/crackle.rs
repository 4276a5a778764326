//! `crackle`: distances to points scattered one in each unit cube (Worley, "A Cellular Texture Basis Function",
//! SIGGRAPH 1996).

use super::{Pattern, Preparing, Spot, Value};
use crate::args::{Args, Parse, Word};
use crate::math::hash::hashed_cell;
use crate::math::mersenne;
use crate::math::noise::NoiseGenerator;
use glam::DVec3;

/// What is taken from coordinates before their cell is looked for.
const NUDGE: f64 = 1e-10;

#[derive(Clone, Copy, Debug)]
struct Crackle {
    /// The factors on the distances to the nearest, second and third point.
    form: DVec3,
    /// The exponent of the distance: 2 is Euclid's, 1 goes along the axes.
    metric: f64,
    /// Lifts the distances, as if the points stood beside the pattern.
    offset: f64,
    /// Whether cells are of one colour each.
    is_solid: bool,
}

#[derive(Debug)]
struct Prepared {
    crackle: Crackle,
    noise: NoiseGenerator,
}

pub(super) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Crackle {
        form: DVec3::new(-1.0, 1.0, 0.0),
        metric: 2.0,
        offset: 0.0,
        is_solid: false,
    }))
}

impl Pattern for Crackle {
    fn prepare(&self, with: &Preparing<'_>) -> Box<dyn Value> {
        Box::new(Prepared {
            crackle: *self,
            noise: with.noise,
        })
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Form => {
                args.accept(word)?;
                self.form = args.vector()?;
            }
            Word::Metric => {
                args.accept(word)?;
                self.metric = args.float()?;
            }
            Word::Offset => {
                args.accept(word)?;
                self.offset = args.float()?;
            }
            Word::Solid => self.is_solid = args.accept(word)?,
            _ => return Ok(false),
        }
        Ok(true)
    }
}

impl Value for Prepared {
    fn value(&self, point: DVec3, _spot: &Spot) -> f64 {
        let Crackle {
            form,
            metric,
            offset,
            is_solid,
        } = self.crackle;
        let nearest = if metric == 2.0 {
            let lift = offset * offset;
            let length = |d: DVec3| d.length_squared() + lift;
            nearest(point, length, length).with_distances(f64::sqrt)
        } else if metric == 1.0 {
            let length = |d: DVec3| d.x.abs() + d.y.abs() + d.z.abs() + offset;
            nearest(point, length, length)
        } else {
            let lift = offset.powf(metric);
            let root = 1.0 / metric;
            let length = |d| sum_of_powers(d, metric) + lift;
            let least = |gap| least_sum(gap, metric) + lift;
            nearest(point, length, least).with_distances(|sum| sum.powf(root))
        };
        if is_solid {
            return self.noise.noise(nearest.point);
        }
        let [d1, d2, d3] = nearest.distances;
        (form.x * d1 + form.y * d2 + form.z * d3).clamp(0.0, 1.0)
    }
}

/// The nearest point and the three least distances.
struct Nearest {
    distances: [f64; 3],
    point: DVec3,
}

impl Nearest {
    fn with_distances(self, change: impl Fn(f64) -> f64) -> Self {
        Nearest {
            distances: self.distances.map(change),
            ..self
        }
    }
}

/// What is found of the points about a place.
struct Looking<'l, L, G> {
    point: DVec3,
    home: [i64; 3],
    /// By axis, how far the cells from two before to two behind are away at least.
    gaps: [[f64; 5]; 3],
    length: &'l L,
    least: &'l G,
    found: Nearest,
}

/// Steps to the cells within one step along each axis, the nearest first.
const NEAR: [[i8; 3]; 27] = near();

const fn near() -> [[i8; 3]; 27] {
    let mut steps = [[0; 3]; 27];
    let mut count = 0;
    let mut far = 0;
    while far <= 3 {
        let mut number = 0;
        while number < 27 {
            let step = [number / 9 - 1, number / 3 % 3 - 1, number % 3 - 1];
            if step[0] * step[0] + step[1] * step[1] + step[2] * step[2] == far {
                steps[count] = step;
                count += 1;
            }
            number += 1;
        }
        far += 1;
    }
    steps
}

/// Looks through the cells about a point: all within one step along each axis, and those of the next layer along one
/// axis. `least` says how long a way is at least whose parts along the axes are no shorter than these, so that cells too
/// far away need not be looked into.
fn nearest(point: DVec3, length: impl Fn(DVec3) -> f64, least: impl Fn(DVec3) -> f64) -> Nearest {
    let home = super::cell(point - NUDGE);
    let gaps = [0, 1, 2].map(|axis: usize| {
        [-2, -1, 0, 1, 2].map(|step| {
            let low = home[axis].saturating_add(step) as f64;
            (low - point[axis]).max(point[axis] - (low + 1.0)).max(0.0)
        })
    });
    let mut looking = Looking {
        point,
        home,
        gaps,
        length: &length,
        least: &least,
        found: Nearest {
            distances: [f64::INFINITY; 3],
            point: DVec3::ZERO,
        },
    };
    for step in NEAR {
        looking.look(step);
    }
    for axis in 0..3 {
        for far in [-2, 2] {
            let mut step = [0; 3];
            step[axis] = far;
            if looking.is_too_far(step) {
                continue;
            }
            for number in 0..9 {
                step[(axis + 1) % 3] = number / 3 - 1;
                step[(axis + 2) % 3] = number % 3 - 1;
                looking.look(step);
            }
        }
    }
    looking.found
}

impl<L: Fn(DVec3) -> f64, G: Fn(DVec3) -> f64> Looking<'_, L, G> {
    /// Whether no point of a cell is among the three nearest.
    #[inline(always)]
    fn is_too_far(&self, step: [i8; 3]) -> bool {
        let gap = |axis: usize| self.gaps[axis][(step[axis] + 2).clamp(0, 4) as usize];
        (self.least)(DVec3::new(gap(0), gap(1), gap(2))) >= self.found.distances[2]
    }

    #[inline(always)]
    fn look(&mut self, step: [i8; 3]) {
        if self.is_too_far(step) {
            return;
        }
        let cell = [0, 1, 2].map(|axis| self.home[axis].saturating_add(i64::from(step[axis])));
        let candidate = point_of(cell);
        let distance = (self.length)(candidate - self.point);
        let [d1, d2, d3] = self.found.distances;
        if distance < d1 {
            self.found.distances = [distance, d1, d2];
            self.found.point = candidate;
        } else if distance < d2 {
            self.found.distances = [d1, distance, d2];
        } else if distance < d3 {
            self.found.distances[2] = distance;
        }
    }
}

/// The sum of the sizes of the parts to this power.
fn sum_of_powers(d: DVec3, exponent: f64) -> f64 {
    let d = d.abs();
    d.x.powf(exponent) + d.y.powf(exponent) + d.z.powf(exponent)
}

/// What such a sum is at least; nothing is known of it where small parts count most.
fn least_sum(gap: DVec3, exponent: f64) -> f64 {
    if exponent > 0.0 {
        sum_of_powers(gap, exponent)
    } else {
        f64::NEG_INFINITY
    }
}

/// The nearest of the points scattered over the cells, by the distance of this metric: 2 is Euclid's; 1 is the sum of
/// the coordinates with their signs, as `facets` has it in POV-Ray.
#[must_use]
pub fn nearest_feature(point: DVec3, metric: f64) -> DVec3 {
    let found = if metric == 2.0 {
        nearest(point, DVec3::length_squared, DVec3::length_squared)
    } else if metric == 1.0 {
        let signed = |d: DVec3| d.x + d.y + d.z;
        nearest(point, signed, |_| f64::NEG_INFINITY)
    } else {
        let length = |d| sum_of_powers(d, metric);
        nearest(point, length, |gap| least_sum(gap, metric))
    };
    found.point
}

/// The point of a cell.
#[inline]
fn point_of(cell: [i64; 3]) -> DVec3 {
    let corner = DVec3::from(cell.map(|c| c as f64));
    corner + DVec3::from(mersenne::three(hashed_cell(cell)))
}
