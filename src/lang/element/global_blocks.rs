//! The blocks of `global_settings`: radiosity, photons and subsurface, read and checked as POV-Ray does.

use crate::base::args::{Args, Parse, Word, since_3_8};
use crate::base::source::{Diagnostic, Span};
use crate::lang::reader::Reader;
use crate::scene::light::photon_file;
use crate::scene::{Importance, PhotonDensity, Photons, RadiositySettings, Subsurface};

/// Number of stored radiosity directions unless a scene sets it.
const ALL_DIRECTIONS: u32 = 1600;

/// Range of a setting, and its description for messages.
struct Range {
    is_in: fn(f64) -> bool,
    description: &'static str,
}

const POSITIVE: Range = Range {
    is_in: |value| value > 0.0,
    description: "a positive number",
};
const SHARE: Range = Range {
    is_in: |value| value > 0.0 && value <= 1.0,
    description: "a number above 0 and up to 1",
};
const UP_TO_ONE: Range = Range {
    is_in: |value| (0.0..=1.0).contains(&value),
    description: "a number from 0 to 1",
};
const UP_TO_TWENTY: Range = Range {
    is_in: |value| (1.0..21.0).contains(&value),
    description: "a number from 1 to 20",
};
const COUNT: Range = Range {
    is_in: |value| (0.0..=4e9).contains(&value),
    description: "a number that is not negative",
};

