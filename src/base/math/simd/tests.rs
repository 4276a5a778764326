use super::portable::F64x4Portable;
use super::*;

#[test]
fn the_closure_runs_once() {
    let mut count = 0;
    let result = with_widest(|_| {
        count += 1;
        7
    });
    assert_eq!((result, count), (7, 1));
}

/// Kernel that returns the bits of all operations on two times four numbers.
struct Everything([f64; 4], [f64; 4]);

impl SimdKernel for Everything {
    type Output = (Vec<[u64; 4]>, Vec<u32>, [i32; 4]);

    fn run<F: F64x4>(self) -> Self::Output {
        let (a, b) = (F::from_array(&self.0), F::from_array(&self.1));
        let [lt, le, eq] = [a.lt(b), a.le(b), a.eq(b)];
        let from_bits = F::mask_from_bits(0b1010);
        let small = a
            .xor_sign(b)
            .lane_max(F::splat(-1e9))
            .lane_min(F::splat(1e9));
        let (whole, integers) = small.truncate();
        let positive = a.abs().lane_max(F::splat(1e-300)).lane_min(F::splat(1e300));
        let [exponent, mantissa] = positive.exponent_and_mantissa();
        let mut numbers = vec![
            a + b,
            a - b,
            a * b,
            a / b,
            -a,
            a.abs(),
            a.abs().sqrt(),
            a.lane_min(b),
            a.lane_max(b),
            a.xor_sign(b),
            F::select(lt, a, b),
            F::select(from_bits & le, a, b),
            F::select(from_bits | eq, a, b),
            exponent,
            mantissa,
            exponent.exp2(),
            whole,
        ];
        let rows = [a, b, a + b, F::splat(2.0)].map(F::to_array);
        numbers.extend(F::columns(rows.each_ref()));
        let bits = numbers.iter().map(|x| x.to_array().map(f64::to_bits));
        let masks = [lt, le, eq, from_bits, from_bits & lt, from_bits | lt].map(F::bitmask);
        (bits.collect(), masks.into(), integers)
    }
}

/// [`Everything`] in single precision.
struct EverythingSingle([f32; 8], [f32; 8]);

impl SimdKernel for EverythingSingle {
    type Output = (Vec<[u32; 8]>, u32);

    fn run<F: F64x4>(self) -> Self::Output {
        fn of<E: F32x8>(a: &[f32; 8], b: &[f32; 8]) -> (Vec<[u32; 8]>, u32) {
            let (a, b) = (E::from_array(a), E::from_array(b));
            let numbers = [
                a + b,
                a - b,
                a * b,
                a / b,
                a.abs().sqrt(),
                a.lane_min(b),
                a.lane_max(b),
                E::splat(2.0),
            ];
            let bits = numbers.iter().map(|x| x.to_array().map(f32::to_bits));
            (bits.collect(), a.le(b))
        }
        of::<F::F32>(&self.0, &self.1)
    }
}

#[test]
fn all_levels_give_the_same_bits() {
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        1e-300,
        -7e290,
        3e299,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MIN_POSITIVE / 4.0,
        0.1,
        -2147483647.5,
    ];
    let count = numbers.len();
    for i in 0..count {
        for j in 0..count {
            let a = std::array::from_fn(|lane| numbers[(i + lane) % count]);
            let b = std::array::from_fn(|lane| numbers[(j + 2 * lane) % count]);
            // Sign and payload of NaN may differ.
            let canonical = |(numbers, masks, integers): <Everything as SimdKernel>::Output| {
                let number = |bits| match f64::from_bits(bits).is_nan() {
                    true => f64::NAN.to_bits(),
                    false => bits,
                };
                let numbers: Vec<_> = numbers.iter().map(|lanes| lanes.map(number)).collect();
                (numbers, masks, integers)
            };
            let expected = canonical(Everything(a, b).run::<F64x4Portable>());
            for level in [SimdLevel::NARROW, SimdLevel::widest()] {
                assert_eq!(canonical(level.run(Everything(a, b))), expected);
            }
            for (lane, (a, b)) in a.into_iter().zip(b).enumerate() {
                let scalar = [a + b, F64Lanes::lane_min(a, b), F64Lanes::xor_sign(a, b)];
                for (operation, value) in [0, 7, 9].into_iter().zip(scalar) {
                    let bits = expected.0[operation][lane];
                    assert!(bits == value.to_bits() || value.is_nan());
                }
            }
        }
    }
}

#[test]
fn all_levels_give_the_same_bits_in_single_precision() {
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        1e-30,
        -7e30,
        f32::INFINITY,
        0.1,
        f32::NAN,
    ];
    for i in 0..numbers.len() {
        let a = std::array::from_fn(|lane| numbers[(i + lane) % numbers.len()]);
        let b = std::array::from_fn(|lane| numbers[(2 * i + 5 * lane) % numbers.len()]);
        let canonical = |(numbers, mask): (Vec<[u32; 8]>, u32)| {
            let number = |bits| match f32::from_bits(bits).is_nan() {
                true => f32::NAN.to_bits(),
                false => bits,
            };
            let numbers: Vec<_> = numbers.iter().map(|lanes| lanes.map(number)).collect();
            (numbers, mask)
        };
        let expected = canonical(EverythingSingle(a, b).run::<F64x4Portable>());
        for level in [SimdLevel::NARROW, SimdLevel::widest()] {
            assert_eq!(canonical(level.run(EverythingSingle(a, b))), expected);
        }
    }
}
