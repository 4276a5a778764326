//! `superellipsoid { <e, n> }`: where `(|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1`.
//!
//! The surface is also the level set 1 of the norm `N = ((|x|^p + |y|^p)^(q/p) + |z|^q)^(1/q)`, with `p = 2/e` and
//! `q = 2/n`. `N` is homogeneous of degree one, so it neither overflows nor flattens out, however large the powers are;
//! a zero `e` or `n` makes edges (`N` is then the maximum of both terms), as in POV-Ray.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`).
//!
//! Up to `e = n = 2` the norm is convex along a ray, and Newton's iteration from where the ray enters the bounding box
//! finds the near root or turns away; likewise the far one from the other end. Beyond, the surface has hollow sides:
//! the ray is split where a coordinate is zero. Most pieces, and most rays that leave the surface, are shown to stay
//! outside by lower bounds of the norm that are concave along the ray (`floors`); on the others values and slopes of
//! `N` are bounded from those at the ends.
//!
//! Negative powers are drawn as POV-Ray draws them: where the norm is 1 at coordinates of up to 1.01, on rays that hit the
//! smaller bounding box, without walls (measured). With a negative `n` the norm is below 1 there, and nothing shows.
//!
//! Both searches first run in ten-digit arithmetic, at a fraction of the cost of exact powers (`rough`), the convex one
//! also on ray packets (`four`); a root takes its last digits from the exact norm, and close calls are decided in full
//! precision.

mod exact;
mod lower_bounds;
mod norms;
mod packet;
mod rough;

use self::exact::{Along, derivative, norm, norm_and_derivatives};
use self::rough::{Estimate, Pieces, Rough, SLACK};
use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::{RescaledRay, is_comfortable};
use crate::base::math::roots::bracket::Roots;
use crate::base::math::roots::interval_roots::{IntervalFunction, first_below_zero, sign_changes};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Crossing, Geometry, INSIDE_TOLERANCE, Root, Start, SurfaceSide, first_visible,
};
use glam::{DAffine3, DVec2, DVec3};
use smallvec::SmallVec;

/// A box with edges and corners rounded or drawn in, between -1 and 1. It is one piece, face 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Superellipsoid {
    /// The power of x and y.
    across: f64,
    /// The power of z.
    along: f64,
}

type Crossings = SmallVec<[Root; 4]>;

/// Range of roots that a query needs.
#[derive(Clone, Copy)]
struct RootRange {
    /// Roots before this `t` are not needed.
    from: f64,
    /// Roots beyond one that lies between `enough_after` and `enough_before` are not needed.
    enough_after: f64,
    enough_before: f64,
    /// Added to a parameter before the comparison with these two.
    start: f64,
}

/// Half the width of the bounding box, as `max_extent` reports it in POV-Ray.
const REACH: f64 = 1.0001;

/// Half the width of the box in which POV-Ray searches for the surface.
const SEARCH_REACH: f64 = 1.01;

/// A ray that enters at a steeper slope does not graze: its exit need not be known.
const STEEP: f64 = 1e-3;

impl RootRange {
    const ALL: RootRange = RootRange {
        from: f64::NEG_INFINITY,
        enough_after: f64::INFINITY,
        enough_before: f64::INFINITY,
        start: 0.0,
    };

    fn new(from: f64, enough_after: f64, enough_before: f64) -> Self {
        RootRange {
            from,
            enough_after,
            enough_before,
            start: 0.0,
        }
    }

    /// The same range for parameters counted from `start`.
    fn about(self, start: f64) -> RootRange {
        let rounding = 8.0 * f64::EPSILON * (self.from.abs() + start.abs());
        RootRange {
            from: self.from - start - rounding,
            start,
            ..self
        }
    }

    /// True if no root up to `t` is needed.
    fn is_before(&self, t: f64) -> bool {
        t <= self.from
    }

    fn is_enough(&self, t: f64) -> bool {
        let t = t + self.start;
        self.enough_after < t && t < self.enough_before
    }
}

