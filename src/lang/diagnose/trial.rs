//! Trials of proposed changes: the changed text is read from its start to beyond the position of the error.
//!
//! A change that does not lead past that position is withdrawn, with the words that propose it. Where the changed line has
//! a further mistake with a change of its own, the two become one. Later errors that the changed text has not are
//! consequences of the first and not reported.

use crate::base::options::{ReadOptions, Writes};
use crate::base::source::{Code, Diagnostic, Fix, Severity, Sources, Span};
use crate::lang::ReadEvent;
use crate::lang::frame::Start;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;
use std::cmp::Reverse;
use std::time::{Duration, Instant};

/// Most tokens read before an error for which changes are tried; a reading of these takes some milliseconds.
const TOKENS: u64 = 500_000;
/// Most bytes of the text that is changed.
const BYTES: usize = 4 << 20;
/// Nothing is tried once reading, and trials, have taken this long.
const TIME: Duration = Duration::from_secs(1);
/// Tokens that are read beyond the error, in loops and in files.
const BEYOND: u64 = 1_000;
/// Most blocks, calls and conditions around an error: a trial takes as much stack again.
const NESTING: usize = 100;
/// Changes of one line that become one.
const CHANGES: u32 = 4;

/// Most bytes of changes that become one.
const MERGED: u32 = 400;

/// State of the trials of a reading.
#[derive(Debug)]
pub(in crate::lang) struct Trials {
    /// The start of the first reading.
    start: Instant,
    /// The changes of earlier errors.
    accepted: Vec<Fix>,
    /// The trial that this reading is.
    current: Option<Trial>,
}

/// A reading of a changed text.
#[derive(Debug)]
struct Trial {
    /// The change under test, in the changed text; `None` if those of earlier errors are all.
    changed: Option<Span>,
    /// Number of tokens after which it ends.
    end: u64,
    /// Number of changes of this line that are tried together.
    depth: u32,
    faults: Vec<Fault>,
}

/// An error of a changed text.
#[derive(Debug)]
struct Fault {
    /// The position that reading has to pass.
    position: Start,
    /// The start of the second token before it, if there is one in the text that was being read.
    before: Option<u32>,
    error: Diagnostic,
}

impl Default for Trials {
    fn default() -> Self {
        Trials {
            start: Instant::now(),
            accepted: Vec::new(),
            current: None,
        }
    }
}

/// Outcome of a trial.
enum Outcome {
    /// The change leads past the error; it may have grown by changes of the same line, with their hints.
    Mended(Fix, Vec<String>),
    Refused,
}

