//! `crackle`: distances to feature points, one at random in each unit cell (Worley, "A Cellular Texture Basis
//! Function", SIGGRAPH 1996).

mod metric;

use crate::base::args::{Args, Parse, Word, since_3_8};
use crate::base::math::noise::NoiseGenerator;
use crate::base::math::powers::{POWER_ERROR, power};
use crate::base::math::sampling::hash::hashed_cell;
use crate::base::math::sampling::mersenne;
use crate::base::math::simd::{F64Lanes, SimdKernel, with_widest};
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use metric::Metric;
use std::cell::RefCell;

/// Subtracted from coordinates before their cell is determined.
const NUDGE: f64 = 1e-10;

#[derive(Clone, Copy, Debug)]
struct Crackle {
    /// The weights of the distances to the nearest, second and third feature point.
    form: DVec3,
    /// The exponent of the metric: 2 is Euclidean, 1 is Manhattan.
    metric: f64,
    /// Distance of the feature points from the space of the pattern, along a fourth axis.
    offset: f64,
    /// True if each cell has one value.
    is_solid: bool,
    period: Period,
}

/// Numbers of cells after which the pattern repeats along the axes; 0 along axes without repetition.
type Period = [i64; 3];

/// The period of a pattern that does not repeat.
const ENDLESS: Period = [0; 3];

#[derive(Debug)]
struct Prepared {
    form: DVec3,
    metric: Metric,
    is_solid: bool,
    period: Period,
    noise: NoiseGenerator,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Crackle {
        form: DVec3::new(-1.0, 1.0, 0.0),
        metric: 2.0,
        offset: 0.0,
        is_solid: false,
        period: ENDLESS,
    }))
}

