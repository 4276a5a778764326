//! Textures that are selected by a pattern: `texture_map`, lists after `checker` and similar patterns, `tiles`,
//! `material_map`.

use super::version_2::{FIRST_WITH_BLOCKS, begins_part};
use super::{Layer, Texture, read_pattern};
use crate::base::args::{Args, Parse, Word, declared};
use crate::base::bitmap;
use crate::base::math::Step;
use crate::base::source::{Diagnostic, Span};
use crate::base::word::Class;
use crate::scene::pattern::{self, Blend, Keys, Map, Modifiers, Pattern};
use std::sync::Arc;

/// A pattern that selects among textures.
#[derive(Clone, Debug)]
pub struct Patterned {
    /// The location of the pattern's word, for messages.
    pub at: Span,
    /// The word that begins the pattern.
    pub word: Word,
    /// The selector and its textures.
    pub kind: PatternedKind,
    /// Transforms, warps, turbulence and waves.
    pub modifiers: Modifiers,
    /// `no_bump_scale`: true if scaling the pattern leaves the height of bumps unchanged.
    pub has_no_bump_scale: bool,
}

/// The selector of a texture, with the textures that it selects from.
#[derive(Clone, Debug)]
pub enum PatternedKind {
    /// A pattern; the map is `None` until it is read.
    Map(Box<dyn Pattern>, Option<Map<Texture>>),
    /// The weighted mean of textures; `None` until the map is read.
    Average(Option<Map<Texture>>),
    /// Two textures as alternating tiles.
    Tiles(Arc<[Texture; 2]>),
    /// One texture at the texture coordinates of the surface.
    Uv(Arc<Texture>),
    /// `material_map`: the pixels of an image; each value selects a texture.
    Material(bitmap::MappedBitmap, Arc<[Texture]>),
}

impl Patterned {
    /// Reads a patterned texture up to its map; `None` if `word` does not begin one.
    pub(super) fn begin(word: Word, args: &mut dyn Args, default: &Layer) -> Parse<Option<Self>> {
        let at = args.span();
        let kind = match word {
            Word::Average => {
                args.accept(word)?;
                PatternedKind::Average(None)
            }
            Word::UvMapping => {
                while args.accept(word)? {}
                PatternedKind::Uv(Arc::new(Texture::entry(args, default)?))
            }
            Word::Tiles => {
                args.accept(word)?;
                PatternedKind::Tiles(Arc::new(tiles(args, default)?))
            }
            Word::MaterialMap => {
                args.accept(word)?;
                let picture = bitmap::read(args, bitmap::Purpose::Textures)?;
                PatternedKind::Material(picture, materials(args, default)?.into())
            }
            _ => {
                let Some(pattern) = read_pattern(word, args)? else {
                    return Ok(None);
                };
                let has_open_block = pattern.has_open_block();
                let list = pattern
                    .has_list()
                    .then(|| texture_list(&*pattern, args, default));
                let list = list.transpose()?;
                if has_open_block {
                    args.close()?;
                }
                PatternedKind::Map(pattern, list)
            }
        };
        Ok(Some(Patterned {
            at,
            word,
            kind,
            modifiers: Modifiers::default(),
            has_no_bump_scale: false,
        }))
    }

    /// Reads a modifier of the pattern or its map; false if none is next.
    pub(super) fn read_item(&mut self, args: &mut dyn Args, default: &Layer) -> Parse<bool> {
        let Some(word) = args.word()? else {
            return Ok(false);
        };
        if word == Word::NoBumpScale {
            self.has_no_bump_scale = args.accept(word)?;
            return Ok(true);
        }
        if self.modifiers.read(word, args)? {
            return Ok(true);
        }
        let (keys, map) = match &mut self.kind {
            PatternedKind::Map(pattern, _) if word != Word::TextureMap || pattern.has_list() => {
                return pattern.read_modifier(word, args);
            }
            PatternedKind::Map(_, map) => (Keys::Positions, map),
            PatternedKind::Average(map) if word == Word::TextureMap => (Keys::Weights, map),
            _ => return Ok(false),
        };
        args.accept(word)?;
        *map = Some(Texture::read_map(keys, args, default)?);
        Ok(true)
    }