impl Reader<'_> {
    /// True once a trial has read enough.
    pub(in crate::lang) fn has_tried(&self) -> bool {
        let trial = self.trials.current.as_ref();
        trial.is_some_and(|trial| self.taken > trial.end)
    }

    /// An error without its change if that leads no further; an empty one for a consequence of earlier errors.
    pub(in crate::lang) fn tried(&mut self, mut error: Diagnostic) -> Diagnostic {
        // A limit ends a trial; it is no mistake of the change.
        if error.severity != Severity::Error || error.message.is_empty() || self.is_over {
            return error;
        }
        let position = self.position(&error);
        if self.trials.current.is_none() && self.is_consequence(position) {
            return *self.consequence();
        }
        let fix = error.fix.take().filter(|fix| !self.drops_comment(fix));
        if let Some(fix) = fix.filter(|fix| self.is_tried(fix.span, position)) {
            match self.outcome(&fix, position) {
                Some(Outcome::Mended(fix, hints)) => {
                    self.accept(&fix);
                    error.fix = Some(Box::new(fix));
                    error.hints.retain(|hint| !hints.contains(hint));
                    error.hints.extend(hints);
                }
                Some(Outcome::Refused) => {
                    let last = error.hints.pop();
                    error
                        .hints
                        .extend(last.and_then(|hint| rule(&hint, &fix.text)));
                }
                None => {}
            }
        }
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < position.start);
        let before = at.checked_sub(2).filter(|_| tokens.file == position.file);
        let before = before.map(|at| tokens.tokens[at].start);
        if let Some(trial) = &mut self.trials.current {
            trial.faults.push(Fault {
                position,
                before,
                error: error.clone(),
            });
        }
        error
    }

    /// The position that reading has to pass: the next token if the error is about that, or at the end of the scene.
    fn position(&self, error: &Diagnostic) -> Start {
        let here = self.start_here();
        let is_here = |span: Span| (span.file, span.start) == (here.file, here.start);
        let is_at_end = self.raw().kind == Kind::End;
        let is_about_next = is_at_end || error.labels.iter().any(|label| is_here(label.span));
        match error.span {
            Some(span) if !is_about_next => Start {
                file: span.file,
                start: span.start,
            },
            _ => here,
        }
    }

    /// True for a change to try: in a trial, one behind the change under test, in its line or of an error in its text.
    fn is_tried(&self, span: Span, position: Start) -> bool {
        let Some(trial) = &self.trials.current else {
            return true;
        };
        let is_behind = |changed: Span| {
            let text = self.sources.text(span.file);
            let between = text.get(changed.end as usize..span.start as usize);
            span.file == changed.file
                && span.start >= changed.start
                && (is_in(position, changed) || between.is_none_or(is_one_line))
        };
        trial.depth < CHANGES && trial.changed.is_some_and(is_behind)
    }

    /// True if a change would delete a comment.
    fn drops_comment(&self, fix: &Fix) -> bool {
        let (start, end) = (fix.span.start as usize, fix.span.end as usize);
        let text = self.sources.text(fix.span.file).get(start..end);
        let text = text.unwrap_or_default();
        ["//", "/*"]
            .iter()
            .any(|mark| text.contains(mark) && !fix.text.contains(mark))
    }

    /// Notes a change for later trials.
    fn accept(&mut self, fix: &Fix) {
        let (file, start) = (fix.span.file, fix.span.start);
        let is_apart = |known: &Fix| {
            known.span.file != file || known.span.end <= start || fix.span.end <= known.span.start
        };
        if self.trials.current.is_none() && self.trials.accepted.iter().all(is_apart) {
            self.trials.accepted.push(fix.clone());
        }
    }

    /// True if the text with the changes of earlier errors has no error here.
    fn is_consequence(&mut self, position: Start) -> bool {
        if self.trials.accepted.is_empty() {
            return false;
        }
        let moved = self.moved_by_all(position);
        let is_here = |fault: &Fault| fault.position == moved;
        self.trial(None)
            .is_some_and(|read| !read.is_over && !read.faults.iter().any(is_here))
    }

    /// The position in the text with the changes of earlier errors.
    fn moved_by_all(&self, position: Start) -> Start {
        let changes = self.changes(None);
        changes.into_iter().fold(position, moved)
    }

    /// The changes of earlier errors and a further one, from the end of each text to its start.
    fn changes<'a>(&'a self, further: Option<&'a Fix>) -> Vec<&'a Fix> {
        let mut changes: Vec<&Fix> = self.trials.accepted.iter().chain(further).collect();
        changes.sort_by_key(|fix| Reverse(fix.span.start));
        changes
    }

    /// Tries a change; `None` if it would take too long.
    fn outcome(&mut self, fix: &Fix, position: Start) -> Option<Outcome> {
        let read = self.trial(Some(fix))?;
        let changed = self.changed_span(fix);
        let in_first = Fix {
            span: Span::new(
                changed.file,
                changed.start,
                changed.start + fix.span.end - fix.span.start,
            ),
            text: fix.text.clone(),
        };
        let position = moved(self.moved_by_all(position), &in_first);
        let (first, passed) = match position.file == changed.file {
            true => (
                changed.start.min(position.start),
                changed.end.max(position.start),
            ),
            false => (position.start, position.start),
        };
        // A change may break what precedes it in the statement.
        let begun = self.moved_by_all(self.statement.start);
        let first = match begun.file == position.file {
            true => first.min(begun.start),
            false => first,
        };
        for fault in read.faults {
            let both =
                fault.error.fix.as_ref().and_then(|other| {
                    merged((fix, changed), other, read.sources.text(changed.file))
                });
            if let Some(both) = both {
                return Some(Outcome::Mended(both, fault.error.hints));
            }
            let next = fault.position;
            let is_near = || {
                let text = read.sources.text(position.file);
                let between = text.get(passed as usize..next.start as usize);
                let ends = next.start as usize >= text.trim_end().len();
                fault.before.is_some_and(|before| before < passed)
                    && (ends || between.is_none_or(is_one_line))
            };
            let is_stuck = next.file == position.file
                && next.start >= first
                && (next.start <= passed || is_near())
                && fault.error.code != Some(Code::MissingFile);
            if is_stuck {
                return Some(Outcome::Refused);
            }
        }
        Some(Outcome::Mended(fix.clone(), Vec::new()))
    }

    /// The text of a change in the changed text.
    fn changed_span(&self, fix: &Fix) -> Span {
        let start = self.moved_by_all(Start {
            file: fix.span.file,
            start: fix.span.start,
        });
        Span::new(start.file, start.start, start.start + length(&fix.text))
    }

    /// Reads the text with the changes of earlier errors and a further one; `None` if it would take too long.
    fn trial(&mut self, fix: Option<&Fix>) -> Option<TrialReading> {
        let is_deep = [self.blocks.len(), self.frames.len(), self.statement.nesting]
            .into_iter()
            .any(|depth| depth > NESTING);
        let is_long = self.taken + self.budget.reread > TOKENS;
        if is_deep || is_long || self.trials.start.elapsed() > TIME {
            return None;
        }
        let mut sources = self.sources.clone().for_another_run();
        for fix in self.changes(fix) {
            let text = sources.text(fix.span.file);
            let before = text.get(..fix.span.start as usize)?;
            let behind = text.get(fix.span.end as usize..)?;
            if text.len() > BYTES {
                return None;
            }
            let changed = [before, &fix.text, behind].concat();
            sources.replace_text(fix.span.file, changed);
        }
        let options = ReadOptions {
            writes: Writes::InMemory,
            lints: false,
            notes_objects: false,
            max_repeated_tokens: self.budget.reread + BEYOND,
            ..self.options.clone()
        };
        let depth = self.trials.current.as_ref().map_or(0, |trial| trial.depth);
        let trial = Trial {
            changed: fix.map(|fix| self.changed_span(fix)),
            end: self.taken + BEYOND,
            depth: depth + 1,
            faults: Vec::new(),
        };
        let start = self.trials.start;
        let mut listener = |_: ReadEvent<'_>| {};
        let reader = Reader::new(
            self.scene,
            &mut sources,
            (None, None),
            &options,
            self.probe,
            &mut listener,
        );
        let mut reader = reader.ok()?;
        reader.trials = Trials {
            start,
            accepted: Vec::new(),
            current: Some(trial),
        };
        reader.enter_header();
        reader.statements();
        let faults = reader.trials.current.take()?.faults;
        let is_over = reader.is_over;
        drop(reader);
        Some(TrialReading {
            faults,
            is_over,
            sources,
        })
    }
}