impl Pattern for Crackle {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        let Crackle {
            form,
            metric,
            offset,
            is_solid,
            period,
        } = *self;
        let metric = if metric == 2.0 {
            Metric::Euclidean(offset * offset)
        } else if metric == 1.0 {
            Metric::Manhattan(offset)
        } else {
            Metric::Minkowski(metric, offset.powf(metric))
        };
        Box::new(Prepared {
            form,
            metric,
            is_solid,
            period,
            noise: context.noise,
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
            Word::Repeat => {
                args.accept(word)?;
                since_3_8(args, word, Word::Crackle)?;
                self.period = read_period(args)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// Reads the vector after `repeat`, whose components are rounded down.
#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
fn read_period(args: &mut dyn Args) -> Parse<Period> {
    let at = args.span();
    let period = args.vector()?;
    if period.min_element() < 0.0 {
        let error = Diagnostic::error(
            at.to(args.last_span()),
            "the components of `repeat` in `crackle` must not be negative",
        );
        return Err(Box::new(
            error.with_hint("0 means no repetition along that axis."),
        ));
    }
    Ok(period.to_array().map(|cells| cells as i64))
}

impl PatternEval for Prepared {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let metric = &self.metric;
        if self.is_solid {
            let nearest = nearest_point(point, metric, self.period);
            return self
                .noise
                .noise(nearest + to_first_period(point, self.period));
        }
        let needed = metric.needed(self.form);
        let [d1, d2, d3] = metric.distances(nearest(point, metric, needed, self.period), needed);
        (self.form.x * d1 + self.form.y * d2 + self.form.z * d3).clamp(0.0, 1.0)
    }
}

/// Margins on estimates of the smallest lengths, relative and absolute. They cover the errors of two estimates, one too
/// large and one too small.
const ESTIMATE_MARGIN: [f64; 2] = [4.0 * POWER_ERROR, 1e-90];
/// Number of cells within one step along each axis.
const CELLS: usize = 27;
/// Number of cells whose neighbourhoods a thread caches: successive queries tend to be close together.
const CACHED_CELLS: usize = 64;

/// The feature points of a cell and its neighbours, padded by one at infinity.
#[derive(Clone, Copy)]
struct Neighbourhood {
    cell: [i64; 3],
    points: [[f64; CELLS + 1]; 3],
}

thread_local! {
    static CACHE: RefCell<Vec<Neighbourhood>> = const { RefCell::new(Vec::new()) };
}

impl Neighbourhood {
    /// An unused entry, without points.
    const UNUSED: Neighbourhood = Neighbourhood {
        cell: [i64::MIN; 3],
        points: [[f64::INFINITY; CELLS + 1]; 3],
    };

    fn new(cell: [i64; 3], period: Period) -> Neighbourhood {
        let mut neighbourhood = Neighbourhood {
            cell,
            ..Neighbourhood::UNUSED
        };
        for number in 0..CELLS {
            let step = [number / 9, number / 3 % 3, number % 3].map(|step| step as i64 - 1);
            let point = point_of(offset_cell(cell, step), period);
            for axis in 0..3 {
                neighbourhood.points[axis][number] = point[axis];
            }
        }
        neighbourhood
    }

    fn point(&self, number: usize) -> DVec3 {
        let [x, y, z] = &self.points;
        DVec3::new(x[number], y[number], z[number])
    }

    /// Calls `visit` with the neighbourhood of a cell, from the cache of the thread if the pattern does not repeat.
    fn with<R>(cell: [i64; 3], period: Period, visit: impl FnOnce(&Neighbourhood) -> R) -> R {
        if period != ENDLESS {
            return visit(&Neighbourhood::new(cell, period));
        }
        CACHE.with_borrow_mut(|entries| {
            if entries.is_empty() {
                entries.resize(CACHED_CELLS, Neighbourhood::UNUSED);
            }
            let neighbourhood = &mut entries[hashed_cell(cell) as usize % CACHED_CELLS];
            if neighbourhood.cell != cell || cell == Neighbourhood::UNUSED.cell {
                *neighbourhood = Neighbourhood::new(cell, ENDLESS);
            }
            visit(neighbourhood)
        })
    }
}

/// Kernel for the lengths to the points of a neighbourhood, four points at a time, and the three smallest of them. For
/// [`Metric::Minkowski`] they are estimates.
#[derive(Clone, Copy)]
struct LengthKernel<'a> {
    neighbourhood: &'a Neighbourhood,
    point: DVec3,
    metric: &'a Metric,
}

impl SimdKernel for LengthKernel<'_> {
    type Output = ([f64; 3], [[f64; 4]; (CELLS + 1) / 4]);

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> Self::Output {
        let [x, y, z] = self
            .neighbourhood
            .points
            .each_ref()
            .map(|axis| axis.as_chunks().0);
        let DVec3 {
            x: px,
            y: py,
            z: pz,
        } = self.point;
        let (px, py, pz) = (F::splat(px), F::splat(py), F::splat(pz));
        let infinity = F::splat(f64::INFINITY);
        let mut least = [infinity; 3];
        let mut lengths = [[0.0; 4]; (CELLS + 1) / 4];
        for chunk in 0..x.len() {
            let dx = F::from_array(&x[chunk]) - px;
            let dy = F::from_array(&y[chunk]) - py;
            let dz = F::from_array(&z[chunk]) - pz;
            let length = match self.metric {
                Metric::Manhattan(offset) => {
                    let sum = dx.abs() + dy.abs() + dz.abs();
                    sum + F::splat(*offset)
                }
                Metric::Euclidean(offset) => {
                    let sum = dx * dx + dy * dy + dz * dz;
                    sum + F::splat(*offset)
                }
                Metric::Minkowski(exponent, offset) => {
                    let of_x = power(dx.abs(), *exponent);
                    let of_y = power(dy.abs(), *exponent);
                    let of_z = power(dz.abs(), *exponent);
                    let sum = of_x + of_y + of_z + F::splat(*offset);
                    // The padding, a point at infinity.
                    F::select(dx.lt(infinity), sum, infinity)
                }
                Metric::SignedSum => infinity,
            };
            lengths[chunk] = length.to_array();
            let second = length.lane_max(least[0]);
            least[0] = length.lane_min(least[0]);
            let third = second.lane_max(least[1]);
            least[1] = second.lane_min(least[1]);
            least[2] = third.lane_min(least[2]);
        }
        let [first, second, third] = [
            least[0].to_array(),
            least[1].to_array(),
            least[2].to_array(),
        ];
        let lanes = [0, 1, 2, 3];
        let [a, b, c, d] = lanes.map(
            #[inline(always)]
            |lane: usize| [first[lane], second[lane], third[lane]],
        );
        (merged(merged(a, b), merged(c, d)), lengths)
    }
}

/// The three smallest of two sorted triples, sorted.
#[inline(always)]
fn merged(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let crossed = a[0].lane_max(b[1]).lane_min(a[1].lane_max(b[0]));
    [
        a[0].lane_min(b[0]),
        a[0].lane_max(b[0]).lane_min(a[1].lane_min(b[1])),
        a[2].lane_min(b[2]).lane_min(crossed),
    ]
}

/// Inserts a length into the sorted three smallest.
#[inline(always)]
fn insert(smallest: &mut [f64; 3], length: f64) {
    let [d1, d2, d3] = *smallest;
    if length < d1 {
        *smallest = [length, d1, d2];
    } else if length < d2 {
        *smallest = [d1, length, d2];
    } else if length < d3 {
        smallest[2] = length;
    }
}

/// The three smallest lengths from a point to feature points, of which only the first `needed` are exact. Searches all
/// cells within one step along each axis, and those two steps away along one axis.
fn nearest(point: DVec3, metric: &Metric, needed: usize, period: Period) -> [f64; 3] {
    let cell = crate::scene::pattern::cell(point - NUDGE);
    let mut smallest = Neighbourhood::with(cell, period, |neighbourhood| {
        let least = LengthKernel {
            neighbourhood,
            point,
            metric,
        };
        match metric {
            Metric::Euclidean(_) | Metric::Manhattan(_) => least.in_lanes().0,
            Metric::Minkowski(..) if metric.has_estimates() => least.by_estimates(needed),
            Metric::Minkowski(..) | Metric::SignedSum => least.exact(|_| true),
        }
    });
    let last = needed - 1;
    if metric.is_below_cell_width(smallest[last]) {
        return smallest;
    }
    let max_component = metric.max_component(smallest[last]);
    let is_near = |gap: DVec3, smallest: &[f64; 3]| {
        gap.max_element() <= max_component && metric.lower_bound(gap) < smallest[last]
    };
    next_layer(cell, point, &mut smallest, is_near, |smallest, cell| {
        insert(smallest, metric.length(point_of(cell, period) - point));
    });
    smallest
}

impl LengthKernel<'_> {
    fn in_lanes(&self) -> ([f64; 3], [[f64; 4]; (CELLS + 1) / 4]) {
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(*self),
        )
    }

    /// The `needed` smallest lengths, exact. Points are skipped if their estimates exclude them.
    fn by_estimates(&self, needed: usize) -> [f64; 3] {
        let (least, estimates) = self.in_lanes();
        let [relative, absolute] = ESTIMATE_MARGIN;
        let limit = least[needed - 1] * (1.0 + relative) + absolute;
        self.exact(|number| {
            let is_excluded = estimates[number / 4][number % 4] > limit;
            !is_excluded
        })
    }

    /// The three smallest lengths, exact, among the points for which `is_candidate` holds.
    fn exact(&self, is_candidate: impl Fn(usize) -> bool) -> [f64; 3] {
        let mut smallest = [f64::INFINITY; 3];
        for number in (0..CELLS).filter(|&number| is_candidate(number)) {
            let offset = self.neighbourhood.point(number) - self.point;
            insert(&mut smallest, self.metric.length(offset));
        }
        smallest
    }
}

