//! `sor { number of points, <r, y>, ... [open] }`: a surface of revolution about the y axis whose squared radius is a
//! piecewise cubic of the height.
//!
//! Between the second point and the last but one, `r²` takes the value and the slope `2·r·dr/dy` at each point, with
//! `dr/dy` from both neighbours. Along a ray `r²(y) − x² − z²` is a cubic on each interval between two points, clipped
//! to the largest radius, centred and scaled to -1..1. Neighbouring intervals share the sign at the height between
//! them. Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`), since
//! the ray is first moved to the point nearest to the surface's centre. Caps close the solid at the first and the last
//! height; `open` makes them invisible.
//!
//! A surface of revolution outside of CSG objects is hit where POV-Ray finds a hit instead ([`closed_form`]), without
//! `--clean-cuts` and `sturm`.

use self::closed_form::{Caps, Segment};
use super::spline;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::{Normalization, power_of_two};
use crate::base::math::roots::polynomial::{sign_changes, sign_changes_between};
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::solid::axial::{APEX, BASE, SIDE, Slab};
use crate::scene::shape::{Crossing, Crossings, Geometry, Root, Start, first_visible};
use glam::{DAffine3, DVec2, DVec3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A ray is clipped a little wide, so that the ends of an interval lie outside whatever the roundings.
const CLIP: f64 = 1.001;

/// A surface of revolution. Face 0 is the side, 1 the cap at the lower end, 2 the cap at the upper one.
#[derive(Clone, Debug, PartialEq)]
pub struct Sor {
    profile: Arc<Profile>,
    is_open: bool,
    /// True if rays hit it where POV-Ray finds a hit.
    has_povray_hits: bool,
    /// True with `sturm`, which makes POV-Ray find its hits by iteration.
    has_sturm: bool,
    /// True if it is opaque, and shadows itself from POV-Ray's least distance of other rays on: it has mostly blocked the light
    /// before, and is tested for that first.
    has_near_shadows: bool,
    /// Length of a unit of the scene.
    unit: f64,
    /// The rounding of unit vectors.
    normalization: Normalization,
}

#[derive(Debug, PartialEq)]
struct Profile {
    rings: Vec<Ring>,
    /// The same curves in POV-Ray's form.
    segments: Vec<Segment>,
    /// The largest radius.
    rim: f64,
    low: f64,
    high: f64,
    /// Squared radii of the caps.
    ends_sq: [f64; 2],
}

/// The curve between two points: `r²` by rising power of `x`, with `-1 <= x <= 1` from the lower to the upper height.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ring {
    low: f64,
    high: f64,
    c: [f64; 4],
}

