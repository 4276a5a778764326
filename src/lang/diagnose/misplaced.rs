//! Words in a block that has none of them, and the block that has.

use crate::base::args::Word;
use crate::lang::diagnose::notation::is_map;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind};

/// Most tokens of a word with its value.
const VALUE_TOKENS: usize = 64;

/// Most tokens of a block.
const BLOCK_TOKENS: usize = 400;

/// The block that a word belongs in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Home {
    /// A block of this name, in an object or a texture.
    Part(&'static str),
    /// The interior of an object.
    Interior,
    /// The object itself.
    Object,
    /// The pattern that it changes.
    Pattern,
    /// A statement of the top level.
    Statement(&'static str),
}

impl Reader<'_> {
    /// The words of the blocks around the next token, innermost first, as far as they have one.
    pub(super) fn words_of_blocks(&self) -> impl Iterator<Item = Word> + '_ {
        let opens = self.blocks.iter().rev();
        opens.map_while(|&open| {
            let (_, name) = self.element_of(self.span_of(open));
            Word::from_spelling(name)
        })
    }

    /// The block that the next token, a word, belongs in.
    pub(super) fn misplaced(&self, word: Word, wanted: &str) -> Option<Remedy> {
        let is_statement = wanted.contains("statement");
        let blocks: Vec<Word> = match is_statement {
            true => Vec::new(),
            false => self.words_of_blocks().collect(),
        };
        let block = blocks.first().copied();
        if !is_statement && (block.is_none() || !wanted.contains("`}`")) {
            return None;
        }
        if word == Word::Angle && block == Some(Word::LightSource) {
            return Some("A spotlight has `radius` and `falloff`, in degrees.".into());
        }
        if block == Some(Word::LightSource) && word.class() == Class::Shape {
            return Some(
                format!("The shape of a light belongs in `looks_like {{ {word} {{ ... }} }}`.")
                    .into(),
            );
        }
        let is_transparency = matches!(word, Word::Filter | Word::Transmit);
        if is_transparency && matches!(block, Some(Word::Finish | Word::Texture)) {
            let hint = format!(
                "Transparency belongs to the colour: `pigment {{ rgb <1, 0, 0> {word} 0.5 }}`."
            );
            return Some(hint.into());
        }
        if word.class() == Class::Transform && matches!(block, Some(Word::Finish | Word::Interior))
        {
            let block = block?;
            return Some(
                format!("`{block}` has no size or place: write `{word}` after its `}}`.").into(),
            );
        }
        if word.class() == Class::Transform
            && let Some(map) = block.filter(|&block| is_map(block))
        {
            let hint = format!("`{map}` has entries only: write `{word}` after its `}}`.");
            return Some(hint.into());
        }
        if is_part(word) && block == Some(Word::Material) {
            let hint = format!("`{word}` belongs in `texture {{ }}` of this `material`.");
            return Some(hint.into());
        }
        if (word, block) == (Word::Texture, Some(Word::Texture)) && self.is_after_mark('{') {
            return Some("One `texture` is enough: remove this word with its `{` and `}`.".into());
        }
        let instead = match (word, block) {
            (Word::LookAt, Some(Word::LightSource)) => Some(Word::PointAt),
            (Word::PointAt, Some(Word::Camera)) => Some(Word::LookAt),
            _ => None,
        };
        if let (Some(instead), Some(block)) = (instead, block) {
            let hint = match instead {
                Word::PointAt => {
                    "A light has `point_at`, after `spotlight` or `parallel`.".to_owned()
                }
                _ => format!("The word is `{instead}` in `{block}`."),
            };
            return Some(Remedy::fix(hint, self.here_span(), instead.spelling()));
        }
        let home = match (word, block) {
            (_, Some(Word::Interior)) if of_media(word) => {
                return Some(self.wrapped(word, Home::Part("media"), "media"));
            }
            (Word::Photons, None) => Home::Statement("global_settings"),
            _ => home_of(word)?,
        };
        let Some(block) = block else {
            return self.outside_of_blocks(word, home);
        };
        match home {
            Home::Statement(name) if name != block.spelling() => {
                Some(format!("`{word}` belongs in `{name} {{ }}`.").into())
            }
            Home::Statement(_) => None,
            Home::Pattern => (block == Word::Texture || is_object(block)).then(|| {
                format!("`{word}` belongs after its pattern: `pigment {{ marble {word} ... }}`.").into()
            }),
            Home::Part(name) if name == block.spelling() => None,
            Home::Part(name) if is_object(block) || block == Word::Texture => {
                Some(self.wrapped(word, home, name))
            }
            Home::Part("pigment") if block == Word::SkySphere => Some(self.wrapped(word, home, "pigment")),
            Home::Part(name) if is_part(block) => Some(
                format!("`{word}` belongs in `{name} {{ }}`, beside this block: write it behind the `}}`.").into(),
            ),
            Home::Part(_) => None,
            Home::Interior if is_object(block) => Some(self.wrapped(word, home, "interior")),
            Home::Interior | Home::Object => {
                let at = blocks.iter().position(|&block| is_object(block))?;
                let (object, outermost) = (blocks[at], blocks[at.checked_sub(1)?]);
                if outermost != Word::Texture && !is_part(outermost) {
                    return None;
                }
                Some(match home {
                    Home::Interior if outermost == Word::Interior => return None,
                    Home::Interior => format!(
                        "`{word}` belongs in `interior {{ }}` of `{object}`, outside of `{outermost}`."
                    )
                    .into(),
                    _ => format!("`{word}` belongs in `{object}`, outside of `{outermost}`.").into(),
                })
            }
        }
    }

    /// A setting outside of its block.
    pub(crate) fn setting_in_block(&self, word: Word) -> Remedy {
        let at = self.here.at;
        let hint = format!("`{word}` belongs in `global_settings {{ }}`.");
        let Some(end) = self.end_of_value(at) else {
            return hint.into();
        };
        let mut span = self.tokens_span(at..end);
        let text = format!("global_settings {{ {} }}", self.source_text(span));
        let before = self.sources.text(span.file).get(..span.start as usize);
        if before.is_some_and(|before| before.ends_with('#')) {
            span.start -= 1;
        }
        Remedy::fix(hint, span, text)
    }

    /// `#declare T = pigment { ... } finish { ... }`, at the second part.
    pub(super) fn texture_of_parts(&self) -> Option<Remedy> {
        let at = self.here.at;
        let is_texture_part = |at: usize| {
            let word = self.token(at).and_then(|token| token.word());
            matches!(word, Some(Word::Pigment | Word::Normal | Word::Finish))
        };
        let mut depth = 0;
        let open = (at.saturating_sub(BLOCK_TOKENS)..at).rev().find(|&at| {
            let is_mark = |mark| self.token(at).is_some_and(|token| token.is_mark(mark));
            depth += i32::from(is_mark('}')) - i32::from(is_mark('{'));
            depth == 0
        })?;
        let start = open.checked_sub(1)?;
        let is_declared = self.token(start.checked_sub(1)?)?.is_mark('=');
        if !is_texture_part(at) || !is_texture_part(start) || !is_declared {
            return None;
        }
        let mut end = at;
        while is_texture_part(end) {
            end = self.end_of_long_brackets(end + 1, '{', '}')?;
        }
        let span = self.tokens_span(start..end);
        let text = format!("texture {{ {} }}", self.source_text(span));
        Some(Remedy::fix(
            "Parts that are declared together make a `texture`.",
            span,
            text,
        ))
    }

    /// True if the last token was a mark.
    pub(crate) fn is_after_mark(&self, mark: char) -> bool {
        let before = self.here.at.checked_sub(1).and_then(|at| self.token(at));
        before.is_some_and(|before| before.is_mark(mark))
    }

    /// At the top level.
    fn outside_of_blocks(&self, word: Word, home: Home) -> Option<Remedy> {
        if home == Home::Object
            && let Some(remedy) = self.object_without_braces()
        {
            return Some(remedy);
        }
        Some(match home {
            Home::Statement("global_settings") => self.setting_in_block(word),
            Home::Statement(name) => format!("`{word}` belongs in `{name} {{ }}`.").into(),
            Home::Part(name) => format!("`{word}` belongs in `{name} {{ }}` of an object.").into(),
            Home::Interior => format!("`{word}` belongs in `interior {{ }}` of an object.").into(),
            Home::Object => format!("`{word}` belongs in the `{{` and `}}` of an object.").into(),
            Home::Pattern => return None,
        })
    }

    /// `Ball translate x`, for `object { Ball translate x }`.
    fn object_without_braces(&self) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        let name = self.token(before)?.symbol()?;
        let modifies = |word: Word| {
            let is_object = matches!(home_of(word), Some(Home::Object | Home::Interior));
            is_object || is_part(word) || word == Word::Texture
        };
        let mut end = None;
        let mut at = self.here.at;
        while let Some(next) = self
            .token(at)?
            .word()
            .filter(|&word| modifies(word))
            .and_then(|_| self.end_of_value(at))
        {
            at = next;
            end = Some(next);
        }
        let span = self.tokens_span(before..end?);
        let text = self.source_text(span);
        let is_object = matches!(self.scopes.get(name), Some(Value::Object(_)));
        is_object.then(|| {
            let object = format!("object {{ {text} }}");
            let hint = match text.contains(['\n', '\r']) {
                true => "An object with modifiers stands in `object { }`.".to_owned(),
                false => format!("Write `{object}`."),
            };
            Remedy::fix(hint, span, object)
        })
    }

    /// The words of one home from the next token on, with a block of that name around them.
    fn wrapped(&self, word: Word, home: Home, name: &str) -> Remedy {
        let hint = match word.class() {
            Class::Color => "A colour belongs in `pigment { }`.".to_owned(),
            _ if matches!(word, Word::ColorMap | Word::ColourMap | Word::PigmentMap) => {
                format!("`{word}` belongs in `pigment {{ }}`, after a pattern.")
            }
            _ => format!("`{word}` belongs in `{name} {{ }}`."),
        };
        let mut end = None;
        let mut next = Some(self.here.at);
        while let Some(at) = next {
            let is_ours = |word: Word| match home {
                Home::Part("media") => of_media(word),
                _ => home_of(word) == Some(home),
            };
            match self
                .token(at)
                .and_then(|token| token.word())
                .is_some_and(is_ours)
            {
                true => next = self.end_of_value(at),
                false => break,
            }
            end = next.or(end);
        }
        let is_whole = |end: usize| {
            let behind = self.token(end).filter(|token| {
                // Modifiers behind a pattern belong to it.
                let is_apart = |word: Word| {
                    let is_modifier = home_of(word) == Some(Home::Pattern);
                    !word.is_value() && !is_modifier && word.class() != Class::Transform
                };
                token.is_mark('}') || token.word().is_some_and(is_apart)
            });
            behind.is_some()
        };
        let Some(end) = end.filter(|&end| next.is_some() && is_whole(end)) else {
            return hint.into();
        };
        let span = self.tokens_span(self.here.at..end);
        let text = self.source_text(span);
        let is_short = text.len() <= limits::QUOTED && !text.contains(['\n', '\r']);
        // A map needs a pattern before it.
        match is_short && !is_map(word) {
            true => Remedy::fix(hint, span, format!("{name} {{ {text} }}")),
            false => hint.into(),
        }
    }

    /// The token behind a word and its value, if that is a block, a vector, a number or a product of such.
    pub(super) fn end_of_value(&self, at: usize) -> Option<usize> {
        self.token(at)?.word()?;
        let mut at = at + 1;
        // `color rgb 1`, `ambient rgb 1`
        while self
            .token(at)?
            .word()
            .is_some_and(|word| word.class() == Class::Color)
        {
            at += 1;
        }
        loop {
            let token = self.token(at)?;
            let mark = (token.kind == Kind::Mark)
                .then(|| char::from_u32(token.value))
                .flatten();
            at = match (token.kind, mark) {
                (Kind::Mark, Some('-')) => {
                    at += 1;
                    continue;
                }
                (Kind::Mark, Some('{')) => return self.end_of_brackets(at, '{', '}'),
                (Kind::Mark, Some('<')) => self.end_of_brackets(at, '<', '>')?,
                (Kind::Number | Kind::Name, _) => at + 1,
                (Kind::Word, _) if token.word()?.class() == Class::Value => at + 1,
                _ => return None,
            };
            match self.token(at)? {
                token if ['*', '/'].into_iter().any(|mark| token.is_mark(mark)) => at += 1,
                _ => return Some(at),
            }
        }
    }

    /// The token behind a bracket and what it encloses, a value.
    pub(super) fn end_of_brackets(&self, at: usize, open: char, close: char) -> Option<usize> {
        let end = self.end_of_long_brackets(at, open, close)?;
        (end <= at + VALUE_TOKENS).then_some(end)
    }

    /// The token behind a bracket and what it encloses.
    pub(super) fn end_of_long_brackets(&self, at: usize, open: char, close: char) -> Option<usize> {
        let mut depth = 0;
        for at in at..at + BLOCK_TOKENS {
            let token = self.token(at)?;
            depth += i32::from(token.is_mark(open)) - i32::from(token.is_mark(close));
            if depth == 0 {
                return Some(at + 1);
            }
        }
        None
    }
}

