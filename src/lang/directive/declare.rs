//! `#declare`, `#local`, `#undef`, `#include`, `#version`, and the values that identifiers are given.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Code, Diagnostic};
use crate::base::version::Novelty;
use crate::lang::expr::callee::{FUNCTION, is_callable};
use crate::lang::expr::value::Value;
use crate::lang::fast_path::replay::cache::Level;
use crate::lang::frame::{Declaring, Entered, Frame, Start, is_bare_directive};
use crate::lang::reader::Reader;
use crate::lang::statement_state::Deprecation;
use crate::lang::syntax::{Kind, Symbol, Token};
use std::rc::Rc;

/// Kind of a name's value, as far as it restricts the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum BoundKind {
    Function,
    Macro,
    Poison,
    Other,
}

impl BoundKind {
    fn of(value: &Value) -> Self {
        match value {
            Value::Macro(_) => BoundKind::Macro,
            Value::Element(element) if element.name == FUNCTION => BoundKind::Function,
            Value::Poison(_) => BoundKind::Poison,
            _ => BoundKind::Other,
        }
    }

    /// Functions and macros keep their kind, and no other name becomes a function by its definition.
    fn excludes(self, next: BoundKind) -> bool {
        self != BoundKind::Poison
            && next != BoundKind::Poison
            && (self != BoundKind::Other || next == BoundKind::Function)
    }
}

/// A name of a tuple declaration.
struct TupleName {
    declaring: Declaring,
    start: Start,
    is_optional: bool,
    /// The path of an item of an array.
    item: Option<Vec<usize>>,
}

