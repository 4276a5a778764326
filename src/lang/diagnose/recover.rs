//! Error recovery: resuming after a faulty statement.

use super::hints::opens_group;
use crate::base::args::Word;
use crate::lang::expr::value::Value;
use crate::lang::frame::Entered;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind};

impl Reader<'_> {
    /// After an error: leaves the loops and macros it occurred in and goes past the faulty statement.
    pub(crate) fn recover(&mut self) {
        self.skip_statement();
        self.statement.recovered = Some(self.start_here());
    }

    fn skip_statement(&mut self) {
        let open_blocks = self.blocks.len();
        self.blocks.clear();
        self.unwind_loops_and_macros();
        if open_blocks > 0 && self.is_at_new_statement() {
            return;
        }
        let is_block = self.raw().is_mark('{');
        if open_blocks == 0 && self.statement.start == self.start_here() && !is_block {
            self.skip_token();
        }
        let mut depth = open_blocks;
        loop {
            let token = self.raw();
            match token.kind {
                Kind::End => return,
                Kind::DataSegment => {
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
                        // The next layer of a texture belongs to the faulty one.
                        if !self.raw().word().is_some_and(is_part) {
                            return;
                        }
                    }
                    depth = depth.saturating_sub(1);
                }
                Kind::Mark if depth == 0 && token.is_mark(';') => {
                    self.pass();
                    if self.is_first_in_line() {
                        return;
                    }
                    continue;
                }
                _ if depth == 0 && self.is_at_new_statement() => return,
                _ => {}
            }
            self.pass();
        }
    }

    /// True if the statement that begins here is the rest of a faulty one: it begins with a token that no statement
    /// begins with.
    pub(crate) fn is_rest_of_faulty(&self) -> bool {
        let token = self.raw();
        let class = token.word().map(Word::class);
        self.statement.recovered == Some(self.statement.start)
            && match token.kind {
                Kind::Mark | Kind::Number | Kind::String => true,
                _ => {
                    token.word().is_some_and(is_part)
                        || matches!(class, Some(Class::Transform | Class::Value))
                }
            }
    }

    fn skip_token(&mut self) {
        if !matches!(self.raw().kind, Kind::End | Kind::DataSegment) {
            self.pass();
        }
    }

    /// True if the next token begins a line and could begin a statement: a sign of a forgotten `}` above.
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

    /// True if only blanks precede the next token in its line.
    fn is_first_in_line(&self) -> bool {
        let text = self.sources.text(self.here.tokens.file);
        let before = &text[..self.raw().start as usize];
        let blanks = |c: char| c == ' ' || c == '\t';
        before.trim_end_matches(blanks).ends_with(['\n', '\r'])
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

    /// Skips a directive while looking for the end of a faulty statement; groups are skipped as a whole.
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

/// True if a word begins a part of an object, which can stand nowhere else.
pub(crate) fn is_part(word: Word) -> bool {
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
