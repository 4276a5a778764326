//! `internal(n)`: the functions behind the names of functions.inc.
//!
//! Each is a formula of a point and of the extra parameters that functions.inc describes. The formulas were found from
//! the shapes' mathematics and by fitting, and compared with the values that POV-Ray 3.7 prints at many points.
//! Most of the algebraic surfaces are cut off at [`LIMIT`]: they grow fast away from the surface.

mod curves;
mod surfaces;

use std::fmt;

/// Where POV-Ray cuts off the values of most algebraic surfaces.
const LIMIT: f64 = 10.0;

/// A built-in function.
pub struct Internal {
    /// As `internal(n)` writes it.
    pub number: u16,
    /// Its name in functions.inc.
    pub name: &'static str,
    /// How many parameters it takes beside the point.
    extra: usize,
    formula: fn(&[f64]) -> f64,
}

impl fmt::Debug for Internal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)
    }
}

impl Internal {
    /// A row of the lists: `N` is three for the point and one for each further parameter.
    const fn new(number: u16, name: &'static str, extra: usize, formula: fn(&[f64]) -> f64) -> Self {
        Internal {
            number,
            name,
            extra,
            formula,
        }
    }

    /// How many arguments it takes.
    #[must_use]
    pub fn parameters(&self) -> usize {
        3 + self.extra
    }

    /// The value for these arguments; zero if they are too few.
    #[must_use]
    pub fn value(&self, arguments: &[f64]) -> f64 {
        match arguments.get(..self.parameters()) {
            Some(arguments) => (self.formula)(arguments),
            None => 0.0,
        }
    }
}

/// All of them.
static LISTS: [&[Internal]; 2] = [curves::LIST, surfaces::LIST];

/// The function of this number, if there is one.
#[must_use]
pub fn of_number(number: f64) -> Option<&'static Internal> {
    let mut all = LISTS.into_iter().flatten();
    all.find(|internal| f64::from(internal.number) == number.trunc())
}

/// A value within the limit.
fn limited(value: f64) -> f64 {
    value.clamp(-LIMIT, LIMIT)
}