    /// An error if the map is missing.
    pub(super) fn check(&self, args: &mut dyn Args) -> Parse<()> {
        match &self.kind {
            PatternedKind::Map(_, None) | PatternedKind::Average(None) => {
                Err(args.expected(&format!("`texture_map` after `{}`", self.word)))
            }
            PatternedKind::Map(pattern, _) => pattern.check(args),
            _ => Ok(()),
        }
    }

    /// Sets `no_bump_scale` on all entries if the pattern has it, except those of `material_map`, which have their own
    /// (measured with POV-Ray).
    pub(super) fn spread_no_bump_scale(&mut self) {
        if !self.has_no_bump_scale {
            return;
        }
        let without_bump_scale = |texture: &Texture| {
            let mut texture = texture.clone();
            texture.set_no_bump_scale();
            texture
        };
        match &mut self.kind {
            PatternedKind::Map(_, map) | PatternedKind::Average(map) => {
                *map = map.as_ref().map(|map| map.map(without_bump_scale));
            }
            PatternedKind::Tiles(two) => {
                *two = Arc::new([without_bump_scale(&two[0]), without_bump_scale(&two[1])])
            }
            PatternedKind::Uv(mapped) => *mapped = Arc::new(without_bump_scale(mapped)),
            PatternedKind::Material(..) => {}
        }
    }

    /// The textures that can be selected.
    #[must_use]
    pub fn textures(&self) -> Vec<&Texture> {
        match &self.kind {
            PatternedKind::Map(_, None) | PatternedKind::Average(None) => Vec::new(),
            PatternedKind::Map(_, Some(map)) | PatternedKind::Average(Some(map)) => {
                map.entries().iter().map(|entry| &entry.1).collect()
            }
            PatternedKind::Tiles(two) => two.iter().collect(),
            PatternedKind::Uv(mapped) => vec![mapped],
            PatternedKind::Material(_, textures) => textures.iter().collect(),
        }
    }

    /// Transforms the pattern and all its textures.
    pub(super) fn transform(&mut self, step: &Step) {
        self.modifiers.chain.push(step);
    }
}

impl Texture {
    /// Reads `texture_map { ... }` after its word.
    ///
    /// # Errors
    /// A malformed entry, or no entry.
    pub fn read_map(keys: Keys, args: &mut dyn Args, default: &Layer) -> Parse<Map<Texture>> {
        Map::read("texture_map", keys, Blend::refuse, args, &mut |args| {
            Texture::entry(args, default)
        })
    }

    /// Reads an entry of a map: a texture without braces.
    fn entry(args: &mut dyn Args, default: &Layer) -> Parse<Texture> {
        let mut texture = Texture::begin(args, default)?;
        while texture.read_item(args, default)? {}
        texture.checked(args)
    }

    /// Reads a name or the start of a patterned texture; the default texture otherwise.
    pub(super) fn begin(args: &mut dyn Args, default: &Layer) -> Parse<Texture> {
        if let Some(known) = declared::<Texture>(args)? {
            return Ok(Texture::clone(&known));
        }
        let mut texture = Texture::from(default.clone());
        let mut has_no_bump_scale = false;
        while args.accept(Word::NoBumpScale)? {
            has_no_bump_scale = true;
        }
        if let Some(word) = args.word()?
            && !matches!(word, Word::BumpMap | Word::ImageMap)
            && !begins_part(word, args.version())
        {
            texture.pattern = Patterned::begin(word, args, default)?.map(Box::new);
            if texture.pattern.is_none() && pattern::is_pattern(word) {
                return Err(crate::base::args::not_built(args, word));
            }
            if texture.pattern.is_none() && args.version() >= FIRST_WITH_BLOCKS {
                skip_modifiers(args)?;
            }
        }
        if has_no_bump_scale {
            texture.set_no_bump_scale();
        }
        Ok(texture)
    }
}

/// Reads modifiers of a pattern without a pattern: they have no effect, and nothing else may follow.
fn skip_modifiers(args: &mut dyn Args) -> Parse<()> {
    let at = args.span();
    let mut unused = Modifiers::default();
    let mut has_any = false;
    while let Some(word) = args.word()?
        && (has_any || word.class() != Class::Transform)
        && unused.read(word, args)?
    {
        has_any = true;
    }
    if !has_any {
        return Ok(());
    }
    if args.word()?.is_some() {
        return Err(args.expected("a modifier of a pattern or `}` in `texture`"));
    }
    let at = at.to(args.last_span());
    let message = "modifiers of a pattern have no effect in a texture without a pattern";
    args.warn(Diagnostic::warning(at, message));
    Ok(())
}

