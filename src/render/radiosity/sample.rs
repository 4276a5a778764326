//! Samples of irradiance and their weights at a point, one or four side by side.

use crate::base::color::Rgb;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{self, Vec3Lanes};
use glam::DVec3;

/// Points closer than this coincide.
const SAME: f64 = 1e-6;
/// The largest distance of a point behind a sample's plane, as a sine.
const BEHIND: f64 = 0.05;
/// Samples of less weight are ignored.
const MIN_WEIGHT: f64 = 0.001;
/// Roundings, more than those by which two squares with equal roots differ.
const ROUNDINGS: f64 = 8.0;

/// Irradiance at a point.
#[derive(Clone, Copy, Debug)]
pub struct IrradianceSample {
    /// The point.
    pub point: DVec3,
    /// The unit normal on the receiving side.
    pub normal: DVec3,
    /// The mean of the light over the hemisphere, weighted by the cosine to the power of `brilliance`.
    pub light: Rgb,
    /// The harmonic mean distance of the hits, within the limits of reuse.
    pub radius: f64,
    /// The distance of the nearest hit.
    pub nearest: f64,
    /// The unit direction to it; zero without a hit.
    pub to_nearest: DVec3,
    /// The quality of the light that was gathered, up to 1.
    pub quality: f64,
    /// The number of diffuse reflections before it.
    pub depth: usize,
    /// The exponent of the cosine by which the light is weighted.
    pub brilliance: f32,
}

/// A lookup of irradiance at a point.
#[derive(Clone, Copy, Debug)]
pub struct CacheQuery {
    /// The point.
    pub point: DVec3,
    /// The unit normal on the side that is seen.
    pub normal: DVec3,
    /// The largest error of a sample that counts.
    pub error: f64,
    /// The depth of the samples.
    pub depth: usize,
    /// The brilliance of the samples.
    pub brilliance: f32,
    /// Weights fall off smoothly rather than linearly.
    pub is_smooth: bool,
}

/// Points, normals and distances of samples in structure-of-arrays form, a sample per lane.
pub(super) struct SampleLanes<F> {
    pub(super) point: Vec3Lanes<F>,
    pub(super) normal: Vec3Lanes<F>,
    pub(super) to_nearest: Vec3Lanes<F>,
    pub(super) radius: F,
    pub(super) nearest: F,
    pub(super) quality: F,
}

impl IrradianceSample {
    /// The weight of the sample at a point; 0 where it does not count. `unit` is the length of the scene's unit.
    #[must_use]
    pub fn weight_at(&self, query: &CacheQuery, unit: f64) -> f64 {
        if self.brilliance != query.brilliance {
            return 0.0;
        }
        let lanes = SampleLanes {
            point: self.point.to_array(),
            normal: self.normal.to_array(),
            to_nearest: self.to_nearest.to_array(),
            radius: self.radius,
            nearest: self.nearest,
            quality: self.quality,
        };
        lanes.weights(query, unit)
    }
}

impl<F: F64Lanes> SampleLanes<F> {
    /// [`IrradianceSample::weight_at`] in lanes, of samples of the query's brilliance.
    #[inline(always)]
    pub(super) fn weights(&self, query: &CacheQuery, unit: f64) -> F {
        let (zero, one, two) = (F::splat(0.0), F::splat(1.0), F::splat(2.0));
        let max_error = F::splat(query.error);
        let offset = vec3::sub(vec3::splat(query.point), self.point);
        let distance_sq = vec3::dot(offset, offset);
        let farthest = self.radius * max_error;
        // Most samples are too far away, and this needs no square root.
        let limit_sq = farthest * farthest * F::splat(1.0 + ROUNDINGS * f64::EPSILON);
        let is_near = distance_sq.le(limit_sq);
        if F::bitmask(is_near) == 0 {
            return zero;
        }
        let distance = distance_sq.sqrt();
        let is_apart = F::splat(SAME * unit).lt(distance);
        let to_nearest = vec3::dot(self.to_nearest, offset) / distance;
        let toward = to_nearest * self.nearest + (one - to_nearest) * self.radius;
        let radius = F::select(is_apart & zero.lt(to_nearest), toward, self.radius);
        let normal = vec3::splat(query.normal);
        let between = vec3::add(normal, self.normal);
        let length = vec3::dot(between, between).sqrt();
        let front = vec3::dot(offset, between) / (distance * length);
        let front = F::select(is_apart, front, one);
        let turn = (one - vec3::dot(normal, self.normal)).abs().sqrt();
        let error = distance / radius + two * turn;
        // Points behind the sample are lit by light that it cannot see.
        let counts = is_near
            & distance.lt(farthest)
            & distance.lt(radius * max_error)
            & error.lt(max_error)
            & F::splat(-BEHIND).lt(front);
        let share = error / max_error;
        let rest = one - share;
        let weight = if query.is_smooth {
            let is_low = share.lt(F::splat(0.5));
            F::select(is_low, one - two * share * share, two * rest * rest)
        } else {
            rest
        };
        let dimmed = weight * (one + front / F::splat(BEHIND));
        let weight = F::select(front.le(zero), dimmed, weight);
        let is_used = counts & F::splat(MIN_WEIGHT).lt(weight);
        F::select(is_used, weight * self.quality, zero)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A sample of white light at a point, with its normal and nearest hit along y.
    pub(in crate::render::radiosity) fn sample(point: DVec3, radius: f64) -> IrradianceSample {
        IrradianceSample {
            point,
            normal: DVec3::Y,
            light: Rgb::WHITE,
            radius,
            nearest: radius,
            to_nearest: DVec3::Y,
            quality: 1.0,
            depth: 0,
            brilliance: 1.0,
        }
    }

    fn query(point: DVec3) -> CacheQuery {
        CacheQuery {
            point,
            normal: DVec3::Y,
            error: 1.5,
            depth: 0,
            brilliance: 1.0,
            is_smooth: false,
        }
    }

    /// The weights of the fact sheet, computed by hand.
    #[test]
    fn weights_fall_with_distance_and_angle() {
        let sample = sample(DVec3::ZERO, 2.0);
        let weight = |query: &CacheQuery| sample.weight_at(query, 1.0);
        assert_eq!(weight(&query(DVec3::ZERO)), 1.0);
        assert!((weight(&query(DVec3::X)) - (1.0 - 0.5 / 1.5)).abs() < 1e-12);
        assert_eq!(weight(&query(DVec3::X * 3.0)), 0.0);
        let smooth = CacheQuery {
            is_smooth: true,
            ..query(DVec3::X)
        };
        assert!((weight(&smooth) - (1.0 - 2.0 / 9.0)).abs() < 1e-12);
        // Behind the common plane nothing counts; just behind it weights are small.
        assert_eq!(weight(&query(DVec3::new(1.0, -0.2, 0.0))), 0.0);
        let behind = query(DVec3::new(1.0, -0.025, 0.0));
        let share = 1.0 - 1.0003f64 / 2.0 / 1.5;
        assert!((weight(&behind) - share * 0.5).abs() < 1e-3);
    }
}
