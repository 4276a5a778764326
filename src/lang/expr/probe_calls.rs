//! `trace` and `inside` in expressions.

use super::value::{Number, Value};
use crate::base::args::Parse;
use crate::base::source::Diagnostic;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene::Object;
use glam::DVec3;
use std::sync::Arc;

impl Reader<'_> {
    /// `object, from, direction [, variable for the normal]` after `trace(`. A miss gives zeros.
    pub(crate) fn trace(&mut self) -> Parse<Number> {
        let object = self.probed_object("trace")?;
        self.take_mark(',')?;
        let from = self.vector3()?;
        self.take_mark(',')?;
        let dir = self.vector3()?;
        let target = if self.take_mark(',')? {
            Some(self.normal_target()?)
        } else {
            None
        };
        let hit = self.probe.trace(&object, from, dir, self.normalization());
        let (point, normal) = hit.unwrap_or((DVec3::ZERO, DVec3::ZERO));
        if let Some(target) = target {
            self.set_normal(&target, Value::Number(Number::vector(normal)))?;
        }
        Ok(Number::vector(point))
    }

    /// `object, point` after `inside(`.
    pub(crate) fn inside(&mut self) -> Parse<Number> {
        let object = self.probed_object("inside")?;
        if !object.is_solid() {
            let error = Diagnostic::error(self.taken_span(), "this object has no inside");
            return Err(self.with_trace(error.with_hint(
                "Triangles, meshes without `inside_vector` and lights have none, nor has what holds one.",
            )));
        }
        self.take_mark(',')?;
        let point = self.vector3()?;
        Ok(Number::truth(self.probe.is_inside(&object, point)))
    }

    fn probed_object(&mut self, function: &str) -> Parse<Arc<Object>> {
        match self.object_of_name()? {
            Some(object) => {
                self.check_probed(&object)?;
                Ok(object)
            }
            None => Err(self.expected_here(&format!("the name of an object in `{function}`"))),
        }
    }

    fn normal_target(&mut self) -> Parse<Target> {
        let what = "the name of a vector that takes the normal";
        if self.peek()?.kind != Kind::Name {
            return Err(self.expected_here(what));
        }
        let symbol = self.identifier(what)?;
        let item = match self.scopes.get(symbol) {
            Some(Value::Array(_)) => Some(self.item_path(symbol)?),
            Some(Value::Poison(why)) => return Err(self.consequence_of(why.as_deref())),
            _ => None,
        };
        let held = self.scopes.get(symbol);
        if !held
            .and_then(|held| held.item(item.as_deref().unwrap_or_default()))
            .is_some_and(is_vector)
        {
            let error = self.error_taken(format!("expected {what}"));
            return Err(Box::new(
                error.with_hint("Declare it before: `#declare Normal = <0, 0, 0>;`."),
            ));
        }
        Ok(Target { symbol, item })
    }

    fn set_normal(&mut self, target: &Target, value: Value) -> Parse<()> {
        self.changes += 1;
        match &target.item {
            None => {
                self.scopes.declare(target.symbol, value);
                Ok(())
            }
            Some(path) => self.set_item(target.symbol, path, value),
        }
    }
}

/// The variable that receives the normal of `trace`: a name, or an item of the array of that name.
struct Target {
    symbol: Symbol,
    item: Option<Vec<usize>>,
}

fn is_vector(value: &Value) -> bool {
    matches!(value, Value::Number(Number { len: 3, .. }))
}
