//! The pyramid around the rays of a bundle, which nodes and blocks are tried against.

use super::node::{Node, WIDTH};
use super::packet::{DOUBT, all, dot, length_sq, load};
use super::sphere_leaf::SphereLeaf;
use crate::base::math::simd::{Eight, Kernel};

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

impl Kernel for FrustumAndNode<'_> {
    type Answer = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<E: Eight>(&self) -> ([f32; WIDTH], u32) {
        let (planes, pyramid) = (self.node.planes(), self.pyramid);
        let mut met = u32::MAX;
        for side in 0..4 {
            let normal = pyramid.normals[side];
            // The corner that lies farthest to the inner side.
            let corner = [
                E::load(&planes[0][usize::from(normal[0] < 0.0)]),
                E::load(&planes[1][usize::from(normal[1] < 0.0)]),
                E::load(&planes[2][usize::from(normal[2] < 0.0)]),
            ];
            met &= dot(all(normal), corner).not_above(E::all(pyramid.offsets[side]));
        }
        let mut near_sq = E::all(0.0);
        for (axis, [low, high]) in planes.iter().enumerate() {
            let below = E::load(low).minus(E::all(pyramid.high[axis]));
            let above = E::all(pyramid.low[axis]).minus(E::load(high));
            let gap = below.larger(above).larger(E::all(0.0));
            near_sq = near_sq.plus(gap.times(gap));
        }
        let reach = E::all(self.end * self.end * (1.0 + 16.0 * DOUBT));
        (near_sq.store(), met & near_sq.not_above(reach))
    }
}

/// Which balls of a block a ray that ends at `end` may meet, one bit each.
pub(super) struct FrustumAndSphereLeaf<'a> {
    pub(super) pyramid: &'a Frustum,
    pub(super) block: &'a SphereLeaf,
    pub(super) end: f32,
}

impl Kernel for FrustumAndSphereLeaf<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let pyramid = self.pyramid;
        let centre: [E; 3] = load(&self.block.centre);
        let radius = E::load(&self.block.radius);
        let mut met = E::all(0.0).not_above(radius);
        for side in 0..4 {
            let reach =
                E::all(pyramid.offsets[side]).plus(radius.times(E::all(pyramid.sizes[side])));
            met &= dot(all(pyramid.normals[side]), centre).not_above(reach);
        }
        let way = [
            centre[0].minus(E::all(pyramid.low[0])),
            centre[1].minus(E::all(pyramid.low[1])),
            centre[2].minus(E::all(pyramid.low[2])),
        ];
        let distance = length_sq(way).root().times(E::all(1.0 - 4.0 * DOUBT));
        met & distance
            .minus(radius)
            .not_above(E::all(self.end + pyramid.slack))
    }
}
