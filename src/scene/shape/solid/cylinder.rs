//! `cylinder { <base>, <apex>, radius [open] }`.
//!
//! The infinite cylinder is the quadratic of a sphere for the components of the ray perpendicular to the axis
//! ([`sphere_span`]); the slab between the caps clips it. An open cylinder is the same solid with caps that are not
//! visible, as in POV-Ray's inside test. A negative radius works like its absolute value.
//!
//! Error bound: as for a sphere; roots lie within 2 roundings of the problem's size from the surface, from up to 10⁹
//! times its size (`shape/roundings.rs`).

use super::axial::{APEX, Axis, BASE};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::{RescaledRay, is_comfortable, is_comfortable_size};
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::simd::F64Lanes;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::packet;
use crate::scene::shape::packet::{SpanPacket, across, chords, dot, splat, sub};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    Geometry, INSIDE_TOLERANCE, Root, Rounded, Start, Steps, SurfaceSide, first_visible,
    original_span, push_span, read,
};
use glam::{DAffine3, DVec3};

/// A round cylinder. Face 0 is the side, 1 the base cap, 2 the apex cap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    axis: Axis,
    radius: f64,
    is_open: bool,
}

impl Cylinder {
    /// True if its caps are invisible.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// A closed cylinder, or `None` if the ends of its axis coincide.
    #[must_use]
    pub fn new(base: DVec3, apex: DVec3, radius: f64) -> Option<Self> {
        Some(Cylinder {
            axis: Axis::new(base, apex)?,
            radius: radius.abs(),
            is_open: false,
        })
    }

    /// The same cylinder without visible caps.
    #[must_use]
    pub fn open(self) -> Self {
        Cylinder {
            is_open: true,
            ..self
        }
    }

    /// The infinite cylinder: a point of its axis, the unit direction of the axis, and the radius.
    pub(crate) fn axis_and_radius(&self) -> (DVec3, DVec3, f64) {
        (self.axis.base, self.axis.unit, self.radius)
    }

    /// The centres of both caps, and the radius.
    pub(crate) fn ends_and_radius(&self) -> (DVec3, DVec3, f64) {
        (self.axis.base, self.axis.apex, self.radius)
    }

    /// Reads `<base>, <apex>, radius [open]`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; ends that coincide.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let base = read::vector(args, "the base point of the cylinder")?;
        let apex = read::vector(args, "the apex point of the cylinder")?;
        let at = at.to(args.last_span());
        let radius = read::number(args, "the radius of the cylinder")?;
        let Some(cylinder) = Cylinder::new(base, apex, radius) else {
            let error = Diagnostic::error(at, "degenerate cylinder: base point = apex point")
                .with_hint("Place its two ends apart.");
            return Err(Box::new(error));
        };
        let is_open = args.accept(Word::Open)?;
        Ok(Cylinder {
            is_open,
            ..cylinder
        })
    }

    #[inline]
    fn span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let p = ray.origin - self.axis.base;
        if is_comfortable(self.radius, ray.dir.dot(ray.dir), p.dot(p)) {
            self.span_in_range(ray)
        } else {
            self.rescaled_span(ray)
        }
    }

    #[inline]
    fn span_in_range(&self, ray: &Ray) -> Option<[Root; 2]> {
        let slab = self.axis.slab(ray)?;
        let p = self.axis.across(ray.origin - self.axis.base);
        let dir = self.axis.across(ray.dir);
        let (enter, leave) = if dir.dot(dir) == 0.0 {
            if p.dot(p) >= self.radius * self.radius {
                return None;
            }
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            sphere_span(p, dir, self.radius)?
        };
        slab.clip(enter, leave, self.is_open)
    }

    /// True if [`Cylinder::span_packet`] applies to this cylinder.
    pub(crate) fn supports_packets(&self) -> bool {
        !self.is_open && is_comfortable_size(self.radius)
    }

    /// Spans of a ray packet. Lanes parallel to the axis or to the caps take the scalar path.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> SpanPacket<F> {
        let unit = splat(self.axis.unit);
        let p = sub(rays.origin, splat(self.axis.base));
        let is_known = packet::is_comfortable(dot(rays.dir, rays.dir), dot(p, p));
        let dir = across(unit, rays.dir);
        let (side_enter, side_leave, is_hit) = chords(across(unit, p), dir, self.radius);
        if F::bitmask(is_hit) == 0 && F::bitmask(is_known) == 0b1111 {
            let is_slanted = F::splat(0.0).lt(dot(dir, dir));
            return SpanPacket::new(side_enter, side_leave, is_hit, is_slanted);
        }
        let (first, last, slope) = self.axis.slab_packet(rays);
        let enter = F::select(side_enter.lt(first), first, side_enter);
        let leave = F::select(last.lt(side_leave), last, side_leave);
        let is_slanted = F::splat(0.0).lt(dot(dir, dir)) & F::splat(0.0).lt(slope.abs());
        SpanPacket::new(enter, leave, is_hit, is_known & is_slanted)
    }

    #[cold]
    fn rescaled_span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let to_apex = self.axis.apex - self.axis.base;
        let size = self.radius.max(to_apex.abs().max_element());
        let rescaled = RescaledRay::new(&Ray::new(ray.origin - self.axis.base, ray.dir), size)?;
        let small = Cylinder {
            axis: Axis {
                base: DVec3::ZERO,
                apex: to_apex / rescaled.size,
                unit: self.axis.unit,
            },
            radius: self.radius / rescaled.size,
            is_open: self.is_open,
        };
        let roots = small.span_in_range(&rescaled.ray)?;
        original_span(&rescaled, roots)
    }
}