impl Superellipsoid {
    /// The surface with the exponents `e` and `n`.
    #[must_use]
    pub fn new(e: f64, n: f64) -> Self {
        Superellipsoid {
            across: 2.0 / e,
            along: 2.0 / n,
        }
    }

    /// Reads `<e, n>`.
    ///
    /// # Errors
    /// A malformed vector; exponents that are not finite.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        // A negative zero is a zero.
        let exponents = args.vector2()? + DVec2::ZERO;
        let at = at.to(args.last_span());
        let given = format!("found <{}, {}>", exponents.x, exponents.y);
        if !exponents.is_finite() {
            let message = format!("the exponents of the superellipsoid must be finite, {given}");
            return Err(Box::new(Diagnostic::error(at, message)));
        }
        if exponents.min_element() < 0.0 {
            let drawn = match exponents.y < 0.0 {
                true => "nothing is drawn",
                false => "its surface has gaps",
            };
            let message = format!("a superellipsoid of a negative exponent, {given}: {drawn}");
            args.warn(Diagnostic::warning(at, message));
        }
        Ok(Superellipsoid::new(exponents.x, exponents.y))
    }

    fn has_negative_power(&self) -> bool {
        self.across < 0.0 || self.along < 0.0
    }

    fn is_convex(&self) -> bool {
        self.across >= 1.0 && self.along >= 1.0
    }

    /// `N`, for a point without negative coordinates.
    fn size(&self, p: DVec3) -> f64 {
        norm(norm(p.x, p.y, self.across), p.z, self.along)
    }

    /// `N` and its gradient, for a point without negative coordinates.
    fn size_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let ring = norm(p.x, p.y, self.across);
        let size = norm(ring, p.z, self.along);
        let by_ring = derivative(ring, size, self.along);
        let gradient = DVec3::new(
            by_ring * derivative(p.x, ring, self.across),
            by_ring * derivative(p.y, ring, self.across),
            derivative(p.z, size, self.along),
        );
        (size, gradient)
    }

    /// As [`Self::size_and_gradient`], with the derivatives computed along with the norm; where two terms are equal and
    /// the power is infinite, each has half the slope.
    fn size_and_slopes(&self, p: DVec3) -> (f64, DVec3) {
        let (ring, [of_x, of_y]) = norm_and_derivatives(p.x, p.y, self.across);
        let (size, [of_ring, of_z]) = norm_and_derivatives(ring, p.z, self.along);
        (size, DVec3::new(of_ring * of_x, of_ring * of_y, of_z))
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        self.size_and_gradient(p).1
    }

    fn crossings(&self, ray: &Ray, range: RootRange) -> Crossings {
        if is_comfortable(1.0, ray.dir.dot(ray.dir), ray.origin.dot(ray.origin)) {
            return self.comfortable_crossings(ray, range);
        }
        let Some(rescaled) = RescaledRay::new(ray, 1.0) else {
            return Crossings::new();
        };
        let mut roots = self.comfortable_crossings(&rescaled.ray, RootRange::ALL);
        for root in &mut roots {
            root.t = rescaled.t(root.t);
        }
        roots
    }

    fn comfortable_crossings(&self, ray: &Ray, range: RootRange) -> Crossings {
        let reach = if self.has_negative_power() {
            SEARCH_REACH
        } else {
            1.0
        };
        let Some((from, to)) = clip(ray, reach) else {
            return Crossings::new();
        };
        // Relative to the middle of the clipped interval, so that its ends lose no digits to a far origin.
        let middle = 0.5 * (from + to);
        let ray = Ray::new(ray.at(middle), ray.dir);
        let (from, to) = (from - middle, to - middle);
        let range = range.about(middle);
        let mut roots = if self.has_negative_power() {
            self.open_crossings(&ray, from, to)
        } else if self.is_convex() {
            self.convex_crossings(&ray, from, to, range)
        } else {
            self.hollow_crossings(&ray, from, to, range)
        };
        for root in &mut roots {
            root.t += middle;
        }
        roots
    }

    fn convex_crossings(&self, ray: &Ray, from: f64, to: f64, range: RootRange) -> Crossings {
        let mut roots = Crossings::new();
        let estimates = self.estimates(ray, from, to);
        let starts_within = from < range.from && range.from < to;
        if starts_within && self.is_well_inside(ray.at(range.from)) {
            let leave = self.first_inside(ray, estimates[1], to, from);
            roots.extend(leave.map(|(leave, _)| root(leave, true)));
            return roots;
        }
        let Some((enter, slope)) = self.first_inside(ray, estimates[0], from, to) else {
            return roots;
        };
        if range.is_enough(enter) && slope < -STEEP * ray.dir.length() {
            roots.push(root(enter, false));
        } else if let Some((leave, _)) = self.first_inside(ray, estimates[1], to, from)
            && enter < leave
        {
            roots.extend([root(enter, false), root(leave, true)]);
        }
        roots
    }

    /// True if a point is certainly inside, by ten digits.
    fn is_well_inside(&self, point: DVec3) -> bool {
        let rough = Rough::new(self, &Ray::new(point, DVec3::ZERO));
        rough.is_some_and(|rough| rough.at(0.0).0 < -SLACK)
    }

    /// First point from one end to the other where a convex norm falls below 1, and its slope there.
    fn first_inside(
        &self,
        ray: &Ray,
        estimate: Estimate,
        from: f64,
        to: f64,
    ) -> Option<(f64, f64)> {
        match estimate {
            Estimate::None => return None,
            Estimate::Near(t, slope) => {
                let rough = Rough::new(self, ray)?;
                if let Some(t) = rough.sharpened(t, slope, from.abs().max(to.abs())) {
                    return Some((t, slope));
                }
            }
            Estimate::Unclear => {}
        }
        let excess = |t: f64| {
            let p = ray.at(t);
            let (size, gradient) = self.size_and_slopes(p.abs());
            (size - 1.0, gradient.dot(p.signum() * ray.dir))
        };
        let t = first_below_zero(excess, from, to)?;
        Some((t, excess(t).1))
    }

    /// The crossings of a surface that the box cuts open; what is inside of it ends at invisible walls.
    fn open_crossings(&self, ray: &Ray, from: f64, to: f64) -> Crossings {
        let along = Along {
            shape: self,
            ray: *ray,
        };
        let is_inside = |t: f64| along.value(t) < 0.0;
        let wall = |t: f64, leaves: bool| Root {
            is_visible: false,
            ..root(t, leaves)
        };
        let mut params = Roots::new();
        let stops = stops(ray, from, to);
        for ends in stops.windows(2) {
            let [start, end] = [ends[0], ends[1]].map(|t| (t, is_inside(t)));
            sign_changes(&along, [start, end].map(exact::end), &mut params);
        }
        let mut roots = Crossings::new();
        let starts_inside = is_inside(from);
        if starts_inside {
            roots.push(wall(from, false));
        }
        roots.extend(alternating(&params, starts_inside));
        if roots
            .last()
            .is_some_and(|root| root.crossing == Crossing::Enter)
        {
            roots.push(wall(to, true));
        }
        roots
    }

    fn hollow_crossings(&self, ray: &Ray, from: f64, to: f64, range: RootRange) -> Crossings {
        let stops = stops(ray, from, to);
        let along = Along {
            shape: self,
            ray: *ray,
        };
        let mut roots = Crossings::new();
        if let Some(rough) = Rough::new(self, ray) {
            Pieces::new(rough, &along, range).all_roots(&stops, &mut roots);
            return roots;
        }
        let mut params = Roots::new();
        let mut start = (from, false);
        for &stop in &stops[1..] {
            let end = (stop, stop < to && along.value(stop) < 0.0);
            sign_changes(&along, [start, end].map(exact::end), &mut params);
            start = end;
        }
        roots.extend(alternating(&params, false));
        roots
    }
}

