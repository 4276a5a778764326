//! `normal`: bump mapping as a scene describes it.

use super::read_pattern;
use crate::base::args::{Args, Parse, Word, declared, default_of};
use crate::base::bitmap;
use crate::base::math::Step;
use crate::base::source::Span;
use crate::scene::pattern::{self, Blend, Keys, Map, Modifiers, Pattern, Stop};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The default height of bumps.
const AMOUNT: f64 = 0.5;
/// The default distance between the samples of a pattern's slope.
const ACCURACY: f64 = 0.02;
/// The default size of `facets`.
const FACETS: f64 = 0.1;

/// Bumps on a surface.
#[derive(Clone, Debug)]
pub struct Normal {
    /// The location in the scene file, for messages.
    pub at: Span,
    /// The source of the bumps.
    pub kind: NormalKind,
    /// The height of the bumps.
    pub amount: f64,
    /// The distance between the samples of the pattern's slope, in units of pattern space.
    pub accuracy: f64,
    /// `no_bump_scale`: true if scaling the pattern leaves the height of the bumps unchanged.
    pub has_no_bump_scale: bool,
    /// Transforms, warps, turbulence and waves.
    pub modifiers: Modifiers,
}

/// The source of the bumps of a [`Normal`].
#[derive(Clone, Debug)]
pub enum NormalKind {
    /// None yet; not valid on a surface.
    None,
    /// The values of a pattern.
    Pattern(Box<dyn Pattern>),
    /// The values of a pattern, mapped by a `slope_map` of heights and slopes.
    Slopes(Box<dyn Pattern>, Map<DVec2>),
    /// A pattern that selects among normals.
    Normals(Box<dyn Pattern>, Map<Arc<Normal>>),
    /// The weighted mean of normals; `None` until the map is read.
    Average(Option<Map<Arc<Normal>>>),
    /// The brightness of an image.
    Image(bitmap::MappedBitmap),
    /// Flat faces.
    Facets(Facets),
    /// Other bumps at the texture coordinates of the surface.
    Uv(Arc<Normal>),
}

/// The parameters of `facets`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    /// The size of the faces.
    pub size: f64,
    /// The amount of tilt if faces are found by position; 0 to find them by the surface normal.
    pub coords: f64,
    /// The exponent of the distance metric.
    pub metric: f64,
}

impl Normal {
    /// The numbers of samples along the axes, if it is made of an image or a density file.
    #[must_use]
    pub fn sample_counts(&self) -> Option<DVec3> {
        match &self.kind {
            NormalKind::Image(image) => Some(image.sample_counts()),
            NormalKind::Pattern(pattern)
            | NormalKind::Slopes(pattern, _)
            | NormalKind::Normals(pattern, _) => pattern.sample_counts(),
            NormalKind::Uv(normal) => normal.sample_counts(),
            NormalKind::None | NormalKind::Average(_) | NormalKind::Facets(_) => None,
        }
    }

    /// Reads a normal block after its word. Values that the block does not set are those of `base`.
    ///
    /// # Errors
    /// A malformed value, no pattern, or an unsupported pattern.
    pub fn read(args: &mut dyn Args, base: Option<&Arc<Normal>>) -> Parse<Arc<Normal>> {
        let at = args.last_span();
        args.open()?;
        let mut normal = Normal::begin(args, at, base.map(Arc::as_ref))?;
        while !args.accept_close()? {
            if !normal.read_item(args)? {
                return Err(args.expected("a pattern, a modifier or `}` in `normal`"));
            }
        }
        normal.checked(args)
    }

    /// Reads `normal_map { ... }` after its word.
    ///
    /// # Errors
    /// A malformed entry, or no entry.
    pub fn read_map(keys: Keys, args: &mut dyn Args) -> Parse<Map<Arc<Normal>>> {
        Map::read(
            "normal_map",
            keys,
            Blend::refuse,
            args,
            &mut Normal::read_entry,
        )
    }

