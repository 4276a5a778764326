//! Many rays from one point at once: those of a camera to a tile of the picture, or those between a light and the points
//! that it may light.
//!
//! The tree is walked once for all of them. Nodes are tried against the pyramid around the rays, items by their balls
//! against groups of eight rays and then against single ones, all in single precision with every doubt in favour of
//! being met. What remains is a short list of pairs of an item and a ray, which the caller tries exactly. So the answers
//! are those of one ray at a time, to the bit.

use super::bounding_sphere::BoundingSphere;
use super::frustum::{Frustum, FrustumAndNode, FrustumAndSphereLeaf};
use super::node::{Aabb32, Child, ChildKind, Node, WIDTH, larger, smaller};
use super::packet::{
    ConesAndSphere, DOUBT, LANES, PacketAndBox, PacketAndSphere, PacketCones, RayPacket8, ViewBox,
    frame_end,
};
use super::packet_interval::{DirInterval, IntervalAndBox, IntervalAndBoxes, NodeBoxes};
use super::{Bvh, Pending, Stack, nearest_child};
use crate::base::math::Bounds;
use crate::base::math::rounding::{f32_above, f32_below, nearest};
use crate::base::math::simd::SimdLevel;
use glam::{DVec3, Vec3};

/// Rays must not spread farther from their middle than this cosine, or a pyramid is no use.
const LEAST_COSINE: f32 = 0.2;
/// From farther away, in sizes of the tree, single precision cannot tell its items apart.
pub(super) const FARTHEST: f64 = 256.0;

/// How many nodes and single items may be visited for each ray of a bundle; items of a node that are tried together cost
/// little more than it. A ray by itself visits some twenty, each of which costs about as much.
const PATIENCE: usize = 6;
/// How many more may be visited by any bundle.
const LEAST_PATIENCE: usize = 32;

/// Of a node of which rays may meet so many items these are tried together.
const MANY: u32 = 3;

/// The place of the root's box, which no node holds.
const NOWHERE: u32 = u32::MAX;

/// A number of rays from one point.
#[derive(Debug, Default)]
pub struct Bundle {
    /// In the frame of the tree.
    origin: DVec3,
    groups: Vec<RayPacket8>,
    /// How many rays there are; the last group may have room for more.
    count: usize,
    cones: Vec<PacketCones>,
    /// One for each group, made when first asked for.
    beams: Vec<DirInterval>,
    pyramid: Frustum,
    /// Frame lengths of world lengths.
    scale: f64,
}

impl Bundle {
    /// Takes `count` rays for a walk through `tree`: unit directions, and where each ends, four by four; behind the last
    /// ray some ray stands again. False if they cannot go together.
    #[inline(always)]
    pub fn fill(
        &mut self,
        tree: &Bvh,
        origin: DVec3,
        count: usize,
        four: impl Fn(usize) -> ([[f64; 4]; 3], [f64; 4]),
    ) -> bool {
        self.origin = tree.frame.place(origin);
        self.scale = tree.frame.scale();
        // NaN is too far as well.
        let is_near = self.origin.abs().max_element() < FARTHEST;
        if !is_near || count == 0 || !self.scale.is_normal() {
            return false;
        }
        self.count = count;
        self.groups.clear();
        self.beams.clear();
        let last = (count - 1) / 4;
        for number in 0..count.div_ceil(LANES) {
            let mut group = RayPacket8::EMPTY;
            for half in 0..2 {
                let (dir, end) = four((2 * number + half).min(last));
                group.take(half, (&dir, &end), self.scale);
            }
            self.groups.push(group);
        }
        for number in count..self.groups.len() * LANES {
            self.groups[number / LANES].end[number % LANES] = f32::NEG_INFINITY;
        }
        self.gather_cones();
        self.gather_pyramid()
    }

    #[inline(always)]
    fn gather_cones(&mut self) {
        self.cones.clear();
        for groups in self.groups.chunks(LANES) {
            let mut cones = PacketCones {
                middle: [[0.0; LANES]; 3],
                spread: [f32::NEG_INFINITY; LANES],
            };
            for (place, group) in groups.iter().enumerate() {
                let (middle, spread) = group.cone();
                for axis in 0..3 {
                    cones.middle[axis][place] = middle[axis];
                }
                cones.spread[place] = spread;
            }
            self.cones.push(cones);
        }
    }

