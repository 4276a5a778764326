//! `sphere { <centre>, radius }`.
//!
//! The quadratic is solved about the point of closest approach ([`sphere_span`]): a sphere of radius 1 keeps its outline
//! from 10⁸ away, and a floor of radius 10¹² is as flat as double precision allows. A negative radius acts like its
//! absolute value, as in POV-Ray.
//!
//! Error bound: roots lie within a rounding of the problem's size (`|O| + |t·D|`, by coordinates, and the radius) from
//! the surface: 0.90 in 60,000 rays from 5 to 10⁸ radii and grazing ones (`tools/stability`).

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::{
    Normalization, RescaledRay, is_comfortable, is_comfortable_size,
};
use crate::base::math::roots::ray_sphere::{MARGIN, sphere_span};
use crate::base::math::simd::F64Lanes;
use crate::base::math::{Bounds, Ray, Step, rotation};
use crate::scene::shape::packet::{
    NearestPacket, SpanPacket, chords, dot, is_comfortable as are_comfortable, splat, sub,
};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    CLEAR_MARGIN, Crossing, Geometry, Root, Rounded, RoundedHit, SpanEnd, Start, Steps,
    WELL_INSIDE, first_visible, push_span, read, span, uniform_scale,
};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A root this many times farther than the nearest distance that counts is not the one that the ray starts on.
const CLEAR_START_FACTOR: f64 = 17.0;

/// In POV-Ray's formula a ray whose half chord has a smaller square misses, and one from outside whose middle is nearer;
/// in units of the scene's unit.
const LEAST_HALF_SQ: f64 = 1e-10;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub centre: DVec3,
    /// The radius, not negative.
    pub radius: f64,
}

