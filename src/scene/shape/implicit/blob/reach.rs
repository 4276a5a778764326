//! Bounding spheres of the components of a blob: which of them a part of a line may hit, and where their fields may
//! reach the threshold, eight at a time in single precision.
//!
//! Bounds of the field decide only what need not be computed: between two coordinates where an upper bound of it stays
//! below the threshold there is no root, and between a point certainly outside and one certainly inside there is one, so
//! that nothing behind matters to the nearest. The roots themselves are computed in double precision elsewhere.
//!
//! The line is first moved in double precision to its closest approach to the common centre, and lengths are scaled by
//! the common size. All values are then of size 1, with errors far below [`SLACK`].

use super::component::Component;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Number of components that fit into one bit mask.
pub(super) const MAX_COMPONENTS: usize = 64;
const LANES: usize = 8;
/// Above the error of a coordinate along the line, and of the squared distance from the line minus the squared radius.
const SLACK: f32 = 1e-4;
/// Distance of a ray's origin, in units of the common size, beyond which the closest approach is too inaccurate.
const MAX_DISTANCE: f64 = 1e6;
/// Coordinates along the line beyond those of all spheres.
const FAR: f64 = 8.0;
/// Factor that moves a joint on the wrong side of a coordinate beyond all others.
const PENALTY: f32 = 1e6;
const GROUPS: usize = MAX_COMPONENTS / LANES;
/// Pieces that a line is scanned in.
const PIECES: u32 = 16;
/// Pieces that are scanned for a point inside once the field may reach the threshold.
const TRIES: u32 = 4;
/// Share of the threshold above the error of a sum of fields.
const ROUNDING: f32 = 1e-5;
/// Distance from the surface along which the field must fall, and by how many thresholds per unit.
const DEPARTURE: f32 = 0.02;
const FALL: f32 = 1e-2;
/// With this strength a component reaches the threshold wherever [`SLACK`] is left of its squared radius.
const MAX_STRENGTH: f32 = 1e30;

/// Eight spheres in units of the common size. The radius of an unused lane is NaN.
#[derive(Clone, Copy, Debug)]
struct Spheres8 {
    centre: [[f32; LANES]; 3],
    /// Squared radius plus [`SLACK`].
    outer_sq: [f32; LANES],
    /// Twice [`SLACK`] where the component is this sphere, else NaN.
    margin_sq: [f32; LANES],
    /// In units of the threshold, divided by the fourth power of the radius.
    strength: [f32; LANES],
}

/// Bounding spheres of up to [`MAX_COMPONENTS`] components.
#[derive(Clone, Debug)]
pub(super) struct BoundingSpheres {
    common_centre: DVec3,
    scale: f64,
    spheres: Vec<Spheres8>,
    /// True if the components are spheres of positive strength, and the threshold is positive.
    pub(super) is_plain: bool,
}

/// A line in units of the common size, from its closest approach to the common centre.
#[derive(Clone, Copy)]
pub(super) struct Line<'b> {
    spheres: &'b [Spheres8],
    origin: [f32; 3],
    dir: [f32; 3],
    /// Coordinate of the ray's origin, and length of its direction.
    start: f64,
    rate: f64,
}

/// The part of a line on which the roots of a query lie.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Bit mask of the components that may bound or overlap its intervals.
    pub(super) reached: u64,
}

/// Finds the [`Part`] between two coordinates, as coordinates that cut it short if they lie within, and the bit mask.
/// With `enough` it ends behind a point that is surely inside, with something outside between both, or at `enough` if
/// nothing may be inside beyond; with `skips` it begins at the first point that may be inside, `None` without one.
struct Search<'b> {
    line: &'b Line<'b>,
    from: f32,
    to: f32,
    enough: Option<f32>,
    skips: bool,
}

/// Finds the first coordinate at which the field may reach the threshold again if it certainly falls from the surface.
struct Departure<'b> {
    line: &'b Line<'b>,
    from: f32,
}

/// The groups of spheres that a line hits.
struct OnLine<F: F64x4> {
    spheres: [OnLine8<F>; GROUPS],
    /// Indices of the groups.
    groups: [usize; GROUPS],
    len: usize,
}

/// Eight spheres in relation to a line.
#[derive(Clone, Copy)]
struct OnLine8<F: F64x4> {
    /// Coordinates of the centres.
    along: F::F32,
    /// Squared radii less the squared distances from the line, plus [`SLACK`]; negative or NaN where the line misses.
    outer_sq: F::F32,
    /// The same less [`SLACK`] instead where the component is this sphere, else NaN.
    inner_sq: F::F32,
    strength: F::F32,
}

