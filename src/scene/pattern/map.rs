//! The blend map: entries of any kind at positions, interpolated between neighbours.
//!
//! Colour maps, pigment maps, normal maps, slope maps, texture maps and density maps are all of this form.

use super::Stop;
use crate::base::args::{Args, ColorOrSingle, Parse, Word, declared};
use crate::base::bitmap::read_gamma;
use crate::base::color::{Color, Gamma, Rgb};
use crate::base::source::Diagnostic;
use crate::base::word::Class;
use std::sync::Arc;

/// Largest number of entries of a map, as in POV-Ray 3.7.
pub const MAX_ENTRIES: usize = 256;
/// Largest number of entries with the syntax of 3.8, a bound on memory.
const MOST_ENTRIES: usize = 1_000_000;

/// Maps of at most this many entries are counted through rather than bisected: no step waits for the one before.
const MAX_COUNTED: usize = 32;

/// Entries at positions, in the order of the scene; never empty.
#[derive(Debug)]
pub struct Map<T> {
    entries: Arc<[(f32, T)]>,
    is_sorted: bool,
    blend: Blend,
}

/// The blending of the colours of neighbouring entries.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Blend {
    /// Linearly in the working space.
    #[default]
    Working,
    /// The same, rounded as by POV-Ray 3.8.
    Mixed,
    /// Otherwise, in a space to which the working space is decoded first; `filter` and `transmit` in linear light.
    Decoded {
        /// The working space.
        working: Gamma,
        /// The space in which colours are blended.
        space: BlendSpace,
    },
}

/// `blend_mode` 1 to 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BlendSpace {
    /// Linear light.
    Light,
    /// The space of `blend_gamma`.
    Encoded(Gamma),
    /// Linear light, with the grey that the blend in the space of `blend_gamma` has.
    GreyEncoded(Gamma),
}

impl Blend {
    /// Reads `blend_mode` and `blend_gamma` at the start of a map.
    pub(crate) fn read(args: &mut dyn Args) -> Parse<Blend> {
        let (mut mode, mut gamma) = (0.0, Gamma::power(DEFAULT_BLEND_GAMMA));
        loop {
            if args.accept(Word::BlendMode)? {
                let at = args.span();
                mode = args.float()?.trunc();
                if !(0.0..=3.0).contains(&mode) {
                    let error = Diagnostic::error(at.to(args.last_span()), "no such `blend_mode`");
                    return Err(Box::new(error.with_hint("The modes are 0 to 3.")));
                }
            } else if args.accept(Word::BlendGamma)? {
                gamma = read_gamma(Word::BlendGamma, args)?;
            } else {
                break;
            }
        }
        let space = match mode {
            1.0 => BlendSpace::Light,
            2.0 => BlendSpace::Encoded(gamma),
            3.0 => BlendSpace::GreyEncoded(gamma),
            _ => return Ok(Blend::Working),
        };
        let working = args.working_gamma().unwrap_or(Gamma::LINEAR);
        Ok(Blend::Decoded { working, space })
    }

    /// Refuses `blend_mode` and `blend_gamma` in the map `what`, whose entries are no colours.
    pub(crate) fn refuse(what: &str, args: &mut dyn Args) -> Parse<Blend> {
        let at = args.span();
        for word in [Word::BlendMode, Word::BlendGamma] {
            if args.accept(word)? {
                let error = Diagnostic::error(at, format!("`{word}` is not allowed in `{what}`"));
                return Err(Box::new(error.with_hint(
                    "It is for `color_map` and `pigment_map`; others are blended linearly.",
                )));
            }
        }
        Ok(Blend::Working)
    }

    /// The colour between two; `share` is the weight of the second.
    #[must_use]
    #[inline]
    pub fn of(self, from: &Color, to: &Color, share: f64) -> Color {
        match self {
            Blend::Working => from.blended(to, share),
            Blend::Mixed => from.mixed(to, share),
            Blend::Decoded { working, space } => {
                let in_light = |from: f32, to: f32| {
                    let [from, to] = [from, to].map(|c| working.decode(c));
                    working.encode(mixed(from, to, share))
                };
                Color {
                    rgb: space.blended(working, from.rgb, to.rgb, share),
                    filter: in_light(from.filter, to.filter),
                    transmit: in_light(from.transmit, to.transmit),
                }
            }
        }
    }
}

