//! Pixels divided by one straight edge. The area on each side is known far better than by counting samples.
//!
//! The samples of the pixel and those just around it are classified by colour or by the surface they hit. All straight
//! lines that separate the two classes are considered: the mean of the area they cut off is the estimated coverage, and
//! its deviation the error. Further samples are placed on the middle line, and each halves the range of possible lines.
//! A dozen samples give the coverage as well as hundreds spread evenly. Where no line separates the samples the pixel
//! is sampled normally.

use std::f64::consts::FRAC_PI_2;

/// Edges are slightly curved, and lines are not equally likely: the error is this many deviations.
const CAUTION: f64 = 1.5;
const MIDDLE: f64 = 0.5;
/// Gauss-Legendre nodes and weights on [0, 1] for the mean over directions and offsets.
const NODES: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (MIDDLE, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];
/// Distance between successive samples on a line, as a share of its length: the golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A point in the unit square of the pixel, and true if it belongs to the brighter class.
pub(super) type ClassifiedPoint = ([f64; 2], bool);

/// The estimate from all lines that separate two classes of samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division {
    /// The dark share of the pixel.
    pub(super) dark: f64,
    /// The error of this share.
    pub(super) error: f64,
    /// The middle line: the direction from dark to bright, and the line's offset along it.
    direction: Direction,
    offset: f64,
}

impl Division {
    /// From the lines in a wedge between the dark and the bright samples; `None` if rounding leaves none.
    pub(super) fn of(wedge: Wedge, dark: &[[f64; 2]], bright: &[[f64; 2]]) -> Option<Division> {
        let [first, last] = wedge.ends();
        let (mut weight, mut sum, mut squares) = (0.0, 0.0, 0.0);
        let mut middle = None;
        for (share, angle_weight) in NODES {
            let direction = Direction::angle(first + share * (last - first));
            let gap = Gap::between(dark, bright, &direction);
            if share == MIDDLE {
                middle = Some((direction, (gap.dark + gap.bright) / 2.0));
            }
            for (share, offset_weight) in NODES {
                let here = angle_weight * offset_weight * gap.width().max(0.0);
                let dark = direction.area_below(gap.dark + share * (gap.bright - gap.dark));
                weight += here;
                sum += here * dark;
                squares += here * dark * dark;
            }
        }
        let (direction, offset) = middle?;
        if weight.is_nan() || weight <= 0.0 {
            return None;
        }
        let dark = sum / weight;
        Some(Division {
            dark,
            error: CAUTION * (squares / weight - dark * dark).max(0.0).sqrt(),
            direction,
            offset,
        })
    }

    /// True if a point lies on the bright side of the middle line.
    pub(super) fn is_beyond(&self, [x, y]: [f64; 2]) -> bool {
        self.direction.along([x, y]) > self.offset
    }

    /// The centroids of the dark and the bright part.
    pub(super) fn centroids(&self) -> [[f64; 2]; 2] {
        centroids(&self.direction, self.offset)
    }

    /// The point where sample `number` is most informative.
    pub(super) fn point(&self, number: u32) -> [f64; 2] {
        let share = (0.5 + f64::from(number) * GOLDEN).fract();
        let [from, to] = chord(&self.direction, self.offset);
        [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
    }
}

/// The cone of directions from dark samples to bright ones. A line separates the samples if its normal is within a
/// right angle of all of these directions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wedge {
    /// The boundary directions on either side.
    left: [f64; 2],
    right: [f64; 2],
}

impl Wedge {
    /// The wedge of the directions from dark points to bright ones; `None` if no line separates them. Points that can
    /// no longer matter are removed from both lists.
    pub(super) fn between(dark: &mut Vec<[f64; 2]>, bright: &mut Vec<[f64; 2]>) -> Option<Wedge> {
        let (&from, &to) = (dark.first()?, bright.first()?);
        let one = [to[0] - from[0], to[1] - from[1]];
        let mut wedge = Wedge {
            left: one,
            right: one,
        };
        // One pair of points already leaves so few directions that few other points matter.
        let are_apart = wedge.take(to, true, dark) && wedge.take(from, false, bright);
        if !are_apart {
            return None;
        }
        wedge.retain_front(dark, false);
        wedge.retain_front(bright, true);
        let are_apart = bright.iter().all(|&point| wedge.take(point, true, dark));
        if !are_apart {
            return None;
        }
        wedge.retain_front(dark, false);
        wedge.retain_front(bright, true);
        Some(wedge)
    }