/// The result of a trial.
struct TrialReading {
    faults: Vec<Fault>,
    /// True if a limit ended it.
    is_over: bool,
    sources: Sources,
}

/// The position of a text that another becomes by a change.
fn moved(position: Start, fix: &Fix) -> Start {
    let span = fix.span;
    let start = match position.start < span.end {
        _ if position.file != span.file => position.start,
        true => position.start.min(span.start + length(&fix.text)),
        false => position.start - span.end + span.start + length(&fix.text),
    };
    Start { start, ..position }
}

fn is_in(position: Start, span: Span) -> bool {
    position.file == span.file && (span.start..=span.end).contains(&position.start)
}

fn is_one_line(text: &str) -> bool {
    !text.contains(['\n', '\r'])
}

fn length(text: &str) -> u32 {
    u32::try_from(text.len()).unwrap_or(0)
}

/// Two changes of one line as one: the first, with the span of its text in the text that it has made, and one in that.
fn merged((first, changed): (&Fix, Span), second: &Fix, text: &str) -> Option<Fix> {
    let end = changed.end.max(second.span.end);
    let part = |from: u32, to: u32| text.get(from as usize..to as usize);
    if second.span.file != changed.file || end - changed.start > MERGED {
        return None;
    }
    let before = part(changed.start, second.span.start)?;
    let behind = part(second.span.end, end)?;
    Some(Fix {
        span: Span::new(
            changed.file,
            first.span.start,
            first.span.end + end - changed.end,
        ),
        text: [before, &second.text, behind].concat(),
    })
}

