//! `pigment`: the colour of a surface, plain or by a pattern.

use crate::args::{Args, Parse, Word, declared, not_built, transform_step};
use crate::color::{Color, Rgb};
use crate::math::Step;
use crate::pattern::{self, Pattern};

/// The colour of a surface as a scene describes it.
#[derive(Clone, Debug)]
pub struct Pigment {
    /// Where the colour comes from.
    pub kind: PigmentKind,
    /// `quick_color`: the colour in previews of quality 5 and less.
    pub quick_color: Option<Color>,
    /// The transforms of the pattern in the order in which they act; those of its texture stand behind its own.
    pub steps: Vec<Step>,
}

/// Where the colour of a pigment comes from.
#[derive(Clone, Debug)]
pub enum PigmentKind {
    /// The same colour everywhere.
    Plain(Color),
    /// A list of colours from which a pattern selects by the whole part of its value.
    List(Box<dyn Pattern>, Vec<Color>),
}

/// Words that a pigment may hold in the language, beside the patterns, and that are missing here.
const MISSING: &[Word] = &[
    Word::AgateTurb,
    Word::ColorMap,
    Word::ColourMap,
    Word::CubicWave,
    Word::Frequency,
    Word::Lambda,
    Word::NoiseGenerator,
    Word::Octaves,
    Word::Omega,
    Word::Phase,
    Word::Pigment,
    Word::PigmentMap,
    Word::PolyWave,
    Word::RampWave,
    Word::ScallopWave,
    Word::SineWave,
    Word::TriangleWave,
    Word::Turbulence,
    Word::UvMapping,
    Word::Warp,
];

impl Default for Pigment {
    /// Black, as POV-Ray has it.
    fn default() -> Self {
        Pigment::plain(Color::opaque(Rgb::BLACK))
    }
}

impl Pigment {
    /// One colour everywhere.
    #[must_use]
    pub fn plain(color: Color) -> Self {
        Pigment {
            kind: PigmentKind::Plain(color),
            quick_color: None,
            steps: Vec::new(),
        }
    }

    /// The pigment of a block; what the block does not say is as in `base`.
    ///
    /// # Errors
    /// A malformed value, or a word that is not built yet.
    pub fn read(args: &mut dyn Args, base: &Pigment) -> Parse<Pigment> {
        args.open()?;
        let mut pigment = match declared::<Pigment>(args)? {
            Some(known) => Pigment::clone(&known),
            None => base.clone(),
        };
        while !args.accept_close()? {
            pigment.read_item(args)?;
        }
        Ok(pigment)
    }

    fn read_item(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(color) = args.color_if_any()? {
            self.kind = PigmentKind::Plain(color);
            return Ok(());
        }
        if let Some(step) = transform_step(args)? {
            self.steps.push(step);
            return Ok(());
        }
        let Some(word) = args.word()? else {
            return Err(args.expected("a colour, a pattern or `}` in `pigment`"));
        };
        match word {
            Word::QuickColor | Word::QuickColour => {
                args.accept(word)?;
                self.quick_color = Some(args.color()?);
                return Ok(());
            }
            _ => {}
        }
        if let PigmentKind::List(pattern, _) = &mut self.kind
            && pattern.read_modifier(word, args)?
        {
            return Ok(());
        }
        if let Some(pattern) = pattern::named(word) {
            args.accept(word)?;
            let colors = color_list(pattern.default_colors(), args)?;
            self.kind = PigmentKind::List(pattern, colors);
            return Ok(());
        }
        if pattern::is_pattern(word) || MISSING.contains(&word) {
            return Err(not_built(args, word));
        }
        Err(args.expected("a colour, a pattern or `}` in `pigment`"))
    }

    /// Moves what filters into what transmits, as versions up to 3.1 do in the upper layers of a texture.
    pub fn filter_to_transmit(&mut self) {
        let colors = match &mut self.kind {
            PigmentKind::Plain(color) => std::slice::from_mut(color),
            PigmentKind::List(_, colors) => colors.as_mut_slice(),
        };
        for color in colors {
            color.transmit += color.filter;
            color.filter = 0.0;
        }
    }
}