impl BoundingSpheres {
    /// `None` if there are too many components, or some are too large.
    pub(super) fn new<'c>(
        components: impl ExactSizeIterator<Item = &'c Component> + Clone,
        threshold: f64,
    ) -> Option<Self> {
        if components.len() > MAX_COMPONENTS {
            return None;
        }
        let bounds = components.clone().fold(Bounds::EMPTY, |bounds, component| {
            let (centre, radius) = component.bounding_sphere();
            bounds.union(&Bounds::new(centre - radius, centre + radius))
        });
        let common_centre = bounds.centre();
        let scale = (bounds.max - bounds.min).max_element();
        let is_sound = common_centre.is_finite() && scale.is_normal() && (1.0 / scale).is_normal();
        let components: Vec<_> = components.collect();
        let is_positive =
            |component: &&Component| component.is_sphere() && component.strength > 0.0;
        is_sound.then(|| BoundingSpheres {
            common_centre,
            scale,
            is_plain: threshold > 0.0 && components.iter().all(is_positive),
            spheres: components
                .chunks(LANES)
                .map(|components| Spheres8::new(components, common_centre, scale, threshold))
                .collect(),
        })
    }

    /// The line of a ray; `None` if it is too far away.
    #[inline(always)]
    pub(super) fn line(&self, ray: &Ray) -> Option<Line<'_>> {
        let origin = (ray.origin - self.common_centre) / self.scale;
        let length = ray.dir.length();
        let dir = ray.dir / length;
        let start = origin.dot(dir);
        let nearest = origin - start * dir;
        // A positive test, so that NaN counts as not in range.
        let is_in_range = dir.is_finite() && origin.abs().max_element() < MAX_DISTANCE;
        let rate = length / self.scale;
        (is_in_range && rate.is_normal()).then(|| Line {
            spheres: &self.spheres,
            origin: nearest.as_vec3().to_array(),
            dir: dir.as_vec3().to_array(),
            start,
            rate,
        })
    }
}

impl Line<'_> {
    /// The coordinate at `t`.
    #[inline(always)]
    fn along(&self, t: f64) -> f32 {
        to_f32((self.start + t * self.rate).clamp(-FAR, FAR))
    }

    /// The part of the line with the roots between `from` and `to` up to the first beyond `enough`, if that is given;
    /// with `skips` only that one is needed. `None` if there is none. The threshold must be positive for both.
    #[inline(always)]
    pub(super) fn part(
        &self,
        lanes: SimdLevel,
        [from, to]: [f64; 2],
        enough: Option<f64>,
        skips: bool,
    ) -> Option<Part> {
        let (begin, end, reached) = lanes.run(Search {
            line: self,
            from: self.along(from),
            to: self.along(to),
            enough: enough.map(|enough| self.along(enough)),
            skips,
        })?;
        let t = |along: f32| (f64::from(along) - self.start) / self.rate;
        Some(Part {
            from: from.max(t(begin)),
            to: to.min(t(end).max(enough.unwrap_or(to))),
            reached,
        })
    }

    /// The `t` up to which a ray that leaves the surface of plain components certainly does not hit it again, if the
    /// field certainly falls from its origin.
    #[inline(always)]
    pub(super) fn departure(&self, lanes: SimdLevel) -> Option<f64> {
        let from = self.along(0.0);
        let first = lanes.run(Departure { line: self, from })?;
        Some((f64::from(first - SLACK) - self.start) / self.rate)
    }
}

impl Spheres8 {
    fn new(components: &[&Component], common_centre: DVec3, scale: f64, threshold: f64) -> Self {
        let mut result = Spheres8 {
            centre: [[0.0; LANES]; 3],
            outer_sq: [f32::NAN; LANES],
            margin_sq: [f32::NAN; LANES],
            strength: [0.0; LANES],
        };
        for (lane, component) in components.iter().enumerate() {
            let (centre, radius) = component.bounding_sphere();
            let centre = ((centre - common_centre) / scale).as_vec3();
            for axis in 0..3 {
                result.centre[axis][lane] = centre[axis];
            }
            let radius_sq = (radius / scale).powi(2);
            result.outer_sq[lane] = to_f32(radius_sq) + SLACK;
            let strength = component.strength / threshold / radius_sq.powi(2);
            result.strength[lane] = to_f32(strength).min(MAX_STRENGTH);
            if component.is_sphere() {
                result.margin_sq[lane] = 2.0 * SLACK;
            }
        }
        result
    }

