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
            let squares = nearest(point, |d| d.length_squared() + lift);
            squares.with_distances(f64::sqrt)
        } else if metric == 1.0 {
            nearest(point, |d| d.x.abs() + d.y.abs() + d.z.abs() + offset)
        } else {
            let lift = offset.powf(metric);
            let length = |d: DVec3| {
                let d = d.abs();
                d.x.powf(metric) + d.y.powf(metric) + d.z.powf(metric) + lift
            };
            let root = 1.0 / metric;
            nearest(point, length).with_distances(|sum| sum.powf(root))
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

/// Looks through the cells about a point: all within one step along each axis, and those of the next layer along one
/// axis.
fn nearest(point: DVec3, length: impl Fn(DVec3) -> f64) -> Nearest {
    let home = super::cell(point - NUDGE);
    let mut found = Nearest {
        distances: [f64::INFINITY; 3],
        point: DVec3::ZERO,
    };
    for dx in -2..=2_i64 {
        for dy in -2..=2_i64 {
            for dz in -2..=2_i64 {
                let far = [dx, dy, dz].iter().filter(|d| d.abs() == 2).count();
                if far > 1 {
                    continue;
                }
                let cell = [dx, dy, dz];
                let cell = [0, 1, 2].map(|i: usize| home[i].saturating_add(cell[i]));
                let candidate = point_of(cell);
                let distance = length(candidate - point);
                let [d1, d2, d3] = found.distances;
                if distance < d1 {
                    found.distances = [distance, d1, d2];
                    found.point = candidate;
                } else if distance < d2 {
                    found.distances = [d1, distance, d2];
                } else if distance < d3 {
                    found.distances[2] = distance;
                }
            }
        }
    }
    found
}

/// The nearest of the points scattered over the cells, by the distance of this metric: 2 is Euclid's; 1 is the sum of
/// the coordinates with their signs, as `facets` has it in POV-Ray.
#[must_use]
pub fn nearest_feature(point: DVec3, metric: f64) -> DVec3 {
    let found = if metric == 2.0 {
        nearest(point, DVec3::length_squared)
    } else if metric == 1.0 {
        nearest(point, |d| d.x + d.y + d.z)
    } else {
        nearest(point, |d| {
            let d = d.abs();
            d.x.powf(metric) + d.y.powf(metric) + d.z.powf(metric)
        })
    };
    found.point
}

/// The point of a cell.
fn point_of(cell: [i64; 3]) -> DVec3 {
    let first = hashed_cell(cell);
    let corner = DVec3::from(cell.map(|c| c as f64));
    let random = [0, 1, 2].map(|i| mersenne::random(first + i));
    corner + DVec3::from(random)
}
