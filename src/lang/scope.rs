//! The values of identifiers.
//!
//! Scopes are dynamic, as in POV-Ray: each include file and each macro call opens one, and an identifier refers to its
//! innermost binding. Every symbol has its own stack of bindings, so that a look-up is one step.

use super::expr::value::{Number, Value};
use crate::lang::syntax::{Qualified, Symbol};
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// A binding: the depth of the scope that owns it, and its value.
#[derive(Debug)]
struct Binding {
    depth: u32,
    held: Held,
}

#[derive(Debug)]
enum Held {
    Value(Value),
    /// A macro parameter passed by reference: the binding of another symbol, by its index in that symbol's stack.
    Alias(Symbol, u32),
    /// A macro parameter that refers to an item of an array: the array's binding, and the indices from the outermost
    /// array on.
    Item(Symbol, u32, Rc<[usize]>),
}

/// The target of a macro parameter by reference.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// The binding that holds the value, by its index in the symbol's stack.
    symbol: Symbol,
    at: usize,
    /// The indices of an item of the array there; empty for the value itself.
    path: Vec<usize>,
}

/// All bindings of a run.
#[derive(Debug, Default)]
pub(super) struct Scopes {
    stacks: Vec<Vec<Binding>>,
    /// The symbols bound in the open scopes, without the global one, innermost last.
    bound: Vec<Symbol>,
    /// The index of the first symbol of each of these scopes.
    open: Vec<usize>,
    /// `local.Name` and `global.Name`, which have no bindings of their own.
    qualified: FxHashMap<Symbol, Qualified>,
}

impl Scopes {
    /// Opens a scope for an include file or a macro call.
    pub(super) fn enter(&mut self) {
        self.open.push(self.bound.len());
    }

    /// Closes the innermost scope with all its bindings.
    pub(super) fn leave(&mut self) {
        let depth = self.depth();
        let start = self.open.pop().unwrap_or(self.bound.len());
        for symbol in self.bound.drain(start..) {
            let stack = &mut self.stacks[symbol.0 as usize];
            if stack.last().is_some_and(|last| last.depth == depth) {
                stack.truncate(stack.len() - 1);
            } else if let Some(at) = stack.iter().rposition(|binding| binding.depth == depth) {
                stack.remove(at);
            }
        }
    }

    /// Number of scopes open beside the global one.
    pub(super) fn depth(&self) -> u32 {
        u32::try_from(self.open.len()).expect("the depth of calls is limited")
    }

    /// The value of a symbol.
    #[inline]
    pub(super) fn get(&self, symbol: Symbol) -> Option<&Value> {
        let stack = self.stacks.get(symbol.0 as usize);
        match stack.and_then(|stack| stack.last()) {
            Some(binding) => self.held(binding),
            None => self.get_qualified(symbol),
        }
    }

    #[cold]
    #[inline(never)]
    fn get_qualified(&self, symbol: Symbol) -> Option<&Value> {
        let (name, depth) = self.in_scope(symbol)?;
        self.bound_at(name, depth)
    }

    /// Makes `local.Name` and `global.Name` known.
    pub(super) fn qualify(&mut self, all: &[Qualified]) {
        for &qualified in all.get(self.qualified.len()..).unwrap_or_default() {
            self.qualified.insert(qualified.symbol, qualified);
        }
    }

    /// The name and the depth of the scope that `local.Name` or `global.Name` refers to.
    fn in_scope(&self, symbol: Symbol) -> Option<(Symbol, u32)> {
        let qualified = self.qualified.get(&symbol)?;
        let depth = if qualified.is_local { self.depth() } else { 0 };
        Some((qualified.name, depth))
    }

    /// True for `local.Name` and `global.Name`.
    pub(super) fn is_qualified(&self, symbol: Symbol) -> bool {
        self.qualified.contains_key(&symbol)
    }

    /// The symbol and the index of the binding that a name refers to.
    fn binding(&self, symbol: Symbol) -> Option<(Symbol, usize)> {
        if let Some(top) = self.top(symbol) {
            return Some((symbol, top));
        }
        let (name, depth) = self.in_scope(symbol)?;
        let stack = self.stacks.get(name.0 as usize)?;
        let at = stack.iter().position(|binding| binding.depth == depth)?;
        Some((name, at))
    }

    /// The value of a symbol in the scope of that depth, if it is bound there.
    pub(super) fn bound_at(&self, symbol: Symbol, depth: u32) -> Option<&Value> {
        let stack = self.stacks.get(symbol.0 as usize)?;
        self.held(stack.iter().find(|binding| binding.depth == depth)?)
    }

    #[inline]
    fn held<'a>(&'a self, binding: &'a Binding) -> Option<&'a Value> {
        match &binding.held {
            Held::Value(value) => Some(value),
            _ => self.held_behind(binding),
        }
    }

