//! Bundles of parallel rays, such as those of an orthographic camera through a tile of the image.
//!
//! They are traversed as bundles from one point are ([`super::bundle`]). The tests are simpler: in coordinates across the
//! rays each ray is a point, and so it hits the spheres whose centres are near that point.

use super::Bvh;
use super::bounding_sphere::BoundingSphere;
use super::bundle::{NewEnds, RayBundle, lanes_of_packet};
use super::frustum::Frustum;
use super::node::{Aabb32, Child, Frame, Node, WIDTH, max_f32, min_f32};
use super::packet::{LANES, REL_ERROR, load3};
use crate::base::math::rounding::{f32_above, f32_below, nearest};
use crate::base::math::simd::vec3::{Vec3Lanes, dot, from_arrays, scale, splat, sub, to_arrays};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use glam::DVec3;

/// Maximum coordinate of an origin across the rays in the frame of the tree: from farther away rounding would count.
const MAX_ACROSS: f64 = 256.0;
/// The same along the rays.
const MAX_ALONG: f64 = 1e6;
/// Bound on the coordinates of a tree in its frame, in any direction.
const TREE_REACH: f64 = 8.0;
/// Bound on the inverse of a component of the direction: a ray that crosses the sides of a box at a smaller slope leaves the
/// tree before.
const MAX_INVERSE: f64 = 1e30;
/// Bound on the difference of a squared length from 1, for distances to be lengths.
const UNIT: f64 = 1e-9;

/// Parallel rays.
#[derive(Debug, Default)]
pub struct ParallelBundle {
    packets: Vec<ParallelPacket8>,
    rectangles: Vec<PacketRectangles>,
    /// The number of rays; the last packet may have unused lanes.
    count: usize,
    frustum: Frustum,
    /// Length in the frame of a world-space unit.
    scale: f64,
    /// Unit vectors across the rays, and along them.
    axes: [DVec3; 3],
    /// The inverse direction of the rays.
    inverse: [f32; 3],
    /// Bound on the error of a difference of two coordinates.
    slack: f32,
    /// The least coordinate along the rays at which one starts.
    start: f32,
}

/// Eight parallel rays in the frame of the tree.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct ParallelPacket8 {
    /// Their coordinates across the common direction.
    across: [[f32; LANES]; 2],
    /// Their points nearest to the centre of the frame, from which coordinates along the rays are measured.
    foot: [[f32; LANES]; 3],
    /// The coordinates along them of their starts and ends. A ray that is done ends before it begins.
    start: [f32; LANES],
    end: [f32; LANES],
    /// The coordinates of their origins along them.
    origin: [f64; LANES],
}

/// The rectangles around the rays of eight packets, by coordinate across the rays.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct PacketRectangles {
    low: [[f32; LANES]; 2],
    high: [[f32; LANES]; 2],
}

/// Bounds of the coordinates of origins across the rays and along them, lane by lane. The sum is finite unless one is not,
/// which the bounds do not show.
struct OriginBounds {
    low: [[f64; 4]; 3],
    high: [[f64; 4]; 3],
    sum: [f64; 4],
}

/// A sphere in coordinates across the rays and along them, enlarged by the rounding errors.
#[derive(Clone, Copy)]
struct ProjectedSphere {
    centre: [f32; 3],
    radius: f32,
}

impl ParallelPacket8 {
    const EMPTY: ParallelPacket8 = ParallelPacket8 {
        across: [[0.0; LANES]; 2],
        foot: [[0.0; LANES]; 3],
        start: [0.0; LANES],
        end: [f32::NEG_INFINITY; LANES],
        origin: [0.0; LANES],
    };
}

impl PacketRectangles {
    const EMPTY: PacketRectangles = PacketRectangles {
        low: [[f32::INFINITY; LANES]; 2],
        high: [[f32::NEG_INFINITY; LANES]; 2],
    };
}

impl OriginBounds {
    const EMPTY: OriginBounds = OriginBounds {
        low: [[f64::INFINITY; 4]; 3],
        high: [[f64::NEG_INFINITY; 4]; 3],
        sum: [0.0; 4],
    };

    #[inline(always)]
    fn add(&mut self, at: &[[f64; 4]; 3]) {
        for axis in 0..3 {
            for lane in 0..4 {
                let (at, low, high) = (at[axis][lane], self.low[axis][lane], self.high[axis][lane]);
                self.low[axis][lane] = if at < low { at } else { low };
                self.high[axis][lane] = if at > high { at } else { high };
                self.sum[lane] += at;
            }
        }
    }

    fn ends(&self) -> ([f64; 3], [f64; 3]) {
        (
            self.low
                .map(|low| low.into_iter().fold(f64::INFINITY, f64::min)),
            self.high
                .map(|high| high.into_iter().fold(f64::NEG_INFINITY, f64::max)),
        )
    }
}