impl Sphere {
    /// Reads `<centre>, radius`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let centre = read::vector(args, "the centre of the sphere")?;
        let radius = read::number(args, "the radius of the sphere")?.abs();
        Ok(Sphere { centre, radius })
    }

    #[inline(always)]
    fn chord(&self, ray: &Ray) -> Option<(f64, f64)> {
        let p = ray.origin - self.centre;
        if is_comfortable(self.radius, ray.dir.dot(ray.dir), p.dot(p)) {
            sphere_span(p, ray.dir, self.radius)
        } else {
            self.far_chord(p, ray.dir)
        }
    }

    #[cold]
    fn far_chord(&self, p: DVec3, dir: DVec3) -> Option<(f64, f64)> {
        let rescaled = RescaledRay::new(&Ray::new(p, dir), self.radius)?;
        let (enter, leave) = sphere_span(
            rescaled.ray.origin,
            rescaled.ray.dir,
            self.radius / rescaled.size,
        )?;
        Some((rescaled.t(enter), rescaled.t(leave)))
    }

    /// Spans of a ray packet.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> SpanPacket<F> {
        let p = sub(rays.origin, splat(self.centre));
        let (enter, leave, is_hit) = chords(p, rays.dir, self.radius);
        let is_known = are_comfortable(dot(rays.dir, rays.dir), dot(p, p));
        SpanPacket::new(enter, leave, is_hit, is_known)
    }

    /// Nearest roots of a ray packet with `from < t <= far`.
    #[inline(always)]
    pub(crate) fn nearest_packet<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
        from: F,
        far: F,
    ) -> NearestPacket<F> {
        self.span_packet(rays).nearest(from, far)
    }

    /// Any-hit variant: `t` may be any point inside the sphere before its exit. Clear hits and misses need no square
    /// root.
    #[inline(always)]
    pub(crate) fn any_hit_packet<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
        from: F,
        far: F,
        active: u32,
    ) -> NearestPacket<F> {
        let p = sub(rays.origin, splat(self.centre));
        let (a, b, from_centre_sq) = (dot(rays.dir, rays.dir), dot(p, rays.dir), dot(p, p));
        let r_sq = F::splat(self.radius * self.radius);
        let size = from_centre_sq * a;
        let slack = size * F::splat(MARGIN);
        let (off, limit) = (size - b * b, r_sq * a);
        let is_missed = limit.lt(off - slack);
        // A ray that starts outside and reaches the middle of its chord enters before it, and no sooner than at c /
        // 2|b|.
        let ahead = -b;
        let middle = ahead / a;
        let earliest = from * ahead * F::splat(2.0 * CLEAR_START_FACTOR);
        let is_outside = (earliest + from_centre_sq * F::splat(MARGIN)).lt(from_centre_sq - r_sq);
        let reaches_middle = F::splat(0.0).lt(ahead) & middle.lt(far);
        let is_entered = (off + slack).lt(limit) & is_outside;
        let is_hit = is_entered & reaches_middle;
        let is_clear = (is_missed | is_hit) & are_comfortable(a, from_centre_sq);
        if active & !F::bitmask(is_clear) != 0 {
            return self.nearest_packet(rays, from, far);
        }
        NearestPacket {
            t: middle,
            exit_mask: 0,
            hit_mask: F::bitmask(is_hit),
            unknown: 0,
        }
    }

    /// Packet version of [`Geometry::is_exiting`].
    #[inline(always)]
    pub(crate) fn is_exiting_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        let p = sub(rays.origin, splat(self.centre));
        let is_known = are_comfortable(dot(rays.dir, rays.dir), dot(p, p));
        is_known & F::splat(0.0).lt(dot(p, rays.dir))
    }

    /// The other root of a ray that starts on the surface and goes outward or inward.
    #[inline]
    pub(crate) fn other_root(&self, ray: &Ray, goes_out: bool) -> Option<Root> {
        let [enter, leave] = self.span(ray)?;
        Some(if goes_out { enter } else { leave })
    }

    /// The root of a ray with a unit direction next to `t`, by the formula of POV-Ray with its rounding.
    pub(crate) fn rounded_root(&self, ray: &Ray, t: f64) -> f64 {
        let to_centre = self.centre - ray.origin;
        let middle = to_centre.dot(ray.dir);
        let outside_sq = self.radius * self.radius - to_centre.dot(to_centre);
        let half = (outside_sq + middle * middle).sqrt();
        if t < middle {
            middle - half
        } else {
            middle + half
        }
    }

    /// The first root beyond a distance by the formula of POV-Ray, which takes the direction for a unit one; true if the
    /// ray leaves there. `unit` is the length of the scene's unit.
    pub(crate) fn rounded_root_beyond(
        &self,
        ray: &Ray,
        least: f64,
        unit: f64,
    ) -> Option<(f64, bool)> {
        let to_centre = self.centre - ray.origin;
        let middle = to_centre.dot(ray.dir);
        let outside_sq = self.radius * self.radius - to_centre.dot(to_centre);
        let half_sq = outside_sq + middle * middle;
        let is_behind = outside_sq <= 0.0 && middle < LEAST_HALF_SQ * unit;
        if is_behind || half_sq <= LEAST_HALF_SQ * unit * unit {
            return None;
        }
        let half = half_sq.sqrt();
        let roots = [(middle - half, false), (middle + half, true)];
        roots.into_iter().find(|root| root.0 > least)
    }

    /// The hit of a ray with a unit direction next to `t`, with POV-Ray's rounding.
    pub(crate) fn rounded_hit(
        &self,
        ray: &Ray,
        t: f64,
        normalization: Normalization,
    ) -> RoundedHit {
        let t = self.rounded_root(ray, t);
        let point = ray.at(t);
        let normal = normalization.divided(point - self.centre, self.radius);
        RoundedHit { t, point, normal }
    }

    /// The root of a ray with a unit direction that is known to lie at `t`, if it lies surely on one side of the middle
    /// of the chord.
    #[inline]
    pub(crate) fn root_of_unit_ray(&self, ray: &Ray, t: f64) -> Option<Root> {
        let from_middle = (ray.origin - self.centre).dot(ray.dir) + t;
        let is_sure = from_middle.abs() > CLEAR_MARGIN * (t.abs() + self.radius);
        is_sure.then_some(Root {
            t,
            crossing: match from_middle < 0.0 {
                true => Crossing::Enter,
                false => Crossing::Leave,
            },
            face: 0,
            is_visible: true,
        })
    }

    /// True if the ray starts outside and moves away, so that both roots lie behind it.
    #[inline(always)]
    fn is_behind(&self, ray: &Ray) -> bool {
        let p = ray.origin - self.centre;
        let from_centre_sq = p.dot(p);
        // Not within a few roundings of the surface, where the chord decides.
        is_comfortable(self.radius, ray.dir.dot(ray.dir), from_centre_sq)
            && p.dot(ray.dir) > 0.0
            && from_centre_sq * (1.0 - 8.0 * f64::EPSILON) > self.radius * self.radius
    }

    #[inline(always)]
    fn span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let (enter, leave) = self.chord(ray)?;
        span(SpanEnd::new(enter, 0), SpanEnd::new(leave, 0))
    }
}

