//! The reader: everything that reading a scene keeps.

use super::Heard;
use super::budget::Budget;
use super::cursor::{Declaring, Frame, Place, Start};
use super::directive::declare::Deprecation;
use super::directive::files::Files;
use super::expr::streams::Streams;
use super::expr::value::{Number, Value};
use super::fast_path::literal::Memory;
use super::fast_path::replay::{Recording, ReplayCache};
use super::fast_path::stretch::SHORTEST_PIECE;
use super::limits;
use super::probe::Probe;
use super::scope::Scopes;
use super::token_cache::Lexicon;
use crate::base::args::{Parse, Word};
use crate::base::color::Color;
use crate::base::options::ReadOptions;
use crate::base::source::{Code, Dependency, Diagnostic, FileId, Severity, Sources, Span};
use crate::lang::syntax::{Names, Symbol, Tokens, tokenize_around_data};
use crate::scene::atmosphere::Atmosphere;
use crate::scene::camera::Camera;
use crate::scene::texture::{Layer, Texture};
use crate::scene::{Background, Globals, Objects, Scene};
use rustc_hash::{FxHashMap, FxHashSet};
use std::rc::Rc;
use std::sync::Arc;

/// The state of reading one scene.
pub(super) struct Reader<'a> {
    pub(super) sources: &'a mut Sources,
    pub(super) options: &'a ReadOptions,
    pub(super) probe: &'a mut dyn Probe,
    listener: &'a mut dyn FnMut(Heard<'_>),
    pub(super) names: Names,
    lexicon: Option<&'a mut Lexicon>,
    scene: FileId,
    /// The tokens of all files read so far, the scene's own among them.
    tokenized: FxHashMap<FileId, Rc<Tokens>>,
    /// Where reading goes on.
    pub(super) here: Place,
    /// The token last taken.
    pub(super) last: Place,
    pub(super) frames: Vec<Frame>,
    pub(super) scopes: Scopes,
    /// The `{` of the elements being read.
    pub(super) blocks: Vec<Start>,
    /// Where the statement being read began.
    pub(super) statement_start: Start,
    /// How deep the expression being read is nested.
    pub(super) depth: usize,
    /// How many directives, conditions, strings and macro arguments are being read inside each other.
    pub(super) nesting: usize,
    /// The `#declare` whose value is being read.
    pub(super) declaring: Option<Declaring>,
    /// True if the number of a `#version` is being read.
    pub(super) is_in_version: bool,
    /// Whether a directive within the statement being read failed.
    pub(super) has_faulty_directive: bool,
    /// Where the number that is being declared ended, if a directive follows it: there a `;` is missing. With the place
    /// of the directive and how many frames were open.
    pub(super) without_semicolon: Option<(Span, Place, usize)>,
    /// Of how many bytes of a stretch of data tokens are made next.
    pub(super) piece: usize,
    pub(super) replays: ReplayCache,
    /// The steps of the expression being read, if they can be kept.
    pub(super) recording: Option<Recording>,
    pub(super) budget: Budget,
    /// Whether a limit was met behind which nothing more is read.
    pub(super) is_over: bool,
    /// Names already told to be undeclared.
    pub(super) undeclared: FxHashSet<Symbol>,
    /// Whether an include file was not found, so that any name may be one of its.
    pub(super) lacks_file: bool,
    /// Names whose use is to be warned of.
    pub(super) deprecated: FxHashMap<Symbol, Deprecation>,
    pub(super) streams: Streams,
    /// How often something that expressions depend on may have changed; the streams count their own changes.
    pub(super) changes: u64,
    /// What `#fopen` opened.
    pub(super) files: Files,
    pub(super) version: f64,
    pub(super) has_version: bool,
    pub(super) now: f64,
    pub(super) default_layer: Layer,
    pub(super) default_texture: Arc<Texture>,
    pub(super) default_camera: Camera,
    pub(super) camera: Option<(Camera, Span)>,
    /// Whether a light source has been read.
    pub(super) has_light: bool,
    pub(super) background: Option<Color>,
    pub(super) atmosphere: Atmosphere,
    pub(super) globals: Globals,
    pub(super) objects: Objects,
    /// Words of data.
    pub(super) memory: Memory,
    /// What drawing cannot do yet.
    pub(super) undrawn: Vec<Diagnostic>,
    messages: String,
    findings: Vec<Diagnostic>,
    pub(super) errors: usize,
}

/// What reading a scene gives.
#[derive(Debug)]
pub struct Reading {
    /// The scene; `None` if anything in it is faulty.
    pub scene: Option<Scene>,
    /// Errors and warnings in the order in which they were found.
    pub findings: Vec<Diagnostic>,
    /// What `#debug`, `#render` and `#statistics` write.
    pub messages: String,
    /// What the scene asks for and drawing cannot do yet, where the quality is high enough for it: errors.
    pub undrawn: Vec<Diagnostic>,
    /// The files that were read or asked for: if one of them changes, appears or goes, so may the picture.
    pub dependencies: Vec<Dependency>,
    /// Whether the lexicon holds more than before.
    pub has_learnt: bool,
}