/// Rounds four numbers.
#[inline(always)]
fn store_rounded(to: &mut [f32], from: &[f64; 4]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = nearest(*from);
    }
}

/// The coordinate along a ray of its end, rounded up, from that of its origin and the distance in the frame.
#[inline(always)]
fn end_along(origin: f64, distance: f64, slack: f32) -> f32 {
    let end = nearest(origin + distance);
    let end = if end.is_nan() { f32::INFINITY } else { end };
    let end = end + end.abs() * REL_ERROR + slack;
    if distance < 0.0 {
        f32::NEG_INFINITY
    } else {
        end
    }
}

impl ParallelBundle {
    /// Loads `count` infinite rays in this unit direction for a traversal of `tree`, by their origins, four by four; lanes
    /// behind the last ray repeat some ray. Returns false if they cannot be traversed together.
    #[inline(always)]
    pub(crate) fn fill<'o>(
        &mut self,
        lanes: SimdLevel,
        tree: &Bvh,
        (count, dir): (usize, DVec3),
        packet4: impl Fn(usize) -> &'o [[f64; 4]; 3],
    ) -> bool {
        self.scale = tree.frame.scale();
        let is_unit = (dir.length_squared() - 1.0).abs() < UNIT;
        if count == 0 || !self.scale.is_normal() || !is_unit {
            return false;
        }
        let along = dir.normalize();
        let (across, up) = along.any_orthonormal_pair();
        self.axes = [across, up, along];
        let inverse = along.to_array().map(|along| 1.0 / along);
        self.inverse = inverse.map(|inverse| nearest(inverse.clamp(-MAX_INVERSE, MAX_INVERSE)));
        self.count = count;
        self.packets.clear();
        self.packets
            .resize(count.div_ceil(LANES), ParallelPacket8::EMPTY);
        let mut bounds = OriginBounds::EMPTY;
        for half in 0..count.div_ceil(4) {
            let (packet, first) = (&mut self.packets[half / 2], 4 * (half % 2));
            let origin = packet4(half);
            let [at, foot] = lanes.run(AlongAxes {
                frame: &tree.frame,
                axes: &self.axes,
                origin,
            });
            bounds.add(&at);
            for (to, from) in packet.across.iter_mut().zip(&at) {
                store_rounded(&mut to[first..first + 4], from);
            }
            for (to, from) in packet.foot.iter_mut().zip(&foot) {
                store_rounded(&mut to[first..first + 4], from);
            }
            packet.origin[first..first + 4].copy_from_slice(&at[2]);
        }
        let (low, high) = bounds.ends();
        let extent = [low[0], low[1], high[0], high[1]]
            .into_iter()
            .fold(0.0, |extent: f64, at| extent.max(at.abs()));
        let is_near = extent < MAX_ACROSS && low[2].abs().max(high[2].abs()) < MAX_ALONG;
        if !(is_near && bounds.sum.iter().all(|sum| sum.is_finite())) {
            return false;
        }
        self.slack = 2.0 * REL_ERROR * nearest(TREE_REACH + extent);
        for number in 0..count {
            let (packet, lane) = (&mut self.packets[number / LANES], number % LANES);
            // Rounding may move the start of a ray by more only where it lies behind the tree.
            packet.start[lane] = nearest(packet.origin[lane].max(-TREE_REACH)) - self.slack;
            packet.end[lane] = f32::INFINITY;
        }
        self.build_rectangles();
        self.build_frustum(low, high);
        true
    }

    /// Ends the rays at these distances, four by four.
    #[inline(always)]
    pub(crate) fn end_all(&mut self, packet4: impl Fn(usize) -> [f64; 4]) {
        for half in 0..self.count.div_ceil(4) {
            let (packet, first) = (&mut self.packets[half / 2], 4 * (half % 2));
            let there = (self.count - 4 * half).min(4);
            for (lane, end) in (first..).zip(&packet4(half)[..there]) {
                packet.end[lane] = end_along(packet.origin[lane], end * self.scale, self.slack);
            }
        }
    }

    fn build_rectangles(&mut self) {
        self.rectangles.clear();
        for (group, packets) in self.packets.chunks(LANES).enumerate() {
            let mut rectangles = PacketRectangles::EMPTY;
            for (lane, packet) in packets.iter().enumerate() {
                let there = (self.count - LANES * (LANES * group + lane)).min(LANES);
                for (axis, at) in packet.across.iter().enumerate() {
                    let at = &at[..there];
                    rectangles.low[axis][lane] = at.iter().copied().fold(f32::INFINITY, min_f32);
                    rectangles.high[axis][lane] =
                        at.iter().copied().fold(f32::NEG_INFINITY, max_f32);
                }
            }
            self.rectangles.push(rectangles);
        }
    }

    /// Builds the planes around all rays, and the box around their starts, from the bounds of their origins across and
    /// along them.
    fn build_frustum(&mut self, low: [f64; 3], high: [f64; 3]) {
        let [across, up, along] = self.axes;
        let slack = f64::from(self.slack);
        let sides = [
            (across, high[0]),
            (-across, -low[0]),
            (up, high[1]),
            (-up, -low[1]),
        ];
        for (side, (normal, offset)) in sides.into_iter().enumerate() {
            self.frustum.normals[side] = [normal.x, normal.y, normal.z].map(nearest);
            self.frustum.offsets[side] = f32_above(offset + 4.0 * slack);
            self.frustum.sizes[side] = 1.0 + 4.0 * REL_ERROR;
        }
        let ends = [low[2], high[2]].map(|along| along.max(-TREE_REACH));
        self.start = f32_below(ends[0] - slack);
        let (mut least, mut largest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in 0..8 {
            let end = |axis: usize, bit: usize| match corner >> bit & 1 {
                0 => low[axis],
                _ => high[axis],
            };
            let point = end(0, 0) * across + end(1, 1) * up + ends[corner >> 2 & 1] * along;
            (least, largest) = (least.min(point), largest.max(point));
        }
        let (least, largest) = ((least - slack).to_array(), (largest + slack).to_array());
        self.frustum.low = least.map(f32_below);
        self.frustum.high = largest.map(f32_above);
        let (low, high) = (self.frustum.low, self.frustum.high);
        let size: f32 = (0..3).map(|axis| 2.0 * (high[axis] - low[axis])).sum();
        self.frustum.slack = size + self.slack;
    }

    /// A sphere as seen along the rays.
    #[inline(always)]
    fn seen(&self, sphere: &BoundingSphere) -> ProjectedSphere {
        let (centre, radius) = sphere.centre_and_radius();
        let [across, up, along] = &self.axes;
        ProjectedSphere {
            centre: [across.dot(centre), up.dot(centre), along.dot(centre)].map(nearest),
            radius: radius * (1.0 + REL_ERROR) + self.slack,
        }
    }
}

