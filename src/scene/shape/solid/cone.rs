//! `cone { <base>, base radius, <apex>, apex radius [open] }`.
//!
//! The radius at height `y` above the base is `w(y) = r₀ + k·y`. The apex of the infinite cone is never used, so a cone
//! that is almost a cylinder is no special case. The ray is first moved to its closest approach to the axis between the
//! caps; there `|p|² − w²` has coefficients of the cone's own size, and its differences of squares are factored. The
//! closed cone is the inside of that quadratic, clipped to the slab between the caps, which excludes the other nappe.
//!
//! Error bound: a cone that narrows by 10⁻¹⁵ of its radius is hit within a rounding of the cylinder's hit (tested);
//! parity is right by construction. Roots lie within 2 roundings of the problem's size from the surface
//! (`shape/roundings.rs`).
//!
//! Radii of different signs make an hourglass and two negative ones a cone, as POV-Ray draws them.

use super::axial::{APEX, Axis, BASE};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::{RescaledRay, is_comfortable, is_comfortable_size};
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{add, scale};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::packet::{self, SpanPacket, across, dot, splat, sub};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    Geometry, INSIDE_TOLERANCE, Root, Rounded, Start, Steps, SurfaceSide, first_visible,
    original_span, push_span, read,
};
use glam::{DAffine3, DVec3};

/// A truncated cone. Face 0 is the side, 1 the base cap, 2 the apex cap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    axis: Axis,
    /// Not negative.
    base_radius: f64,
    /// Negative only for an hourglass.
    apex_radius: f64,
    is_open: bool,
}

/// The interval or intervals of a line inside an infinite double cone.
enum Sides {
    Inner(f64, f64),
    /// Two intervals: up to the first value and from the second on.
    Outer(f64, f64),
}

/// The spans of a line inside a cone; only an hourglass has two.
type Spans = [Option<[Root; 2]>; 2];

/// True for a cone of these radii that POV-Ray takes for a cylinder (measured by bisection for radii of 0.05 to 50).
pub(crate) fn is_almost_cylinder(a: f64, b: f64) -> bool {
    (a - b) * (a - b) < 1e-10 * a.max(b)
}

impl Cone {
    /// A closed cone, or `None` if the ends of its axis coincide.
    #[must_use]
    pub fn new(base: DVec3, base_radius: f64, apex: DVec3, apex_radius: f64) -> Option<Self> {
        let sign = if base_radius < 0.0 { -1.0 } else { 1.0 };
        let other = if base_radius == 0.0 {
            apex_radius.abs()
        } else {
            sign * apex_radius
        };
        Some(Cone {
            axis: Axis::new(base, apex)?,
            base_radius: base_radius.abs(),
            apex_radius: other,
            is_open: false,
        })
    }

    /// The same cone without visible caps.
    #[must_use]
    pub fn open(self) -> Self {
        Cone {
            is_open: true,
            ..self
        }
    }

    /// The centres and radii of both caps.
    pub(crate) fn ends(&self) -> [(DVec3, f64); 2] {
        [
            (self.axis.base, self.base_radius),
            (self.axis.apex, self.apex_radius),
        ]
    }