/// The nearest feature point.
fn nearest_point(point: DVec3, metric: &Metric, period: Period) -> DVec3 {
    let cell = crate::scene::pattern::cell(point - NUDGE);
    let mut best = (f64::INFINITY, DVec3::ZERO);
    let offer = |best: &mut (f64, DVec3), candidate: DVec3| {
        let length = metric.length(candidate - point);
        if length < best.0 {
            *best = (length, candidate);
        }
    };
    Neighbourhood::with(cell, period, |neighbourhood| {
        (0..CELLS).for_each(|number| offer(&mut best, neighbourhood.point(number)));
    });
    let is_near = |gap, best: &(f64, DVec3)| metric.lower_bound(gap) < best.0;
    next_layer(cell, point, &mut best, is_near, |best, cell| {
        offer(best, point_of(cell, period));
    });
    best.1
}

/// Offers the cells two steps away along one axis, for each side of the neighbourhood that is near enough
/// to matter.
fn next_layer<T>(
    cell: [i64; 3],
    point: DVec3,
    best: &mut T,
    is_near: impl Fn(DVec3, &T) -> bool,
    offer: impl Fn(&mut T, [i64; 3]),
) {
    for axis in 0..3 {
        for two_steps in [-2, 2] {
            let low = cell[axis].saturating_add(two_steps) as f64;
            let mut gap = DVec3::ZERO;
            gap[axis] = (low - point[axis]).max(point[axis] - (low + 1.0)).max(0.0);
            if !is_near(gap, best) {
                continue;
            }
            let mut step = [0; 3];
            step[axis] = two_steps;
            for number in 0..9 {
                step[(axis + 1) % 3] = number / 3 - 1;
                step[(axis + 2) % 3] = number % 3 - 1;
                offer(best, offset_cell(cell, step));
            }
        }
    }
}

