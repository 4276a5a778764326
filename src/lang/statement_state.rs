//! State of the statement being read, and of the names used in it.

use super::directive::sealed::Sealed;
use super::frame::{Declaring, Position, Start};
use super::syntax::Symbol;
use crate::base::source::Span;
use rustc_hash::{FxHashMap, FxHashSet};

/// State of the statement being read.
#[derive(Debug)]
pub(super) struct StatementState {
    /// Its start.
    pub(super) start: Start,
    /// The start of the text behind a faulty statement.
    pub(super) recovered: Option<Start>,
    /// The `#declare` whose value is being read.
    pub(super) declaring: Option<Declaring>,
    /// True if the number of a `#version` is being read.
    pub(super) is_in_version: bool,
    /// True if a directive within the statement failed.
    pub(super) has_faulty_directive: bool,
    /// The end of the number being declared, if a directive follows it: a `;` is missing there. With the position of
    /// the directive and the number of frames open.
    pub(super) without_semicolon: Option<(Span, Position, usize)>,
    /// True within parentheses, conditions, arguments and colours, where expressions have operators in every language
    /// version.
    pub(super) has_operators: bool,
    /// Nesting depth of the expression being read.
    pub(super) depth: usize,
    /// Number of nested directives, conditions, strings and macro arguments being read.
    pub(super) nesting: usize,
    /// The slot being read where POV-Ray runs no directive behind a value.
    pub(super) sealed: Option<Sealed>,
    /// Number of tokens taken when the last directive ended or the last macro was entered.
    pub(super) directive_end: u64,
}

impl StatementState {
    /// The state at the start of a statement.
    pub(super) fn new(start: Start) -> StatementState {
        StatementState {
            start,
            recovered: None,
            declaring: None,
            is_in_version: false,
            has_faulty_directive: false,
            without_semicolon: None,
            has_operators: false,
            depth: 0,
            nesting: 0,
            sealed: None,
            directive_end: 0,
        }
    }
}

/// Names with findings of their own.
#[derive(Debug, Default)]
pub(super) struct NameUsage {
    /// Names already reported as undeclared.
    pub(super) undeclared: FxHashSet<Symbol>,
    /// True if an include file is missing, so that any name may be one of its.
    pub(super) lacks_file: bool,
    /// Arrays with an item whose value could not be read.
    pub(super) faulty_arrays: FxHashSet<Symbol>,
    /// Reserved words that a scene declares.
    pub(super) declared_words: Vec<Span>,
    /// Names that warn when they are used.
    pub(super) deprecated: FxHashMap<Symbol, Deprecation>,
}

/// The attributes of `deprecated` for a name.
#[derive(Debug)]
pub(crate) struct Deprecation {
    pub(crate) is_once: bool,
    pub(crate) message: Option<String>,
}