    #[inline(always)]
    fn on<F: F64x4>(&self, line: &Line) -> OnLine8<F> {
        let splat = <F::F32>::splat;
        let x = <F::F32>::from_array(&self.centre[0]) - splat(line.origin[0]);
        let y = <F::F32>::from_array(&self.centre[1]) - splat(line.origin[1]);
        let z = <F::F32>::from_array(&self.centre[2]) - splat(line.origin[2]);
        let (dx, dy, dz) = (splat(line.dir[0]), splat(line.dir[1]), splat(line.dir[2]));
        let along = x * dx + y * dy + z * dz;
        let distance_sq = x * x + y * y + z * z - along * along;
        let outer_sq = <F::F32>::from_array(&self.outer_sq) - distance_sq;
        OnLine8 {
            along,
            outer_sq,
            inner_sq: outer_sq - <F::F32>::from_array(&self.margin_sq),
            strength: <F::F32>::from_array(&self.strength),
        }
    }
}

impl<F: F64x4> OnLine<F> {
    #[inline(always)]
    fn new(line: &Line) -> Self {
        let zero = <F::F32>::splat(0.0);
        let none = OnLine8 {
            along: zero,
            outer_sq: zero,
            inner_sq: zero,
            strength: zero,
        };
        let mut result = OnLine {
            spheres: [none; GROUPS],
            groups: [0; GROUPS],
            len: 0,
        };
        for (group, spheres) in line.spheres.iter().enumerate() {
            let on_line = spheres.on::<F>(line);
            if zero.le(on_line.outer_sq) != 0 {
                result.spheres[result.len % GROUPS] = on_line;
                result.groups[result.len % GROUPS] = group;
                result.len += 1;
            }
        }
        result
    }

    /// Coordinates between which the spheres lie.
    #[inline(always)]
    fn ends(&self) -> [f32; 2] {
        let splat = <F::F32>::splat;
        let (mut begin, mut end) = (splat(f32::INFINITY), splat(f32::NEG_INFINITY));
        for sphere in &self.spheres[..self.len] {
            // NaN where the line misses: least and greatest numbers ignore it.
            let half = sphere.outer_sq.sqrt() + splat(SLACK);
            begin = (sphere.along - half).lane_min(begin);
            end = (sphere.along + half).lane_max(end);
        }
        [least::<F>(begin), greatest::<F>(end)]
    }

    /// Upper bound of the field between two coordinates, in units of the threshold.
    #[inline(always)]
    fn max_field(&self, from: f32, to: f32) -> f32 {
        let splat = <F::F32>::splat;
        let (zero, from, to) = (splat(0.0), splat(from), splat(to));
        let mut sum = zero;
        for sphere in &self.spheres[..self.len] {
            let outside = (from - sphere.along)
                .lane_max(sphere.along - to)
                .lane_max(zero);
            let falloff = (sphere.outer_sq - outside * outside).lane_max(zero);
            sum = sum + falloff * falloff * sphere.strength;
        }
        total::<F>(sum)
    }

    /// Lower bound of the field at a coordinate.
    #[inline(always)]
    fn min_field(&self, at: f32) -> f32 {
        let (zero, at) = (<F::F32>::splat(0.0), <F::F32>::splat(at));
        let mut sum = zero;
        for sphere in &self.spheres[..self.len] {
            let falloff =
                (sphere.inner_sq - (at - sphere.along) * (at - sphere.along)).lane_max(zero);
            sum = sum + falloff * falloff * sphere.strength;
        }
        total::<F>(sum)
    }

    /// True if the field certainly falls from a coordinate on for [`DEPARTURE`].
    #[inline(always)]
    fn falls(&self, from: f32) -> bool {
        let splat = <F::F32>::splat;
        let (zero, departure) = (splat(0.0), splat(DEPARTURE));
        let from = splat(from - 0.25 * SLACK);
        let mut slope = zero;
        for sphere in &self.spheres[..self.len] {
            let (passed, ahead) = (
                zero.lane_max(from - sphere.along),
                zero.lane_max(sphere.along - from),
            );
            let gone = passed + departure;
            let fall = (sphere.inner_sq - gone * gone).lane_max(zero) * passed;
            let nearest = (ahead - departure).lane_max(zero);
            let rise = (sphere.outer_sq - nearest * nearest).lane_max(zero) * ahead;
            slope = slope + (rise - fall) * sphere.strength;
        }
        4.0 * total::<F>(slope) < -FALL
    }

