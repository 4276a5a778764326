//! Colours of three or five channels in single precision, as in POV-Ray, and their arithmetic.

mod gamma;

pub use gamma::Gamma;

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// Linear red, green and blue.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

/// A scene colour: red, green, blue and two kinds of transparency, `filter` (tinted) and `transmit` (untinted).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Color {
    /// Red, green and blue in the working space.
    pub rgb: Rgb,
    /// The fraction of light transmitted with the tint of the colour.
    pub filter: f32,
    /// The fraction of light transmitted without tint.
    pub transmit: f32,
}

impl Rgb {
    /// All channels 0.
    pub const BLACK: Rgb = Rgb::splat(0.0);
    /// All channels 1.
    pub const WHITE: Rgb = Rgb::splat(1.0);

    /// A colour of three channels.
    #[must_use]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Rgb { r, g, b }
    }

    /// The same value in each channel.
    #[must_use]
    pub const fn splat(v: f32) -> Self {
        Rgb { r: v, g: v, b: v }
    }

    /// Red, green and blue in double precision.
    #[must_use]
    pub fn channels(self) -> [f64; 3] {
        [self.r, self.g, self.b].map(f64::from)
    }

    /// POV-Ray's luminance weights.
    #[must_use]
    pub fn grey(self) -> f32 {
        0.297 * self.r + 0.589 * self.g + 0.114 * self.b
    }

    /// The largest channel.
    #[must_use]
    pub fn max(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// Applies `f` to each channel.
    #[must_use]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Rgb {
        Rgb::new(f(self.r), f(self.g), f(self.b))
    }
}

impl Color {
    /// An opaque colour.
    #[must_use]
    pub const fn opaque(rgb: Rgb) -> Self {
        Color {
            rgb,
            filter: 0.0,
            transmit: 0.0,
        }
    }

    /// Builds a colour from five components in the language's order: red, green, blue, filter, transmit.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        reason = "colours are single precision, as in POV-Ray"
    )]
    pub fn from_components(c: [f64; 5]) -> Self {
        Color {
            rgb: Rgb::new(c[0] as f32, c[1] as f32, c[2] as f32),
            filter: c[3] as f32,
            transmit: c[4] as f32,
        }
    }

    /// The transmittance for light from behind: `rgb · filter + transmit` in each channel.
    #[must_use]
    pub fn transmission(self) -> Rgb {
        self.rgb * self.filter + Rgb::splat(self.transmit)
    }

    /// Linear interpolation from this colour (`share` 0) to `to` (`share` 1). As in POV-Ray 3.7, the difference, its
    /// share and the sum are rounded to single precision each.
    #[must_use]
    pub fn blended(&self, to: &Color, share: f64) -> Color {
        Color {
            rgb: self.rgb + (to.rgb - self.rgb) * share,
            filter: self.filter + scaled(to.filter - self.filter, share),
            transmit: self.transmit + scaled(to.transmit - self.transmit, share),
        }
    }

    /// The same as the sum of both shares, each rounded to single precision, as in POV-Ray 3.8.
    #[must_use]
    pub fn mixed(&self, to: &Color, share: f64) -> Color {
        let mix = |from: f32, to: f32| scaled(from, 1.0 - share) + scaled(to, share);
        Color {
            rgb: self.rgb * (1.0 - share) + to.rgb * share,
            filter: mix(self.filter, to.filter),
            transmit: mix(self.transmit, to.transmit),
        }
    }

    /// The weighted mean; opaque black if the weights sum to 0.
    #[must_use]
    pub fn average(weighted: impl Iterator<Item = (f32, Color)>) -> Color {
        let mut sum = Color::default();
        let mut total = 0.0;
        for (weight, color) in weighted {
            total += weight;
            sum.rgb += color.rgb * weight;
            sum.filter += color.filter * weight;
            sum.transmit += color.transmit * weight;
        }
        if total == 0.0 {
            return Color::default();
        }
        Color {
            rgb: sum.rgb.map(|channel| channel / total),
            filter: sum.filter / total,
            transmit: sum.transmit / total,
        }
    }

    /// True if any light is transmitted.
    #[must_use]
    pub fn is_transparent(self) -> bool {
        self.filter != 0.0 || self.transmit != 0.0
    }
}

impl Add for Rgb {
    type Output = Rgb;
    fn add(self, o: Rgb) -> Rgb {
        Rgb::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl Sub for Rgb {
    type Output = Rgb;
    fn sub(self, o: Rgb) -> Rgb {
        Rgb::new(self.r - o.r, self.g - o.g, self.b - o.b)
    }
}

impl Mul for Rgb {
    type Output = Rgb;
    fn mul(self, o: Rgb) -> Rgb {
        Rgb::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

impl Mul<f32> for Rgb {
    type Output = Rgb;
    fn mul(self, k: f32) -> Rgb {
        Rgb::new(self.r * k, self.g * k, self.b * k)
    }
}

/// The product is computed in double precision and rounded once, as in POV-Ray.
impl Mul<f64> for Rgb {
    type Output = Rgb;
    fn mul(self, k: f64) -> Rgb {
        Rgb::new(scaled(self.r, k), scaled(self.g, k), scaled(self.b, k))
    }
}

/// A channel times a factor.
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision, as in POV-Ray"
)]
fn scaled(channel: f32, factor: f64) -> f32 {
    (f64::from(channel) * factor) as f32
}

/// As the product.
impl Div<f64> for Rgb {
    type Output = Rgb;
    #[allow(
        clippy::cast_possible_truncation,
        reason = "colours are single precision, as in POV-Ray"
    )]
    fn div(self, k: f64) -> Rgb {
        self.map(|c| (f64::from(c) / k) as f32)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Rgb) {
        *self = *self + o;
    }
}

impl MulAssign for Rgb {
    fn mul_assign(&mut self, o: Rgb) {
        *self = *self * o;
    }
}
