//! `pigment`: the colour of a surface, uniform or from a pattern.

use super::{BoxedDefault, ColorFunctions, read_pattern};
use crate::base::args::{Args, Parse, Word, declared, default_of, not_built};
use crate::base::bitmap;
use crate::base::color::{Color, Rgb};
use crate::base::math::Step;
use crate::base::source::Diagnostic;
use crate::base::version::has_defaults_of_3_8;
use crate::base::word::Class;
use crate::scene::interior::Density;
use crate::scene::pattern::{self, Blend, Keys, Map, Modifiers, Pattern, Stop, Wave};
use glam::DVec3;

/// The colour of a surface as a scene describes it.
#[derive(Clone, Debug)]
pub struct Pigment {
    /// The source of the colour.
    pub kind: PigmentKind,
    /// `quick_color`: the colour in previews of quality 5 and less.
    pub quick_color: Option<Box<Color>>,
    /// Turbulence, waves, warps and transforms of the pattern. Transforms of the texture are appended to them.
    pub modifiers: BoxedDefault<Modifiers>,
}

/// The source of a pigment's colour. A scene may have a million of them, most of them plain.
#[derive(Clone, Debug)]
pub enum PigmentKind {
    /// The same colour everywhere.
    Plain(Color),
    /// A pattern with a map of colours.
    Colors(Box<Mapped<Color>>),
    /// A pattern with a map of pigments.
    Pigments(Box<Mapped<Pigment>>),
    /// `average`: the weighted mean of pigments; `None` until its `pigment_map` is read.
    Average(Option<Box<Map<Pigment>>>),
    /// `image_map`: the colours of an image.
    Image(Box<bitmap::MappedBitmap>),
    /// `user_defined`: a function for each component of the colour.
    Functions(Box<ColorFunctions>),
    /// `uv_mapping`: another pigment, evaluated at the texture coordinates of the surface.
    Uv(Box<Pigment>),
}

/// A pattern and the map for its values.
#[derive(Clone, Debug)]
pub struct Mapped<T> {
    /// The pattern.
    pub pattern: Box<dyn Pattern>,
    /// The map from pattern values to entries.
    pub map: Map<T>,
}

impl PigmentKind {
    fn colors(pattern: Box<dyn Pattern>, map: Map<Color>) -> Self {
        PigmentKind::Colors(Box::new(Mapped { pattern, map }))
    }

    fn pigments(pattern: Box<dyn Pattern>, map: Map<Pigment>) -> Self {
        PigmentKind::Pigments(Box::new(Mapped { pattern, map }))
    }

    /// Replaces the pattern but keeps a map or list that the scene has set for the previous pattern, which a named or
    /// the default pigment may have (measured with POV-Ray).
    fn with_pattern(&self, pattern: Box<dyn Pattern>) -> Self {
        match self {
            PigmentKind::Pigments(mapped) => PigmentKind::pigments(pattern, mapped.map.clone()),
            PigmentKind::Colors(mapped) if mapped.is_custom() => {
                PigmentKind::colors(pattern, mapped.map.clone())
            }
            PigmentKind::Average(Some(map)) => PigmentKind::pigments(pattern, (**map).clone()),
            _ => {
                let map = Map::of_stops(pattern.default_map());
                PigmentKind::colors(pattern, map)
            }
        }
    }
}

impl Mapped<Color> {
    /// True if the scene sets the colours; false for the pattern's default map.
    fn is_custom(&self) -> bool {
        self.pattern.has_list() || self.map.entries() != self.pattern.default_map()
    }

    /// Reads a modifier of the pattern, on which its default map may depend.
    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let is_custom = self.is_custom();
        let is_read = self.pattern.read_modifier(word, args)?;
        if is_read && !is_custom {
            self.map = Map::of_stops(self.pattern.default_map());
        }
        Ok(is_read)
    }
}

/// The keywords of a block: a density is read like a pigment, with its own keywords, which do not mix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PigmentSyntax {
    /// `pigment`, `pigment_map`.
    Pigment,
    /// `density`, `density_map`.
    Density,
}

impl PigmentSyntax {
    fn word(self) -> Word {
        match self {
            PigmentSyntax::Pigment => Word::Pigment,
            PigmentSyntax::Density => Word::Density,
        }
    }