impl RayBundle for ParallelBundle {
    #[inline(always)]
    fn frustum(&self) -> &Frustum {
        &self.frustum
    }

    #[inline(always)]
    fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn farthest(&self) -> f32 {
        let mut farthest = [f32::NEG_INFINITY; LANES];
        for packet in &self.packets {
            for (farthest, end) in farthest.iter_mut().zip(packet.end) {
                *farthest = max_f32(end, *farthest);
            }
        }
        let farthest = farthest.into_iter().fold(f32::NEG_INFINITY, max_f32);
        (farthest - self.start) * (1.0 + REL_ERROR)
    }

    #[inline(always)]
    fn test_item(
        &mut self,
        lanes: SimdLevel,
        sphere: &BoundingSphere,
        aabb: Option<&Aabb32>,
        mut visit: impl FnMut(usize, u32, &mut NewEnds),
    ) -> bool {
        let seen = self.seen(sphere);
        let mut is_shortened = false;
        for group in 0..self.rectangles.len() {
            let rectangles = &self.rectangles[group];
            let mut hits = lanes.run(RectanglesAndSphere { rectangles, seen });
            while hits != 0 {
                let number = group * LANES + hits.trailing_zeros() as usize;
                hits &= hits - 1;
                let Some(packet) = self.packets.get(number) else {
                    break;
                };
                let mut rays = lanes.run(PacketAndSphere { packet, seen });
                if rays != 0
                    && let Some(aabb) = aabb
                {
                    let (inverse, slack) = (self.inverse, self.slack);
                    rays &= lanes.run(PacketAndBox {
                        packet,
                        inverse,
                        slack,
                        aabb,
                    });
                }
                rays &= lanes_of_packet(self.count, number);
                if rays == 0 {
                    continue;
                }
                let mut new_ends = NewEnds::default();
                visit(number * LANES, rays, &mut new_ends);
                let packet = &mut self.packets[number];
                new_ends.each(|lane, end| {
                    is_shortened = true;
                    packet.end[lane] = end_along(packet.origin[lane], end * self.scale, self.slack);
                });
            }
        }
        is_shortened
    }

    #[inline(always)]
    fn test_items(
        &mut self,
        lanes: SimdLevel,
        node: &Node,
        _around: Option<&Aabb32>,
        mut items: u32,
        sphere: impl Fn(u32) -> Option<BoundingSphere>,
        mut visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        let mut is_shortened = false;
        while items != 0 {
            let slot = items.trailing_zeros() as usize % WIDTH;
            items &= items - 1;
            let Some(item) = node.child(slot).and_then(Child::item) else {
                continue;
            };
            let aabb = node.aabb(slot);
            let known = sphere(item);
            let is_filled = known.is_some_and(|sphere| sphere.is_filled);
            is_shortened |= self.test_item(
                lanes,
                &known.unwrap_or_else(|| BoundingSphere::around(&aabb)),
                (!is_filled).then_some(&aabb),
                #[inline(always)]
                |first, rays, new_ends| visit(item, first, rays, new_ends),
            );
        }
        is_shortened
    }
}

