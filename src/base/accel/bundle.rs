//! Bundles of many rays from one point: camera rays through a tile of the image, or shadow rays between a light and
//! shading points.
//!
//! The tree is traversed once for all of them. Nodes are tested against the frustum around the rays, items by their
//! bounding spheres against packets of eight rays and then against single rays, all in single precision and
//! conservatively. What remains is a short list of pairs of an item and a ray, which the caller intersects exactly. So
//! the results are those of single rays, bit for bit.

use super::bounding_sphere::{BoundingSphere, ViewedSphere};
use super::frustum::{Frustum, FrustumAndNode, FrustumAndSphereLeaf};
use super::node::{Aabb32, Child, ChildKind, Node, WIDTH, max_f32, min_f32};
use super::packet::{
    ConesAndSphere, LANES, PacketAndBox, PacketAndSphere, PacketCones, REL_ERROR, RayPacket8,
    ViewBox, frame_end,
};
use super::packet_interval::{DirInterval, IntervalAndBox, IntervalAndBoxes, NodeBoxes};
use super::{Bvh, Pending, Stack, nearest_child};
use crate::base::math::Bounds;
use crate::base::math::rounding::{f32_above, f32_below, nearest};
use crate::base::math::simd::SimdLevel;
use glam::{DVec3, Vec3};

/// Minimum cosine between a ray and the axis of the bundle; a wider frustum culls nothing.
const MIN_COSINE: f32 = 0.2;
/// Maximum distance of the origin, in sizes of the tree: from farther away single precision cannot separate its items.
const MAX_DISTANCE: f64 = 256.0;

/// Number of nodes and single items that may be visited per ray of a bundle; items of a node that are tested together
/// cost little more than the node. A single ray visits some twenty, each of which costs about as much.
const VISITS_PER_RAY: usize = 6;
/// Number of visits that any bundle may make in addition.
const MIN_VISITS: usize = 32;

/// From this number of candidate items on, the items of a node are tested together.
const BATCH_MIN_ITEMS: u32 = 3;

/// The box index of the root, whose box no node holds.
const NO_BOX: u32 = u32::MAX;

/// Rays from one point.
#[derive(Debug, Default)]
pub struct Bundle {
    /// In the frame of the tree.
    origin: DVec3,
    packets: Vec<RayPacket8>,
    /// The number of rays; the last packet may have unused lanes.
    count: usize,
    cones: Vec<PacketCones>,
    /// One for each packet, built on first use.
    intervals: Vec<DirInterval>,
    frustum: Frustum,
    /// Length in the frame of a world-space unit.
    scale: f64,
}

/// Rays that are traversed together.
pub(super) trait RayBundle {
    /// The planes around all rays.
    fn frustum(&self) -> &Frustum;

    /// The number of rays.
    fn count(&self) -> usize;

    /// The farthest end of a ray; negative when all rays are done.
    fn farthest(&self) -> f32;

    /// Tests an item against all rays; `visit` gets packets of eight rays with a mask of those that may hit it. Returns
    /// whether a ray was shortened.
    fn test_item(
        &mut self,
        lanes: SimdLevel,
        sphere: &BoundingSphere,
        aabb: Option<&Aabb32>,
        visit: impl FnMut(usize, u32, &mut NewEnds),
    ) -> bool;

