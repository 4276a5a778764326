//! Four rays and a quadric at once, by the steps of [`super::quadric`] in the same order. What takes more steps there is
//! left to single rays: directions that are scaled first, a quadratic without its square, roots close to each other.
//!
//! Spans are valid within an interval of the line. An open quadric, such as the two nappes of a cone, has two of them; a
//! lane in which both reach into the interval takes the scalar path.

use super::quadric::{CLOSE, EVEN_SQUARES, NEAR_ENOUGH, Quadric};
use crate::base::math::Ray;
use crate::base::math::simd::{F64Lanes, SimdKernel, with_widest};
use crate::scene::shape::packet::{RayPacket, SpanPacket, Vec3Lanes, add, dot, scale, splat, sub};

/// What holds at four points.
#[derive(Clone, Copy)]
struct At<F> {
    value: F,
    half_gradient: Vec3Lanes<F>,
    /// No more than the sum of the sizes of the terms of the value.
    size: F,
}

/// Two places on one line, in lanes.
struct Refining<'a> {
    quadric: &'a Quadric,
    line: &'a Ray,
    places: [f64; 2],
}

/// Exact rounding error of a product, for numbers of [`has_error`] (Dekker 1971; the halves are Veltkamp's).
#[inline(always)]
fn error_of_product<F: F64Lanes>((a, b): (F, F), product: F) -> F {
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
fn has_error<F: F64Lanes>(x: F) -> F::Mask {
    const MOST: f64 = f64::from_bits((1023 + 400) << 52);
    let size = x.abs();
    let is_even = F::splat(1.0 / MOST).le(size) & size.le(F::splat(MOST));
    is_even | size.eq(F::splat(0.0))
}

impl SimdKernel for Refining<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> [f64; 2] {
        let rays = RayPacket::<F> {
            origin: splat(self.line.origin),
            dir: splat(self.line.dir),
        };
        let [t, other] = self.places;
        let refined = self
            .quadric
            .refined_of_four(&rays, F::from_array(&[t, other, t, other]));
        let [t, other, ..] = refined.to_array();
        [t, other]
    }
}

