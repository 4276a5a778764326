//! Pixels that one straight edge divides: how much lies on each side is known far better than counting samples tells.
//!
//! The samples of the pixel and those just around it are told apart by colour or by what they met, and all straight lines
//! that separate the two kinds are looked at: the mean share of the pixel that they cut off is the share, its deviation
//! the error. Further samples go to places on the line in the middle, and each halves what is possible there. A dozen
//! samples tell the share as well as hundreds spread evenly would. Where no line separates the samples the pixel is
//! sampled on in the ordinary way.

/// Edges are bent a little, and all lines are not equally likely: the error is this many deviations.
const CAUTION: f64 = 1.5;
/// Directions tried to either side of a guess, and by how much they differ, in radians.
const GUESSES: [(u8, f64); 3] = [(5, 0.2), (4, 0.045), (3, 0.013)];
/// Bisections to the end of the directions that separate.
const BISECTIONS: u32 = 6;
/// Directions over which the mean is taken, as shares of the way between the ends: Gauss-Legendre.
const NODES: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];
/// The next place on a line comes so much of its length behind the last.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A place, the pixel being the unit square, and whether it is of the brighter kind.
pub(super) type Told = ([f64; 2], bool);

/// What the lines that separate samples tell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division {
    /// The share of the pixel that is dark.
    pub(super) dark: f64,
    /// How wrong that may be.
    pub(super) error: f64,
    /// The line in the middle: the direction from dark to bright, and how far it lies in that.
    angle: f64,
    offset: f64,
    /// Two points of the border of the pixel on it.
    chord: [[f64; 2]; 2],
    /// The middles of the dark and the bright part.
    pub(super) middles: [[f64; 2]; 2],
}

impl Division {
    /// The lines that separate these samples; `None` if there are none.
    pub(super) fn of(told: &[Told]) -> Option<Division> {
        let middle = |bright: bool| {
            let mut sum = [0.0; 2];
            let mut count = 0.0;
            for (place, _) in told.iter().filter(|(_, is_bright)| *is_bright == bright) {
                sum = [sum[0] + place[0], sum[1] + place[1]];
                count += 1.0;
            }
            (count > 0.0).then(|| sum.map(|s| s / count))
        };
        let (from, to) = (middle(false)?, middle(true)?);
        let mut best = (to[1] - from[1]).atan2(to[0] - from[0]);
        let sides = &[Side::of(told, false)?, Side::of(told, true)?];
        let mut widest = Gap::of(sides, best).width();
        for (count, step) in GUESSES {
            let guess = best;
            let (sin, cos) = guess.sin_cos();
            let (sin_step, cos_step) = step.sin_cos();
            for side in [-1.0, 1.0] {
                let (sin_step, mut sin, mut cos) = (side * sin_step, sin, cos);
                for i in 1..=count {
                    (sin, cos) = (
                        sin * cos_step + cos * sin_step,
                        cos * cos_step - sin * sin_step,
                    );
                    let width = Gap::along(sides, [cos, sin]).width();
                    if width > widest {
                        (best, widest) = (guess + side * f64::from(i) * step, width);
                    }
                }
            }
        }
        if widest <= 0.0 {
            return None;
        }
        let ends = [-1.0, 1.0].map(|side| best + side * last_separating(sides, best, side));
        Some(Division::over(sides, best, ends))
    }