impl BlendSpace {
    /// The blend of two colours of the working space. `blend_mode 3` takes greys there, before decoding and after
    /// encoding (measured with POV-Ray 3.8).
    fn blended(self, working: Gamma, from: Rgb, to: Rgb, share: f64) -> Rgb {
        let blend_in = |space: Gamma| {
            let [from, to] = [from, to].map(|rgb| rgb.map(|c| space.encode(working.decode(c))));
            (from + (to - from) * share).map(|c| working.encode(space.decode(c)))
        };
        match self {
            BlendSpace::Light => blend_in(Gamma::LINEAR),
            BlendSpace::Encoded(gamma) => blend_in(gamma),
            BlendSpace::GreyEncoded(gamma) => {
                let linear = blend_in(Gamma::LINEAR);
                let [from, to] = [from, to].map(|rgb| gamma.encode(working.decode(rgb.grey())));
                let grey = working.encode(gamma.decode(mixed(from, to, share)));
                match linear.grey() {
                    0.0 => linear,
                    plain => linear * f64::from(grey / plain),
                }
            }
        }
    }
}

/// The value between two; `share` is the weight of the second.
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision"
)]
fn mixed(from: f32, to: f32, share: f64) -> f32 {
    (f64::from(from) + f64::from(to - from) * share) as f32
}

/// `blend_gamma` of maps that set none.
const DEFAULT_BLEND_GAMMA: f64 = 2.5;

/// The entries next to a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Between<'a, T> {
    /// At one entry, or outside of the range of positions.
    One(&'a T),
    /// Between two; with the weight of the second.
    Two(&'a T, &'a T, f64),
}

/// The meaning of the numbers before the entries of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keys {
    /// Pattern value at which the entry applies.
    Positions,
    /// Weight of the entry in the mean of `average`; 1 by default.
    Weights,
}

impl Keys {
    fn read(self, args: &mut dyn Args) -> Parse<f32> {
        if self == Keys::Positions {
            return args.single();
        }
        // POV-Ray parses a colour here as the beginning of a weight.
        let word = args.word()?;
        if word.is_some_and(|word| word.class() == Class::Color) {
            return Err(args.expected("a weight before the colour of an entry"));
        }
        #[allow(
            clippy::cast_possible_truncation,
            reason = "weights are single precision"
        )]
        let weight = args.float_or(1.0)? as f32;
        Ok(weight)
    }

    /// Reads a number, a comma and what `entry` reads, and appends them.
    fn read_entry<T>(
        self,
        args: &mut dyn Args,
        entries: &mut Vec<(f32, T)>,
        entry: &mut dyn FnMut(&mut dyn Args) -> Parse<T>,
    ) -> Parse<()> {
        let at = self.read(args)?;
        args.comma()?;
        entries.push((at, entry(args)?));
        Ok(())
    }
}

/// Reads, or refuses, the blending of the map that the text names.
type ReadBlend = fn(&str, &mut dyn Args) -> Parse<Blend>;

/// Reads one entry of a map and appends it.
type ReadEntry<'a, T> = dyn FnMut(&mut dyn Args, &mut Vec<(f32, T)>) -> Parse<()> + 'a;

/// Copies share the entries.
impl<T> Clone for Map<T> {
    fn clone(&self) -> Self {
        Map {
            entries: Arc::clone(&self.entries),
            is_sorted: self.is_sorted,
            blend: self.blend,
        }
    }
}

impl<T> Map<T> {
    /// A map of these entries, or `None` if there are none.
    #[must_use]
    pub fn new(entries: Vec<(f32, T)>) -> Option<Self> {
        let is_sorted = entries.is_sorted_by(|a, b| a.0 <= b.0);
        (!entries.is_empty()).then(|| Map {
            entries: entries.into(),
            is_sorted,
            blend: Blend::default(),
        })
    }

    /// Reads `{ [position entry] ... }` or `{ Name }`. `entry` reads up to the `]`, which it leaves; `what` is the
    /// keyword of the map, for messages; `blend` reads or refuses words of blending before the entries.
    ///
    /// # Errors
    /// A malformed entry, none, or too many.
    pub fn read(
        what: &str,
        keys: Keys,
        blend: ReadBlend,
        args: &mut dyn Args,
        entry: &mut dyn FnMut(&mut dyn Args) -> Parse<T>,
    ) -> Parse<Map<T>>
    where
        T: Send + Sync + 'static,
    {
        Map::read_entries(what, blend, args, &mut |args, entries| {
            keys.read_entry(args, entries, entry)
        })
    }

