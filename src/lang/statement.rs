//! The statements of a scene file, and going on after a faulty one.

use super::cursor::Entered;
use super::hints::opens_group;
use super::limits;
use super::reader::Reader;
use super::value::Value;
use crate::args::{Args, Parse, Word};
use crate::atmosphere::{Fog, Rainbow, SkySphere};
use crate::camera::Camera;
use crate::color::Gamma;
use crate::interior::Media;
use crate::pattern::read_noise_generator;
use crate::scene::{Charset, Object};
use crate::source::{Code, Diagnostic};
use crate::syntax::{Class, Kind};
use crate::texture::{Layer, Texture};
use std::sync::Arc;

/// How many waves there may be: each costs time at each point.
const WAVES: std::ops::RangeInclusive<f64> = 1.0..=10_000.0;
/// POV-Ray's bounds of `max_trace_level`.
const TRACE_LEVELS: std::ops::RangeInclusive<f64> = 1.0..=256.0;

impl Reader<'_> {
    /// Reads the whole scene; findings are recorded.
    pub(super) fn statements(&mut self) {
        loop {
            match self.statement() {
                Ok(true) => {}
                Ok(false) => return,
                Err(error) => {
                    let mut is_unbuilt =
                        error.code == Some(Code::NotBuilt) && !self.has_faulty_directive;
                    self.tell(error);
                    if is_unbuilt && let Err(error) = self.skip_blocks(0) {
                        is_unbuilt = false;
                        self.tell(error);
                    }
                    if self.is_over {
                        return;
                    }
                    if self.errors >= limits::ERRORS {
                        let message = format!("nothing is read behind {} errors", limits::ERRORS);
                        self.warning(Diagnostic::warning(None, message));
                        return;
                    }
                    if !is_unbuilt {
                        self.recover();
                    }
                }
            }
        }
    }

    fn tell(&mut self, error: Box<Diagnostic>) {
        let error = self.with_trace(*error);
        self.record(*error);
    }

    /// One statement; false at the end of the scene.
    fn statement(&mut self) -> Parse<bool> {
        self.blocks.clear();
        self.depth = 0;
        self.has_faulty_directive = false;
        self.take_literal_objects(|reader, object| reader.add_object(Arc::new(object)))?;
        let token = self.peek()?;
        self.statement_start = self.start_here();
        if token.kind == Kind::End {
            return self.end_of_scene().map(|()| false);
        }
        match token.word() {
            Some(Word::Camera) => {
                self.pass();
                let at = self.taken_span();
                let base = self.default_camera.clone();
                let camera = Camera::read(self, &base)?;
                if let Some((_, first)) = self.camera.replace((camera, at)) {
                    self.warning(
                        Diagnostic::warning(at, "more than one camera; the last one counts")
                            .with_label(first, "this one does not count"),
                    );
                }
            }
            Some(Word::Background) => {
                self.pass();
                self.open_block()?;
                self.background = Some(self.color_value()?);
                Args::close(self)?;
            }
            Some(Word::Fog) => {
                self.pass();
                let fog = Fog::read(self)?;
                self.atmosphere.fogs.push(fog);
            }
            Some(Word::Rainbow) => {
                self.pass();
                let rainbow = Rainbow::read(self)?;
                self.atmosphere.rainbows.push(rainbow);
            }
            Some(Word::Media) => {
                self.pass();
                let media = Media::read(self)?;
                self.atmosphere.media.push(media);
            }
            Some(Word::SkySphere) => {
                self.pass();
                let sky = SkySphere::read(self)?;
                if self.atmosphere.sky_sphere.replace(Arc::new(sky)).is_some() {
                    self.warning(Diagnostic::warning(
                        self.taken_span(),
                        "more than one `sky_sphere`; the last one counts",
                    ));
                }
            }
            Some(Word::GlobalSettings) => self.global_settings()?,
            Some(word) if is_old_setting(word) => {
                let message = format!("`{word}` should stand in `global_settings`");
                self.warning(Diagnostic::warning(self.here_span(), message));
                self.global_setting(word)?;
            }
            Some(Word::Default) => {
                self.pass();
                self.run_default()?;
            }
            _ => self.object_statement()?,
        }
        Ok(true)
    }

    fn object_statement(&mut self) -> Parse<()> {
        let object = match self.object()? {
            Some(object) => Some(object),
            None => self.object_of_name()?,
        };
        if let Some(object) = object {
            return self.add_object(object);
        }
        let token = self.raw();
        match token.word() {
            Some(word) if is_part(word) => {
                let error = self.expected_here("an object or a statement");
                let hint = format!("`{word}` stands in the `{{` and `}}` of an object.");
                Err(Box::new(error.with_hint(hint)))
            }
            Some(word) if word.class() == Class::Statement => Err(self.not_built(word)),
            _ if token.is_mark('}') => Err(self.with_trace(
                Diagnostic::error(self.here_span(), "this `}` closes nothing")
                    .with_hint("Remove it, or look for a missing `{` above."),
            )),
            _ => Err(self.expected_here("an object or a statement")),
        }
    }

    fn add_object(&mut self, object: Arc<Object>) -> Parse<()> {
        let object = self.with_default_texture(object);
        self.count_leaves(&object)?;
        self.objects.push(object);
        Ok(())
    }

    /// An object without a texture takes the default one as it is at the object's end.
    pub(super) fn with_default_texture(&mut self, mut object: Arc<Object>) -> Arc<Object> {
        if object.texture.is_none() && !matches!(object.kind, crate::scene::Kind::Light { .. }) {
            let texture = Arc::clone(&self.default_texture);
            let attached = object.attach(texture);
            Arc::make_mut(&mut object).texture = Some(attached);
        }
        object
    }

    /// Changes the defaults for the objects that follow.
    fn set_default(&mut self, layer: Layer) {
        self.default_texture = Arc::new(Texture::from(layer.clone()));
        self.default_layer = layer;
    }

    fn end_of_scene(&mut self) -> Parse<()> {
        let Some(open) = self
            .frames
            .iter()
            .rev()
            .find(|frame| !matches!(frame.kind, Entered::Include { .. }))
        else {
            return Ok(());
        };
        let name = match open.kind {
            Entered::Macro { .. } => "a macro",
            Entered::While { .. } => "`#while`",
            Entered::For(_) => "`#for`",
            Entered::Switch { .. } => "`#switch`",
            _ => "`#if`",
        };
        let start = Self::unclosed_directive(&open.home);
        self.frames.clear();
        let message = format!("the scene ends inside {name}: its `#end` is missing");
        let error = match start {
            Some(start) => Diagnostic::error(start, message),
            None => *self.error_here(message),
        };
        Err(self.with_trace(error.with_hint("Write `#end` where it is to end.")))
    }

    /// `default { texture | pigment | normal | finish | camera ... }`, also as `#default`.
    pub(super) fn run_default(&mut self) -> Parse<()> {
        self.open_block()?;
        loop {
            if self.take_close()? {
                return Ok(());
            }
            match self.peek()?.word() {
                Some(Word::Texture) => {
                    let texture = self.texture_layers()?;
                    if let Some(layer) = texture.layers().last() {
                        self.set_default(layer.clone());
                    }
                }
                Some(Word::Camera) => {
                    self.pass();
                    let base = self.default_camera.clone();
                    self.default_camera = Camera::read(self, &base)?;
                }
                Some(word @ (Word::Pigment | Word::Normal | Word::Finish)) => {
                    let mut layer = self.default_layer.clone();
                    layer.read_part(word, self)?;
                    self.set_default(layer);
                }
                Some(Word::Radiosity) => self.importance()?,
                _ => {
                    return Err(self.expected_here(
                        "`texture`, `pigment`, `finish`, `camera` or `}` in `default`",
                    ));
                }
            }
        }
    }

    fn global_settings(&mut self) -> Parse<()> {
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

    fn global_setting(&mut self, word: Word) -> Parse<()> {
        let at = self.here_span();
        match word {
            Word::Radiosity => return self.radiosity(),
            Word::Photons => return self.photons(),
            Word::Subsurface => return self.subsurface(),
            Word::AssumedGamma => {
                self.pass();
                let gamma = self.gamma()?;
                if self.globals.assumed_gamma.is_some() {
                    self.warning(Diagnostic::warning(
                        at,
                        "`assumed_gamma` is set already; the first one counts",
                    ));
                } else {
                    self.globals.assumed_gamma = Some(gamma);
                }
            }
            Word::AdcBailout => {
                self.pass();
                self.globals.adc_bailout = self.float()?;
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
                self.globals.max_trace_level = level;
            }
            Word::AmbientLight => {
                self.pass();
                self.globals.ambient_light = self.color_value()?.rgb;
            }
            Word::NoiseGenerator => {
                self.pass();
                self.globals.noise_generator = read_noise_generator(self)?;
            }
            Word::NumberOfWaves => {
                self.pass();
                self.globals.number_of_waves = self.number_of_waves()?;
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
                self.globals.mm_per_unit = self.float()?;
            }
            Word::IridWavelength => {
                self.pass();
                self.globals.irid_wavelength = self.color_value()?.rgb;
            }
            Word::Charset => {
                self.pass();
                self.globals.charset = if self.take_word(Word::Utf8)? {
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

    fn gamma(&mut self) -> Parse<Gamma> {
        if self.take_word(Word::Srgb)? {
            return Ok(Gamma::Srgb);
        }
        let gamma = self.float()?;
        if gamma > 0.0 && gamma.is_finite() {
            Ok(Gamma::power(gamma))
        } else {
            Err(self.error_taken("`assumed_gamma` must be a positive number or `srgb`"))
        }
    }

    /// After an error: leaves the loops and macros it happened in and goes on behind the faulty statement.
    fn recover(&mut self) {
        let open_blocks = self.blocks.len();
        self.blocks.clear();
        self.unwind_loops_and_macros();
        if open_blocks > 0 && self.is_at_new_statement() {
            return;
        }
        if open_blocks == 0 && self.statement_start == self.start_here() {
            self.skip_token();
        }
        let mut depth = open_blocks;
        loop {
            let token = self.raw();
            match token.kind {
                Kind::End => return,
                Kind::More => {
                    self.read_on();
                    continue;
                }
                Kind::Directive if depth == 0 => return,
                Kind::Directive => {
                    self.skip_directive();
                    continue;
                }
                Kind::Mark if token.is_mark('{') => depth += 1,
                Kind::Mark if token.is_mark('}') => {
                    if depth <= 1 {
                        self.pass();
                        if self.raw().is_mark(';') {
                            self.pass();
                        }
                        // The next layer of a texture belongs to the one that is faulty.
                        if !self.raw().word().is_some_and(is_part) {
                            return;
                        }
                    }
                    depth = depth.saturating_sub(1);
                }
                _ if depth == 0 && self.is_at_new_statement() => return,
                _ => {}
            }
            self.pass();
        }
    }

    fn skip_token(&mut self) {
        if !matches!(self.raw().kind, Kind::End | Kind::More) {
            self.pass();
        }
    }

    /// Whether the token at hand begins a line and could begin a statement: the mark of a forgotten `}` above.
    fn is_at_new_statement(&self) -> bool {
        let token = self.raw();
        let begins = match token.word() {
            Some(word) if is_part(word) => false,
            Some(word) => matches!(word.class(), Class::Shape | Class::Statement | Class::Csg),
            None => token
                .symbol()
                .is_some_and(|symbol| matches!(self.scopes.get(symbol), Some(Value::Macro(_)))),
        };
        let text = self.sources.text(self.here.tokens.file);
        let before = &text.as_bytes()[..token.start as usize];
        begins && before.last().is_none_or(|&byte| byte == b'\n')
    }

    fn unwind_loops_and_macros(&mut self) {
        let floor = self
            .frames
            .iter()
            .rposition(|frame| matches!(frame.kind, Entered::Include { .. }))
            .map_or(0, |at| at + 1);
        let is_running = |kind: &Entered| !matches!(kind, Entered::If | Entered::Include { .. });
        // A macro may have been called from a file further out than the include it has itself entered.
        let outermost = self
            .frames
            .iter()
            .position(|frame| matches!(frame.kind, Entered::Macro { .. }));
        let from = outermost
            .or_else(|| (floor..self.frames.len()).find(|&at| is_running(&self.frames[at].kind)));
        let Some(from) = from else { return };
        let left: Vec<_> = self.frames.drain(from..).collect();
        for (order, frame) in left.into_iter().enumerate() {
            if matches!(frame.kind, Entered::Macro { .. } | Entered::Include { .. }) {
                self.scopes.leave();
            }
            if order > 0 {
                continue;
            }
            match frame.kind {
                Entered::Macro { back, .. } => self.here = back,
                _ => {
                    let end = if frame.end == u32::MAX {
                        frame.home.tokens.len() - 1
                    } else {
                        frame.end as usize + 1
                    };
                    self.here.tokens = frame.home;
                    self.here.at = end;
                }
            }
        }
    }

    /// Passes a directive while looking for the end of a faulty statement: whole groups at once.
    fn skip_directive(&mut self) {
        let token = self.raw();
        let directive = &self.here.tokens.directives[token.value as usize];
        let (word, end) = (directive.word, directive.end);
        match word {
            Some(Word::End) => {
                self.frames
                    .pop_if(|frame| !matches!(frame.kind, Entered::Include { .. }));
            }
            Some(word) if opens_group(word) && end != u32::MAX => self.here.at = end as usize,
            Some(Word::Else | Word::Elseif | Word::Case | Word::Range) if end != u32::MAX => {
                self.here.at = end as usize;
                return;
            }
            _ => {}
        }
        self.skip_token();
    }
}

/// Settings that old scenes write outside of `global_settings`.
fn is_old_setting(word: Word) -> bool {
    matches!(
        word,
        Word::AdcBailout
            | Word::AmbientLight
            | Word::AssumedGamma
            | Word::HfGray16
            | Word::IridWavelength
            | Word::MaxIntersections
            | Word::MaxTraceLevel
            | Word::NumberOfWaves
    )
}

/// Whether a word begins a part of objects, which stands nowhere else.
fn is_part(word: Word) -> bool {
    matches!(
        word,
        Word::Texture
            | Word::Pigment
            | Word::Finish
            | Word::Normal
            | Word::Interior
            | Word::InteriorTexture
            | Word::Material
    )
}
