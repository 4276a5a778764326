//! What identifiers hold, for literals: found in the scopes of the run, or among what these have told before.
//!
//! While literals are read nothing is declared. So what the scopes have told once stays true to the end of the data, and
//! threads that have no scopes can go by it.

use crate::lang::expr::value::Value;
use crate::lang::scope::Scopes;
use crate::lang::syntax::Names;
use crate::scene::Object;
use rustc_hash::FxHashMap;
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// What an identifier can hold that literals take.
#[derive(Clone, Debug)]
pub(crate) enum Held {
    Object(Arc<Object>),
    /// A texture, finish, camera, ...
    Element(Arc<dyn Any + Send + Sync>),
}

/// Identifiers by their spelling, and what they hold.
pub(crate) type Told = FxHashMap<String, Held>;

/// Where literals find what identifiers hold.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Known<'a> {
    /// In the scopes of the run; it is noted for later.
    Scopes(&'a Names, &'a Scopes, &'a RefCell<Told>),
    /// Among what was noted.
    Told(&'a Told),
}

impl Known<'_> {
    /// What an identifier holds, if literals take it and it is known.
    pub(crate) fn get(self, spelling: &str) -> Option<Held> {
        let (names, scopes, told) = match self {
            Known::Told(told) => return told.get(spelling).cloned(),
            Known::Scopes(names, scopes, told) => (names, scopes, told),
        };
        let held = match scopes.get(names.symbol(spelling)?)? {
            Value::Object(object) => Held::Object(Arc::clone(object)),
            Value::Element(element) => Held::Element(Arc::clone(&element.value)),
            _ => return None,
        };
        let mut told = told.borrow_mut();
        if !told.contains_key(spelling) {
            told.insert(spelling.to_owned(), held.clone());
        }
        Some(held)
    }
}
