//! Spheres of one colour, which loops and macros make the most of: the positions of their numbers are recorded once.
//!
//! A replayed `sphere { centre, radius pigment { rgb colour } }` with literals or recorded expressions for the three is
//! recorded as these three, and from then on none of its tokens is looked at. Words and marks cannot change, and
//! expressions detect changes themselves.

use super::cache::{Known, Level, ReplayCache};
use super::recording::{Part, RecordedSphere};
use crate::base::args::Word;
use crate::base::color::Color;
use crate::lang::expr::streams::Streams;
use crate::lang::expr::value::Number;
use crate::lang::fast_path::numbers::literal_at;
use crate::lang::scope::Scopes;
use crate::lang::syntax::Tokens;
use crate::scene::shape::Sphere;
use crate::scene::texture::Layer;

impl Part {
    /// The expression at a token, if it is literal or recorded, and the index after it.
    fn at(tokens: &Tokens, at: usize, replays: &ReplayCache) -> Option<(Part, usize)> {
        if let Some((number, after)) = literal_at(tokens, at) {
            return Some((Part::Literal(number), after));
        }
        match replays.known(tokens.file, at, Level::Sum) {
            Known::Program(index) => {
                let after = replays.programs[index as usize].after;
                Some((Part::Program(index, after), after))
            }
            _ => None,
        }
    }

    #[inline]
    fn number(
        &self,
        replays: &mut ReplayCache,
        scopes: &Scopes,
        streams: &mut Streams,
    ) -> Option<Number> {
        match *self {
            Part::Literal(number) => Some(number),
            Part::Program(index, after) if replays.programs[index as usize].after == after => {
                replays.value(index, scopes, streams)
            }
            Part::Program(..) => None,
        }
    }
}

impl RecordedSphere {
    /// The sphere at a token, if it has this form.
    pub(super) fn at(
        tokens: &Tokens,
        start: usize,
        replays: &ReplayCache,
    ) -> Option<RecordedSphere> {
        let all = &tokens.tokens;
        let word = |at: usize| all.get(at).and_then(|token| token.word());
        let mark = |at: usize, mark: char| all.get(at).is_some_and(|token| token.is_mark(mark));
        let behind_comma = |at: usize| at + usize::from(mark(at, ','));
        if word(start) != Some(Word::Sphere) || !mark(start + 1, '{') {
            return None;
        }
        let (centre, at) = Part::at(tokens, behind_comma(start + 2), replays)?;
        let (radius, mut at) = Part::at(tokens, behind_comma(at), replays)?;
        let mut color = None;
        if word(at) == Some(Word::Pigment) && mark(at + 1, '{') {
            at += 2;
            at += usize::from(matches!(word(at), Some(Word::Color | Word::Colour)));
            let kin = word(at)
                .filter(|word| matches!(word, Word::Rgb | Word::Rgbf | Word::Rgbt | Word::Rgbft))?;
            let (part, behind) = Part::at(tokens, at + 1, replays)?;
            if !mark(behind, '}') {
                return None;
            }
            color = Some((kin, part));
            at = behind + 1;
        }
        mark(at, '}').then_some(RecordedSphere {
            centre,
            radius,
            color,
            after: at + 1,
        })
    }

    /// The sphere with its current numbers; `None` if it has to be read.
    pub(super) fn read(
        &self,
        replays: &mut ReplayCache,
        default: &Layer,
        scopes: &Scopes,
        streams: &mut Streams,
    ) -> Option<(Sphere, Option<Color>)> {
        let centre = self.centre.number(replays, scopes, streams)?.promoted(3);
        let radius = self.radius.number(replays, scopes, streams)?;
        let is_sound = centre.len == 3
            && radius.len == 1
            && centre.xyz().is_finite()
            && radius.v[0].is_finite();
        if !is_sound {
            return None;
        }
        let mut color: Option<Color> = None;
        if let Some((word, part)) = &self.color {
            if !default.is_bare() {
                return None;
            }
            let number = part.number(replays, scopes, streams)?;
            color = Some(color_of(*word, number)?);
        }
        let sphere = Sphere {
            centre: centre.xyz(),
            radius: radius.v[0].abs(),
        };
        Some((sphere, color))
    }
}

/// The colour of the numbers after `rgb` and the like; `None` if it has to be read.
pub(crate) fn color_of(word: Word, number: Number) -> Option<Color> {
    let wanted = match word {
        Word::Rgb => 3,
        Word::Rgbf | Word::Rgbt => 4,
        Word::Rgbft => 5,
        _ => return None,
    };
    if number.len > wanted {
        return None;
    }
    let mut parts = number.promoted(wanted).v;
    if word == Word::Rgbt {
        parts = [parts[0], parts[1], parts[2], 0.0, parts[3]];
    }
    #[allow(
        clippy::cast_possible_truncation,
        reason = "colours are single precision"
    )]
    let is_finite = parts.iter().all(|&part| (part as f32).is_finite());
    is_finite.then(|| Color::from_components(parts))
}
