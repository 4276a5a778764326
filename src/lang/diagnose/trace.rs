//! The trace of a finding: macro calls with their arguments, rounds of loops, includes.

use crate::base::source::{Diagnostic, Label};
use crate::lang::expr::value::Value;
use crate::lang::frame::{Entered, Frame};
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};

impl Reader<'_> {
    /// The diagnostic with the calls, loops and includes that lead to it, innermost first.
    pub(crate) fn with_trace(&self, mut diagnostic: Diagnostic) -> Box<Diagnostic> {
        if diagnostic.trace.is_empty() {
            let frames = self.frames.iter().enumerate().rev();
            let labels = frames.filter_map(|(at, frame)| self.step(at, frame));
            diagnostic.trace = labels.take(limits::TRACE).collect();
        }
        Box::new(diagnostic)
    }

    /// The label of one frame.
    fn step(&self, at: usize, frame: &Frame) -> Option<Label> {
        match &frame.kind {
            Entered::Macro {
                call,
                called_to,
                name,
                called,
                ..
            } => {
                let depth = self.frames[..=at]
                    .iter()
                    .filter(|frame| {
                        matches!(frame.kind, Entered::Macro { .. } | Entered::Include { .. })
                    })
                    .count();
                let values = called.parameters().iter().filter_map(|&parameter| {
                    let value = self
                        .scopes
                        .bound_at(parameter, u32::try_from(depth).ok()?)?;
                    self.value_text(parameter, value)
                });
                let values: Vec<String> = values.take(limits::TRACE_VALUES).collect();
                let with = if values.is_empty() { "" } else { " with " };
                let name = self.names.spelling(*name);
                Some(Label {
                    span: self.span_of(*call).to(self.span_of(*called_to)),
                    text: format!("in the macro `{name}`{with}{}, called here", all(&values)),
                })
            }
            Entered::Include { from, .. } => Some(Label {
                span: *from,
                text: "in the file included here".to_owned(),
            }),
            Entered::For(run) if run.has_gone_round() => {
                let value = self.scopes.get(run.variable())?;
                self.round(
                    frame,
                    run.body(),
                    vec![self.value_text(run.variable(), value)?],
                )
            }
            Entered::While {
                condition, rounds, ..
            } if *rounds > 1 => self.round(
                frame,
                *condition,
                self.names_of_condition(frame, *condition),
            ),
            _ => None,
        }
    }

    /// The loop whose head holds or ends before the token `inside`, and the values of its variables.
    fn round(&self, frame: &Frame, inside: usize, values: Vec<String>) -> Option<Label> {
        let tokens = &frame.home;
        let head = tokens.tokens[..inside]
            .iter()
            .rposition(|token| token.kind == Kind::Directive)?;
        let with = if values.is_empty() { "" } else { ", where " };
        Some(Label {
            span: tokens.span(head),
            text: format!("in a later round of this loop{with}{}", all(&values)),
        })
    }

    /// The numbers that the condition of a `#while` depends on.
    fn names_of_condition(&self, frame: &Frame, condition: usize) -> Vec<String> {
        let tokens = &frame.home.tokens;
        let mut values: Vec<String> = Vec::new();
        let mut depth = 0;
        for token in &tokens[condition.min(tokens.len())..] {
            depth += i32::from(token.is_mark('(')) - i32::from(token.is_mark(')'));
            if depth <= 0 || values.len() == limits::TRACE_VALUES || token.kind == Kind::Directive {
                break;
            }
            let value = token.symbol().and_then(|symbol| {
                let value = self.scopes.get(symbol)?;
                self.value_text(symbol, value)
            });
            values.extend(value.filter(|text| !values.contains(text)));
        }
        values
    }

    /// "`R` = 2", for values that are short.
    fn value_text(&self, symbol: Symbol, value: &Value) -> Option<String> {
        let value = match value {
            Value::Number(number) => number.to_string(),
            Value::Text(text) if text.len() <= limits::QUOTED => {
                format!("\"{}\"", &*text.letters())
            }
            _ => return None,
        };
        Some(format!("`{}` = {value}", self.names.spelling(symbol)))
    }
}

/// `a`, `a and b`, `a, b and c`.
fn all(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