impl Reader<'_> {
    /// `#declare Name = value` and `#local Name = value`, and the same for an item of an array.
    pub(crate) fn run_declare(&mut self, is_local: bool) -> Parse<()> {
        // It may stand where another declaration should have ended.
        let outer = self.statement.without_semicolon.take();
        let end = self.declare(is_local);
        if outer.is_some() {
            self.statement.without_semicolon = outer;
        }
        end
    }

    fn declare(&mut self, is_local: bool) -> Parse<()> {
        if self.is_raw_mark('(') {
            if self.dialect.has_words_of_3_8() {
                return self.declare_tuple(is_local);
            }
            let error = self.expected_here("a name to declare");
            return Err(Box::new(error.with_hint(
                "Several names at once are of POV-Ray 3.8: begin the scene with `#version 3.8;`.",
            )));
        }
        let deprecation = self.deprecation()?;
        let symbol = self.declared_name(is_local)?;
        let name = self.start_taken();
        self.set_deprecation(symbol, deprecation);
        if self.begins_item(symbol) {
            return self.declare_item(symbol, is_local);
        }
        let steps = self.steps;
        let has_equals = self.take_mark('=')?;
        if has_equals && self.steps != steps {
            let reason = "no directive may stand between a name and its `=`";
            self.refused_by_povray(self.taken_span(), reason, "Write it before `#declare`.");
        }
        if !has_equals {
            let spelling = self.names.spelling(symbol).to_owned();
            let directive = if is_local { "#local" } else { "#declare" };
            let mut error = self.expected_here(&format!("`=` after `{directive} {spelling}`"));
            // Without a value the name is undeclared, which need not be said again.
            self.usage.undeclared.insert(symbol);
            if !error.message.is_empty() && error.hints.is_empty() {
                let hint = format!("Write `{directive} {spelling} = ...`.");
                *error = self.missing_equals(hint).added_to(*error);
            }
            return Err(error);
        }
        let outer = self.statement.declaring.take();
        let mut declaring = self.declaring_here(symbol, is_local);
        let known = if is_local && !self.scopes.is_qualified(symbol) {
            self.scopes.bound_at(symbol, declaring.scope)
        } else {
            self.scopes.get(symbol)
        };
        let known = known.map(BoundKind::of);
        let mut start = name;
        let mut macro_behind = None;
        let value = self.replayed(Level::Value, |reader| {
            // Directives before the value run before it and may enter a file or a macro, in which the value is then
            // read: `#declare N = #declare A = 1; N + A;`.
            reader.peek()?;
            declaring = Declaring {
                scope: declaring.scope,
                ..reader.declaring_here(symbol, is_local)
            };
            start = reader.start_here();
            reader.statement.declaring = Some(declaring);
            let value;
            (value, macro_behind) = reader.sealed_declared(|reader| reader.read_value("a value"));
            value
        });
        self.statement.declaring = outer;
        match value {
            Ok(Some(value)) => {
                // The name has its value before the `;` is looked for: a directive there may use it.
                let is_number = self.is_like_number(&value);
                self.warn_of_macro_behind(is_number, macro_behind);
                // A copied function may replace anything but a function.
                let next = if is_number {
                    BoundKind::Other
                } else {
                    BoundKind::of(&value)
                };
                if let Some(known) = known
                    && known.excludes(next)
                {
                    let error = self.name_is_taken(symbol, name);
                    self.record_in_passing(*error);
                }
                self.assign(&declaring, value);
                let outer = self.statement.declaring.replace(Declaring {
                    is_complete: true,
                    ..declaring
                });
                let end = self.end_of_declaration(is_number);
                self.statement.declaring = outer;
                end
            }
            Ok(None) => {
                self.assign(&declaring, Value::Poison(None));
                let spelling = self.names.spelling(symbol).to_owned();
                let error = self.expected_here(&format!("a value for `{spelling}`"));
                let name = self.span_of(name);
                Err(Box::new(error.with_label(name, "declared here")))
            }
            Err(error) if error.code == Some(Code::NotBuilt) => {
                // A directive after the value may use the name.
                self.assign(&declaring, Value::Poison(Some(Rc::new(*error))));
                self.statement.has_faulty_directive = false;
                self.skip_value(declaring, start)
            }
            Err(error) => {
                self.assign(&declaring, Value::Poison(None));
                Err(error)
            }
        }
    }

    /// The name behind `#declare` or `#local`, which itself says where it is declared.
    fn declared_name(&mut self, is_local: bool) -> Parse<Symbol> {
        let symbol = self.identifier("a name to declare")?;
        if !is_local || !self.scopes.is_qualified(symbol) || self.begins_item(symbol) {
            return Ok(symbol);
        }
        let name = self.names.spelling(symbol);
        let message = format!("`#local` cannot declare `{name}`");
        let hint = format!("Write `#declare {name}`, or `#local` and the name alone.");
        Err(Box::new(self.error_taken(message).with_hint(hint)))
    }

    /// `#declare (A, B[0], optional C, ) = (value, value, , value);` of version 3.8. Each name gets its value before the
    /// next one is read; a name may be left out, and its value then too.
    fn declare_tuple(&mut self, is_local: bool) -> Parse<()> {
        self.draft.note_novelty(Novelty::Tuple);
        self.pass();
        let mut names = Vec::new();
        loop {
            if self.is_raw_mark(',') || self.is_raw_mark(')') {
                names.push(None);
                if !self.take_mark(',')? {
                    break;
                }
                continue;
            }
            let is_optional = self.take_raw_word(Word::Optional);
            let deprecation = self.deprecation()?;
            let symbol = self.declared_name(is_local)?;
            let start = self.start_taken();
            self.set_deprecation(symbol, deprecation);
            let item = match self.begins_item(symbol) {
                true => Some(self.item_path(symbol)?),
                false => None,
            };
            names.push(Some(TupleName {
                declaring: self.declaring_here(symbol, is_local),
                start,
                is_optional,
                item,
            }));
            if !self.take_mark(',')? {
                break;
            }
        }
        self.expect_mark(')', "`,` or `)` after the name")?;
        self.expect_mark('=', "`=` after the names")?;
        let outer = self.statement.declaring.take();
        let declared = self.declare_names(&names);
        self.statement.declaring = outer;
        declared?;
        self.take_mark(';')?;
        Ok(())
    }

    /// `(value, value)`, as many as there are names.
    fn declare_names(&mut self, names: &[Option<TupleName>]) -> Parse<()> {
        self.expect_mark('(', "`(` before the values")?;
        for (at, name) in names.iter().enumerate() {
            if at > 0 {
                self.expect_mark(',', "`,` and a further value")?;
            }
            let may_lack = name.as_ref().is_none_or(|name| name.is_optional);
            if may_lack && self.take_nothing()? {
                continue;
            }
            let Some(name) = name else {
                if self.value("a value")?.is_none() {
                    return Err(self.expected_here("a value"));
                }
                continue;
            };
            let symbol = name.declaring.symbol;
            let Some(value) = self.value("a value")? else {
                let spelling = self.names.spelling(symbol).to_owned();
                return Err(self.expected_here(&format!("a value for `{spelling}`")));
            };
            if let Some(path) = &name.item {
                self.set_item(symbol, path, value)?;
                continue;
            }
            let known = self.scopes.get(symbol).map(BoundKind::of);
            if known.is_some_and(|known| known.excludes(BoundKind::of(&value))) {
                return Err(self.name_is_taken(symbol, name.start));
            }
            self.assign(&name.declaring, value);
        }
        self.expect_mark(')', "`)` after the values")
    }

    /// True if a value ends as a number does: it is one, or a function or spline by name.
    pub(crate) fn is_like_number(&self, value: &Value) -> bool {
        let is_written = || self.last.tokens.tokens[self.last.at].is_mark('}');
        matches!(value, Value::Number(_)) || is_callable(value) && !is_written()
    }

    /// The error for redeclaring a function or a macro as something else, or something else as a function.
    pub(crate) fn name_is_taken(&self, symbol: Symbol, name: Start) -> Box<Diagnostic> {
        let spelling = self.names.spelling(symbol);
        let known = self.scopes.get(symbol);
        let known = known.map_or("in use".to_owned(), Value::kind);
        let error = Diagnostic::error(
            self.span_of(name),
            format!("`{spelling}` is {known} already"),
        );
        self.with_trace(error.with_hint(format!(
            "Write `#undef {spelling}` above, or take another name."
        )))
    }

    /// Skips the value being declared, which holds something unsupported.
    fn skip_value(&mut self, declaring: Declaring, start: Start) -> Parse<()> {
        let is_expression = match self.raw().kind {
            Kind::Name | Kind::Word if self.start_here() == start => {
                let next = self.raw_ahead(1);
                ['(', '[', '.', '+', '-', '*', '/']
                    .into_iter()
                    .any(|mark| next.is_mark(mark))
            }
            Kind::Word => false,
            _ => true,
        };
        if is_expression && self.blocks.len() <= declaring.blocks {
            while !self.peek()?.is_mark(';') && self.raw().kind != Kind::End {
                self.pass();
            }
        } else {
            self.skip_blocks(declaring.blocks)?;
        }
        self.statement.depth = declaring.depth;
        if self.raw().is_mark(';') {
            self.pass();
        }
        Ok(())
    }

    /// Skips a value or an object that holds something unsupported, until `outside` blocks are open. It is valid
    /// otherwise: directives in it run.
    pub(crate) fn skip_blocks(&mut self, outside: usize) -> Parse<()> {
        let mut open = self.blocks.len().saturating_sub(outside);
        loop {
            let token = self.peek()?;
            if token.kind == Kind::End {
                break;
            }
            if token.is_mark('}') && open == 0 {
                break;
            }
            self.pass();
            if token.is_mark('{') {
                open += 1;
            } else if token.is_mark('}') {
                open -= 1;
            }
            // The unsupported word may stand before its block, and further layers of a texture after it.
            let next = self.raw();
            if open == 0 && !next.is_mark('{') && next.word() != Some(Word::Texture) {
                break;
            }
        }
        self.blocks.truncate(outside);
        Ok(())
    }

    /// `deprecated [once] ["message"]` before a declared name.
    fn deprecation(&mut self) -> Parse<Option<Deprecation>> {
        if self.raw().word() != Some(Word::Deprecated) {
            return Ok(None);
        }
        self.pass();
        let is_once = self.raw().word() == Some(Word::Once);
        if is_once {
            self.pass();
        }
        let message = if self.raw().kind == Kind::String {
            Some(self.string()?)
        } else {
            None
        };
        Ok(Some(Deprecation { is_once, message }))
    }

    /// Marks a name that is declared as deprecated, or no longer.
    fn set_deprecation(&mut self, symbol: Symbol, deprecation: Option<Deprecation>) {
        match deprecation {
            Some(deprecation) => {
                self.usage.deprecated.insert(symbol, deprecation);
            }
            None if !self.usage.deprecated.is_empty() => {
                self.usage.deprecated.remove(&symbol);
            }
            None => {}
        }
    }

    /// Warns of the use of a deprecated name, or of its first use only.
    pub(crate) fn warn_of_deprecated(&mut self, symbol: Symbol) {
        let Some(deprecation) = self.usage.deprecated.get(&symbol) else {
            return;
        };
        let name = self.names.spelling(symbol);
        let message = match &deprecation.message {
            Some(message) => message.trim_end().to_owned(),
            None => format!("`{name}` was declared deprecated"),
        };
        if deprecation.is_once {
            self.usage.deprecated.remove(&symbol);
        }
        self.warning(Diagnostic::warning(self.here_span(), message));
    }

    /// Notes `global.Name` and `local.Name`, taken last, which are of version 3.8, and warns of them in older scenes.
    pub(crate) fn warn_of_qualified(&mut self, symbol: Symbol) {
        if self.scopes.is_qualified(symbol) {
            if self.dialect.has_words_of_3_8() {
                return self.draft.note_novelty(Novelty::ScopedName);
            }
            let reason = "`global.` and `local.` before a name are of version 3.8";
            let remedy = "Write the name alone, or begin the scene with `#version 3.8;`.";
            self.refused_by_povray(self.taken_span(), reason, remedy);
        }
    }

    /// A declaration whose value begins at the cursor.
    pub(crate) fn declaring_here(&self, symbol: Symbol, is_local: bool) -> Declaring {
        Declaring {
            symbol,
            is_local,
            scope: self.scopes.depth(),
            is_item: false,
            frames: self.frames.len(),
            depth: self.statement.depth,
            blocks: self.blocks.len(),
            is_complete: false,
            has_ended: false,
        }
    }

    /// Peeks after a value that may be complete. A directive or a macro call there may use the name being declared, so
    /// it gets the value so far.
    pub(crate) fn peek_after(&mut self, value: impl FnOnce() -> Value) -> Parse<Token> {
        let level = (self.statement.depth, self.blocks.len());
        let open = self
            .statement
            .declaring
            .filter(|open| (open.depth, open.blocks) == level);
        if let Some(open) = open {
            let next = self.raw();
            let is_run = match next.kind {
                Kind::Directive => true,
                Kind::Name => self.scopes.is_macro(Symbol(next.value)),
                Kind::Word => is_bare_directive(next),
                _ => false,
            };
            if is_run && !open.is_item {
                self.assign(&open, value());
            }
            self.statement.declaring = Some(Declaring {
                is_complete: true,
                ..open
            });
        }
        let token = self.peek();
        if open.is_some() {
            self.statement.declaring = open;
        }
        token
    }

    /// Assigns a value to a name. A macro may have been entered since the name was read, and may end after the value.
    pub(crate) fn assign(&mut self, to: &Declaring, value: Value) {
        if to.scope < self.scopes.depth() {
            self.scopes
                .assign_from(to.scope, to.symbol, value, to.is_local);
        } else if to.is_local {
            self.scopes.local(to.symbol, value);
        } else {
            self.scopes.declare(to.symbol, value);
        }
    }

    pub(crate) fn is_raw_mark(&self, mark: char) -> bool {
        let token = self.raw();
        token.kind == Kind::Mark && token.value == mark as u32
    }

    /// True if no macro or file was entered, and no frame left, since this number of frames was open.
    pub(crate) fn is_within(&self, frames: usize) -> bool {
        let is_macro_or_file =
            |frame: &Frame| matches!(frame.kind, Entered::Macro { .. } | Entered::Include { .. });
        self.frames
            .get(frames..)
            .is_some_and(|entered| !entered.iter().any(is_macro_or_file))
    }

    pub(crate) fn run_undef(&mut self) -> Parse<()> {
        let symbol = self.identifier("a name after `#undef`")?;
        if self.begins_item(symbol) {
            let path = self.item_path(symbol)?;
            let array = self.scopes.get_mut(symbol);
            if let Some(item) = array.and_then(|array| array.item_mut(&path)) {
                *item = None;
            }
            return Ok(());
        }
        if let Some(&Value::File(handle)) = self.scopes.get(symbol) {
            self.scopes.undefine(symbol);
            return self.close_file(handle, self.taken_span());
        }
        if !self.scopes.undefine(symbol) {
            let name = self.names.spelling(symbol).to_owned();
            self.warning(Diagnostic::warning(
                self.taken_span(),
                format!("`{name}` is not declared; nothing to undo"),
            ));
        }
        Ok(())
    }

    /// The name in the parentheses of `#ifdef`, perhaps an item of an array.
    pub(crate) fn is_defined(&mut self) -> Parse<bool> {
        self.expect_mark('(', "`(` after `#ifdef`")?;
        let is_defined = self.names_a_value()?;
        self.expect_mark(')', "`)` after the name")?;
        Ok(is_defined)
    }

    /// True if the next identifier, with its indices, has a value. POV-Ray takes any other token as well: a string
    /// has a value, a reserved word, a number or a mark has none.
    pub(crate) fn names_a_value(&mut self) -> Parse<bool> {
        self.pass_hash();
        if self.begins_scope_key(self.raw()) {
            self.resolve_scope_key()?;
        }
        let token = self.raw();
        let is_empty = token.is_mark(')') && !self.raw_ahead(1).is_mark(')');
        if matches!(
            token.kind,
            Kind::Word | Kind::Number | Kind::String | Kind::Mark
        ) && !is_empty
        {
            self.pass();
            return Ok(token.kind == Kind::String);
        }
        let symbol = self.identifier("a name")?;
        let path = if self.begins_item(symbol) {
            self.item_path(symbol)?
        } else {
            Vec::new()
        };
        let held = self.scopes.get(symbol);
        Ok(held.is_some_and(|value| value.item(&path).is_some()))
    }
}
