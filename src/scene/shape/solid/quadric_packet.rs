//! Packet intersection of a quadric, by the steps of [`super::quadric`] in the same order. Lanes that need more steps
//! there take the scalar path: directions that are rescaled first, a quadratic without its square, roots close to each
//! other.
//!
//! Spans are valid within an interval of the line. An open quadric, such as the two nappes of a cone, has two of them;
//! a lane in which both reach into the interval takes the scalar path.

use super::quadric::{CLOSE, NEAR_ENOUGH, Quadric, UNSCALED_SQUARES};
use crate::base::math::Ray;
use crate::base::math::simd::{F64Lanes, SimdKernel, with_widest};
use crate::scene::shape::packet::{SpanPacket, Vec3Lanes, add, dot, scale, splat, sub};
use crate::scene::shape::ray_packet::RayPacket;

/// Value and gradient at a packet of points.
#[derive(Clone, Copy)]
struct At<F> {
    value: F,
    half_gradient: Vec3Lanes<F>,
    /// A lower bound of the sum of the magnitudes of the terms of the value.
    size: F,
}

/// Kernel that refines two roots on one line, in lanes.
struct RefineKernel<'a> {
    quadric: &'a Quadric,
    line: &'a Ray,
    params: [f64; 2],
}

/// Exact rounding error of a product, for numbers of [`has_exact_error`] (Dekker 1971; the halves are Veltkamp's).
#[inline(always)]
fn error_of_product<F: F64Lanes>(a: F, b: F, product: F) -> F {
    let halves = |x: F| {
        let large = x * F::splat(134_217_729.0);
        let high = large - (large - x);
        (high, x - high)
    };
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let rest = product - a_high * b_high;
    let rest = rest - a_low * b_high - a_high * b_low;
    a_low * b_low - rest
}

/// True where products of such numbers make [`error_of_product`] neither overflow nor underflow.
#[inline(always)]
fn has_exact_error<F: F64Lanes>(x: F) -> F::Mask {
    const MOST: f64 = f64::from_bits((1023 + 400) << 52);
    let size = x.abs();
    let is_even = F::splat(1.0 / MOST).le(size) & size.le(F::splat(MOST));
    is_even | size.eq(F::splat(0.0))
}

impl SimdKernel for RefineKernel<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> [f64; 2] {
        let rays = RayPacket::<F> {
            origin: splat(self.line.origin),
            dir: splat(self.line.dir),
        };
        let [t, other] = self.params;
        let refined = self
            .quadric
            .refined_packet(&rays, F::from_array(&[t, other, t, other]));
        let [t, other, ..] = refined.to_array();
        [t, other]
    }
}

