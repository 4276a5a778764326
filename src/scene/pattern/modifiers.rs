//! The modifiers that any pattern may have: turbulence, waves, noise generator, transforms and warps.

use super::octaves::read_octaves;
use super::warp::Turbulence;
use super::{
    Pattern, PrepareContext, PreparedPattern, PreparedWarpChain, Settings, Shape, WarpChain, Wave,
};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::Step;
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::base::source::Diagnostic;
use glam::DVec3;

/// Valid values of `noise_generator`; 0 selects that of the global settings.
const GENERATORS: std::ops::RangeInclusive<f64> = 0.0..=3.0;

/// The modifiers of a pattern, shared by pigments, normals, densities and textures.
#[derive(Clone, Debug, Default)]
pub struct Modifiers {
    /// Transforms and warps.
    pub chain: WarpChain,
    /// The amounts of `turbulence` along the axes.
    turbulence: Option<DVec3>,
    octaves: Octaves,
    noise_generator: Option<NoiseGenerator>,
    frequency: Option<f32>,
    phase: Option<f32>,
    shape: Option<Shape>,
}

impl Modifiers {
    /// Reads `word`, the next token, with its value if it is a modifier of any pattern. Returns whether it is.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if self.chain.read(word, args)? {
            return Ok(true);
        }
        // Accepted without effect: normals, for which it matters, read it themselves.
        if word == Word::NoBumpScale {
            return args.accept(word);
        }
        if word == Word::Turbulence {
            args.accept(word)?;
            self.turbulence = Some(args.vector()?);
            return Ok(true);
        }
        if word == Word::NoiseGenerator {
            args.accept(word)?;
            self.noise_generator = read_noise_generator(args)?;
            return Ok(true);
        }
        Ok(read_octaves(&mut self.octaves, word, args)? || self.read_wave(word, args)?)
    }

    /// Sets the waveform as if the scene had.
    pub fn set_shape(&mut self, shape: Shape) {
        self.shape = Some(shape);
    }

    /// Sets what `wave`, the default of a pattern, has other than most patterns, as if the scene had. As in POV-Ray, it
    /// replaces what the scene set before the pattern, and stays when another pattern follows.
    pub fn set_wave(&mut self, wave: &Wave) {
        let usual = Wave::default();
        if wave.frequency != usual.frequency {
            self.frequency = Some(wave.frequency);
        } else if wave.shape != usual.shape {
            self.shape = Some(wave.shape);
        }
    }

    fn read_wave(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let mut wave = Wave::default();
        let is_known = wave.read(word, args)?;
        match word {
            _ if !is_known => {}
            Word::Frequency => self.frequency = Some(wave.frequency),
            Word::Phase => self.phase = Some(wave.phase),
            _ => self.shape = Some(wave.shape),
        }
        Ok(is_known)
    }

    /// The pattern prepared for evaluation. `after` holds the transforms of the object or texture with the pattern.
    #[must_use]
    pub fn prepare(
        &self,
        pattern: &dyn Pattern,
        after: &[Step],
        settings: &Settings,
    ) -> PreparedPattern {
        let default = pattern.default_wave();
        let wave = Wave {
            frequency: self.frequency.unwrap_or(default.frequency),
            phase: self.phase.unwrap_or(default.phase),
            shape: self.shape.unwrap_or(default.shape),
        };
        let value = pattern.prepare(&PrepareContext {
            noise: self.noise_generator.unwrap_or(settings.noise_generator),
            turbulence: self.turbulence.unwrap_or(DVec3::ZERO),
            octaves: self.octaves,
            wave,
            settings,
        });
        let is_displaced = settings.is_3_8 || pattern.is_displaced();
        let turbulence = self.displacement().filter(|_| is_displaced);
        let chain = self.chain.prepare(after, turbulence, settings);
        PreparedPattern::new(chain, value, wave)
    }

    /// The warp chain alone, for uses without a pattern.
    #[must_use]
    pub fn prepare_chain(&self, after: &[Step], settings: &Settings) -> PreparedWarpChain {
        self.chain.prepare(after, self.displacement(), settings)
    }

    fn displacement(&self) -> Option<Turbulence> {
        let amount = self.turbulence.filter(|&amount| amount != DVec3::ZERO)?;
        Some(Turbulence {
            amount,
            octaves: self.octaves,
        })
    }
}

/// Reads the number after `noise_generator`; `None` for 0, which selects that of the global settings.
///
/// # Errors
/// A number that names no generator.
pub fn read_noise_generator(args: &mut dyn Args) -> Parse<Option<NoiseGenerator>> {
    let start = args.span();
    let number = args.float()?.trunc();
    if !GENERATORS.contains(&number) {
        let span = start.to(args.last_span());
        let message = format!("`noise_generator` is 1, 2 or 3, found {number}");
        return Err(Box::new(Diagnostic::error(span, message)));
    }
    Ok((number > 0.0).then(|| NoiseGenerator::of_number(number)))
}
