//! `rainbow`: an arc of colours around a direction, in front of everything far enough away.

use super::Tint;
use crate::base::args::{Args, Parse, Word, declared};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::smooth;
use crate::base::math::sampling::mersenne::Stream;
use crate::base::source::{Diagnostic, Span};
use crate::scene::pattern::Map;
use glam::DVec3;

/// Directions and angles below this count as zero, and the last colour of the arc ends this far before its edge.
const EPSILON: f64 = 1e-10;
/// The default of both arc angles, in radians: beyond any angle. With `falloff_angle` alone the arc fades towards this
/// angle, so it hardly fades (measured).
const UNBOUNDED_ANGLE: f64 = 360.0;
/// The default of `distance`.
const DEFAULT_DISTANCE: f64 = 1e7;

/// A rainbow.
#[derive(Clone, Debug)]
pub struct Rainbow {
    /// The colours from the inner edge to the outer one; without them the rainbow has no effect.
    pub colors: Option<Map<Color>>,
    /// The unit direction of the centre, away from the light.
    pub direction: DVec3,
    /// The unit direction from the centre to the middle of the arc, perpendicular to `direction`.
    pub up: DVec3,
    /// The angle between `direction` and the middle of the colours, in radians.
    pub angle: f64,
    /// The width of the colours, in radians.
    pub width: f64,
    /// The distance over which light from behind falls to 1/e.
    pub distance: f64,
    /// The amplitude of random offsets across the arc, as a fraction of its width.
    pub jitter: f64,
    /// The angle around `direction` covered by the arc, in radians.
    pub arc_angle: f64,
    /// The angle around `direction` covered by the arc at full strength, in radians.
    pub falloff_angle: f64,
    /// The unit direction to the right of the arc.
    right: DVec3,
}

/// The arc angles of a block, as far as it states them.
#[derive(Default)]
struct Angles {
    arc: Option<f64>,
    falloff: Option<f64>,
}

impl Rainbow {
    fn new() -> Self {
        Rainbow {
            colors: None,
            direction: DVec3::ZERO,
            up: DVec3::Y,
            angle: 0.0,
            width: 0.0,
            distance: DEFAULT_DISTANCE,
            jitter: 0.0,
            arc_angle: UNBOUNDED_ANGLE,
            falloff_angle: UNBOUNDED_ANGLE,
            right: DVec3::ZERO,
        }
    }

    /// Reads the block of a rainbow.
    ///
    /// # Errors
    /// A malformed value, no direction, `up` parallel to `direction`, or an `arc_angle` below `falloff_angle`.
    pub fn read(args: &mut dyn Args) -> Parse<Rainbow> {
        args.open()?;
        let at = args.last_span();
        let mut rainbow = match declared::<Rainbow>(args)? {
            Some(known) => Rainbow::clone(&known),
            None => Rainbow::new(),
        };
        let mut angles = Angles::default();
        while !args.accept_close()? {
            rainbow.read_item(args, &mut angles)?;
        }
        rainbow.finish(&angles, at)?;
        Ok(rainbow)
    }

