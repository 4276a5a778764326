//! Ray packets of four lanes: spans and roots of simple solids, bit for bit as [`super::Geometry::roots`] gives them
//! per ray.

use super::packet_search::{NearestQuery4, NearestResult4, SpanResult4};
use super::ray_packet::RayPacket;
use super::{Quadric, Shape};
use crate::base::math::conditioning::{COMFORTABLE_SQUARE, FAR_SQUARE, is_comfortable_size};
use crate::base::math::roots::ray_sphere::MARGIN;
use crate::base::math::simd::F64Lanes;
pub(crate) use crate::base::math::simd::vec3::Vec3Lanes;
pub(super) use crate::base::math::simd::vec3::{add, dot, scale, splat, sub};

/// Slots for roots: a torus has up to four on each of two intervals.
pub(super) const MAX_ROOTS: usize = 8;

/// Inside spans of a ray packet; lines that enter a solid more than once are not known. An end that a line does not have
/// is infinite.
pub(crate) struct SpanPacket<F: F64Lanes> {
    pub(crate) enter: F,
    pub(crate) leave: F,
    /// Mask of the lanes that hit the solid.
    pub(crate) is_hit: F::Mask,
    /// Bit mask of the lanes for which the packet test is inconclusive: they take the scalar path.
    pub(crate) unknown: u32,
}

impl<F: F64Lanes> SpanPacket<F> {
    /// Spans from raw ends; lanes outside `is_known` take the scalar path, as the shape requires.
    #[inline(always)]
    pub(super) fn new(enter: F, leave: F, is_hit: F::Mask, is_known: F::Mask) -> Self {
        let endless = F::splat(f64::INFINITY);
        let is_finite = enter.abs().lt(endless) & leave.abs().lt(endless);
        // A span of zero length follows the tie rules of the scalar path, too.
        let is_plain = is_finite & (enter.lt(leave) | leave.lt(enter));
        SpanPacket {
            enter,
            leave,
            is_hit: is_hit & enter.lt(leave),
            unknown: 0b1111
                & (!F::bitmask(is_known) | (F::bitmask(is_hit) & !F::bitmask(is_plain))),
        }
    }
}

impl<F: F64Lanes> SpanPacket<F> {
    #[inline(always)]
    fn load(result: &SpanResult4) -> Self {
        SpanPacket::new(
            F::from_array(&result.enter),
            F::from_array(&result.leave),
            F::mask_from_bits(result.hit_mask),
            F::mask_from_bits(0b1111 & !result.unknown),
        )
    }

    /// The first span ends with `from < t <= far`.
    #[inline(always)]
    pub(super) fn nearest(&self, from: F, far: F) -> NearestPacket<F> {
        let within = from.lt(self.enter) & self.enter.le(far);
        let enters = self.is_hit & within;
        let within = from.lt(self.leave) & self.leave.le(far);
        let leaves = self.is_hit & within;
        let enters_bits = F::bitmask(enters);
        NearestPacket {
            t: F::select(enters, self.enter, self.leave),
            exit_mask: F::bitmask(leaves) & !enters_bits,
            hit_mask: enters_bits | F::bitmask(leaves),
            unknown: self.unknown,
        }
    }
}

/// All roots of a ray packet with a shape, all visible and of face 0, in order: even slots enter, odd slots leave.
/// Slots may be empty.
pub(crate) struct RootPacket<F: F64Lanes> {
    pub(super) t: [F; MAX_ROOTS],
    /// Per slot, the bit mask of the lanes that have a root there.
    pub(super) hit_masks: [u32; MAX_ROOTS],
    /// Bit mask of the lanes that take the scalar path.
    pub(super) unknown: u32,
}

/// Nearest roots of a ray packet.
pub(crate) struct NearestPacket<F: F64Lanes> {
    pub(crate) t: F,
    /// Bit mask of the lanes whose root leaves the solid; the others enter.
    pub(crate) exit_mask: u32,
    /// Bit mask of the lanes that have a root.
    pub(crate) hit_mask: u32,
    /// Bit mask of the lanes that take the scalar path.
    pub(crate) unknown: u32,
}