    fn held_behind<'a>(&'a self, mut binding: &'a Binding) -> Option<&'a Value> {
        loop {
            match &binding.held {
                Held::Value(value) => return Some(value),
                Held::Alias(target, at) => {
                    binding = self.stacks[target.0 as usize].get(*at as usize)?
                }
                Held::Item(target, at, path) => {
                    let array = &self.stacks[target.0 as usize].get(*at as usize)?.held;
                    return match array {
                        Held::Value(array) => array.item(path),
                        _ => None,
                    };
                }
            }
        }
    }

    /// True if a symbol is the name of a macro.
    #[inline]
    pub(super) fn is_macro(&self, symbol: Symbol) -> bool {
        match self
            .stacks
            .get(symbol.0 as usize)
            .and_then(|stack| stack.last())
        {
            Some(Binding {
                held: Held::Value(value),
                ..
            }) => matches!(value, Value::Macro(_)),
            Some(_) => matches!(self.get(symbol), Some(Value::Macro(_))),
            None => false,
        }
    }

    /// The value of a symbol, for changes.
    pub(super) fn get_mut(&mut self, symbol: Symbol) -> Option<&mut Value> {
        let (symbol, at) = self.binding(symbol)?;
        self.held_mut(symbol, at)
    }

    /// The value of the binding at an index of a symbol's stack, for changes.
    fn held_mut(&mut self, symbol: Symbol, at: usize) -> Option<&mut Value> {
        let (symbol, at) = self.owner(symbol, at);
        let (symbol, at, path) = match &self.stacks[symbol.0 as usize].get(at)?.held {
            Held::Item(array, at, path) => (*array, *at as usize, Some(Rc::clone(path))),
            _ => (symbol, at, None),
        };
        match (&mut self.stacks[symbol.0 as usize].get_mut(at)?.held, path) {
            (Held::Value(value), None) => Some(value),
            (Held::Value(array), Some(path)) => array.item_mut(&path)?.as_mut(),
            _ => None,
        }
    }

    /// True if a name is bound in the innermost scope, as its own or as a parameter.
    pub(super) fn is_local(&self, symbol: Symbol) -> bool {
        if let Some((name, depth)) = self.in_scope(symbol) {
            return depth == self.depth() && self.bound_at(name, depth).is_some();
        }
        let stack = self.stacks.get(symbol.0 as usize);
        stack.is_some_and(|stack| stack.last().is_some_and(|last| last.depth == self.depth()))
    }

    /// The binding at the end of a chain of aliases: it holds the value or refers to the item of an array.
    fn owner(&self, mut symbol: Symbol, mut at: usize) -> (Symbol, usize) {
        while let Some(&Binding {
            held: Held::Alias(target, index),
            ..
        }) = self.stacks[symbol.0 as usize].get(at)
        {
            (symbol, at) = (target, index as usize);
        }
        (symbol, at)
    }

    /// `#declare`: assigns to the current binding of the name, or makes a global one.
    pub(super) fn declare(&mut self, symbol: Symbol, value: Value) {
        match self.get_mut(symbol) {
            Some(old) => *old = value,
            None => {
                let (name, depth) = self.in_scope(symbol).unwrap_or((symbol, 0));
                self.bind(name, depth, Held::Value(value));
            }
        }
    }

    /// `#declare` of a number for a name that holds one of its own; false, without effect, for any other name.
    #[inline]
    pub(super) fn declare_over(&mut self, symbol: Symbol, number: &Number) -> bool {
        let stack = self.stacks.get_mut(symbol.0 as usize);
        match stack.and_then(|stack| stack.last_mut()) {
            Some(Binding {
                held: Held::Value(Value::Number(old)),
                ..
            }) => {
                *old = *number;
                true
            }
            _ => false,
        }
    }

    /// `#local`: assigns to the innermost scope's binding, or makes one there.
    #[inline]
    pub(super) fn local(&mut self, symbol: Symbol, value: Value) {
        if !self.qualified.is_empty() && self.is_qualified(symbol) {
            return self.declare(symbol, value);
        }
        let depth = self.depth();
        if depth > 0
            && let Some(stack) = self.stacks.get_mut(symbol.0 as usize)
        {
            // Nearly always the name is new in the scope, or holds a value of its own there.
            match stack.last_mut() {
                Some(Binding {
                    depth: known,
                    held: Held::Value(old),
                }) if *known == depth => {
                    *old = value;
                    return;
                }
                Some(last) if last.depth >= depth => {}
                _ => {
                    let held = Held::Value(value);
                    stack.push(Binding { depth, held });
                    self.bound.push(symbol);
                    return;
                }
            }
        }
        self.local_among_others(symbol, value);
    }

    #[inline(never)]
    fn local_among_others(&mut self, symbol: Symbol, value: Value) {
        let depth = self.depth();
        let is_ours =
            |stack: &Vec<Binding>| stack.last().is_some_and(|binding| binding.depth == depth);
        if self.stacks.get(symbol.0 as usize).is_some_and(is_ours) {
            self.declare(symbol, value);
        } else {
            self.bind(symbol, depth, Held::Value(value));
        }
    }

