//! Four rays and a copy of a small union of balls at once: to the bit what each finds by itself.

use super::csg::may_be_left;
use super::hits::NO_LEAF;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{RayPacket, Root, Shape};
use crate::world::compiled::World;
use crate::world::csg::program::RawHit;
use crate::world::instance::Instance;

/// Four rays on their way to a copy. If `ANY` surface will do, the first that is found ends the search.
struct InstancePacket<'a, const ANY: bool> {
    copy: &'a Instance,
    rays: &'a RayPacket4,
    /// The leaves of the copy that the rays have just left; [`NO_LEAF`] for none.
    left: [u32; 4],
    /// Which rays there are, one bit each.
    there: u32,
}

/// The first surfaces on four rays.
struct NearestInInstance {
    t: [f64; 4],
    /// The leaves, whole numbers.
    leaf: [f64; 4],
    /// Which of the surfaces are left there; the others are entered.
    leaves: u32,
    met: u32,
    /// Which rays must be asked for singly.
    unknown: u32,
}

impl<const ANY: bool> SimdKernel for InstancePacket<'_, ANY> {
    type Output = NearestInInstance;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> NearestInInstance {
        let rays: RayPacket<F> = self.rays.load();
        let rays = rays.to_object(&self.copy.object_from_world);
        let from = F::from_array(&self.rays.from);
        let mut far = F::from_array(&self.rays.far);
        let (mut t, mut leaf) = (F::splat(f64::INFINITY), F::splat(0.0));
        let (mut leaves, mut met, mut unknown) = (0, 0, 0);
        for (number, own) in (0u32..).zip(&self.copy.model.leaves) {
            let mut asked = self.there & !unknown;
            if ANY {
                asked &= !met;
            }
            if asked == 0 {
                break;
            }
            let Shape::Sphere(ball) = &own.shape else {
                unknown = self.there;
                break;
            };
            let mut has_left = 0;
            for (lane, left) in self.left.iter().enumerate() {
                has_left |= u32::from(*left == number) << lane;
            }
            has_left &= asked;
            if has_left != 0 {
                let gone = F::bitmask(ball.four_left_behind(&rays)) & self.rays.goes_out;
                unknown |= has_left & !gone;
                asked &= !has_left;
            }
            let nearest = ball.nearest_of_four(&rays, from, far);
            unknown |= nearest.unknown & asked;
            let new = nearest.met & asked;
            if new == 0 {
                continue;
            }
            // Which of two at the same distance comes first single rays know.
            unknown |= F::bitmask(nearest.t.eq(t)) & met & new;
            let is_new = F::mask_from_bits(new);
            t = F::select(is_new, nearest.t, t);
            far = F::select(is_new, nearest.t, far);
            leaf = F::select(is_new, F::splat(f64::from(number)), leaf);
            leaves = leaves & !new | nearest.leaves & new;
            met |= new;
        }
        NearestInInstance {
            t: t.to_array(),
            leaf: leaf.to_array(),
            leaves,
            met,
            unknown: unknown & self.there,
        }
    }
}

impl World {
    /// What some of four rays from `start` on find of a copy of a few balls up to and including where they end: calls
    /// `take` with the number of each ray that meets it, perhaps with any surface of it if `ANY` will do. Gives those that
    /// must be asked for singly, one bit each.
    #[inline(always)]
    pub(in crate::world) fn packet4_instance<const ANY: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        (lot, start, there): (&mut RayStream, usize, u32),
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let copy = &self.model.instances[number as usize];
        let rays = lot.four(start);
        let from = rays.from;
        let mut left = [NO_LEAF; 4];
        for (own, left) in left.iter_mut().zip(rays.left) {
            // Leaves before the first wrap around to numbers that no leaf of the copy has.
            *own = left.wrapping_sub(copy.first);
        }
        let asked = InstancePacket::<ANY> {
            copy,
            rays,
            left,
            there,
        };
        let found = lanes.run(asked);
        let mut unknown = found.unknown;
        let mut met = found.met & !unknown;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % 4;
            met &= met - 1;
            if may_be_left(from[lane], found.t[lane]) {
                unknown |= 1 << lane;
                continue;
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let leaf = found.leaf[lane] as u32;
            let root = Root::on_smooth(found.t[lane], found.leaves >> lane & 1 == 1);
            let surface = copy.surface + copy.model.leaves[leaf as usize].surface;
            take(
                lot,
                start + lane,
                RawHit {
                    root,
                    leaf: copy.first + leaf,
                    surface,
                },
            );
        }
        unknown
    }
}
