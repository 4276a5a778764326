//! The functions of complex numbers that a hypercomplex fractal may iterate.

use crate::base::args::Word;
use crate::base::math::Complex;
use std::ops::Neg;

/// A function of a complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Function {
    Square,
    /// The square again: the cube of hypercomplex numbers in POV-Ray 3.7 (measured).
    Cube,
    Reciprocal,
    Exp,
    Ln,
    Sin,
    Asin,
    Sinh,
    Asinh,
    Cos,
    Acos,
    Cosh,
    Acosh,
    Tan,
    Atan,
    Tanh,
    Atanh,
    /// The power with this exponent.
    Power(Complex),
}

impl Function {
    /// The functions without a parameter, by keyword.
    pub(super) const NAMED: &[(Word, Function)] = &[
        (Word::Sqr, Function::Square),
        (Word::Cube, Function::Cube),
        (Word::Reciprocal, Function::Reciprocal),
        (Word::Exp, Function::Exp),
        (Word::Ln, Function::Ln),
        (Word::Sin, Function::Sin),
        (Word::Asin, Function::Asin),
        (Word::Sinh, Function::Sinh),
        (Word::Asinh, Function::Asinh),
        (Word::Cos, Function::Cos),
        (Word::Acos, Function::Acos),
        (Word::Cosh, Function::Cosh),
        (Word::Acosh, Function::Acosh),
        (Word::Tan, Function::Tan),
        (Word::Atan, Function::Atan),
        (Word::Tanh, Function::Tanh),
        (Word::Atanh, Function::Atanh),
    ];

    /// The value at `z`.
    pub(super) fn value(self, z: Complex) -> Complex {
        let one = Complex::ONE;
        match self {
            Function::Square | Function::Cube => z * z,
            Function::Reciprocal => one / z,
            Function::Exp => z.exp(),
            Function::Ln => z.ln(),
            Function::Sin => z.sin(),
            Function::Asin => z.asin(),
            Function::Sinh => z.sinh(),
            Function::Asinh => z.times_i().asin().times_i().neg(),
            Function::Cos => z.cos(),
            Function::Acos => z.acosh().times_i().neg(),
            Function::Cosh => z.times_i().cos(),
            Function::Acosh => z.acosh(),
            Function::Tan => z.tan(),
            Function::Atan => z.times_i().atanh().times_i().neg(),
            Function::Tanh => z.tanh(),
            Function::Atanh => z.atanh(),
            Function::Power(exponent) => z.power(exponent),
        }
    }

    /// The factor of `z` in the product that POV-Ray takes for the derivative of several iterations: the value of the
    /// function but for three of them (measured).
    pub(super) fn factor(self, z: Complex) -> Complex {
        match self {
            Function::Square | Function::Cube => z,
            Function::Reciprocal => -(Complex::ONE / (z * z)),
            _ => self.value(z),
        }
    }

    /// True if the inside test of POV-Ray 3.7 takes the second coordinate for the third, too (measured).
    pub(super) fn tests_y_as_z(self) -> bool {
        !matches!(
            self,
            Function::Square | Function::Cube | Function::Reciprocal
        )
    }
}

impl Complex {
    /// `1 - self`, with the sign of a zero that POV-Ray has on branch cuts (measured).
    fn one_minus(self) -> Self {
        Complex::new(1.0 - self.re, -self.im)
    }

    fn times_i(self) -> Self {
        Complex::new(-self.im, self.re)
    }

    fn exp(self) -> Self {
        let (sin, cos) = self.im.sin_cos();
        let size = self.re.exp();
        Complex::new(size * cos, size * sin)
    }

    fn ln(self) -> Self {
        Complex::new(0.5 * self.norm_sq().ln(), self.im.atan2(self.re))
    }

    fn sqrt(self) -> Self {
        let size = self.re.hypot(self.im);
        let (re, im) = (
            (0.5 * (size + self.re)).sqrt(),
            (0.5 * (size - self.re)).sqrt(),
        );
        Complex::new(re, im.copysign(self.im))
    }

    fn sin(self) -> Self {
        let (sin, cos) = self.re.sin_cos();
        Complex::new(sin * self.im.cosh(), cos * self.im.sinh())
    }

    fn cos(self) -> Self {
        let (sin, cos) = self.re.sin_cos();
        Complex::new(cos * self.im.cosh(), -sin * self.im.sinh())
    }

    fn sinh(self) -> Self {
        let (sin, cos) = self.im.sin_cos();
        Complex::new(self.re.sinh() * cos, self.re.cosh() * sin)
    }

    fn tan(self) -> Self {
        let (re, im) = (2.0 * self.re, 2.0 * self.im);
        let divisor = re.cos() + im.cosh();
        Complex::new(re.sin() / divisor, im.sinh() / divisor)
    }

    fn tanh(self) -> Self {
        let (re, im) = (2.0 * self.re, 2.0 * self.im);
        let divisor = re.cosh() + im.cos();
        Complex::new(re.sinh() / divisor, im.sin() / divisor)
    }

    fn asin(self) -> Self {
        let root = (self * self).one_minus().sqrt();
        (self.times_i() + root).ln().times_i().neg()
    }

    /// With the branch cuts of POV-Ray (measured).
    fn acosh(self) -> Self {
        (self + (self * self - Complex::ONE).sqrt()).ln()
    }

    fn atanh(self) -> Self {
        let ln = ((Complex::ONE + self) / self.one_minus()).ln();
        Complex::new(0.5 * ln.re, 0.5 * ln.im)
    }

    fn power(self, exponent: Complex) -> Self {
        let ln = Complex::new(self.norm_sq().sqrt().ln(), self.im.atan2(self.re));
        (exponent * ln).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_functions_undo_each_other() {
        let z = Complex::new(0.3, -0.4);
        for (function, inverse) in [
            (Function::Sin, Function::Asin),
            (Function::Cos, Function::Acos),
            (Function::Tan, Function::Atan),
            (Function::Sinh, Function::Asinh),
            (Function::Cosh, Function::Acosh),
            (Function::Tanh, Function::Atanh),
            (Function::Exp, Function::Ln),
        ] {
            let there_and_back = function.value(inverse.value(z));
            assert!((there_and_back - z).norm_sq() < 1e-24, "{function:?}");
        }
    }
}
