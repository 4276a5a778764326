//! Pixels that one straight edge divides: how much lies on each side is known far better than counting samples tells.
//!
//! The samples of the pixel and those just around it are told apart by colour or by what they met, and all straight lines
//! that separate the two kinds are looked at: the mean share of the pixel that they cut off is the share, its deviation
//! the error. Further samples go to places on the line in the middle, and each halves what is possible there. A dozen
//! samples tell the share as well as hundreds spread evenly would. Where no line separates the samples the pixel is
//! sampled on in the ordinary way.

use std::f64::consts::FRAC_PI_2;

/// Edges are bent a little, and all lines are not equally likely: the error is this many deviations.
const CAUTION: f64 = 1.5;
const MIDDLE: f64 = 0.5;
/// Directions over which the mean is taken, as shares of the way between the ends: Gauss-Legendre.
const NODES: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (MIDDLE, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];
/// The next place on a line comes so much of its length behind the last.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A place, the pixel being the unit square, and whether it is of the brighter kind.
pub(super) type ClassifiedPoint = ([f64; 2], bool);

/// What the lines that separate samples tell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division {
    /// The share of the pixel that is dark.
    pub(super) dark: f64,
    /// How wrong that may be.
    pub(super) error: f64,
    /// The line in the middle: the direction from dark to bright, and how far it lies in that.
    along: Along,
    offset: f64,
}

impl Division {
    /// The lines in a wedge between the dark samples and the bright ones; `None` if rounding leaves none.
    pub(super) fn of(wedge: Wedge, dark: &[[f64; 2]], bright: &[[f64; 2]]) -> Option<Division> {
        let [first, last] = wedge.ends();
        let (mut weight, mut sum, mut squares) = (0.0, 0.0, 0.0);
        let mut middle = None;
        for (share, angle_weight) in NODES {
            let along = Along::angle(first + share * (last - first));
            let gap = Gap::between(dark, bright, &along);
            if share == MIDDLE {
                middle = Some((along, (gap.dark + gap.bright) / 2.0));
            }
            for (share, offset_weight) in NODES {
                let here = angle_weight * offset_weight * gap.width().max(0.0);
                let dark = along.area_below(gap.dark + share * (gap.bright - gap.dark));
                weight += here;
                sum += here * dark;
                squares += here * dark * dark;
            }
        }
        let (along, offset) = middle?;
        if weight.is_nan() || weight <= 0.0 {
            return None;
        }
        let dark = sum / weight;
        Some(Division {
            dark,
            error: CAUTION * (squares / weight - dark * dark).max(0.0).sqrt(),
            along,
            offset,
        })
    }

    /// Whether a place lies on the bright side of the line in the middle.
    pub(super) fn is_beyond(&self, [x, y]: [f64; 2]) -> bool {
        self.along.of([x, y]) > self.offset
    }

    /// The middles of the dark and the bright part.
    pub(super) fn middles(&self) -> [[f64; 2]; 2] {
        middles(&self.along, self.offset)
    }

    /// The place at which a sample with this number tells most.
    pub(super) fn place(&self, number: u32) -> [f64; 2] {
        let share = (0.5 + f64::from(number) * GOLDEN).fract();
        let [from, to] = chord(&self.along, self.offset);
        [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
    }
}

/// The directions from the dark samples to the bright ones, all of them between two. A line separates the samples if it
/// is at a right angle to a direction that has less than a right angle with all of these.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wedge {
    /// Of all those to the one side, and to the other.
    left: [f64; 2],
    right: [f64; 2],
}

impl Wedge {
    /// Around the directions from some places to others; `None` if no line separates them. Of both only those stay that
    /// will ever matter.
    pub(super) fn between(dark: &mut Vec<[f64; 2]>, bright: &mut Vec<[f64; 2]>) -> Option<Wedge> {
        let (&from, &to) = (dark.first()?, bright.first()?);
        let one = [to[0] - from[0], to[1] - from[1]];
        let mut wedge = Wedge {
            left: one,
            right: one,
        };
        // Already one of each kind leaves so few directions that few of the others matter.
        let are_apart = wedge.take(to, true, dark) && wedge.take(from, false, bright);
        if !are_apart {
            return None;
        }
        wedge.keep_front(dark, false);
        wedge.keep_front(bright, true);
        let are_apart = bright.iter().all(|&place| wedge.take(place, true, dark));
        if !are_apart {
            return None;
        }
        wedge.keep_front(dark, false);
        wedge.keep_front(bright, true);
        Some(wedge)
    }