    /// Reads `slope_map { [position <height, slope>] ... }` after its word.
    ///
    /// # Errors
    /// A malformed entry, or no entry.
    pub fn read_slopes(args: &mut dyn Args) -> Parse<Map<DVec2>> {
        Map::read(
            "slope_map",
            Keys::Positions,
            Blend::refuse,
            args,
            &mut |args| args.vector2(),
        )
    }

    /// Reads bumps and their height without a block. Other values are those of `base`.
    pub(super) fn read_bare(args: &mut dyn Args, base: Option<&Arc<Normal>>) -> Parse<Arc<Normal>> {
        let at = args.span();
        Normal::begin(args, at, base.map(Arc::as_ref))?.checked(args)
    }

    /// Reads `word`, the next token, with its value if it is a modifier of patterns in general.
    pub(super) fn read_modifier(
        normal: &mut Arc<Normal>,
        word: Word,
        args: &mut dyn Args,
    ) -> Parse<bool> {
        Arc::make_mut(normal).modifiers.read(word, args)
    }

    fn read_entry(args: &mut dyn Args) -> Parse<Arc<Normal>> {
        let at = args.span();
        let base: Option<Arc<Normal>> = default_of(args);
        let mut normal = Normal::begin(args, at, base.as_deref())?;
        while normal.read_item(args)? {}
        normal.checked(args)
    }

    /// Reads an optional name, which replaces `base`, and an optional pattern, or a height alone.
    fn begin(args: &mut dyn Args, at: Span, base: Option<&Normal>) -> Parse<Normal> {
        let known = declared::<Arc<Normal>>(args)?;
        let is_named = known.is_some();
        let mut normal = match (known, base) {
            (Some(known), _) => Normal::clone(&known),
            (None, Some(base)) => base.clone(),
            (None, None) => Normal {
                at,
                kind: NormalKind::None,
                amount: AMOUNT,
                accuracy: ACCURACY,
                has_no_bump_scale: false,
                modifiers: Modifiers::default(),
            },
        };
        normal.at = at;
        if is_named {
            args.comma()?;
        }
        let Some(word) = args.word()? else {
            normal.amount = args.float_or(normal.amount)?;
            return Ok(normal);
        };
        if word == Word::UvMapping {
            while args.accept(word)? {}
            normal.kind = NormalKind::Uv(Normal::read_entry(args)?);
        } else if let Some(kind) = normal.kind.begin(word, args)? {
            normal.kind = kind;
            if let NormalKind::Image(picture) = &normal.kind {
                normal.amount = picture.bump_size.unwrap_or(normal.amount);
            }
            if let NormalKind::Pattern(pattern)
            | NormalKind::Slopes(pattern, _)
            | NormalKind::Normals(pattern, _) = &normal.kind
            {
                normal.modifiers.set_wave(&pattern.default_wave());
            }
            args.comma()?;
            normal.amount = args.float_or(normal.amount)?;
        } else if pattern::is_pattern(word) {
            return Err(crate::base::args::not_built(args, word));
        }
        Ok(normal)
    }

    fn checked(self, args: &mut dyn Args) -> Parse<Arc<Normal>> {
        if matches!(self.kind, NormalKind::Average(None)) {
            return Err(args.expected("`normal_map` after `average`"));
        }
        if let NormalKind::Pattern(pattern)
        | NormalKind::Slopes(pattern, _)
        | NormalKind::Normals(pattern, _) = &self.kind
        {
            pattern.check(args)?;
        }
        Ok(Arc::new(self))
    }

    fn read_item(&mut self, args: &mut dyn Args) -> Parse<bool> {
        let Some(word) = args.word()? else {
            return Ok(false);
        };
        match word {
            Word::BumpSize => {
                args.accept(word)?;
                self.amount = args.float()?;
            }
            Word::Accuracy => {
                args.accept(word)?;
                self.accuracy = args.float()?;
            }
            Word::NoBumpScale => self.has_no_bump_scale = args.accept(word)?,
            Word::NormalMap | Word::SlopeMap => return self.read_own_map(word, args),
            _ => {
                return Ok(self.modifiers.read(word, args)? || self.kind.read_item(word, args)?);
            }
        }
        Ok(true)
    }