    /// Adds a point, bright or dark; `others` are the points of the other class. Returns false if then no line
    /// separates them.
    #[inline]
    pub(super) fn take(&mut self, point: [f64; 2], is_bright: bool, others: &[[f64; 2]]) -> bool {
        let sign = if is_bright { 1.0 } else { -1.0 };
        for other in others {
            let dir = [sign * (point[0] - other[0]), sign * (point[1] - other[1])];
            let (left, right) = (cross(self.left, dir), cross(self.right, dir));
            if left < 0.0 && right > 0.0 {
                continue;
            }
            let is_behind = left >= 0.0 && right <= 0.0;
            if is_behind && self.left[0] * dir[0] + self.left[1] * dir[1] <= 0.0 {
                return false;
            }
            if left > 0.0 && right >= 0.0 {
                self.left = dir;
            } else if right < 0.0 && left <= 0.0 {
                self.right = dir;
            } else if left > 0.0 && right < 0.0 {
                return false;
            }
        }
        true
    }

    /// Retains the points that lie next to the other class along some separating direction. The rest can never matter
    /// again, because each point added leaves fewer directions.
    fn retain_front(&self, points: &mut Vec<[f64; 2]>, is_bright: bool) {
        let sign = if is_bright { -1.0 } else { 1.0 };
        let first = [sign * self.left[1], -sign * self.left[0]];
        let last = [-sign * self.right[1], sign * self.right[0]];
        let far = |[x, y]: [f64; 2]| [x * first[0] + y * first[1], x * last[0] + y * last[1]];
        let mut count = 0;
        for i in 0..points.len() {
            let point = points[i];
            let here = far(point);
            let is_hidden = points[..count].iter().any(|&other| {
                let other = far(other);
                other[0] >= here[0] && other[1] >= here[1]
            });
            if is_hidden {
                continue;
            }
            let before = std::mem::take(&mut count);
            for k in 0..before {
                let other = far(points[k]);
                if other[0] > here[0] || other[1] > here[1] {
                    points[count] = points[k];
                    count += 1;
                }
            }
            points[count] = point;
            count += 1;
        }
        points.truncate(count);
    }

    /// The first and the last angle of the separating directions.
    fn ends(&self) -> [f64; 2] {
        let right = self.right[1].atan2(self.right[0]);
        // Less than half a turn away.
        let turn = cross(self.right, self.left)
            .atan2(self.right[0] * self.left[0] + self.right[1] * self.left[1]);
        [right + turn - FRAC_PI_2, right + FRAC_PI_2]
    }
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A unit direction.
#[derive(Clone, Copy, Debug)]
struct Direction {
    cos: f64,
    sin: f64,
}

impl Direction {
    fn angle(angle: f64) -> Direction {
        let (sin, cos) = angle.sin_cos();
        Direction { cos, sin }
    }

    /// The coordinate of a point along the direction.
    fn along(&self, [x, y]: [f64; 2]) -> f64 {
        x * self.cos + y * self.sin
    }

    /// The area of the unit square with a coordinate below `offset`.
    fn area_below(&self, mut offset: f64) -> f64 {
        let Direction { cos, sin } = *self;
        // Mirrored so that both components are positive.
        let below = |v: f64| if v < 0.0 { v } else { 0.0 };
        offset -= below(cos) + below(sin);
        let (a, b) = (cos.abs(), sin.abs());
        let (small, large) = if a < b { (a, b) } else { (b, a) };
        if offset <= 0.0 {
            return 0.0;
        }
        if offset >= a + b {
            return 1.0;
        }
        if small < FLAT {
            return ((offset - small / 2.0) / large).clamp(0.0, 1.0);
        }
        let beyond = |side: f64| {
            let beyond = offset - side;
            if beyond > 0.0 { beyond * beyond } else { 0.0 }
        };
        (offset * offset - beyond(a) - beyond(b)) / (2.0 * a * b)
    }
}

/// The interval along a direction between the last dark sample and the first bright one.
struct Gap {
    dark: f64,
    bright: f64,
}

impl Gap {
    fn between(dark: &[[f64; 2]], bright: &[[f64; 2]], direction: &Direction) -> Gap {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        // `f64::min` handles NaN, which takes longer than all the rest.
        for point in bright {
            let here = direction.along(*point);
            least = if here < least { here } else { least };
        }
        for point in dark {
            let here = direction.along(*point);
            most = if here > most { here } else { most };
        }
        Gap {
            dark: most,
            bright: least,
        }
    }