    fn read_item(&mut self, args: &mut dyn Args, angles: &mut Angles) -> Parse<()> {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of `rainbow` or `}`"));
        };
        if !matches!(
            word,
            Word::Direction
                | Word::Up
                | Word::ColorMap
                | Word::ColourMap
                | Word::Angle
                | Word::Width
                | Word::Distance
                | Word::Jitter
                | Word::ArcAngle
                | Word::FalloffAngle
        ) {
            return Err(args.expected("a parameter of `rainbow` or `}`"));
        }
        args.accept(word)?;
        match word {
            Word::Direction => self.direction = args.vector()?,
            Word::Up => self.up = args.vector()?,
            Word::ColorMap | Word::ColourMap => {
                let map = Map::read_colors(args)?;
                self.colors = Some(map.rounded_for(args.is_for_3_8()));
            }
            Word::Angle => self.angle = args.float()?.to_radians(),
            Word::Width => self.width = args.float()?.to_radians(),
            Word::Distance => self.distance = args.float()?,
            Word::Jitter => self.jitter = args.float()?,
            Word::ArcAngle => angles.arc = Some(args.float()?.to_radians()),
            _ => angles.falloff = Some(args.float()?.to_radians()),
        }
        Ok(())
    }

    fn finish(&mut self, angles: &Angles, at: Span) -> Parse<()> {
        let fault = |message: &str, hint: &str| {
            Err(Box::new(Diagnostic::error(at, message).with_hint(hint)))
        };
        let Some(direction) = self.direction.try_normalize() else {
            return fault(
                "this rainbow has no direction",
                "Write `direction` with a vector away from the light.",
            );
        };
        let right = self.up.normalize_or_zero().cross(direction);
        if right.length() < EPSILON {
            return fault(
                "`up` and `direction` of this rainbow are parallel",
                "Turn one of the two.",
            );
        }
        self.direction = direction;
        self.right = right.normalize();
        self.up = direction.cross(self.right).normalize();
        match (angles.arc, angles.falloff) {
            (Some(arc), falloff) => {
                self.arc_angle = arc;
                self.falloff_angle = falloff.unwrap_or(arc);
            }
            (None, Some(falloff)) => self.falloff_angle = falloff,
            (None, None) => {}
        }
        if self.arc_angle < self.falloff_angle {
            return fault(
                "`arc_angle` of this rainbow is smaller than `falloff_angle`",
                "The arc has its full strength within `falloff_angle` and ends at `arc_angle`.",
            );
        }
        Ok(())
    }

    /// The effect of the rainbow on light from distance `length` along a unit direction; `None` outside the arc.
    #[must_use]
    pub fn tint(&self, dir: DVec3, length: f64, stream: &mut Stream) -> Option<Tint> {
        let colors = self.colors.as_ref()?;
        let cosine = self.direction.dot(dir);
        if self.width == 0.0 || cosine < 0.0 {
            return None;
        }
        let mut at = (cosine.min(1.0).acos() - self.angle) / self.width + 0.5;
        if self.jitter != 0.0 {
            at += (2.0 * stream.next_number() - 1.0) * self.jitter;
        }
        if !(0.0..=1.0 - EPSILON).contains(&at) {
            return None;
        }
        let fading = self.fading(dir)?;
        let Color {
            rgb,
            filter,
            transmit,
        } = colors.color(at);
        let transmit = f64::from(transmit);
        let transmittance = (-length / self.distance)
            .exp()
            .max(fading * (1.0 - transmit) + transmit);
        let filter = f64::from(filter) * (1.0 - transmittance);
        let filtered = Rgb::WHITE * (1.0 - filter) + rgb * filter;
        Some(Tint {
            factor: filtered * transmittance,
            added: rgb * (1.0 - transmittance),
        })
    }

    /// The fading of the arc in a direction, 0 for full strength to 1; `None` beyond its ends.
    fn fading(&self, dir: DVec3) -> Option<f64> {
        let (x, y) = (dir.dot(self.right), dir.dot(self.up));
        let length = x.hypot(y);
        if length < EPSILON {
            return Some(0.0);
        }
        let angle = (y / length).clamp(-1.0, 1.0).acos();
        let (half_falloff, half_arc) = (0.5 * self.falloff_angle, 0.5 * self.arc_angle);
        if angle <= half_falloff {
            Some(0.0)
        } else if angle <= half_arc {
            Some(smooth((angle - half_falloff) / (half_arc - half_falloff)))
        } else {
            None
        }
    }
}

/// The combined effect of the rainbows in one direction: the mean of their effects.
#[must_use]
pub fn mean_tint(tints: impl Iterator<Item = Tint>) -> Option<Tint> {
    let mut count = 0.0_f64;
    let mut sum = Tint {
        factor: Rgb::BLACK,
        added: Rgb::BLACK,
    };
    for tint in tints {
        count += 1.0;
        sum.factor += tint.factor;
        sum.added += tint.added;
    }
    (count > 0.0).then(|| Tint {
        factor: sum.factor * (1.0 / count),
        added: sum.added * (1.0 / count),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(text: &str) -> Parse<Rainbow> {
        let text = text.replacen('{', "{ color_map { [0 rgb 0] [1 rgb 1] }", 1);
        Rainbow::read(&mut TextArgs::new(&text))
    }

    /// The tint at an angle from the direction z, and at an angle around it from the top.
    fn tint(rainbow: &Rainbow, angle_deg: f64, around_deg: f64) -> Option<Tint> {
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        let (across, up) = around_deg.to_radians().sin_cos();
        let dir = DVec3::new(sin * across, sin * up, cos);
        rainbow.tint(dir, 1e20, &mut Stream::default())
    }

    #[test]
    fn colours_lie_around_the_angle() {
        let rainbow = read("{ direction <0, 0, 2> angle 40 width 4 }").unwrap();
        assert!(tint(&rainbow, 37.9, 0.0).is_none() && tint(&rainbow, 42.1, 0.0).is_none());
        // Without arc angles the arc is a full circle.
        let middle = tint(&rainbow, 40.0, 170.0).expect("it is there");
        assert_eq!(middle.factor, Rgb::BLACK);
        assert!((middle.added.r - 0.5).abs() < 1e-6);
    }

    #[test]
    fn the_arc_fades_to_its_ends() {
        let text = "{ direction <0, 0, 2> angle 40 width 4 arc_angle 120 falloff_angle 60 }";
        let rainbow = read(text).unwrap();
        let transmittance = |around: f64| tint(&rainbow, 40.0, around).map(|tint| tint.factor.r);
        assert_eq!(
            (transmittance(29.0), transmittance(61.0)),
            (Some(0.0), None)
        );
        assert!((transmittance(-45.0).expect("it fades there") - 0.5).abs() < 1e-6);
    }

    #[test]
    fn directions_must_leave_an_arc() {
        for (text, message) in [
            ("{ }", "this rainbow has no direction"),
            (
                "{ direction <0, 1, 0> }",
                "`up` and `direction` of this rainbow are parallel",
            ),
            (
                "{ direction <0, 0, 1> arc_angle 30 falloff_angle 60 }",
                "`arc_angle` of this rainbow is smaller than `falloff_angle`",
            ),
        ] {
            assert_eq!(read(text).expect_err("it is faulty").message, message);
        }
    }
}