const NO_ROOM: &str = "this file needs more memory than there is";
/// The effective version of scenes without any `#version` (facts 3.1).
const VERSION_OF_SCENES_WITHOUT: f64 = 3.62;
/// Days from the start of 1970 to the start of 2000, which `now` counts from.
const DAYS_1970_TO_2000: f64 = 10957.0;

impl<'a> Reader<'a> {
    /// The version whose rules hold for light and pictures here.
    pub(super) fn version_of_rules(&self) -> f64 {
        if self.has_version {
            self.version
        } else {
            VERSION_OF_SCENES_WITHOUT
        }
    }

    /// A reader at the start of a file.
    pub(super) fn new(
        scene: FileId,
        sources: &'a mut Sources,
        lexicon: Option<&'a mut Lexicon>,
        options: &'a ReadOptions,
        probe: &'a mut dyn Probe,
        listener: &'a mut dyn FnMut(Heard<'_>),
    ) -> Result<Self, Vec<Diagnostic>> {
        let budget = Budget::new(options.memory);
        if !budget.has_room_for(sources.text(scene)) {
            let span = Span::new(scene, 0, 0);
            return Err(vec![
                Diagnostic::error(span, NO_ROOM).with_code(Code::Memory),
            ]);
        }
        let (mut names, known) = match &lexicon {
            Some(lexicon) => (lexicon.names.clone(), lexicon.tokens(scene)),
            None => (Names::new(), None),
        };
        let tokens = match known {
            Some(tokens) => tokens,
            None => Rc::new(tokenize_around_data(
                scene,
                sources.text(scene),
                &mut names,
            )?),
        };
        let mut reader = Reader {
            sources,
            options,
            probe,
            listener,
            names,
            lexicon,
            scene,
            tokenized: FxHashMap::from_iter([(scene, Rc::clone(&tokens))]),
            last: Place {
                tokens: Rc::clone(&tokens),
                at: 0,
            },
            frames: Vec::new(),
            scopes: Scopes::default(),
            blocks: Vec::new(),
            statement_start: Start::of(&tokens, 0),
            here: Place { tokens, at: 0 },
            depth: 0,
            nesting: 0,
            declaring: None,
            is_in_version: false,
            has_faulty_directive: false,
            without_semicolon: None,
            piece: SHORTEST_PIECE,
            replays: ReplayCache::default(),
            recording: None,
            budget,
            is_over: false,
            undeclared: FxHashSet::default(),
            lacks_file: false,
            deprecated: FxHashMap::default(),
            streams: Streams::default(),
            changes: 0,
            files: Files::default(),
            version: options.version.unwrap_or(3.7),
            has_version: options.version.is_some(),
            now: days_since_2000(),
            default_layer: Layer::default(),
            default_texture: Arc::new(Texture::from(Layer::default())),
            default_camera: Camera::default(),
            camera: None,
            has_light: false,
            background: None,
            atmosphere: Atmosphere::default(),
            globals: Globals::default(),
            objects: Objects::default(),
            memory: Memory::default(),
            messages: String::new(),
            undrawn: Vec::new(),
            findings: Vec::new(),
            errors: 0,
        };
        reader.declare_options();
        Ok(reader)
    }

    /// The identifiers that exist before the first line.
    fn declare_options(&mut self) {
        let o = self.options;
        let known = [
            ("image_width", f64::from(o.width)),
            ("image_height", f64::from(o.height)),
            ("clock_delta", o.clock_delta),
            ("frame_number", f64::from(o.frame_number)),
            ("initial_frame", f64::from(o.initial_frame)),
            ("final_frame", f64::from(o.final_frame)),
            ("initial_clock", o.initial_clock),
            ("final_clock", o.final_clock),
        ];
        let given = o
            .declares
            .iter()
            .map(|(name, value)| (name.as_str(), *value));
        for (name, value) in known.into_iter().chain(given) {
            let symbol = self.names.intern(name);
            self.scopes
                .declare(symbol, Value::Number(Number::float(value)));
        }
        let name = self.names.intern("input_file_name");
        let text: Rc<str> = self.sources.name(self.here.tokens.file).into();
        self.scopes.declare(name, Value::Text(text));
    }

    /// The tokens of a file, made once.
    pub(super) fn tokens_of(&mut self, file: FileId) -> Parse<Rc<Tokens>> {
        if let Some(tokens) = self.tokenized.get(&file) {
            return Ok(Rc::clone(tokens));
        }
        if !self.budget.has_room_for(self.sources.text(file)) {
            self.is_over = true;
            return Err(Box::new(self.error_taken(NO_ROOM).with_code(Code::Memory)));
        }
        let known = self.lexicon.as_ref();
        if let Some(tokens) = known.and_then(|lexicon| lexicon.tokens(file)) {
            self.tokenized.insert(file, Rc::clone(&tokens));
            return Ok(tokens);
        }
        match tokenize_around_data(file, self.sources.text(file), &mut self.names) {
            Ok(tokens) => {
                let tokens = Rc::new(tokens);
                self.tokenized.insert(file, Rc::clone(&tokens));
                Ok(tokens)
            }
            Err(mut errors) => {
                let last = errors.pop().map(Box::new);
                for error in errors {
                    self.record(error);
                }
                Err(last.unwrap_or_else(|| self.consequence()))
            }
        }
    }

    /// The silent error of using something that failed before and was reported there.
    pub(super) fn consequence(&self) -> Box<Diagnostic> {
        Box::new(Diagnostic::error(None, ""))
    }

    /// The error of using a value that could not be read.
    pub(super) fn consequence_of(&self, why: Option<&Diagnostic>) -> Box<Diagnostic> {
        why.map_or_else(|| self.consequence(), |why| Box::new(why.clone()))
    }

    /// Keeps a finding; consequences of earlier ones are not told.
    pub(super) fn record(&mut self, finding: Diagnostic) {
        if finding.severity == Severity::Error {
            self.errors += 1;
        }
        if !finding.message.is_empty() && !self.findings.contains(&finding) {
            self.keep(finding);
        }
    }

    /// Keeps a warning, once for each place.
    pub(super) fn warning(&mut self, warning: Diagnostic) {
        let is_known =
            |known: &Diagnostic| known.span == warning.span && known.message == warning.message;
        if self.findings.len() < limits::FINDINGS && !self.findings.iter().any(is_known) {
            self.keep(warning);
        }
    }

    fn keep(&mut self, finding: Diagnostic) {
        (self.listener)(Heard::Found(&finding, self.sources));
        self.findings.push(finding);
    }

    /// Writes text of `#debug` and the like; gives how much was written so far, in bytes.
    pub(super) fn say(&mut self, text: &str) -> usize {
        (self.listener)(Heard::Said(text));
        self.messages.push_str(text);
        self.messages.len()
    }

    /// The scene that was read.
    pub(super) fn finish(mut self) -> Reading {
        self.note_missing();
        if self.errors == 0 {
            self.close_files();
        }
        self.doubt_the_whole();
        let has_learnt = self.lexicon.take().is_some_and(|lexicon| {
            let names = std::mem::take(&mut self.names);
            lexicon.learn(names, &self.tokenized, self.sources, self.scene)
        });
        let version = self.version_of_rules();
        let scene = (self.errors == 0).then(|| Scene {
            camera: self
                .camera
                .map_or(self.default_camera, |(camera, _)| camera),
            objects: self.objects,
            background: Background {
                color: self.background,
            },
            atmosphere: self.atmosphere,
            globals: self.globals,
            version,
        });
        Reading {
            scene,
            findings: self.findings,
            messages: self.messages,
            undrawn: self.undrawn,
            dependencies: self.sources.dependencies().to_vec(),
            has_learnt,
        }
    }
}