fn offset_cell(cell: [i64; 3], step: [i64; 3]) -> [i64; 3] {
    let [x, y, z] = cell;
    [
        x.saturating_add(step[0]),
        y.saturating_add(step[1]),
        z.saturating_add(step[2]),
    ]
}

/// The nearest feature point, by the metric with this exponent: 2 is Euclidean; 1 is the signed sum of the coordinates,
/// as for `facets` in POV-Ray.
#[must_use]
pub fn nearest_feature(point: DVec3, metric: f64) -> DVec3 {
    if metric == 2.0 {
        nearest_point(point, &Metric::Euclidean(0.0), ENDLESS)
    } else if metric == 1.0 {
        nearest_point(point, &Metric::SignedSum, ENDLESS)
    } else {
        nearest_point(point, &Metric::Minkowski(metric, 0.0), ENDLESS)
    }
}

/// The feature point of a cell.
#[inline]
fn point_of(cell: [i64; 3], period: Period) -> DVec3 {
    let corner = DVec3::from(cell.map(|c| c as f64));
    let number = if period == ENDLESS {
        hashed_cell(cell)
    } else {
        hashed_cell(wrapped(cell, period))
    };
    corner + DVec3::from(mersenne::random_triple(number))
}

/// The equal cell of the first period.
fn wrapped(cell: [i64; 3], period: Period) -> [i64; 3] {
    std::array::from_fn(|axis| match period[axis] {
        0 => cell[axis],
        cells => cell[axis].rem_euclid(cells),
    })
}

/// The offset from the period of a point to the first. POV-Ray moves the point there, and the feature points with it: those
/// beyond the border of a period have another noise than the equal ones within it.
fn to_first_period(point: DVec3, period: Period) -> DVec3 {
    if period == ENDLESS {
        return DVec3::ZERO;
    }
    let cell = crate::scene::pattern::cell(point - NUDGE);
    let corner = |cell: [i64; 3]| DVec3::from(cell.map(|c| c as f64));
    corner(wrapped(cell, period)) - corner(cell)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    /// The three smallest lengths by brute force.
    fn all_lengths(point: DVec3, metric: &Metric) -> [f64; 3] {
        let cell = crate::scene::pattern::cell(point - NUDGE);
        let mut smallest = [f64::INFINITY; 3];
        for number in 0..125 {
            let step = [number / 25 - 2, number / 5 % 5 - 2, number % 5 - 2];
            if step.iter().filter(|step: &&i64| step.abs() == 2).count() < 2 {
                insert(
                    &mut smallest,
                    metric.length(point_of(offset_cell(cell, step), ENDLESS) - point),
                );
            }
        }
        smallest
    }

    #[test]
    fn no_cell_that_matters_is_skipped() {
        let mut rng = Random::new(3);
        for round in 0..4000 {
            let point = rng.vector(if round % 2 == 0 { 5.0 } else { 1e5 });
            for metric in [
                Metric::Euclidean(0.0),
                Metric::Euclidean(0.3),
                Metric::Manhattan(0.2),
                Metric::Minkowski(3.0, 0.1),
                Metric::Minkowski(1.5, 0.0),
                Metric::Minkowski(17.3, 1e3),
                Metric::Minkowski(0.5, 0.0),
                Metric::Minkowski(-1.0, 0.0),
            ] {
                let all = all_lengths(point, &metric);
                let least = if metric.has_estimates() { 1 } else { 3 };
                for needed in least..=3 {
                    let smallest = nearest(point, &metric, needed, ENDLESS);
                    assert_eq!(smallest[..needed], all[..needed], "{point}");
                }
            }
            let nearest = nearest_point(point, &Metric::Euclidean(0.0), ENDLESS);
            let [least, ..] = all_lengths(point, &Metric::Euclidean(0.0));
            assert_eq!((nearest - point).length_squared(), least);
        }
    }
}
