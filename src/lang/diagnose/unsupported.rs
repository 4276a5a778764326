//! Parts of textures that cannot be drawn: errors at their location, but only if their effect would be visible.

use crate::base::source::{Diagnostic, Span};
use crate::lang::reader::Reader;
use crate::scene::texture::{Finish, NormalKind, Patterned, Texture};
use crate::scene::{Kind, Object};
use rustc_hash::FxHashSet;
use std::sync::Arc;

impl Reader<'_> {
    /// Records the textures of the whole scene that cannot be drawn, each once.
    pub(crate) fn note_unsupported(&mut self) {
        let mut opaque = Vec::new();
        let mut parts = Vec::new();
        let has_subsurface = self.draft.globals.subsurface.is_some();
        // Copies share their parts, which are visited once.
        let mut seen = FxHashSet::default();
        let mut open: Vec<&Arc<Object>> = self.draft.objects.whole().collect();
        let mut last = None;
        for texture in self.draft.objects.textures_of_plain() {
            if last.replace(Arc::as_ptr(texture)) != Some(Arc::as_ptr(texture)) {
                for texture in all_textures(texture) {
                    if has_subsurface {
                        opaque.extend(opaque_below(texture));
                    }
                    parts.extend(normals_without_pattern(texture));
                }
            }
        }
        if has_subsurface {
            let mut last = None;
            for finish in self.draft.objects.finishes_of_plain() {
                if last.replace(Arc::as_ptr(finish)) != Some(Arc::as_ptr(finish)) {
                    opaque.extend(opaque_medium(finish));
                }
            }
        }
        while let Some(object) = open.pop() {
            let is_shared = Arc::strong_count(object) > 1;
            if is_shared && !seen.insert(Arc::as_ptr(object).addr()) {
                continue;
            }
            for texture in object.textures() {
                for texture in all_textures(&texture.what) {
                    if has_subsurface {
                        opaque.extend(opaque_below(texture));
                    }
                    parts.extend(normals_without_pattern(texture));
                }
            }
            match &object.kind {
                Kind::Shape(_) => {}
                Kind::Light { looks_like, .. } => open.extend(looks_like),
                Kind::Csg { children, .. } => open.extend(&**children),
            }
        }
        for at in in_order(opaque) {
            let error = Diagnostic::error(
                at,
                "this `subsurface` lets no light in: a `translucency` of 0",
            );
            let hint = "Write more than 0 for red, green and blue. With `+Q8` the scene is drawn without it.";
            self.report.undrawn.push(error.with_hint(hint));
        }
        for at in in_order(parts) {
            self.record(
                Diagnostic::error(at, "this `normal` has no pattern")
                    .with_hint("Write `normal { bumps 0.5 }`, or the name of another pattern."),
            );
        }
    }
}

/// Removes duplicates, in the order of the files.
fn in_order(mut spans: Vec<Span>) -> Vec<Span> {
    spans.sort_by_key(|at| (at.file, at.start));
    spans.dedup();
    spans
}

/// A texture and all textures it selects from.
fn all_textures(texture: &Texture) -> Vec<&Texture> {
    let mut all = vec![texture];
    let mut at = 0;
    while let Some(next) = all.get(at) {
        let chosen = next.pattern().map(Patterned::textures);
        all.extend(chosen.into_iter().flatten());
        at += 1;
    }
    all
}

fn normals_without_pattern(texture: &Texture) -> impl Iterator<Item = Span> {
    let normals = texture.layers().iter().flat_map(|layer| &layer.normal);
    let normals = normals.filter(|normal| matches!(normal.kind, NormalKind::None));
    normals.map(|normal| normal.at)
}

/// The layers that scatter light below the surface in a medium without translucency.
fn opaque_below(texture: &Texture) -> impl Iterator<Item = Span> {
    let layers = texture.layers().iter();
    layers.filter_map(|layer| opaque_medium(&layer.finish))
}

/// The location of the medium of a finish, if it has no translucency in some channel.
fn opaque_medium(finish: &Finish) -> Option<Span> {
    let subsurface = finish.subsurface?;
    let passes = |path: f64| path > 0.0;
    let is_opaque = !subsurface.translucency.channels().into_iter().all(passes);
    is_opaque.then_some(subsurface.at)
}