impl<F: F64Lanes> NearestPacket<F> {
    #[inline(always)]
    fn load(result: &NearestResult4) -> Self {
        NearestPacket {
            t: F::from_array(&result.t),
            exit_mask: 0,
            hit_mask: result.hit_mask,
            unknown: result.unknown,
        }
    }
}

impl<F: F64Lanes> RootPacket<F> {
    #[inline(always)]
    pub(super) fn none(unknown: u32) -> Self {
        RootPacket {
            t: [F::splat(f64::INFINITY); MAX_ROOTS],
            hit_masks: [0; MAX_ROOTS],
            unknown,
        }
    }

    /// The spans of the lanes that have no more than one.
    #[inline(always)]
    pub(super) fn spans(&self) -> SpanResult4 {
        let endless = F::splat(f64::INFINITY);
        let (mut enter, mut leave) = (endless, -endless);
        let (mut once, mut twice) = (0, 0);
        for slot in 0..MAX_ROOTS {
            let own = self.hit_masks[slot];
            let is_own = F::mask_from_bits(own);
            if slot % 2 == 0 {
                twice |= once & own;
                once |= own;
                enter = F::select(is_own, self.t[slot], enter);
            } else {
                leave = F::select(is_own, self.t[slot], leave);
            }
        }
        SpanResult4 {
            enter: enter.to_array(),
            leave: leave.to_array(),
            hit_mask: once,
            unknown: self.unknown | twice,
        }
    }

    /// The first root with `from < t <= far`, without the root that a ray has just left, which is the one of that
    /// crossing nearest to its start. `left` holds the lanes that have left an entering root and those that have left a
    /// leaving one.
    #[inline(always)]
    pub(crate) fn nearest(&self, from: F, far: F, left: [u32; 2]) -> NearestPacket<F> {
        let mut nearest = NearestPacket {
            t: F::splat(f64::INFINITY),
            exit_mask: 0,
            hit_mask: 0,
            unknown: self.unknown,
        };
        let mut hidden = F::splat(f64::NAN);
        if left != [0, 0] {
            let mut size = F::splat(f64::INFINITY);
            for slot in 0..MAX_ROOTS {
                let own = F::mask_from_bits(self.hit_masks[slot] & left[slot % 2]);
                let is_nearer = own & self.t[slot].abs().lt(size);
                size = F::select(is_nearer, self.t[slot].abs(), size);
                hidden = F::select(is_nearer, self.t[slot], hidden);
            }
        }
        let mut passed = 0;
        for slot in 0..MAX_ROOTS {
            if self.hit_masks[slot] == 0 {
                continue;
            }
            let is_hidden = F::bitmask(self.t[slot].eq(hidden)) & self.hit_masks[slot];
            nearest.unknown |= is_hidden & passed;
            passed |= is_hidden;
            let is_within = from.lt(self.t[slot]) & self.t[slot].le(far);
            let new = F::bitmask(is_within) & self.hit_masks[slot] & !is_hidden & !nearest.hit_mask;
            nearest.t = F::select(F::mask_from_bits(new), self.t[slot], nearest.t);
            if slot % 2 == 1 {
                nearest.exit_mask |= new;
            }
            nearest.hit_mask |= new;
        }
        nearest
    }
}

impl Shape {
    /// True if packet spans are implemented for the shape.
    pub(crate) fn has_span_packet(&self) -> bool {
        match self {
            Shape::Sphere(sphere) => is_comfortable_size(sphere.radius),
            Shape::Cuboid(_) => true,
            Shape::Cylinder(cylinder) => cylinder.supports_packets(),
            Shape::Cone(cone) => cone.supports_packets(),
            Shape::Torus(torus) => torus.supports_packets(),
            Shape::Superellipsoid(superellipsoid) => superellipsoid.supports_packets(),
            Shape::Plane(_) => true,
            _ => self.as_quadric().is_some(),
        }
    }

