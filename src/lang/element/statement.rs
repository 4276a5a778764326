//! The statements of a scene file, and error recovery between them.

use super::settings::is_old_setting;
use crate::base::args::{Args, Parse, Word};
use crate::base::color::Color;
use crate::base::source::{Code, Diagnostic};
use crate::lang::diagnose::recover::is_part;
use crate::lang::fast_path::common_object::Read;
use crate::lang::fast_path::literal_cache::CachedObjects;
use crate::lang::fast_path::parallel::{Defaults, LiteralSink};
use crate::lang::frame::Entered;
use crate::lang::reader::{ObjectSpan, Reader};
use crate::lang::syntax::Kind;
use crate::scene::atmosphere::{Fog, Rainbow, SkySphere};
use crate::scene::camera::Camera;
use crate::scene::interior::Media;
use crate::scene::texture::{Finish, Layer, Texture};
use crate::scene::{ColorOrTexture, Entry, Object, PlainObject};
use std::rc::Rc;
use std::sync::Arc;

/// Collects the objects of the scene itself.
struct TopLevel;

impl LiteralSink for TopLevel {
    type Item = Entry;

    fn item(read: Read, defaults: &Defaults<'_>) -> Entry {
        match read {
            Read::Object(object) => {
                Entry::from(Arc::new(object).with_default_texture(defaults.texture))
            }
            Read::Shape { shape, color } => {
                let look = look(color, &defaults.finish, defaults.texture);
                Entry::from(PlainObject { shape, look })
            }
        }
    }

    fn to_cached(objects: Vec<Entry>) -> CachedObjects {
        CachedObjects::Entries(objects.into())
    }

    fn take(&mut self, reader: &mut Reader<'_>, piece: Vec<Entry>) -> Parse<()> {
        count(reader, &piece)?;
        reader.draft.objects.append(piece);
        Ok(())
    }

    fn suits(objects: &CachedObjects) -> bool {
        matches!(objects, CachedObjects::Entries(_))
    }

    fn take_cached(&mut self, reader: &mut Reader<'_>, objects: &CachedObjects) -> Parse<()> {
        let CachedObjects::Entries(entries) = objects else {
            return Ok(());
        };
        match entries.has_whole() {
            true => count(reader, entries)?,
            false => reader.count_single_shapes(entries.len() as u64)?,
        }
        reader.draft.objects.append_shared(entries);
        Ok(())
    }
}

/// Counts the primitives of objects.
fn count(reader: &mut Reader<'_>, entries: &[Entry]) -> Parse<()> {
    let mut plain = 0;
    for entry in entries {
        match entry.whole() {
            Some(object) => reader.count_leaves(object)?,
            None => plain += 1,
        }
    }
    reader.count_single_shapes(plain)
}

/// The appearance of a shape with a colour of its own or the default texture.
fn look(color: Option<Color>, finish: &Arc<Finish>, texture: &Arc<Texture>) -> ColorOrTexture {
    match color {
        Some(color) => ColorOrTexture::Color(color, Arc::clone(finish)),
        None => ColorOrTexture::Texture(Arc::clone(texture)),
    }
}

