//! `area_light`: a grid of lamps, or a disc, over which shadows are averaged.
//!
//! Only shadows are: direction and strength of the light are those of its centre, unless `area_illumination` asks for
//! each lamp by itself. A part of the grid is divided where its corners differ, or down to the depth of `adaptive`;
//! the default of 100 divides everything, which counts the inner lamps of odd grids more than once.

use super::part::first_lamps;
use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Diagnostic, Span};
use glam::{DAffine3, DVec3};
use std::sync::OnceLock;

/// The `adaptive` of lights that give none.
const ALL_LAMPS: u32 = 100;
/// Lamps on each side; more than any scene can wait for.
const MOST_LAMPS: f64 = 4096.0;
/// By this POV-Ray moves the lamps of a disc, so that none is in the very middle.
const OFF_CENTRE: f64 = 0.001;
/// Within this of one, the direction to the light counts as that of an axis; POV-Ray's value.
const ALONG_AXIS: f64 = 0.01;

/// A grid of lamps.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// The sides of the grid.
    pub axes: Axes,
    /// How many lamps there are along each side.
    pub sizes: [u32; 2],
    /// Down to this depth the grid is divided even where its corners agree.
    pub adaptive: u32,
    /// Whether lamps are moved at random.
    pub has_jitter: bool,
    /// Whether the grid is bent to a disc.
    pub is_circular: bool,
    /// Whether it turns to the point that it lights.
    pub is_oriented: bool,
    /// `area_illumination`: whether each lamp gives light from where it is.
    pub is_full: bool,
    /// Where a word that only round areas can have stands.
    at_circular: Option<Span>,
    /// The lamps that are asked about for each point, once they are known.
    first: OnceLock<Vec<[u32; 2]>>,
}

/// The two sides of a grid of lamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The side along which the first index counts.
    pub first: DVec3,
    /// The other one.
    pub second: DVec3,
}

impl Area {
    fn new() -> Self {
        Area {
            axes: Axes {
                first: DVec3::ZERO,
                second: DVec3::ZERO,
            },
            sizes: [1, 1],
            adaptive: ALL_LAMPS,
            has_jitter: false,
            is_circular: false,
            is_oriented: false,
            is_full: false,
            at_circular: None,
            first: OnceLock::new(),
        }
    }

    /// The lamps that are asked about for each point, whatever comes from them, in this order.
    #[must_use]
    pub fn first_lamps(&self) -> &[[u32; 2]] {
        self.first
            .get_or_init(|| first_lamps(self.sizes, self.adaptive))
    }

    /// Takes `word` and its value into the area of a light if it is one of this element, and says whether it was.
    ///
    /// # Errors
    /// A malformed value, or a number of lamps that is none.
    pub(super) fn read_item(
        area: &mut Option<Box<Area>>,
        word: Word,
        args: &mut dyn Args,
    ) -> Parse<bool> {
        if word == Word::AreaLight {
            let known = area.take().map_or_else(Area::new, |area| *area);
            *area = Some(Box::new(known.read_grid(args)?));
            return Ok(true);
        }
        if !matches!(
            word,
            Word::Adaptive | Word::Jitter | Word::Circular | Word::Orient | Word::AreaIllumination
        ) {
            return Ok(false);
        }
        let at = args.span();
        args.accept(word)?;
        let Some(area) = area else {
            if word == Word::Adaptive {
                args.float()?;
            } else if word == Word::AreaIllumination {
                args.float_or(1.0)?;
            }
            args.warn(
                Diagnostic::warning(at, format!("`{word}` does nothing without `area_light`"))
                    .with_hint("Write `area_light` before it."),
            );
            return Ok(true);
        };
        match word {
            Word::Adaptive => area.adaptive = whole(args.float()?),
            Word::Jitter => area.has_jitter = true,
            Word::AreaIllumination => area.is_full = args.float_or(1.0)? != 0.0,
            _ => {
                area.is_oriented |= word == Word::Orient;
                area.is_circular = true;
                area.at_circular = Some(at);
            }
        }
        Ok(true)
    }

    /// `area_light AXIS, AXIS, COUNT, COUNT`.
    fn read_grid(mut self, args: &mut dyn Args) -> Parse<Area> {
        args.accept(Word::AreaLight)?;
        self.axes.first = args.vector()?;
        args.comma()?;
        self.axes.second = args.vector()?;
        for size in &mut self.sizes {
            args.comma()?;
            let at = args.span();
            let count = args.float()?.trunc();
            if !(1.0..=MOST_LAMPS).contains(&count) {
                let message = format!(
                    "an area light has 1 to {MOST_LAMPS} lamps along each side, not {count}"
                );
                return Err(Box::new(Diagnostic::error(
                    at.to(args.last_span()),
                    message,
                )));
            }
            *size = whole(count);
        }
        Ok(self)
    }

