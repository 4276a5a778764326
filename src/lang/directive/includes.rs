//! `#include`, `#version`, and the messages of a scene: `#debug` and the like.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Code, Diagnostic};
use crate::base::version::{has_defaults_of_3_8, is_for_3_8};
use crate::lang::expr::FIRST_WITH_OPERATORS;
use crate::lang::frame::{Entered, Position};
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;
use std::rc::Rc;

/// The newest language version.
const NEWEST: f64 = 3.8;

impl Reader<'_> {
    pub(crate) fn run_include(&mut self) -> Parse<()> {
        let name = self.file_name()?;
        let from = self.taken_span();
        self.publish_files(from)?;
        let depth = self
            .frames
            .iter()
            .filter(|frame| matches!(frame.kind, Entered::Include { .. }))
            .count();
        if depth >= limits::INCLUDES {
            return Err(self.with_trace(
                Diagnostic::error(
                    from,
                    format!(
                        "files include each other more than {} deep",
                        limits::INCLUDES
                    ),
                )
                .with_hint("A file that includes itself needs an `#ifndef` around the `#include`."),
            ));
        }
        let file = match self.sources.find_include(&name, from.file) {
            Ok(file) => file,
            Err(mut error) => {
                self.usage.lacks_file = true;
                error.span = Some(from);
                return Err(self.with_trace(*error));
            }
        };
        self.enter_file(file, from)
    }

    /// Enters the file that the command line includes before the scene.
    pub(crate) fn enter_header(&mut self) {
        let Some(header) = &self.options.include_header else {
            return;
        };
        let from = self.here_span();
        let loaded = match self.options.is_header_by_user {
            true => self.sources.load_file(header),
            false => self.sources.load_regular(header),
        };
        let entered = loaded.and_then(|file| self.enter_file(file, from));
        if let Err(error) = entered {
            self.record(*error);
        }
    }

    fn enter_file(
        &mut self,
        file: crate::base::source::FileId,
        from: crate::base::source::Span,
    ) -> Parse<()> {
        let tokens = self.tokens_of(file)?;
        let kind = Entered::Include {
            back: self.here.clone(),
            from,
        };
        self.enter_frame(Rc::clone(&tokens), u32::MAX, kind);
        self.scopes.enter();
        self.here = Position { tokens, at: 0 };
        Ok(())
    }

    pub(crate) fn run_version(&mut self) -> Parse<()> {
        let next = self.raw();
        if next.kind == Kind::Name && self.source_text(self.here_span()) == "unofficial" {
            self.pass();
        }
        // It holds at once, for a directive after it as well.
        self.statement.is_in_version = true;
        let version = self.float();
        self.statement.is_in_version = false;
        let version = version?;
        self.take_semicolon();
        if version > NEWEST + crate::lang::limits::EQUAL {
            return Err(self.with_trace(
                Diagnostic::error(
                    self.taken_span(),
                    format!(
                        "this scene asks for version {version}; povr draws as POV-Ray {NEWEST}"
                    ),
                )
                .with_hint(format!(
                    "Write `#version {NEWEST};` if the scene uses nothing newer."
                )),
            ));
        }
        // Macros after a number are parsed differently before 3.5, and operators before 1.5.
        if [3.5, FIRST_WITH_OPERATORS]
            .iter()
            .any(|first| (version < *first) != (self.draft.version < *first))
        {
            self.replays.clear();
        }
        if is_for_3_8(version) {
            self.sources.search_paths_of_3_8(true);
            self.draft.globals.is_for_3_8 = true;
            if self.dialect.reserve_words_of_3_8() {
                self.replays.clear();
            }
        }
        let has_other_defaults =
            has_defaults_of_3_8(version) != has_defaults_of_3_8(self.draft.version);
        self.draft.version = version;
        self.draft.has_version = true;
        if has_other_defaults && self.draft.has_default {
            let message = "the defaults stay those of the version before, as a `#default` precedes";
            let warning = Diagnostic::warning(self.taken_span(), message);
            self.warning(warning.with_hint("Write `#version` before the first `#default`."));
        } else if has_other_defaults {
            self.draft.set_stock_defaults();
        }
        Ok(())
    }

    /// `#debug`, `#warning`, `#error`, `#render`, `#statistics` and their string.
    pub(crate) fn run_message(&mut self, word: Word, span: crate::base::source::Span) -> Parse<()> {
        let text = self.string()?;
        match word {
            Word::Error => {
                // The rest was written for a scene without this error.
                self.is_over = true;
                let text = match text.trim_end() {
                    "" => "the scene stops itself here",
                    text => text,
                };
                Err(self.with_trace(Diagnostic::error(span, text).with_code(Code::Author)))
            }
            Word::Warning => {
                let warning = Diagnostic::warning(span, text.trim_end().to_owned());
                self.warning(warning.with_code(Code::Author));
                Ok(())
            }
            _ => {
                if self.report.say(&text) <= limits::MESSAGES {
                    return Ok(());
                }
                self.is_over = true;
                Err(self.with_trace(Diagnostic::error(
                    span,
                    format!(
                        "a scene writes at most {} bytes of messages",
                        limits::MESSAGES
                    ),
                )))
            }
        }
    }
}
