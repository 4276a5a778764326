//! What a scene may write beside any pattern: turbulence, waves, the noise, transforms and warps.

use super::{
    Pattern, PreparedPattern, PreparedWarpChain, Preparing, Settings, Shape, WarpChain, Wave,
};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::Step;
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::base::source::Diagnostic;
use glam::DVec3;

/// The numbers that `noise_generator` takes; 0 leaves the choice to the scene.
const GENERATORS: std::ops::RangeInclusive<f64> = 0.0..=3.0;

/// Everything that a scene writes beside a pattern. Pigments, normals, densities and textures share it.
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
    /// Reads `word`, the next token, with its value if it may stand beside any pattern, and says whether it may.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if self.chain.read(word, args)? {
            return Ok(true);
        }
        // Taken, and of no meaning but beside bumps, which read it themselves.
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

    /// Shapes the value as if the scene said so.
    pub fn set_shape(&mut self, shape: Shape) {
        self.shape = Some(shape);
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

    /// The form for drawing; `after` are the transforms of what carries the pattern.
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
        let value = pattern.prepare(&Preparing {
            noise: self.noise_generator.unwrap_or(settings.noise_generator),
            turbulence: self.turbulence.unwrap_or(DVec3::ZERO),
            octaves: self.octaves,
            wave,
            settings,
        });
        let turbulence = self.displacement().filter(|_| pattern.is_displaced());
        let chain = self.chain.prepare(after, turbulence, settings);
        PreparedPattern::new(chain, value, wave)
    }

    /// The way to the point alone, where no pattern of its own is looked up there.
    #[must_use]
    pub fn prepare_chain(&self, after: &[Step], settings: &Settings) -> PreparedWarpChain {
        self.chain.prepare(after, self.displacement(), settings)
    }

    fn displacement(&self) -> Option<(DVec3, Octaves)> {
        let amount = self.turbulence.filter(|&amount| amount != DVec3::ZERO)?;
        Some((amount, self.octaves))
    }
}

/// Reads `octaves`, `omega` or `lambda` with its number, and says whether it was one of them.
pub(super) fn read_octaves(octaves: &mut Octaves, word: Word, args: &mut dyn Args) -> Parse<bool> {
    if !matches!(word, Word::Octaves | Word::Omega | Word::Lambda) {
        return Ok(false);
    }
    args.accept(word)?;
    match word {
        Word::Octaves => octaves.count = Octaves::count_of(args.float()?),
        Word::Omega => octaves.omega = args.single()?,
        _ => octaves.lambda = args.single()?,
    }
    Ok(true)
}

/// Reads the number behind `noise_generator`; `None` for 0, which leaves the choice to the scene.
///
/// # Errors
/// A number that names no generator.
pub fn read_noise_generator(args: &mut dyn Args) -> Parse<Option<NoiseGenerator>> {
    let start = args.span();
    let number = args.float()?.trunc();
    if !GENERATORS.contains(&number) {
        let place = start.to(args.last_span());
        let message = format!("`noise_generator` is 1, 2 or 3, found {number}");
        return Err(Box::new(Diagnostic::error(place, message)));
    }
    Ok((number > 0.0).then(|| NoiseGenerator::of_number(number)))
}