/// Computes the coordinates of four origins along the axes of a bundle, and the points of their rays nearest to the
/// centre of the frame.
struct AlongAxes<'a> {
    frame: &'a Frame,
    axes: &'a [DVec3; 3],
    origin: &'a [[f64; 4]; 3],
}

impl SimdKernel for AlongAxes<'_> {
    type Output = [[[f64; 4]; 3]; 2];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [[[f64; 4]; 3]; 2] {
        let origin: Vec3Lanes<F> = self.frame.in_frame_lanes(from_arrays(self.origin));
        let [across, up, along] = self.axes;
        let at = [
            dot(origin, splat(*across)),
            dot(origin, splat(*up)),
            dot(origin, splat(*along)),
        ];
        let foot = sub(origin, scale(splat(*along), at[2]));
        [to_arrays(at), to_arrays(foot)]
    }
}

/// Mask of the packets, of eight, that may contain a ray that hits a sphere.
struct RectanglesAndSphere<'a> {
    rectangles: &'a PacketRectangles,
    seen: ProjectedSphere,
}

impl SimdKernel for RectanglesAndSphere<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let ProjectedSphere { centre, radius } = self.seen;
        let mut distance_sq = <F::F32>::splat(0.0);
        for axis in 0..2 {
            let centre = <F::F32>::splat(centre[axis]);
            let before = <F::F32>::from_array(&self.rectangles.low[axis]) - centre;
            let behind = centre - <F::F32>::from_array(&self.rectangles.high[axis]);
            let off = before.lane_max(behind).lane_max(<F::F32>::splat(0.0));
            distance_sq = distance_sq + off * off;
        }
        distance_sq.le(<F::F32>::splat(radius * radius * (1.0 + 4.0 * REL_ERROR)))
    }
}

/// Mask of the rays of a packet that may hit a sphere.
struct PacketAndSphere<'a> {
    packet: &'a ParallelPacket8,
    seen: ProjectedSphere,
}

impl SimdKernel for PacketAndSphere<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let ProjectedSphere { centre, radius } = self.seen;
        let [x, y] = &self.packet.across;
        let x = <F::F32>::from_array(x) - <F::F32>::splat(centre[0]);
        let y = <F::F32>::from_array(y) - <F::F32>::splat(centre[1]);
        let limit = <F::F32>::splat(radius * radius * (1.0 + 4.0 * REL_ERROR));
        let is_near = (x * x + y * y).le(limit);
        let is_ahead =
            <F::F32>::from_array(&self.packet.start).le(<F::F32>::splat(centre[2] + radius));
        let is_before =
            <F::F32>::splat(centre[2] - radius).le(<F::F32>::from_array(&self.packet.end));
        is_near & is_ahead & is_before
    }
}

/// Mask of the rays of a packet that may hit a box.
struct PacketAndBox<'a> {
    packet: &'a ParallelPacket8,
    /// The inverse direction of the rays.
    inverse: [f32; 3],
    slack: f32,
    aabb: &'a Aabb32,
}

impl SimdKernel for PacketAndBox<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let foot: [F::F32; 3] = load3(&self.packet.foot);
        // A ray that is done ends at minus infinity: the slack below would be infinite.
        let mut leave = <F::F32>::from_array(&self.packet.end).lane_max(<F::F32>::splat(f32::MIN));
        let mut enter = <F::F32>::from_array(&self.packet.start);
        for (axis, foot) in foot.into_iter().enumerate() {
            let inverse = <F::F32>::splat(self.inverse[axis]);
            let low = (<F::F32>::splat(self.aabb.low[axis] - self.slack) - foot) * inverse;
            let high = (<F::F32>::splat(self.aabb.high[axis] + self.slack) - foot) * inverse;
            enter = low.lane_min(high).lane_max(enter);
            leave = high.lane_max(low).lane_min(leave);
        }
        let slack = <F::F32>::splat(4.0 * REL_ERROR) * (enter.abs() + leave.abs());
        (enter - slack).le(leave + <F::F32>::splat(f32::MIN_POSITIVE))
    }
}

impl Bvh {
    /// [`Bvh::traverse_bundle`] for parallel rays.
    #[inline(always)]
    #[must_use]
    pub(crate) fn traverse_parallel_bundle(
        &self,
        lanes: SimdLevel,
        bundle: &mut ParallelBundle,
        visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        self.traverse_rays(lanes, bundle, visit)
    }
}