    /// True if packet queries of the nearest root are implemented for the shape.
    pub(crate) fn has_nearest_packet(&self) -> bool {
        match self {
            Shape::Sphere(sphere) => is_comfortable_size(sphere.radius),
            Shape::Torus(torus) => torus.supports_packets(),
            Shape::Superellipsoid(superellipsoid) => superellipsoid.supports_packets(),
            Shape::JuliaFractal(fractal) => fractal.supports_packets(),
            Shape::Plane(_) | Shape::Cuboid(_) => true,
            Shape::Cylinder(cylinder) => cylinder.supports_packets(),
            Shape::Cone(cone) => cone.supports_packets(),
            _ => self.as_quadric().is_some(),
        }
    }

    /// True if packets know more of it once an interval limits their rays: a surface of second order, which may be
    /// unbounded.
    pub(crate) fn gains_from_intervals(&self) -> bool {
        self.as_quadric().is_some()
    }

    /// The surface of second order that it is.
    #[inline(always)]
    fn as_quadric(&self) -> Option<&Quadric> {
        match self {
            Shape::Quadric(quadric) => Some(quadric),
            Shape::Poly(poly) => poly.as_quadric(),
            _ => None,
        }
    }

    /// True if its roots lie on several faces.
    #[inline(always)]
    pub(crate) fn has_faces(&self) -> bool {
        matches!(self, Shape::Cuboid(_) | Shape::Cylinder(_) | Shape::Cone(_))
    }

    /// Nearest roots of the active lanes, as [`RootPacket::nearest`] finds them. With `ANY` the distance may be that of
    /// any point within the solid.
    #[inline(always)]
    pub(crate) fn nearest_packet<F: F64Lanes, const ANY: bool>(
        &self,
        rays: &RayPacket<F>,
        from: F,
        far: F,
        left: [u32; 2],
        active: u32,
    ) -> NearestPacket<F> {
        match self {
            Shape::Sphere(sphere) if left == [0, 0] && ANY => {
                sphere.any_hit_packet(rays, from, far, active)
            }
            Shape::Sphere(sphere) if left == [0, 0] => sphere.nearest_packet(rays, from, far),
            Shape::Torus(torus) => torus.nearest_packet::<F, ANY>(rays, from, far, left, active),
            Shape::Superellipsoid(_) | Shape::JuliaFractal(_) => NearestPacket::load(
                &self.search_packet(&NearestQuery4::new(rays, from, far, left, active)),
            ),
            Shape::Cuboid(_)
            | Shape::Cylinder(_)
            | Shape::Cone(_)
            | Shape::Quadric(_)
            | Shape::Poly(_) => {
                // No end beyond the first is needed.
                let mut nearest = self.span_packet(rays, from, from).nearest(from, far);
                nearest.unknown |= left[0] | left[1];
                nearest
            }
            _ => self.root_packet(rays).nearest(from, far, left),
        }
    }