    /// Takes in one place more, bright or not, of which `others` are those of the other kind; false if then no line
    /// separates them.
    #[inline]
    pub(super) fn take(&mut self, place: [f64; 2], is_bright: bool, others: &[[f64; 2]]) -> bool {
        let sign = if is_bright { 1.0 } else { -1.0 };
        for other in others {
            let way = [sign * (place[0] - other[0]), sign * (place[1] - other[1])];
            let (left, right) = (cross(self.left, way), cross(self.right, way));
            if left < 0.0 && right > 0.0 {
                continue;
            }
            let is_behind = left >= 0.0 && right <= 0.0;
            if is_behind && self.left[0] * way[0] + self.left[1] * way[1] <= 0.0 {
                return false;
            }
            if left > 0.0 && right >= 0.0 {
                self.left = way;
            } else if right < 0.0 && left <= 0.0 {
                self.right = way;
            } else if left > 0.0 && right < 0.0 {
                return false;
            }
        }
        true
    }

    /// Keeps those of some places, bright or not, that lie next to the other kind in some direction that separates. The
    /// others will never matter again, for the directions become fewer with every place.
    fn keep_front(&self, places: &mut Vec<[f64; 2]>, is_bright: bool) {
        let sign = if is_bright { -1.0 } else { 1.0 };
        let first = [sign * self.left[1], -sign * self.left[0]];
        let last = [-sign * self.right[1], sign * self.right[0]];
        let far = |[x, y]: [f64; 2]| [x * first[0] + y * first[1], x * last[0] + y * last[1]];
        let mut count = 0;
        for i in 0..places.len() {
            let place = places[i];
            let here = far(place);
            let is_hidden = places[..count].iter().any(|&other| {
                let other = far(other);
                other[0] >= here[0] && other[1] >= here[1]
            });
            if is_hidden {
                continue;
            }
            let before = std::mem::take(&mut count);
            for k in 0..before {
                let other = far(places[k]);
                if other[0] > here[0] || other[1] > here[1] {
                    places[count] = places[k];
                    count += 1;
                }
            }
            places[count] = place;
            count += 1;
        }
        places.truncate(count);
    }

    /// The first and the last angle of the directions that separate.
    fn ends(&self) -> [f64; 2] {
        let right = self.right[1].atan2(self.right[0]);
        // Less than half a turn on.
        let turn = cross(self.right, self.left)
            .atan2(self.right[0] * self.left[0] + self.right[1] * self.left[1]);
        [right + turn - FRAC_PI_2, right + FRAC_PI_2]
    }
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A direction.
#[derive(Clone, Copy, Debug)]
struct Along {
    cos: f64,
    sin: f64,
}

impl Along {
    fn angle(angle: f64) -> Along {
        let (sin, cos) = angle.sin_cos();
        Along { cos, sin }
    }

    /// How far a place lies in it.
    fn of(&self, [x, y]: [f64; 2]) -> f64 {
        x * self.cos + y * self.sin
    }

    /// The area of the unit square that lies less far than this in it.
    fn area_below(&self, mut offset: f64) -> f64 {
        let Along { cos, sin } = *self;
        // Mirrored so that both are positive.
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

/// Along one direction: how far the dark samples reach, and where the bright ones begin.
struct Gap {
    dark: f64,
    bright: f64,
}

impl Gap {
    fn between(dark: &[[f64; 2]], bright: &[[f64; 2]], along: &Along) -> Gap {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        // What `min` does about numbers that are none takes longer than all the rest.
        for place in bright {
            let here = along.of(*place);
            least = if here < least { here } else { least };
        }
        for place in dark {
            let here = along.of(*place);
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

/// A line that leaves the axis by less is taken for parallel to it: the area is wrong by less than a sixth of this.
const FLAT: f64 = 1e-6;

/// Where the line `x cos + y sin = offset` enters and leaves the unit square.
fn chord(&Along { cos, sin }: &Along, offset: f64) -> [[f64; 2]; 2] {
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
fn middles(along: &Along, offset: f64) -> [[f64; 2]; 2] {
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = |place: [f64; 2]| along.of(place) - offset;
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

    /// What is known of the lines between samples.
    fn division(told: &[ClassifiedPoint]) -> Option<Division> {
        let mut groups = [Vec::new(), Vec::new()];
        for &(place, is_bright) in told {
            groups[usize::from(is_bright)].push(place);
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
                let area = Along::angle(angle).area_below(offset);
                assert!(
                    (area - counted).abs() < 3e-3,
                    "{angle} {offset}: {area}, {counted}"
                );
            }
        }
        assert!((Along::angle(0.0).area_below(0.25) - 0.25).abs() < 1e-6);
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
            let sobol = crate::base::math::sampling::sobol::Sobol::of_pixel(5, 6);
            let side = |v: u32| f64::from(v) / 2f64.powi(32);
            let mut told: Vec<ClassifiedPoint> = (0..16)
                .map(|number| {
                    let (x, y) = sobol.point(number);
                    tell([side(x), side(y)])
                })
                .collect();
            for number in 0..9 {
                let division = division(&told).expect("a line separates them");
                told.push(tell(division.place(number)));
            }
            let division = division(&told).expect("a line separates them");
            let off = (division.dark - Along::angle(angle).area_below(offset)).abs();
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
                let middles = middles(&Along::angle(angle), offset);
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
        assert!(division(&told).is_none());
    }
}
