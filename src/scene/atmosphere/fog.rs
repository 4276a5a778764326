//! `fog`: attenuates light by `exp(-d / distance)` and adds the fog's own colour for the rest.
//!
//! Ground fog (`fog_type 2`) has full density up to the height `fog_offset` and falls off above it as `1 / (1 + y²)`,
//! `y` in units of `fog_alt`. Turbulence shortens the path length through the fog.

use super::Tint;
use crate::base::args::{Args, Parse, Word, declared, transform_step};
use crate::base::color::Color;
use crate::base::math::Ray;
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::base::source::Diagnostic;
use glam::DVec3;

/// Heights closer than this, in units of `fog_alt`, count as equal; POV-Ray's value.
const SAME_HEIGHT: f64 = 1e-10;
/// The `fog_type` of ground fog. All others are homogeneous, as in POV-Ray.
const GROUND_FOG: f64 = 2.0;

/// A fog.
#[derive(Clone, Debug, PartialEq)]
pub struct Fog {
    /// The distance over which light falls to 1/e; 0 for no fog.
    pub distance: f64,
    /// The fog's own colour; `filter` tints light from behind it, `transmit` is the least transmittance.
    pub color: Color,
    /// True for ground fog.
    pub is_ground: bool,
    /// The unit direction upwards, for ground fog.
    pub up: DVec3,
    /// `fog_alt`: the height above `offset` at which ground fog has half its density.
    pub alt: f64,
    /// `fog_offset`: ground fog has full density up to this height.
    pub offset: f64,
    /// Factors on the midpoint of the ray, where the turbulence is sampled; with zero it is that of the origin for
    /// every ray.
    pub turbulence: Option<DVec3>,
    /// `turb_depth`: a factor on the turbulence, which limits the share of the path length it removes.
    pub turb_depth: f64,
    /// The octaves of the turbulence.
    pub octaves: Octaves,
}

impl Default for Fog {
    fn default() -> Self {
        Fog {
            distance: 0.0,
            color: Color::default(),
            is_ground: false,
            up: DVec3::Y,
            alt: 0.0,
            offset: 0.0,
            turbulence: None,
            turb_depth: 0.5,
            octaves: Octaves::default(),
        }
    }
}

impl Fog {
    /// Reads the block of a fog.
    ///
    /// # Errors
    /// A malformed value, or an `up` without direction.
    pub fn read(args: &mut dyn Args) -> Parse<Fog> {
        args.open()?;
        let mut fog = match declared::<Fog>(args)? {
            Some(known) => {
                let mut fog = Fog::clone(&known);
                if args.is_for_3_8() {
                    fog.turbulence.get_or_insert(DVec3::ZERO);
                }
                fog
            }
            None => Fog::default(),
        };
        let at = args.last_span();
        while !args.accept_close()? {
            fog.read_item(args)?;
        }
        let Some(up) = fog.up.try_normalize() else {
            let error = Diagnostic::error(at, "the `up` of this fog has no direction");
            return Err(Box::new(error.with_hint("Write `up y`.")));
        };
        fog.up = up;
        Ok(fog)
    }

    fn read_item(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(color) = args.color_if_any()? {
            self.color = color;
            return Ok(());
        }
        if let Some(step) = transform_step(args)? {
            // Transforms affect only the direction `up`.
            self.up = step
                .transform()
                .world_from_object
                .transform_vector3(self.up);
            return Ok(());
        }
        if args.at_expression()? {
            self.distance = args.float()?;
            let text = "a number alone in `fog` is its distance";
            let warning = Diagnostic::warning(args.last_span(), text);
            args.warn(warning.with_hint("Write `distance` before it."));
            return Ok(());
        }
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of `fog` or `}`"));
        };
        let slot = match word {
            Word::Distance => &mut self.distance,
            Word::FogAlt => &mut self.alt,
            Word::FogOffset => &mut self.offset,
            Word::TurbDepth => &mut self.turb_depth,
            Word::FogType => {
                args.accept(word)?;
                self.is_ground = args.float()?.trunc() == GROUND_FOG;
                return Ok(());
            }
            Word::Up | Word::Turbulence => {
                args.accept(word)?;
                let vector = args.vector()?;
                if word == Word::Up {
                    self.up = vector;
                } else {
                    self.turbulence = Some(vector);
                }
                return Ok(());
            }
            Word::Octaves | Word::Omega | Word::Lambda => return self.read_octaves(word, args),
            _ => return Err(args.expected("a parameter of `fog` or `}`")),
        };
        args.accept(word)?;
        *slot = args.float()?;
        Ok(())
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "turbulence is single precision, as in POV-Ray"
    )]
    fn read_octaves(&mut self, word: Word, args: &mut dyn Args) -> Parse<()> {
        args.accept(word)?;
        self.turbulence.get_or_insert(DVec3::ZERO);
        let value = args.float()?;
        match word {
            Word::Octaves => self.octaves.count = Octaves::clamped_count(value),
            Word::Omega => self.octaves.omega = value as f32,
            _ => self.octaves.lambda = value as f32,
        }
        Ok(())
    }

    /// Returns true if the fog has any effect.
    #[must_use]
    pub fn exists(&self) -> bool {
        self.distance != 0.0
    }

    /// The effect of this fog on light, over `length` from the origin of a ray of unit direction.
    #[must_use]
    pub fn tint(&self, ray: &Ray, length: f64, noise: NoiseGenerator) -> Tint {
        let mut path_length = length;
        if let Some(turbulence) = self.turbulence {
            let middle = ray.at(0.5 * length) * turbulence;
            let depth = self.turb_depth * noise.turbulence(middle, &self.octaves);
            path_length *= 1.0 - (-length / self.distance).exp() * depth.min(1.0);
        }
        let density = if self.is_ground {
            self.density(ray.origin.dot(self.up), ray.at(length).dot(self.up))
        } else {
            1.0
        };
        let min_transmittance = f64::from(self.color.transmit);
        let transmittance = (-path_length * density / self.distance)
            .exp()
            .max(min_transmittance);
        let Color { rgb, filter, .. } = self.color;
        let filtered = rgb.map(|c| (1.0 - filter) + filter * c);
        Tint {
            factor: filtered * transmittance,
            added: rgb * (1.0 - transmittance),
        }
    }

    /// The mean density of ground fog between two heights.
    fn density(&self, from: f64, to: f64) -> f64 {
        let (s, t) = (
            (from - self.offset) / self.alt,
            (to - self.offset) / self.alt,
        );
        match (s <= 0.0, t <= 0.0) {
            (true, true) => 1.0,
            (true, false) => (t.atan() - s) / (t - s),
            (false, true) => (s.atan() - t) / (s - t),
            (false, false) if (s - t).abs() > SAME_HEIGHT => (s.atan() - t.atan()) / (s - t),
            // Zero without `alt`: such a fog ends at its offset.
            (false, false) => 1.0 / (s * s + 1.0),
        }
    }
}

