//! Transfer functions between linear light and encoded values.

use serde::{Deserialize, Serialize};

/// A transfer function.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Gamma {
    /// The sRGB curve (IEC 61966-2-1).
    Srgb,
    /// The curve of ITU-R BT.709.
    Bt709,
    /// The curve of ITU-R BT.2020, with the constants for 12 bits.
    Bt2020,
    /// A power law: `linear = encoded ^ g`. `Power(1.0)` is linear.
    Power(f32),
}

impl Gamma {
    /// The identity.
    pub const LINEAR: Gamma = Gamma::Power(1.0);

    /// The power law with exponent `g`; within 0.01 of 1 it is linear.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "a gamma has few digits")]
    pub fn power(g: f64) -> Gamma {
        if (g - 1.0).abs() < 0.01 {
            Gamma::LINEAR
        } else {
            Gamma::Power(g as f32)
        }
    }

    /// True if values of the one serve for the other, as in POV-Ray: a `gAMA` chunk says 0.45455 for 1/2.2.
    #[must_use]
    pub fn is_almost(self, other: Gamma) -> bool {
        match (self, other) {
            (Gamma::Power(from), Gamma::Power(to)) => (1.0 - to / from).abs() <= 0.01,
            _ => self == other,
        }
    }

    /// Linear light of an encoded value.
    #[must_use]
    pub fn decode(self, encoded: f32) -> f32 {
        match self {
            Gamma::Srgb if encoded <= 0.040_45 => encoded / 12.92,
            Gamma::Srgb => ((encoded + 0.055) / 1.055).powf(2.4),
            Gamma::Bt709 => BT709.decode(encoded),
            Gamma::Bt2020 => BT2020.decode(encoded),
            Gamma::Power(1.0) => encoded,
            Gamma::Power(g) => encoded.max(0.0).powf(g),
        }
    }

    /// Encoded value of linear light.
    #[must_use]
    pub fn encode(self, linear: f32) -> f32 {
        match self {
            Gamma::Srgb if linear <= 0.003_130_8 => linear * 12.92,
            Gamma::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
            Gamma::Bt709 => BT709.encode(linear),
            Gamma::Bt2020 => BT2020.encode(linear),
            Gamma::Power(1.0) => linear,
            Gamma::Power(g) => linear.max(0.0).powf(1.0 / g),
        }
    }
}

/// A curve of the ITU: linear up to `knee`, then a power law.
struct ItuCurve {
    scale: f32,
    knee: f32,
}

const BT709: ItuCurve = ItuCurve {
    scale: 1.099,
    knee: 0.018,
};
const BT2020: ItuCurve = ItuCurve {
    scale: 1.0993,
    knee: 0.0181,
};

impl ItuCurve {
    fn decode(&self, encoded: f32) -> f32 {
        match encoded < 4.5 * self.knee {
            true => encoded / 4.5,
            false => ((encoded + (self.scale - 1.0)) / self.scale).powf(1.0 / 0.45),
        }
    }

    fn encode(&self, linear: f32) -> f32 {
        match linear < self.knee {
            true => linear * 4.5,
            false => self.scale * linear.powf(0.45) - (self.scale - 1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Gamma;

    #[test]
    fn powers_within_a_hundredth_are_one() {
        for encoding in [0.454_55, 0.451, 0.459] {
            assert!(Gamma::Power(1.0 / encoding).is_almost(Gamma::Power(2.2)));
        }
        for other in [
            Gamma::Power(1.0 / 0.46),
            Gamma::Power(1.0 / 0.449),
            Gamma::Srgb,
        ] {
            assert!(!other.is_almost(Gamma::Power(2.2)));
        }
    }

    #[test]
    fn decoding_inverts_encoding() {
        for gamma in [
            Gamma::Srgb,
            Gamma::Bt709,
            Gamma::Bt2020,
            Gamma::LINEAR,
            Gamma::power(2.2),
        ] {
            for i in 0..=10u8 {
                let v = f32::from(i) / 10.0;
                assert!((gamma.decode(gamma.encode(v)) - v).abs() < 1e-5);
            }
        }
    }
}