impl Reader<'_> {
    /// Reads the whole scene and records its findings.
    pub(crate) fn statements(&mut self) {
        loop {
            match self.statement() {
                Ok(true) if self.has_tried() => return,
                Ok(true) if self.options.stop.is_cancelled() => {
                    let error = self.stopped(self.start_taken());
                    self.record(*error);
                    return;
                }
                Ok(true) => {}
                Ok(false) => return,
                Err(error) => {
                    let mut is_unbuilt =
                        error.code == Some(Code::NotBuilt) && !self.statement.has_faulty_directive;
                    self.report(*error);
                    if is_unbuilt && let Err(error) = self.skip_blocks(0) {
                        is_unbuilt = false;
                        self.report(*error);
                    }
                    if self.is_over || self.has_tried() {
                        return;
                    }
                    if self.report.is_full() {
                        let message =
                            format!("nothing is read after {} errors", self.report.reported);
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

    fn report(&mut self, error: Diagnostic) {
        let unended = self.statement.without_semicolon.take();
        if let Some((last, ..)) = unended.filter(|_| error.message.is_empty()) {
            // The missing value would be there if the declaration had ended.
            self.report_missing_semicolon(last);
        }
        let error = self.with_trace(error);
        self.record(*error);
    }

    /// One statement; false at the end of the scene.
    fn statement(&mut self) -> Parse<bool> {
        self.blocks.clear();
        self.statement.depth = 0;
        self.statement.has_faulty_directive = false;
        if !self.options.locates_objects() {
            // Spans of objects are noted one by one.
            self.take_literal_objects(&mut TopLevel)?;
        }
        let token = self.peek()?;
        self.statement.start = self.start_here();
        if token.kind == Kind::End {
            return self.end_of_scene().map(|()| false);
        }
        match token.word() {
            Some(Word::Camera) => {
                self.pass();
                let at = self.taken_span();
                let base = self.draft.default_camera.clone();
                let camera = Camera::read(self, &base)?;
                let spans = [at, at.to(self.taken_span())];
                if let Some((_, [first, _])) = self.draft.camera.replace((camera, spans)) {
                    self.warning(
                        Diagnostic::warning(at, "more than one camera; the last one counts")
                            .with_label(first, "this one does not count"),
                    );
                }
            }
            Some(Word::Background) => {
                self.pass();
                self.open_block()?;
                if self.peek()?.word() == Some(Word::Pigment) {
                    return Err(self.expected_here("a colour in `background`"));
                }
                self.draft.background = Some(self.color_value()?);
                Args::close(self)?;
            }
            Some(Word::Fog) => {
                self.pass();
                let fog = Fog::read(self)?;
                self.draft.atmosphere.fogs.push(fog);
            }
            Some(Word::Rainbow) => {
                self.pass();
                let rainbow = Rainbow::read(self)?;
                self.draft.atmosphere.rainbows.push(rainbow);
            }
            Some(Word::Media) => {
                self.pass();
                let media = Media::read(self)?;
                self.draft.atmosphere.media.push(media);
            }
            Some(Word::SkySphere) => {
                self.pass();
                let sky = SkySphere::read(self)?;
                if self
                    .draft
                    .atmosphere
                    .sky_sphere
                    .replace(Arc::new(sky))
                    .is_some()
                {
                    self.warning(Diagnostic::warning(
                        self.taken_span(),
                        "more than one `sky_sphere`; the last one counts",
                    ));
                }
            }
            Some(Word::GlobalSettings) => self.global_settings()?,
            Some(word) if is_old_setting(word) => {
                let message = format!("`{word}` belongs in `global_settings`");
                let warning = Diagnostic::warning(self.here_span(), message);
                self.warning(self.setting_in_block(word).added_to(warning));
                self.global_setting(word)?;
            }
            Some(Word::Default) => {
                self.pass();
                self.run_default()?;
            }
            Some(Word::Version) => {
                let message = "`version` without `#`; read as `#version`";
                self.warning(Diagnostic::warning(self.here_span(), message));
                self.pass();
                self.run_version()?;
            }
            _ => {
                if self.options.locates_objects() {
                    self.object_spans.push(ObjectSpan {
                        first: self.draft.objects.len(),
                        span: self.here_span(),
                        stock_texture: (!self.draft.has_default)
                            .then(|| Arc::clone(&self.draft.default_texture)),
                    });
                }
                self.object_statement()?;
            }
        }
        Ok(true)
    }

    fn object_statement(&mut self) -> Parse<()> {
        if let Some((sphere, color)) = self.replay_sphere()? {
            let look = self.look_of(color);
            self.count_leaf()?;
            self.draft.objects.push_sphere(sphere, look);
            return Ok(());
        }
        if let Some(read) = self.replay_object()? {
            return self.add_read(read);
        }
        if self.raw_ahead(1).is_mark('[') && self.assignment().is_some() {
            return Err(self.expected_here("an object or a statement"));
        }
        let object = match self.raw().word() {
            Some(word) => self.object_of_tokens(word)?,
            None => self.object_of_name()?,
        };
        if let Some(object) = object {
            return self.add_object(object);
        }
        let token = self.raw();
        if self.is_rest_of_faulty() {
            return Err(self.consequence());
        }
        match token.word() {
            Some(word) if is_part(word) => {
                let error = self.expected_here("an object or a statement");
                if !error.hints.is_empty() {
                    return Err(error);
                }
                let hint = format!("`{word}` belongs in the `{{` and `}}` of an object.");
                Err(Box::new(error.with_hint(hint)))
            }
            _ if token.is_mark('}') => Err(self.with_trace(
                Diagnostic::error(self.here_span(), "this `}` closes nothing")
                    .with_hint("Remove it, or look for a missing `{` above."),
            )),
            _ => {
                let error = self.expected_here("an object or a statement");
                self.note_name_of_foreign_declaration();
                Err(error)
            }
        }
    }

    fn add_read(&mut self, read: Read) -> Parse<()> {
        let (shape, color) = match read {
            Read::Object(object) => return self.add_object(Arc::new(object)),
            Read::Shape { shape, color } => (shape, color),
        };
        let look = self.look_of(color);
        self.count_leaf()?;
        self.draft.objects.push_plain(PlainObject { shape, look });
        Ok(())
    }

    /// The appearance of a shape with a colour of its own or the default texture.
    fn look_of(&self, color: Option<Color>) -> ColorOrTexture {
        look(
            color,
            &self.draft.default_layer.finish,
            &self.draft.default_texture,
        )
    }

    fn add_object(&mut self, object: Arc<Object>) -> Parse<()> {
        let object = self.with_default_texture(object);
        self.count_leaves(&object)?;
        self.draft.objects.push(object);
        Ok(())
    }

    /// An object without a texture takes the default one at the end of the object.
    pub(crate) fn with_default_texture(&self, object: Arc<Object>) -> Arc<Object> {
        object.with_default_texture(&self.draft.default_texture)
    }

    /// Changes the defaults for the objects that follow.
    fn set_default(&mut self, layer: Layer) {
        let layer = layer.into_default();
        self.draft.default_texture = Arc::new(Texture::from(layer.clone()));
        self.draft.default_layer = layer;
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
        let home = Rc::clone(&open.home);
        let start = Self::unclosed_directive(&home);
        self.frames.clear();
        let message = format!("the scene ends inside {name}: its `#end` is missing");
        let error = match start {
            Some(start) => Diagnostic::error(start, message),
            None => *self.error_here(message),
        };
        let error = self.with_swallowed_directive(&home, error);
        Err(self.with_trace(error.with_hint("Write `#end` where it is to end.")))
    }

    /// `default { texture | pigment | normal | finish | camera ... }`, also as `#default`.
    pub(crate) fn run_default(&mut self) -> Parse<()> {
        self.draft.has_default = true;
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
                    let base = self.draft.default_camera.clone();
                    self.draft.default_camera = Camera::read(self, &base)?;
                }
                Some(word @ (Word::Pigment | Word::Normal | Word::Finish)) => {
                    let mut layer = self.draft.default_layer.clone();
                    layer.read_part(word, self)?;
                    self.set_default(layer);
                }
                Some(Word::Radiosity) => {
                    let usual = self.draft.globals.importance;
                    self.draft.globals.importance = self.importance()?.unwrap_or(usual);
                }
                _ => {
                    return Err(self.expected_here(
                        "`texture`, `pigment`, `finish`, `camera` or `}` in `default`",
                    ));
                }
            }
        }
    }
}
