//! Lints: doubts about scenes that can be drawn, which `povr check` reports as warnings. Each has a name, the code of
//! its warning. `--allow NAME` switches it off, and so does a comment `// povr: allow NAME` in the scene.
//!
//! Doubts about the language are raised by the reader; those here need the finished scene. Scenes whose view takes too
//! long to examine are left alone.

mod candidates;
mod material;
mod view;

use crate::base::options::CancelToken;
use crate::base::source::{Code, Diagnostic, Span};
use crate::lang::ObjectSpan;
use crate::scene::{Object, Scene};
use std::sync::Arc;

/// An object of the scene and its position in the text.
struct Located {
    object: Arc<Object>,
    span: Option<Span>,
    /// True if it took the default texture, which the scene has not set.
    has_stock_texture: bool,
}

/// The doubts about a scene, of whose objects the reader has noted the spans. When cancelled, the first of them, none
/// of them about the view.
#[must_use]
pub fn doubts(scene: &Scene, object_spans: &[ObjectSpan], stop: &CancelToken) -> Vec<Diagnostic> {
    let goes_on = |_: &Located| !stop.is_cancelled();
    let mut doubts = material::doubts(scene, located(scene, object_spans).take_while(goes_on));
    if view::is_examined(scene) {
        let located = located(scene, object_spans).take_while(goes_on);
        doubts.extend(view::doubts(scene, located, stop));
    }
    doubts
}

impl Located {
    /// True if both have one and the same texture.
    fn has_texture_of(&self, other: &Located) -> bool {
        let (Some(a), Some(b)) = (&self.object.texture, &other.object.texture) else {
            return false;
        };
        let colors = (a.what.bare(), b.what.bare());
        Arc::ptr_eq(&a.what, &b.what) || matches!(colors, (Some((a, _)), Some((b, _))) if a == b)
    }
}

/// The objects of a scene, one after the other: in a large one they take much memory.
fn located(scene: &Scene, object_spans: &[ObjectSpan]) -> impl Iterator<Item = Located> {
    let objects = scene.objects.iter().enumerate();
    objects.map(|(index, object)| {
        let known = ObjectSpan::of(object_spans, index);
        let stock = known.and_then(|known| known.stock_texture.as_ref());
        let own = object.texture.as_ref().map(|texture| &texture.what);
        Located {
            span: known.map(|known| known.span),
            has_stock_texture: stock.zip(own).is_some_and(|(a, b)| Arc::ptr_eq(a, b)),
            object,
        }
    })
}

/// A doubt of a kind, with a remedy.
fn doubt(code: Code, span: Option<Span>, message: &str, hint: &str) -> Diagnostic {
    Diagnostic::warning(span, message)
        .with_code(code)
        .with_hint(hint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::options::ReadOptions;
    use crate::base::source::Sources;
    use crate::lang::evaluate;

    #[test]
    fn a_cancelled_search_ends_without_doubts() {
        let mut sources = Sources::new(Vec::new());
        let scene = "camera { location -5*z look_at -9*z } sphere { 0, 1 pigment { rgb 1 } }";
        let file = sources.add_text("scene", scene.as_bytes());
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        let scene = reading.scene.expect("it is right");
        let stop = CancelToken::default();
        let result = doubts(&scene, &reading.object_spans, &stop);
        assert!(
            result
                .iter()
                .any(|one| one.code == Some(Code::NothingInView))
        );
        stop.cancel();
        assert!(doubts(&scene, &reading.object_spans, &stop).is_empty());
    }
}