    fn width(&self) -> f64 {
        self.bright - self.dark
    }
}

/// Lines closer to an axis count as parallel to it: the area is wrong by less than a sixth of this.
const FLAT: f64 = 1e-6;

/// The points where the line `x cos + y sin = offset` enters and leaves the unit square.
fn chord(&Direction { cos, sin }: &Direction, offset: f64) -> [[f64; 2]; 2] {
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
    // Rounding may put a corner just outside.
    let at = |t: f64| [0, 1].map(|i| (foot[i] + t * dir[i]).clamp(0.0, 1.0));
    [at(from.min(to)), at(to)]
}

/// The centroids of the parts of the unit square below and above a line; for an empty part, the centre of the square.
fn centroids(direction: &Direction, offset: f64) -> [[f64; 2]; 2] {
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = |point: [f64; 2]| direction.along(point) - offset;
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
    // Twice the area, and six times the first moments.
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

    /// The division of classified points by a line.
    fn division(classified: &[ClassifiedPoint]) -> Option<Division> {
        let mut groups = [Vec::new(), Vec::new()];
        for &(point, is_bright) in classified {
            groups[usize::from(is_bright)].push(point);
        }
        let [mut dark, mut bright] = groups.clone();
        let wedge = Wedge::between(&mut dark, &mut bright)?;
        let whole = Division::of(wedge, &groups[0], &groups[1])?;
        let by_fronts = Division::of(wedge, &dark, &bright)?;
        assert!((by_fronts.dark - whole.dark).abs() < 1e-12);
        assert!((by_fronts.error - whole.error).abs() < 1e-12);
        Some(whole)
    }

    #[test]
    fn areas_below_a_line_match_counting() {
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
                let area = Direction::angle(angle).area_below(offset);
                assert!(
                    (area - counted).abs() < 3e-3,
                    "{angle} {offset}: {area}, {counted}"
                );
            }
        }
        assert!((Direction::angle(0.0).area_below(0.25) - 0.25).abs() < 1e-6);
    }

    #[test]
    fn a_dozen_samples_fit_a_straight_edge() {
        for (angle, offset) in [
            (0.3, 0.6),
            (2.0, 0.1),
            (-1.2, -0.4),
            (4.0, -0.9),
            (0.0, 0.5),
        ] {
            let classify = |point: [f64; 2]| {
                (
                    point,
                    point[0] * f64::cos(angle) + point[1] * f64::sin(angle) > offset,
                )
            };
            let sobol = crate::base::math::sampling::sobol::Sobol::of_pixel(5, 6);
            let side = |v: u32| f64::from(v) / 2f64.powi(32);
            let mut classified: Vec<ClassifiedPoint> = (0..16)
                .map(|number| {
                    let (x, y) = sobol.point(number);
                    classify([side(x), side(y)])
                })
                .collect();
            for number in 0..9 {
                let division = division(&classified).expect("a line separates them");
                classified.push(classify(division.point(number)));
            }
            let division = division(&classified).expect("a line separates them");
            let off = (division.dark - Direction::angle(angle).area_below(offset)).abs();
            assert!(
                off < 0.006 && off < 2.0 * division.error,
                "{off}, {division:?}"
            );
            assert!(division.error < 0.015, "{division:?}");
        }
    }

    #[test]
    fn centroids_of_both_parts_match_counting() {
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
                let centroids = centroids(&Direction::angle(angle), offset);
                for (sum, middle) in sums.iter().zip(centroids) {
                    if sums.iter().all(|sum| sum[2] > 100.0) {
                        let off = (sum[0] / sum[2] - middle[0]).hypot(sum[1] / sum[2] - middle[1]);
                        assert!(off < 0.01, "{angle} {offset}: {middle:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn classes_that_no_line_separates_are_rejected() {
        let classified = [
            ([0.1, 0.1], true),
            ([0.9, 0.9], true),
            ([0.5, 0.5], false),
            ([0.4, 0.6], false),
            ([0.6, 0.5], false),
            ([0.5, 0.1], true),
            ([0.1, 0.9], true),
            ([0.9, 0.1], true),
        ];
        assert!(division(&classified).is_none());
    }
}
