//! The pyramid around the rays of a bundle, which nodes and blocks are tried against.

use super::node::{Node, WIDTH};
use super::packet::{DOUBT, all, dot, length_sq, load};
use super::sphere_leaf::SphereLeaf;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel};

/// Four planes through the common origin; a box on the far side of one is not met.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frustum {
    pub(super) normals: [[f32; 3]; 4],
    pub(super) offsets: [f32; 4],
    /// The lengths of the normals, and somewhat more.
    pub(super) sizes: [f32; 4],
    /// No less than what rounding moves the origin by.
    pub(super) slack: f32,
    /// The origin rounded down and up.
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

/// The square of how near each box of a node comes to the origin at the least, and which boxes a ray that ends at `end`
/// may meet, one bit each.
pub(super) struct FrustumAndNode<'a> {
    pub(super) pyramid: &'a Frustum,
    pub(super) node: &'a Node,
    pub(super) end: f32,
}

impl SimdKernel for FrustumAndNode<'_> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; WIDTH], u32) {
        let (planes, pyramid) = (self.node.planes(), self.pyramid);
        let mut met = u32::MAX;
        for side in 0..4 {
            let normal = pyramid.normals[side];
            // The corner that lies farthest to the inner side.
            let corner = [
                <F::F32>::from_array(&planes[0][usize::from(normal[0] < 0.0)]),
                <F::F32>::from_array(&planes[1][usize::from(normal[1] < 0.0)]),
                <F::F32>::from_array(&planes[2][usize::from(normal[2] < 0.0)]),
            ];
            met &= dot(all(normal), corner).le(<F::F32>::splat(pyramid.offsets[side]));
        }
        let mut near_sq = <F::F32>::splat(0.0);
        for (axis, [low, high]) in planes.iter().enumerate() {
            let below = <F::F32>::from_array(low) - <F::F32>::splat(pyramid.high[axis]);
            let above = <F::F32>::splat(pyramid.low[axis]) - <F::F32>::from_array(high);
            let gap = below.lane_max(above).lane_max(<F::F32>::splat(0.0));
            near_sq = near_sq + gap * gap;
        }
        let reach = <F::F32>::splat(self.end * self.end * (1.0 + 16.0 * DOUBT));
        (near_sq.to_array(), met & near_sq.le(reach))
    }
}

/// Which balls of a block a ray that ends at `end` may meet, one bit each.
pub(super) struct FrustumAndSphereLeaf<'a> {
    pub(super) pyramid: &'a Frustum,
    pub(super) block: &'a SphereLeaf,
    pub(super) end: f32,
}

impl SimdKernel for FrustumAndSphereLeaf<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let pyramid = self.pyramid;
        let centre: [F::F32; 3] = load(&self.block.centre);
        let radius = <F::F32>::from_array(&self.block.radius);
        let mut met = <F::F32>::splat(0.0).le(radius);
        for side in 0..4 {
            let reach = <F::F32>::splat(pyramid.offsets[side])
                + radius * <F::F32>::splat(pyramid.sizes[side]);
            met &= dot(all(pyramid.normals[side]), centre).le(reach);
        }
        let way = [
            centre[0] - <F::F32>::splat(pyramid.low[0]),
            centre[1] - <F::F32>::splat(pyramid.low[1]),
            centre[2] - <F::F32>::splat(pyramid.low[2]),
        ];
        let distance = length_sq(way).sqrt() * <F::F32>::splat(1.0 - 4.0 * DOUBT);
        met & (distance - radius).le(<F::F32>::splat(self.end + pyramid.slack))
    }
}
