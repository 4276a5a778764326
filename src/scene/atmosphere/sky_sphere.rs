//! `sky_sphere`: layered pigments at infinity, evaluated by ray direction, in front of the background.

use crate::base::args::{Args, Parse, Word, declared, transform_step};
use crate::base::color::{Color, Rgb};
use crate::base::math::Step;
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::{Pigment, PreparedPigment};
use glam::DVec3;

/// The sky of a scene.
#[derive(Clone, Debug)]
pub struct SkySphere {
    /// The pigments, the lowest layer first, at least one.
    pub pigments: Vec<Pigment>,
    /// A factor on the light of the pigments.
    pub emission: Rgb,
    /// Transforms of the whole sky.
    pub steps: Vec<Step>,
}

/// A sky prepared for ray queries.
#[derive(Debug)]
pub struct PreparedSky {
    /// The pigments, the top layer first.
    pigments: Vec<PreparedPigment>,
    emission: Rgb,
    rules_37: bool,
}

/// Radiance of the sky in one direction, and the factor on the background behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyRadiance {
    /// Radiance of the sky itself.
    pub rgb: Rgb,
    /// The factor on the background.
    pub factor: Rgb,
}

impl SkySphere {
    /// Reads the block of a sky sphere.
    ///
    /// # Errors
    /// A malformed value, or no pigment.
    pub fn read(args: &mut dyn Args) -> Parse<SkySphere> {
        args.open()?;
        let mut sky = match declared::<SkySphere>(args)? {
            Some(known) => SkySphere::clone(&known),
            None => SkySphere {
                pigments: Vec::new(),
                emission: Rgb::WHITE,
                steps: Vec::new(),
            },
        };
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                sky.steps.push(step);
            } else if args.accept(Word::Pigment)? {
                sky.pigments.push(Pigment::read(args, &Pigment::default())?);
            } else if args.accept(Word::Emission)? {
                sky.emission = args.color()?.rgb;
            } else {
                return Err(
                    args.expected("`pigment`, `emission`, a transform or `}` in `sky_sphere`")
                );
            }
        }
        if sky.pigments.is_empty() {
            let error = Diagnostic::error(args.last_span(), "this `sky_sphere` has no pigment");
            return Err(Box::new(
                error.with_hint("Write `pigment { ... }` into it."),
            ));
        }
        Ok(sky)
    }

    /// Prepares the sky for ray queries; `settings` are the scene-wide settings of patterns, and `rules_37` selects the
    /// rules for scenes of version 3.7 and later.
    #[must_use]
    pub fn prepare(&self, settings: &Settings, rules_37: bool) -> PreparedSky {
        let prepare = |pigment: &Pigment| PreparedPigment::new(pigment, &self.steps, settings);
        PreparedSky {
            pigments: self.pigments.iter().rev().map(prepare).collect(),
            emission: self.emission,
            rules_37,
        }
    }
}

impl PreparedSky {
    /// Evaluates the sky in a unit direction.
    ///
    /// From version 3.7 on, upper pigments filter the lower ones. Before, they attenuate the lower ones without tinting
    /// them, and the transmittance to the background is the product of all transmits, plus the product of all filters
    /// times the product of all colours (measured).
    #[must_use]
    pub fn radiance(&self, dir: DVec3) -> SkyRadiance {
        if self.rules_37 {
            self.filtered_layers(dir)
        } else {
            self.layers_before_37(dir)
        }
    }

    fn filtered_layers(&self, dir: DVec3) -> SkyRadiance {
        let clear = SkyRadiance {
            rgb: Rgb::BLACK,
            factor: Rgb::WHITE,
        };
        self.colors(dir).fold(clear, |above, color| {
            let light = color.rgb * (1.0 - color.filter - color.transmit);
            SkyRadiance {
                rgb: above.rgb + light * above.factor * self.emission,
                factor: above.factor * color.transmission(),
            }
        })
    }

    fn layers_before_37(&self, dir: DVec3) -> SkyRadiance {
        let mut rgb = Rgb::BLACK;
        let mut transmittance = 1.0;
        let mut product = Color {
            rgb: Rgb::WHITE,
            filter: 1.0,
            transmit: 1.0,
        };
        for color in self.colors(dir) {
            let opacity = 1.0 - color.filter - color.transmit;
            rgb += color.rgb * (transmittance * opacity) * self.emission;
            transmittance *= color.filter + color.transmit;
            product.rgb *= color.rgb;
            product.filter *= color.filter;
            product.transmit *= color.transmit;
        }
        SkyRadiance {
            rgb,
            factor: product.transmission(),
        }
    }

    fn colors(&self, dir: DVec3) -> impl Iterator<Item = Color> + '_ {
        self.pigments
            .iter()
            .map(move |pigment| pigment.color(&SurfacePoint::at(dir)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Parse<SkySphere> {
        SkySphere::read(&mut TextArgs::new(text))
    }

    /// Compares with pixels of POV-Ray 3.7 in front of a background of this colour.
    fn check(text: &str, rules_37: bool, background: Rgb, expected: [f32; 3]) {
        let seen = read(text)
            .unwrap()
            .prepare(&Settings::default(), rules_37)
            .radiance(DVec3::Z);
        let Rgb { r, g, b } = seen.rgb + seen.factor * background;
        for (actual, expected) in [r, g, b].into_iter().zip(expected) {
            assert!((actual - expected).abs() < 3e-5, "{text}: {r} {g} {b}");
        }
    }

    const ONE_LAYER: &str = "{ pigment { rgbft <0.8, 0.6, 0.4, 0.3, 0.2> } }";
    const TWO_LAYERS: &str = "{ pigment { rgbft <0.8, 0.6, 0.4, 0.3, 0.2> } \
        pigment { rgbft <0.3, 0.5, 0.7, 0.1, 0.4> } }";

    #[test]
    fn upper_pigments_filter_the_lower_ones() {
        check(ONE_LAYER, true, Rgb::BLACK, [0.4, 0.3, 0.2]);
        check(TWO_LAYERS, true, Rgb::BLACK, [0.322, 0.385, 0.444]);
        check(
            TWO_LAYERS,
            true,
            Rgb::new(0.5, 0.6, 0.7),
            [0.4166, 0.4876, 0.54928],
        );
    }

    #[test]
    fn before_3_7_upper_pigments_attenuate_the_lower_ones() {
        check(TWO_LAYERS, false, Rgb::BLACK, [0.35, 0.4, 0.45]);
        check(
            ONE_LAYER,
            false,
            Rgb::new(0.5, 0.6, 0.7),
            [0.62, 0.528, 0.424],
        );
        check(
            TWO_LAYERS,
            false,
            Rgb::new(0.5, 0.6, 0.7),
            [0.39361, 0.45341, 0.51188],
        );
    }

    #[test]
    fn emission_scales_the_light_of_the_sky() {
        let text = TWO_LAYERS.replacen('{', "{ emission rgb <0.5, 2, 1>", 1);
        let background = Rgb::new(0.5, 0.6, 0.7);
        check(&text, false, background, [0.2186, 0.85341, 0.51188]);
    }

    #[test]
    fn a_sky_needs_a_pigment() {
        let error = read("{ emission 1 }").expect_err("it is empty");
        assert_eq!(error.message, "this `sky_sphere` has no pigment");
    }
}
