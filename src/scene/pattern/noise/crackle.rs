//! `crackle`: distances to points scattered one in each unit cube (Worley, "A Cellular Texture Basis Function",
//! SIGGRAPH 1996).

mod metric;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::noise::NoiseGenerator;
use crate::base::math::powers::{POWER_ERROR, power};
use crate::base::math::sampling::hash::hashed_cell;
use crate::base::math::sampling::mersenne;
use crate::base::math::simd::{F64Lanes, SimdKernel, with_widest};
use crate::scene::pattern::{Pattern, PatternEval, Preparing, SurfacePoint};
use glam::DVec3;
use metric::Metric;
use std::cell::RefCell;

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
    form: DVec3,
    metric: Metric,
    is_solid: bool,
    noise: NoiseGenerator,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Crackle {
        form: DVec3::new(-1.0, 1.0, 0.0),
        metric: 2.0,
        offset: 0.0,
        is_solid: false,
    }))
}

impl Pattern for Crackle {
    fn prepare(&self, with: &Preparing<'_>) -> Box<dyn PatternEval> {
        let Crackle {
            form,
            metric,
            offset,
            is_solid,
        } = *self;
        let metric = if metric == 2.0 {
            Metric::Squares(offset * offset)
        } else if metric == 1.0 {
            Metric::Sizes(offset)
        } else {
            Metric::Powers(metric, offset.powf(metric))
        };
        Box::new(Prepared {
            form,
            metric,
            is_solid,
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

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let metric = &self.metric;
        if self.is_solid {
            return self.noise.noise(nearest_point(point, metric));
        }
        let counted = metric.counted(self.form);
        let [d1, d2, d3] = metric.distances(nearest(point, metric, counted), counted);
        (self.form.x * d1 + self.form.y * d2 + self.form.z * d3).clamp(0.0, 1.0)
    }
}

/// More than an estimate may be above the least lengths that are to be found, as a share of them and at all: one is too
/// large and another too small.
const ESTIMATE_CARE: [f64; 2] = [4.0 * POWER_ERROR, 1e-90];
/// The cells within one step along each axis.
const CELLS: usize = 27;
/// For so many cells a thread keeps the points about them: neighbouring places are asked about one after the other.
const KEPT: usize = 64;

/// The points about a cell, the last of them nowhere.
#[derive(Clone, Copy)]
struct About {
    home: [i64; 3],
    points: [[f64; CELLS + 1]; 3],
}

thread_local! {
    static ABOUT: RefCell<Vec<About>> = const { RefCell::new(Vec::new()) };
}

impl About {
    /// No cell that is asked for: it has no points.
    const NOTHING: About = About {
        home: [i64::MIN; 3],
        points: [[f64::INFINITY; CELLS + 1]; 3],
    };

    fn new(home: [i64; 3]) -> About {
        let mut about = About {
            home,
            ..About::NOTHING
        };
        for number in 0..CELLS {
            let step = [number / 9, number / 3 % 3, number % 3].map(|step| step as i64 - 1);
            let point = point_of(stepped(home, step));
            for axis in 0..3 {
                about.points[axis][number] = point[axis];
            }
        }
        about
    }

    fn point(&self, number: usize) -> DVec3 {
        let [x, y, z] = &self.points;
        DVec3::new(x[number], y[number], z[number])
    }

    /// The one about this cell.
    fn with<R>(home: [i64; 3], ask: impl FnOnce(&About) -> R) -> R {
        ABOUT.with_borrow_mut(|kept| {
            if kept.is_empty() {
                kept.resize(KEPT, About::NOTHING);
            }
            let about = &mut kept[hashed_cell(home) as usize % KEPT];
            if about.home != home || home == About::NOTHING.home {
                *about = About::new(home);
            }
            ask(about)
        })
    }
}

/// The lengths to points about a cell, four points at a time, and the three least of them. Of powers they are estimates.
#[derive(Clone, Copy)]
struct Least<'a> {
    about: &'a About,
    point: DVec3,
    metric: &'a Metric,
}

impl SimdKernel for Least<'_> {
    type Output = ([f64; 3], [[f64; 4]; (CELLS + 1) / 4]);

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> Self::Output {
        let [x, y, z] = self.about.points.each_ref().map(|axis| axis.as_chunks().0);
        let DVec3 {
            x: px,
            y: py,
            z: pz,
        } = self.point;
        let (px, py, pz) = (F::splat(px), F::splat(py), F::splat(pz));
        let endless = F::splat(f64::INFINITY);
        let mut least = [endless; 3];
        let mut lengths = [[0.0; 4]; (CELLS + 1) / 4];
        for four in 0..x.len() {
            let dx = F::from_array(&x[four]) - px;
            let dy = F::from_array(&y[four]) - py;
            let dz = F::from_array(&z[four]) - pz;
            let length = match self.metric {
                Metric::Sizes(lift) => {
                    let sum = dx.abs() + dy.abs() + dz.abs();
                    sum + F::splat(*lift)
                }
                Metric::Squares(lift) => {
                    let sum = dx * dx + dy * dy + dz * dz;
                    sum + F::splat(*lift)
                }
                Metric::Powers(exponent, lift) => {
                    let of_x = power(dx.abs(), *exponent);
                    let of_y = power(dy.abs(), *exponent);
                    let of_z = power(dz.abs(), *exponent);
                    let sum = of_x + of_y + of_z + F::splat(*lift);
                    // A point that is nowhere.
                    F::select(dx.lt(endless), sum, endless)
                }
                Metric::Signed => endless,
            };
            lengths[four] = length.to_array();
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

/// The three least of two times three, all in order.
#[inline(always)]
fn merged(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let crossed = a[0].lane_max(b[1]).lane_min(a[1].lane_max(b[0]));
    [
        a[0].lane_min(b[0]),
        a[0].lane_max(b[0]).lane_min(a[1].lane_min(b[1])),
        a[2].lane_min(b[2]).lane_min(crossed),
    ]
}

/// Takes in a length if it is among the three least.
#[inline(always)]
fn insert(found: &mut [f64; 3], length: f64) {
    let [d1, d2, d3] = *found;
    if length < d1 {
        *found = [length, d1, d2];
    } else if length < d2 {
        *found = [d1, length, d2];
    } else if length < d3 {
        found[2] = length;
    }
}

/// The three least lengths from a point to those scattered over the cells about it, or the least of them that are counted
/// and no lesser ones: all within one step along each axis, and those of the next layer along one axis.
fn nearest(point: DVec3, metric: &Metric, counted: usize) -> [f64; 3] {
    let home = crate::scene::pattern::cell(point - NUDGE);
    let mut found = About::with(home, |about| {
        let least = Least {
            about,
            point,
            metric,
        };
        match metric {
            Metric::Squares(_) | Metric::Sizes(_) => least.in_lanes().0,
            Metric::Powers(..) if metric.has_estimates() => least.by_estimates(counted),
            Metric::Powers(..) | Metric::Signed => least.exact(|_| true),
        }
    });
    let last = counted - 1;
    if metric.is_within_a_cell(found[last]) {
        return found;
    }
    let longest = metric.longest(found[last]);
    let is_near = |gap: DVec3, found: &[f64; 3]| {
        gap.max_element() <= longest && metric.least(gap) < found[last]
    };
    next_layer((home, point), &mut found, is_near, |found, candidate| {
        insert(found, metric.length(candidate - point));
    });
    found
}

impl Least<'_> {
    fn in_lanes(&self) -> ([f64; 3], [[f64; 4]; (CELLS + 1) / 4]) {
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(*self),
        )
    }

    /// The least lengths that are counted, of the points for which estimates do not exclude it.
    fn by_estimates(&self, counted: usize) -> [f64; 3] {
        let (least, estimates) = self.in_lanes();
        let [share, more] = ESTIMATE_CARE;
        let most = least[counted - 1] * (1.0 + share) + more;
        self.exact(|number| {
            let is_excluded = estimates[number / 4][number % 4] > most;
            !is_excluded
        })
    }

    /// The three least lengths to those of the points that may count.
    fn exact(&self, may_count: impl Fn(usize) -> bool) -> [f64; 3] {
        let mut found = [f64::INFINITY; 3];
        for number in (0..CELLS).filter(|&number| may_count(number)) {
            let way = self.about.point(number) - self.point;
            insert(&mut found, self.metric.length(way));
        }
        found
    }
}

/// The nearest of them.
fn nearest_point(point: DVec3, metric: &Metric) -> DVec3 {
    let home = crate::scene::pattern::cell(point - NUDGE);
    let mut found = (f64::INFINITY, DVec3::ZERO);
    let offer = |found: &mut (f64, DVec3), candidate: DVec3| {
        let length = metric.length(candidate - point);
        if length < found.0 {
            *found = (length, candidate);
        }
    };
    About::with(home, |about| {
        (0..CELLS).for_each(|number| offer(&mut found, about.point(number)));
    });
    let is_near = |gap, found: &(f64, DVec3)| metric.least(gap) < found.0;
    next_layer((home, point), &mut found, is_near, offer);
    found.1
}

/// Offers the points of the next layer of cells along each axis, unless it is so far away that none of them counts.
fn next_layer<T>(
    (home, point): ([i64; 3], DVec3),
    found: &mut T,
    is_near: impl Fn(DVec3, &T) -> bool,
    offer: impl Fn(&mut T, DVec3),
) {
    for axis in 0..3 {
        for far in [-2, 2] {
            let low = home[axis].saturating_add(far) as f64;
            let mut gap = DVec3::ZERO;
            gap[axis] = (low - point[axis]).max(point[axis] - (low + 1.0)).max(0.0);
            if !is_near(gap, found) {
                continue;
            }
            let mut step = [0; 3];
            step[axis] = far;
            for number in 0..9 {
                step[(axis + 1) % 3] = number / 3 - 1;
                step[(axis + 2) % 3] = number % 3 - 1;
                offer(found, point_of(stepped(home, step)));
            }
        }
    }
}

fn stepped(cell: [i64; 3], step: [i64; 3]) -> [i64; 3] {
    let [x, y, z] = cell;
    [
        x.saturating_add(step[0]),
        y.saturating_add(step[1]),
        z.saturating_add(step[2]),
    ]
}

/// The nearest of the points scattered over the cells, by the distance of this metric: 2 is Euclid's; 1 is the sum of
/// the coordinates with their signs, as `facets` has it in POV-Ray.
#[must_use]
pub fn nearest_feature(point: DVec3, metric: f64) -> DVec3 {
    if metric == 2.0 {
        nearest_point(point, &Metric::Squares(0.0))
    } else if metric == 1.0 {
        nearest_point(point, &Metric::Signed)
    } else {
        nearest_point(point, &Metric::Powers(metric, 0.0))
    }
}

/// The point of a cell.
#[inline]
fn point_of(cell: [i64; 3]) -> DVec3 {
    let corner = DVec3::from(cell.map(|c| c as f64));
    corner + DVec3::from(mersenne::three(hashed_cell(cell)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    /// The lengths to the points of all cells, by looking into each.
    fn all_lengths(point: DVec3, metric: &Metric) -> [f64; 3] {
        let home = crate::scene::pattern::cell(point - NUDGE);
        let mut found = [f64::INFINITY; 3];
        for number in 0..125 {
            let step = [number / 25 - 2, number / 5 % 5 - 2, number % 5 - 2];
            if step.iter().filter(|step: &&i64| step.abs() == 2).count() < 2 {
                insert(
                    &mut found,
                    metric.length(point_of(stepped(home, step)) - point),
                );
            }
        }
        found
    }

    #[test]
    fn no_cell_that_counts_is_passed_over() {
        let mut rng = Random::new(3);
        for round in 0..4000 {
            let point = rng.vector(if round % 2 == 0 { 5.0 } else { 1e5 });
            for metric in [
                Metric::Squares(0.0),
                Metric::Squares(0.3),
                Metric::Sizes(0.2),
                Metric::Powers(3.0, 0.1),
                Metric::Powers(1.5, 0.0),
                Metric::Powers(17.3, 1e3),
                Metric::Powers(0.5, 0.0),
                Metric::Powers(-1.0, 0.0),
            ] {
                let all = all_lengths(point, &metric);
                let least = if metric.has_estimates() { 1 } else { 3 };
                for counted in least..=3 {
                    let found = nearest(point, &metric, counted);
                    assert_eq!(found[..counted], all[..counted], "{point}");
                }
            }
            let nearest = nearest_point(point, &Metric::Squares(0.0));
            let [least, ..] = all_lengths(point, &Metric::Squares(0.0));
            assert_eq!((nearest - point).length_squared(), least);
        }
    }
}
