//! Patterns given by a formula of the point alone, or of the point and the noise generator.

use crate::base::args::Parse;
use crate::base::math::noise::NoiseGenerator;
use crate::scene::pattern::{GREY, Pattern, PatternEval, PrepareContext, Stop, SurfacePoint, Wave};
use glam::DVec3;

/// A pattern whose value is a formula of the point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Formula {
    value: fn(DVec3) -> f64,
    wave: Wave,
    map: &'static [Stop],
    has_list: bool,
    jumps: bool,
}

/// A pattern whose value is a formula of the point and the noise generator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoiseFormula {
    value: fn(NoiseGenerator, DVec3) -> f64,
    values_x4: Option<ValuesX4>,
    map: &'static [Stop],
    tilt: Option<Tilt>,
}

/// Formula for [`PatternEval::values_x4`] with a noise generator.
type ValuesX4 = fn(NoiseGenerator, &[DVec3; 4]) -> [f64; 4];

/// Formula for [`PatternEval::tilt`] with a noise generator.
type Tilt = fn(NoiseGenerator, DVec3) -> DVec3;

impl Formula {
    /// A pattern from black to white.
    pub(crate) fn new(value: fn(DVec3) -> f64) -> Self {
        Formula {
            value,
            wave: Wave::default(),
            map: &GREY,
            has_list: false,
            jumps: true,
        }
    }

    /// A pattern that selects from a list.
    pub(crate) fn list(value: fn(DVec3) -> f64, map: &'static [Stop]) -> Self {
        Formula {
            value,
            wave: Wave::NONE,
            map,
            has_list: true,
            jumps: true,
        }
    }

    /// The same pattern with its own default colours.
    pub(crate) fn with_map(self, map: &'static [Stop]) -> Self {
        Formula { map, ..self }
    }

    /// The same pattern, if its value does not jump where surfaces may lie: it is smooth, or its coordinates are nudged.
    pub(crate) fn without_jumps(self) -> Self {
        Formula {
            jumps: false,
            ..self
        }
    }

    /// The pattern as the result of a reader.
    #[allow(clippy::unnecessary_wraps, reason = "readers of other patterns fail")]
    pub(crate) fn boxed(self) -> Parse<Box<dyn Pattern>> {
        Ok(Box::new(self))
    }
}

impl NoiseFormula {
    /// A pattern from black to white.
    pub(crate) fn new(value: fn(NoiseGenerator, DVec3) -> f64) -> Self {
        NoiseFormula {
            value,
            values_x4: None,
            map: &GREY,
            tilt: None,
        }
    }

    /// The same pattern with a formula for four points at once.
    pub(crate) fn with_x4(self, values_x4: ValuesX4) -> Self {
        NoiseFormula {
            values_x4: Some(values_x4),
            ..self
        }
    }

    /// The same pattern with its own formula for normals.
    pub(crate) fn with_tilt(self, tilt: Tilt) -> Self {
        NoiseFormula {
            tilt: Some(tilt),
            ..self
        }
    }

    /// The same pattern with its own default colours.
    pub(crate) fn with_map(self, map: &'static [Stop]) -> Self {
        NoiseFormula { map, ..self }
    }

    /// The pattern as the result of a reader.
    #[allow(clippy::unnecessary_wraps, reason = "readers of other patterns fail")]
    pub(crate) fn boxed(self) -> Parse<Box<dyn Pattern>> {
        Ok(Box::new(self))
    }
}

impl Pattern for Formula {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn default_map(&self) -> &'static [Stop] {
        self.map
    }

    fn default_wave(&self) -> Wave {
        self.wave
    }

    fn has_list(&self) -> bool {
        self.has_list
    }
}

impl PatternEval for Formula {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        (self.value)(point)
    }

    fn jumps(&self) -> bool {
        self.jumps
    }
}

impl Pattern for NoiseFormula {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(PreparedNoise {
            value: self.value,
            values_x4: self.values_x4,
            tilt: self.tilt,
            noise: context.noise,
        })
    }

    fn default_map(&self) -> &'static [Stop] {
        self.map
    }
}

/// A formula with its noise generator.
#[derive(Debug)]
struct PreparedNoise {
    value: fn(NoiseGenerator, DVec3) -> f64,
    values_x4: Option<ValuesX4>,
    tilt: Option<Tilt>,
    noise: NoiseGenerator,
}

impl PatternEval for PreparedNoise {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        (self.value)(self.noise, point)
    }

    fn values_x4(&self, points: &[DVec3; 4], _spots: [&SurfacePoint; 4]) -> [f64; 4] {
        match self.values_x4 {
            Some(values_x4) => values_x4(self.noise, points),
            None => points.map(|point| (self.value)(self.noise, point)),
        }
    }

    fn tilt(&self, point: DVec3) -> Option<DVec3> {
        self.tilt.map(|tilt| tilt(self.noise, point))
    }
}
