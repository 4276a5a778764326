//! `slope`: the angle between the surface normal and a direction, optionally blended with the altitude of the point.

use crate::base::args::{Args, Parse, Word};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use std::f64::consts::PI;

/// Subtracted from a value of 1, so that full slope stays at the end of the map.
const NUDGE: f64 = 1e-10;

/// A direction, with the range of values that is mapped to 0..1.
#[derive(Clone, Copy, Debug)]
struct Range {
    dir: DVec3,
    from: f64,
    to: f64,
}

#[derive(Clone, Copy, Debug)]
struct Slope {
    /// The direction, or the target point.
    slope: Range,
    target: Target,
    altitude: Option<Range>,
}

/// The meaning of the vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    Direction,
    /// `point_at`: the direction to a point.
    Point,
    /// The same in version 3.8, which subtracts a unit vector, that to the hit point, and normalizes nothing else.
    PointOf38,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let has_block = args.accept_mark('{')?;
    let target = match args.accept(Word::PointAt)? {
        true if args.is_for_3_8() => Target::PointOf38,
        true => Target::Point,
        false => Target::Direction,
    };
    let mut slope = Slope {
        slope: Range {
            dir: args.vector()?,
            from: 0.0,
            to: 1.0,
        },
        target,
        altitude: None,
    };
    if has_block {
        slope.slope.read(args)?;
        if target == Target::Direction && args.accept(Word::Altitude)? {
            let mut altitude = Range {
                dir: args.vector()?,
                from: 0.0,
                to: 1.0,
            };
            altitude.read(args)?;
            slope.altitude = Some(altitude);
        }
        args.close()?;
    }
    Ok(Box::new(slope))
}

impl Range {
    /// Reads the ends, with or without commas; both may be left out, or the second, which is 0 then.
    fn read(&mut self, args: &mut dyn Args) -> Parse<()> {
        args.comma()?;
        if args.at_expression()? {
            self.from = args.float()?;
            args.comma()?;
            self.to = args.float_or(0.0)?;
        }
        Ok(())
    }

    /// Position of a number within the range, 0 at `from` and 1 at `to`. The number itself if both are 0, which stands
    /// for no range.
    fn relative(&self, number: f64) -> f64 {
        if self.from == 0.0 && self.to == 0.0 {
            number
        } else {
            (number - self.from) / (self.to - self.from)
        }
    }
}

impl Pattern for Slope {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }
}

impl PatternEval for Slope {
    fn value(&self, point: DVec3, spot: &SurfacePoint) -> f64 {
        let towards = match self.target {
            Target::Direction => self.slope.dir,
            Target::Point => self.slope.dir - spot.point,
            Target::PointOf38 => self.slope.dir - spot.point.normalize_or_zero(),
        };
        let direction = match self.target {
            Target::PointOf38 => towards,
            Target::Direction | Target::Point => towards.normalize_or_zero(),
        };
        let cosine = spot.normal.dot(direction).clamp(-1.0, 1.0);
        let mut value = self.slope.relative((cosine.asin() / PI * 2.0 + 1.0) * 0.5);
        if let Some(altitude) = &self.altitude {
            let (slope_size, size) = (towards.length(), altitude.dir.length());
            let height = altitude.relative(point.dot(altitude.dir.normalize_or_zero()));
            let total = slope_size + size;
            value = value * slope_size / total + height * size / total;
        }
        if value < 0.0 {
            1.0 + value % 1.0
        } else if value == 1.0 {
            1.0 - NUDGE
        } else {
            value % 1.0
        }
    }

    fn needs_normal(&self) -> bool {
        true
    }
}
