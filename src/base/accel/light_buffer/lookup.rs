//! Rays that have the point of a [`LightBuffer`] in common look up what they may meet.

use super::grid::Grid;
use super::{LightBuffer, NONE};
use crate::base::accel::bounding_cylinder::PacketAndCylinder;
use crate::base::accel::packet::{
    DOUBT, LANES, PacketAndBox, PacketAndSphere, RayPacket8, all, dot, frame_end, load,
};
use crate::base::math::rounding::nearest;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use glam::{DVec3, Vec3};

/// Adding and subtracting this rounds a small number, negative or not, to a whole one: 1.5 times 2 to the 23.
const WHOLE: f32 = 12_582_912.0;

/// Eight rays from the point of a vista, or to it.
#[derive(Debug)]
pub(crate) struct Rays8 {
    group: RayPacket8,
    scale: f64,
    /// Where the last of them ends, as far as that is known.
    farthest: f32,
    /// Whether that is to be found anew.
    have_new_ends: bool,
    /// Which of them are there, one bit each.
    there: u32,
}

impl Rays8 {
    /// Lets a ray end sooner: at this distance, or before it begins if that is negative.
    #[inline(always)]
    pub(crate) fn end(&mut self, ray: usize, end: f64) {
        self.group.end[ray % LANES] = frame_end(end, self.scale);
        self.have_new_ends = true;
    }
}

impl LightBuffer {
    /// Rays from here of these unit directions, which end at such distances, four and four, of which those marked in `there`
    /// are there.
    #[inline(always)]
    pub(crate) fn rays(&self, halves: [(&[[f64; 4]; 3], &[f64; 4]); 2], there: u32) -> Rays8 {
        let mut rays = Rays8 {
            group: RayPacket8::EMPTY,
            scale: self.frame.scale(),
            farthest: 0.0,
            have_new_ends: false,
            there,
        };
        rays.group.take(0, halves[0], rays.scale);
        rays.group.take(1, halves[1], rays.scale);
        for (ray, end) in rays.group.end.iter_mut().enumerate() {
            if there >> ray & 1 == 0 {
                *end = f32::NEG_INFINITY;
            }
        }
        rays.farthest = rays.group.farthest();
        rays
    }

    /// The same for rays to here, of which the distances tell where they begin.
    #[inline(always)]
    pub(crate) fn rays_back(&self, halves: [(&[[f64; 4]; 3], &[f64; 4]); 2], there: u32) -> Rays8 {
        let mut rays = self.rays(halves, there);
        for dir in &mut rays.group.dir {
            for dir in dir {
                *dir = -*dir;
            }
        }
        rays
    }

    /// Visits, the nearest first, items with those of eight rays that may meet them before they end, one bit each; `visit`
    /// notes new ends. Gives the rays that leave the view.
    #[inline(always)]
    pub(crate) fn each(
        &self,
        lanes: SimdLevel,
        rays: &mut Rays8,
        mut visit: impl FnMut(u32, u32, &mut Rays8),
    ) -> u32 {
        let vista = self;
        let group = &rays.group;
        let (cells, inside) = lanes.run(CellsOfRays { vista, group });
        let there = rays.there;
        let mut left = inside & there;
        // One place that visits: what it does is compiled into it.
        let (mut items, mut asked) = (&self.around[..], there);
        loop {
            for &item in items {
                if self.known[item as usize].near > rays.farthest {
                    break;
                }
                let may_meet = asked & self.may_meet(lanes, item, &rays.group);
                if may_meet != 0 {
                    visit(item, may_meet, rays);
                    if rays.have_new_ends {
                        rays.farthest = rays.group.farthest();
                        rays.have_new_ends = false;
                    }
                }
            }
            if left == 0 {
                break;
            }
            let cell = cells[left.trailing_zeros() as usize % LANES];
            let cells = &cells;
            asked = left & lanes.run(EqualCells { cells, cell });
            left &= !asked;
            items = self.raster.items(number_of(cell));
        }
        there & !inside
    }

    /// Which rays of a group may meet an item, one bit each.
    #[inline(always)]
    fn may_meet(&self, lanes: SimdLevel, item: u32, group: &RayPacket8) -> u32 {
        let known = &self.known[item as usize];
        let ball = PacketAndSphere {
            group,
            centre: Vec3::from_array(known.centre),
            radius: known.radius,
        };
        let mut may_meet = lanes.run(ball);
        if may_meet == 0 {
            return 0;
        }
        let form = self.form(item);
        if form.slab != NONE {
            let slab = &self.slabs[form.slab as usize];
            may_meet &= lanes.run(PacketAndBox { group, slab });
        }
        if may_meet != 0 && form.rod != NONE {
            let rod = &self.rods[form.rod as usize];
            may_meet &= lanes.run(PacketAndCylinder { group, rod });
        }
        may_meet
    }