    fn map_word(self) -> Word {
        match self {
            PigmentSyntax::Pigment => Word::PigmentMap,
            PigmentSyntax::Density => Word::DensityMap,
        }
    }

    fn read_map(self, keys: Keys, args: &mut dyn Args) -> Parse<Map<Pigment>> {
        match self {
            PigmentSyntax::Pigment => Pigment::read_map(keys, args),
            PigmentSyntax::Density => {
                Ok(Density::read_map(keys, args)?.map(|entry| entry.0.clone()))
            }
        }
    }
}

impl Default for Pigment {
    /// Black, as in POV-Ray.
    fn default() -> Self {
        Pigment::plain(Color::opaque(Rgb::BLACK))
    }
}

impl Pigment {
    /// A pigment of one colour.
    #[must_use]
    pub fn plain(color: Color) -> Self {
        Pigment {
            kind: PigmentKind::Plain(color),
            quick_color: None,
            modifiers: BoxedDefault::default(),
        }
    }

    /// The colour of a pigment of one colour.
    fn plain_color(&self) -> Option<Color> {
        match self.kind {
            PigmentKind::Plain(color) => Some(color),
            _ => None,
        }
    }

    /// True if it has neither `quick_color` nor modifiers.
    pub(super) fn is_bare(&self) -> bool {
        self.quick_color.is_none() && self.modifiers.get().is_none()
    }