    /// Tests some items of a node, one bit each, against all rays, as [`RayBundle::test_item`] does. `around` is the box
    /// of the node, if known.
    fn test_items(
        &mut self,
        lanes: SimdLevel,
        node: &Node,
        around: Option<&Aabb32>,
        items: u32,
        sphere: impl Fn(u32) -> Option<BoundingSphere>,
        visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool;
}

/// Mask of the lanes of a packet that hold rays, of `count` rays. Infinite spheres and boxes are hit by the unused lanes
/// behind the last ray as well.
#[inline(always)]
pub(super) fn lanes_of_packet(count: usize, packet: usize) -> u32 {
    0xff >> (LANES - (count - packet * LANES).min(LANES))
}

impl Bundle {
    /// Loads `count` rays for a traversal of `tree`: unit directions and ends, four by four; lanes behind the last ray
    /// repeat some ray. Returns false if the rays cannot be traversed together.
    #[inline(always)]
    pub fn fill(
        &mut self,
        tree: &Bvh,
        origin: DVec3,
        count: usize,
        packet4: impl Fn(usize) -> ([[f64; 4]; 3], [f64; 4]),
    ) -> bool {
        self.origin = tree.frame.in_frame(origin);
        self.scale = tree.frame.scale();
        // NaN is too far as well.
        let is_near = self.origin.abs().max_element() < MAX_DISTANCE;
        if !is_near || count == 0 || !self.scale.is_normal() {
            return false;
        }
        self.count = count;
        self.packets.clear();
        self.intervals.clear();
        let last = (count - 1) / 4;
        for number in 0..count.div_ceil(LANES) {
            let mut packet = RayPacket8::EMPTY;
            for half in 0..2 {
                let (dir, end) = packet4((2 * number + half).min(last));
                packet.load_half(half, &dir, &end, self.scale);
            }
            self.packets.push(packet);
        }
        for number in count..self.packets.len() * LANES {
            self.packets[number / LANES].end[number % LANES] = f32::NEG_INFINITY;
        }
        self.build_cones();
        self.build_frustum()
    }

    #[inline(always)]
    fn build_cones(&mut self) {
        self.cones.clear();
        for packets in self.packets.chunks(LANES) {
            let mut cones = PacketCones {
                middle: [[0.0; LANES]; 3],
                spread: [f32::NEG_INFINITY; LANES],
            };
            for (lane, packet) in packets.iter().enumerate() {
                let (middle, spread) = packet.cone();
                for axis in 0..3 {
                    cones.middle[axis][lane] = middle[axis];
                }
                cones.spread[lane] = spread;
            }
            self.cones.push(cones);
        }
    }

    /// Builds the frustum around all rays; returns false if they spread too far.
    #[inline(always)]
    fn build_frustum(&mut self) -> bool {
        let sum = self.packets.iter().fold(Vec3::ZERO, |sum, packet| {
            sum + Vec3::from_array(packet.dir.map(|lanes| lanes.iter().sum()))
        });
        let Some(axis) = sum.try_normalize() else {
            return false;
        };
        let (across, up) = axis.any_orthonormal_pair();
        let mut low = [[f32::INFINITY; LANES]; 2];
        let mut high = [[f32::NEG_INFINITY; LANES]; 2];
        let mut least = [f32::INFINITY; LANES];
        for packet in &self.packets {
            let along = packet.dot(axis);
            let inverse = along.map(|cosine| 1.0 / cosine);
            for (side, dir) in [across, up].into_iter().enumerate() {
                let slope = packet.dot(dir);
                for i in 0..LANES {
                    let slope = slope[i] * inverse[i];
                    low[side][i] = min_f32(slope, low[side][i]);
                    high[side][i] = max_f32(slope, high[side][i]);
                }
            }
            for i in 0..LANES {
                least[i] = min_f32(along[i], least[i]);
            }
        }
        let is_narrow = least.into_iter().all(|cosine| cosine > MIN_COSINE);
        let axis = axis.as_dvec3();
        let mut planes = [(DVec3::ZERO, 0.0); 4];
        for (side, dir) in [across.as_dvec3(), up.as_dvec3()].into_iter().enumerate() {
            let low =
                f64::from(low[side].into_iter().fold(f32::INFINITY, min_f32) - 16.0 * REL_ERROR);
            let high = f64::from(
                high[side].into_iter().fold(f32::NEG_INFINITY, max_f32) + 16.0 * REL_ERROR,
            );
            planes[2 * side] = (dir - high * axis, 0.0);
            planes[2 * side + 1] = (low * axis - dir, 0.0);
        }
        for (side, (normal, _)) in planes.into_iter().enumerate() {
            let offset = normal.dot(self.origin);
            let slack = f64::from(8.0 * REL_ERROR) * (4.0 + offset.abs()) * (1.0 + normal.length());
            self.frustum.normals[side] = [normal.x, normal.y, normal.z].map(nearest);
            self.frustum.offsets[side] = nearest(offset + slack);
            self.frustum.sizes[side] = nearest(normal.length()) * (1.0 + 4.0 * REL_ERROR);
        }
        let origin = [self.origin.x, self.origin.y, self.origin.z];
        self.frustum.low = origin.map(f32_below);
        self.frustum.high = origin.map(f32_above);
        let (low, high) = (self.frustum.low, self.frustum.high);
        self.frustum.slack = (0..3).map(|axis| 2.0 * (high[axis] - low[axis])).sum();
        is_narrow
    }

