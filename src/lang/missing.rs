//! What a scene uses and povr does not draw: refused by name where it is drawn, but only if it would be seen.

use super::reader::Reader;
use crate::args::Word;
use crate::interior::Interior;
use crate::scene::{Kind, Object};
use crate::source::Span;
use crate::texture::Texture;
use rustc_hash::FxHashSet;
use std::sync::Arc;

impl Reader<'_> {
    /// Tells what the objects and the air of the whole scene ask for and do not get. Each thing is told once.
    pub(super) fn note_missing(&mut self) {
        let mut found = Vec::new();
        found.extend(
            self.atmosphere
                .media
                .iter()
                .map(|media| (media.at, Word::Media)),
        );
        let has_subsurface = self.globals.subsurface.is_some();
        // Copies share their parts, which need to be looked at once.
        let mut seen = FxHashSet::default();
        let mut open: Vec<(&Arc<Object>, bool)> =
            self.objects.iter().map(|object| (object, false)).collect();
        while let Some((object, is_hollow)) = open.pop() {
            let is_hollow = object.flags.hollow.unwrap_or(is_hollow);
            let is_shared = Arc::strong_count(object) > 1;
            if is_shared && !seen.insert((Arc::as_ptr(object).addr(), is_hollow)) {
                continue;
            }
            if let Some(interior) = &object.interior {
                found.extend(media_of(interior, is_hollow));
            }
            if has_subsurface {
                let textures = [&object.texture, &object.interior_texture];
                let textures = textures.into_iter().flatten();
                found.extend(textures.filter_map(|texture| subsurface_of(&texture.what)));
            }
            match &object.kind {
                Kind::Shape(_) => {}
                Kind::Light { looks_like, .. } => {
                    open.extend(looks_like.iter().map(|look| (look, is_hollow)));
                }
                Kind::Csg { children, .. } => {
                    open.extend(children.iter().map(|child| (child, is_hollow)));
                }
            }
        }
        found.sort_by_key(|(at, _)| (at.file, at.start));
        found.dedup();
        for (at, word) in found {
            self.note_undrawn(&format!("`{word}`"), at);
        }
    }
}

/// The media of an interior, which are seen in hollow objects alone.
fn media_of(interior: &Interior, is_hollow: bool) -> impl Iterator<Item = (Span, Word)> {
    let media = interior.media.iter().filter(move |_| is_hollow);
    media.map(|media| (media.at, Word::Media))
}

fn subsurface_of(texture: &Texture) -> Option<(Span, Word)> {
    let mut layers = texture.layers().iter();
    let subsurface = layers.find_map(|layer| layer.finish.subsurface)?;
    Some((subsurface.at, Word::Subsurface))
}
