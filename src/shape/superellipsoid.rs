//! `superellipsoid { <e, n> }`: where `(|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1`.
//!
//! The same surface is where the size `N = ((|x|^p + |y|^p)^(q/p) + |z|^q)^(1/q)`, with `p = 2/e` and `q = 2/n`, is 1.
//! `N` grows in proportion with the point, so it neither overflows nor flattens out, however large the powers are; a
//! power of zero for `e` or `n` makes edges (`N` is then the larger of both), as in POV-Ray.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`).
//!
//! Up to `e = n = 2` the size is convex along a ray, and Newton's iteration from where the ray enters the box around it
//! finds the near root or turns away; the far one from the other end. Beyond, the surface has hollow sides: the ray is
//! cut where a coordinate is zero, and on each piece values and slopes of `N` are bounded by those of its ends.
//!
//! Both ways are first gone in numbers of ten digits, which cost a fraction of exact powers (`rough`); a root takes its
//! last digits from the exact size, and what is too close to call is asked anew in exact numbers.

mod rough;

use self::rough::{Estimate, Pieces, Rough};
use super::{Geometry, Root, Start, first_visible, span};
use crate::args::{Args, Parse};
use crate::math::conditioning::{Eased, is_comfortable};
use crate::math::enclosed::{Enclosed, Range, first_below_zero, sign_changes};
use crate::math::polynomial::Places;
use crate::math::{Bounds, Ray, Step};
use crate::source::Diagnostic;
use glam::DVec3;
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

/// The size along a piece of a ray on which no coordinate changes sign.
struct Along<'s> {
    shape: &'s Superellipsoid,
    ray: Ray,
}

/// How far the box of the shape goes: `max_extent` tells it, as in POV-Ray.
const REACH: f64 = 1.0001;

/// A ray that enters at a steeper slope does not touch: where it leaves need not be known.
const STEEP: f64 = 1e-3;