/// Reads `{ texture { ... } tile2 texture { ... } }`.
fn tiles(args: &mut dyn Args, default: &Layer) -> Parse<[Texture; 2]> {
    args.open()?;
    let first = next_texture(args, default)?;
    if !args.accept(Word::Tile2)? {
        return Err(args.expected("`tile2` in `tiles`"));
    }
    let second = next_texture(args, default)?;
    args.close()?;
    Ok([first, second])
}

/// Reads the textures after an image, up to the end of the block that the image has opened.
fn materials(args: &mut dyn Args, default: &Layer) -> Parse<Vec<Texture>> {
    let mut textures = vec![next_texture(args, default)?];
    while !args.accept_close()? {
        textures.push(next_texture(args, default)?);
    }
    Ok(textures)
}

fn next_texture(args: &mut dyn Args, default: &Layer) -> Parse<Texture> {
    if args.accept(Word::Texture)? {
        Texture::read(args, default)
    } else {
        Err(args.expected("`texture`"))
    }
}

/// Reads the list of textures of a pattern. Missing textures are the default texture.
fn texture_list(
    pattern: &dyn Pattern,
    args: &mut dyn Args,
    default: &Layer,
) -> Parse<Map<Texture>> {
    let stops = pattern.default_map().iter();
    let mut entries: Vec<_> = stops
        .map(|&(at, _)| (at, Texture::from(default.clone())))
        .collect();
    for (_, slot) in &mut entries {
        if !args.accept(Word::Texture)? {
            break;
        }
        *slot = Texture::read(args, default)?;
        args.comma()?;
    }
    Map::new(entries).ok_or_else(|| args.expected("`texture`"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Parse<Texture> {
        let known = Texture::from(Layer::default());
        let mut args = TextArgs::new(text).with("T", known);
        Texture::read(&mut args, &Layer::default())
    }

    #[test]
    fn patterns_select_textures_by_maps_and_lists() {
        for text in [
            "{ gradient <1,0,0> texture_map { [0 T] [1 T scale 2] } scale 2 turbulence 1 }",
            "{ gradient <1,0,0> texture_map { [0 pigment { rgb 1 } finish { phong 1 }] [1 T] } }",
            "{ wood texture_map { [0 checker texture { T } texture { T } scale 2] [1 T] } }",
            "{ checker texture { T }, texture { T } scale 3 }",
            "{ checker texture { T } }",
            "{ checker }",
            "{ brick texture { T } texture { T } mortar 0.2 }",
            "{ average texture_map { [T] [2 T] } no_bump_scale }",
            "{ tiles { texture { T } tile2 texture { T } } scale 2 }",
            "{ uv_mapping T scale 2 }",
            "{ uv_mapping pigment { rgb 1 } finish { phong 1 } }",
            "{ uv_mapping gradient <1,0,0> texture_map { [0 T] [1 uv_mapping T] } scale 2 }",
        ] {
            assert!(read(text).unwrap().is_patterned(), "{text}");
        }
    }

    /// POV-Ray refuses each of these.
    #[test]
    fn malformed_textures_are_refused() {
        for text in [
            "{ gradient <1,0,0> }",
            "{ gradient <1,0,0> color_map { [0 rgb 1] } }",
            "{ gradient <1,0,0> texture_map { [0 texture { T }] } }",
            "{ gradient <1,0,0> texture_map { [0 T T] } }",
            "{ gradient <1,0,0> texture_map { [0 T] } pigment { rgb 1 } }",
            "{ pigment { rgb 1 } gradient <1,0,0> texture_map { [0 T] } }",
            "{ T gradient <1,0,0> texture_map { [0 T] } }",
            "{ texture_map { [0 T] } }",
            "{ checker T T }",
            "{ tiles { texture { T } } }",
            "{ average }",
            "{ uv_mapping texture { T } }",
            "{ pigment { rgb 1 } uv_mapping }",
            "{ T uv_mapping }",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn parameters_of_patterns_are_checked_together() {
        let error =
            read("{ pavement pattern 2 texture_map { [0 T] } }").expect_err("no such pattern");
        assert_eq!(
            error.message,
            "`pattern` of 1 tiles with 3 sides is 1 to 1, found 2"
        );
    }
}