    fn read_entries(
        what: &str,
        blend: ReadBlend,
        args: &mut dyn Args,
        entry: &mut ReadEntry<'_, T>,
    ) -> Parse<Map<T>>
    where
        T: Send + Sync + 'static,
    {
        args.open()?;
        let before = args.span();
        let blend = blend(what, args)?;
        let has_blend = args.span() != before;
        if let Some(known) = declared::<Map<T>>(args)? {
            if has_blend {
                let message = format!("a declared `{what}` keeps its own blending");
                let warning = Diagnostic::warning(before, message);
                args.warn(warning.with_hint("Write the words of blending where it is declared."));
            }
            if what == "density_map" {
                let reason = "a declared `density_map` cannot stand for its entries";
                args.refused_by_povray(args.last_span(), reason, "Write the entries here.");
            }
            args.close()?;
            return Ok(Map::clone(&known));
        }
        let most = match args.is_for_3_8() {
            true => MOST_ENTRIES,
            false => MAX_ENTRIES,
        };
        let mut entries = Vec::new();
        while args.accept_mark('[')? {
            entry(args, &mut entries)?;
            if !args.accept_mark(']')? {
                return Err(args.expected(&format!("`]` after an entry of `{what}`")));
            }
            if entries.len() > most {
                if args.is_for_3_8() {
                    return Err(args.expected(&format!("at most {most} entries in `{what}`")));
                }
                let message = format!("more than {most} entries in `{what}` need version 3.8");
                let error = Diagnostic::error(args.last_span(), message);
                return Err(Box::new(
                    error.with_hint("Begin the scene with `#version 3.8;`."),
                ));
            }
        }
        match Map::new(entries) {
            Some(map) => args.close().map(|()| Map { blend, ..map }),
            None => Err(args.expected(&format!("`[` and an entry of `{what}`"))),
        }
    }

    /// The blending of neighbouring colours.
    #[must_use]
    pub fn blend(&self) -> Blend {
        self.blend
    }

    /// The map with the roundings of version 3.8, if the scene is of that.
    #[must_use]
    pub(crate) fn rounded_for(mut self, is_3_8: bool) -> Self {
        if is_3_8 && self.blend == Blend::Working {
            self.blend = Blend::Mixed;
        }
        self
    }

    /// The entries with their positions.
    #[must_use]
    pub fn entries(&self) -> &[(f32, T)] {
        &self.entries
    }

    /// A map with other entries at the same positions.
    #[must_use]
    pub fn map<U>(&self, change: impl Fn(&T) -> U) -> Map<U> {
        Map {
            entries: self
                .entries
                .iter()
                .map(|(at, t)| (*at, change(t)))
                .collect(),
            is_sorted: self.is_sorted,
            blend: self.blend,
        }
    }

    /// The entries next to a value. Before the first position and from the last one on this is one entry. Where several
    /// entries share the position `value`, it is the first of them.
    #[must_use]
    pub fn between(&self, value: f64) -> Between<'_, T> {
        let entries = &*self.entries;
        let last = &entries[entries.len() - 1];
        // Compared by `<` and negated below, so that NaN takes the last entry.
        let is_before_last = value < f64::from(last.0);
        if !is_before_last {
            return Between::One(&last.1);
        }
        let is_below = |entry: &(f32, T)| f64::from(entry.0) < value;
        let next = if !self.is_sorted {
            let at_or_above = entries.iter().position(|entry| !is_below(entry));
            at_or_above.unwrap_or(entries.len() - 1)
        } else if entries.len() <= MAX_COUNTED {
            entries.iter().filter(|entry| is_below(entry)).count()
        } else {
            entries.partition_point(is_below)
        };
        let to = &entries[next];
        if next == 0 || f64::from(to.0) == value {
            return Between::One(&to.1);
        }
        let from = &entries[next - 1];
        let (start, end) = (f64::from(from.0), f64::from(to.0));
        Between::Two(&from.1, &to.1, (value - start) / (end - start))
    }
}

impl Map<Color> {
    /// A map of these colours, which must not be empty.
    #[must_use]
    pub fn of_stops(stops: &[Stop]) -> Self {
        Map {
            entries: stops.into(),
            is_sorted: stops.is_sorted_by(|a, b| a.0 <= b.0),
            blend: Blend::default(),
        }
    }

    /// The colour at a value, blended in single precision.
    #[must_use]
    #[inline]
    pub fn color(&self, value: f64) -> Color {
        match self.between(value) {
            Between::One(color) => *color,
            Between::Two(from, to, share) => self.blend.of(from, to, share),
        }
    }

