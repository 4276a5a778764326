//! `normal`: bumps on a surface, as a scene describes them.

use super::read_pattern;
use crate::base::args::{Args, Parse, Word, declared, default_of};
use crate::base::bitmap;
use crate::base::math::Step;
use crate::base::source::Span;
use crate::scene::pattern::{self, Keys, Map, Modifiers, Pattern, Stop};
use glam::DVec2;
use std::sync::Arc;

/// Bumps without an amount of their own are so high.
const AMOUNT: f64 = 0.5;
/// How far apart a pattern is sampled for its slope where the scene does not say it.
const ACCURACY: f64 = 0.02;
/// The size of `facets` without one.
const FACETS: f64 = 0.1;

/// Bumps on a surface.
#[derive(Clone, Debug)]
pub struct Normal {
    /// Where it stands, for messages.
    pub at: Span,
    /// What gives the bumps.
    pub kind: NormalKind,
    /// How high they are.
    pub amount: f64,
    /// How far apart the pattern is sampled, in units of its own space.
    pub accuracy: f64,
    /// Whether bumps keep their slope when the surface is scaled.
    pub has_no_bump_scale: bool,
    /// Transforms, warps, turbulence and waves.
    pub modifiers: Modifiers,
}

/// What gives the bumps of a [`Normal`].
#[derive(Clone, Debug)]
pub enum NormalKind {
    /// Nothing yet: surfaces cannot have it.
    None,
    /// The values of a pattern.
    Pattern(Box<dyn Pattern>),
    /// The values of a pattern through heights and slopes.
    Slopes(Box<dyn Pattern>, Map<DVec2>),
    /// A pattern that chooses among normals.
    Normals(Box<dyn Pattern>, Map<Arc<Normal>>),
    /// The mean of normals; `None` until the map is read.
    Average(Option<Map<Arc<Normal>>>),
    /// The brightness of a picture.
    Image(bitmap::Source),
    /// Flat faces.
    Facets(Facets),
    /// Other bumps at the texture coordinates of the surface.
    Uv(Arc<Normal>),
}

/// The parameters of `facets`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    /// How large the faces are.
    pub size: f64,
    /// How far the place counts, and not the direction of the surface.
    pub coords: f64,
    /// By which power distances are measured.
    pub metric: f64,
}

impl Normal {
    /// The normal of a block behind its word; what the block does not say is as in `base`.
    ///
    /// # Errors
    /// A malformed value, no pattern, or a pattern that is not built yet.
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

    /// Reads `normal_map { ... }` behind its word.
    ///
    /// # Errors
    /// A malformed entry, or none.
    pub fn read_map(keys: Keys, args: &mut dyn Args) -> Parse<Map<Arc<Normal>>> {
        Map::read("normal_map", keys, args, &mut Normal::read_entry)
    }

    /// Reads `slope_map { [position <height, slope>] ... }` behind its word.
    ///
    /// # Errors
    /// A malformed entry, or none.
    pub fn read_slopes(args: &mut dyn Args) -> Parse<Map<DVec2>> {
        Map::read("slope_map", Keys::Positions, args, &mut |args| {
            args.vector2()
        })
    }

    /// Bumps and how high they are, without a block; all else is as in `base`.
    pub(super) fn read_bare(args: &mut dyn Args, base: Option<&Arc<Normal>>) -> Parse<Arc<Normal>> {
        let at = args.span();
        Normal::begin(args, at, base.map(Arc::as_ref))?.checked(args)
    }

    /// Reads `word`, the next token, with its value if it may stand beside any pattern.
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

    /// A name, or what there is already, and then perhaps another pattern.
    fn begin(args: &mut dyn Args, at: Span, base: Option<&Normal>) -> Parse<Normal> {
        let mut normal = match (declared::<Arc<Normal>>(args)?, base) {
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
        let Some(word) = args.word()? else {
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
            NormalKind::Pattern(pattern) if !pattern.has_list() => pattern.clone(),
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

    /// Whether some of the bumps are found by the texture coordinates of a surface.
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

    /// Moves the bumps.
    pub fn transform(&mut self, step: &Step) {
        self.modifiers.chain.push(step);
    }
}

impl NormalKind {
    /// The bumps that begin with this word, if some do. A pattern keeps the map that the scene has given to the one before,
    /// as in pigments.
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

    /// The normals that are chosen from.
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

/// The normals that a pattern with a list chooses from: all of them must be there.
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
    fn the_amount_stands_behind_the_pattern_or_its_own_word() {
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
    fn a_block_may_change_what_there_is() {
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

    /// A default may give the height before the pattern.
    #[test]
    fn a_pattern_takes_the_height_of_what_it_changes() {
        let known = read("{ bump_size 2 }").unwrap();
        assert!(matches!(known.kind, NormalKind::None));
        let bumps = Normal::read(&mut TextArgs::new("{ bumps }"), Some(&known)).unwrap();
        assert_eq!(bumps.amount, 2.0);
    }

    /// POV-Ray refuses each of these.
    #[test]
    fn what_makes_no_bumps_is_refused() {
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