    /// Lays the pyramid around all rays; false if they spread too far.
    #[inline(always)]
    fn gather_pyramid(&mut self) -> bool {
        let sum = self.groups.iter().fold(Vec3::ZERO, |sum, group| {
            sum + Vec3::from_array(group.dir.map(|lanes| lanes.iter().sum()))
        });
        let Some(axis) = sum.try_normalize() else {
            return false;
        };
        let (across, up) = axis.any_orthonormal_pair();
        let mut low = [[f32::INFINITY; LANES]; 2];
        let mut high = [[f32::NEG_INFINITY; LANES]; 2];
        let mut least = [f32::INFINITY; LANES];
        for group in &self.groups {
            let along = group.dot(axis);
            let inverse = along.map(|cosine| 1.0 / cosine);
            for (side, dir) in [across, up].into_iter().enumerate() {
                let slope = group.dot(dir);
                for i in 0..LANES {
                    let slope = slope[i] * inverse[i];
                    low[side][i] = smaller(slope, low[side][i]);
                    high[side][i] = larger(slope, high[side][i]);
                }
            }
            for i in 0..LANES {
                least[i] = smaller(along[i], least[i]);
            }
        }
        let is_narrow = least.into_iter().all(|cosine| cosine > LEAST_COSINE);
        let axis = axis.as_dvec3();
        let mut planes = [(DVec3::ZERO, 0.0); 4];
        for (side, dir) in [across.as_dvec3(), up.as_dvec3()].into_iter().enumerate() {
            let low = f64::from(low[side].into_iter().fold(f32::INFINITY, smaller) - 16.0 * DOUBT);
            let high =
                f64::from(high[side].into_iter().fold(f32::NEG_INFINITY, larger) + 16.0 * DOUBT);
            planes[2 * side] = (dir - high * axis, 0.0);
            planes[2 * side + 1] = (low * axis - dir, 0.0);
        }
        for (place, (normal, _)) in planes.into_iter().enumerate() {
            let offset = normal.dot(self.origin);
            let slack = f64::from(8.0 * DOUBT) * (4.0 + offset.abs()) * (1.0 + normal.length());
            self.pyramid.normals[place] = [normal.x, normal.y, normal.z].map(nearest);
            self.pyramid.offsets[place] = nearest(offset + slack);
            self.pyramid.sizes[place] = nearest(normal.length()) * (1.0 + 4.0 * DOUBT);
        }
        let origin = [self.origin.x, self.origin.y, self.origin.z];
        self.pyramid.low = origin.map(f32_below);
        self.pyramid.high = origin.map(f32_above);
        let (low, high) = (self.pyramid.low, self.pyramid.high);
        self.pyramid.slack = (0..3).map(|axis| 2.0 * (high[axis] - low[axis])).sum();
        is_narrow
    }

    /// Whether a ray of it may meet a box, ends not regarded.
    #[must_use]
    pub fn may_meet(&self, tree: &Bvh, bounds: &Bounds) -> bool {
        let cell = tree.frame.cell(bounds);
        let pyramid = &self.pyramid;
        (0..4).all(|side| {
            let normal = pyramid.normals[side];
            // The corner that lies farthest to the inner side.
            let nearest = (0..3).fold(0.0, |sum, axis| {
                let ends = [cell.high[axis], cell.low[axis]];
                sum + normal[axis] * ends[usize::from(normal[axis] >= 0.0)]
            });
            // An infinite end says nothing.
            nearest.is_nan() || nearest <= pyramid.offsets[side]
        })
    }

    /// Lets a ray end sooner: at this distance, or before it begins if that is negative.
    #[inline]
    pub fn shorten(&mut self, ray: usize, end: f64) {
        self.groups[ray / LANES].end[ray % LANES] = frame_end(end, self.scale);
    }

    /// The farthest end of a ray; negative when all are done.
    #[inline(always)]
    fn farthest(&self) -> f32 {
        let mut farthest = [f32::NEG_INFINITY; LANES];
        for group in &self.groups {
            for (farthest, end) in farthest.iter_mut().zip(group.end) {
                *farthest = larger(end, *farthest);
            }
        }
        farthest.into_iter().fold(f32::NEG_INFINITY, larger)
    }

