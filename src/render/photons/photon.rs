//! A photon in POV-Ray's twenty bytes: its position in single precision, its light with a shared exponent for three
//! channels (Ward 1991, "Real Pixels"), and its origin's direction in two angles of a byte each.

use crate::base::color::Rgb;
use glam::DVec3;
use std::f64::consts::PI;

/// The bias of the shared exponent, modulo 256.
const EXPONENT: i32 = 250;
/// Light below this is black.
const NOTHING: f64 = 1e-32;
/// Light that is not a number: black.
const NOT_A_NUMBER: [u8; 4] = [0, 0, 0, 250];
/// Steps of an angle in half a turn.
const STEPS: f64 = 127.0;

/// A stored photon.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photon {
    /// Its position in the scene's own coordinates.
    pub position: [f32; 3],
    /// Red, green, blue and their exponent.
    pub light: [u8; 4],
    /// The splitting axis of the map.
    pub axis: u8,
    /// The direction of its origin: elevation, and azimuth around the y axis from x towards z.
    pub from: [i8; 2],
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "photons are stored in few bits"
)]
impl Photon {
    /// Packs a photon with this light at a point, coming from `origin`. The channels are truncated.
    #[must_use]
    pub fn new(position: DVec3, light: Rgb, origin: DVec3) -> Photon {
        Photon::with(packed(light), position, origin)
    }

    /// The same with rounded channels, as in POV-Ray 3.8.
    #[must_use]
    pub fn rounded(position: DVec3, light: Rgb, origin: DVec3) -> Photon {
        Photon::with(packed_rounded(light), position, origin)
    }

    fn with(light: [u8; 4], position: DVec3, origin: DVec3) -> Photon {
        let from = (origin - position).normalize_or_zero();
        let level = (from.x * from.x + from.z * from.z).sqrt();
        let turned = |cosine: f64, is_negative: bool| {
            let angle = cosine.acos();
            if is_negative { -angle } else { angle }
        };
        // An angle that is not a number, of a level 0 or above 1, becomes 0.
        let rise = turned(level, from.y < 0.0);
        let around = turned(from.x / level, from.z < 0.0);
        Photon {
            position: position.to_array().map(|x| x as f32),
            light,
            axis: 0,
            from: [rise, around].map(|angle| (angle * STEPS / PI) as i8),
        }
    }

    /// Its position.
    #[must_use]
    #[inline]
    pub fn at(&self) -> DVec3 {
        DVec3::from(self.position.map(f64::from))
    }
}

/// Lookup tables for unpacking photons.
#[derive(Clone, Debug, Default)]
pub(super) struct Unpacking {
    /// Sines and cosines, by the byte of the angle.
    turns: Vec<(f64, f64)>,
    /// The light of one step of a channel, by the exponent.
    steps: Vec<f32>,
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "light is stored in single precision"
)]
impl Unpacking {
    pub(super) fn new() -> Unpacking {
        let turn = |angle: u8| (f64::from(angle.cast_signed()) * PI / STEPS).sin_cos();
        let step = |exponent: u8| match exponent {
            0 => 0.0,
            _ => f64::from(i32::from(exponent) - EXPONENT - 8).exp2() as f32,
        };
        Unpacking {
            turns: (0..=u8::MAX).map(turn).collect(),
            steps: (0..=u8::MAX).map(step).collect(),
        }
    }

    /// The light of a photon.
    #[inline]
    pub(super) fn light(&self, photon: &Photon) -> Rgb {
        let [r, g, b, exponent] = photon.light;
        let step = self.steps[usize::from(exponent)];
        let channel = |byte: u8| f32::from(byte) * step;
        Rgb::new(channel(r), channel(g), channel(b))
    }

    /// The unit direction to a photon's origin.
    #[inline]
    pub(super) fn dir(&self, photon: &Photon) -> DVec3 {
        let [rise, around] = photon
            .from
            .map(|angle| self.turns[usize::from(angle.cast_unsigned())]);
        DVec3::new(rise.1 * around.1, rise.0, rise.1 * around.0)
    }
}

