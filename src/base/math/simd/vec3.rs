//! Three-dimensional vectors in structure-of-arrays form. Sums are in the order of `glam`'s.

use super::F64Lanes;
use glam::DVec3;

/// One vector per lane: the x, the y and the z components.
pub(crate) type Vec3Lanes<F> = [F; 3];

/// The vector `v` in all lanes.
#[inline(always)]
pub(crate) fn splat<F: F64Lanes>(v: DVec3) -> Vec3Lanes<F> {
    [F::splat(v.x), F::splat(v.y), F::splat(v.z)]
}

// Components are written out: a closure is not compiled for the SIMD level of its caller.

#[inline(always)]
pub(crate) fn from_arrays<F: F64Lanes>(from: &[[f64; 4]; 3]) -> Vec3Lanes<F> {
    [
        F::from_array(&from[0]),
        F::from_array(&from[1]),
        F::from_array(&from[2]),
    ]
}

#[inline(always)]
pub(crate) fn to_arrays<F: F64Lanes>(v: Vec3Lanes<F>) -> [[f64; 4]; 3] {
    [v[0].to_array(), v[1].to_array(), v[2].to_array()]
}

#[inline(always)]
pub(crate) fn dot<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn add<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub<F: F64Lanes>(a: Vec3Lanes<F>, b: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale<F: F64Lanes>(v: Vec3Lanes<F>, by: F) -> Vec3Lanes<F> {
    [v[0] * by, v[1] * by, v[2] * by]
}

#[inline(always)]
pub(crate) fn divide<F: F64Lanes>(v: Vec3Lanes<F>, by: F) -> Vec3Lanes<F> {
    [v[0] / by, v[1] / by, v[2] / by]
}

/// The absolute values of the components.
#[inline(always)]
pub(crate) fn abs<F: F64Lanes>(v: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [v[0].abs(), v[1].abs(), v[2].abs()]
}

/// The largest absolute value of a component.
#[inline(always)]
pub(crate) fn max_abs<F: F64Lanes>(v: Vec3Lanes<F>) -> F {
    v[0].abs().lane_max(v[1].abs()).lane_max(v[2].abs())
}
