//! `mandel`: the Mandelbrot set in the xy plane, also with higher exponents.

use super::{Coloring, Complex, iterate_power, read_exponent, read_iterations};
use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::scene::pattern::{GREY, Pattern, PatternEval, PrepareContext, Stop, SurfacePoint};
use glam::DVec3;

/// The default colours of exponent 2, as in POV-Ray (measured). Higher exponents have those of most patterns.
const COLORS: [Stop; 6] = [
    (0.0, Color::opaque(Rgb::BLACK)),
    (0.001, Color::opaque(Rgb::BLACK)),
    (0.001, Color::opaque(Rgb::new(0.0, 1.0, 1.0))),
    (0.012, Color::opaque(Rgb::new(1.0, 1.0, 0.0))),
    (0.015, Color::opaque(Rgb::new(1.0, 0.0, 1.0))),
    (0.1, Color::opaque(Rgb::new(0.0, 1.0, 1.0))),
];

#[derive(Clone, Copy, Debug)]
struct Mandel {
    iterations: u32,
    exponent: i32,
    coloring: Coloring,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let iterations = read_iterations(args)?;
    Ok(Box::new(Mandel {
        iterations,
        exponent: 2,
        coloring: Coloring::new(iterations),
    }))
}

impl Pattern for Mandel {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn default_map(&self) -> &'static [Stop] {
        match self.exponent {
            2 => &COLORS,
            _ => &GREY,
        }
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word == Word::Exponent {
            self.exponent = read_exponent(args)?;
            return Ok(true);
        }
        self.coloring.read(word, args)
    }
}

impl PatternEval for Mandel {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let c = Complex::new(point.x, point.y);
        self.coloring
            .value(iterate_power(c, c, self.exponent, self.iterations))
    }
}