    /// `#declare` or `#local` of a name that was read with `depth` scopes open, while the value ended in an inner one:
    /// bindings further in belong to other names.
    pub(super) fn assign_from(&mut self, depth: u32, symbol: Symbol, value: Value, is_local: bool) {
        if let Some(&Qualified { name, is_local, .. }) = self.qualified.get(&symbol) {
            let depth = if is_local { depth } else { 0 };
            return self.assign_from(depth, name, value, true);
        }
        let is_it = |binding: &Binding| match is_local {
            true => binding.depth == depth,
            false => binding.depth <= depth,
        };
        let stack = self.stacks.get(symbol.0 as usize);
        let known = stack.and_then(|stack| stack.iter().rposition(is_it));
        match known.and_then(|at| self.held_mut(symbol, at)) {
            Some(old) => *old = value,
            None => self.bind(symbol, if is_local { depth } else { 0 }, Held::Value(value)),
        }
    }

    /// Binds a macro parameter in the innermost scope to the binding that `target` had before that scope opened.
    pub(super) fn alias(&mut self, symbol: Symbol, target: Target) {
        let depth = self.depth();
        let at = u32::try_from(target.at).expect("stacks of bindings are short");
        let held = if target.path.is_empty() {
            Held::Alias(target.symbol, at)
        } else {
            Held::Item(target.symbol, at, target.path.into())
        };
        self.bind(symbol, depth, held);
    }

    /// The index of the current binding of a symbol in its stack.
    pub(super) fn top(&self, symbol: Symbol) -> Option<usize> {
        self.stacks.get(symbol.0 as usize)?.len().checked_sub(1)
    }

    /// The target of an alias made now.
    pub(super) fn target(&self, symbol: Symbol) -> Option<Target> {
        let (symbol, at) = self.binding(symbol)?;
        let (symbol, at) = self.owner(symbol, at);
        Some(match &self.stacks[symbol.0 as usize].get(at)?.held {
            Held::Item(array, at, path) => Target {
                symbol: *array,
                at: *at as usize,
                path: path.to_vec(),
            },
            _ => Target {
                symbol,
                at,
                path: Vec::new(),
            },
        })
    }

    /// The same for an item of the array that the name holds.
    pub(super) fn target_of_item(&self, symbol: Symbol, path: &[usize]) -> Option<Target> {
        let mut target = self.target(symbol)?;
        target.path.extend_from_slice(path);
        Some(target)
    }

    fn bind(&mut self, symbol: Symbol, depth: u32, held: Held) {
        let index = symbol.0 as usize;
        if self.stacks.len() <= index {
            self.stacks.resize_with(index + 1, Vec::new);
        }
        let innermost = self.open.len();
        let stack = &mut self.stacks[index];
        if depth > 0
            && depth as usize == innermost
            && stack.last().is_none_or(|last| last.depth <= depth)
        {
            stack.push(Binding { depth, held });
            self.bound.push(symbol);
            return;
        }
        let at = stack
            .iter()
            .rposition(|binding| binding.depth <= depth)
            .map_or(0, |i| i + 1);
        stack.insert(at, Binding { depth, held });
        if at + 1 < stack.len() {
            self.shift_aliases(symbol, at);
        }
        if depth > 0 {
            let inner = self.open.get_mut(depth as usize..).unwrap_or_default();
            let end = inner.first().copied().unwrap_or(self.bound.len());
            inner.iter_mut().for_each(|start| *start += 1);
            self.bound.insert(end, symbol);
        }
    }

    /// Adjusts aliases after a binding was inserted below others of its symbol: their targets have moved up.
    fn shift_aliases(&mut self, moved: Symbol, from: usize) {
        for binding in self.stacks.iter_mut().flatten() {
            if let Held::Alias(symbol, at) | Held::Item(symbol, at, _) = &mut binding.held
                && *symbol == moved
                && *at as usize >= from
            {
                *at += 1;
            }
        }
    }

    /// `#undef`: removes the current binding of the name; true if there was one.
    pub(super) fn undefine(&mut self, symbol: Symbol) -> bool {
        if let Some((name, depth)) = self.in_scope(symbol) {
            let stack = self.stacks.get_mut(name.0 as usize);
            return stack.is_some_and(|stack| {
                let at = stack.iter().position(|binding| binding.depth == depth);
                at.map(|at| stack.remove(at)).is_some()
            });
        }
        self.stacks
            .get_mut(symbol.0 as usize)
            .and_then(Vec::pop)
            .is_some()
    }

    /// Symbols that have a value now.
    pub(super) fn defined(&self) -> impl Iterator<Item = Symbol> + '_ {
        let filled = |(index, stack): (usize, &Vec<Binding>)| {
            (!stack.is_empty()).then(|| Symbol(u32::try_from(index).unwrap_or(u32::MAX)))
        };
        self.stacks.iter().enumerate().filter_map(filled)
    }
}