    /// Checks what can be known only at the end of the light.
    pub(super) fn end(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(at) = self.at_circular
            && self.sizes.contains(&1)
        {
            let message = "a round area light needs more than one lamp along each side";
            return Err(Box::new(Diagnostic::error(at, message)));
        }
        let (first, second) = (self.axes.first.length(), self.axes.second.length());
        if let Some(at) = self.at_circular
            && self.is_oriented
            && (first - second).abs() > ALONG_AXIS * first
        {
            args.warn(Diagnostic::warning(
                at,
                "`orient` makes both sides of the area light as long as the first",
            ));
        }
        Ok(())
    }

    pub(super) fn transform(&mut self, to_world: &DAffine3) {
        self.axes.first = to_world.transform_vector3(self.axes.first);
        self.axes.second = to_world.transform_vector3(self.axes.second);
    }

    /// The sides of the grid as a point sees it that has the light in the unit direction `to_light`.
    #[must_use]
    pub fn axes_for(&self, to_light: DVec3) -> Axes {
        if !self.is_oriented {
            return self.axes;
        }
        let aside = if (to_light.z.abs() - 1.0).abs() < ALONG_AXIS {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let first = to_light.cross(aside).normalize_or_zero();
        let second = to_light.cross(first).normalize_or_zero();
        let length = self.axes.first.length();
        Axes {
            first: first * length,
            second: second * length,
        }
    }

    /// How far the lamp of two indices stands from the centre of the light. Jitter makes indices that are not whole.
    #[must_use]
    pub fn lamp(&self, axes: &Axes, u: f64, v: f64) -> DVec3 {
        let place = |index: f64, size: u32| {
            if size > 1 {
                index / f64::from(size - 1) - 0.5
            } else {
                0.0
            }
        };
        let (mut a, mut b) = (place(u, self.sizes[0]), place(v, self.sizes[1]));
        if self.is_circular {
            a += OFF_CENTRE;
            b += OFF_CENTRE;
            let bent = a.abs().max(b.abs()) / a.hypot(b);
            a *= bent;
            b *= bent;
        }
        a * axes.first + b * axes.second
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates: a negative depth is as good as none"
)]
fn whole(number: f64) -> u32 {
    number as u32
}

#[cfg(test)]
mod tests {
    use super::super::Light;
    use super::*;
    use crate::base::args::text::TextArgs;

    fn area(text: &str) -> Parse<Area> {
        let mut args = TextArgs::new(text);
        let mut light = Light::begin(&mut args)?;
        while light.read_item(&mut args)? {}
        light.end(&mut args)?;
        assert!(args.is_done());
        light
            .area
            .map(|area| *area)
            .ok_or_else(|| args.expected("an area"))
    }

    #[test]
    fn lamps_stand_from_end_to_end() {
        let area = area("0 rgb 1 area_light <4, 0, 0>, <0, 2, 0>, 3, 1").unwrap();
        let lamp = |u| area.lamp(&area.axes, u, 0.0);
        assert_eq!(lamp(0.0), DVec3::new(-2.0, 0.0, 0.0));
        assert_eq!(
            (lamp(1.0), lamp(2.0)),
            (DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0))
        );
    }

    #[test]
    fn the_lamps_of_a_disc_lie_in_circles() {
        let area = area("0 rgb 1 area_light <2, 0, 0>, <0, 2, 0>, 5, 5 circular").unwrap();
        let far = |u, v| area.lamp(&area.axes, u, v).length();
        assert!((far(0.0, 0.0) - 1.0).abs() < 0.01 && (far(0.0, 2.0) - 1.0).abs() < 0.01);
        assert!((far(1.0, 1.0) - 0.5).abs() < 0.01);
    }

    #[test]
    fn an_oriented_disc_stands_across_the_light() {
        let area = area("0 rgb 1 area_light <2, 0, 0>, <0, 0, 2>, 3, 3 orient").unwrap();
        assert!(area.is_circular);
        for to_light in [DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, -0.8)] {
            let axes = area.axes_for(to_light);
            assert!(axes.first.dot(to_light).abs() < 1e-12);
            assert!(axes.second.dot(axes.first).abs() < 1e-12);
            assert!((axes.second.length() - 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn sizes_are_whole_and_more_than_none() {
        // POV-Ray 3.7 cuts 2.7 to 2, refuses 0 and ends with a memory error for -3.
        assert_eq!(
            area("0 rgb 1 area_light 1, 1, 2.7, 1").unwrap().sizes,
            [2, 1]
        );
        for size in ["0", "-3", "10000"] {
            let text = format!("0 rgb 1 area_light 1, 1, {size}, 1");
            let error = area(&text).expect_err("no such number of lamps");
            let expected = format!("an area light has 1 to 4096 lamps along each side, not {size}");
            assert_eq!(error.message, expected);
        }
    }

    #[test]
    fn a_disc_needs_lamps_along_both_sides() {
        let error = area("0 rgb 1 area_light 1, 1, 3, 1 circular").expect_err("it is a line");
        assert_eq!(
            error.message,
            "a round area light needs more than one lamp along each side"
        );
    }
}