impl Superellipsoid {
    /// The surface with the exponents `e` and `n`, neither negative.
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
    /// A malformed vector; exponents that are negative or not finite.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let exponents = args.vector2()?;
        if !exponents.is_finite() || exponents.min_element() < 0.0 {
            let message = format!(
                "the exponents of the superellipsoid must be finite and not negative, found <{}, {}>",
                exponents.x, exponents.y
            );
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                message,
            )));
        }
        Ok(Superellipsoid::new(exponents.x, exponents.y))
    }

    fn is_convex(&self) -> bool {
        self.across >= 1.0 && self.along >= 1.0
    }

    /// `N`, for a point without negative coordinates.
    fn size(&self, p: DVec3) -> f64 {
        norm(norm(p.x, p.y, self.across), p.z, self.along)
    }

    /// `N` and its derivatives by each coordinate, for a point without negative ones.
    fn size_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let ring = norm(p.x, p.y, self.across);
        let size = norm(ring, p.z, self.along);
        let by_ring = share(ring, size, self.along);
        let gradient = DVec3::new(
            by_ring * share(p.x, ring, self.across),
            by_ring * share(p.y, ring, self.across),
            share(p.z, size, self.along),
        );
        (size, gradient)
    }

    /// The same, with derivatives that are worked out along with the size; where two of its parts are equally large and the
    /// power is endless, each has half the slope.
    fn size_and_slopes(&self, p: DVec3) -> (f64, DVec3) {
        let (ring, [of_x, of_y]) = norm_and_shares(p.x, p.y, self.across);
        let (size, [of_ring, of_z]) = norm_and_shares(ring, p.z, self.along);
        (size, DVec3::new(of_ring * of_x, of_ring * of_y, of_z))
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        self.size_and_gradient(p).1
    }

    /// All, or the first alone if that lies between `from` and `to`.
    fn crossings(&self, ray: &Ray, seen: Option<(f64, f64)>) -> Crossings {
        if is_comfortable(1.0, ray.dir.dot(ray.dir), ray.origin.dot(ray.origin)) {
            return self.comfortable_crossings(ray, seen);
        }
        let Some(eased) = Eased::new(ray, 1.0) else {
            return Crossings::new();
        };
        let mut roots = self.comfortable_crossings(&eased.ray, None);
        for root in &mut roots {
            root.t = eased.t(root.t);
        }
        roots
    }

    fn comfortable_crossings(&self, ray: &Ray, seen: Option<(f64, f64)>) -> Crossings {
        let Some((from, to)) = clip(ray) else {
            return Crossings::new();
        };
        // About the middle of the clipped stretch, so that its ends lose no digits to a far origin.
        let middle = 0.5 * (from + to);
        let ray = Ray::new(ray.at(middle), ray.dir);
        let (from, to) = (from - middle, to - middle);
        let is_seen = |t: f64| {
            let t = t + middle;
            seen.is_some_and(|(least, most)| least < t && t < most)
        };
        let mut roots = if self.is_convex() {
            self.convex_crossings(&ray, (from, to), is_seen)
        } else {
            self.hollow_crossings(&ray, (from, to), is_seen)
        };
        for root in &mut roots {
            root.t += middle;
        }
        roots
    }

    fn convex_crossings(
        &self,
        ray: &Ray,
        (from, to): (f64, f64),
        is_seen: impl Fn(f64) -> bool,
    ) -> Crossings {
        let mut roots = Crossings::new();
        let Some((enter, slope)) = self.first_inside(ray, from, to) else {
            return roots;
        };
        if is_seen(enter) && slope < -STEEP * ray.dir.length() {
            roots.extend(span((enter, 0), (to, 0)).map(|[enter, _]| enter));
        } else if let Some((leave, _)) = self.first_inside(ray, to, from)
            && enter < leave
        {
            roots.extend(span((enter, 0), (leave, 0)).into_iter().flatten());
        }
        roots
    }

    /// Where a convex size falls below 1 on the way from one end to the other, and its slope there.
    fn first_inside(&self, ray: &Ray, from: f64, to: f64) -> Option<(f64, f64)> {
        if let Some(rough) = Rough::new(self, ray) {
            match rough.first_inside(from, to) {
                Estimate::None => return None,
                Estimate::Near(t, slope) => {
                    if let Some(t) = rough.sharpened(t, slope, from.abs().max(to.abs())) {
                        return Some((t, slope));
                    }
                }
                Estimate::Unclear => {}
            }
        }
        let excess = |t: f64| {
            let p = ray.at(t);
            let (size, gradient) = self.size_and_slopes(p.abs());
            (size - 1.0, gradient.dot(p.signum() * ray.dir))
        };
        let t = first_below_zero(excess, from, to)?;
        Some((t, excess(t).1))
    }

    fn hollow_crossings(
        &self,
        ray: &Ray,
        (from, to): (f64, f64),
        is_seen: impl Fn(f64) -> bool,
    ) -> Crossings {
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
        let along = Along {
            shape: self,
            ray: *ray,
        };
        let pieces = Rough::new(self, ray).map(|rough| Pieces::new(rough, &along));
        let mut places = Places::new();
        let mut start = (from, false);
        for &stop in &stops[1..] {
            let end = match &pieces {
                Some(pieces) => {
                    let end = (stop, stop < to && pieces.is_inside(stop));
                    pieces.sign_changes(start, end, &mut places);
                    end
                }
                None => {
                    let end = (stop, stop < to && along.value(stop) < 0.0);
                    sign_changes(&along, start, end, &mut places);
                    end
                }
            };
            start = end;
            if places.chunks_exact(2).any(|pair| is_seen(pair[0])) {
                break;
            }
        }
        let mut roots = Crossings::new();
        for pair in places.chunks_exact(2) {
            roots.extend(span((pair[0], 0), (pair[1], 0)).into_iter().flatten());
        }
        roots
    }
}

impl Along<'_> {
    /// The least and the most of each coordinate without its sign.
    fn reach(&self, from: f64, to: f64) -> (DVec3, DVec3) {
        let (a, b) = (self.ray.at(from).abs(), self.ray.at(to).abs());
        (a.min(b), a.max(b))
    }
}

impl Enclosed for Along<'_> {
    fn value(&self, t: f64) -> f64 {
        self.shape.size(self.ray.at(t).abs()) - 1.0
    }

    fn slope(&self, t: f64) -> f64 {
        let p = self.ray.at(t);
        self.shape.gradient(p.abs()).dot(p.signum() * self.ray.dir)
    }

    fn values(&self, from: f64, to: f64) -> Range {
        let (least, most) = self.reach(from, to);
        Range {
            low: self.shape.size(least) - 1.0,
            high: self.shape.size(most) - 1.0,
        }
    }

    fn slopes(&self, from: f64, to: f64) -> Range {
        let Superellipsoid { across, along } = *self.shape;
        let (least, most) = self.reach(from, to);
        let ring = [least, most].map(|p| norm(p.x, p.y, across));
        let size = [norm(ring[0], least.z, along), norm(ring[1], most.z, along)];
        let by_ring = shares(ring, size, along);
        let of_ring = |least: f64, most: f64| {
            let own = shares([least, most], ring, across);
            [by_ring[0] * own[0], by_ring[1] * own[1]]
        };
        let rates = [
            of_ring(least.x, most.x),
            of_ring(least.y, most.y),
            shares([least.z, most.z], size, along),
        ];
        // Which way each coordinate grows without its sign is the same on all of the piece.
        let growth = self.ray.at(0.5 * (from + to)).signum() * self.ray.dir;
        let mut sum = Range::new(0.0, 0.0);
        for axis in 0..3 {
            if growth[axis] != 0.0 {
                let ends = rates[axis].map(|rate| rate * growth[axis]);
                sum.low += ends[0].min(ends[1]);
                sum.high += ends[0].max(ends[1]);
            }
        }
        if sum.low.is_nan() || sum.high.is_nan() {
            return Range::new(f64::NEG_INFINITY, f64::INFINITY);
        }
        sum
    }
}