impl Geometry for Cylinder {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        push_span(self.span(ray), roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.span(ray)?, from, to)
    }

    /// True from the surface, or from outside it, away from the cylinder.
    fn is_exiting(&self, ray: &Ray) -> bool {
        self.axis.is_exiting(ray, self.radius, 0.0)
    }

    #[inline]
    fn root_at(&self, ray: &Ray, t: f64) -> Option<Root> {
        if self.is_open {
            return None;
        }
        self.axis.root_at(ray, t, self.radius, self.radius, 0.0)
    }

    fn bounding_cylinder(&self) -> Option<(DVec3, DVec3, f64)> {
        Some(self.axis_and_radius())
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match face {
            BASE => -self.axis.unit,
            APEX => self.axis.unit,
            _ => self.axis.across(point - self.axis.base),
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let (above, below) = self.axis.heights(point);
        let radial = self.axis.across(point - self.axis.base) / self.radius;
        let depth = above.min(below) / self.axis.length();
        let depth = depth.min(1.0 - radial.length_squared());
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
        if self.radius == 0.0 {
            return Bounds::EMPTY;
        }
        self.axis.bounds(self.radius, self.radius)
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        Some(self.axis.held_box(self.radius, self.radius))
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Some(Rounded::of_cylinder(self, steps))
    }

    fn decides_ties(&self) -> bool {
        true
    }

    fn absorb(&mut self, step: &Step) -> bool {
        let factor = self.axis.absorb(step);
        self.radius *= factor.unwrap_or(1.0);
        factor.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Transform;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::Crossing;
    use crate::scene::shape::tests::check;

    fn cylinder(text: &str) -> Cylinder {
        Cylinder::read(&mut TextArgs::new(text)).unwrap()
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&cylinder("<-0.7,0,0>, <0.7,0,0>, 0.2"));
    }

    #[test]
    fn it_is_a_solid() {
        let tilted = cylinder("<1,2,3>, <-2,3,5>, 1.3");
        check::solid(&tilted);
        check::scales_exactly(&tilted, |k| {
            Cylinder::new(tilted.axis.base * k, tilted.axis.apex * k, 1.3 * k).unwrap()
        });
        check::solid(&cylinder("<0,-1,0>, <0,2,0>, 0.4"));
    }

    #[test]
    fn root_at_identifies_the_root_by_its_point() {
        let mut rng = Random::new(13);
        let mut known = [0; 3];
        for number in 0..30_000 {
            let base = rng.vector(1.0);
            let radius = 0.02 + rng.uniform();
            let Some(cylinder) = Cylinder::new(base, base + rng.vector(1.0), radius) else {
                continue;
            };
            let away = 2.0_f64.powi(number % 20 - 2);
            let origin = away * rng.vector(1.0);
            let aim = base + rng.vector(0.5);
            let ray = Ray::new(origin, (0.1 + rng.uniform()) * (aim - origin));
            for root in cylinder.span(&ray).into_iter().flatten() {
                let result = cylinder.root_at(&ray, root.t);
                assert!(
                    result.is_none_or(|result| result == root),
                    "{ray:?} {root:?}"
                );
                known[root.face as usize] += usize::from(result.is_some());
            }
        }
        assert!(known.iter().all(|&known| known > 4000), "{known:?}");
    }

    #[test]
    fn an_open_cylinder_is_the_same_solid_with_invisible_caps() {
        let open = cylinder("<0,0,0>, <0,2,0>, 1 open");
        check::solid(&open);
        let ray = Ray::new(DVec3::new(0.0, 5.0, 0.0), DVec3::new(0.5, -4.5, 0.0));
        let roots = open.span(&ray).unwrap();
        let seen = roots.map(|root| (root.crossing, root.face, root.is_visible));
        assert_eq!(
            seen,
            [
                (Crossing::Enter, APEX, false),
                (Crossing::Leave, BASE, false)
            ]
        );
        assert!(open.nearest(&ray, 0.0, f64::INFINITY).is_none());
    }

    #[test]
    fn a_ray_along_the_axis_hits_the_caps() {
        let upright = cylinder("<0,1,0>, <0,3,0>, 1");
        for zero in [0.0, -0.0] {
            let ray = Ray::new(DVec3::new(0.5, 7.0, 0.5), DVec3::new(zero, -2.0, zero));
            assert_eq!(upright.span(&ray).unwrap().map(|root| root.t), [2.0, 3.0]);
            let beside = Ray::new(DVec3::new(1.0, 7.0, 0.0), ray.dir);
            assert!(upright.span(&beside).is_none());
        }
    }

    #[test]
    fn an_upright_cap_has_the_depth_of_a_box_face() {
        let upright = cylinder("<0.1,0.7,0>, <0.1,2.3,0>, 1");
        let ray = Ray::new(DVec3::new(0.3, 7.7, 0.1), DVec3::new(0.01, -0.93, 0.02));
        assert_eq!(upright.span(&ray).unwrap()[0].t, (2.3 - 7.7) / -0.93);
    }

    #[test]
    fn a_hair_a_million_long_is_hit() {
        let hair = cylinder("<0,0,0>, <1000000,0,0>, 0.000001");
        let ray = Ray::new(DVec3::new(5e5, 5e-7, -4.0), DVec3::Z);
        assert!(hair.span(&ray).is_some());
        let beside = Ray::new(DVec3::new(5e5, 1.1e-6, -4.0), DVec3::Z);
        assert!(hair.span(&beside).is_none());
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-150, 1e150, 1e300] {
            let upright = Cylinder::new(DVec3::ZERO, DVec3::Y * scale, scale).unwrap();
            let origin = DVec3::new(0.0, 0.5, -3.0) * scale;
            let [enter, leave] = upright.span(&Ray::new(origin, DVec3::Z)).unwrap();
            assert!((enter.t / scale - 2.0).abs() < 1e-15);
            assert!((leave.t / scale - 4.0).abs() < 1e-15);
        }
    }

    #[test]
    fn coinciding_ends_are_an_error() {
        let error = Cylinder::read(&mut TextArgs::new("<1,2,3>, <1,2,3>, 1")).unwrap_err();
        assert_eq!(
            error.message,
            "degenerate cylinder: base point = apex point"
        );
    }

    #[test]
    fn steps_that_preserve_circles_are_absorbed() {
        let steps = [
            Step::Scale(DVec3::new(2.0, -5.0, 2.0)),
            Step::Rotate(DVec3::new(10.0, 20.0, 30.0)),
            Step::Scale(DVec3::splat(-0.5)),
            Step::Translate(DVec3::new(0.3, 0.2, 0.1)),
        ];
        let original = cylinder("<1,2,3>, <1,4,3>, 2");
        let mut moved = original;
        assert!(steps.iter().all(|step| moved.absorb(step)));
        check::same_inside(&original, &moved, &Transform::from_steps(&steps));
        assert!(!moved.absorb(&Step::Scale(DVec3::new(1.0, 2.0, 1.0))));
    }
}
