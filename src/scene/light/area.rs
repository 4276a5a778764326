//! `area_light`: a rectangular or circular grid of point lights, the grid lights, over which shadows are averaged.
//!
//! Direction and attenuation are those of the centre, unless `area_illumination` lights the point from each grid light.
//! A part of the grid is subdivided where its corners differ, and always down to the depth of `adaptive`. The default
//! of 100 subdivides everything, which counts the inner lights of odd grids more than once.

use super::part::initial_grid_lights;
use crate::base::args::{Args, Parse, Word};
use crate::base::derived::Derived;
use crate::base::source::{Diagnostic, Span};
use glam::{DAffine3, DVec3};

/// The default of `adaptive`: subdivides any grid completely.
const FULL_SUBDIVISION: u32 = 100;
/// Limit for the grid lights along each side; more would take too long to render.
const MAX_SIDE: f64 = 4096.0;
/// POV-Ray's shift of the lights of a circular grid, so that none is at the exact centre.
const OFF_CENTRE: f64 = 0.001;
/// Tolerance for a direction parallel to an axis, and for sides of equal length; POV-Ray's value.
const AXIS_TOLERANCE: f64 = 0.01;

/// The grid of an area light.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// The edge vectors of the grid.
    pub axes: Axes,
    /// The number of grid lights along each side.
    pub sizes: [u32; 2],
    /// The depth down to which the grid is subdivided even where its corners agree.
    pub adaptive: u32,
    /// True if grid lights are jittered at random.
    pub has_jitter: bool,
    /// True if the grid is warped to a disc.
    pub is_circular: bool,
    /// True if the grid turns towards the shading point.
    pub is_oriented: bool,
    /// `area_illumination`: true if each grid light illuminates from its own position.
    pub has_area_illumination: bool,
    /// Span of `circular`.
    at_circular: Option<Span>,
    /// Span of `orient`.
    at_orient: Option<Span>,
    /// Cache for [`Area::initial_grid_lights`].
    initial: Derived<Vec<[u32; 2]>>,
}