    fn read_own_map(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let pattern = match &mut self.kind {
            NormalKind::Average(map) if word == Word::NormalMap => {
                args.accept(word)?;
                *map = Some(Normal::read_map(Keys::Weights, args)?);
                return Ok(true);
            }
            NormalKind::Pattern(pattern)
            | NormalKind::Slopes(pattern, _)
            | NormalKind::Normals(pattern, _)
                if !pattern.has_list() =>
            {
                pattern.clone()
            }
            _ => return Err(args.expected("a pattern that takes a map before the map")),
        };
        args.accept(word)?;
        self.kind = if word == Word::SlopeMap {
            NormalKind::Slopes(pattern, Normal::read_slopes(args)?)
        } else {
            NormalKind::Normals(pattern, Normal::read_map(Keys::Positions, args)?)
        };
        Ok(true)
    }

    /// True if any of the bumps depend on the texture coordinates of the surface.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        match &self.kind {
            NormalKind::Uv(_) => true,
            NormalKind::Normals(_, map) | NormalKind::Average(Some(map)) => {
                map.entries().iter().any(|(_, entry)| entry.uses_uv())
            }
            _ => false,
        }
    }

    /// Transforms the bumps.
    pub fn transform(&mut self, step: &Step) {
        self.modifiers.chain.push(step);
    }
}

impl NormalKind {
    /// Reads bumps that begin with `word`; `None` if no pattern does. A pattern takes over the map of the pattern that
    /// it replaces, as in pigments.
    fn begin(&self, word: Word, args: &mut dyn Args) -> Parse<Option<Self>> {
        match word {
            Word::BumpMap => {
                args.accept(word)?;
                let picture = bitmap::read(args, bitmap::Purpose::Bumps)?;
                return Ok(Some(NormalKind::Image(picture)));
            }
            Word::Average => {
                args.accept(word)?;
                return Ok(Some(NormalKind::Average(self.normals().cloned())));
            }
            Word::Facets => {
                args.accept(word)?;
                return Ok(Some(NormalKind::Facets(Facets {
                    size: FACETS,
                    coords: 0.0,
                    metric: 2.0,
                })));
            }
            _ => {}
        }
        let Some(pattern) = read_pattern(word, args)? else {
            return Ok(None);
        };
        let has_open_block = pattern.has_open_block();
        let is_list = pattern.has_list() && args.word()? == Some(Word::Normal);
        let kind = if is_list {
            let normals = normal_list(pattern.default_map(), args)?;
            NormalKind::Normals(pattern, normals)
        } else if pattern.has_list() {
            NormalKind::Pattern(pattern)
        } else if let NormalKind::Slopes(_, map) = self {
            NormalKind::Slopes(pattern, map.clone())
        } else if let Some(map) = self.normals() {
            NormalKind::Normals(pattern, map.clone())
        } else {
            NormalKind::Pattern(pattern)
        };
        if has_open_block {
            args.close()?;
        }
        Ok(Some(kind))
    }

    /// The map of normals, if there is one.
    fn normals(&self) -> Option<&Map<Arc<Normal>>> {
        match self {
            NormalKind::Normals(_, map) => Some(map),
            NormalKind::Average(map) => map.as_ref(),
            _ => None,
        }
    }

    fn read_item(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let facets = match self {
            NormalKind::Pattern(pattern)
            | NormalKind::Slopes(pattern, _)
            | NormalKind::Normals(pattern, _) => return pattern.read_modifier(word, args),
            NormalKind::Facets(facets) => facets,
            NormalKind::None
            | NormalKind::Average(_)
            | NormalKind::Image(_)
            | NormalKind::Uv(_) => return Ok(false),
        };
        let value = match word {
            Word::Size => &mut facets.size,
            Word::Coords => &mut facets.coords,
            Word::Metric => &mut facets.metric,
            _ => return Ok(false),
        };
        args.accept(word)?;
        *value = args.float()?;
        Ok(true)
    }
}