impl Sor {
    /// Reads the points and `open`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, fewer than four points, a negative radius, heights that do not rise.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let points = spline::read_points(args, "surface of revolution")?;
        let at = at.to(args.last_span());
        let fault = |message: String, hint: &str| {
            Err(Box::new(Diagnostic::error(at, message).with_hint(hint)))
        };
        if points.len() < 4 {
            return fault(
                "surface of revolution must have at least four points".to_owned(),
                "the first and the last only bend the curve",
            );
        }
        if let Some(point) = points.iter().find(|point| point.x < 0.0) {
            let message = format!("a point has a negative radius: <{}, {}>", point.x, point.y);
            return fault(message, "a radius is a distance from the y axis");
        }
        let count = points.len();
        let is_rising = points[1..count - 1].windows(2).all(|p| p[0].y < p[1].y);
        let has_slopes = points.windows(3).all(|p| p[0].y != p[2].y);
        if !is_rising || !has_slopes {
            return fault(
                "the heights of a surface of revolution must rise from point to point".to_owned(),
                "a `lathe` takes curves that turn back",
            );
        }
        let is_open = args.accept(Word::Open)?;
        Ok(Sor {
            profile: Arc::new(Profile::new(&points)),
            is_open,
            has_povray_hits: false,
            has_sturm: false,
            has_near_shadows: false,
            unit: 1.0,
            normalization: Normalization::of_version(args.is_for_3_8()),
        })
    }

    /// True if rays hit it where POV-Ray finds a hit.
    pub(crate) fn has_povray_hits(&self) -> bool {
        self.has_povray_hits
    }

    /// Makes rays hit it where POV-Ray finds a hit.
    pub(crate) fn use_povray_hits(&mut self) {
        self.has_povray_hits = !self.has_sturm;
    }

    /// Makes shadow rays that leave it hit it as near as other rays do.
    pub(crate) fn use_near_shadows(&mut self) {
        self.has_near_shadows = true;
    }

    /// The first hit with `from < t < to` as POV-Ray finds it.
    fn povray_hit(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let profile = &self.profile;
        let length = ray.dir.length();
        let along = Ray::new(ray.origin, self.normalization.divided(ray.dir, length));
        let caps = Caps {
            heights: [profile.low, profile.high],
            radii_sq: profile.ends_sq,
            is_open: self.is_open,
        };
        let (from, unit) = (from * length, self.unit * length);
        let hit = closed_form::nearest(&profile.segments, &caps, &along, from, unit)?;
        let t = hit.k / length;
        let crossing = match hit.is_exit {
            true => Crossing::Leave,
            false => Crossing::Enter,
        };
        (t < to).then_some(root(t, hit.face, crossing))
    }

    /// The bounds of the curve as it is computed.
    fn hull(&self) -> Bounds {
        let Profile { rim, low, high, .. } = *self.profile;
        Bounds::new(DVec3::new(-rim, low, -rim), DVec3::new(rim, high, rim))
    }
}

impl Profile {
    /// Builds the profile from at least four points of rising height.
    fn new(points: &[DVec2]) -> Self {
        let rings: Vec<Ring> = points.windows(4).map(Ring::new).collect();
        let segments = points.windows(4).map(Segment::new).collect();
        let rim_sq = rings.iter().map(Ring::max_radius_sq).fold(0.0, f64::max);
        let (first, last) = (points[1], points[points.len() - 2]);
        Profile {
            rings,
            segments,
            rim: rim_sq.sqrt(),
            low: first.y,
            high: last.y,
            ends_sq: [first.x * first.x, last.x * last.x],
        }
    }

    fn crossings(&self, ray: &Ray, is_open: bool) -> Crossings {
        let mut roots = Crossings::new();
        // Rescale the direction so that it can be squared, and start from the point nearest to the centre.
        let dir_size = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir / dir_size;
        let middle = DVec3::new(0.0, 0.5 * (self.low + self.high), 0.0);
        let start = (middle - ray.origin).dot(dir) / dir.dot(dir);
        let near = Ray::new(ray.origin + start * dir, dir);
        let Some(slab) = Slab::between(&near, self.low, self.high) else {
            return roots;
        };
        let Some(reach) = self.reach(&near) else {
            return roots;
        };
        self.walk(&near, &slab, reach.0, reach.1, &mut roots);
        for root in &mut roots {
            root.t = (start + root.t) / dir_size;
            root.is_visible = !is_open || root.face == SIDE;
        }
        if roots.iter().any(|root| !root.t.is_finite()) {
            roots.clear();
        }
        roots
    }

