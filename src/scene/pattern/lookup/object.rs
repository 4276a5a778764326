//! `object`: the first entry outside an object, the second inside.

use crate::base::args::{AnyObject, Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::derived::Derived;
use crate::scene::pattern::{
    Pattern, PatternEval, PrepareContext, Solid, Stop, SurfacePoint, Wave,
};
use glam::DVec3;
use std::sync::Arc;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 2] = [
    (0.0, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
];

#[derive(Clone, Debug)]
struct ObjectPattern {
    object: Arc<dyn AnyObject + Send + Sync>,
    /// The object prepared for inside tests, once for all copies of the pattern.
    solid: Arc<Derived<Option<Arc<dyn Solid>>>>,
}

#[derive(Debug)]
struct Prepared(Option<Arc<dyn Solid>>);

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    args.open()?;
    let object = args.transformed_object_any()?;
    Ok(Box::new(ObjectPattern {
        object,
        solid: Arc::default(),
    }))
}

impl Pattern for ObjectPattern {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        let solid = self.solid.get_or_init(|| {
            let prepare = context.settings.solid_of?;
            prepare(&self.object)
        });
        Box::new(Prepared(solid.clone()))
    }

    fn default_map(&self) -> &'static [Stop] {
        &COLORS
    }

    fn default_wave(&self) -> Wave {
        Wave::NONE
    }

    fn has_list(&self) -> bool {
        true
    }

    fn has_open_block(&self) -> bool {
        true
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let is_inside = self.0.as_ref().is_some_and(|solid| solid.contains(point));
        f64::from(u8::from(is_inside))
    }
}