    /// Reads a pigment block. Parts that the block does not set are those of `base`.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read(args: &mut dyn Args, base: &Pigment) -> Parse<Pigment> {
        args.open()?;
        Pigment::read_inside(args, base)
    }

    /// Reads a pigment block after its `{`.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read_inside(args: &mut dyn Args, base: &Pigment) -> Parse<Pigment> {
        let known = Pigment::read_known(args, base)?;
        if args.accept(Word::UvMapping)? {
            let mapped = Pigment::entry(args)?;
            return known
                .mapped(mapped)
                .read_to_block_end(args, PigmentSyntax::Pigment);
        }
        known.read_to_block_end(args, PigmentSyntax::Pigment)
    }

    /// Makes `mapped`, evaluated at the texture coordinates, the source of this pigment's colour.
    fn mapped(mut self, mapped: Pigment) -> Pigment {
        self.quick_color = mapped.quick_color.clone().or(self.quick_color);
        self.kind = PigmentKind::Uv(Box::new(mapped));
        self
    }

    /// True if any of its colours depend on the texture coordinates of the surface.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        let any = |map: &Map<Pigment>| map.entries().iter().any(|(_, entry)| entry.uses_uv());
        match &self.kind {
            PigmentKind::Uv(_) => true,
            PigmentKind::Pigments(mapped) => any(&mapped.map),
            PigmentKind::Average(map) => map.as_ref().is_some_and(|map| any(map)),
            PigmentKind::Plain(_)
            | PigmentKind::Colors(_)
            | PigmentKind::Image(_)
            | PigmentKind::Functions(_) => false,
        }
    }

    /// The numbers of samples along the axes, if it shows an image or a density file.
    #[must_use]
    pub fn sample_counts(&self) -> Option<DVec3> {
        match &self.kind {
            PigmentKind::Image(image) => Some(image.sample_counts()),
            PigmentKind::Colors(mapped) => mapped.pattern.sample_counts(),
            PigmentKind::Pigments(mapped) => mapped.pattern.sample_counts(),
            PigmentKind::Uv(pigment) => pigment.sample_counts(),
            PigmentKind::Plain(_) | PigmentKind::Average(_) | PigmentKind::Functions(_) => None,
        }
    }

    /// Reads changes to this pigment up to the end of the block: a colour or pattern, then the other parts.
    ///
    /// # Errors
    /// A malformed value, an unsupported keyword, or a colour or pattern after another part.
    pub fn read_to_block_end(
        mut self,
        args: &mut dyn Args,
        family: PigmentSyntax,
    ) -> Parse<Pigment> {
        if args.accept_close()? {
            return self.checked(args, family);
        }
        if !self.read_source(args, family)? && !self.read_part(args, family)? {
            let what = format!("a colour, a pattern or `}}` in `{}`", family.word());
            return Err(args.expected(&what));
        }
        self.read_parts_to_block_end(args, family)
    }

    /// Reads the parts after the colour or pattern up to the end of the block.
    ///
    /// # Errors
    /// A malformed value, an unsupported keyword, or another colour or pattern.
    pub fn read_parts_to_block_end(
        mut self,
        args: &mut dyn Args,
        family: PigmentSyntax,
    ) -> Parse<Pigment> {
        while !args.accept_close()? {
            if !self.read_part(args, family)? {
                let is_source =
                    |word: Word| word.class() == Class::Color || pattern::is_pattern(word);
                let rule = match args.word()?.is_some_and(is_source) {
                    true => ", whose colour or pattern comes first, and once",
                    false => "",
                };
                let what = format!("a modifier or `}}` in `{}`{rule}", family.word());
                return Err(args.expected(&what));
            }
        }
        self.checked(args, family)
    }

    /// Reads changes to this pigment up to the end of an entry of a map.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read_entry(mut self, args: &mut dyn Args, family: PigmentSyntax) -> Parse<Pigment> {
        self.read_source(args, family)?;
        while self.read_part(args, family)? {}
        self.checked(args, family)
    }

    /// Reads an entry of a map: a pigment without braces.
    fn entry(args: &mut dyn Args) -> Parse<Pigment> {
        let default: Pigment = default_of(args);
        let mut known = Pigment::read_known(args, &default)?;
        let mut is_mapped = false;
        // Repetitions have no effect. A loop rather than recursion, since a faulty scene may have a million of them.
        while args.accept(Word::UvMapping)? {
            known = Pigment::read_known(args, &default)?;
            is_mapped = true;
        }
        let entry = known.read_entry(args, PigmentSyntax::Pigment)?;
        Ok(if is_mapped {
            default.mapped(entry)
        } else {
            entry
        })
    }

    fn read_known(args: &mut dyn Args, base: &Pigment) -> Parse<Pigment> {
        Ok(match declared::<Pigment>(args)? {
            Some(known) => Pigment::clone(&known),
            None => base.clone(),
        })
    }

    fn checked(self, args: &mut dyn Args, family: PigmentSyntax) -> Parse<Pigment> {
        match self.kind {
            PigmentKind::Average(None) => {
                Err(args.expected(&format!("`{}` after `average`", family.map_word())))
            }
            PigmentKind::Colors(ref mapped) => mapped.pattern.check(args).map(|()| self),
            PigmentKind::Pigments(ref mapped) => mapped.pattern.check(args).map(|()| self),
            _ => Ok(self),
        }
    }

    /// Reads `pigment_map { ... }` after its word.
    ///
    /// # Errors
    /// A malformed entry, no entry, or too many.
    pub fn read_map(keys: Keys, args: &mut dyn Args) -> Parse<Map<Pigment>> {
        let blend = |_: &str, args: &mut dyn Args| Blend::read(args);
        Map::read("pigment_map", keys, blend, args, &mut Pigment::entry)
    }

    /// Reads a colour, a pattern, a map or a modifier without a block; false if none is next.
    pub(super) fn read_bare(&mut self, args: &mut dyn Args) -> Parse<bool> {
        let family = PigmentSyntax::Pigment;
        Ok(self.read_source(args, family)? || self.read_part(args, family)?)
    }

    /// Reads a colour that begins with a colour word or a name; false if none is next.
    pub(super) fn read_own_color(&mut self, args: &mut dyn Args) -> Parse<bool> {
        let color = args.color_if_any()?;
        if let Some(color) = color {
            self.kind = PigmentKind::Plain(color);
        }
        Ok(color.is_some())
    }

    /// Reads a colour or a pattern with its list; false if none is next. Before it, `uv_mapping` has no effect in a
    /// density.
    fn read_source(&mut self, args: &mut dyn Args, family: PigmentSyntax) -> Parse<bool> {
        while family == PigmentSyntax::Density && args.word()? == Some(Word::UvMapping) {
            skip_idle(Word::UvMapping, args, family)?;
        }
        if self.read_own_color(args)? {
            return Ok(true);
        }
        let Some(word) = args.word()? else {
            return Ok(false);
        };
        let is_read = self.read_pattern(word, args, family)?;
        if !is_read && pattern::is_pattern(word) {
            return Err(not_built(args, word));
        }
        Ok(is_read)
    }

    /// Reads a map or a modifier; false if none is next.
    fn read_part(&mut self, args: &mut dyn Args, family: PigmentSyntax) -> Parse<bool> {
        let Some(word) = args.word()? else {
            return Ok(false);
        };
        let is_read = self.read_idle(word, args, family)?
            || self.read_own(word, args, family)?
            || self
                .modifiers
                .change(|modifiers| modifiers.read(word, args))?;
        if !is_read && word == Word::UvMapping {
            let what = "`uv_mapping` at the start of the pigment, before its pattern";
            return Err(args.expected(what));
        }
        Ok(is_read)
    }

    /// Reads a map without a pattern before it, which has no effect; false if none is next.
    fn read_idle(&mut self, word: Word, args: &mut dyn Args, family: PigmentSyntax) -> Parse<bool> {
        let is_color_map = matches!(word, Word::ColorMap | Word::ColourMap);
        let is_map = is_color_map || word == family.map_word();
        let plain = self.plain_color();
        let is_idle = is_map
            && (plain == Some(Color::opaque(Rgb::BLACK))
                || plain == Some(Color::opaque(Rgb::WHITE)) && has_defaults_of_3_8(args.version()));
        if is_idle {
            skip_idle(word, args, family)?;
        }
        Ok(is_idle)
    }

    /// Reads a `color_map`, which has no effect on a plain colour; false if none is next, or if there is a pattern.
    pub(super) fn read_idle_colors(&self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let is_idle =
            matches!(word, Word::ColorMap | Word::ColourMap) && self.plain_color().is_some();
        if is_idle {
            skip_idle(word, args, PigmentSyntax::Pigment)?;
        }
        Ok(is_idle)
    }

    fn read_own(&mut self, word: Word, args: &mut dyn Args, family: PigmentSyntax) -> Parse<bool> {
        match word {
            Word::QuickColor | Word::QuickColour if family == PigmentSyntax::Pigment => {
                args.accept(word)?;
                self.quick_color = Some(Box::new(args.color()?));
            }
            Word::ColorMap | Word::ColourMap => {
                let pattern = self.pattern_for_map(args)?;
                args.accept(word)?;
                self.kind = PigmentKind::colors(pattern, Map::read_colors(args)?);
            }
            _ if word == family.map_word() => {
                if let PigmentKind::Average(entries) = &mut self.kind {
                    args.accept(word)?;
                    *entries = Some(Box::new(family.read_map(Keys::Weights, args)?));
                    return Ok(true);
                }
                let pattern = self.pattern_for_map(args)?;
                args.accept(word)?;
                self.kind = PigmentKind::pigments(pattern, family.read_map(Keys::Positions, args)?);
            }
            _ => match &mut self.kind {
                PigmentKind::Colors(mapped) => return mapped.read_modifier(word, args),
                PigmentKind::Pigments(mapped) => return mapped.pattern.read_modifier(word, args),
                _ => return Ok(false),
            },
        }
        Ok(true)
    }

    /// The pattern for a map: one that takes no list.
    fn pattern_for_map(&self, args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
        let pattern = match &self.kind {
            PigmentKind::Colors(mapped) => Some(&mapped.pattern),
            PigmentKind::Pigments(mapped) => Some(&mapped.pattern),
            _ => None,
        };
        match pattern {
            Some(pattern) if !pattern.has_list() => Ok(pattern.clone()),
            _ => Err(args.expected("a pattern that takes a map before the map")),
        }
    }

    fn read_pattern(
        &mut self,
        word: Word,
        args: &mut dyn Args,
        family: PigmentSyntax,
    ) -> Parse<bool> {
        if word == Word::ImageMap && family == PigmentSyntax::Pigment {
            args.accept(word)?;
            let source = bitmap::read(args, bitmap::Purpose::Colors)?;
            self.kind = PigmentKind::Image(Box::new(source));
            return Ok(true);
        }
        if word == Word::UserDefined {
            args.accept(word)?;
            self.kind = PigmentKind::Functions(Box::new(ColorFunctions::read(args)?));
            return Ok(true);
        }
        if word == Word::Average {
            args.accept(word)?;
            let known = match &self.kind {
                PigmentKind::Pigments(mapped) => Some(Box::new(mapped.map.clone())),
                _ => None,
            };
            self.kind = PigmentKind::Average(known);
            return Ok(true);
        }
        let Some(pattern) = read_pattern(word, args)? else {
            return Ok(false);
        };
        let has_open_block = pattern.has_open_block();
        let defaults = pattern.default_map();
        let wave = pattern.default_wave();
        if wave != Wave::default() {
            self.modifiers.get_mut().set_wave(&wave);
        }
        self.kind = if !pattern.has_list() {
            self.kind.with_pattern(pattern)
        } else if args.word()? == Some(family.word()) {
            PigmentKind::pigments(pattern, pigment_list(defaults, args, family)?)
        } else {
            PigmentKind::colors(pattern, color_list(defaults, args)?)
        };
        if has_open_block {
            args.close()?;
        }
        Ok(true)
    }

    /// Appends a transform.
    pub fn transform(&mut self, step: &Step) {
        self.modifiers.get_mut().chain.push(step);
    }

    /// Converts filter to transmit, as versions up to 3.1 do in the upper layers of a texture.
    pub fn filter_to_transmit(&mut self) {
        let changed = |color: &Color| Color {
            transmit: color.transmit + color.filter,
            filter: 0.0,
            ..*color
        };
        let all_changed = |map: &Map<Pigment>| {
            map.map(|pigment| {
                let mut pigment = pigment.clone();
                pigment.filter_to_transmit();
                pigment
            })
        };
        match &mut self.kind {
            PigmentKind::Plain(color) => *color = changed(color),
            PigmentKind::Colors(mapped) => mapped.map = mapped.map.map(changed),
            PigmentKind::Pigments(mapped) => mapped.map = all_changed(&mapped.map),
            PigmentKind::Average(map) => {
                if let Some(map) = map {
                    **map = all_changed(map);
                }
            }
            PigmentKind::Uv(mapped) => mapped.filter_to_transmit(),
            PigmentKind::Image(_) | PigmentKind::Functions(_) => {}
        }
    }
}

