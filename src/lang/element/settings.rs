//! `global_settings`, and the settings that old scenes write outside of it.

use crate::base::args::{Args, Parse, Word};
use crate::base::bitmap::read_gamma;
use crate::base::source::Diagnostic;
use crate::lang::reader::Reader;
use crate::scene::Charset;
use crate::scene::pattern::read_noise_generator;

/// Range of `number_of_waves`: each costs time at each point.
const WAVES: std::ops::RangeInclusive<f64> = 1.0..=10_000.0;
/// POV-Ray's bounds of `max_trace_level`.
const TRACE_LEVELS: std::ops::RangeInclusive<f64> = 1.0..=256.0;

impl Reader<'_> {
    pub(crate) fn global_settings(&mut self) -> Parse<()> {
        self.changes += 1;
        self.pass();
        self.open_block()?;
        while !self.take_close()? {
            let Some(word) = self.peek()?.word() else {
                return Err(self.expected_here("a setting or `}` in `global_settings`"));
            };
            self.global_setting(word)?;
        }
        Ok(())
    }

    pub(crate) fn global_setting(&mut self, word: Word) -> Parse<()> {
        let at = self.here_span();
        match word {
            Word::Radiosity => return self.radiosity(),
            Word::Photons => return self.photons(),
            Word::Subsurface => return self.subsurface(),
            Word::AssumedGamma => {
                self.pass();
                let gamma = read_gamma(word, self)?;
                if self.draft.globals.assumed_gamma.is_some() {
                    self.warning(Diagnostic::warning(
                        at,
                        "`assumed_gamma` is set already; the first one counts",
                    ));
                } else {
                    self.draft.globals.assumed_gamma = Some(gamma);
                }
            }
            Word::AdcBailout => {
                self.pass();
                self.draft.globals.adc_bailout = self.float()?;
            }
            Word::MaxTraceLevel => {
                self.pass();
                let level = self.float()?.trunc();
                if !TRACE_LEVELS.contains(&level) {
                    let text = format!(
                        "`max_trace_level` runs from 1 to 256; {level} is taken to the nearest"
                    );
                    self.warning(Diagnostic::warning(at, text));
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "clamped"
                )]
                let level = level.clamp(*TRACE_LEVELS.start(), *TRACE_LEVELS.end()) as u32;
                self.draft.globals.max_trace_level = level;
            }
            Word::AmbientLight => {
                self.pass();
                self.draft.globals.ambient_light = self.color_value()?.rgb;
            }
            Word::NoiseGenerator => {
                self.pass();
                self.draft.globals.noise_generator = read_noise_generator(self)?;
            }
            Word::NumberOfWaves => {
                self.pass();
                self.draft.globals.number_of_waves = self.number_of_waves()?;
            }
            Word::MaxIntersections | Word::HfGray16 => {
                self.pass();
                if word == Word::HfGray16 {
                    self.float_or(1.0)?;
                } else {
                    self.float()?;
                }
                let message = format!("`{word}` has no effect from version 3.7 on");
                self.warning(Diagnostic::warning(at, message));
            }
            Word::MmPerUnit => {
                self.pass();
                self.draft.globals.mm_per_unit = self.float()?;
            }
            Word::IridWavelength => {
                self.pass();
                self.draft.globals.irid_wavelength = self.color_value()?.rgb;
            }
            Word::Charset => {
                self.pass();
                self.draft.globals.charset = if self.take_word(Word::Utf8)? {
                    Charset::Utf8
                } else if self.take_word(Word::Ascii)? || self.take_word(Word::Sys)? {
                    Charset::Ascii
                } else {
                    return Err(self.expected_here("`ascii`, `utf8` or `sys` after `charset`"));
                };
            }
            _ => return Err(self.expected_here("a setting or `}` in `global_settings`")),
        }
        Ok(())
    }

    fn number_of_waves(&mut self) -> Parse<u32> {
        let number = self.float()?.trunc();
        if !WAVES.contains(&number) {
            let text = format!("`number_of_waves` runs from 1 to {}", WAVES.end());
            self.warning(Diagnostic::warning(self.taken_span(), text));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let number = number.clamp(*WAVES.start(), *WAVES.end()) as u32;
        Ok(number)
    }
}

/// Settings that old scenes write outside of `global_settings`.
pub(crate) fn is_old_setting(word: Word) -> bool {
    matches!(word, Word::MaxIntersections | Word::MaxTraceLevel)
}