/// An interval of a ray, divided where a coordinate is zero.
fn stops(ray: &Ray, from: f64, to: f64) -> SmallVec<[f64; 5]> {
    let mut stops: SmallVec<[f64; 5]> = SmallVec::new();
    stops.push(from);
    for axis in 0..3 {
        let t = -ray.origin[axis] / ray.dir[axis];
        if from < t && t < to {
            stops.push(t);
        }
    }
    stops.push(to);
    stops.sort_unstable_by(f64::total_cmp);
    stops
}

/// The roots at these parameters, which enter and leave in turn.
fn alternating(params: &[f64], starts_inside: bool) -> impl Iterator<Item = Root> {
    let sides = [starts_inside, !starts_inside].into_iter().cycle();
    params.iter().zip(sides).map(|(&t, leaves)| root(t, leaves))
}

fn root(t: f64, leaves: bool) -> Root {
    Root {
        t,
        crossing: if leaves {
            Crossing::Leave
        } else {
            Crossing::Enter
        },
        face: 0,
        is_visible: true,
    }
}

/// Interval of a line in the box from `-reach` to `reach`; NaN, from a line in a face, excludes nothing.
fn clip(ray: &Ray, reach: f64) -> Option<(f64, f64)> {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (p, d) = (ray.origin[axis], ray.dir[axis]);
        if d == 0.0 {
            if p.abs() > reach {
                return None;
            }
            continue;
        }
        let (a, b) = ((-reach - p) / d, (reach - p) / d);
        (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
    }
    (from < to && from.is_finite() && to.is_finite()).then_some((from, to))
}