/// `(a^p + b^p)^(1/p)` of two numbers that are not negative; the larger one for infinite `p`.
fn norm(a: f64, b: f64, p: f64) -> f64 {
    let (small, large) = (a.min(b), a.max(b));
    if small == 0.0 {
        return large;
    }
    if p == 2.0 {
        return (a * a + b * b).sqrt();
    }
    let rest = (small / large).powf(p);
    large * (rest.ln_1p() / p).exp()
}

/// [`norm`] and its derivatives by both numbers, where `p` is 1 at least.
fn norm_and_shares(a: f64, b: f64, p: f64) -> (f64, [f64; 2]) {
    let (small, large) = (a.min(b), a.max(b));
    let ratio = small / large;
    let (norm, shares) = if small == 0.0 || ratio == 0.0 {
        let of_small = if p > 1.0 { 0.0 } else { 1.0 };
        (large, [of_small, 1.0])
    } else if p == 2.0 {
        let norm = (a * a + b * b).sqrt();
        (norm, [small / norm, large / norm])
    } else {
        let rest = ratio.powf(p);
        let growth = (rest.ln_1p() / p).exp();
        let of_large = growth / (1.0 + rest);
        (large * growth, [rest / ratio * of_large, of_large])
    };
    (
        norm,
        if a < b {
            shares
        } else {
            [shares[1], shares[0]]
        },
    )
}

/// The derivative of a norm by one of its two numbers: `(part / whole)^(p − 1)`.
fn share(part: f64, whole: f64, p: f64) -> f64 {
    if p == 2.0 && whole > 0.0 {
        return part / whole;
    }
    if whole == 0.0 {
        return 1.0;
    }
    (part / whole).min(1.0).powf(p - 1.0)
}