/// True for the words of objects that carry textures.
fn is_object(word: Word) -> bool {
    matches!(word.class(), Class::Shape | Class::Csg)
}

/// True for the words of media.
fn of_media(word: Word) -> bool {
    matches!(
        word,
        Word::Absorption
            | Word::Density
            | Word::Emission
            | Word::Scattering
            | Word::Samples
            | Word::Intervals
    )
}

/// True for the parts of an object that stand side by side.
fn is_part(word: Word) -> bool {
    matches!(
        word,
        Word::Pigment | Word::Normal | Word::Finish | Word::Interior
    )
}

/// The block of a word, for words that have one alone.
fn home_of(word: Word) -> Option<Home> {
    use Word::{
        Adaptive, AdcBailout, Ambient, AmbientLight, Angle, Aperture, AreaLight, AssumedGamma,
        BlurSamples, BoundedBy, Brilliance, BumpMap, BumpSize, Bumps, Caustics, ClippedBy,
        ColorMap, ColourMap, ConserveEnergy, Crand, Dents, Diffuse, Direction, Dispersion,
        DispersionSamples, DoubleIlluminate, Emission, FadeColor, FadeColour, FadeDistance,
        FadePower, FocalPoint, Frequency, HfGray16, Hollow, Inverse, Ior, Irid, IridWavelength,
        Lambda, Location, LookAt, MaxTraceLevel, Media, Metallic, NoImage, NoReflection, NoShadow,
        NormalMap, NumberOfWaves, Octaves, Omega, Open, Phase, Phong, PhongSize, Photons,
        PigmentMap, PointAt, QuickColor, Radiosity, Reflection, ReflectionExponent, Right, Ripples,
        Roughness, SlopeMap, Specular, Spotlight, Sturm, Tightness, Turbulence, Up, Waves,
        Wrinkles,
    };
    Some(match word {
        Angle | Aperture | BlurSamples | Direction | FocalPoint | Location | LookAt | Right
        | Up => Home::Statement("camera"),
        Adaptive | AreaLight | PointAt | Spotlight | Tightness => Home::Statement("light_source"),
        AdcBailout | AmbientLight | AssumedGamma | HfGray16 | IridWavelength | MaxTraceLevel
        | NumberOfWaves | Radiosity => Home::Statement("global_settings"),
        Ambient | Brilliance | ConserveEnergy | Crand | Diffuse | Emission | Irid | Metallic
        | Phong | PhongSize | Reflection | ReflectionExponent | Roughness | Specular => {
            Home::Part("finish")
        }
        BumpMap | BumpSize | Bumps | Dents | NormalMap | Ripples | SlopeMap | Waves | Wrinkles => {
            Home::Part("normal")
        }
        ColorMap | ColourMap | PigmentMap | QuickColor => Home::Part("pigment"),
        Caustics | Dispersion | DispersionSamples | FadeColor | FadeColour | FadeDistance
        | FadePower | Ior | Media => Home::Interior,
        BoundedBy | ClippedBy | DoubleIlluminate | Hollow | Inverse | NoImage | NoReflection
        | NoShadow | Open | Photons | Sturm => Home::Object,
        Frequency | Lambda | Octaves | Omega | Phase | Turbulence => Home::Pattern,
        _ if matches!(word.class(), Class::Pattern | Class::Color) => Home::Part("pigment"),
        _ if word.class() == Class::Transform => Home::Object,
        _ => return None,
    })
}
