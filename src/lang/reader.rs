//! The reader: all state of reading a scene.

use super::budget::Budget;
use super::diagnose::trial::Trials;
use super::dialect::Dialect;
use super::directive::open_file::Files;
use super::draft::SceneDraft;
use super::expr::array::ItemAhead;
use super::expr::streams::Streams;
use super::expr::value::{Number, Value};
use super::fast_path::literal::Memory;
use super::fast_path::literal_cache::{LiteralCache, LiteralReuse};
use super::fast_path::replay::cache::ReplayCache;
use super::fast_path::replay::recording::Recording;
use super::frame::{Frame, Position, Start};
use super::limits::MIN_PIECE;
use super::probe::Probe;
use super::report::Report;
use super::scope::Scopes;
use super::statement_state::{NameUsage, StatementState};
use super::token_cache::TokenCache;
use super::{LastLiterals, ReadEvent};
use crate::base::args::{Parse, Word};
use crate::base::options::ReadOptions;
use crate::base::source::{Code, Dependency, Diagnostic, FileId, Sources, Span};
use crate::base::version::{Novelty, is_for_3_8};
use crate::lang::syntax::{Kind, Names, Tokens, tokenize_around_data};
use crate::scene::Scene;
use crate::scene::texture::Texture;
use rustc_hash::{FxHashMap, FxHashSet};
use std::rc::Rc;
use std::sync::Arc;

/// The state of reading one scene.
pub(super) struct Reader<'a> {
    pub(super) sources: &'a mut Sources,
    pub(super) options: &'a ReadOptions,
    pub(super) probe: &'a mut dyn Probe,
    pub(super) names: Names,
    pub(super) dialect: Dialect,
    token_cache: Option<&'a mut TokenCache>,
    pub(super) scene: FileId,
    /// The tokens of all files read so far, the scene itself among them.
    tokenized: FxHashMap<FileId, Rc<Tokens>>,
    /// The position where reading goes on.
    pub(super) here: Position,
    /// The position of the last token taken.
    pub(super) last: Position,
    /// Number of tokens taken.
    pub(super) taken: u64,
    /// Number of directives run and macros called.
    pub(super) steps: u64,
    /// An item of an array that was read ahead.
    pub(super) item_ahead: Option<ItemAhead>,
    pub(super) frames: Vec<Frame>,
    pub(super) scopes: Scopes,
    /// The `{` of the elements being read.
    pub(super) blocks: Vec<Start>,
    pub(super) statement: StatementState,
    /// Size of the next piece of a data segment to tokenize, in bytes.
    pub(super) piece: usize,
    pub(super) replays: ReplayCache,
    /// The steps of the expression being read, if it can be recorded.
    pub(super) recording: Option<Recording>,
    pub(super) budget: Budget,
    /// True once a limit ended reading.
    pub(super) is_over: bool,
    pub(super) usage: NameUsage,
    pub(super) streams: Streams,
    /// Number of changes to anything that expressions depend on; the streams count their own.
    pub(super) changes: u64,
    /// The files opened by `#fopen`.
    pub(super) files: Files,
    pub(super) now: f64,
    /// The scene as read so far.
    pub(super) draft: SceneDraft,
    /// Reserved words and interned values of literal data.
    pub(super) memory: Memory,
    /// The findings so far.
    pub(super) report: Report<'a>,
    /// Trials of the changes that errors propose.
    pub(super) trials: Trials,
    /// As [`Reading::object_spans`].
    pub(super) object_spans: Vec<ObjectSpan>,
    /// Takes literals from the last reading.
    pub(super) reuse: Option<LiteralReuse<'a>>,
}