    /// Reads `<base>, base radius, <apex>, apex radius [open]`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; ends that coincide.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let base = read::vector(args, "the base point of the cone")?;
        let base_radius = read::number(args, "the base radius of the cone")?;
        let apex = read::vector(args, "the apex point of the cone")?;
        let at = at.to(args.last_span());
        let apex_radius = read::number(args, "the apex radius of the cone")?;
        let Some(cone) = Cone::new(base, base_radius, apex, apex_radius) else {
            let error = Diagnostic::error(at, "degenerate cone: base point = apex point")
                .with_hint("Place its two ends apart.");
            return Err(Box::new(error));
        };
        let is_open = args.accept(Word::Open)?;
        Ok(Cone { is_open, ..cone })
    }

    fn max_radius(&self) -> f64 {
        self.base_radius.max(self.apex_radius.abs())
    }

    /// Change of the radius per unit of height.
    fn slope(&self) -> f64 {
        (self.apex_radius - self.base_radius) / self.axis.length()
    }

    /// POV-Ray's unit of heights: the length with the tip, or without it where it takes the cone for a cylinder.
    fn unit_length(&self) -> f64 {
        let length = self.axis.length();
        if is_almost_cylinder(self.base_radius, self.apex_radius) {
            length
        } else {
            length * self.max_radius() / (self.apex_radius - self.base_radius).abs()
        }
    }

    /// True if [`Cone::span_packet`] applies to this cone.
    pub(crate) fn supports_packets(&self) -> bool {
        !self.is_open && self.apex_radius >= 0.0 && is_comfortable_size(self.max_radius())
    }

    /// Spans of a ray packet. Lanes parallel to the axis, to the caps or to a line of the cone take the scalar path.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> SpanPacket<F> {
        let zero = F::splat(0.0);
        let (unit, widening) = (splat(self.axis.unit), F::splat(self.slope()));
        let origin = sub(rays.origin, splat(self.axis.base));
        let is_known = packet::is_comfortable(dot(rays.dir, rays.dir), dot(origin, origin));
        let (first, last, dir_height) = self.axis.slab_packet(rays);
        let height = dot(unit, origin);
        let (offset, dir) = (across(unit, origin), across(unit, rays.dir));
        let dir_sq = dot(dir, dir);
        let closest = -dot(offset, dir) / dir_sq;
        let middle = closest.lane_max(first).lane_min(last);
        let p = add(offset, scale(dir, middle));
        let distance = dot(p, p).sqrt();
        let is_near = distance.le(F::splat(self.max_radius() * (1.0 + 8.0 * f64::EPSILON)));
        let width = F::splat(self.base_radius) + widening * (height + middle * dir_height);
        let widening = widening * dir_height;
        let speed = dir_sq.sqrt();
        let a = (speed - widening) * (speed + widening);
        let b = dot(p, dir) - width * widening;
        let c = (distance - width) * (distance + width);
        let discriminant = b * b - a * c;
        let is_inner = zero.lt(a);
        let root = discriminant.lane_max(zero).sqrt();
        let q = F::select(b.lt(zero), root - b, -(root + b));
        let is_double = q.eq(zero);
        let t = F::select(is_double, zero, q / a);
        let other = F::select(is_double, zero, c / q);
        let (near, far) = (middle + t.lane_min(other), middle + t.lane_max(other));
        // The slab holds the nappe with the positive radius.
        let endless = F::splat(f64::INFINITY);
        let is_ahead = zero.lt(widening);
        let from = F::select(is_inner, near, F::select(is_ahead, far, -endless));
        let to = F::select(is_inner, far, F::select(is_ahead, endless, near));
        let enter = F::select(from.lt(first), first, from);
        let leave = F::select(last.lt(to), last, to);
        let is_hit = is_near & (a.lt(zero) | zero.lt(discriminant));
        let is_slanted = zero.lt(dir_sq) & zero.lt(dir_height.abs()) & zero.lt(a.abs());
        SpanPacket::new(enter, leave, is_hit, is_known & is_slanted)
    }

    /// The spans of a line inside, in order.
    fn spans(&self, ray: &Ray) -> Spans {
        let p = ray.origin - self.axis.base;
        if is_comfortable(self.max_radius(), ray.dir.dot(ray.dir), p.dot(p)) {
            self.spans_in_range(ray)
        } else {
            self.rescaled_spans(ray).unwrap_or_default()
        }
    }

    #[cold]
    fn rescaled_spans(&self, ray: &Ray) -> Option<Spans> {
        let to_apex = self.axis.apex - self.axis.base;
        let size = self.max_radius().max(to_apex.abs().max_element());
        let rescaled = RescaledRay::new(&Ray::new(ray.origin - self.axis.base, ray.dir), size)?;
        let small = Cone {
            axis: Axis {
                base: DVec3::ZERO,
                apex: to_apex / rescaled.size,
                unit: self.axis.unit,
            },
            base_radius: self.base_radius / rescaled.size,
            apex_radius: self.apex_radius / rescaled.size,
            is_open: self.is_open,
        };
        let spans = small.spans_in_range(&rescaled.ray);
        Some(spans.map(|span| original_span(&rescaled, span?)))
    }

    fn spans_in_range(&self, ray: &Ray) -> Spans {
        let Some(slab) = self.axis.slab(ray) else {
            return Spans::default();
        };
        let slope = self.slope();
        let clip = |from: f64, to: f64| slab.clip(from, to, self.is_open);
        match self.sides(ray, slope, slab.enter.t, slab.leave.t) {
            None => Spans::default(),
            Some(Sides::Inner(from, to)) => [clip(from, to), None],
            Some(Sides::Outer(until, from)) if self.apex_radius < 0.0 => {
                [clip(f64::NEG_INFINITY, until), clip(from, f64::INFINITY)]
            }
            // The slab holds the nappe with the positive radius.
            Some(Sides::Outer(until, from)) => match slope * self.axis.unit.dot(ray.dir) > 0.0 {
                true => [clip(from, f64::INFINITY), None],
                false => [clip(f64::NEG_INFINITY, until), None],
            },
        }
    }

    /// The line's intervals inside the infinite double cone; valid only near the interval between the caps.
    #[inline(always)]
    fn sides(&self, ray: &Ray, slope: f64, enter: f64, leave: f64) -> Option<Sides> {
        let origin = ray.origin - self.axis.base;
        let (height, dir_height) = (self.axis.unit.dot(origin), self.axis.unit.dot(ray.dir));
        let (offset, dir) = (self.axis.across(origin), self.axis.across(ray.dir));
        let dir_sq = dir.dot(dir);
        let closest = if dir_sq > 0.0 {
            -offset.dot(dir) / dir_sq
        } else {
            0.0
        };
        let middle = closest.max(enter).min(leave);

        let p = offset + middle * dir;
        let distance = p.length();
        // Outside the widest circle by more than rounding.
        if distance > self.max_radius() * (1.0 + 8.0 * f64::EPSILON) && dir_sq > 0.0 {
            return None;
        }
        let width = self.base_radius + slope * (height + middle * dir_height);
        let widening = slope * dir_height;
        let speed = dir_sq.sqrt();
        let a = (speed - widening) * (speed + widening);
        let b = p.dot(dir) - width * widening;
        let c = (distance - width) * (distance + width);
        let span_at = |from: f64, to: f64| (middle + from, middle + to);
        if a == 0.0 {
            return linear_sides(b, c, middle);
        }
        let discriminant = b * b - a * c;
        if a > 0.0 && discriminant <= 0.0 {
            return None;
        }
        let root = discriminant.max(0.0).sqrt();
        let q = if b < 0.0 { root - b } else { -(root + b) };
        let (t, other) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
        let (from, to) = span_at(t.min(other), t.max(other));
        Some(if a > 0.0 {
            Sides::Inner(from, to)
        } else {
            Sides::Outer(from, to)
        })
    }
}

