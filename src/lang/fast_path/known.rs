//! Values of identifiers in literals, from the scopes of the run or from a map of earlier look-ups.
//!
//! Nothing is declared while literals are read. So a value that the scopes gave once is valid to the end of the data,
//! and threads without access to the scopes can use it.

use crate::lang::expr::value::Value;
use crate::lang::scope::Scopes;
use crate::lang::syntax::Names;
use crate::scene::Object;
use rustc_hash::FxHashMap;
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// A value that literals accept by name.
#[derive(Clone, Debug)]
pub(crate) enum KnownValue {
    Object(Arc<Object>),
    /// A texture, finish, camera, ...
    Element(Arc<dyn Any + Send + Sync>),
}

/// Values by the spelling of their identifier.
pub(crate) type NotedValues = FxHashMap<String, KnownValue>;

/// The source of these values.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Known<'a> {
    /// The scopes of the run; values are noted for other threads.
    Scopes(&'a Names, &'a Scopes, &'a RefCell<NotedValues>),
    /// The values noted before.
    Noted(&'a NotedValues),
}

impl Known<'_> {
    /// The value of an identifier, if literals accept it and it is known.
    pub(crate) fn get(self, spelling: &str) -> Option<KnownValue> {
        let (names, scopes, noted) = match self {
            Known::Noted(noted) => return noted.get(spelling).cloned(),
            Known::Scopes(names, scopes, noted) => (names, scopes, noted),
        };
        let held = match scopes.get(names.symbol(spelling)?)? {
            Value::Object(object) => KnownValue::Object(Arc::clone(object)),
            Value::Element(element) => KnownValue::Element(Arc::clone(&element.value)),
            _ => return None,
        };
        let mut noted = noted.borrow_mut();
        if !noted.contains_key(spelling) {
            noted.insert(spelling.to_owned(), held.clone());
        }
        Some(held)
    }
}
