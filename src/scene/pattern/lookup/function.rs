//! `function { ... }`: the value of a user function at the point.

use crate::base::args::{Args, Parse};
use crate::scene::function::{self, Function};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use std::sync::Arc;

#[derive(Clone, Debug)]
struct FunctionPattern {
    function: Arc<Function>,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(FunctionPattern {
        function: function::read_of_point(args)?,
    }))
}

impl Pattern for FunctionPattern {
    fn prepare(&self, _: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }
}

impl PatternEval for FunctionPattern {
    fn value(&self, point: DVec3, _: &SurfacePoint) -> f64 {
        let value = self.function.eval(&point.to_array());
        if value > 1.0 { value % 1.0 } else { value }
    }
}