impl Quadric {
    /// Spans of a ray packet; an end outside of its interval from `low` to `high` may be missing.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
        low: F,
        high: F,
    ) -> SpanPacket<F> {
        let (zero, endless) = (F::splat(0.0), F::splat(f64::INFINITY));
        let dir_sq = dot(rays.dir, rays.dir);
        let is_unscaled =
            F::splat(UNSCALED_SQUARES.start).le(dir_sq) & dir_sq.lt(F::splat(UNSCALED_SQUARES.end));
        let ahead = dot(sub(splat(self.centre), rays.origin), rays.dir) / dir_sq;
        let a = dot(rays.dir, self.turned_packet(rays.dir));
        let near = self.at_packet(add(rays.origin, scale(rays.dir, ahead)));
        let (b, c) = (dot(near.half_gradient, rays.dir), near.value);
        let (b_sq, a_c) = (b * b, a * c);
        let mut discriminant = b_sq - a_c;
        let is_apart = (F::splat(CLOSE) * b * b).le(discriminant.abs());
        // Little cancellation.
        let mut is_clear = (F::splat(0.5) * b_sq.abs().lane_max(a_c.abs())).le(discriminant.abs());
        if F::bitmask(is_clear) != 0b1111 {
            let rest = error_of_product(b, b, b_sq) - error_of_product(a, c, a_c);
            discriminant = F::select(is_clear, discriminant, discriminant + rest);
            is_clear = is_clear | ((has_exact_error(a) & has_exact_error(b)) & has_exact_error(c));
        }
        let is_known = (is_unscaled & zero.lt(a.abs()))
            & ((is_clear & is_apart) & discriminant.abs().lt(endless));
        let is_hit = zero.lt(discriminant);
        let is_open = a.lt(zero);
        if F::bitmask(is_hit) == 0 {
            return SpanPacket {
                enter: -endless,
                leave: endless,
                is_hit: is_open,
                unknown: 0b1111 & !F::bitmask(is_known),
            };
        }
        let root = discriminant.sqrt();
        // The sign of zero counts.
        let is_negative = b.lt(zero) | (F::splat(1.0) / b).lt(zero);
        let q = -(b + F::select(is_negative, -root, root));
        let (t, other) = (q / a, c / q);
        let params = [t.lane_min(other) + ahead, t.lane_max(other) + ahead];
        let mut refined = params;
        for t in &mut refined {
            *t = self.refined_packet(rays, *t);
        }
        let is_ordered = refined[0].le(refined[1]);
        let first = F::select(is_ordered, refined[0], params[0]);
        let second = F::select(is_ordered, refined[1], params[1]);
        let is_finite = first.abs().lt(endless) & second.abs().lt(endless);
        let is_span = is_finite & first.lt(second);
        // An open quadric: the first span ends before the interval, or the second begins after it.
        let is_outer = is_hit & is_open;
        let [is_before, is_after] = [first.lt(low), high.lt(second)];
        let is_one = F::bitmask(is_before | is_after) & !F::bitmask(first.eq(low));
        let inconclusive =
            F::bitmask(is_hit) & !F::bitmask(is_span) | F::bitmask(is_outer) & !is_one;
        let (enter, leave) = (
            F::select(is_outer, F::select(is_before, second, -endless), first),
            F::select(is_outer, F::select(is_before, endless, first), second),
        );
        SpanPacket {
            enter: F::select(is_hit, enter, -endless),
            leave: F::select(is_hit, leave, endless),
            is_hit: is_hit | is_open,
            unknown: 0b1111 & (!F::bitmask(is_known) | inconclusive),
        }
    }

    /// Refines roots on one line with up to two Newton steps on the quadric in space, as long as they are needed and
    /// reduce the value.
    pub(crate) fn refined(&self, line: &Ray, params: [f64; 2]) -> [f64; 2] {
        let refining = RefineKernel {
            quadric: self,
            line,
            params,
        };
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(refining),
        )
    }

    /// Packet version of [`Quadric::refined`], one root per lane.
    #[inline(always)]
    fn refined_packet<F: F64Lanes>(&self, rays: &RayPacket<F>, mut t: F) -> F {
        let mut at = self.at_packet(add(rays.origin, scale(rays.dir, t)));
        let mut active = F::mask_from_bits(0b1111);
        for _ in 0..2 {
            let enough = F::splat(NEAR_ENOUGH * f64::EPSILON) * at.size;
            active = active & enough.lt(at.value.abs());
            if F::bitmask(active) == 0 {
                break;
            }
            let slope = dot(at.half_gradient, rays.dir);
            // A NaN fails the comparison below.
            let next = t - F::splat(0.5) * at.value / slope;
            let at_next = self.at_packet(add(rays.origin, scale(rays.dir, next)));
            active = active & at_next.value.abs().lt(at.value.abs());
            t = F::select(active, next, t);
            at = At {
                value: F::select(active, at_next.value, at.value),
                half_gradient: [
                    F::select(active, at_next.half_gradient[0], at.half_gradient[0]),
                    F::select(active, at_next.half_gradient[1], at.half_gradient[1]),
                    F::select(active, at_next.half_gradient[2], at.half_gradient[2]),
                ],
                size: F::select(active, at_next.size, at.size),
            };
        }
        t
    }

    #[inline(always)]
    fn at_packet<F: F64Lanes>(&self, p: Vec3Lanes<F>) -> At<F> {
        let turned = self.turned_packet(p);
        let (square, linear) = (dot(p, turned), dot(splat(self.linear), p));
        let constant = F::splat(self.constant);
        At {
            value: square + linear + constant,
            half_gradient: add(turned, splat(0.5 * self.linear)),
            size: square.abs() + linear.abs() + constant.abs(),
        }
    }

    #[inline(always)]
    fn turned_packet<F: F64Lanes>(&self, v: Vec3Lanes<F>) -> Vec3Lanes<F> {
        let matrix = &*self.matrix;
        let [x, y, z] = [
            scale(splat(matrix.x_axis), v[0]),
            scale(splat(matrix.y_axis), v[1]),
            scale(splat(matrix.z_axis), v[2]),
        ];
        add(add(x, y), z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::Bounds;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::SimdLevel;
    use crate::scene::shape::{Crossing, Geometry, Root, Start};
    use glam::DVec3;

    /// Computes the inside spans of a ray packet.
    #[derive(Clone, Copy)]
    struct SpanKernel<'a> {
        quadric: &'a Quadric,
        rays: [Ray; 4],
        within: (f64, f64),
    }

    impl SimdKernel for SpanKernel<'_> {
        type Output = [Option<(bool, f64, f64)>; 4];

        fn run<F: F64Lanes>(self) -> Self::Output {
            let spans = {
                let (low, high) = (F::splat(self.within.0), F::splat(self.within.1));
                self.quadric
                    .span_packet(&RayPacket::<F>::of_each(&self.rays), low, high)
            };
            let (enter, leave) = (spans.enter.to_array(), spans.leave.to_array());
            let hits = F::bitmask(spans.is_hit);
            [0, 1, 2, 3].map(|lane| {
                let is_known = spans.unknown >> lane & 1 == 0;
                is_known.then(|| match hits >> lane & 1 {
                    0 => (false, 0.0, 0.0),
                    _ => (true, enter[lane], leave[lane]),
                })
            })
        }
    }

    /// The roots of one ray within an interval, and true if the ray is inside at the start of it.
    fn scalar_ends(
        quadric: &Quadric,
        ray: &Ray,
        low: f64,
        high: f64,
    ) -> (bool, Vec<(f64, Crossing)>) {
        let mut roots: Vec<Root> = Vec::new();
        let mut is_inside = quadric.roots(ray, &mut roots) == Start::Inside;
        for root in roots.iter().filter(|root| root.t < low) {
            is_inside = root.crossing == Crossing::Enter;
        }
        let mut ends: Vec<_> = roots.iter().map(|root| (root.t, root.crossing)).collect();
        ends.retain(|(t, _)| low <= *t && *t <= high);
        (is_inside, ends)
    }

    /// The same, from the span of one lane.
    fn packet_ends(
        is_hit: bool,
        enter: f64,
        leave: f64,
        low: f64,
        high: f64,
    ) -> (bool, Vec<(f64, Crossing)>) {
        let mut ends = vec![(enter, Crossing::Enter), (leave, Crossing::Leave)];
        ends.retain(|(t, _)| is_hit && t.is_finite() && low <= *t && *t <= high);
        (is_hit && enter < low && low <= leave, ends)
    }

    #[test]
    fn packets_find_the_spans_of_each_ray() {
        let mut rng = Random::new(61);
        let bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);
        let (mut known, mut hits, mut open) = (0, 0, 0);
        for round in 0..20_000 {
            let sign = |rng: &mut Random| (3.0 * rng.uniform()).floor() - 1.0;
            let squares = DVec3::new(1.0, sign(&mut rng), sign(&mut rng));
            let [mixed, linear, scale] = match round % 3 {
                0 => [DVec3::ZERO, DVec3::ZERO, DVec3::ONE],
                1 => [DVec3::ZERO, rng.vector(1.0), rng.vector(1.0)],
                _ => [rng.vector(0.5), rng.vector(1.0), rng.vector(3.0)],
            };
            let constant = sign(&mut rng) * 0.25;
            let quadric = Quadric::new(squares * scale, mixed, linear, constant);
            let mut rays = [(); 4].map(|()| rng.ray_near(&bounds));
            if round % 5 == 0 {
                // Through the middle, along an axis, with zeros of either sign.
                rays[1] = Ray::new(DVec3::new(-0.0, 0.0, -4.0), DVec3::new(0.0, -0.0, 1.0));
                rays[2] = Ray::new(DVec3::new(0.0, 3.0, -0.0), DVec3::new(-0.0, -1.0, 0.0));
            }
            let quadric = &quadric;
            let within = match round % 2 {
                0 => (0.0, f64::INFINITY),
                _ => (rng.uniform(), 1.0 + rng.uniform()),
            };
            let kernel = SpanKernel {
                quadric,
                rays,
                within,
            };
            let (wide, narrow) = (
                SimdLevel::widest().run(kernel),
                SimdLevel::NARROW.run(kernel),
            );
            assert_eq!(wide, narrow);
            for (ray, span) in rays.iter().zip(wide) {
                let Some(span) = span else { continue };
                let expected = scalar_ends(quadric, ray, within.0, within.1);
                let (is_hit, enter, leave) = span;
                let ends = packet_ends(is_hit, enter, leave, within.0, within.1);
                assert_eq!(ends, expected, "{quadric:?} {ray:?}");
                known += 1;
                hits += usize::from(span.0);
                open += usize::from(span.0 && span.2 == f64::INFINITY);
            }
        }
        assert!(
            known > 40_000 && hits > 20_000 && open > 5_000,
            "{known} {hits} {open}"
        );
    }
}