impl Reader<'_> {
    /// `radiosity { ... }`. Settings of an earlier block stay.
    pub(crate) fn radiosity(&mut self) -> Parse<()> {
        self.pass();
        let start = self.taken_span();
        self.open_block()?;
        let mut settings = self.draft.globals.radiosity.unwrap_or_default();
        while !self.take_close()? {
            let Some(word) = self.peek()?.word() else {
                return Err(self.expected_here("a setting or `}` in `radiosity`"));
            };
            self.radiosity_setting(word, &mut settings)?;
        }
        if settings.maximum_reuse <= settings.minimum_reuse {
            let message = "`maximum_reuse` must be larger than `minimum_reuse`";
            return Err(self.with_trace(Diagnostic::error(start, message)));
        }
        self.draft.globals.radiosity = Some(settings);
        Ok(())
    }

    fn radiosity_setting(&mut self, word: Word, settings: &mut RadiositySettings) -> Parse<()> {
        if matches!(word, Word::LoadFile | Word::SaveFile) {
            self.pass();
            let at = self.taken_span();
            self.file_name()?;
            let message = format!("`{word}` in `radiosity` has no effect from version 3.7 on");
            self.warning(Diagnostic::warning(at, message));
            return Ok(());
        }
        let known = [
            Word::AdcBailout,
            Word::AlwaysSample,
            Word::Brightness,
            Word::Brilliance,
            Word::Count,
            Word::ErrorBound,
            Word::GrayThreshold,
            Word::LowErrorFactor,
            Word::MaxSample,
            Word::MaximumReuse,
            Word::Media,
            Word::MinimumReuse,
            Word::NearestCount,
            Word::Normal,
            Word::PretraceEnd,
            Word::PretraceStart,
            Word::RecursionLimit,
            Word::Subsurface,
        ];
        if !known.contains(&word) {
            return Err(self.expected_here("a setting or `}` in `radiosity`"));
        }
        self.pass();
        match word {
            Word::AdcBailout => settings.adc_bailout = self.float()?,
            Word::AlwaysSample => settings.always_sample = self.float()? != 0.0,
            Word::Brightness => settings.brightness = self.float()?,
            Word::Brilliance => {
                since_3_8(self, word, Word::Radiosity)?;
                settings.has_brilliance = self.float()? != 0.0;
            }
            Word::Count => {
                settings.count = count(self.checked(&POSITIVE)?);
                if self.has_next_value()? {
                    let at = self.span();
                    let directions = count(self.checked(&POSITIVE)?);
                    settings.directions = Some(directions);
                    if directions < ALL_DIRECTIONS {
                        self.warn_of(at, "the second number of `count`, below 1600,");
                    }
                }
            }
            Word::ErrorBound => settings.error_bound = self.checked(&POSITIVE)?,
            Word::GrayThreshold => settings.gray_threshold = self.checked(&UP_TO_ONE)?,
            Word::LowErrorFactor => settings.low_error_factor = self.checked(&POSITIVE)?,
            Word::MaxSample => settings.max_sample = self.float()?,
            Word::MaximumReuse => settings.maximum_reuse = self.checked(&POSITIVE)?,
            Word::MinimumReuse => settings.minimum_reuse = self.float()?,
            Word::Media => settings.has_media = self.float()? != 0.0,
            Word::Normal => settings.has_normals = self.float()? != 0.0,
            Word::Subsurface => settings.has_subsurface = self.float()? != 0.0,
            Word::NearestCount => {
                settings.nearest_count = count(self.checked(&UP_TO_TWENTY)?);
                if self.has_next_value()? {
                    let at = self.span();
                    settings.nearest_count_aim = count(self.checked(&COUNT)?);
                    if settings.nearest_count_aim > 0 {
                        self.warn_of(at, "the second number of `nearest_count`");
                    }
                }
            }
            Word::PretraceEnd => settings.pretrace_end = self.checked(&SHARE)?,
            Word::PretraceStart => settings.pretrace_start = self.checked(&SHARE)?,
            _ => settings.recursion_limit = count(self.checked(&UP_TO_TWENTY)?),
        }
        Ok(())
    }

    /// `photons { ... }` of the whole scene. By itself it shoots none: objects request photons.
    pub(crate) fn photons(&mut self) -> Parse<()> {
        self.pass();
        self.open_block()?;
        let mut settings = self.draft.globals.photons.take().unwrap_or_default();
        while !self.take_close()? {
            let Some(word) = self.peek()?.word() else {
                return Err(self.expected_here("a setting or `}` in `photons`"));
            };
            self.photons_setting(word, &mut settings)?;
        }
        self.draft.globals.photons = Some(settings);
        Ok(())
    }

    fn photons_setting(&mut self, word: Word, settings: &mut Photons) -> Parse<()> {
        match word {
            Word::Spacing => {
                self.pass();
                settings.density = PhotonDensity::Spacing(self.checked(&POSITIVE)?);
            }
            Word::Count => {
                self.pass();
                settings.density = PhotonDensity::Count(self.checked(&COUNT)?);
            }
            Word::Gather => {
                self.pass();
                settings.gather[0] = count(self.checked(&COUNT)?);
                self.accept_mark(',')?;
                settings.gather[1] = count(self.checked(&COUNT)?);
            }
            Word::Jitter => {
                self.pass();
                settings.jitter = self.float()?;
            }
            Word::Autostop => {
                self.pass();
                settings.autostop = self.float()?;
            }
            Word::ExpandThresholds => {
                self.pass();
                settings.expand_thresholds.0 = self.checked(&COUNT)?;
                self.accept_mark(',')?;
                settings.expand_thresholds.1 = count(self.checked(&COUNT)?);
            }
            Word::Radius => {
                self.pass();
                self.photons_radius(settings)?;
            }
            Word::Media => {
                self.pass();
                settings.media.0 = count(self.checked(&COUNT)?);
                if self.has_next_value()? {
                    settings.media.1 = self.float()?;
                }
            }
            Word::MaxTraceLevel => {
                self.pass();
                settings.max_trace_level = Some(count(self.checked(&COUNT)?));
            }
            Word::AdcBailout => {
                self.pass();
                settings.adc_bailout = Some(self.float()?);
            }
            Word::LoadFile => {
                self.pass();
                let name = self.file_name()?;
                let bytes = match self.file_named("the photon map", &name, &[]) {
                    Ok(bytes) => bytes,
                    // POV-Ray reads the file instead of emitting photons, which low qualities do without.
                    Err(error) => {
                        self.report.undrawn.push(*error);
                        return Ok(());
                    }
                };
                if photon_file::records(&bytes).is_none() {
                    let message = format!("`{name}` is not a photon map");
                    let error = Diagnostic::error(self.taken_span(), message)
                        .with_hint("Make one by `save_file`.");
                    return Err(self.with_trace(error));
                }
                settings.load_file = Some(bytes);
            }
            Word::SaveFile => {
                self.pass();
                let name = self.file_name()?;
                self.check_writable(&name, self.taken_span())?;
                settings.save_file = Some(name);
            }
            _ => return Err(self.expected_here("a setting or `}` in `photons`")),
        }
        Ok(())
    }

    /// Up to four numbers, which may be missing between commas: radius and factor, for surfaces and media.
    fn photons_radius(&mut self, settings: &mut Photons) -> Parse<()> {
        let [surface, media] = &mut settings.radius;
        let mut numbers = [surface.0, Some(surface.1), media.0, Some(media.1)];
        for (at, number) in numbers.iter_mut().enumerate() {
            if at > 0 && !self.has_next_value()? {
                break;
            }
            if self.at_expression()? {
                *number = Some(self.float()?);
            }
        }
        let [radius, factor, media_radius, media_factor] = numbers;
        *surface = (radius, factor.unwrap_or(1.0));
        *media = (media_radius, media_factor.unwrap_or(1.0));
        Ok(())
    }

    /// `subsurface { ... }` of the whole scene. By itself it changes nothing: finishes request it.
    pub(crate) fn subsurface(&mut self) -> Parse<()> {
        self.pass();
        self.open_block()?;
        let mut settings = Subsurface::default();
        while !self.take_close()? {
            if self.take_word(Word::Samples)? {
                settings.samples[0] = count(self.checked(&POSITIVE)?);
                self.accept_mark(',')?;
                settings.samples[1] = count(self.checked(&POSITIVE)?);
            } else if self.take_word(Word::Radiosity)? {
                settings.has_radiosity = self.float()? != 0.0;
            } else {
                return Err(self.expected_here("`samples`, `radiosity` or `}` in `subsurface`"));
            }
        }
        self.draft.globals.subsurface = Some(settings);
        Ok(())
    }

    /// `radiosity { importance value }` of an object, or the default of all.
    pub(crate) fn importance(&mut self) -> Parse<Option<Importance>> {
        self.pass();
        self.open_block()?;
        let mut importance = None;
        if self.take_word(Word::Importance)? {
            let at = self.span();
            let share = self.checked(&SHARE)?;
            importance = Some(Importance::new(share));
            if share < 1.0 {
                self.warn_of(at, "an `importance` below 1");
            }
        }
        Args::close(self)?;
        Ok(importance)
    }

    /// Warns of a setting with which the radiosity differs from POV-Ray's.
    fn warn_of(&mut self, at: Span, setting: &str) {
        let message = format!("{setting} is not obeyed as by POV-Ray: its radiosity will differ");
        self.warn(Diagnostic::warning(at, message));
    }

    /// A float within a range.
    fn checked(&mut self, range: &Range) -> Parse<f64> {
        let start = self.span();
        let value = self.float()?;
        if (range.is_in)(value) {
            return Ok(value);
        }
        let message = format!("expected {}, found {value}", range.description);
        Err(self.with_trace(Diagnostic::error(start.to(self.taken_span()), message)))
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates; checked by ranges before"
)]
fn count(value: f64) -> u32 {
    value as u32
}