/// Three channels with a shared exponent.
fn packed(light: Rgb) -> [u8; 4] {
    let Some(exponent) = shared_exponent(light) else {
        return dark(light);
    };
    bytes(light, exponent, 0.0)
}

/// The same with rounded channels. The largest is below 255: where it would not be, the exponent is the next (measured).
fn packed_rounded(light: Rgb) -> [u8; 4] {
    let Some(exponent) = shared_exponent(light) else {
        return dark(light);
    };
    let is_full = bytes(light, exponent, 0.5)[..3].contains(&u8::MAX);
    bytes(light, exponent + i32::from(is_full), 0.5)
}

/// The exponent for three channels; `None` if they are too dark or not finite.
fn shared_exponent(light: Rgb) -> Option<i32> {
    let most = f64::from(light.max());
    (most >= NOTHING && most.is_finite()).then(|| exponent_of(most))
}

/// Channels without an exponent.
fn dark(light: Rgb) -> [u8; 4] {
    match light.max().is_nan() {
        true => NOT_A_NUMBER,
        false => [0; 4],
    }
}

/// Channels in units of an exponent, each plus `bias`.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "channels are below 256 or saturate, and the exponent wraps around"
)]
fn bytes(light: Rgb, exponent: i32, bias: f64) -> [u8; 4] {
    let unit = f64::from(8 - exponent).exp2();
    let channel = |c: f32| (f64::from(c) * unit + bias) as u8;
    [
        channel(light.r),
        channel(light.g),
        channel(light.b),
        (exponent + EXPONENT).rem_euclid(256) as u8,
    ]
}

/// The exponent of the least power of two above a positive normal number.
#[allow(clippy::cast_possible_truncation, reason = "eleven bits are taken")]
fn exponent_of(number: f64) -> i32 {
    ((number.to_bits() >> 52) & 0x7ff) as i32 - 1022
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_keeps_one_byte_of_its_largest_channel() {
        let photon = Photon::new(DVec3::ZERO, Rgb::new(0.75, 0.5, 0.001), DVec3::Y);
        assert_eq!(photon.light, [192, 128, 0, 250]);
        assert_eq!(Unpacking::new().light(&photon), Rgb::new(0.75, 0.5, 0.0));
        assert_eq!(Photon::new(DVec3::ZERO, Rgb::BLACK, DVec3::Y).light, [0; 4]);
    }

    /// Measured in the photons that POV-Ray 3.8 saves: bytes that 3.7 has as 149, 254 and 255.
    #[test]
    fn rounded_light_has_no_channel_of_255() {
        let of = |r: f32, g: f32| {
            let light = Rgb::new(r / 256.0, g / 256.0, 0.0);
            Photon::rounded(DVec3::ZERO, light, DVec3::Y).light
        };
        assert_eq!(of(149.5, 20.4), [150, 20, 0, 250]);
        assert_eq!(of(254.4, 0.4), [254, 0, 0, 250]);
        assert_eq!(of(254.6, 1.0), [127, 1, 0, 251]);
        assert_eq!(of(255.9, 0.0), [128, 0, 0, 251]);
        assert_eq!(
            Photon::rounded(DVec3::ZERO, Rgb::BLACK, DVec3::Y).light,
            [0; 4]
        );
    }

    #[test]
    fn directions_are_exact_to_about_a_degree() {
        for from in [
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(-1.0, -2.0, 0.5),
            DVec3::new(0.2, 0.1, -3.0),
            DVec3::NEG_Y,
        ] {
            let photon = Photon::new(DVec3::ZERO, Rgb::WHITE, from);
            assert!(
                Unpacking::new().dir(&photon).dot(from.normalize()) > 0.999,
                "{from}"
            );
        }
        let photon = Photon::new(DVec3::ZERO, Rgb::WHITE, DVec3::Y);
        assert_eq!(photon.from, [63, 0]);
    }
}