    /// Packet version of [`super::Geometry::is_exiting`], for rays that leave the surface.
    #[inline(always)]
    pub(crate) fn is_exiting_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        match self {
            Shape::Sphere(sphere) => sphere.is_exiting_packet(rays),
            Shape::Torus(torus) => torus.is_exiting_packet(rays),
            Shape::Superellipsoid(superellipsoid) => {
                let none = F::splat(0.0);
                let rays = NearestQuery4::new(rays, none, none, [0, 0], 0b1111);
                F::mask_from_bits(superellipsoid.is_exiting_packet(&rays))
            }
            Shape::Plane(plane) => plane.is_exiting_packet(rays),
            _ => F::mask_from_bits(0),
        }
    }

    /// True if the packet version of `is_exiting` is implemented for the shape.
    #[inline(always)]
    pub(crate) fn has_exiting_packet(&self) -> bool {
        match self {
            Shape::Sphere(_) | Shape::Torus(_) | Shape::Plane(_) => true,
            Shape::Superellipsoid(superellipsoid) => superellipsoid.supports_packets(),
            _ => false,
        }
    }

    /// Roots of a ray packet; all lanes are unknown for a shape without packet roots.
    #[inline(always)]
    pub(crate) fn root_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RootPacket<F> {
        match self {
            Shape::Sphere(sphere) => {
                let spans = sphere.span_packet(rays);
                let mut roots = RootPacket::none(spans.unknown);
                (roots.t[0], roots.t[1]) = (spans.enter, spans.leave);
                roots.hit_masks[0] = F::bitmask(spans.is_hit);
                roots.hit_masks[1] = roots.hit_masks[0];
                roots
            }
            Shape::Torus(torus) => torus.root_packet(rays),
            Shape::Plane(plane) => plane.root_packet(rays),
            _ => RootPacket::none(0b1111),
        }
    }

    /// Spans of a ray packet, all unknown for a shape without packet spans; ends outside of `low` to `high` may be
    /// missing.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
        low: F,
        high: F,
    ) -> SpanPacket<F> {
        match self {
            Shape::Sphere(sphere) if is_comfortable_size(sphere.radius) => sphere.span_packet(rays),
            Shape::Cuboid(cuboid) => cuboid.span_packet(rays),
            Shape::Cylinder(cylinder) if cylinder.supports_packets() => cylinder.span_packet(rays),
            Shape::Cone(cone) if cone.supports_packets() => cone.span_packet(rays),
            Shape::Plane(plane) => plane.span_packet(rays),
            Shape::Torus(_) | Shape::Superellipsoid(_) => {
                let query = NearestQuery4::new(rays, low, high, [0, 0], 0b1111);
                SpanPacket::load(&self.search_spans(&query))
            }
            _ => match self.as_quadric() {
                Some(quadric) => quadric.span_packet(rays, low, high),
                None => {
                    let nothing = F::splat(0.0);
                    let none = F::mask_from_bits(0);
                    SpanPacket::new(nothing, nothing, none, none)
                }
            },
        }
    }
}

/// Components of a packet of vectors perpendicular to an axis.
#[inline(always)]
pub(super) fn across<F: F64Lanes>(unit: Vec3Lanes<F>, v: Vec3Lanes<F>) -> Vec3Lanes<F> {
    sub(v, scale(unit, dot(unit, v)))
}

/// Mask of the lanes whose squares need no rescaling; the size of the solid is tested apart.
#[inline(always)]
pub(super) fn is_comfortable<F: F64Lanes>(dir_sq: F, origin_sq: F) -> F::Mask {
    let least = F::splat(1.0 / COMFORTABLE_SQUARE);
    let is_dir = least.le(dir_sq) & dir_sq.lt(F::splat(COMFORTABLE_SQUARE));
    is_dir & origin_sq.lt(F::splat(FAR_SQUARE))
}