#[cfg(test)]
mod tests {
    use crate::base::file::Folders;
    use crate::base::options::ReadOptions;
    use crate::base::source::Sources;
    use crate::lang::evaluate;
    use crate::scene::{Globals, PhotonDensity, RadiositySettings};

    fn globals(text: &str) -> Result<Globals, String> {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov", format!("global_settings {{ {text} }}"));
        let options = ReadOptions {
            writable: Folders::Only(vec![".".into()]),
            ..ReadOptions::default()
        };
        let reading = evaluate(file, &mut sources, &options);
        match reading.scene {
            Some(scene) => Ok(scene.globals),
            None => Err(reading.findings[0].message.clone()),
        }
    }

    #[test]
    fn radiosity_takes_all_its_words() {
        let all = globals(
            "radiosity { adc_bailout 0.1 always_sample on brightness 2 -1 count 30, 100 error_bound 1 gray_threshold 1
              low_error_factor .4 max_sample 3 media on maximum_reuse 0.3 minimum_reuse 0.01 nearest_count 6, 3 normal on
              pretrace_start .1 pretrace_end .02 recursion_limit 3 subsurface on save_file \"x\" load_file \"y\" }",
        );
        let expected = RadiositySettings {
            adc_bailout: 0.1,
            always_sample: true,
            brightness: 1.0,
            count: 30,
            directions: Some(100),
            error_bound: 1.0,
            gray_threshold: 1.0,
            low_error_factor: 0.4,
            max_sample: 3.0,
            maximum_reuse: 0.3,
            minimum_reuse: 0.01,
            has_brilliance: false,
            has_media: true,
            has_normals: true,
            has_subsurface: true,
            nearest_count: 6,
            nearest_count_aim: 3,
            pretrace_start: 0.1,
            pretrace_end: 0.02,
            recursion_limit: 3,
        };
        assert_eq!(all.unwrap().radiosity, Some(expected));
        let two = globals("radiosity { brightness 3 } radiosity { count 7 }").unwrap();
        let expected = RadiositySettings {
            brightness: 3.0,
            count: 7,
            ..RadiositySettings::default()
        };
        assert_eq!(two.radiosity, Some(expected));
    }

