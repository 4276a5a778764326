//! `potential`: the field of a blob, or the function of an isosurface, at the point; since version 3.8.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint, Wave};
use glam::DVec3;
use std::fmt::Debug;
use std::sync::Arc;

/// The field of which an object is an isosurface.
pub trait Field: Debug + Send + Sync {
    /// The field at a point in the space around the object.
    fn value(&self, point: DVec3) -> f64;
    /// The value on the surface of the object.
    fn threshold(&self) -> f64;
}

#[derive(Clone, Debug)]
struct Potential {
    field: Arc<dyn Field>,
    /// Subtracted from the field.
    offset: f64,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    args.open()?;
    let at = args.span();
    let field = args.field_any()?.downcast::<Arc<dyn Field>>();
    args.close()?;
    match field {
        Ok(field) => Ok(Box::new(Potential {
            field: Arc::clone(&field),
            offset: 0.0,
        })),
        Err(_) => {
            let error = Diagnostic::error(at, "`potential` needs a blob or isosurface");
            Err(Box::new(error))
        }
    }
}

impl Pattern for Potential {
    fn prepare(&self, _: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }

    fn default_wave(&self) -> Wave {
        Wave::NONE
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word != Word::Threshold {
            return Ok(false);
        }
        args.accept(word)?;
        let is_subtracted = args.float()? != 0.0;
        self.offset = if is_subtracted {
            self.field.threshold()
        } else {
            0.0
        };
        Ok(true)
    }
}

impl PatternEval for Potential {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _: &SurfacePoint) -> f64 {
        self.field.value(point) - self.offset
    }
}