/// Chords of a ray packet with a sphere about the origin, as [`crate::base::math::roots::ray_sphere::sphere_span`] finds
/// each: enter, leave, and the mask of the lanes that hit it.
#[inline(always)]
pub(super) fn chords<F: F64Lanes>(
    p: Vec3Lanes<F>,
    dir: Vec3Lanes<F>,
    radius: f64,
) -> (F, F, F::Mask) {
    let a = dot(dir, dir);
    let b = dot(p, dir);
    let from_centre_sq = dot(p, p);
    let (r, r_sq) = (F::splat(radius), F::splat(radius * radius));
    let size = from_centre_sq * a;
    let off = size - size * F::splat(MARGIN) - b * b;
    let is_far = (r_sq * a).lt(off);
    if F::bitmask(is_far) == 0b1111 {
        return (a, a, F::mask_from_bits(0));
    }
    let along = -b / a;
    let nearest = add(p, scale(dir, along));
    let nearest_sq = dot(nearest, nearest);
    let distance = nearest_sq.sqrt();
    let half_sq = (r - distance) * (r + distance);
    let from_centre = from_centre_sq.sqrt();
    let c = (from_centre - r) * (from_centre + r);
    let root = (a * half_sq).sqrt();
    let is_ahead = b.lt(F::splat(0.0));
    let q = F::select(is_ahead, root - b, -(root + b));
    let (t, other) = (q / a, c / q);
    let is_hit = nearest_sq.lt(r_sq) & F::splat(0.0).lt(half_sq);
    (t.lane_min(other), t.lane_max(other), is_hit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Bounds;
    use crate::base::math::Ray;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{SimdKernel, SimdLevel};
    use crate::scene::shape::{
        Cone, Crossing, Cuboid, Cylinder, Geometry, Plane, Poly, Root, Sphere, Superellipsoid,
        Torus,
    };
    use glam::DVec3;

    /// Roots of a ray packet per lane, in the form of the scalar path.
    #[derive(Clone, Copy)]
    struct RootsKernel<'a> {
        shape: &'a Shape,
        rays: [Ray; 4],
    }

    impl SimdKernel for RootsKernel<'_> {
        type Output = [Option<Vec<(f64, Crossing)>>; 4];

        fn run<F: F64Lanes>(self) -> Self::Output {
            let rays = RayPacket::<F>::of_each(&self.rays);
            let roots = if self.shape.has_span_packet() {
                let all = F::splat(f64::INFINITY);
                let spans = self.shape.span_packet(&rays, -all, all);
                let hits = F::bitmask(spans.is_hit);
                let mut roots = RootPacket::none(spans.unknown);
                (roots.t[0], roots.t[1]) = (spans.enter, spans.leave);
                (roots.hit_masks[0], roots.hit_masks[1]) = (hits, hits);
                roots
            } else {
                self.shape.root_packet(&rays)
            };
            [0, 1, 2, 3].map(|lane| {
                let has = |bits: u32| bits >> lane & 1 == 1;
                let crossing = |slot| [Crossing::Enter, Crossing::Leave][slot % 2];
                let slots = (0..MAX_ROOTS).filter(|&slot| has(roots.hit_masks[slot]));
                let known = slots.map(|slot| (roots.t[slot].to_array()[lane], crossing(slot)));
                let known = known.filter(|(t, _)| t.is_finite());
                (!has(roots.unknown)).then(|| known.collect())
            })
        }
    }

    #[test]
    fn packets_find_the_roots_of_each_ray() {
        let read = |text: &str| TextArgs::new(text);
        let shapes = [
            Shape::Sphere(Sphere::read(&mut read("<1, 2, 3>, 1.5")).unwrap()),
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(2.0, 0.5, 3.0))),
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(1.0, -1.0, 1.0))),
            Shape::Cylinder(Cylinder::read(&mut read("<-1, 0.5, 0>, <1, 1, 2>, 0.7")).unwrap()),
            Shape::Cylinder(Cylinder::read(&mut read("<-2, 0, 0>, <2, 0, 0>, 0.6")).unwrap()),
            Shape::Cone(Cone::read(&mut read("<-1, 0.5, 0>, 0.2, <1, 1, 2>, 0.7")).unwrap()),
            Shape::Cone(Cone::read(&mut read("<0, 2, 0>, 1, <0, 0, 0>, 0")).unwrap()),
            Shape::Cone(Cone::read(&mut read("<0, 2, 0>, 2, <0, 1, 0>, 0.5")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 0.3")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 0.01")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 1")).unwrap()),
            Shape::Plane(Plane::read(&mut read("<1, 2, -0.5>, 0.25")).unwrap()),
            Shape::Plane(Plane::read(&mut read("<0, 1, 0>, -1")).unwrap()),
            Shape::Superellipsoid(Superellipsoid::new(0.3, 0.25)),
            Shape::Superellipsoid(Superellipsoid::new(1.0, 0.5)),
            Shape::Poly(Poly::read(&mut read("2, <1, 0, 0, 0, 1, 0, 0, -1, 0, 1>")).unwrap()),
            Shape::Poly(Poly::read(&mut read("2, <1, 0, 0, 0, 2, 0, 0, 3, 1, -1>")).unwrap()),
        ];
        let mut rng = Random::new(31);
        for shape in &shapes {
            let own: Bounds = shape.bounds();
            let bounds = if own.is_finite() {
                own
            } else {
                Bounds::new(DVec3::NEG_ONE, DVec3::ONE)
            };
            let (mut known, mut hits) = (0, 0);
            for _ in 0..4000 {
                let rays = [(); 4].map(|()| rng.ray_near(&bounds));
                let kernel = RootsKernel { shape, rays };
                let (wide, narrow) = (
                    SimdLevel::widest().run(kernel),
                    SimdLevel::NARROW.run(kernel),
                );
                assert_eq!(wide, narrow);
                for (ray, lane_roots) in rays.iter().zip(wide) {
                    let Some(lane_roots) = lane_roots else {
                        continue;
                    };
                    let mut roots: Vec<Root> = Vec::new();
                    shape.roots(ray, &mut roots);
                    let scalar: Vec<_> = roots.iter().map(|root| (root.t, root.crossing)).collect();
                    assert_eq!(lane_roots, scalar, "{shape:?} {ray:?}");
                    known += 1;
                    hits += usize::from(!scalar.is_empty());
                }
            }
            assert!(known > 3000, "{shape:?} {known} {hits}");
        }
    }

    /// Any-hit test of a sphere with and without its roots: `(hits, unknown)` of each, and whether the two report
    /// different `t`.
    #[derive(Clone, Copy)]
    struct AnyHitKernel<'a> {
        sphere: &'a Sphere,
        rays: [Ray; 4],
        from: [f64; 4],
        far: [f64; 4],
    }

    impl SimdKernel for AnyHitKernel<'_> {
        type Output = ([(u32, u32); 2], bool);

        fn run<F: F64Lanes>(self) -> Self::Output {
            let rays = RayPacket::<F>::of_each(&self.rays);
            let (from, far) = (F::from_array(&self.from), F::from_array(&self.far));
            let any = self.sphere.any_hit_packet(&rays, from, far, 0b1111);
            let first = self.sphere.nearest_packet(&rays, from, far);
            let differs = any.t.to_array() != first.t.to_array() && any.hit_mask != 0;
            (
                [(any.hit_mask, any.unknown), (first.hit_mask, first.unknown)],
                differs,
            )
        }
    }

    #[test]
    fn any_hit_without_roots_agrees_with_the_nearest_root() {
        let sphere = Sphere {
            centre: DVec3::new(1.0, -2.0, 0.5),
            radius: 1.5,
        };
        let bounds = sphere.bounds();
        let mut rng = Random::new(51);
        let (mut hits, mut quick) = (0, 0);
        for round in 0..40_000 {
            let rays = [(); 4].map(|()| {
                let ray = rng.ray_near(&bounds);
                // Some start on the sphere, or near it.
                let out = (ray.origin - sphere.centre).normalize_or(DVec3::X);
                let near = 1.0 + 1e-15 * f64::from(round % 7 - 3);
                let on_it = sphere.centre + near * sphere.radius * out;
                let dir = ray.dir.normalize_or(DVec3::Y);
                Ray::new(if round % 3 == 0 { on_it } else { ray.origin }, dir)
            });
            let from = [(); 4].map(|()| 1e-13 * rng.uniform());
            let far = [(); 4].map(|()| 12.0 * rng.uniform());
            let sphere = &sphere;
            let kernel = AnyHitKernel {
                sphere,
                rays,
                from,
                far,
            };
            let (wide, narrow) = (
                SimdLevel::widest().run(kernel),
                SimdLevel::NARROW.run(kernel),
            );
            assert_eq!(wide, narrow);
            let ([any, first], differs) = wide;
            let known = 0b1111 & !any.1 & !first.1;
            assert_eq!(
                any.0 & known,
                first.0 & known,
                "{kernel:?}",
                kernel = kernel.rays
            );
            hits += (any.0 & known).count_ones();
            quick += u32::from(differs);
        }
        assert!(hits > 10_000 && quick > 3_000, "{hits} {quick}");
    }
}
