//! Vectors of four, component by component. Sums stand in the order of those of `glam`.

use super::F64Lanes;
use glam::DVec3;

/// Four vectors: their x, their y, their z.
pub(crate) type Vec3Lanes<F> = [F; 3];

/// The same vector four times.
#[inline(always)]
pub(crate) fn same<F: F64Lanes>(v: DVec3) -> Vec3Lanes<F> {
    [F::all(v.x), F::all(v.y), F::all(v.z)]
}

// A closure would not take part in the wide lanes of its caller, so these are spelt out.

#[inline(always)]
pub(crate) fn load<F: F64Lanes>(from: &[[f64; 4]; 3]) -> Vec3Lanes<F> {
    [F::load(&from[0]), F::load(&from[1]), F::load(&from[2])]
}

#[inline(always)]
pub(crate) fn store<F: F64Lanes>(v: Vec3Lanes<F>) -> [[f64; 4]; 3] {
    [v[0].store(), v[1].store(), v[2].store()]
}

#[inline(always)]
pub(crate) fn dot<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> F {
    a[0].times(b[0])
        .plus(a[1].times(b[1]))
        .plus(a[2].times(b[2]))
}

#[inline(always)]
pub(crate) fn plus<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])]
}

#[inline(always)]
pub(crate) fn minus<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [a[0].minus(b[0]), a[1].minus(b[1]), a[2].minus(b[2])]
}

#[inline(always)]
pub(crate) fn scaled<F: F64Lanes>(v: Vec3Lanes<F>, by: F) -> Vec3Lanes<F> {
    [v[0].times(by), v[1].times(by), v[2].times(by)]
}

#[inline(always)]
pub(crate) fn over<F: F64Lanes>(v: Vec3Lanes<F>, by: F) -> Vec3Lanes<F> {
    [v[0].over(by), v[1].over(by), v[2].over(by)]
}

/// The vectors without signs.
#[inline(always)]
pub(crate) fn sizes<F: F64Lanes>(v: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [v[0].size(), v[1].size(), v[2].size()]
}

/// The size of the largest component.
#[inline(always)]
pub(crate) fn largest<F: F64Lanes>(v: Vec3Lanes<F>) -> F {
    v[0].size().larger(v[1].size()).larger(v[2].size())
}