/// The two edge vectors of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The edge along which the first index counts.
    pub first: DVec3,
    /// The edge along which the second index counts.
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
            adaptive: FULL_SUBDIVISION,
            has_jitter: false,
            is_circular: false,
            is_oriented: false,
            has_area_illumination: false,
            at_circular: None,
            at_orient: None,
            initial: Derived::default(),
        }
    }

    /// The grid lights sampled for every shading point, regardless of the results, in this order.
    #[must_use]
    pub fn initial_grid_lights(&self) -> &[[u32; 2]] {
        self.initial
            .get_or_init(|| initial_grid_lights(self.sizes, self.adaptive))
    }

    /// Parses `word` and its value if it is an area light parameter. Returns false otherwise.
    ///
    /// # Errors
    /// A malformed value, or a number of grid lights that is out of range.
    pub(super) fn read_item(
        area: &mut Option<Box<Area>>,
        word: Word,
        args: &mut dyn Args,
    ) -> Parse<bool> {
        if word == Word::AreaLight {
            let current = area.take().map_or_else(Area::new, |area| *area);
            *area = Some(Box::new(current.read_grid(args)?));
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
            Word::Adaptive => area.adaptive = saturating_u32(args.float()?),
            Word::Jitter => area.has_jitter = true,
            Word::AreaIllumination => area.has_area_illumination = args.float_or(1.0)? != 0.0,
            _ => {
                area.is_circular = true;
                if word == Word::Orient {
                    area.is_oriented = true;
                    area.at_orient = Some(at);
                } else {
                    area.at_circular = Some(at);
                }
            }
        }
        Ok(true)
    }

    /// Parses `area_light AXIS, AXIS, COUNT, COUNT`.
    fn read_grid(mut self, args: &mut dyn Args) -> Parse<Area> {
        args.accept(Word::AreaLight)?;
        self.axes.first = args.vector()?;
        args.comma()?;
        self.axes.second = args.vector()?;
        for size in &mut self.sizes {
            args.comma()?;
            let at = args.span();
            let count = args.float()?.trunc();
            if !(1.0..=MAX_SIDE).contains(&count) {
                let message =
                    format!("an area light has 1 to {MAX_SIDE} lamps along each side, not {count}");
                return Err(Box::new(Diagnostic::error(
                    at.to(args.last_span()),
                    message,
                )));
            }
            *size = saturating_u32(count);
        }
        Ok(self)
    }

    /// Checks conditions that depend on the whole light.
    pub(super) fn end(&mut self, args: &mut dyn Args) -> Parse<()> {
        if self.sizes.contains(&1) {
            if let Some(at) = self.at_circular {
                let message = "a round area light needs more than one light along each side";
                return Err(Box::new(Diagnostic::error(at, message)));
            }
            // As in POV-Ray, `orient` turns a row of lights, but no circle is made of it.
            self.is_circular = false;
        }
        let (first, second) = (self.axes.first.length(), self.axes.second.length());
        if let Some(at) = self.at_orient
            && (first - second).abs() > AXIS_TOLERANCE * first
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

    /// The edge vectors as seen from a shading point with the unit direction `to_light`. They depend on the direction
    /// only for `orient`.
    #[must_use]
    pub fn axes_for(&self, to_light: DVec3) -> Axes {
        if !self.is_oriented {
            return self.axes;
        }
        let helper = if (to_light.z.abs() - 1.0).abs() < AXIS_TOLERANCE {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let first = to_light.cross(helper).normalize_or_zero();
        let second = to_light.cross(first).normalize_or_zero();
        let length = self.axes.first.length();
        Axes {
            first: first * length,
            second: second * length,
        }
    }

    /// The position of grid light (`u`, `v`) along the axes, from -0.5 to 0.5.
    fn position(&self, u: f64, v: f64) -> [f64; 2] {
        let position = |index: f64, size: u32| {
            if size > 1 {
                index / f64::from(size - 1) - 0.5
            } else {
                0.0
            }
        };
        [position(u, self.sizes[0]), position(v, self.sizes[1])]
    }

    /// The offset of the grid light (`u`, `v`) that emits photons: neither `circular` nor `orient` changes it.
    #[must_use]
    pub fn rectangle_offset(&self, u: f64, v: f64) -> DVec3 {
        let [a, b] = self.position(u, v);
        a * self.axes.first + b * self.axes.second
    }

    /// Half the edges of a parallelogram around the centre that holds all grid lights, wherever jitter moves them.
    #[must_use]
    pub fn half_edges(&self, axes: &Axes) -> [DVec3; 2] {
        let reach = |size: u32| match size {
            1 => OFF_CENTRE,
            _ if self.has_jitter => 0.5 + 0.5 / f64::from(size - 1) + OFF_CENTRE,
            _ => 0.5 + OFF_CENTRE,
        };
        [
            axes.first * reach(self.sizes[0]),
            axes.second * reach(self.sizes[1]),
        ]
    }

    /// The offset of grid light (`u`, `v`) from the centre of the light. Jitter makes the indices fractional.
    #[must_use]
    pub fn grid_light_offset(&self, axes: &Axes, u: f64, v: f64) -> DVec3 {
        let [mut a, mut b] = self.position(u, v);
        if self.is_circular {
            a += OFF_CENTRE;
            b += OFF_CENTRE;
            let warp = a.abs().max(b.abs()) / a.hypot(b);
            a *= warp;
            b *= warp;
        }
        a * axes.first + b * axes.second
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates: a negative depth is as good as none"
)]
fn saturating_u32(number: f64) -> u32 {
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
    fn grid_lights_span_the_edges() {
        let area = area("0 rgb 1 area_light <4, 0, 0>, <0, 2, 0>, 3, 1").unwrap();
        let offset = |u| area.grid_light_offset(&area.axes, u, 0.0);
        assert_eq!(offset(0.0), DVec3::new(-2.0, 0.0, 0.0));
        assert_eq!(
            (offset(1.0), offset(2.0)),
            (DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0))
        );
    }

    #[test]
    fn half_edges_hold_jittered_lights() {
        for shape in ["5, 3", "2, 1", "4, 4 circular"] {
            let text = format!("0 rgb 1 area_light <2, 0, 0>, <0, 3, 0>, {shape} jitter");
            let area = area(&text).unwrap();
            let [across, up] = area.half_edges(&area.axes);
            let last = area.sizes.map(|size| f64::from(size - 1));
            for [u, v] in [
                [-0.5, -0.5],
                [last[0] + 0.5, -0.5],
                [last[0] + 0.5, last[1] + 0.5],
            ] {
                let offset = area.grid_light_offset(&area.axes, u, v).abs();
                assert!(offset.x <= across.x && offset.y <= up.y, "{shape} {offset}");
            }
        }
    }

    #[test]
    fn the_lights_of_a_circular_grid_lie_on_circles() {
        let area = area("0 rgb 1 area_light <2, 0, 0>, <0, 2, 0>, 5, 5 circular").unwrap();
        let radius = |u, v| area.grid_light_offset(&area.axes, u, v).length();
        assert!((radius(0.0, 0.0) - 1.0).abs() < 0.01 && (radius(0.0, 2.0) - 1.0).abs() < 0.01);
        assert!((radius(1.0, 1.0) - 0.5).abs() < 0.01);
    }

    #[test]
    fn an_oriented_disc_is_perpendicular_to_the_light() {
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
    fn sizes_are_positive_integers() {
        // POV-Ray 3.7 truncates 2.7 to 2, refuses 0 and ends with a memory error for -3.
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
    fn a_circular_grid_needs_lights_along_both_sides() {
        let error = area("0 rgb 1 area_light 1, 1, 3, 1 circular").expect_err("it is a line");
        assert_eq!(
            error.message,
            "a round area light needs more than one light along each side"
        );
        assert!(area("0 rgb 1 area_light 1, 1, 3, 1 circular orient").is_err());
        let turned = area("0 rgb 1 area_light 1, 1, 3, 1 orient").unwrap();
        assert!(turned.is_oriented && !turned.is_circular);
    }
}