/// The solution of `2b·t + c <= 0`, for a ray parallel to a line of the cone.
fn linear_sides(b: f64, c: f64, middle: f64) -> Option<Sides> {
    if b == 0.0 {
        return (c < 0.0).then_some(Sides::Inner(f64::NEG_INFINITY, f64::INFINITY));
    }
    let t = middle - c / (2.0 * b);
    Some(if b > 0.0 {
        Sides::Inner(f64::NEG_INFINITY, t)
    } else {
        Sides::Inner(t, f64::INFINITY)
    })
}

impl Geometry for Cone {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let [first, second] = self.spans(ray);
        push_span(first, roots);
        push_span(second, roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let spans = self.spans(ray);
        let mut spans = spans.iter().flatten();
        spans.find_map(|span| first_visible(span, from, to))
    }

    /// Same test as for a cylinder; an hourglass is not convex.
    fn is_exiting(&self, ray: &Ray) -> bool {
        let is_convex = self.apex_radius >= 0.0;
        is_convex && self.axis.is_exiting(ray, self.base_radius, self.slope())
    }

    #[inline]
    fn root_at(&self, ray: &Ray, t: f64) -> Option<Root> {
        if self.is_open {
            return None;
        }
        let (base_radius, max_radius) = (self.base_radius, self.max_radius());
        self.axis
            .root_at(ray, t, base_radius, max_radius, self.slope())
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match face {
            BASE => -self.axis.unit,
            APEX => self.axis.unit,
            _ => {
                let from_base = point - self.axis.base;
                let across = self.axis.across(from_base);
                let slope = self.slope();
                let width = self.base_radius + slope * self.axis.unit.dot(from_base);
                across - (width * slope) * self.axis.unit
            }
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let (above, below) = self.axis.heights(point);
        let radial = self.axis.across(point - self.axis.base) / self.max_radius();
        let radius = (self.base_radius + self.slope() * above) / self.max_radius();
        let depth = above.min(below) / self.unit_length();
        let depth = depth.min(radius * radius - radial.length_squared());
        if self.is_open {
            depth >= -INSIDE_TOLERANCE
        } else {
            depth > INSIDE_TOLERANCE
        }
    }

    fn surface_side(&self) -> SurfaceSide {
        if self.is_open {
            SurfaceSide::Inside
        } else {
            SurfaceSide::Outside
        }
    }

    fn bounds(&self) -> Bounds {
        if self.max_radius() == 0.0 {
            return Bounds::EMPTY;
        }
        self.axis.bounds(self.base_radius, self.apex_radius.abs())
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        Some(self.axis.held_box(self.base_radius, self.apex_radius))
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Rounded::of_cone(self, steps)
    }

    fn decides_ties(&self) -> bool {
        true
    }

    fn absorb(&mut self, step: &Step) -> bool {
        let factor = self.axis.absorb(step);
        self.base_radius *= factor.unwrap_or(1.0);
        self.apex_radius *= factor.unwrap_or(1.0);
        factor.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Transform;
    use crate::scene::shape::Cylinder;
    use crate::scene::shape::tests::check;

    fn cone(text: &str) -> Cone {
        Cone::read(&mut TextArgs::new(text)).unwrap()
    }

    fn crossings(cone: &Cone, ray: &Ray) -> Vec<Root> {
        let mut roots = Vec::new();
        cone.roots(ray, &mut roots);
        roots
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&cone("<-0.7,0,0>, 0.2, <0.7,0,0>, 0.1"));
    }

    #[test]
    fn it_is_a_solid() {
        let tilted = cone("<1,2,3>, 1.5, <-2,3,5>, 0.3");
        check::solid(&tilted);
        check::scales_exactly(&tilted, |k| {
            let (base, apex) = (tilted.axis.base * k, tilted.axis.apex * k);
            Cone::new(base, 1.5 * k, apex, 0.3 * k).unwrap()
        });
    }

    #[test]
    fn pointed_open_and_hourglass_cones_are_solids() {
        check::solid(&cone("<0,0,0>, 0, <0,2,0>, 1"));
        check::solid(&cone("<0,-1,0>, 1.2, <0,2,1>, 0"));
        check::solid(&cone("<0,-1,0>, 1.2, <0,2,1>, 0.4 open"));
        check::solid(&cone("<0,-1,0>, 1, <0,2,0>, -1.5"));
        assert_eq!(
            cone("<0,0,0>, -1, <0,2,0>, -2"),
            cone("<0,0,0>, 1, <0,2,0>, 2")
        );
    }

    #[test]
    fn the_other_nappe_does_not_leak() {
        let pointed = cone("<0,0,0>, 1, <0,1,0>, 0");
        for x in [-0.9, -0.3, 0.0, 1e-9, 0.6] {
            let ray = Ray::new(DVec3::new(x, 1.2, -5.0), DVec3::Z);
            assert!(crossings(&pointed, &ray).is_empty());
            let ray = Ray::new(DVec3::new(x, 5.0, 0.0), DVec3::new(0.0, -1.0, 0.0));
            assert_eq!(crossings(&pointed, &ray).len(), 2, "x = {x}");
        }
    }

    #[test]
    fn a_ray_along_a_line_of_the_side_ends_at_a_cap() {
        let pointed = cone("<0,0,0>, 1, <0,1,0>, 0");
        let ray = Ray::new(DVec3::new(-1.5, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0));
        let roots = crossings(&pointed, &ray);
        let faces: Vec<_> = roots.iter().map(|root| (root.t, root.face)).collect();
        assert_eq!(faces, [(0.75, 0), (1.0, BASE)]);
    }

    #[test]
    fn equal_radii_make_a_cylinder() {
        let round = cone("<1,2,3>, 1.5, <-2,3,5>, 1.5");
        let cylinder = Cylinder::new(round.axis.base, round.axis.apex, 1.5).unwrap();
        let mut rng = check::Random::new(5);
        for _ in 0..2000 {
            let ray = rng.ray_near(&round.bounds());
            let mut expected = Vec::new();
            cylinder.roots(&ray, &mut expected);
            let hits = crossings(&round, &ray);
            assert_eq!(hits.len(), expected.len(), "{ray:?}");
            for (a, b) in hits.iter().zip(&expected) {
                assert!((a.t - b.t).abs() < 1e-9, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn an_almost_cylinder_is_no_special_case() {
        for shrink in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
            let near = Cone::new(DVec3::ZERO, 1.0, DVec3::Y, 1.0 - shrink).unwrap();
            let ray = Ray::new(DVec3::new(0.0, 0.5, -5.0), DVec3::Z);
            let t = near.nearest(&ray, 0.0, 10.0).unwrap().t;
            assert!((t - (4.0 + 0.5 * shrink)).abs() < 1e-15);
        }
    }

    #[test]
    fn root_at_identifies_the_root_by_its_point() {
        let mut rng = check::Random::new(13);
        let mut known = [0; 3];
        for number in 0..40_000 {
            let base = rng.vector(1.0);
            // Some end in a point.
            let radii = [1.5 * rng.uniform(), (2.0 * rng.uniform() - 0.5).max(0.0)];
            let Some(cone) = Cone::new(base, radii[0], base + rng.vector(1.0), radii[1]) else {
                continue;
            };
            let away = 2.0_f64.powi(number % 20 - 2);
            let origin = away * rng.vector(1.0);
            let aim = base + rng.vector(0.5);
            let ray = Ray::new(origin, (0.1 + rng.uniform()) * (aim - origin));
            for root in crossings(&cone, &ray) {
                let result = cone.root_at(&ray, root.t);
                assert!(
                    result.is_none_or(|result| result == root),
                    "{cone:?} {ray:?} {root:?}"
                );
                known[root.face as usize] += usize::from(result.is_some());
            }
        }
        assert!(known.iter().all(|&known| known > 4000), "{known:?}");
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-150, 1e150, 1e300] {
            let pointed = Cone::new(DVec3::ZERO, scale, DVec3::Y * scale, 0.0).unwrap();
            let origin = DVec3::new(0.0, 0.5, -3.0) * scale;
            let roots = crossings(&pointed, &Ray::new(origin, DVec3::Z));
            assert_eq!(roots.len(), 2);
            assert!((roots[0].t / scale - 2.5).abs() < 1e-14);
        }
    }

    #[test]
    fn steps_that_preserve_circles_are_absorbed() {
        let steps = [
            Step::Scale(DVec3::new(2.0, 3.0, -2.0)),
            Step::Rotate(DVec3::new(10.0, 20.0, 30.0)),
            Step::Translate(DVec3::new(0.3, 0.2, 0.1)),
        ];
        let original = cone("<1,2,3>, 2, <1,4,3>, 0.5");
        let mut moved = original;
        assert!(steps.iter().all(|step| moved.absorb(step)));
        check::same_inside(&original, &moved, &Transform::from_steps(&steps));
    }
}