    /// Interval of a line within the largest radius.
    fn reach(&self, ray: &Ray) -> Option<(f64, f64)> {
        let (origin, dir) = (across(ray.origin), across(ray.dir));
        let rim = self.rim * CLIP;
        if dir == DVec3::ZERO {
            return (origin.dot(origin) < rim * rim).then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        sphere_span(origin, dir, rim)
    }

    /// Appends the roots of all rings in the order in which the line passes them.
    fn walk(&self, ray: &Ray, slab: &Slab, near: f64, far: f64, roots: &mut Crossings) {
        let count = self.rings.len();
        let rises = ray.dir.y >= 0.0;
        let mut is_inside = false;
        if slab.enter.t > near {
            let cap = usize::from(slab.enter.face == APEX);
            is_inside = self.is_within(self.ends_sq[cap], ray, slab.enter.t);
            if is_inside {
                roots.push(root(slab.enter.t, slab.enter.face, Crossing::Enter));
            }
        }
        for step in 0..count {
            let number = if rises { step } else { count - 1 - step };
            let ring = &self.rings[number];
            let Some((from, to)) = ring.interval(ray) else {
                continue;
            };
            let is_last = to >= far;
            if to <= near {
                continue;
            }
            if from >= far {
                break;
            }
            let end_sq = match (step + 1 == count, rises) {
                (true, true) => self.ends_sq[1],
                (true, false) => self.ends_sq[0],
                (false, true) => ring.value(1.0),
                (false, false) => ring.value(-1.0),
            };
            let ends_inside = !is_last && self.is_within(end_sq, ray, to);
            let (from, to) = (from.max(near), to.min(far));
            ring.solve(ray, from, to, is_inside, ends_inside, roots);
            is_inside = ends_inside;
        }
        if is_inside {
            roots.push(root(slab.leave.t, slab.leave.face, Crossing::Leave));
        }
    }

    fn is_within(&self, radius_sq: f64, ray: &Ray, t: f64) -> bool {
        let p = across(ray.at(t));
        p.dot(p) < radius_sq
    }

    /// Index of the ring at a height, clamped to the first and the last.
    fn ring_at(&self, height: f64) -> usize {
        let above = self.rings.partition_point(|ring| ring.high < height);
        above.min(self.rings.len() - 1)
    }
}

impl Ring {
    /// The ring between the second and the third of four points.
    fn new(p: &[DVec2]) -> Self {
        let (start, end) = (p[1], p[2]);
        let slope = |before: DVec2, here: DVec2, after: DVec2| {
            2.0 * here.x * (after.x - before.x) / (after.y - before.y)
        };
        let half = 0.5 * (end.y - start.y);
        let slopes = [
            half * slope(p[0], start, end),
            half * slope(start, end, p[3]),
        ];
        let values = [start.x * start.x, end.x * end.x];
        // Hermite interpolation on -1..1.
        let (sum, difference) = (values[0] + values[1], values[1] - values[0]);
        let c = [
            0.5 * sum + 0.25 * (slopes[0] - slopes[1]),
            0.75 * difference - 0.25 * (slopes[0] + slopes[1]),
            0.25 * (slopes[1] - slopes[0]),
            0.25 * (slopes[0] + slopes[1]) - 0.25 * difference,
        ];
        Ring {
            low: start.y,
            high: end.y,
            c,
        }
    }

    fn value(&self, x: f64) -> f64 {
        let [a, b, c, d] = self.c;
        a + x * (b + x * (c + x * d))
    }

    fn slope(&self, x: f64) -> f64 {
        let [_, b, c, d] = self.c;
        b + x * (2.0 * c + x * 3.0 * d)
    }

    /// Curve parameter at a height.
    fn param(&self, height: f64) -> f64 {
        ((height - self.low) - (self.high - height)) / (self.high - self.low)
    }

    /// Largest squared radius.
    fn max_radius_sq(&self) -> f64 {
        let [_, b, c, d] = self.c;
        let turns = sign_changes(&[b, 2.0 * c, 3.0 * d]);
        let params = turns.iter().copied().chain([-1.0, 1.0]);
        params.map(|x| self.value(x)).fold(0.0, f64::max)
    }

    /// Interval of a line between both heights.
    fn interval(&self, ray: &Ray) -> Option<(f64, f64)> {
        let slab = Slab::between(ray, self.low, self.high)?;
        // A horizontal ray at the height between two rings belongs to the upper one.
        (ray.dir.y != 0.0 || ray.origin.y < self.high).then_some((slab.enter.t, slab.leave.t))
    }

