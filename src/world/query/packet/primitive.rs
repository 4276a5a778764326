//! Four rays and a primitive at once: to the bit what each finds by itself.

use super::csg::may_be_left;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{Crossing, RayPacket, Root};
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::primitive::Leaf;
use crate::world::query::Query;

/// Four rays on their way to a primitive.
struct PrimitivePacket<'a, const ANY: bool> {
    leaf: &'a Leaf,
    rays: &'a RayPacket4,
    /// Which have just left a root of it that enters, and which one that leaves, one bit each.
    left: [u32; 2],
    /// Which rays there are.
    there: u32,
}

/// The first roots of four rays.
struct NearestRoots {
    t: [f64; 4],
    leaves: u32,
    met: u32,
    unknown: u32,
}

impl<const ANY: bool> SimdKernel for PrimitivePacket<'_, ANY> {
    type Output = NearestRoots;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> NearestRoots {
        let mut rays: RayPacket<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        let (from, far) = (
            F::from_array(&self.rays.from),
            F::from_array(&self.rays.far),
        );
        let nearest =
            self.leaf
                .shape
                .nearest_of_four::<F, ANY>(&rays, (from, far), self.left, self.there);
        NearestRoots {
            t: nearest.t.to_array(),
            leaves: nearest.leaves,
            met: nearest.met,
            unknown: nearest.unknown,
        }
    }
}

/// Asks which of four rays that go out from a leaf have left it for good, one bit each.
struct ExitedLanes<'a> {
    leaf: &'a Leaf,
    rays: &'a RayPacket4,
}

impl SimdKernel for ExitedLanes<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> u32 {
        let mut rays: RayPacket<F> = self.rays.load();
        if let Some(matrix) = &self.leaf.object_from_world {
            rays = rays.to_object(matrix);
        }
        F::bitmask(self.leaf.shape.four_left_behind(&rays))
    }
}

impl World {
    /// What some of four rays from `start` on find of a primitive up to and including where they end: calls `take` with the number of
    /// each ray that meets it; if `ANY` will do perhaps with some place in it. Gives those that must be asked for singly,
    /// one bit each.
    #[inline(always)]
    pub(in crate::world) fn packet4_primitive<const ANY: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        (lot, start, mut there): (&mut RayStream, usize, u32),
        query: impl Fn(usize) -> Query,
        roots: &mut Vec<Root>,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let rays = lot.four(start);
        let from = rays.from;
        let leaf = &self.model.leaves[number as usize];
        let mut unclear = 0;
        let mut asked = PrimitivePacket::<ANY> {
            leaf,
            rays,
            left: [0, 0],
            there,
        };
        let mut own = rays.have_left(number) & there;
        let is_told = leaf.shape.tells_left_behind();
        if own & rays.goes_out != 0 && is_told {
            let gone = own & rays.goes_out & lanes.run(ExitedLanes { leaf, rays });
            there &= !gone;
            own &= !gone;
        }
        while own != 0 {
            let lane = own.trailing_zeros() as usize % 4;
            own &= own - 1;
            let query = query(start + lane);
            if let Some(left) = &query.origin_surface {
                let is_plain = left.face == 0 && left.crossing != Crossing::Touch;
                let leaves = left.normal.dot(query.ray.dir) > 0.0;
                if leaves && !is_told && leaf.is_exiting(&query.ray) {
                    there &= !(1 << lane);
                    continue;
                }
                asked.left[usize::from(leaves)] |= 1 << lane;
                unclear |= u32::from(!is_plain) << lane;
            }
        }
        if there == 0 {
            return 0;
        }
        asked.there = there;
        let found = lanes.run(asked);
        let mut unknown = (found.unknown | unclear) & there;
        let mut met = found.met & there & !unknown;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % 4;
            met &= met - 1;
            if may_be_left(from[lane], found.t[lane]) {
                unknown |= 1 << lane;
                continue;
            }
            let root = if !ANY && leaf.shape.has_faces() {
                let ray = query(start + lane).ray;
                let Some(root) = leaf.root_at(&ray, found.t[lane], roots) else {
                    unknown |= 1 << lane;
                    continue;
                };
                root
            } else {
                Root::on_smooth(found.t[lane], found.leaves >> lane & 1 == 1)
            };
            let surface = leaf.surface;
            take(
                lot,
                start + lane,
                RawHit {
                    root,
                    leaf: number,
                    surface,
                },
            );
        }
        unknown
    }
}
