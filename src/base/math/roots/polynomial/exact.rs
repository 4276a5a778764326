//! Tests of number and position of sign changes against exact integer arithmetic.
//!
//! The tolerance is 16 epsilon times the sum of the coefficients times their number: a change of the constant term by
//! that much must be able to explain the number of roots and the sign at each of them.

use super::sign_changes;
use crate::base::math::exact::Exact;
use crate::base::math::sampling::random::Random;

const TOLERANCE: f64 = 16.0 * f64::EPSILON;

fn check(c: &[f64]) -> usize {
    let roots = sign_changes(c);
    let size: f64 = c.iter().map(|c| c.abs()).sum();
    let degree = f64::from(u32::try_from(c.len()).unwrap());
    let slack = TOLERANCE * degree * size;
    let moved = |by: f64| {
        let mut c = c.to_vec();
        c[0] += by;
        Exact::new(&c)
    };
    let (shrunk, same, grown) = (moved(-slack), moved(0.0), moved(slack));
    let counts = [&shrunk, &same, &grown].map(|p| p.count_between(-1.0, 1.0));
    let least = counts.into_iter().min().unwrap();
    let most = counts.into_iter().max().unwrap();
    assert!(
        (least..=most).contains(&roots.len()),
        "{c:?}: exact {counts:?}, found {roots:?}"
    );
    for x in &roots {
        assert!(shrunk.sign_at(*x) * grown.sign_at(*x) <= 0, "{c:?} at {x}");
    }
    assert!(roots.windows(2).all(|pair| pair[0] <= pair[1]), "{roots:?}");
    let is_ends = same.sign_at(-1.0) * same.sign_at(1.0);
    let is_sure = [&shrunk, &grown]
        .iter()
        .all(|p| p.sign_at(-1.0) == same.sign_at(-1.0) && p.sign_at(1.0) == same.sign_at(1.0));
    if is_sure && is_ends != 0 {
        assert_eq!(roots.len() % 2 == 1, is_ends < 0, "{c:?}: {roots:?}");
    }
    roots.len()
}

fn product(roots: &[f64]) -> Vec<f64> {
    roots.iter().fold(vec![1.0], |c, root| {
        let mut next = vec![0.0; c.len() + 1];
        for (i, c) in c.iter().enumerate() {
            next[i + 1] += c;
            next[i] -= root * c;
        }
        next
    })
}

fn signed(rng: &mut Random) -> f64 {
    2.0 * rng.uniform() - 1.0
}

#[test]
fn random_polynomials_of_every_degree_lose_no_root() {
    let mut rng = Random::new(31);
    let mut count = 0;
    for degree in 1..=35_u32 {
        for _ in 0..(400 / (degree * degree)).max(2) {
            let c: Vec<f64> = (0..=degree).map(|_| signed(&mut rng)).collect();
            count += check(&c);
        }
    }
    assert!(count > 300, "only {count} roots");
}

#[test]
fn products_of_roots_lose_none() {
    let mut rng = Random::new(32);
    for degree in [3, 4, 5, 6, 8, 10, 12] {
        for _ in 0..40 {
            let roots: Vec<f64> = (0..degree).map(|_| 1.5 * signed(&mut rng)).collect();
            check(&product(&roots));
        }
    }
}

#[test]
fn close_double_and_triple_roots_come_as_rounding_allows() {
    let mut rng = Random::new(33);
    for exponent in 2..16 {
        let gap = 10.0_f64.powi(-exponent);
        for _ in 0..8 {
            let a = 0.9 * signed(&mut rng);
            let b = 2.0 * signed(&mut rng);
            let c = 3.0 + rng.uniform();
            check(&product(&[a, a + gap, b, c]));
            check(&product(&[a, a + gap, b, c, -c]));
            check(&product(&[a, a + gap, a + 3.0 * gap, b, c, -c]));
        }
    }
}

#[test]
fn even_powers_and_missing_terms_are_no_special_case() {
    for c in [
        vec![-0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        vec![0.1, 0.0, -1.0, 0.0, 1.0, 0.0, -0.1],
        vec![-1e-12, 0.0, 0.0, 0.0, 0.0, 1.0],
        vec![0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1e-3],
    ] {
        check(&c);
    }
    assert!(sign_changes(&[0.0; 9]).is_empty());
}