    /// Visits the items that may lie between here and a point, until `visit` says to stop. Says
    /// whether it did.
    #[inline(always)]
    pub(crate) fn between(&self, point: DVec3, mut visit: impl FnMut(u32) -> bool) -> bool {
        let way = self.frame.place(point) - self.origin;
        let distance = way.length();
        let dir = (way / distance).as_vec3();
        let [across, up, along] = self.axes.map(Vec3::from_array);
        let end = nearest(distance) * (1.0 + 4.0 * DOUBT);
        // One place that visits: what it does is compiled into it.
        let (mut items, mut is_last) = (&self.around[..], false);
        loop {
            for &item in items {
                if self.known[item as usize].near > end {
                    break;
                }
                if self.may_lie_on(dir, end, item) && visit(item) {
                    return true;
                }
            }
            if is_last {
                return false;
            }
            let depth = along.dot(dir);
            let grid = &self.raster.grid;
            let mut cell = 0;
            for (side, axis) in [(1, up), (0, across)] {
                let at = axis.dot(dir) / depth * grid.rate[side] + grid.start[side];
                let size = grid.size[side];
                if !(depth > 0.0 && at >= 0.0 && at < as_number(size)) {
                    return false;
                }
                cell = cell * size as usize + number_of(at);
            }
            (items, is_last) = (self.raster.items(cell), true);
        }
    }

    /// Whether an item may lie on a ray from here in this direction before it ends.
    #[inline(always)]
    fn may_lie_on(&self, dir: Vec3, end: f32, item: u32) -> bool {
        let known = &self.known[item as usize];
        let centre = Vec3::from_array(known.centre);
        let limit = known.radius * known.radius * (1.0 + 4.0 * DOUBT);
        let along = dir.dot(centre);
        // As eight rays are tried: what is not a number misses.
        dir.cross(centre).length_squared() <= limit
            && along - known.radius <= end
            && along + known.radius >= 0.0
            && match self.form(item).slab {
                NONE => true,
                slab => self.slabs[slab as usize].is_met(dir, end),
            }
    }
}

/// The number of a cell that is there.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a small whole number"
)]
fn number_of(cell: f32) -> usize {
    cell as u32 as usize
}

#[inline(always)]
#[allow(clippy::cast_precision_loss, reason = "a grid has few rows")]
fn as_number(size: u32) -> f32 {
    size as f32
}

/// In which cells eight rays are, and which of them are in any, one bit each.
struct CellsOfRays<'a> {
    vista: &'a LightBuffer,
    group: &'a RayPacket8,
}

impl SimdKernel for CellsOfRays<'_> {
    type Output = ([f32; LANES], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; LANES], u32) {
        let Grid { rate, start, size } = self.vista.raster.grid;
        let dir: [F::F32; 3] = load(&self.group.dir);
        let depth = dot(all(self.vista.axes[2]), dir);
        let mut inside = <F::F32>::splat(f32::MIN_POSITIVE).le(depth);
        let mut cells = <F::F32>::splat(0.0);
        for side in [1, 0] {
            let slope = dot(all(self.vista.axes[side]), dir) / depth;
            let at = slope * <F::F32>::splat(rate[side]) + <F::F32>::splat(start[side]);
            // Rounded to the nearest of the middles of cells; which of two at their edge does not matter.
            let whole = at - <F::F32>::splat(0.5) + <F::F32>::splat(WHOLE) - <F::F32>::splat(WHOLE);
            let size = as_number(size[side]);
            inside &= <F::F32>::splat(0.0).le(whole) & whole.le(<F::F32>::splat(size - 1.0));
            cells = cells * <F::F32>::splat(size) + whole;
        }
        (cells.to_array(), inside)
    }
}

/// Which of eight cells are this one, one bit each.
struct EqualCells<'a> {
    cells: &'a [f32; LANES],
    cell: f32,
}

impl SimdKernel for EqualCells<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let cells = <F::F32>::from_array(self.cells);
        let cell = <F::F32>::splat(self.cell);
        cells.le(cell) & cell.le(cells)
    }
}
