//! Values that can be called.

use super::value::{Element, Value};
use crate::base::math::Spline;
use crate::scene::function::Function;
use std::sync::Arc;

/// The [`Element`] name of functions.
pub(crate) const FUNCTION: &str = "function";

/// The [`Element`] name of splines.
pub(crate) const SPLINE: &str = "spline";

/// A callable value: an identifier followed by `(` calls it.
pub(crate) enum Callee {
    Function(Arc<Function>),
    Spline(Arc<Spline>),
}

impl Callee {
    /// The function or spline of a value, if it is one.
    pub(crate) fn of(value: &Value) -> Option<Self> {
        let Value::Element(element) = value else {
            return None;
        };
        let any = Arc::clone(&element.value);
        match element.name {
            FUNCTION => any.downcast().ok().map(Callee::Function),
            SPLINE => any.downcast().ok().map(Callee::Spline),
            _ => None,
        }
    }
}

/// True for functions and splines.
pub(crate) fn is_callable(value: &Value) -> bool {
    matches!(value, Value::Element(Element { name, .. }) if [FUNCTION, SPLINE].contains(name))
}