impl Geometry for Superellipsoid {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend_from_slice(&self.crossings(ray, RootRange::ALL));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let range = RootRange::new(from, from, to);
        first_visible(&self.crossings(ray, range), from, to)
    }

    fn roots_from(&self, ray: &Ray, from: f64, enough: f64, roots: &mut Vec<Root>) -> bool {
        let range = RootRange::new(from, enough, f64::INFINITY);
        roots.extend_from_slice(&self.crossings(ray, range));
        false
    }

    fn exits_in_cones(&self) -> bool {
        self.is_convex()
    }

    /// A convex norm that grows at the start of the ray does not fall again.
    fn is_exiting(&self, ray: &Ray) -> bool {
        if ray.origin.abs().max_element() > REACH || self.has_negative_power() {
            return false;
        }
        let least_slope = STEEP * ray.dir.length();
        Rough::new(self, ray).is_some_and(|rough| {
            if self.is_convex() {
                rough.at(0.0).1 > least_slope
            } else {
                rough.is_leaving(least_slope)
            }
        })
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let gradient = self.gradient(point.abs());
        // On a sharp ridge the slope across it is infinite and outweighs the others.
        let gradient = if gradient.is_finite() {
            gradient
        } else {
            gradient.map(|slope| f64::from(u8::from(slope == f64::INFINITY)))
        };
        let normal = point.signum() * gradient;
        if normal == DVec3::ZERO {
            DVec3::X
        } else {
            normal
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        self.size(point.abs()) < 1.0 + INSIDE_TOLERANCE
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Inside
    }

    fn bounds(&self) -> Bounds {
        let reach = if self.has_negative_power() {
            SEARCH_REACH
        } else {
            REACH
        };
        Bounds::new(DVec3::splat(-reach), DVec3::splat(reach))
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        let bounds = Bounds::new(DVec3::splat(-REACH), DVec3::splat(REACH));
        self.has_negative_power()
            .then_some((bounds, DAffine3::IDENTITY))
    }

    fn shows_beyond_its_box(&self) -> bool {
        self.has_negative_power()
    }

    /// The inside of a surface that the box cuts open goes on beyond the walls.
    fn may_miss_roots(&self) -> bool {
        self.has_negative_power()
    }

    /// A surface that the box cuts open is the boundary of all points where the norm is below 1.
    fn extends_beyond_bounds(&self) -> bool {
        self.has_negative_power()
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