    /// Appends the roots on a finite interval, given on which side its ends lie.
    fn solve(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        starts_inside: bool,
        ends_inside: bool,
        roots: &mut Crossings,
    ) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let point = ray.at(middle);
        let step = ray.dir * half;
        let x = self.param(point.y);
        let dx = 2.0 * step.y / (self.high - self.low);
        let [_, _, c, d] = self.c;
        let (p, v) = (across(point), across(step));
        // Squared distance from the axis less the squared radius.
        let excess = [
            p.dot(p) - self.value(x),
            2.0 * p.dot(v) - dx * self.slope(x),
            v.dot(v) - dx * dx * (c + 3.0 * d * x),
            -dx * dx * dx * d,
        ];
        let reach = excess[1].abs() + excess[2].abs() + excess[3].abs();
        if starts_inside == ends_inside && excess[0].abs() > reach {
            return;
        }
        let mut is_inside = starts_inside;
        for param in sign_changes_between(&excess, starts_inside, ends_inside) {
            let crossing = if is_inside {
                Crossing::Leave
            } else {
                Crossing::Enter
            };
            roots.push(root(middle + half * param, SIDE, crossing));
            is_inside = !is_inside;
        }
    }
}

fn root(t: f64, face: u32, crossing: Crossing) -> Root {
    Root {
        t,
        crossing,
        face,
        is_visible: true,
    }
}

/// Component perpendicular to the axis.
fn across(v: DVec3) -> DVec3 {
    DVec3::new(v.x, 0.0, v.z)
}

impl Geometry for Sor {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend(self.profile.crossings(ray, self.is_open));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if self.has_povray_hits {
            return self.povray_hit(ray, from, to);
        }
        first_visible(&self.profile.crossings(ray, self.is_open), from, to)
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match face {
            BASE => DVec3::NEG_Y,
            APEX => DVec3::Y,
            _ => {
                let normal = self.profile.segments[self.profile.ring_at(point.y)].normal(point);
                // Zero where the curve reaches the axis in a point.
                if normal == DVec3::ZERO {
                    DVec3::Y
                } else {
                    normal
                }
            }
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let profile = &self.profile;
        if !(profile.low <= point.y && point.y <= profile.high) {
            return false;
        }
        let ring = &profile.rings[profile.ring_at(point.y)];
        let p = across(point);
        p.dot(p) <= ring.value(ring.param(point.y))
    }

    fn bounds(&self) -> Bounds {
        self.hull().with_slack()
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        Some((self.hull(), DAffine3::IDENTITY))
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    /// `u` goes around the axis from +x towards +z, and `v` up the curve by the index of the ring; over the caps it
    /// runs from -1 at the centre of the lower one to 0 at its rim, and from 1 to 2 on the upper one.
    fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let profile = &self.profile;
        let around = point.z.atan2(point.x) / TAU;
        let around = if around < 0.0 { around + 1.0 } else { around };
        let number = profile.ring_at(point.y);
        let ring = &profile.rings[number];
        let [base, apex] = profile
            .ends_sq
            .map(|radius_sq| across(point).length() / radius_sq.sqrt());
        match face {
            BASE => return Some([around, base - 1.0]),
            APEX => return Some([around, 2.0 - apex]),
            _ => {}
        }
        let count = |n: usize| f64::from(u32::try_from(n).unwrap_or(u32::MAX));
        let share = (0.5 * (ring.param(point.y) + 1.0)).clamp(0.0, 1.0);
        Some([around, (count(number) + share) / count(profile.rings.len())])
    }

    fn takes_sturm(&self) -> bool {
        true
    }

    fn use_sturm(&mut self) {
        self.has_sturm = true;
    }

    fn scale_scene_lengths(&mut self, factor: f64) {
        self.unit *= factor;
    }

    /// Makes callers use `nearest_beside` for rays that leave the surface: POV-Ray's hits are too far beside it to tell which
    /// of them a ray has just left.
    fn is_faceted(&self) -> bool {
        self.has_povray_hits
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, _: u32) -> Option<Root> {
        let from = if self.has_near_shadows { 0.0 } else { from };
        self.nearest(ray, from, to)
    }
}

mod closed_form;
#[cfg(test)]
mod tests;
