//! `plane { <normal>, distance }`: a half-space, solid behind the normal.
//!
//! The normal is normalised, as in POV-Ray, so `distance` is in scene units along it. Error bound: 2 roundings of the
//! problem's size (`shape/roundings.rs`), from the normal, the difference and the quotient.

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::{Normalization, power_of_two, unit};
use crate::base::math::simd::F64Lanes;
use crate::base::math::{Bounds, Ray, Step, normal_from_inverse, rotation};
use crate::base::source::Diagnostic;
use crate::scene::shape::packet::{RootPacket, SpanPacket, dot, splat};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    Crossing, Geometry, INSIDE_TOLERANCE, Root, Start, SurfaceSide, first_visible, read,
    uniform_scale,
};
use glam::DVec3;

/// The half-space `normal · p <= distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A unit vector that points out of the solid.
    pub normal: DVec3,
    /// The distance of the surface from the origin, along the normal.
    pub distance: f64,
    /// Points up to this far outside count as inside.
    inside_tolerance: f64,
}

impl Plane {
    /// The half-space behind a unit normal, `distance` from the origin.
    #[must_use]
    pub fn new(normal: DVec3, distance: f64) -> Self {
        Plane {
            normal,
            distance,
            inside_tolerance: 0.0,
        }
    }

    /// Takes POV-Ray's tolerance for points that the scene's text queries. It is a length of the world: with it
    /// pictures would depend on the unit.
    pub(crate) fn use_inside_tolerance(&mut self) {
        self.inside_tolerance = INSIDE_TOLERANCE;
    }

    /// Reads `<normal>, distance`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; a normal of length zero.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let normal = read::vector(args, "the normal of the plane")?;
        let at = at.to(args.last_span());
        let normalization = Normalization::of_version(args.is_for_3_8());
        let Some(normal) = normalization.unit_at_any_scale(normal) else {
            let error = Diagnostic::error(at, "degenerate plane normal: it has no direction");
            return Err(Box::new(error));
        };
        let distance = read::number(args, "the distance of the plane")?;
        Ok(Plane::new(normal, distance))
    }

    /// The crossing of the whole line and the side it starts on. A crossing too far for a finite number is dropped.
    #[inline]
    pub(crate) fn cross(&self, ray: &Ray) -> (Start, Option<Root>) {
        let slope = self.normal.dot(ray.dir);
        let height = self.distance - self.normal.dot(ray.origin);
        let t = height / slope;
        if slope == 0.0 || !t.is_finite() {
            let start = if height >= 0.0 {
                Start::Inside
            } else {
                Start::Outside
            };
            return (start, None);
        }
        let (start, crossing) = if slope > 0.0 {
            (Start::Inside, Crossing::Leave)
        } else {
            (Start::Outside, Crossing::Enter)
        };
        let root = Root {
            t,
            crossing,
            face: 0,
            is_visible: true,
        };
        (start, Some(root))
    }

    /// Inside intervals of a ray packet. Lanes parallel to the plane are unknown.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> SpanPacket<F> {
        let normal = splat(self.normal);
        let slope = dot(normal, rays.dir);
        let height = F::splat(self.distance) - dot(normal, rays.origin);
        let t = height / slope;
        let endless = F::splat(f64::INFINITY);
        let is_left = F::splat(0.0).lt(slope);
        SpanPacket {
            enter: F::select(is_left, -endless, t),
            leave: F::select(is_left, t, endless),
            is_hit: F::mask_from_bits(0b1111),
            unknown: 0b1111 & !F::bitmask(t.abs().lt(endless)),
        }
    }

    /// Packet version of [`Geometry::is_exiting`].
    #[inline(always)]
    pub(crate) fn is_exiting_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        F::splat(0.0).lt(dot(splat(self.normal), rays.dir))
    }

    /// Crossings of a ray packet.
    #[inline(always)]
    pub(crate) fn root_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RootPacket<F> {
        let normal = splat(self.normal);
        let slope = dot(normal, rays.dir);
        let height = F::splat(self.distance) - dot(normal, rays.origin);
        let t = height / slope;
        let nothing = F::splat(0.0);
        let is_finite = t.abs().lt(F::splat(f64::INFINITY));
        let mut roots = RootPacket::none(0);
        (roots.t[0], roots.t[1]) = (t, t);
        roots.hit_masks[0] = F::bitmask(slope.lt(nothing) & is_finite);
        roots.hit_masks[1] = F::bitmask(nothing.lt(slope) & is_finite);
        roots
    }

    /// Replaces the normal by one of any length, with `distance` in units of that length.
    fn set(&mut self, normal: DVec3, distance: f64) -> bool {
        let length = normal.length();
        if length.is_normal() {
            self.normal = normal * length.recip();
            self.distance = distance / length;
            return true;
        }
        // If the square overflows or underflows, rescale before taking the length.
        let size = power_of_two(normal.abs().max_element());
        let Some(direction) = unit(normal) else {
            return false;
        };
        self.normal = direction;
        self.distance = distance / size / (normal / size).length();
        true
    }
}