/// The result of reading a scene.
#[derive(Debug)]
pub struct Reading {
    /// The scene; `None` after an error.
    pub scene: Option<Scene>,
    /// Errors and warnings in the order in which they occurred.
    pub findings: Vec<Diagnostic>,
    /// The text of `#debug`, `#render` and `#statistics`.
    pub messages: String,
    /// Features that the scene uses and rendering does not support, where the quality is high enough for them: errors.
    pub undrawn: Vec<Diagnostic>,
    /// The files that were read or looked for: if one of them changes, appears or vanishes, so may the image.
    pub dependencies: Vec<Dependency>,
    /// True if the token cache holds more than before.
    pub has_new_tokens: bool,
    /// The statement of the camera that counts.
    pub camera: Option<Span>,
    /// The spans of the objects of the scene, in their order, if the options ask for them.
    pub object_spans: Vec<ObjectSpan>,
    /// Objects for the next reading, if those of the last one were given.
    pub literals: Option<LiteralCache>,
}

/// The span of consecutive objects of a scene, all from one statement.
#[derive(Clone, Debug)]
pub struct ObjectSpan {
    /// The index of the first of them.
    pub first: usize,
    /// The word or name that begins the statement.
    pub span: Span,
    /// The texture that objects without one take, unless the scene has set it.
    pub stock_texture: Option<Arc<Texture>>,
}

impl ObjectSpan {
    /// The span of an object of a scene, from its index.
    pub(crate) fn of(object_spans: &[ObjectSpan], index: usize) -> Option<&ObjectSpan> {
        let at = object_spans.partition_point(|one| one.first <= index);
        at.checked_sub(1).map(|at| &object_spans[at])
    }
}

const NO_MEMORY: &str = "this file needs more memory than there is";
/// Days from the start of 1970 to the start of 2000, which `now` counts from.
const DAYS_1970_TO_2000: f64 = 10957.0;