    /// Reads `color_map { ... }` after its keyword. In the old form an entry has two positions and two colours.
    ///
    /// # Errors
    /// A malformed entry, none, or too many.
    pub fn read_colors(args: &mut dyn Args) -> Parse<Map<Color>> {
        let blend: ReadBlend = |_, args| Blend::read(args);
        Map::read_entries("color_map", blend, args, &mut |args, entries| {
            let from = args.single()?;
            args.comma()?;
            let is_vector = args.at_mark('<')?;
            let to = match args.color_or_single()? {
                ColorOrSingle::Color(color) => {
                    if is_vector {
                        let reason = "a vector is no colour here";
                        let remedy = "Write `rgbft` before it.";
                        args.refused_by_povray(args.last_span(), reason, remedy);
                    }
                    entries.push((from, color));
                    return Ok(());
                }
                ColorOrSingle::Single(to) => to,
            };
            comma_in_old_entry(args)?;
            entries.push((from, args.color()?));
            let has_comma = comma_in_old_entry(args)?;
            if !has_comma && !matches!(args.word()?, Some(Word::Color | Word::Colour)) {
                let at = args.span();
                let reason = "the second colour of an entry begins with `color`";
                args.refused_by_povray(at, reason, OLD_ENTRY);
            }
            entries.push((to, args.color()?));
            Ok(())
        })
    }
}

/// A remedy for entries with two positions.
const OLD_ENTRY: &str =
    "Write `[0 0.5 color rgb 0 color rgb 1]`, or `[0 color rgb 0][0.5 color rgb 1]`.";

/// Skips a comma before a colour of an entry with two positions; returns true if there was one.
fn comma_in_old_entry(args: &mut dyn Args) -> Parse<bool> {
    let has_comma = args.comma()?;
    if has_comma {
        let reason = "there is no comma before a colour of an entry with two positions";
        args.refused_by_povray(args.last_span(), reason, OLD_ENTRY);
    }
    Ok(has_comma)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn colors(text: &str) -> Parse<Map<Color>> {
        Map::read_colors(&mut TextArgs::new(text))
    }

    fn map(positions: &[f32]) -> Map<f32> {
        Map::new(positions.iter().map(|&at| (at, at)).collect()).expect("there are entries")
    }

    #[test]
    fn values_outside_the_positions_take_the_entry_at_that_end() {
        let map = map(&[0.25, 0.75]);
        assert_eq!(map.between(0.0), Between::One(&0.25));
        assert_eq!(map.between(0.75), Between::One(&0.75));
        assert_eq!(map.between(2.0), Between::One(&0.75));
        assert_eq!(map.between(0.5), Between::Two(&0.25, &0.75, 0.5));
    }

    #[test]
    fn equal_positions_take_the_first_entry_at_and_the_last_above() {
        let entries = vec![(0.0, 'a'), (0.5, 'b'), (0.5, 'c'), (1.0, 'd')];
        let map = Map::new(entries).expect("there are entries");
        assert_eq!(map.between(0.5), Between::One(&'b'));
        assert_eq!(map.between(0.75), Between::Two(&'c', &'d', 0.5));
    }

    #[test]
    fn a_long_map_is_searched_like_a_short_one() {
        let positions: Vec<f32> = (0..=100u8).map(|i| f32::from(i) / 128.0).collect();
        let map = map(&positions);
        assert_eq!(map.between(0.5), Between::One(&0.5));
        let share = 0.25;
        let expected = Between::Two(&positions[64], &positions[65], share);
        assert_eq!(map.between(0.5 + share / 128.0), expected);
    }

    #[test]
    fn an_unsorted_map_is_searched_from_its_start() {
        // POV-Ray takes the entries in the order in which they are written.
        let map = map(&[0.5, 0.25, 1.0]);
        assert_eq!(map.between(0.125), Between::One(&0.5));
        assert_eq!(map.between(0.75), Between::Two(&0.25, &1.0, 2.0 / 3.0));
    }

    #[test]
    fn the_old_form_gives_two_entries() {
        let map = colors("{ [0, 0.5 color rgb 0 color rgb 1] [0.5 rgb 1] }").unwrap();
        let positions: Vec<f32> = map.entries().iter().map(|entry| entry.0).collect();
        assert_eq!(positions, [0.0, 0.5, 0.5]);
        assert_eq!(map.color(0.25).rgb, crate::base::color::Rgb::splat(0.5));
    }

    #[test]
    fn a_declared_map_can_be_used() {
        let known = colors("{ [0 rgb 0] [1 rgb 1] }").unwrap();
        let mut args = TextArgs::new("{ M }").with("M", known);
        assert_eq!(Map::read_colors(&mut args).unwrap().entries().len(), 2);
        assert!(args.is_done());
    }

    #[test]
    fn a_map_has_entries() {
        let error = colors("{ }").expect_err("it is empty").message;
        assert_eq!(error, "expected `[` and an entry of `color_map`, found `}`");
        let many = format!("{{ {} }}", "[0 rgb 1]".repeat(MAX_ENTRIES + 1));
        let error = colors(&many).expect_err("it is too long").message;
        assert_eq!(
            error,
            "more than 256 entries in `color_map` need version 3.8"
        );
    }
}