impl Reader<'_> {
    /// What is missing from the scene as a whole. Only what is certain: a picture that is black by intention has no
    /// camera of its own, and a light may come of ambient colours.
    fn doubt_the_whole(&mut self) {
        if self.errors > 0 {
            return;
        }
        if self.objects.is_empty() {
            self.warning(Diagnostic::warning(None, "no objects in scene"));
            return;
        }
        if self.camera.is_none() && self.default_camera == Camera::default() {
            self.warning(
                Diagnostic::warning(None, "no camera: it stands at the origin and looks along z")
                    .with_hint("Write `camera { location <0, 1, -5> look_at 0 }`."),
            );
        }
        if !self.has_light && !self.may_glow() {
            self.warning(
                Diagnostic::warning(
                    None,
                    "no light source: only the default ambient light is seen",
                )
                .with_hint("Write `light_source { <4, 6, -8>, rgb 1 }`."),
            );
        }
    }

    /// Whether anything but lights may be bright: what an include file declares, and words for light of its own.
    fn may_glow(&self) -> bool {
        let glows = |word: Word| {
            matches!(
                word,
                Word::Ambient | Word::Emission | Word::AmbientLight | Word::Radiosity | Word::Media
            )
        };
        let tokens = &self.here.tokens.tokens;
        self.tokenized.len() > 1 || tokens.iter().any(|token| token.word().is_some_and(glows))
    }
}

fn days_since_2000() -> f64 {
    let since_1970 = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .unwrap_or_default();
    since_1970.as_secs_f64() / 86400.0 - DAYS_1970_TO_2000
}
