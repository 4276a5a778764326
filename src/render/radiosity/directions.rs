//! The ray directions of irradiance samples.

use crate::base::math::halton;
use glam::DVec3;
use std::f64::consts::TAU;

/// The default number of directions.
pub(super) const DEFAULT_COUNT: u32 = 1600;

/// The cosine to y from which a normal uses the axes of the world.
const UPRIGHT: f64 = 0.999;
/// The cosine to z from which a frame is built about y.
const NEAR_Z: f64 = 0.9;

/// Cosine-weighted directions over the hemisphere about y.
pub(super) fn pool(count: u32) -> Vec<DVec3> {
    (1..=count).map(direction).collect()
}

fn direction(number: u32) -> DVec3 {
    let point = halton(number);
    let (radius, (sin, cos)) = (point.x.sqrt(), (TAU * point.y).sin_cos());
    DVec3::new(radius * cos, (1.0 - radius * radius).sqrt(), radius * sin)
}

/// The direction about y that stands for a cosine-weighted one where the weight is the cosine to the power of `brilliance`.
pub(super) fn of_brilliance(dir: DVec3, brilliance: f32) -> DVec3 {
    let across = (1.0 - dir.y * dir.y).sqrt();
    if brilliance == 1.0 || across == 0.0 {
        return dir;
    }
    let cosine = dir.y.powf(2.0 / (1.0 + f64::from(brilliance)));
    let scale = (1.0 - cosine * cosine).max(0.0).sqrt() / across;
    DVec3::new(scale * dir.x, cosine, scale * dir.z)
}

/// The axes of the hemisphere about a normal, in POV-Ray's orientation.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: DVec3,
    normal: DVec3,
    z: DVec3,
}

impl Frame {
    /// The frame about a unit normal.
    #[must_use]
    pub fn about(normal: DVec3) -> Self {
        if normal.y.abs() > UPRIGHT {
            // The axes of the world, inverted for a ceiling.
            let sign = normal.y.signum();
            return Frame {
                x: sign * DVec3::X,
                normal: sign * DVec3::Y,
                z: sign * DVec3::Z,
            };
        }
        let axis = if normal.z.abs() > NEAR_Z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let x = normal.cross(axis).normalize();
        let z = x.cross(normal).normalize();
        Frame { x, normal, z }
    }

    /// Maps a direction from the y-up frame to this frame.
    #[must_use]
    pub fn turned(&self, dir: DVec3) -> DVec3 {
        dir.x * self.x + dir.y * self.normal + dir.z * self.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_cosine_weighted() {
        let pool = pool(DEFAULT_COUNT);
        assert!(
            pool.iter()
                .all(|dir| dir.y >= 0.0 && (dir.length() - 1.0).abs() < 1e-12)
        );
        let mean: f64 = pool.iter().map(|dir| dir.y).sum::<f64>() / f64::from(DEFAULT_COUNT);
        // The mean cosine of cosine-weighted directions is two thirds.
        assert!((mean - 2.0 / 3.0).abs() < 1e-3, "{mean}");
        // h2(1) = 1/2, h3(1) = 1/3.
        let first = DVec3::new(
            -0.5 * 0.5f64.sqrt(),
            0.5f64.sqrt(),
            0.75f64.sqrt() * 0.5f64.sqrt(),
        );
        assert!((pool[0] - first).length() < 1e-12, "{}", pool[0]);
    }

    #[test]
    fn directions_follow_the_brilliance() {
        for (brilliance, exponent) in [(0.5, 0.5), (1.0, 1.0), (3.0, 3.0)] {
            let of_pool = pool(DEFAULT_COUNT)
                .into_iter()
                .map(|dir| of_brilliance(dir, brilliance));
            let cosines: Vec<f64> = of_pool
                .inspect(|dir| assert!((dir.length() - 1.0).abs() < 1e-12))
                .map(|dir| dir.y)
                .collect();
            let mean: f64 = cosines.iter().sum::<f64>() / f64::from(DEFAULT_COUNT);
            let expected = (exponent + 1.0) / (exponent + 2.0);
            assert!((mean - expected).abs() < 1e-3, "{brilliance}: {mean}");
        }
    }

    #[test]
    fn frames_map_y_to_their_normal() {
        for normal in [
            DVec3::Y,
            -DVec3::Y,
            DVec3::X,
            -DVec3::Z,
            DVec3::new(0.6, 0.64, 0.48),
        ] {
            let frame = Frame::about(normal);
            assert!((frame.turned(DVec3::Y) - normal).length() < 1e-12);
            let dir = DVec3::new(0.48, 0.6, 0.64);
            assert!((frame.turned(dir).length() - 1.0).abs() < 1e-12);
            assert!((frame.turned(dir).dot(normal) - 0.6).abs() < 1e-12);
        }
    }
}