/// The least and the most of [`share`].
fn shares(part: [f64; 2], whole: [f64; 2], p: f64) -> [f64; 2] {
    let ratio = |part: f64, whole: f64| {
        if whole > 0.0 {
            (part / whole).min(1.0)
        } else {
            1.0
        }
    };
    let ends = [ratio(part[0], whole[1]), ratio(part[1], whole[0])].map(|r| r.powf(p - 1.0));
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// The stretch of a line in the box from -1 to 1; NaN, of a line in a face, excludes nothing.
fn clip(ray: &Ray) -> Option<(f64, f64)> {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (p, d) = (ray.origin[axis], ray.dir[axis]);
        if d == 0.0 {
            if p.abs() > 1.0 {
                return None;
            }
            continue;
        }
        let (a, b) = ((-1.0 - p) / d, (1.0 - p) / d);
        (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
    }
    (from < to && from.is_finite() && to.is_finite()).then_some((from, to))
}

impl Geometry for Superellipsoid {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend_from_slice(&self.crossings(ray, None));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.crossings(ray, Some((from, to))), from, to)
    }

    /// A size that is convex and grows where the ray starts does not fall again.
    fn is_left_behind(&self, ray: &Ray) -> bool {
        let Some(rough) = self.is_convex().then(|| Rough::new(self, ray)).flatten() else {
            return false;
        };
        let is_near = ray.origin.abs().max_element() <= REACH;
        is_near && rough.at(0.0).1 > STEEP * ray.dir.length()
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
        self.size(point.abs()) <= 1.0
    }

    fn bounds(&self) -> Bounds {
        Bounds::new(DVec3::splat(-REACH), DVec3::splat(REACH))
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::math::random::Random;
    use crate::shape::check;

    #[test]
    fn rounded_boxes_are_solids() {
        for (e, n) in [(1.0, 1.0), (0.5, 0.7), (0.9, 0.8)] {
            check::solid(&Superellipsoid::new(e, n));
        }
        for (e, n) in [(1.5, 0.3), (2.0, 2.0), (0.1, 1.9), (0.02, 0.02)] {
            check::creased(&Superellipsoid::new(e, n));
        }
    }

    #[test]
    fn stars_are_solids() {
        for (e, n) in [(3.0, 3.0), (3.0, 0.5), (0.5, 4.0), (2.5, 1.0)] {
            check::creased(&Superellipsoid::new(e, n));
        }
    }

    #[test]
    fn with_both_one_it_is_a_sphere() {
        let ray = Ray::new(DVec3::new(0.3, 0.4, -1e6), DVec3::Z);
        let roots = Superellipsoid::new(1.0, 1.0).crossings(&ray, None);
        assert_eq!(roots.len(), 2);
        assert!((roots[0].t - (1e6 - 0.75_f64.sqrt())).abs() < 2e-10);
        assert!((roots[1].t - (1e6 + 0.75_f64.sqrt())).abs() < 2e-10);
    }

    #[test]
    fn exponents_near_zero_make_a_box() {
        for e in [0.0, 1e-9, 1e-3] {
            let ray = Ray::new(DVec3::new(-3.0, 0.9, 0.9), DVec3::X);
            let roots = Superellipsoid::new(e, e).crossings(&ray, None);
            assert!((roots[0].t - 2.0).abs() < 1e-3 && (roots[1].t - 4.0).abs() < 1e-3);
        }
    }

    #[test]
    fn a_ray_past_the_hollow_side_of_a_star_passes_two_arms() {
        let star = Superellipsoid::new(4.0, 1.0);
        let ray = Ray::new(DVec3::new(-2.0, 0.1, 0.0), DVec3::X);
        assert_eq!(star.crossings(&ray, None).len(), 2);
        let across = Ray::new(DVec3::new(-0.5, 1.3, 0.0), DVec3::new(1.0, -1.0, 0.0));
        assert_eq!(star.crossings(&across, None).len(), 4);
    }

    #[test]
    fn exponents_below_zero_are_refused() {
        let error = Superellipsoid::read(&mut TextArgs::new("<-1, 1>")).unwrap_err();
        assert!(error.message.ends_with("not negative, found <-1, 1>"));
        assert!(Superellipsoid::read(&mut TextArgs::new("<0, 1>")).is_ok());
    }

    /// Where a line crosses the surface, in exact numbers alone.
    fn exact_places(shape: &Superellipsoid, ray: &Ray) -> Vec<f64> {
        let Some((from, to)) = clip(ray) else {
            return Vec::new();
        };
        let middle = 0.5 * (from + to);
        let ray = Ray::new(ray.at(middle), ray.dir);
        let (from, to) = (from - middle, to - middle);
        let mut stops: Vec<f64> = (0..3).map(|i| -ray.origin[i] / ray.dir[i]).collect();
        stops.retain(|t| from < *t && *t < to);
        stops.push(to);
        stops.sort_by(f64::total_cmp);
        let along = Along { shape, ray };
        let (mut places, mut start) = (Places::new(), (from, false));
        for stop in stops {
            let end = (stop, stop < to && along.value(stop) < 0.0);
            sign_changes(&along, start, end, &mut places);
            start = end;
        }
        places.iter().map(|t| t + middle).collect()
    }

    #[test]
    fn rough_powers_lose_no_root_and_no_digit() {
        let mut rng = Random::new(23);
        for (e, n) in [
            (0.3, 0.25),
            (0.5, 1.0),
            (1.0, 2.0),
            (2.0, 0.3),
            (0.1, 1.7),
            (0.3, 3.0),
            (3.0, 0.5),
            (3.0, 3.0),
            (1.5, 4.0),
            (0.01, 30.0),
        ] {
            let shape = Superellipsoid::new(e, n);
            let mut found = 0;
            for _ in 0..1000 {
                let away = rng.vector(3.0);
                let ray = Ray::new(rng.vector(1.0) + away, -away);
                let roots = shape.crossings(&ray, None);
                let exact = exact_places(&shape, &ray);
                found += roots.len();
                if roots.len() == exact.len() {
                    for (root, t) in roots.iter().zip(&exact) {
                        let size = (1.0 - shape.size(ray.at(root.t).abs())).abs();
                        let is_near = (root.t - t).abs() < 1e-9 || size < 4e-15;
                        assert!(is_near, "<{e}, {n}> {ray:?}: {} {t}", root.t);
                    }
                } else {
                    // Only a line that touches the surface may be judged in two ways.
                    let own: Vec<f64> = roots.iter().map(|root| root.t).collect();
                    let more = if own.len() > exact.len() { own } else { exact };
                    let is_close = |pair: &[f64]| pair[1] - pair[0] < 1e-6;
                    let is_touch = more.windows(2).any(is_close);
                    assert!(is_touch, "<{e}, {n}> {ray:?}: {more:?}");
                }
            }
            assert!(found > 200, "<{e}, {n}>: {found}");
        }
    }
}