/// Reads `word` and its value, and warns that it has no effect.
fn skip_idle(word: Word, args: &mut dyn Args, family: PigmentSyntax) -> Parse<()> {
    args.accept(word)?;
    let at = args.last_span();
    let hint = if matches!(word, Word::ColorMap | Word::ColourMap) {
        Map::read_colors(args)?;
        "Write a pattern before it, as `gradient y`."
    } else if word == family.map_word() {
        family.read_map(Keys::Positions, args)?;
        "Write a pattern before it, as `gradient y`."
    } else {
        "Remove it: a density has no surface."
    };
    let warning = Diagnostic::warning(at, format!("`{word}` has no effect here"));
    args.warn(warning.with_hint(hint));
    Ok(())
}

/// Reads a list of colours, with or without commas. Missing colours are those of `defaults`.
fn color_list(defaults: &[Stop], args: &mut dyn Args) -> Parse<Map<Color>> {
    let mut entries = defaults.to_vec();
    for (_, slot) in &mut entries {
        if let Some(color) = args.color_if_any()? {
            *slot = color;
        } else if args.at_expression()? {
            *slot = args.color()?;
        } else {
            break;
        }
        args.comma()?;
    }
    Ok(Map::of_stops(&entries))
}

/// Reads a list of pigments, with or without commas. Missing pigments are the default pigment.
fn pigment_list(
    defaults: &[Stop],
    args: &mut dyn Args,
    family: PigmentSyntax,
) -> Parse<Map<Pigment>> {
    let default = match family {
        PigmentSyntax::Pigment => default_of(args),
        PigmentSyntax::Density => Density::default().0,
    };
    let mut entries: Vec<_> = defaults
        .iter()
        .map(|&(at, _)| (at, default.clone()))
        .collect();
    for (_, slot) in &mut entries {
        if !args.accept(family.word())? {
            break;
        }
        *slot = match family {
            PigmentSyntax::Pigment => Pigment::read(args, &default)?,
            PigmentSyntax::Density => Density::read(args)?.0,
        };
        args.comma()?;
    }
    Map::new(entries).ok_or_else(|| args.expected("an entry"))
}

#[cfg(test)]
mod tests;
