//! The frustum around the rays of a bundle, and its tests against nodes and sphere leaves.

use super::node::{Node, WIDTH};
use super::packet::{REL_ERROR, dot, length_sq, load3, splat3};
use super::sphere_leaf::SphereLeaf;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};

/// Four planes around the rays; a box on the outer side of one is not hit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frustum {
    pub(super) normals: [[f32; 3]; 4],
    pub(super) offsets: [f32; 4],
    /// The lengths of the normals, rounded up.
    pub(super) sizes: [f32; 4],
    /// Bound on the distance of `low` from the start of a ray.
    pub(super) slack: f32,
    /// The box around the starts of the rays; that of a common origin is as large as its rounding.
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

/// The squared distance from the starts to each box of a node, a lower bound, and a mask of the boxes that a ray of
/// length `end` may hit.
pub(super) struct FrustumAndNode<'a> {
    pub(super) frustum: &'a Frustum,
    pub(super) node: &'a Node,
    pub(super) end: f32,
}

impl SimdKernel for FrustumAndNode<'_> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; WIDTH], u32) {
        let (planes, frustum) = (self.node.planes(), self.frustum);
        let mut hits = u32::MAX;
        for side in 0..4 {
            let normal = frustum.normals[side];
            // The corner farthest to the inner side.
            let corner = [
                <F::F32>::from_array(&planes[0][usize::from(normal[0] < 0.0)]),
                <F::F32>::from_array(&planes[1][usize::from(normal[1] < 0.0)]),
                <F::F32>::from_array(&planes[2][usize::from(normal[2] < 0.0)]),
            ];
            hits &= dot(splat3(normal), corner).le(<F::F32>::splat(frustum.offsets[side]));
        }
        let mut near_sq = <F::F32>::splat(0.0);
        for (axis, [low, high]) in planes.iter().enumerate() {
            let below = <F::F32>::from_array(low) - <F::F32>::splat(frustum.high[axis]);
            let above = <F::F32>::splat(frustum.low[axis]) - <F::F32>::from_array(high);
            let gap = below.lane_max(above).lane_max(<F::F32>::splat(0.0));
            near_sq = near_sq + gap * gap;
        }
        let reach = <F::F32>::splat(self.end * self.end * (1.0 + 16.0 * REL_ERROR));
        (near_sq.to_array(), hits & near_sq.le(reach))
    }
}

/// Mask of the spheres of a leaf that a ray of length `end` may hit.
pub(super) struct FrustumAndSphereLeaf<'a> {
    pub(super) frustum: &'a Frustum,
    pub(super) leaf: &'a SphereLeaf,
    pub(super) end: f32,
}

impl SimdKernel for FrustumAndSphereLeaf<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let frustum = self.frustum;
        let centre: [F::F32; 3] = load3(&self.leaf.centre);
        let radius = <F::F32>::from_array(&self.leaf.radius);
        let mut hits = <F::F32>::splat(0.0).le(radius);
        for side in 0..4 {
            let reach = <F::F32>::splat(frustum.offsets[side])
                + radius * <F::F32>::splat(frustum.sizes[side]);
            hits &= dot(splat3(frustum.normals[side]), centre).le(reach);
        }
        let to_centre = [
            centre[0] - <F::F32>::splat(frustum.low[0]),
            centre[1] - <F::F32>::splat(frustum.low[1]),
            centre[2] - <F::F32>::splat(frustum.low[2]),
        ];
        let distance = length_sq(to_centre).sqrt() * <F::F32>::splat(1.0 - 4.0 * REL_ERROR);
        hits & (distance - radius).le(<F::F32>::splat(self.end + frustum.slack))
    }
}
