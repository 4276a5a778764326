//! The first two dimensions of the Sobol' sequence with Owen scrambling.
//!
//! It is a (0, 2)-sequence: of the first `2^k` points each of the `2^k` rectangles `2^-a` by `2^-b` with `a + b = k`
//! contains exactly one, for any `a`. Owen scrambling (1995) preserves this and makes each point uniform over the
//! square. It uses the hash of Laine and Karras in Burley's form ("Practical Hash-based Owen Scrambling", 2020).

/// A scrambled sequence, determined by its seeds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sobol {
    seed_x: u32,
    seed_y: u32,
}

impl Sobol {
    /// The sequence of a pixel.
    pub(crate) fn of_pixel(x: i32, y: i32) -> Self {
        let of_column = mixed(x.cast_unsigned());
        let seed_x = mixed(of_column ^ y.cast_unsigned().rotate_left(16));
        Sobol {
            seed_x,
            seed_y: mixed(seed_x ^ 0x9e37_79b9),
        }
    }

    /// Point `number` of the sequence, in units of `2^-32` of the side of the square.
    pub(crate) fn point(&self, number: u32) -> (u32, u32) {
        // The first dimension is the number with its bits reversed, and scrambling works on reversed bits: both cancel.
        let x = scrambled(number, self.seed_x).reverse_bits();
        let y = scrambled(second_dimension(number), self.seed_y).reverse_bits();
        (x, y)
    }
}

/// The second dimension with its bits reversed. Its generator matrix is Pascal's triangle modulo 2: with the bits of
/// the number as a polynomial `p(x)` over GF(2), the result is `p(1 + x)`. Each step expands half of the bits, since
/// for example `(1 + x)^16 = 1 + x^16`.
fn second_dimension(mut number: u32) -> u32 {
    number ^= number >> 16;
    number ^= number >> 8 & 0x00ff_00ff;
    number ^= number >> 4 & 0x0f0f_0f0f;
    number ^= number >> 2 & 0x3333_3333;
    number ^ number >> 1 & 0x5555_5555
}

/// Owen scrambling of reversed bits: each bit is flipped depending on the bits below it.
fn scrambled(mut v: u32, seed: u32) -> u32 {
    v = v.wrapping_add(seed);
    for factor in [0x6c50_b47c, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6] {
        v ^= v.wrapping_mul(factor);
    }
    v
}

/// An integer hash (Wellons, "lowbias32").
fn mixed(mut v: u32) -> u32 {
    v = v.wrapping_add(0x6d2b_79f5);
    v ^= v >> 16;
    v = v.wrapping_mul(0x7feb_352d);
    v ^= v >> 15;
    v = v.wrapping_mul(0x846c_a68b);
    v ^ (v >> 16)
}

#[cfg(test)]
mod tests {
    use super::Sobol;

    #[test]
    fn every_elementary_rectangle_holds_one_point() {
        for (column, row) in [(0, 0), (1, 0), (-3, 7), (1000, 4321)] {
            let sobol = Sobol::of_pixel(column, row);
            for k in 0..=8u32 {
                for a in 0..=k {
                    let b = k - a;
                    let mut counts = vec![0; 1 << k];
                    for number in 0..1u32 << k {
                        let (x, y) = sobol.point(number);
                        let cell = |v: u32, bits: u32| v.checked_shr(32 - bits).unwrap_or(0);
                        counts[(cell(x, a) << b | cell(y, b)) as usize] += 1;
                    }
                    assert!(counts.iter().all(|&n| n == 1), "2^{a} by 2^{b}");
                }
            }
        }
    }

    #[test]
    fn the_points_of_different_pixels_are_uniform_and_uncorrelated() {
        // Over 100 by 100 pixels the mean of the first point is 1/2 and that of the product of neighbours 1/4.
        let side = |v: u32| f64::from(v) / 2f64.powi(32);
        let (mut sum, mut product) = ([0.0; 2], 0.0);
        for y in 0..100 {
            for x in 0..100 {
                let here = Sobol::of_pixel(x, y).point(0);
                let next = Sobol::of_pixel(x + 1, y).point(0);
                sum[0] += side(here.0);
                sum[1] += side(here.1);
                product += side(here.0) * side(next.0);
            }
        }
        for sum in sum {
            assert!((sum / 1e4 - 0.5).abs() < 0.01, "{sum}");
        }
        assert!((product / 1e4 - 0.25).abs() < 0.01, "{product}");
    }
}