/// A hint without the text that it proposes: the rule behind it, if it states one.
fn rule(hint: &str, text: &str) -> Option<String> {
    let proposes = |part: &str| match text.trim() {
        "" => part.contains("emove"),
        text if text.len() < 4 => part.contains(&format!("`{text}`")),
        text => part.contains(text),
    };
    if !proposes(hint) {
        return Some(hint.to_owned());
    }
    let mut is_quoted = false;
    let divider = hint.find(|letter| {
        is_quoted ^= letter == '`';
        !is_quoted && matches!(letter, ':' | ';')
    });
    if let Some((first, rest)) = divider.and_then(|at| hint.split_at_checked(at))
        && !proposes(first)
        && proposes(rest)
    {
        return Some(format!("{first}."));
    }
    let is_proposal = ["Write", "write", "emove"]
        .iter()
        .any(|verb| hint.contains(verb));
    (!is_proposal).then(|| hint.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::source::{FileId, Sources};
    use crate::lang::evaluate;

    fn fix(start: u32, end: u32, text: &str) -> Fix {
        let mut sources = Sources::default();
        let file: FileId = sources.add_text("x.pov", "");
        Fix {
            span: Span::new(file, start, end),
            text: text.to_owned(),
        }
    }

    /// The first error of a scene: the changed scene, and the hints.
    fn first_error(scene: &str) -> (Option<String>, Vec<String>) {
        let mut sources = Sources::default();
        let file = sources.add_text("x.pov", scene);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        let error = reading.findings.into_iter().next().unwrap();
        let changed = error.fix.map(|fix| {
            let (start, end) = (fix.span.start as usize, fix.span.end as usize);
            [&scene[..start], &fix.text, &scene[end..]].concat()
        });
        (changed, error.hints)
    }

    #[test]
    fn a_change_that_leads_no_further_is_withdrawn() {
        let (changed, _) = first_error("Sphere { 0, 1 }");
        assert_eq!(changed.as_deref(), Some("sphere { 0, 1 }"));
        let (changed, hints) = first_error("Sphere = { 0, 1 }");
        assert_eq!(changed, None);
        assert!(
            !hints.iter().any(|hint| hint.contains("sphere")),
            "{hints:?}"
        );
    }

    #[test]
    fn changes_of_one_line_become_one() {
        let (changed, _) = first_error("sphere { center 0, radius 1 }\nbox { 0, 1 }");
        assert_eq!(changed.as_deref(), Some("sphere { 0, 1 }\nbox { 0, 1 }"));
    }

    #[test]
    fn a_change_in_a_long_loop_is_tried() {
        let loops = "#for (I, 0, 999) Sphere { I, 1 } #end";
        let (changed, _) = first_error(loops);
        assert_eq!(changed, Some(loops.replace('S', "s")));
        let (changed, _) = first_error("#while (1) Sphere { 0, 1 } #end");
        assert_eq!(changed.as_deref(), Some("#while (1) sphere { 0, 1 } #end"));
    }

    #[test]
    fn consequences_of_a_changed_error_are_not_reported() {
        let mut sources = Sources::default();
        let file = sources.add_text("x.pov", "#if (1)\nsphere { 0, 1 }\n#endif\nbox { 0, 1 }");
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        assert_eq!(reading.findings.len(), 1, "{:?}", reading.findings);
    }

    #[test]
    fn two_changes_are_merged_in_the_first_text() {
        // `ab = cd` becomes `Xb = cd`, and that `Xb cd`.
        let first = fix(0, 1, "X");
        let both = merged((&first, first.span), &fix(2, 5, " "), "Xb = cd").unwrap();
        assert_eq!((both.span.start, both.span.end), (0, 5));
        assert_eq!(both.text, "Xb ");
    }

    #[test]
    fn a_rule_remains_of_a_withdrawn_proposal() {
        let rule = |hint: &str, text| rule(hint, text);
        let hint = "Keywords are lower case: `sphere`.";
        assert_eq!(
            rule(hint, "sphere").as_deref(),
            Some("Keywords are lower case.")
        );
        assert_eq!(rule("Write `2*x`.", "2*x"), None);
        assert_eq!(rule("Remove this comma: blocks have none.", ""), None);
        let hint = "Only declarations end with `;`; remove it.";
        assert_eq!(
            rule(hint, "").as_deref(),
            Some("Only declarations end with `;`.")
        );
        let hint = "One `=` compares two values.";
        assert_eq!(rule(hint, ">=").as_deref(), Some(hint));
    }
}