/// Reads the list of normals of a pattern. All of them must be present.
fn normal_list(stops: &[Stop], args: &mut dyn Args) -> Parse<Map<Arc<Normal>>> {
    let count = stops.len();
    let base: Option<Arc<Normal>> = default_of(args);
    let mut entries = Vec::new();
    for (at, _) in stops {
        if !args.accept(Word::Normal)? {
            return Err(args.expected(&format!("`normal`: this pattern chooses from {count}")));
        }
        entries.push((*at, Normal::read(args, base.as_ref())?));
        args.comma()?;
    }
    Map::new(entries).ok_or_else(|| args.expected("`normal`"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Parse<Arc<Normal>> {
        Normal::read(&mut TextArgs::new(text), None)
    }

    #[test]
    fn the_amount_follows_the_pattern_or_its_own_word() {
        for (text, amount) in [
            ("{ bumps }", 0.5),
            ("{ bumps 0.25 scale 2 }", 0.25),
            ("{ bumps, 0.25 }", 0.25),
            ("{ gradient <1,0,0>, 0.25 }", 0.25),
            ("{ checker 0.25 }", 0.25),
            ("{ facets 0.25 coords 1 size 2 metric 1 }", 0.25),
            ("{ dents bump_size 0.25 accuracy 0.5 no_bump_scale }", 0.25),
            ("{ agate 0.25 agate_turb 1 }", 0.25),
        ] {
            assert_eq!(read(text).unwrap().amount, amount, "{text}");
        }
    }

    #[test]
    fn maps_hold_slopes_and_normals() {
        let slopes = read("{ wood slope_map { [0 <0,1>] [0.5 <1,0>] } }").unwrap();
        assert!(matches!(&slopes.kind, NormalKind::Slopes(_, map) if map.entries().len() == 2));
        let normals =
            read("{ wood normal_map { [0 bumps 1] [1 dents scale 2] } turbulence 1 }").unwrap();
        assert!(matches!(&normals.kind, NormalKind::Normals(_, map) if map.entries().len() == 2));
        let mean = read("{ average normal_map { [bumps 1] [2 dents] } }").unwrap();
        assert!(matches!(&mean.kind, NormalKind::Average(Some(_))));
        let list = read("{ checker normal { bumps }, normal { dents 1 } scale 2 }").unwrap();
        assert!(matches!(&list.kind, NormalKind::Normals(_, map) if map.entries().len() == 2));
    }

    #[test]
    fn a_block_may_change_the_base() {
        let known = read("{ bumps 2 }").unwrap();
        let mut args = TextArgs::new("{ N scale 2 }").with("N", Arc::clone(&known));
        let changed = Normal::read(&mut args, None).unwrap();
        assert_eq!(
            (changed.amount, changed.modifiers.chain.steps().len()),
            (2.0, 1)
        );
        let changed = Normal::read(&mut TextArgs::new("{ scale 2 }"), Some(&known)).unwrap();
        assert_eq!(
            (changed.amount, changed.modifiers.chain.steps().len()),
            (2.0, 1)
        );
    }

    /// A default may set the height before the pattern.
    #[test]
    fn a_pattern_takes_the_height_of_its_base() {
        let known = read("{ bump_size 2 }").unwrap();
        assert!(matches!(known.kind, NormalKind::None));
        let bumps = Normal::read(&mut TextArgs::new("{ bumps }"), Some(&known)).unwrap();
        assert_eq!(bumps.amount, 2.0);
    }

    /// POV-Ray refuses each of these.
    #[test]
    fn malformed_normals_are_refused() {
        for text in [
            "{ average }",
            "{ checker normal { bumps } }",
            "{ slope_map { [0 <0,1>] } }",
            "{ bumps dents }",
            "{ bumps no_bump_scale on }",
            "{ bumps normal { bumps } }",
            "{ rgb 1 }",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
