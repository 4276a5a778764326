//! Features that a scene uses and the renderer does not support: errors by name, but only if their effect would be
//! visible.

use crate::base::args::Word;
use crate::base::source::{Diagnostic, Span};
use crate::lang::reader::Reader;
use crate::scene::texture::{NormalKind, Patterned, Texture};
use crate::scene::{Kind, Object};
use rustc_hash::FxHashSet;
use std::sync::Arc;

impl Reader<'_> {
    /// Records unsupported features of the objects and the atmosphere of the whole scene, each once.
    pub(crate) fn note_unsupported(&mut self) {
        let mut found = Vec::new();
        let has_subsurface = self.draft.globals.subsurface.is_some();
        let mut parts = Vec::new();
        // Copies share their parts, which are visited once.
        let mut seen = FxHashSet::default();
        let mut open: Vec<&Arc<Object>> = self.draft.objects.whole().collect();
        let mut last = None;
        for texture in self.draft.objects.textures_of_plain() {
            if last.replace(Arc::as_ptr(texture)) != Some(Arc::as_ptr(texture)) {
                for texture in all_textures(texture) {
                    if has_subsurface {
                        found.extend(subsurface_of(texture));
                    }
                    parts.extend(normals_without_pattern(texture));
                }
            }
        }
        if has_subsurface {
            let mut last = None;
            for finish in self.draft.objects.finishes_of_plain() {
                if last.replace(Arc::as_ptr(finish)) != Some(Arc::as_ptr(finish)) {
                    let subsurface = finish.subsurface.iter();
                    found.extend(subsurface.map(|it| (it.at, Word::Subsurface)));
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
                        found.extend(subsurface_of(texture));
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
        for (at, word) in in_order(found) {
            self.record_unsupported(&format!("`{word}`"), at);
        }
        for (at, ()) in in_order(parts) {
            self.record(
                Diagnostic::error(at, "this `normal` has no pattern")
                    .with_hint("Write `normal { bumps 0.5 }`, or the name of another pattern."),
            );
        }
    }
}

/// Removes duplicates, in the order of the files.
fn in_order<T: PartialEq>(mut found: Vec<(Span, T)>) -> Vec<(Span, T)> {
    found.sort_by_key(|(at, _)| (at.file, at.start));
    found.dedup();
    found
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

fn normals_without_pattern(texture: &Texture) -> impl Iterator<Item = (Span, ())> {
    let normals = texture.layers().iter().flat_map(|layer| &layer.normal);
    let normals = normals.filter(|normal| matches!(normal.kind, NormalKind::None));
    normals.map(|normal| (normal.at, ()))
}

fn subsurface_of(texture: &Texture) -> Option<(Span, Word)> {
    let mut layers = texture.layers().iter();
    let subsurface = layers.find_map(|layer| layer.finish.subsurface)?;
    Some((subsurface.at, Word::Subsurface))
}