    /// Tries an item against all rays; `visit` gets eight rays at a time, some of which may meet it.
    #[inline(always)]
    fn try_item(
        &mut self,
        lanes: SimdLevel,
        (ball, cell): (&BoundingSphere, Option<&Aabb32>),
        mut visit: impl FnMut(usize, u32, &mut NewEnds),
    ) -> bool {
        let (centre, radius, distance) = ball.seen_from(self.origin);
        let slab = cell.map(|cell| ViewBox::new(cell, self.origin));
        let mut is_shortened = false;
        for cones in 0..self.cones.len() {
            let asked = ConesAndSphere {
                cones: &self.cones[cones],
                centre,
                radius,
                distance,
            };
            let mut met = lanes.run(asked);
            while met != 0 {
                let place = cones * LANES + met.trailing_zeros() as usize;
                met &= met - 1;
                let Some(group) = self.groups.get(place) else {
                    break;
                };
                let asked = PacketAndSphere {
                    group,
                    centre,
                    radius,
                };
                let mut rays = lanes.run(asked);
                if rays != 0
                    && let Some(slab) = &slab
                {
                    rays &= lanes.run(PacketAndBox { group, slab });
                }
                rays &= self.there(place);
                if rays == 0 {
                    continue;
                }
                let mut ended = NewEnds::default();
                visit(place * LANES, rays, &mut ended);
                is_shortened |= ended.lanes != 0;
                self.end(place, ended);
            }
        }
        is_shortened
    }

    /// Tries some items of a node, one bit each, against all rays, as [`Bundle::try_item`] does. The node lies in a box, if
    /// that is known.
    #[inline(always)]
    fn try_items(
        &mut self,
        lanes: SimdLevel,
        (node, around, items): (&Node, Option<&Aabb32>, u32),
        ball: impl Fn(u32) -> Option<BoundingSphere>,
        mut visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        if self.beams.is_empty() {
            self.beams.extend(self.groups.iter().map(DirInterval::new));
        }
        let pyramid = &self.pyramid;
        let boxes = &lanes.run(NodeBoxes { pyramid, node });
        let around = around.map(|cell| BoundingSphere::around(cell).seen_from(self.origin));
        let mut is_shortened = false;
        for cones in 0..self.cones.len() {
            let mut met = match around {
                Some((centre, radius, distance)) => {
                    let asked = ConesAndSphere {
                        cones: &self.cones[cones],
                        centre,
                        radius,
                        distance,
                    };
                    lanes.run(asked)
                }
                None => 0xff,
            };
            while met != 0 {
                let place = cones * LANES + met.trailing_zeros() as usize;
                met &= met - 1;
                let Some(group) = self.groups.get(place) else {
                    break;
                };
                let (beam, end) = (&self.beams[place], group.farthest());
                let mut some = items & lanes.run(IntervalAndBoxes { beam, boxes, end });
                while some != 0 {
                    let at = some.trailing_zeros() as usize % WIDTH;
                    some &= some - 1;
                    let Some(item) = node.child(at).and_then(Child::item) else {
                        continue;
                    };
                    let (group, beam) = (&self.groups[place], &self.beams[place]);
                    let slab = &boxes.slab(at);
                    let mut rays = lanes.run(IntervalAndBox { group, beam, slab });
                    if rays != 0
                        && let Some(ball) = ball(item)
                    {
                        let (centre, radius, _) = ball.seen_from(self.origin);
                        let asked = PacketAndSphere {
                            group,
                            centre,
                            radius,
                        };
                        rays &= lanes.run(asked);
                    }
                    rays &= self.there(place);
                    if rays != 0 {
                        let mut ended = NewEnds::default();
                        visit(item, place * LANES, rays, &mut ended);
                        is_shortened |= ended.lanes != 0;
                        self.end(place, ended);
                    }
                }
            }
        }
        is_shortened
    }

    /// Which rays of a group there are, one bit each. Sizes without end meet what has none as well: the empty places behind
    /// the last ray.
    #[inline(always)]
    fn there(&self, group: usize) -> u32 {
        0xff >> (LANES - (self.count - group * LANES).min(LANES))
    }

    /// Lets rays of a group end sooner.
    #[inline(always)]
    fn end(&mut self, group: usize, mut ended: NewEnds) {
        while ended.lanes != 0 {
            let lane = ended.lanes.trailing_zeros() as usize % LANES;
            ended.lanes &= ended.lanes - 1;
            self.groups[group].end[lane] = frame_end(ended.ends[lane], self.scale);
        }
    }
}

/// The new ends of some of eight rays.
#[derive(Debug, Default)]
pub struct NewEnds {
    lanes: u32,
    ends: [f64; LANES],
}

impl NewEnds {
    /// Notes the new end of a ray: the distance of a hit, or a negative number for a ray that is done.
    #[inline(always)]
    pub fn note(&mut self, lane: usize, end: f64) {
        self.lanes |= 1 << lane;
        self.ends[lane % LANES] = end;
    }

    /// Calls `visit` with each ray that has a new end, and that.
    #[inline(always)]
    pub(super) fn each(&self, mut visit: impl FnMut(usize, f64)) {
        for lane in (0..LANES).filter(|lane| self.lanes >> lane & 1 == 1) {
            visit(lane, self.ends[lane]);
        }
    }
}

