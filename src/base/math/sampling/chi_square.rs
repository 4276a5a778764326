//! Quantiles of the chi-square distribution, by which POV-Ray decides that it has taken enough samples.

/// Error of POV-Ray's logarithm of the gamma function for non-integral arguments below 13. It makes batches of odd size
/// end slightly early (measured at 13, 19 and 23 samples with three confidences: 0.0394 to 0.0398).
const GAMMA_ERROR: f64 = 0.0396;
/// Arguments from here on do not have the error.
const GAMMA_ERROR_LIMIT: f64 = 13.0;
/// Bisections after which a quantile is exact to the last bit.
const BISECTIONS: u32 = 100;

/// The value that a chi-square variable with `degrees` degrees of freedom exceeds with this probability, as POV-Ray
/// computes it.
#[must_use]
pub fn chi_square(degrees: u32, probability: f64) -> f64 {
    let half = 0.5 * f64::from(degrees);
    let (mut low, mut high) = (0.0, 2.0 * f64::from(degrees) + 100.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if 1.0 - lower_gamma(half, 0.5 * middle) > probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The regularised lower incomplete gamma function, by its series or, for large `x`, by the continued fraction of its
/// complement (Abramowitz and Stegun 6.5.29 and 6.5.31).
fn lower_gamma(a: f64, x: f64) -> f64 {
    const MAX_TERMS: u32 = 100_000;
    const PRECISION: f64 = 1e-15;
    if a <= 0.0 || x <= 0.0 {
        return f64::from(u8::from(a <= 0.0));
    }
    let error = if a < GAMMA_ERROR_LIMIT && a.fract() != 0.0 {
        GAMMA_ERROR
    } else {
        0.0
    };
    let scale = (a * x.ln() - x - ln_gamma(a) - error).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for n in 1..MAX_TERMS {
            term *= x / (a + f64::from(n));
            sum += term;
            if term < sum * PRECISION {
                break;
            }
        }
        return scale * sum;
    }
    let mut b = x + 1.0 - a;
    let mut c = f64::MAX;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for n in 1..MAX_TERMS {
        let n = f64::from(n);
        let an = n * (a - n);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        let step = c * d;
        fraction *= step;
        if (step - 1.0).abs() < PRECISION {
            break;
        }
    }
    1.0 - scale * fraction
}

/// The logarithm of the gamma function, by Stirling's series after shifting the argument upwards.
fn ln_gamma(a: f64) -> f64 {
    let (mut a, mut shift) = (a, 0.0);
    while a < 12.0 {
        shift += a.ln();
        a += 1.0;
    }
    let tail = 1.0 / (12.0 * a) - 1.0 / (360.0 * a.powi(3)) + 1.0 / (1260.0 * a.powi(5));
    (a - 0.5) * a.ln() - a + 0.5 * std::f64::consts::TAU.ln() + tail - shift
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chi_square_matches_the_tables() {
        for (degrees, probability, expected) in [
            (2, 0.05, 5.991_465),
            (10, 0.95, 3.940_299),
            (27, 0.8, 20.702_976),
            (100, 0.9, 82.358_136),
            // Odd degrees below 26 have POV-Ray's error.
            (13, 0.8, 1.013 * 8.633_861),
            (23, 0.8, 1.009_35 * 17.186_506),
        ] {
            let quantile = chi_square(degrees, probability);
            let slack = if degrees < 26 && degrees % 2 == 1 {
                0.01
            } else {
                1e-5
            };
            assert!((quantile - expected).abs() < slack, "{degrees}: {quantile}");
        }
    }
}