    /// False only if no ray of the bundle hits a box, ends disregarded.
    #[must_use]
    pub fn may_hit(&self, tree: &Bvh, bounds: &Bounds) -> bool {
        let aabb = tree.frame.aabb(bounds);
        let frustum = &self.frustum;
        (0..4).all(|side| {
            let normal = frustum.normals[side];
            // The corner farthest to the inner side.
            let nearest = (0..3).fold(0.0, |sum, axis| {
                let ends = [aabb.high[axis], aabb.low[axis]];
                sum + normal[axis] * ends[usize::from(normal[axis] >= 0.0)]
            });
            // NaN from an infinite box culls nothing.
            nearest.is_nan() || nearest <= frustum.offsets[side]
        })
    }

    /// Shortens a ray: to this distance, or to nothing if that is negative.
    #[inline]
    pub fn shorten(&mut self, ray: usize, end: f64) {
        self.packets[ray / LANES].end[ray % LANES] = frame_end(end, self.scale);
    }

    /// Shortens rays of a packet.
    #[inline(always)]
    fn end(&mut self, packet: usize, mut new_ends: NewEnds) {
        while new_ends.lanes != 0 {
            let lane = new_ends.lanes.trailing_zeros() as usize % LANES;
            new_ends.lanes &= new_ends.lanes - 1;
            self.packets[packet].end[lane] = frame_end(new_ends.ends[lane], self.scale);
        }
    }
}

impl RayBundle for Bundle {
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
        farthest.into_iter().fold(f32::NEG_INFINITY, max_f32)
    }

    #[inline(always)]
    fn test_item(
        &mut self,
        lanes: SimdLevel,
        sphere: &BoundingSphere,
        aabb: Option<&Aabb32>,
        mut visit: impl FnMut(usize, u32, &mut NewEnds),
    ) -> bool {
        let ViewedSphere {
            centre,
            radius,
            distance,
        } = sphere.viewed_from(self.origin);
        let view_box = aabb.map(|aabb| ViewBox::new(aabb, self.origin));
        let mut is_shortened = false;
        for cones in 0..self.cones.len() {
            let kernel = ConesAndSphere {
                cones: &self.cones[cones],
                centre,
                radius,
                distance,
            };
            let mut hits = lanes.run(kernel);
            while hits != 0 {
                let packet_index = cones * LANES + hits.trailing_zeros() as usize;
                hits &= hits - 1;
                let Some(packet) = self.packets.get(packet_index) else {
                    break;
                };
                let kernel = PacketAndSphere {
                    packet,
                    centre,
                    radius,
                };
                let mut rays = lanes.run(kernel);
                if rays != 0
                    && let Some(view_box) = &view_box
                {
                    rays &= lanes.run(PacketAndBox { packet, view_box });
                }
                rays &= lanes_of_packet(self.count, packet_index);
                if rays == 0 {
                    continue;
                }
                let mut new_ends = NewEnds::default();
                visit(packet_index * LANES, rays, &mut new_ends);
                is_shortened |= new_ends.lanes != 0;
                self.end(packet_index, new_ends);
            }
        }
        is_shortened
    }