impl Bvh {
    /// Visits, roughly front to back, items with the rays of the bundle that may meet them before the ends of the rays.
    /// `visit` gets the item, the number of the first of eight rays, and which of them are asked, one bit each; it notes
    /// new ends. False if the rays have so little in common that the walk was given up: not all pairs have been
    /// visited then, and each ray is better asked for by itself.
    #[inline(always)]
    #[must_use]
    pub(crate) fn together(
        &self,
        lanes: SimdLevel,
        bundle: &mut Bundle,
        mut visit: impl FnMut(u32, usize, u32, &mut NewEnds),
    ) -> bool {
        let mut patience = LEAST_PATIENCE + PATIENCE * bundle.count;
        let mut end = bundle.farthest();
        let mut pending: Stack<Pending<(Child, u32)>> = Stack::new();
        // A child with the place of its box in the list of all nodes' boxes, which the root has not.
        let mut next = self.root.map(|root| (root, NOWHERE));
        while let Some((child, at)) = next {
            next = None;
            if patience == 0 {
                return false;
            }
            patience -= usize::from(child.item().is_none());
            // Items to be tried: those from the first on that are marked, one bit each.
            let (first, mut met, block) = match child.kind() {
                ChildKind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    let asked = FrustumAndNode {
                        pyramid: &bundle.pyramid,
                        node,
                        end,
                    };
                    let (near_sq, mut met) = lanes.run(asked);
                    let items = met & node.items();
                    if items.count_ones() >= MANY {
                        met &= !items;
                        let around = self.box_at(at);
                        let ball = |item: u32| self.balls.get(item as usize).copied().flatten();
                        let asked = (node, around.as_ref(), items);
                        let is_shortened = bundle.try_items(
                            lanes,
                            asked,
                            ball,
                            #[inline(always)]
                            |item, first, rays, ended| {
                                visit(item, first, rays, ended);
                            },
                        );
                        if is_shortened {
                            end = bundle.farthest();
                        }
                    }
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let at = |place: usize| number * WIDTH as u32 + place as u32;
                    let name = |place: usize| node.child(place).map(|child| (child, at(place)));
                    let bottom = pending.make_room();
                    next = nearest_child((&near_sq, met), (&mut pending, bottom), name);
                    (0, 0, None)
                }
                ChildKind::Block(number) => {
                    let block = &self.blocks[number as usize];
                    let asked = FrustumAndSphereLeaf {
                        pyramid: &bundle.pyramid,
                        block,
                        end,
                    };
                    let met = lanes.run(asked);
                    (self.firsts[number as usize], met, Some(block))
                }
                ChildKind::Item(item) => (item, 1, None),
            };
            while met != 0 {
                let place = met.trailing_zeros();
                met &= met - 1;
                patience = patience.saturating_sub(1);
                let item = first + place;
                let (ball, cell) = match block {
                    Some(block) => (block.ball(place as usize % WIDTH), None),
                    None => self.ball_or_box(item, at),
                };
                let is_shortened = bundle.try_item(
                    lanes,
                    (&ball, cell.as_ref()),
                    #[inline(always)]
                    |first, rays, ended| visit(item, first, rays, ended),
                );
                if is_shortened {
                    end = bundle.farthest();
                }
            }
            while next.is_none()
                && let Some(place) = pending.pop()
            {
                let is_reached = end >= 0.0
                    && place.enter * (1.0 - 8.0 * DOUBT) <= end * end * (1.0 + 8.0 * DOUBT);
                next = is_reached.then_some(place.child);
            }
        }
        true
    }

    /// The box in this place of all nodes.
    #[inline(always)]
    fn box_at(&self, at: u32) -> Option<Aabb32> {
        let node = self.nodes.get(at as usize / WIDTH)?;
        Some(node.cell(at as usize % WIDTH))
    }

    /// A ball that holds an item, whose box is at this place of all nodes, and that box if it tells more.
    #[inline(always)]
    fn ball_or_box(&self, item: u32, at: u32) -> (BoundingSphere, Option<Aabb32>) {
        let cell = || self.nodes[at as usize / WIDTH].cell(at as usize % WIDTH);
        match self.balls.get(item as usize).copied().flatten() {
            Some(ball) if ball.is_filled => (ball, None),
            Some(ball) => (ball, Some(cell())),
            None => {
                let cell = cell();
                (BoundingSphere::around(&cell), Some(cell))
            }
        }
    }
}
