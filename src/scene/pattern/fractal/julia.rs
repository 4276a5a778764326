//! `julia`: the Julia set of a complex number in the xy plane, also with higher exponents.

use super::{Coloring, Complex, iterate_power, read_exponent, read_iterations};
use crate::base::args::{Args, Parse, Word};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
struct Julia {
    c: Complex,
    iterations: u32,
    exponent: i32,
    coloring: Coloring,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let c = args.vector2()?;
    args.comma()?;
    let iterations = read_iterations(args)?;
    Ok(Box::new(Julia {
        c: Complex::new(c.x, c.y),
        iterations,
        exponent: 2,
        coloring: Coloring::new(iterations),
    }))
}

impl Pattern for Julia {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word == Word::Exponent {
            self.exponent = read_exponent(args)?;
            return Ok(true);
        }
        self.coloring.read(word, args)
    }
}

impl PatternEval for Julia {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let z = Complex::new(point.x, point.y);
        self.coloring
            .value(iterate_power(z, self.c, self.exponent, self.iterations))
    }
}