    /// The mean over all lines with directions between two ends.
    fn over(sides: &[Side; 2], best: f64, ends: [f64; 2]) -> Division {
        let (mut weight, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (share, angle_weight) in NODES {
            let angle = ends[0] + share * (ends[1] - ends[0]);
            let gap = Gap::of(sides, angle);
            for (share, offset_weight) in NODES {
                let here = angle_weight * offset_weight * gap.width().max(0.0);
                let dark = area_below(angle, gap.dark + share * (gap.bright - gap.dark));
                weight += here;
                sum += here * dark;
                squares += here * dark * dark;
            }
        }
        let dark = sum / weight;
        let gap = Gap::of(sides, best);
        let offset = (gap.dark + gap.bright) / 2.0;
        Division {
            dark,
            error: CAUTION * (squares / weight - dark * dark).max(0.0).sqrt(),
            angle: best,
            offset,
            chord: chord(best, offset),
            middles: middles(best, offset),
        }
    }

    /// Whether a place lies on the bright side of the line in the middle.
    pub(super) fn is_beyond(&self, [x, y]: [f64; 2]) -> bool {
        let (sin, cos) = self.angle.sin_cos();
        x * cos + y * sin > self.offset
    }

    /// The place at which a sample with this number tells most.
    pub(super) fn place(&self, number: u32) -> [f64; 2] {
        let share = (0.5 + f64::from(number) * GOLDEN).fract();
        let [from, to] = self.chord;
        [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
    }
}

/// The places of one kind of samples, the first repeated behind the last so that lanes are full.
struct Side {
    places: [[f64; MOST_TOLD]; 2],
    count: usize,
}

/// So many samples of one kind are told from the others at most.
const MOST_TOLD: usize = 160;
/// So many are looked at together.
const LANES: usize = 4;

impl Side {
    fn of(told: &[Told], bright: bool) -> Option<Side> {
        let mut side = Side {
            places: [[0.0; MOST_TOLD]; 2],
            count: 0,
        };
        let ours = told.iter().filter(|(_, is_bright)| *is_bright == bright);
        for (place, _) in ours {
            side.put(*place)?;
        }
        let first = [side.places[0][0], side.places[1][0]];
        while !side.count.is_multiple_of(LANES) {
            side.put(first)?;
        }
        Some(side)
    }

    fn put(&mut self, [x, y]: [f64; 2]) -> Option<()> {
        *self.places[0].get_mut(self.count)? = x;
        self.places[1][self.count] = y;
        self.count += 1;
        Some(())
    }

    /// How far it reaches against a direction.
    fn least(&self, [cos, sin]: [f64; 2]) -> f64 {
        let mut least = [f64::INFINITY; LANES];
        let [x, y] = [0, 1].map(|i| self.places[i][..self.count].chunks_exact(LANES));
        for (x, y) in x.zip(y) {
            for lane in 0..LANES {
                let along = x[lane] * cos + y[lane] * sin;
                // What `min` does about numbers that are none takes longer than all the rest.
                least[lane] = if along < least[lane] {
                    along
                } else {
                    least[lane]
                };
            }
        }
        least.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Along one direction: how far the dark samples reach, and where the bright ones begin.
struct Gap {
    dark: f64,
    bright: f64,
}

impl Gap {
    fn of(sides: &[Side; 2], angle: f64) -> Gap {
        let (sin, cos) = angle.sin_cos();
        Gap::along(sides, [cos, sin])
    }

    fn along([dark, bright]: &[Side; 2], [cos, sin]: [f64; 2]) -> Gap {
        Gap {
            dark: -dark.least([-cos, -sin]),
            bright: bright.least([cos, sin]),
        }
    }

    fn width(&self) -> f64 {
        self.bright - self.dark
    }
}

/// How far a direction that separates can be turned to one side until it no longer does.
fn last_separating(sides: &[Side; 2], angle: f64, side: f64) -> f64 {
    let (mut inside, mut outside) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..BISECTIONS {
        let middle = (inside + outside) / 2.0;
        if Gap::of(sides, angle + side * middle).width() > 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// The area of the unit square in which `x cos + y sin` is below an offset.
fn area_below(angle: f64, mut offset: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    // Mirrored so that both are positive.
    offset -= cos.min(0.0) + sin.min(0.0);
    let (a, b) = (cos.abs(), sin.abs());
    let (small, large) = (a.min(b), a.max(b));
    if offset <= 0.0 {
        return 0.0;
    }
    if offset >= a + b {
        return 1.0;
    }
    if small < FLAT {
        return ((offset - small / 2.0) / large).clamp(0.0, 1.0);
    }
    let beyond = |side: f64| (offset - side).max(0.0).powi(2);
    (offset * offset - beyond(a) - beyond(b)) / (2.0 * a * b)
}

/// A line that leaves the axis by less is taken for parallel to it: the area is wrong by less than a sixth of this.
const FLAT: f64 = 1e-6;

/// Where the line `x cos + y sin = offset` enters and leaves the unit square.
fn chord(angle: f64, offset: f64) -> [[f64; 2]; 2] {
    let (sin, cos) = angle.sin_cos();
    let foot = [offset * cos, offset * sin];
    let dir = [-sin, cos];
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for i in 0..2 {
        if dir[i].abs() > FLAT {
            let (a, b) = (-foot[i] / dir[i], (1.0 - foot[i]) / dir[i]);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
    }
    // Rounding may leave a corner just outside.
    let at = |t: f64| [0, 1].map(|i| (foot[i] + t * dir[i]).clamp(0.0, 1.0));
    [at(from.min(to)), at(to)]
}

/// The centres of gravity of the parts of the unit square below and above a line; that of an empty part is the square's.
fn middles(angle: f64, offset: f64) -> [[f64; 2]; 2] {
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let (sin, cos) = angle.sin_cos();
    let above = |[x, y]: [f64; 2]| x * cos + y * sin - offset;
    // The outline of the part below.
    let (mut outline, mut count) = ([[0.0; 2]; 8], 0);
    for (i, corner) in CORNERS.into_iter().enumerate() {
        let next = CORNERS[(i + 1) % 4];
        let (here, there) = (above(corner), above(next));
        if here < 0.0 {
            outline[count] = corner;
            count += 1;
        }
        if (here < 0.0) != (there < 0.0) {
            let share = here / (here - there);
            outline[count] = [0, 1].map(|k| corner[k] + share * (next[k] - corner[k]));
            count += 1;
        }
    }
    // Twice its area, and six times its first moments.
    let (mut area, mut moments) = (0.0, [0.0; 2]);
    for i in 0..count {
        let (from, to) = (outline[i], outline[(i + 1) % count]);
        let cross = from[0] * to[1] - to[0] * from[1];
        area += cross;
        moments = [0, 1].map(|k| moments[k] + cross * (from[k] + to[k]));
    }
    let share = area / 2.0;
    let whole = [0.5; 2];
    if !(FLAT..=1.0 - FLAT).contains(&share) {
        return [whole; 2];
    }
    let dark = moments.map(|moment| moment / (6.0 * share));
    let bright = dark.map(|dark| (0.5 - share * dark) / (1.0 - share));
    [dark, bright]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn areas_below_a_line_are_those_of_counting() {
        for step in 0..24 {
            let angle = f64::from(step) * PI / 12.0 + 0.01;
            for offset in [-0.9, -0.3, 0.0, 0.2, 0.5, 0.77, 1.0, 1.3] {
                let (sin, cos) = angle.sin_cos();
                let mut below = 0;
                for y in 0..200 {
                    for x in 0..200 {
                        let [x, y] = [x, y].map(|v| (f64::from(v) + 0.5) / 200.0);
                        below += i32::from(x * cos + y * sin < offset);
                    }
                }
                let counted = f64::from(below) / 40_000.0;
                let area = area_below(angle, offset);
                assert!(
                    (area - counted).abs() < 3e-3,
                    "{angle} {offset}: {area}, {counted}"
                );
            }
        }
        assert!((area_below(0.0, 0.25) - 0.25).abs() < 1e-6);
    }

    #[test]
    fn a_straight_edge_is_found_with_few_samples() {
        for (angle, offset) in [
            (0.3, 0.6),
            (2.0, 0.1),
            (-1.2, -0.4),
            (4.0, -0.9),
            (0.0, 0.5),
        ] {
            let tell = |place: [f64; 2]| {
                (
                    place,
                    place[0] * f64::cos(angle) + place[1] * f64::sin(angle) > offset,
                )
            };
            let sobol = crate::math::sobol::Sobol::of_pixel(5, 6);
            let side = |v: u32| f64::from(v) / 2f64.powi(32);
            let mut told: Vec<Told> = (0..16)
                .map(|number| {
                    let (x, y) = sobol.point(number);
                    tell([side(x), side(y)])
                })
                .collect();
            for number in 0..9 {
                let division = Division::of(&told).expect("a line separates them");
                told.push(tell(division.place(number)));
            }
            let division = Division::of(&told).expect("a line separates them");
            let off = (division.dark - area_below(angle, offset)).abs();
            assert!(
                off < 0.006 && off < 2.0 * division.error,
                "{off}, {division:?}"
            );
            assert!(division.error < 0.015, "{division:?}");
        }
    }

    #[test]
    fn middles_of_both_parts_are_those_of_counting() {
        for step in 0..24 {
            let angle = f64::from(step) * PI / 12.0 + 0.01;
            for offset in [-0.7, -0.3, 0.2, 0.5, 0.77, 1.1] {
                let (sin, cos) = angle.sin_cos();
                let mut sums = [[0.0; 3]; 2];
                for y in 0..200 {
                    for x in 0..200 {
                        let [x, y] = [x, y].map(|v| (f64::from(v) + 0.5) / 200.0);
                        let sum = &mut sums[usize::from(x * cos + y * sin >= offset)];
                        *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
                    }
                }
                let middles = middles(angle, offset);
                for (sum, middle) in sums.iter().zip(middles) {
                    if sums.iter().all(|sum| sum[2] > 100.0) {
                        let off = (sum[0] / sum[2] - middle[0]).hypot(sum[1] / sum[2] - middle[1]);
                        assert!(off < 0.01, "{angle} {offset}: {middle:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_no_line_separates_is_left_alone() {
        let told = [
            ([0.1, 0.1], true),
            ([0.9, 0.9], true),
            ([0.5, 0.5], false),
            ([0.4, 0.6], false),
            ([0.6, 0.5], false),
            ([0.5, 0.1], true),
            ([0.1, 0.9], true),
            ([0.9, 0.1], true),
        ];
        assert!(Division::of(&told).is_none());
    }
}