impl Quadric {
    /// Spans of four rays; an end outside of its interval from `low` to `high` may be missing.
    #[inline(always)]
    pub(crate) fn four<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
        (low, high): (F, F),
    ) -> SpanPacket<F> {
        let (zero, endless) = (F::splat(0.0), F::splat(f64::INFINITY));
        let dir_sq = dot(rays.dir, rays.dir);
        let is_even =
            F::splat(EVEN_SQUARES.start).le(dir_sq) & dir_sq.lt(F::splat(EVEN_SQUARES.end));
        let ahead = dot(sub(splat(self.middle), rays.origin), rays.dir) / dir_sq;
        let a = dot(rays.dir, self.turned_of_four(rays.dir));
        let near = self.at_four(add(rays.origin, scale(rays.dir, ahead)));
        let (b, c) = (dot(near.half_gradient, rays.dir), near.value);
        let (b_sq, a_c) = (b * b, a * c);
        let mut discriminant = b_sq - a_c;
        let is_apart = (F::splat(CLOSE) * b * b).le(discriminant.abs());
        // Little cancels.
        let mut is_clear = (F::splat(0.5) * b_sq.abs().lane_max(a_c.abs())).le(discriminant.abs());
        if F::bitmask(is_clear) != 0b1111 {
            let rest = error_of_product((b, b), b_sq) - error_of_product((a, c), a_c);
            discriminant = F::select(is_clear, discriminant, discriminant + rest);
            is_clear = is_clear | ((has_error(a) & has_error(b)) & has_error(c));
        }
        let is_known =
            (is_even & zero.lt(a.abs())) & ((is_clear & is_apart) & discriminant.abs().lt(endless));
        let is_met = zero.lt(discriminant);
        let is_open = a.lt(zero);
        if F::bitmask(is_met) == 0 {
            return SpanPacket {
                enter: -endless,
                leave: endless,
                is_met: is_open,
                unknown: 0b1111 & !F::bitmask(is_known),
            };
        }
        let root = discriminant.sqrt();
        // Zero has a sign, too.
        let is_negative = b.lt(zero) | (F::splat(1.0) / b).lt(zero);
        let q = -(b + F::select(is_negative, -root, root));
        let (t, other) = (q / a, c / q);
        let places = [t.lane_min(other) + ahead, t.lane_max(other) + ahead];
        let mut refined = places;
        for t in &mut refined {
            *t = self.refined_of_four(rays, *t);
        }
        let is_ordered = refined[0].le(refined[1]);
        let first = F::select(is_ordered, refined[0], places[0]);
        let second = F::select(is_ordered, refined[1], places[1]);
        let is_finite = first.abs().lt(endless) & second.abs().lt(endless);
        let is_span = is_finite & first.lt(second);
        // An open quadric: the first span ends before the interval, or the second begins behind it.
        let is_outer = is_met & is_open;
        let [is_over, is_to_come] = [first.lt(low), high.lt(second)];
        let is_one = F::bitmask(is_over | is_to_come) & !F::bitmask(first.eq(low));
        let doubts = F::bitmask(is_met) & !F::bitmask(is_span) | F::bitmask(is_outer) & !is_one;
        let (enter, leave) = (
            F::select(is_outer, F::select(is_over, second, -endless), first),
            F::select(is_outer, F::select(is_over, endless, first), second),
        );
        SpanPacket {
            enter: F::select(is_met, enter, -endless),
            leave: F::select(is_met, leave, endless),
            is_met: is_met | is_open,
            unknown: 0b1111 & (!F::bitmask(is_known) | doubts),
        }
    }

    /// Roots on one line with two of Newton's steps on the quadric in space, as far as they are needed and bring them
    /// nearer.
    pub(crate) fn refined(&self, line: &Ray, places: [f64; 2]) -> [f64; 2] {
        let refining = Refining {
            quadric: self,
            line,
            places,
        };
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(refining),
        )
    }

    /// The same on four lines.
    #[inline(always)]
    fn refined_of_four<F: F64Lanes>(&self, rays: &RayPacket<F>, mut t: F) -> F {
        let mut at = self.at_four(add(rays.origin, scale(rays.dir, t)));
        let mut goes_on = F::mask_from_bits(0b1111);
        for _ in 0..2 {
            let enough = F::splat(NEAR_ENOUGH * f64::EPSILON) * at.size;
            goes_on = goes_on & enough.lt(at.value.abs());
            if F::bitmask(goes_on) == 0 {
                break;
            }
            let slope = dot(at.half_gradient, rays.dir);
            // What is no number is not nearer.
            let next = t - F::splat(0.5) * at.value / slope;
            let there = self.at_four(add(rays.origin, scale(rays.dir, next)));
            goes_on = goes_on & there.value.abs().lt(at.value.abs());
            t = F::select(goes_on, next, t);
            at = At {
                value: F::select(goes_on, there.value, at.value),
                half_gradient: [
                    F::select(goes_on, there.half_gradient[0], at.half_gradient[0]),
                    F::select(goes_on, there.half_gradient[1], at.half_gradient[1]),
                    F::select(goes_on, there.half_gradient[2], at.half_gradient[2]),
                ],
                size: F::select(goes_on, there.size, at.size),
            };
        }
        t
    }

    #[inline(always)]
    fn at_four<F: F64Lanes>(&self, p: Vec3Lanes<F>) -> At<F> {
        let turned = self.turned_of_four(p);
        let (square, linear) = (dot(p, turned), dot(splat(self.linear), p));
        let constant = F::splat(self.constant);
        At {
            value: square + linear + constant,
            half_gradient: add(turned, splat(0.5 * self.linear)),
            size: square.abs() + linear.abs() + constant.abs(),
        }
    }

    #[inline(always)]
    fn turned_of_four<F: F64Lanes>(&self, v: Vec3Lanes<F>) -> Vec3Lanes<F> {
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

    /// Asks where four rays are inside of a quadric.
    #[derive(Clone, Copy)]
    struct Asked<'a> {
        quadric: &'a Quadric,
        rays: [Ray; 4],
        within: (f64, f64),
    }

    impl SimdKernel for Asked<'_> {
        type Output = [Option<(bool, f64, f64)>; 4];

        fn run<F: F64Lanes>(self) -> Self::Output {
            let spans = {
                let (low, high) = (F::splat(self.within.0), F::splat(self.within.1));
                self.quadric
                    .four(&RayPacket::<F>::of_each(&self.rays), (low, high))
            };
            let (enter, leave) = (spans.enter.to_array(), spans.leave.to_array());
            let met = F::bitmask(spans.is_met);
            [0, 1, 2, 3].map(|lane| {
                let is_known = spans.unknown >> lane & 1 == 0;
                is_known.then(|| match met >> lane & 1 {
                    0 => (false, 0.0, 0.0),
                    _ => (true, enter[lane], leave[lane]),
                })
            })
        }
    }

    /// The roots of one ray within an interval, and whether it is inside at the start of that.
    fn alone(
        quadric: &Quadric,
        ray: &Ray,
        (low, high): (f64, f64),
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
    fn among(span: (bool, f64, f64), (low, high): (f64, f64)) -> (bool, Vec<(f64, Crossing)>) {
        let (is_met, enter, leave) = span;
        let mut ends = vec![(enter, Crossing::Enter), (leave, Crossing::Leave)];
        ends.retain(|(t, _)| is_met && t.is_finite() && low <= *t && *t <= high);
        (is_met && enter < low && low <= leave, ends)
    }

    #[test]
    fn four_rays_find_what_each_finds() {
        let mut rng = Random::new(61);
        let bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);
        let (mut known, mut met, mut open) = (0, 0, 0);
        for round in 0..20_000 {
            let sign = |rng: &mut Random| (3.0 * rng.share()).floor() - 1.0;
            let squares = DVec3::new(1.0, sign(&mut rng), sign(&mut rng));
            let [mixed, linear, stretch] = match round % 3 {
                0 => [DVec3::ZERO, DVec3::ZERO, DVec3::ONE],
                1 => [DVec3::ZERO, rng.vector(1.0), rng.vector(1.0)],
                _ => [rng.vector(0.5), rng.vector(1.0), rng.vector(3.0)],
            };
            let constant = sign(&mut rng) * 0.25;
            let quadric = Quadric::new(squares * stretch, mixed, linear, constant);
            let mut rays = [(); 4].map(|()| rng.ray_near(&bounds));
            if round % 5 == 0 {
                // Through the middle, along an axis, with zeros of either sign.
                rays[1] = Ray::new(DVec3::new(-0.0, 0.0, -4.0), DVec3::new(0.0, -0.0, 1.0));
                rays[2] = Ray::new(DVec3::new(0.0, 3.0, -0.0), DVec3::new(-0.0, -1.0, 0.0));
            }
            let quadric = &quadric;
            let within = match round % 2 {
                0 => (0.0, f64::INFINITY),
                _ => (rng.share(), 1.0 + rng.share()),
            };
            let asked = Asked {
                quadric,
                rays,
                within,
            };
            let (wide, narrow) = (SimdLevel::widest().run(asked), SimdLevel::NARROW.run(asked));
            assert_eq!(wide, narrow);
            for (ray, found) in rays.iter().zip(wide) {
                let Some(found) = found else { continue };
                let expected = alone(quadric, ray, within);
                assert_eq!(among(found, within), expected, "{quadric:?} {ray:?}");
                known += 1;
                met += usize::from(found.0);
                open += usize::from(found.0 && found.2 == f64::INFINITY);
            }
        }
        assert!(
            known > 40_000 && met > 20_000 && open > 5_000,
            "{known} {met} {open}"
        );
    }
}