impl Geometry for Plane {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let (start, root) = self.cross(ray);
        roots.extend(root);
        start
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(self.cross(ray).1.as_slice(), from, to)
    }

    /// A line that leaves a half-space never enters it.
    fn is_exiting(&self, ray: &Ray) -> bool {
        self.is_exiting_packet(&RayPacket::<f64>::of(ray))
    }

    fn half_space(&self) -> Option<(DVec3, f64)> {
        Some((self.normal, self.distance))
    }

    fn normal(&self, _: DVec3, _: u32) -> DVec3 {
        self.normal
    }

    fn contains(&self, point: DVec3) -> bool {
        let height = self.normal.dot(point) - self.distance;
        height <= 0.0 || height < self.inside_tolerance
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Both
    }

    fn bounds(&self) -> Bounds {
        Bounds::EVERYTHING
    }

    fn absorb(&mut self, step: &Step) -> bool {
        match step {
            Step::Translate(by) => {
                self.distance += self.normal.dot(*by);
                true
            }
            Step::Rotate(degrees) => {
                self.normal = rotation(*degrees) * self.normal;
                true
            }
            Step::Scale(by) => match uniform_scale(*by) {
                // Rotated normals are unit vectors but for rounding: normalizing them again would change their last bits.
                Some(factor) => {
                    self.normal *= by.signum();
                    self.distance *= factor;
                    true
                }
                None => self.set(self.normal / *by, self.distance),
            },
            Step::General(transform) => {
                let from_world = &transform.object_from_world;
                let distance = self.distance - self.normal.dot(from_world.translation);
                self.set(normal_from_inverse(from_world, self.normal), distance)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Transform;
    use crate::scene::shape::tests::check;
    use std::sync::Arc;

    fn plane(text: &str) -> Plane {
        Plane::read(&mut TextArgs::new(text)).unwrap()
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&plane("<1,2,-3>, 0.7"));
    }

    #[test]
    fn it_is_a_half_space() {
        let tilted = plane("<1,2,-3>, 0.7");
        check::half_space(&tilted);
        check::scales_exactly(&tilted, |k| Plane {
            distance: tilted.distance * k,
            ..tilted
        });
    }

    #[test]
    fn the_distance_is_along_the_unit_normal() {
        assert!(plane("<0,4,0>, 1").contains(DVec3::Y));
        assert!(!plane("<0,4,0>, 1").contains(DVec3::Y * 1.000_001));
    }

    #[test]
    fn a_parallel_ray_has_a_side_and_no_root() {
        let mut roots = Vec::new();
        for (y, start) in [
            (0.5, Start::Inside),
            (1.0, Start::Inside),
            (2.0, Start::Outside),
        ] {
            let ray = Ray::new(DVec3::new(0.0, y, 0.0), DVec3::new(1.0, -0.0, 1.0));
            assert_eq!(plane("<0,1,0> 1").roots(&ray, &mut roots), start);
        }
        assert!(roots.is_empty());
    }

    #[test]
    fn a_zero_normal_is_an_error() {
        let error = Plane::read(&mut TextArgs::new("<0,0,0>, 1")).unwrap_err();
        assert_eq!(
            error.message,
            "degenerate plane normal: it has no direction"
        );
    }

    #[test]
    fn every_transform_is_absorbed() {
        let steps = [
            Step::Scale(DVec3::new(2.0, -3.0, 0.5)),
            Step::Rotate(DVec3::new(20.0, 30.0, 40.0)),
            Step::Translate(DVec3::new(1.0, 2.0, 3.0)),
            Step::General(Arc::new(Transform::from_steps(&[
                Step::Rotate(DVec3::new(0.0, 10.0, 0.0)),
                Step::Scale(DVec3::new(1.0, 2.0, 3.0)),
                Step::Translate(DVec3::new(-1.0, 0.0, 0.3)),
            ]))),
        ];
        let mut moved = plane("<1,2,-3>, 0.7");
        assert!(steps.iter().all(|step| moved.absorb(step)));
        let transform = Transform::from_steps(&steps);
        check::same_inside(&plane("<1,2,-3>, 0.7"), &moved, &transform);
        assert!((moved.normal.length() - 1.0).abs() < 1e-15);
    }
}
