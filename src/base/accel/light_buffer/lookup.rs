//! Lookups in a [`LightBuffer`] for rays from or to its point.

use super::grid::Grid;
use super::{LightBuffer, NONE};
use crate::base::accel::bounding_cylinder::PacketAndCylinder;
use crate::base::accel::packet::{
    LANES, PacketAndBox, PacketAndSphere, REL_ERROR, RayPacket8, dot, frame_end, load3, splat3,
};
use crate::base::math::rounding::nearest;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use glam::{DVec3, Vec3};

/// 1.5 · 2²³: adding and subtracting it rounds a small number, negative or not, to an integer.
const ROUND_TO_INTEGER: f32 = 12_582_912.0;

/// Eight rays from the point of a light buffer, or to it.
#[derive(Debug)]
pub(crate) struct Rays8 {
    packet: RayPacket8,
    scale: f64,
    /// The farthest end of the rays, unless [`Rays8::is_stale`] is set.
    farthest: f32,
    /// True if ends changed since `farthest` was computed.
    is_stale: bool,
    /// Mask of the lanes that hold rays.
    active: u32,
}

impl Rays8 {
    /// Shortens a ray: to this distance, or to nothing if that is negative.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, ray: usize, end: f64) {
        self.packet.end[ray % LANES] = frame_end(end, self.scale);
        self.is_stale = true;
    }
}

impl LightBuffer {
    /// Loads rays that start at the point, with these unit directions and ends, as two halves of four; `active` masks
    /// the lanes that hold rays.
    #[inline(always)]
    pub(crate) fn load_from_point(
        &self,
        halves: [(&[[f64; 4]; 3], &[f64; 4]); 2],
        active: u32,
    ) -> Rays8 {
        let mut rays = Rays8 {
            packet: RayPacket8::EMPTY,
            scale: self.frame.scale(),
            farthest: 0.0,
            is_stale: false,
            active,
        };
        let [(dir, end), (second_dir, second_end)] = halves;
        rays.packet.load_half(0, dir, end, rays.scale);
        rays.packet.load_half(1, second_dir, second_end, rays.scale);
        for (ray, end) in rays.packet.end.iter_mut().enumerate() {
            if active >> ray & 1 == 0 {
                *end = f32::NEG_INFINITY;
            }
        }
        rays.farthest = rays.packet.farthest();
        rays
    }

    /// Loads rays that end at the point; the distances are those of their origins.
    #[inline(always)]
    pub(crate) fn load_to_point(
        &self,
        halves: [(&[[f64; 4]; 3], &[f64; 4]); 2],
        active: u32,
    ) -> Rays8 {
        let mut rays = self.load_from_point(halves, active);
        for dir in &mut rays.packet.dir {
            for dir in dir {
                *dir = -*dir;
            }
        }
        rays
    }

    /// Visits, the nearest first, items with a mask of those of eight rays that may hit them before they end; `visit`
    /// sets new ends. Returns a mask of the rays that leave the view.
    #[inline(always)]
    pub(crate) fn visit_packet(
        &self,
        lanes: SimdLevel,
        rays: &mut Rays8,
        mut visit: impl FnMut(u32, u32, &mut Rays8),
    ) -> u32 {
        let light_buffer = self;
        let packet = &rays.packet;
        let (cells, inside) = lanes.run(CellsOfRays {
            light_buffer,
            packet,
        });
        let active = rays.active;
        let mut remaining = inside & active;
        // A single call of `visit`, so that it is inlined only once.
        let (mut items, mut tested) = (&self.always_tested[..], active);
        loop {
            for &item in items {
                if self.proxies[item as usize].near > rays.farthest {
                    break;
                }
                let may_hit = tested & self.may_hit(lanes, item, &rays.packet);
                if may_hit != 0 {
                    visit(item, may_hit, rays);
                    if rays.is_stale {
                        rays.farthest = rays.packet.farthest();
                        rays.is_stale = false;
                    }
                }
            }
            if remaining == 0 {
                break;
            }
            let cell = cells[remaining.trailing_zeros() as usize % LANES];
            let cells = &cells;
            tested = remaining & lanes.run(EqualCells { cells, cell });
            remaining &= !tested;
            items = self.cell_grid.items(cell_index(cell));
        }
        active & !inside
    }