impl<'a> Reader<'a> {
    /// A reader at the start of a file.
    pub(super) fn new(
        scene: FileId,
        sources: &'a mut Sources,
        (token_cache, literals): (Option<&'a mut TokenCache>, Option<LastLiterals<'a>>),
        options: &'a ReadOptions,
        probe: &'a mut dyn Probe,
        listener: &'a mut dyn FnMut(ReadEvent<'_>),
    ) -> Result<Self, Vec<Diagnostic>> {
        let budget = Budget::new(options.memory);
        if !budget.has_memory_for(sources.text(scene)) {
            let span = Span::new(scene, 0, 0);
            return Err(vec![
                Diagnostic::error(span, NO_MEMORY).with_code(Code::Memory),
            ]);
        }
        sources.limit_bytes(budget.memory.headroom());
        let (mut names, known) = match &token_cache {
            Some(token_cache) => (token_cache.names.clone(), token_cache.tokens(scene)),
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
        // POV-Ray 3.8 knows its words from the first line on, whatever precedes the `#version`.
        let mut versions = [options.version, tokens.first_version()].into_iter();
        let is_of_3_8 = versions.any(|version| version.is_some_and(is_for_3_8));
        sources.search_paths_of_3_8(is_of_3_8);
        let mut draft = SceneDraft::new(options);
        draft.globals.is_for_3_8 = is_of_3_8;
        let mut reader = Reader {
            sources,
            options,
            probe,
            dialect: Dialect::new(is_of_3_8, &names),
            names,
            token_cache,
            scene,
            tokenized: FxHashMap::from_iter([(scene, Rc::clone(&tokens))]),
            last: Position {
                tokens: Rc::clone(&tokens),
                at: 0,
            },
            frames: Vec::new(),
            scopes: Scopes::default(),
            blocks: Vec::new(),
            statement: StatementState::new(Start::of(&tokens, 0)),
            here: Position { tokens, at: 0 },
            taken: 0,
            steps: 0,
            item_ahead: None,
            piece: MIN_PIECE,
            replays: ReplayCache::default(),
            recording: None,
            budget,
            is_over: false,
            usage: NameUsage::default(),
            streams: Streams::default(),
            changes: 0,
            files: Files::default(),
            now: days_since_2000(),
            draft,
            memory: Memory::default(),
            report: Report::new(listener),
            trials: Trials::default(),
            object_spans: Vec::new(),
            reuse: None,
        };
        let text = reader.sources.text(scene);
        reader.reuse = literals.map(|last| LiteralReuse::new(scene, text, last));
        reader.scopes.qualify(reader.names.qualified());
        reader.declare_options();
        Ok(reader)
    }

    /// Declares the identifiers that exist before the first line.
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
        let text = self.sources.name(self.here.tokens.file);
        self.scopes.declare(name, Value::Text(text.into()));
    }

    /// The tokens of a file, made once.
    pub(super) fn tokens_of(&mut self, file: FileId) -> Parse<Rc<Tokens>> {
        if let Some(tokens) = self.tokenized.get(&file) {
            return Ok(Rc::clone(tokens));
        }
        if !self.budget.has_memory_for(self.sources.text(file)) {
            self.is_over = true;
            return Err(Box::new(
                self.error_taken(NO_MEMORY).with_code(Code::Memory),
            ));
        }
        let known = self.token_cache.as_ref();
        if let Some(tokens) = known.and_then(|token_cache| token_cache.tokens(file)) {
            self.tokenized.insert(file, Rc::clone(&tokens));
            return Ok(tokens);
        }
        match tokenize_around_data(file, self.sources.text(file), &mut self.names) {
            Ok(tokens) => {
                let tokens = Rc::new(tokens);
                self.scopes.qualify(self.names.qualified());
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

    /// The tokens of a file that has been read.
    pub(super) fn tokens_read(&self, file: FileId) -> Option<&Rc<Tokens>> {
        let current = [&self.here.tokens, &self.last.tokens];
        let is_it = |tokens: &&Rc<Tokens>| tokens.file == file;
        let current = current.into_iter().find(is_it);
        current.or_else(|| self.tokenized.get(&file))
    }

    /// The silent error of using something whose error was reported before.
    pub(super) fn consequence(&self) -> Box<Diagnostic> {
        Box::new(Diagnostic::error(None, ""))
    }

    /// The error of using a value that could not be read.
    pub(super) fn consequence_of(&self, why: Option<&Diagnostic>) -> Box<Diagnostic> {
        why.map_or_else(|| self.consequence(), |why| Box::new(why.clone()))
    }

    /// Records a finding; consequences of earlier ones are dropped.
    pub(super) fn record(&mut self, finding: Diagnostic) {
        let finding = match self.is_about_declared_word(&finding) {
            true => *self.consequence(),
            false => self.tried(finding),
        };
        self.report.record(finding, self.sources);
    }

    /// True for an error at or behind a reserved word that the scene declares, which is an error of its own.
    fn is_about_declared_word(&self, error: &Diagnostic) -> bool {
        let Some(span) = error.span.filter(|_| !self.usage.declared_words.is_empty()) else {
            return false;
        };
        let (before, last) = self.word_before(span);
        // The axis of a transform is a mistake of its own.
        if ["rotate", "scale", "translate"]
            .iter()
            .any(|word| before.trim_end().ends_with(word))
        {
            return false;
        }
        self.usage.declared_words.iter().any(|&declared| {
            let word = self.source_text(declared);
            declared != span && (self.source_text(span) == word || last == word)
        })
    }

    /// Records an error after which its statement goes on, once for each span.
    pub(super) fn record_in_passing(&mut self, error: Diagnostic) {
        if !self.report.knows(&error) {
            self.record(error);
        }
    }

    /// Records a warning, once for each span.
    pub(super) fn warning(&mut self, warning: Diagnostic) {
        if !self
            .sources
            .allows(self.scene, &warning, &self.options.allowed_lints)
        {
            self.report.warning(warning, self.sources);
        }
    }

    /// The result, at the end of the scene.
    pub(super) fn finish(mut self) -> Reading {
        self.note_unsupported();
        if self.report.errors == 0 {
            self.close_files();
        }
        self.warn_of_missing_parts();
        if self.options.lints && self.report.errors == 0 {
            self.warn_of_unused();
        }
        for word in self.dialect.used() {
            self.draft.note_novelty(Novelty::Word(word));
        }
        let has_new_tokens = self.token_cache.take().is_some_and(|token_cache| {
            let names = std::mem::take(&mut self.names);
            token_cache.update(names, &self.tokenized, self.sources, self.scene)
        });
        Reading {
            camera: self.draft.camera.as_ref().map(|(_, [_, all])| *all),
            scene: (self.report.errors == 0).then(|| self.draft.into_scene()),
            findings: self.report.findings,
            messages: self.report.messages,
            undrawn: self.report.undrawn,
            dependencies: self.sources.dependencies().to_vec(),
            has_new_tokens,
            object_spans: self.object_spans,
            literals: self.reuse.map(LiteralReuse::finish),
        }
    }
}

impl Reader<'_> {
    /// Warns of what is missing from the scene as a whole. Only where it is certain: a black image may be intended
    /// without a camera, and ambient colours may give light.
    fn warn_of_missing_parts(&mut self) {
        if self.report.errors > 0 {
            return;
        }
        if self.draft.objects.is_empty() {
            self.warning(
                Diagnostic::warning(None, "no objects in scene").with_code(Code::NoObjects),
            );
            return;
        }
        if self.draft.camera.is_none() && self.draft.has_stock_camera() {
            self.warning(
                Diagnostic::warning(
                    None,
                    "no camera: using one at the origin that looks along z",
                )
                .with_code(Code::NoCamera)
                .with_hint("Write `camera { location <0, 1, -5> look_at 0 }`."),
            );
        }
        if !self.draft.has_light && !self.may_glow() {
            self.warning(
                Diagnostic::warning(
                    None,
                    "no light source: only the default ambient light is seen",
                )
                .with_code(Code::NoLight)
                .with_hint("Write `light_source { <4, 6, -8>, rgb 1 }`."),
            );
        }
    }

    /// Warns of textures, parts of textures and macros that the scene declares and no file mentions again.
    fn warn_of_unused(&mut self) {
        let Some(scene) = self.tokenized.get(&self.scene).cloned() else {
            return;
        };
        let is_name_of = |tokens: &Tokens, at: usize| {
            let before = at.checked_sub(1).map(|before| tokens.tokens[before]);
            before.is_some_and(|token| {
                token.kind == Kind::Directive
                    && matches!(
                        tokens.directives[token.value as usize].word,
                        Some(Word::Declare | Word::Local | Word::Macro)
                    )
            })
        };
        let mut used = FxHashSet::default();
        for tokens in self.tokenized.values() {
            for (at, token) in tokens.tokens.iter().enumerate() {
                if let Some(name) = token.symbol().filter(|_| !is_name_of(tokens, at)) {
                    used.insert(name);
                }
            }
        }
        for (at, token) in scene.tokens.iter().enumerate() {
            let name = token.symbol().filter(|_| is_name_of(&scene, at));
            let Some(name) = name.filter(|name| !used.contains(name)) else {
                continue;
            };
            let (code, what) = match self.scopes.get(name) {
                Some(Value::Macro(_)) => (Code::UnusedMacro, "macro"),
                Some(Value::Element(element))
                    if matches!(element.name, "texture" | "pigment" | "finish" | "normal") =>
                {
                    (Code::UnusedTexture, element.name)
                }
                _ => continue,
            };
            let message = format!("the {what} `{}` is not used", self.names.spelling(name));
            let warning = Diagnostic::warning(scene.span(at), message).with_code(code);
            self.warning(warning.with_hint("Remove it, or use it."));
        }
    }

    /// True if anything but lights may be bright: an include file may declare it, or words for emission occur.
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