/// The combined effect of several fogs: their factors multiply, and their own light adds up without being attenuated by
/// the other fogs.
#[must_use]
pub fn combined_tint(tints: impl Iterator<Item = Tint>) -> Tint {
    tints.fold(Tint::NONE, |sum, tint| Tint {
        factor: sum.factor * tint.factor,
        added: sum.added + tint.added,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::color::Rgb;

    fn read(text: &str) -> Fog {
        Fog::read(&mut TextArgs::new(text)).unwrap()
    }

    /// A wall of rgb <.2, .5, .9> three units in front of the camera, as POV-Ray 3.7 draws it in one or more fogs.
    fn check(fogs: &[&str], expected: [f32; 3]) {
        let ray = Ray::new(DVec3::ZERO, DVec3::new(0.31589, 0.0, 0.94880));
        let tints = fogs
            .iter()
            .map(|text| read(text).tint(&ray, 3.0 / 0.94880, NoiseGenerator::default()));
        let Rgb { r, g, b } = combined_tint(tints).apply(Rgb::new(0.2, 0.5, 0.9));
        for (actual, expected) in [r, g, b].into_iter().zip(expected) {
            assert!((actual - expected).abs() < 2e-3, "{fogs:?}: {r} {g} {b}");
        }
    }

    #[test]
    fn fog_attenuates_light_and_adds_its_own() {
        check(
            &["{ distance 2 rgb <0.6, 0.5, 0.4> }"],
            [0.51768, 0.50001, 0.50291],
        );
        assert!(!read("{ rgb 1 }").exists());
    }

    #[test]
    fn filter_tints_and_transmit_is_the_least_transmittance() {
        let text = "{ distance 2 rgbft <0.6, 0.5, 0.4, 0.3, 0.2> }";
        check(&[text], [0.51273, 0.48457, 0.46957]);
        let far = "{ distance 0.2 rgbft <0.6, 0.5, 0.4, 0.3, 0.2> }";
        check(&[far], [0.51521, 0.48499, 0.46760]);
    }

    #[test]
    fn several_fogs_add_up() {
        let fogs = [
            "{ distance 2 rgbft <0.6, 0.5, 0.4, 0.3, 0.2> }",
            "{ distance 5 rgbft <0.3, 0.5, 0.9, 0.1, 0.3> }",
        ];
        check(&fogs, [0.63500, 0.67556, 0.81935]);
    }

    #[test]
    fn ground_fog_thins_out_above_its_offset() {
        let ground = |rest: &str| {
            format!("{{ fog_type 2 distance 2 fog_offset -0.2 rgb <0.6, 0.5, 0.4> {rest} }}")
        };
        check(&[&ground("fog_alt 0.5")], [0.49761, 0.50001, 0.52798]);
        check(&[&ground("")], [0.2, 0.5, 0.9]);
        check(&[&ground("fog_alt -0.5")], [0.51768, 0.50001, 0.50291]);
    }

    #[test]
    fn transforms_rotate_up() {
        let fog = read("{ up <0, 2, 0> rotate <90, 0, 0> translate 5 scale 3 }");
        assert!((fog.up - DVec3::Z).length() < 1e-12);
        let error = Fog::read(&mut TextArgs::new("{ up 0 }")).expect_err("no direction");
        assert_eq!(error.message, "the `up` of this fog has no direction");
    }
}
