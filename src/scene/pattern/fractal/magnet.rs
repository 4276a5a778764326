//! `magnet`: the fractals of two models of magnetic phase transitions (Peitgen and Richter 1986, "The Beauty of
//! Fractals"), as Mandelbrot or Julia sets in the xy plane.

use super::{Coloring, Complex, Outcome, read_iterations};
use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;

/// Beyond this squared distance from the origin a point has escaped to infinity.
const FAR_SQ: f64 = 1e4;
/// Within this squared distance from 1 a point has converged to 1, which counts as escaping.
const NEAR_SQ: f64 = 1e-4;
/// Initial value of the smallest `|z|²` for Mandelbrot sets, as in POV-Ray.
const INITIAL_LEAST_SQ: f64 = 1e4;

#[derive(Clone, Copy, Debug)]
enum Model {
    First,
    Second,
}

#[derive(Clone, Copy, Debug)]
struct Magnet {
    model: Model,
    /// The parameter of a Julia set; a Mandelbrot set has none.
    c: Option<Complex>,
    iterations: u32,
    coloring: Coloring,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let start = args.span();
    let model = match args.float()?.trunc() {
        1.0 => Model::First,
        2.0 => Model::Second,
        other => {
            let span = start.to(args.last_span());
            let message = format!("the types of `magnet` are 1 and 2, found {other}");
            return Err(Box::new(Diagnostic::error(span, message)));
        }
    };
    let c = if args.accept(Word::Julia)? {
        let c = args.vector2()?;
        args.comma()?;
        Some(Complex::new(c.x, c.y))
    } else if args.accept(Word::Mandel)? {
        None
    } else {
        return Err(args.expected("`mandel` or `julia` after the type of `magnet`"));
    };
    let iterations = read_iterations(args)?;
    Ok(Box::new(Magnet {
        model,
        c,
        iterations,
        coloring: Coloring::new(iterations),
    }))
}

impl Pattern for Magnet {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        self.coloring.read(word, args)
    }
}

impl PatternEval for Magnet {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let point = Complex::new(point.x, point.y);
        let (mut z, c) = match self.c {
            Some(c) => (point, c),
            None => (Complex::ZERO, point),
        };
        let mut least_sq = match self.c {
            Some(_) => z.norm_sq(),
            None => INITIAL_LEAST_SQ,
        };
        for number in 0..self.iterations {
            z = self.model.next(z, c);
            let size_sq = z.norm_sq();
            least_sq = least_sq.min(size_sq);
            if size_sq > FAR_SQ || (z - Complex::ONE).norm_sq() < NEAR_SQ {
                return self.coloring.value(Outcome::Escaped(number, z));
            }
        }
        self.coloring.value(Outcome::Bounded(z, least_sq))
    }
}

impl Model {
    /// An iteration, rounded as POV-Ray rounds it (measured).
    fn next(self, z: Complex, c: Complex) -> Complex {
        let (a, b) = (z.re, z.im);
        let (a_sq, b_sq) = (a * a, b * b);
        let quotient = match self {
            Model::First => {
                let above = Complex::new(a_sq - b_sq + c.re - 1.0, 2.0 * a * b + c.im);
                let below = Complex::new(2.0 * a + c.re - 2.0, 2.0 * b + c.im);
                above / below
            }
            Model::Second => {
                let (c1, c2) = (c - Complex::ONE, c - Complex::ONE * 2.0);
                let product = Complex::new(c1.re * c2.re - c.im * c.im, (c1.re + c2.re) * c.im);
                let linear = |c: Complex| {
                    Complex::new(3.0 * (a * c.re - b * c.im), 3.0 * (a * c.im + b * c.re))
                };
                let above = z.integer_power(3) + linear(c1) + product;
                let below = Complex::new(3.0 * (a_sq - b_sq), 6.0 * a * b)
                    + linear(c2)
                    + product
                    + Complex::ONE;
                above / below
            }
        };
        quotient.square()
    }
}