    /// Mask of the rays of a packet that may hit an item.
    #[inline(always)]
    fn may_hit(&self, lanes: SimdLevel, item: u32, packet: &RayPacket8) -> u32 {
        let proxy = &self.proxies[item as usize];
        let sphere = PacketAndSphere {
            packet,
            centre: Vec3::from_array(proxy.centre),
            radius: proxy.radius,
        };
        let mut may_hit = lanes.run(sphere);
        if may_hit == 0 {
            return 0;
        }
        let bounds = self.bounds_of(item);
        if bounds.view_box != NONE {
            let view_box = &self.view_boxes[bounds.view_box as usize];
            may_hit &= lanes.run(PacketAndBox { packet, view_box });
        }
        if may_hit != 0 && bounds.cylinder != NONE {
            let cylinder = &self.cylinders[bounds.cylinder as usize];
            may_hit &= lanes.run(PacketAndCylinder { packet, cylinder });
        }
        may_hit
    }

    /// Visits the items that may be between the point of the light buffer and another point, until `visit` returns
    /// true. Returns whether it did.
    #[inline(always)]
    pub(crate) fn any_between(&self, point: DVec3, mut visit: impl FnMut(u32) -> bool) -> bool {
        let to_point = self.frame.in_frame(point) - self.origin;
        let distance = to_point.length();
        let dir = (to_point / distance).as_vec3();
        let [across, up, along] = self.axes.map(Vec3::from_array);
        let end = nearest(distance) * (1.0 + 4.0 * REL_ERROR);
        // A single call of `visit`, so that it is inlined only once.
        let (mut items, mut is_last) = (&self.always_tested[..], false);
        loop {
            for &item in items {
                if self.proxies[item as usize].near > end {
                    break;
                }
                if self.may_hit_ray(dir, end, item) && visit(item) {
                    return true;
                }
            }
            if is_last {
                return false;
            }
            let depth = along.dot(dir);
            let grid = &self.cell_grid.grid;
            let mut cell = 0;
            for (side, axis) in [(1, up), (0, across)] {
                let at = axis.dot(dir) / depth * grid.rate[side] + grid.start[side];
                let size = grid.size[side];
                if !(depth > 0.0 && at >= 0.0 && at < to_f32(size)) {
                    return false;
                }
                cell = cell * size as usize + cell_index(at);
            }
            (items, is_last) = (self.cell_grid.items(cell), true);
        }
    }

    /// True if a ray that starts at the point may hit an item before its end.
    #[inline(always)]
    fn may_hit_ray(&self, dir: Vec3, end: f32, item: u32) -> bool {
        let proxy = &self.proxies[item as usize];
        let centre = Vec3::from_array(proxy.centre);
        let limit = proxy.radius * proxy.radius * (1.0 + 4.0 * REL_ERROR);
        let along = dir.dot(centre);
        // As with packets, NaN is a miss.
        dir.cross(centre).length_squared() <= limit
            && along - proxy.radius <= end
            && along + proxy.radius >= 0.0
            && match self.bounds_of(item).view_box {
                NONE => true,
                view_box => self.view_boxes[view_box as usize].is_hit(dir, end),
            }
    }
}

/// The index of a cell of the grid.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a small whole number"
)]
fn cell_index(cell: f32) -> usize {
    cell as u32 as usize
}

#[inline(always)]
#[allow(clippy::cast_precision_loss, reason = "a grid has few rows")]
fn to_f32(size: u32) -> f32 {
    size as f32
}

/// The cells of eight rays, and a mask of the rays that are in any.
struct CellsOfRays<'a> {
    light_buffer: &'a LightBuffer,
    packet: &'a RayPacket8,
}

impl SimdKernel for CellsOfRays<'_> {
    type Output = ([f32; LANES], u32);

    #[inline(always)]
    fn run<F: F64x4>(self) -> ([f32; LANES], u32) {
        let Grid { rate, start, size } = self.light_buffer.cell_grid.grid;
        let dir: [F::F32; 3] = load3(&self.packet.dir);
        let depth = dot(splat3(self.light_buffer.axes[2]), dir);
        let mut inside = <F::F32>::splat(f32::MIN_POSITIVE).le(depth);
        let mut cells = <F::F32>::splat(0.0);
        for side in [1, 0] {
            let slope = dot(splat3(self.light_buffer.axes[side]), dir) / depth;
            let at = slope * <F::F32>::splat(rate[side]) + <F::F32>::splat(start[side]);
            // Rounded to the nearest cell centre; at an edge either cell will do.
            let whole = at - <F::F32>::splat(0.5) + <F::F32>::splat(ROUND_TO_INTEGER)
                - <F::F32>::splat(ROUND_TO_INTEGER);
            let size = to_f32(size[side]);
            inside &= <F::F32>::splat(0.0).le(whole) & whole.le(<F::F32>::splat(size - 1.0));
            cells = cells * <F::F32>::splat(size) + whole;
        }
        (cells.to_array(), inside)
    }
}

/// Mask of the cells, of eight, that equal a given one.
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