impl Geometry for Sphere {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        push_span(self.span(ray), roots)
    }

    #[inline(always)]
    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if from >= 0.0 && self.is_behind(ray) {
            return None;
        }
        first_visible(&self.span(ray)?, from, to)
    }

    fn is_exiting(&self, ray: &Ray) -> bool {
        let p = ray.origin - self.centre;
        is_comfortable(self.radius, ray.dir.dot(ray.dir), p.dot(p)) && p.dot(ray.dir) > 0.0
    }

    fn tests_well_inside(&self) -> bool {
        true
    }

    #[inline]
    fn is_well_inside(&self, ray: &Ray, to: f64) -> bool {
        let inner_sq = WELL_INSIDE * self.radius * self.radius;
        let [start, end] = [ray.origin, ray.at(to)].map(|point| point - self.centre);
        is_comfortable_size(self.radius) && start.dot(start) < inner_sq && end.dot(end) < inner_sq
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        point - self.centre
    }

    fn contains(&self, point: DVec3) -> bool {
        let from_centre = point - self.centre;
        if is_comfortable(self.radius, 1.0, from_centre.dot(from_centre)) {
            from_centre.dot(from_centre) < self.radius * self.radius
        } else {
            (from_centre / self.radius).length_squared() < 1.0
        }
    }

    fn bounds(&self) -> Bounds {
        if self.radius == 0.0 {
            return Bounds::EMPTY;
        }
        Bounds::new(self.centre - self.radius, self.centre + self.radius)
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Some(Rounded::of_sphere(*self, steps))
    }

    fn absorb(&mut self, step: &Step) -> bool {
        match step {
            Step::Translate(by) => self.centre += *by,
            Step::Rotate(degrees) => self.centre = rotation(*degrees) * self.centre,
            Step::Scale(by) => {
                let Some(factor) = uniform_scale(*by) else {
                    return false;
                };
                self.centre *= *by;
                self.radius *= factor;
            }
            Step::General(_) => return false,
        }
        true
    }

    /// Longitude from +x towards +z and latitude from the south pole, each normalised to 0..1.
    fn uv(&self, point: DVec3, _face: u32) -> Option<[f64; 2]> {
        let p = (point - self.centre) / self.radius;
        let longitude = p.z.atan2(p.x);
        let turn = if longitude < 0.0 { TAU } else { 0.0 };
        let latitude = p.y.clamp(-1.0, 1.0).asin();
        Some([(longitude + turn) / TAU, 0.5 + latitude / PI])
    }

    fn loses_uv(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::tests::check;

    fn unit_sphere() -> Sphere {
        Sphere {
            centre: DVec3::ZERO,
            radius: 1.0,
        }
    }

    #[test]
    fn it_is_a_solid() {
        let sphere = Sphere {
            centre: DVec3::new(1.0, -2.0, 0.5),
            radius: 1.7,
        };
        check::solid(&sphere);
        check::scales_exactly(&sphere, |k| Sphere {
            centre: sphere.centre * k,
            radius: sphere.radius * k,
        });
    }

    #[test]
    fn a_root_is_known_by_its_t() {
        let mut rng = Random::new(11);
        let mut known = 0;
        for exponent in 0..20_000 {
            let sphere = Sphere {
                centre: rng.vector(1.0),
                radius: 1.0,
            };
            let away = 2.0_f64.powi(exponent % 20 - 2);
            let origin = away * rng.vector(1.0);
            let aim = sphere.centre + rng.vector(1.0);
            let ray = Ray::new(origin, (aim - origin).normalize_or(DVec3::X));
            for root in sphere.span(&ray).into_iter().flatten() {
                let known_root = sphere.root_of_unit_ray(&ray, root.t);
                assert!(
                    known_root.is_none_or(|known_root| known_root == root),
                    "{ray:?} {root:?}"
                );
                known += usize::from(known_root.is_some());
            }
        }
        assert!(known > 20_000, "{known}");
    }

    #[test]
    fn a_ray_through_the_centre_hits_at_the_poles() {
        let ray = Ray::new(DVec3::new(0.0, 0.0, -3.0), DVec3::Z);
        let root = unit_sphere().nearest(&ray, 0.0, f64::INFINITY).unwrap();
        assert_eq!(root.t, 2.0);
        assert_eq!(
            unit_sphere().nearest(&ray, 2.0, f64::INFINITY).unwrap().t,
            4.0
        );
        assert!(unit_sphere().nearest(&ray, 2.0, 4.0).is_none());
    }

    #[test]
    fn only_what_lies_behind_is_left_out() {
        let mut rng = check::Random::new(3);
        let sphere = unit_sphere();
        for i in 0..20_000 {
            let off = 1.0 + f64::from(i % 9 - 4) * f64::EPSILON;
            let ray = Ray::new(rng.vector(1.0).normalize() * off, rng.vector(1.0));
            let mut roots = Vec::new();
            sphere.roots(&ray, &mut roots);
            let first = first_visible(&roots, 0.0, f64::INFINITY);
            assert_eq!(sphere.nearest(&ray, 0.0, f64::INFINITY), first);
        }
    }

    #[test]
    fn a_tangent_misses() {
        let ray = Ray::new(DVec3::new(1.0, 0.0, -3.0), DVec3::Z);
        assert!(unit_sphere().span(&ray).is_none());
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-160, 1e-150, 1e150, 1e160, 1e300] {
            let sphere = Sphere {
                centre: DVec3::ZERO,
                radius: scale,
            };
            let origin = DVec3::new(0.3, 0.4, -3.0) * scale;
            let [enter, leave] = sphere.span(&Ray::new(origin, DVec3::Z)).unwrap();
            assert!((enter.t / scale - (3.0 - 0.75_f64.sqrt())).abs() < 1e-15);
            assert!((leave.t / scale - (3.0 + 0.75_f64.sqrt())).abs() < 2e-15);
            assert!(sphere.contains(DVec3::X * (0.99 * scale)));
            assert!(!sphere.contains(DVec3::X * (1.01 * scale)));
        }
        let ray = Ray::new(DVec3::new(0.0, 0.0, -1e250), DVec3::Z);
        assert!(unit_sphere().span(&ray).is_some());
    }

    #[test]
    fn a_negative_radius_is_its_absolute_value_and_zero_is_nothing() {
        let sphere = Sphere::read(&mut TextArgs::new("<1,2,3>, -2")).unwrap();
        assert_eq!(sphere.radius, 2.0);
        let nothing = Sphere::read(&mut TextArgs::new("<1 2 3> 0")).unwrap();
        assert!(nothing.bounds().is_empty());
        let through = Ray::new(DVec3::new(1.0, 2.0, 0.0), DVec3::Z);
        assert!(nothing.span(&through).is_none());
    }

    #[test]
    fn a_radius_that_is_not_finite_is_named() {
        let error = Sphere::read(&mut TextArgs::new("<1,2,3>, nan")).unwrap_err();
        assert_eq!(
            error.message,
            "the radius of the sphere must be finite, found NaN"
        );
    }

    #[test]
    fn moves_turns_and_even_scalings_are_absorbed() {
        let mut sphere = Sphere {
            centre: DVec3::X,
            radius: 1.0,
        };
        assert!(sphere.absorb(&Step::Scale(DVec3::new(-2.0, 2.0, 2.0))));
        assert!(sphere.absorb(&Step::Translate(DVec3::Y)));
        assert!(sphere.absorb(&Step::Rotate(DVec3::new(0.0, 0.0, 180.0))));
        assert_eq!(sphere.radius, 2.0);
        assert!((sphere.centre - DVec3::new(2.0, -1.0, 0.0)).length() < 1e-15);
        assert!(!sphere.absorb(&Step::Scale(DVec3::new(1.0, 2.0, 1.0))));
    }

    #[test]
    fn u_turns_from_x_to_z_and_v_rises() {
        assert_eq!(unit_sphere().uv(DVec3::Z, 0), Some([0.25, 0.5]));
        assert_eq!(unit_sphere().uv(DVec3::NEG_Z, 0), Some([0.75, 0.5]));
        assert_eq!(unit_sphere().uv(DVec3::Y, 0).unwrap()[1], 1.0);
    }
}