    #[inline(always)]
    fn test_items(
        &mut self,
        lanes: SimdLevel,
        node: &Node,
        around: Option<&Aabb32>,
        items: u32,
        sphere: impl Fn(u32) -> Option<BoundingSphere>,
        mut visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        if self.intervals.is_empty() {
            self.intervals
                .extend(self.packets.iter().map(DirInterval::new));
        }
        let frustum = &self.frustum;
        let boxes = &lanes.run(NodeBoxes { frustum, node });
        let enclosing_sphere =
            around.map(|aabb| BoundingSphere::around(aabb).viewed_from(self.origin));
        let mut is_shortened = false;
        for cones in 0..self.cones.len() {
            let mut hits = match enclosing_sphere {
                Some(ViewedSphere {
                    centre,
                    radius,
                    distance,
                }) => {
                    let kernel = ConesAndSphere {
                        cones: &self.cones[cones],
                        centre,
                        radius,
                        distance,
                    };
                    lanes.run(kernel)
                }
                None => 0xff,
            };
            while hits != 0 {
                let packet_index = cones * LANES + hits.trailing_zeros() as usize;
                hits &= hits - 1;
                let Some(packet) = self.packets.get(packet_index) else {
                    break;
                };
                let (interval, end) = (&self.intervals[packet_index], packet.farthest());
                let mut boxes_hit = items
                    & lanes.run(IntervalAndBoxes {
                        interval,
                        boxes,
                        end,
                    });
                while boxes_hit != 0 {
                    let slot = boxes_hit.trailing_zeros() as usize % WIDTH;
                    boxes_hit &= boxes_hit - 1;
                    let Some(item) = node.child(slot).and_then(Child::item) else {
                        continue;
                    };
                    let (packet, interval) =
                        (&self.packets[packet_index], &self.intervals[packet_index]);
                    let view_box = &boxes.view_box(slot);
                    let mut rays = lanes.run(IntervalAndBox {
                        packet,
                        interval,
                        view_box,
                    });
                    if rays != 0
                        && let Some(sphere) = sphere(item)
                    {
                        let ViewedSphere { centre, radius, .. } = sphere.viewed_from(self.origin);
                        let kernel = PacketAndSphere {
                            packet,
                            centre,
                            radius,
                        };
                        rays &= lanes.run(kernel);
                    }
                    rays &= lanes_of_packet(self.count, packet_index);
                    if rays != 0 {
                        let mut new_ends = NewEnds::default();
                        visit(item, packet_index * LANES, rays, &mut new_ends);
                        is_shortened |= new_ends.lanes != 0;
                        self.end(packet_index, new_ends);
                    }
                }
            }
        }
        is_shortened
    }
}

/// The new ends of some of eight rays.
#[derive(Debug, Default)]
pub struct NewEnds {
    lanes: u32,
    ends: [f64; LANES],
}

impl NewEnds {
    /// Sets the new end of a ray: the distance of a hit, or a negative number for a ray that is done.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, end: f64) {
        self.lanes |= 1 << lane;
        self.ends[lane % LANES] = end;
    }

    /// Calls `visit` with each ray that has a new end, and that end.
    #[inline(always)]
    pub(crate) fn each(&self, mut visit: impl FnMut(usize, f64)) {
        for lane in (0..LANES).filter(|lane| self.lanes >> lane & 1 == 1) {
            visit(lane, self.ends[lane]);
        }
    }
}

impl Bvh {
    /// Visits, roughly front to back, items with the rays of the bundle that may hit them before the ends of the rays.
    /// `visit` gets the item, the index of the first of eight rays, and a mask of the rays to be intersected; it sets
    /// new ends. Returns false if the traversal was abandoned because the rays have too little in common: not all pairs
    /// have been visited then, and single-ray traversal is better.
    #[inline(always)]
    #[must_use]
    pub(crate) fn traverse_bundle(
        &self,
        lanes: SimdLevel,
        bundle: &mut Bundle,
        visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        self.traverse_rays(lanes, bundle, visit)
    }

