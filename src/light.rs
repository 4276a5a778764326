//! `light_source`: a point that gives light in all directions.
//!
//! Missing: spotlights, cylinders of light, parallel light, area lights, `looks_like`, `projected_through`.

use crate::args::{Args, Parse, Word, not_built, transform_step};
use crate::color::Rgb;
use crate::math::Step;
use glam::DVec3;

/// Up to this a `fade_distance` counts as none; POV-Ray's value.
const NO_FADE: f64 = 1e-10;

/// Words of a light source that are missing here.
const MISSING: &[Word] = &[
    Word::Adaptive,
    Word::AreaIllumination,
    Word::AreaLight,
    Word::Circular,
    Word::Cylinder,
    Word::Falloff,
    Word::Jitter,
    Word::LooksLike,
    Word::Orient,
    Word::Parallel,
    Word::Photons,
    Word::PointAt,
    Word::ProjectedThrough,
    Word::Radius,
    Word::Spotlight,
    Word::Tightness,
];

/// A point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it is, in the world.
    pub centre: DVec3,
    /// Its light; more than 1 and less than 0 are allowed.
    pub color: Rgb,
    /// The distance at which its light is `color`, if `fade_power` is more than 0.
    pub fade_distance: f64,
    /// The power of the distance by which its light fades.
    pub fade_power: f64,
    /// Whether nothing stops its light. Such a light makes no highlights.
    pub is_shadowless: bool,
}

impl Light {
    /// The light of a block.
    ///
    /// # Errors
    /// A malformed value, or a word that is not built yet.
    pub fn read(args: &mut dyn Args) -> Parse<Light> {
        args.open()?;
        let centre = args.vector()?;
        args.comma()?;
        let mut light = Light {
            centre,
            color: args.color()?.rgb,
            fade_distance: 0.0,
            fade_power: 0.0,
            is_shadowless: false,
        };
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                light.transform(&step);
                continue;
            }
            let word = args.word()?;
            match word {
                Some(word @ Word::FadeDistance) => {
                    args.accept(word)?;
                    light.fade_distance = args.float()?;
                }
                Some(word @ Word::FadePower) => {
                    args.accept(word)?;
                    light.fade_power = args.float()?;
                }
                Some(word @ Word::Shadowless) => {
                    args.accept(word)?;
                    light.is_shadowless = true;
                }
                // Both concern media only, of which there are none.
                Some(word @ (Word::MediaAttenuation | Word::MediaInteraction)) => {
                    args.accept(word)?;
                    args.float_or(1.0)?;
                }
                Some(word) if MISSING.contains(&word) => return Err(not_built(args, word)),
                _ => return Err(args.expected("a parameter of `light_source` or `}`")),
            }
        }
        Ok(light)
    }

    /// Moves the light; its fade distance stays.
    pub fn transform(&mut self, step: &Step) {
        self.centre = step
            .transform()
            .world_from_object
            .transform_point3(self.centre);
    }

    /// The share of its light that arrives at a distance, without regard to what stands in the way.
    #[must_use]
    pub fn attenuation(&self, distance: f64) -> f64 {
        if self.fade_power > 0.0 && self.fade_distance.abs() > NO_FADE {
            2.0 / (1.0 + (distance / self.fade_distance).powf(self.fade_power))
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;

    fn read(text: &str) -> Parse<Light> {
        Light::read(&mut TextArgs::new(text))
    }

    #[test]
    fn a_light_has_a_place_and_a_colour() {
        let light = read("{ <1, 2, 3>, rgb <1, 0.5, 0> }").unwrap();
        assert_eq!(light.centre, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(light.color, Rgb::new(1.0, 0.5, 0.0));
        assert!(!light.is_shadowless);
    }

    #[test]
    fn transforms_move_it() {
        let light = read(
            "{ <1, 0, 0>, 0.5 scale 2 translate y }"
                .replace('y', "<0, 1, 0>")
                .as_str(),
        );
        assert_eq!(light.unwrap().centre, DVec3::new(2.0, 1.0, 0.0));
    }

    #[test]
    fn light_is_its_colour_at_the_fade_distance() {
        let light = read("{ 0, rgb 1 fade_distance 4 fade_power 2 }").unwrap();
        assert_eq!(light.attenuation(4.0), 1.0);
        assert_eq!(light.attenuation(12.0), 0.2);
        assert_eq!(
            read("{ 0, rgb 1 fade_power 2 }").unwrap().attenuation(12.0),
            1.0
        );
    }

    #[test]
    fn what_is_missing_is_named() {
        for word in ["spotlight", "area_light", "parallel", "looks_like"] {
            let error = read(&format!("{{ 0, rgb 1 {word} }}")).expect_err("it is missing");
            assert_eq!(error.message, format!("`{word}` is not built yet"));
        }
    }

    #[test]
    fn other_words_are_not_expected() {
        let error = read("{ 0, rgb 1 ior 2 }").expect_err("`ior` has no place in a light");
        assert_eq!(
            error.message,
            "expected a parameter of `light_source` or `}`, found `ior`"
        );
    }
}