    /// The ranges are those that POV-Ray checks.
    #[test]
    fn settings_out_of_range_are_errors() {
        for text in [
            "count 0",
            "recursion_limit 0",
            "recursion_limit 21",
            "nearest_count 0",
            "nearest_count 21",
            "error_bound 0",
            "pretrace_start 2",
            "pretrace_end 0",
            "low_error_factor 0",
            "gray_threshold 2",
            "minimum_reuse .5 maximum_reuse .2",
            "importance .5",
            "always_sample",
            // A word of version 3.8.
            "brilliance on",
        ] {
            assert!(
                globals(&format!("radiosity {{ {text} }}")).is_err(),
                "{text}"
            );
        }
    }

    #[test]
    fn photons_take_all_their_words() {
        let all = globals(
            "photons { count 1000 gather 10, 50 media 100, 2 jitter .5 max_trace_level 6 adc_bailout .02 autostop 0
              expand_thresholds 0.3, 40 radius 0.1,,3 save_file \"x\" }",
        );
        let photons = all.unwrap().photons.unwrap();
        assert_eq!(photons.density, PhotonDensity::Count(1000.0));
        assert_eq!((photons.gather, photons.media), ([10, 50], (100, 2.0)));
        assert_eq!(photons.radius, [(Some(0.1), 1.0), (Some(3.0), 1.0)]);
        assert_eq!(photons.expand_thresholds, (0.3, 40));
        assert!(globals("photons { }").is_ok());
        assert!(globals("photons { gather 20 }").is_err());
        assert!(globals("photons { range 3 }").is_err());
    }

    #[test]
    fn subsurface_takes_two_counts() {
        let globals = |text: &str| globals(text).map(|globals| globals.subsurface.unwrap());
        let read = globals("subsurface { samples 10, 20 radiosity on }").unwrap();
        assert_eq!((read.samples, read.has_radiosity), ([10, 20], true));
        assert!(globals("subsurface { }").is_ok());
        assert!(globals("subsurface { samples 50 }").is_err());
    }
}