    /// A coordinate between `begin` and `end` before which the field stays below the threshold, and one where it is
    /// surely above, with some point below between `enough` and it; either if there is one.
    #[inline(always)]
    fn scan(&self, [begin, end]: [f32; 2], enough: f32) -> [Option<f32>; 2] {
        let piece = (end - begin) / to_f32(f64::from(PIECES));
        let at = |piece_number: u32| begin + piece * to_f32(f64::from(piece_number));
        let (mut first, mut next, mut tries) = (None, 0, 0);
        let mut is_below = begin > enough;
        while next < PIECES && tries < TRIES {
            let mut count = 1 << (next | (PIECES / 2)).trailing_zeros();
            while count > 0 && self.max_field(at(next), at(next + count)) >= 1.0 - ROUNDING {
                count /= 2;
            }
            next += count.max(1);
            if count > 0 {
                is_below |= at(next) > enough;
                continue;
            }
            first = first.or(Some(at(next - 1)));
            if is_below {
                if self.min_field(at(next)) > 1.0 + ROUNDING {
                    return [first, Some(at(next))];
                }
                tries += 1;
            }
        }
        [first, None]
    }

    /// Bit mask of the components that may bound or overlap the intervals between two coordinates: not those before
    /// the last joint up to `from` nor those after the first joint from `to` on.
    #[inline(always)]
    fn reached(&self, from: f32, to: f32) -> u64 {
        let splat = <F::F32>::splat;
        let (zero, slack, penalty) = (splat(0.0), splat(SLACK), splat(PENALTY));
        let (from, to) = (splat(from), splat(to));
        let (mut last_before, mut first_after) = (splat(f32::NEG_INFINITY), splat(f32::INFINITY));
        let mut spans = [(zero, zero); GROUPS];
        for (sphere, span) in self.spheres[..self.len].iter().zip(&mut spans) {
            // NaN where a line may miss, which least and greatest numbers ignore.
            let outer = sphere.outer_sq.sqrt() + slack;
            let inner = sphere.inner_sq.sqrt() - slack;
            let along = sphere.along;
            let (enter, leave) = (along - inner, along + inner);
            let (low, high) = (along - outer, along + outer);
            *span = (low, high);
            let before = low - penalty * zero.lane_max(enter - from);
            last_before = before.lane_max(last_before);
            let before = leave - penalty * zero.lane_max(high - from);
            last_before = before.lane_max(last_before);
            let after = enter + penalty * zero.lane_max(to - low);
            first_after = after.lane_min(first_after);
            let after = high + penalty * zero.lane_max(to - leave);
            first_after = after.lane_min(first_after);
        }
        let last_before = splat(greatest::<F>(last_before));
        let first_after = splat(least::<F>(first_after));
        let mut reached = 0;
        for (&(low, high), group) in spans[..self.len].iter().zip(&self.groups) {
            reached |= u64::from(last_before.le(high) & low.le(first_after)) << (LANES * group);
        }
        reached
    }
}

/// The nearest number in single precision.
#[inline(always)]
fn to_f32(x: f64) -> f32 {
    DVec3::splat(x).as_vec3().x
}

#[inline(always)]
fn total<F: F64x4>(x: F::F32) -> f32 {
    let [a, b, c, d, e, f, g, h] = x.to_array();
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

#[inline(always)]
fn least<F: F64x4>(x: F::F32) -> f32 {
    let [a, b, c, d, e, f, g, h] = x.to_array();
    (a.min(b).min(c.min(d))).min(e.min(f).min(g.min(h)))
}

#[inline(always)]
fn greatest<F: F64x4>(x: F::F32) -> f32 {
    let [a, b, c, d, e, f, g, h] = x.to_array();
    (a.max(b).max(c.max(d))).max(e.max(f).max(g.max(h)))
}

impl SimdKernel for Search<'_> {
    type Output = Option<(f32, f32, u64)>;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Option<(f32, f32, u64)> {
        let (mut begin, mut end) = (f32::NEG_INFINITY, f32::INFINITY);
        let on_line = OnLine::<F>::new(self.line);
        if let Some(enough) = self.enough {
            let beyond = enough + SLACK;
            let [low, high] = on_line.ends();
            let ends = [low.max(enough - SLACK), high.min(self.to + SLACK)];
            let [first, inside] = on_line.scan(ends, beyond);
            if self.skips {
                begin = first? - SLACK;
            }
            end = match inside {
                Some(inside) => inside + SLACK,
                None if first.is_none() => beyond,
                None => end,
            };
        }
        let reached = on_line.reached(self.from.max(begin), self.to.min(end));
        Some((begin, end, reached))
    }
}

impl SimdKernel for Departure<'_> {
    type Output = Option<f32>;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Option<f32> {
        let on_line = OnLine::<F>::new(self.line);
        if !on_line.falls(self.from) {
            return None;
        }
        let ends = [self.from + DEPARTURE, on_line.ends()[1]];
        Some(on_line.scan(ends, self.from)[0].unwrap_or(f32::INFINITY))
    }
}