    /// [`Bvh::traverse_bundle`] for any rays.
    #[inline(always)]
    pub(super) fn traverse_rays(
        &self,
        lanes: SimdLevel,
        bundle: &mut impl RayBundle,
        mut visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        let mut visits_left = MIN_VISITS + VISITS_PER_RAY * bundle.count();
        let mut end = bundle.farthest();
        let mut pending: Stack<Pending<(Child, u32)>> = Stack::new();
        // A child with the index of its box among the boxes of all nodes; the root's box is in none.
        let mut next = self.root.map(|root| (root, NO_BOX));
        while let Some((child, box_index)) = next {
            next = None;
            if visits_left == 0 {
                return false;
            }
            visits_left -= usize::from(child.item().is_none());
            // Items to be tested: those from the first on that are marked, one bit each.
            let (first, mut hits, leaf) = match child.kind() {
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    let kernel = FrustumAndNode {
                        frustum: bundle.frustum(),
                        node,
                        end,
                    };
                    let (near_sq, mut hits) = lanes.run(kernel);
                    let items = hits & node.items();
                    if items.count_ones() >= BATCH_MIN_ITEMS {
                        hits &= !items;
                        let around = self.box_at(box_index);
                        let sphere =
                            |item: u32| self.bounding_spheres.get(item as usize).copied().flatten();
                        let is_shortened = bundle.test_items(
                            lanes,
                            node,
                            around.as_ref(),
                            items,
                            sphere,
                            #[inline(always)]
                            |item, first, rays, new_ends| {
                                visit(item, first, rays, new_ends);
                            },
                        );
                        if is_shortened {
                            end = bundle.farthest();
                        }
                    }
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let box_index = |slot: usize| number * WIDTH as u32 + slot as u32;
                    let child_at =
                        |slot: usize| node.child(slot).map(|child| (child, box_index(slot)));
                    let bottom = pending.reserve();
                    next = nearest_child(&near_sq, hits, &mut pending, bottom, child_at);
                    (0, 0, None)
                }
                ChildKind::Leaf(number) => {
                    let leaf = &self.sphere_leaves[number as usize];
                    let kernel = FrustumAndSphereLeaf {
                        frustum: bundle.frustum(),
                        leaf,
                        end,
                    };
                    let hits = lanes.run(kernel);
                    (self.first_items[number as usize], hits, Some(leaf))
                }
                ChildKind::Item(item) => (item, 1, None),
            };
            while hits != 0 {
                let slot = hits.trailing_zeros();
                hits &= hits - 1;
                visits_left = visits_left.saturating_sub(1);
                let item = first + slot;
                let (sphere, aabb) = match leaf {
                    Some(leaf) => (leaf.sphere(slot as usize % WIDTH), None),
                    None => self.sphere_or_box(item, box_index),
                };
                let is_shortened = bundle.test_item(
                    lanes,
                    &sphere,
                    aabb.as_ref(),
                    #[inline(always)]
                    |first, rays, new_ends| visit(item, first, rays, new_ends),
                );
                if is_shortened {
                    end = bundle.farthest();
                }
            }
            while next.is_none()
                && let Some(entry) = pending.pop()
            {
                let is_reached = end >= 0.0
                    && entry.enter * (1.0 - 8.0 * REL_ERROR) <= end * end * (1.0 + 8.0 * REL_ERROR);
                next = is_reached.then_some(entry.child);
            }
        }
        true
    }

    /// The box with this index among the boxes of all nodes.
    #[inline(always)]
    fn box_at(&self, box_index: u32) -> Option<Aabb32> {
        let node = self.nodes.get(box_index as usize / WIDTH)?;
        Some(node.aabb(box_index as usize % WIDTH))
    }

    /// The bounding sphere of an item, and its box, which has this index among the boxes of all nodes, if that is
    /// tighter.
    #[inline(always)]
    fn sphere_or_box(&self, item: u32, box_index: u32) -> (BoundingSphere, Option<Aabb32>) {
        let aabb = || self.nodes[box_index as usize / WIDTH].aabb(box_index as usize % WIDTH);
        match self.bounding_spheres.get(item as usize).copied().flatten() {
            Some(sphere) if sphere.is_filled => (sphere, None),
            Some(sphere) => (sphere, Some(aabb())),
            None => {
                let aabb = aabb();
                (BoundingSphere::around(&aabb), Some(aabb))
            }
        }
    }
}