/// The colours of a list, with or without commas between them; those left out are as in `defaults`.
fn color_list(defaults: &[Color], args: &mut dyn Args) -> Parse<Vec<Color>> {
    let mut colors = defaults.to_vec();
    for slot in &mut colors {
        if let Some(color) = args.color_if_any()? {
            *slot = color;
        } else if args.at_expression()? {
            *slot = args.color()?;
        } else {
            break;
        }
        args.comma()?;
    }
    Ok(colors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use glam::DVec3;

    fn read(text: &str) -> Parse<Pigment> {
        Pigment::read(&mut TextArgs::new(text), &Pigment::default())
    }

    fn error(text: &str) -> String {
        read(text).expect_err("the text is faulty").message
    }

    fn list(pigment: &Pigment) -> &[Color] {
        match &pigment.kind {
            PigmentKind::List(_, colors) => colors,
            PigmentKind::Plain(_) => panic!("the pigment has a pattern"),
        }
    }

    #[test]
    fn a_colour_makes_a_plain_pigment() {
        let pigment = read("{ rgbf <1, 0.5, 0, 0.25> }").unwrap();
        let expected = Color::from_components([1.0, 0.5, 0.0, 0.25, 0.0]);
        assert!(matches!(pigment.kind, PigmentKind::Plain(color) if color == expected));
    }

    #[test]
    fn a_list_shorter_than_the_pattern_ends_in_default_colours() {
        // POV-Ray 3.7 draws the second colour of `checker rgb 1` as rgb <0, 1, 0>.
        let pigment = read("{ checker rgb 1 }").unwrap();
        let green = Color::opaque(Rgb::new(0.0, 1.0, 0.0));
        assert_eq!(list(&pigment), [Color::opaque(Rgb::WHITE), green]);
    }

    #[test]
    fn a_list_may_hold_bare_vectors() {
        let pigment = read("{ hexagon <1,0,0>, <0,1,0>, rgb 0.5 }").unwrap();
        assert_eq!(list(&pigment)[0], Color::opaque(Rgb::new(1.0, 0.0, 0.0)));
        assert_eq!(list(&pigment)[2], Color::opaque(Rgb::splat(0.5)));
    }

    #[test]
    fn a_second_block_changes_the_first() {
        // POV-Ray 3.7 keeps the pattern and adds the transform.
        let first = read("{ checker rgb 1 rgb 0 scale 2 }").unwrap();
        let second = Pigment::read(&mut TextArgs::new("{ translate 1 }"), &first).unwrap();
        let expected = [Step::Scale(DVec3::splat(2.0)), Step::Translate(DVec3::ONE)];
        assert_eq!(second.steps, expected);
        assert_eq!(list(&second).len(), 2);
    }

    #[test]
    fn a_declared_pigment_can_be_changed() {
        let known = Pigment::plain(Color::opaque(Rgb::WHITE));
        let mut args = TextArgs::new("{ P quick_color rgb 0.5 }").with("P", known);
        let pigment = Pigment::read(&mut args, &Pigment::default()).unwrap();
        assert!(matches!(pigment.kind, PigmentKind::Plain(color) if color.rgb == Rgb::WHITE));
        assert_eq!(pigment.quick_color, Some(Color::opaque(Rgb::splat(0.5))));
        assert!(args.is_done());
    }

    #[test]
    fn brick_reads_its_size_after_the_colours() {
        let pigment = read("{ brick rgb 0 rgb 1 brick_size <2, 2, 2> mortar 0.25 }").unwrap();
        let PigmentKind::List(pattern, _) = pigment.kind else {
            panic!("brick is a pattern");
        };
        assert_eq!(pattern.value(DVec3::new(1.9, 0.5, 0.5)), 0.0);
        assert_eq!(pattern.value(DVec3::new(1.7, 0.5, 0.5)), 1.0);
    }

    #[test]
    fn what_is_missing_is_named() {
        assert_eq!(error("{ bozo }"), "`bozo` is not built yet");
        assert_eq!(
            error("{ checker turbulence 1 }"),
            "`turbulence` is not built yet"
        );
        assert_eq!(
            error("{ checker pigment { rgb 1 } }"),
            "`pigment` is not built yet"
        );
    }

    #[test]
    fn brick_size_belongs_to_brick() {
        assert_eq!(
            error("{ checker rgb 1 rgb 0 brick_size 2 }"),
            "expected a colour, a pattern or `}` in `pigment`, found `brick_size`"
        );
    }
}
