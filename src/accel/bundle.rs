//! Many rays from one point at once: those of a camera to a tile of the picture, or those between a light and the points
//! that it may light.
//!
//! The tree is walked once for all of them. Nodes are tried against the pyramid around the rays, items by their balls
//! against groups of eight rays and then against single ones, all in single precision with every doubt in favour of
//! being met. What remains is a short list of pairs of an item and a ray, which the caller tries exactly. So the answers
//! are those of one ray at a time, to the bit.

use super::block::Block;
use super::node::{Cell, Child, Frame, Kind, Node, WIDTH, larger, smaller};
use super::{Bvh, Pending, Stack, nearest_child};
use crate::math::Bounds;
use crate::math::lanes::{Eight, Kernel, Lanes, eight};
use crate::math::rounding::{f32_above, f32_below, loose_above, loose_below, nearest};
use glam::{DVec3, Vec3};

/// How many rays are tried at once.
pub(super) const LANES: usize = 8;
/// Above the relative error of the single precision arithmetic here, some ten roundings.
pub(super) const DOUBT: f32 = 1.0e-6;
/// Rays must not spread farther from their middle than this cosine, or a pyramid is no use.
const LEAST_COSINE: f32 = 0.2;
/// From farther away, in sizes of the tree, single precision cannot tell its items apart.
pub(super) const FARTHEST: f64 = 256.0;

/// How many nodes and items may be visited for each ray of a bundle. A ray by itself visits some twenty, each of which
/// costs about as much.
const PATIENCE: usize = 6;
/// How many more may be visited by any bundle.
const LEAST_PATIENCE: usize = 32;

/// A number of rays from one point.
#[derive(Debug, Default)]
pub struct Bundle {
    /// In the frame of the tree.
    origin: DVec3,
    groups: Vec<Group>,
    /// How many rays there are; the last group may have room for more.
    count: usize,
    cones: Vec<Cones>,
    pyramid: Pyramid,
    /// Frame lengths of world lengths.
    scale: f64,
}

/// Eight rays: unit directions, and where each ends in the frame. A ray that is done ends before it begins.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Group {
    pub(super) dir: [[f32; LANES]; 3],
    pub(super) end: [f32; LANES],
}

/// The middle directions of eight groups, and how far a direction of the group can lie from it.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Cones {
    middle: [[f32; LANES]; 3],
    spread: [f32; LANES],
}

/// Four planes through the common origin; a box on the far side of one is not met.
#[derive(Clone, Copy, Debug, Default)]
struct Pyramid {
    normals: [[f32; 3]; 4],
    offsets: [f32; 4],
    /// The lengths of the normals, and somewhat more.
    sizes: [f32; 4],
    /// No less than what rounding moves the origin by.
    slack: f32,
    /// The origin rounded down and up.
    low: [f32; 3],
    high: [f32; 3],
}

/// A ball around an item, in the frame of its tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    centre: [f32; 3],
    radius: f32,
    /// Whether the item fills it, so that its box tells no more.
    pub(super) is_filled: bool,
}

impl Ball {
    /// Around the points within a radius of a centre, which are all of the item or not.
    pub(super) fn new(frame: &Frame, (centre, radius, is_filled): (DVec3, f64, bool)) -> Self {
        let centre = frame.place(centre);
        let radius = radius * frame.scale();
        let rounded = [centre.x, centre.y, centre.z].map(nearest);
        let moved = (DVec3::from(rounded.map(f64::from)) - centre).length();
        Ball {
            centre: rounded,
            radius: f32_above((radius + moved) * (1.0 + 1e-9)),
            is_filled,
        }
    }
}

impl Ball {
    /// One that its item fills.
    #[inline(always)]
    pub(super) fn filled(centre: [f32; 3], radius: f32) -> Self {
        Ball {
            centre,
            radius,
            is_filled: true,
        }
    }

    /// The box around it.
    pub(super) fn cell(&self) -> Cell {
        let radius = f64::from(self.radius);
        Cell {
            low: self
                .centre
                .map(|centre| loose_below(f64::from(centre) - radius)),
            high: self
                .centre
                .map(|centre| loose_above(f64::from(centre) + radius)),
        }
    }

    /// Around a box.
    #[inline(always)]
    pub(super) fn around(cell: &Cell) -> Self {
        let (low, high) = (Vec3::from_array(cell.low), Vec3::from_array(cell.high));
        let centre = 0.5 * low + 0.5 * high;
        // Beyond what is lost in the rounding of the middle.
        let size = low.abs().max(high.abs()).max_element();
        Ball {
            centre: centre.to_array(),
            radius: (0.5 * high - 0.5 * low).length() * (1.0 + 4.0 * DOUBT) + DOUBT * size,
            is_filled: false,
        }
    }

    /// Its centre as seen from a place in the frame, a radius that makes up for the rounding of that, and the distance.
    #[inline(always)]
    pub(super) fn seen_from(&self, origin: DVec3) -> (Vec3, f32, f32) {
        let centre = (DVec3::from(self.centre.map(f64::from)) - origin).as_vec3();
        let distance = centre.length();
        (centre, self.radius + 2.0 * DOUBT * distance, distance)
    }
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
        let last = (count - 1) / 4;
        for number in 0..count.div_ceil(LANES) {
            let mut group = Group::EMPTY;
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
            let mut cones = Cones {
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
        lanes: Lanes,
        (ball, cell): (&Ball, Option<&Cell>),
        mut visit: impl FnMut(usize, u32, &mut Ended),
    ) -> bool {
        let (centre, radius, distance) = ball.seen_from(self.origin);
        let slab = cell.map(|cell| Slab::new(cell, self.origin));
        let mut is_shortened = false;
        for cones in 0..self.cones.len() {
            let asked = ConesAndBall {
                cones: &self.cones[cones],
                centre,
                radius,
                distance,
            };
            let mut met = eight(lanes, &asked);
            while met != 0 {
                let place = cones * LANES + met.trailing_zeros() as usize;
                met &= met - 1;
                let Some(group) = self.groups.get(place) else {
                    break;
                };
                let asked = GroupAndBall {
                    group,
                    centre,
                    radius,
                };
                let mut rays = eight(lanes, &asked);
                if rays != 0
                    && let Some(slab) = &slab
                {
                    rays &= eight(lanes, &GroupAndBox { group, slab });
                }
                // Sizes without end meet what has none as well: the empty places behind the last ray.
                let there = (self.count - place * LANES).min(LANES);
                rays &= 0xff >> (LANES - there);
                if rays == 0 {
                    continue;
                }
                let mut ended = Ended::default();
                visit(place * LANES, rays, &mut ended);
                is_shortened |= ended.lanes != 0;
                while ended.lanes != 0 {
                    let lane = ended.lanes.trailing_zeros() as usize % LANES;
                    ended.lanes &= ended.lanes - 1;
                    self.groups[place].end[lane] = frame_end(ended.ends[lane], self.scale);
                }
            }
        }
        is_shortened
    }
}

/// The new ends of some of eight rays.
#[derive(Debug, Default)]
pub struct Ended {
    lanes: u32,
    ends: [f64; LANES],
}

impl Ended {
    /// Notes the new end of a ray: the distance of a hit, or a negative number for a ray that is done.
    #[inline(always)]
    pub fn note(&mut self, lane: usize, end: f64) {
        self.lanes |= 1 << lane;
        self.ends[lane % LANES] = end;
    }
}

/// A box as seen from the common origin, rounded outward.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    low: [f32; 3],
    high: [f32; 3],
}

impl Slab {
    /// Of nothing.
    pub(super) const NOTHING: Slab = Slab {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    // Spelt out: `map` is not always inlined.
    #[inline(always)]
    pub(super) fn new(cell: &Cell, origin: DVec3) -> Self {
        let below = |axis: usize| loose_below(f64::from(cell.low[axis]) - origin[axis]);
        let above = |axis: usize| loose_above(f64::from(cell.high[axis]) - origin[axis]);
        Slab {
            low: [below(0), below(1), below(2)],
            high: [above(0), above(1), above(2)],
        }
    }
}

impl Slab {
    /// Whether a ray from the origin in this direction may meet it before `end`: [`GroupAndBox`] for a single one.
    #[inline(always)]
    pub(super) fn is_met(&self, dir: Vec3, end: f32) -> bool {
        let (mut enter, mut leave) = (0.0, end);
        for axis in 0..3 {
            let inverse = 1.0 / dir[axis];
            let (low, high) = (self.low[axis] * inverse, self.high[axis] * inverse);
            enter = larger(smaller(low, high), enter);
            leave = smaller(larger(high, low), leave);
        }
        let slack = 4.0 * DOUBT * (enter.abs() + leave.abs());
        enter - slack <= leave + f32::MIN_POSITIVE
    }
}

impl Group {
    pub(super) const EMPTY: Group = Group {
        dir: [[0.0; LANES]; 3],
        end: [f32::NEG_INFINITY; LANES],
    };

    /// Takes in the first or second half of its rays: unit directions, and where each ends, in a frame of this scale.
    #[inline(always)]
    pub(super) fn take(
        &mut self,
        half: usize,
        (dir, end): (&[[f64; 4]; 3], &[f64; 4]),
        scale: f64,
    ) {
        let at = 4 * half;
        // Spelt out: `map` is not always inlined.
        for (to, from) in self.dir.iter_mut().zip(dir) {
            for (to, from) in to[at..at + 4].iter_mut().zip(from) {
                *to = nearest(*from);
            }
        }
        for (to, from) in self.end[at..at + 4].iter_mut().zip(end) {
            *to = frame_end(*from, scale);
        }
    }

    /// The farthest end; negative when all are done.
    #[inline(always)]
    pub(super) fn farthest(&self) -> f32 {
        let mut farthest = f32::NEG_INFINITY;
        for end in self.end {
            farthest = larger(end, farthest);
        }
        farthest
    }

    #[inline(always)]
    fn dot(&self, with: Vec3) -> [f32; LANES] {
        let [x, y, z] = &self.dir;
        let mut dot = [0.0; LANES];
        for i in 0..LANES {
            dot[i] = x[i] * with.x + y[i] * with.y + z[i] * with.z;
        }
        dot
    }

    /// The middle direction, and a bound on the distance of the others from it.
    #[inline(always)]
    fn cone(&self) -> (Vec3, f32) {
        #[allow(clippy::cast_precision_loss, reason = "8 is exact")]
        let middle = Vec3::from_array(
            self.dir
                .map(|lanes| lanes.iter().sum::<f32>() / LANES as f32),
        );
        let mut off = [0.0; LANES];
        for (i, off) in off.iter_mut().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|axis| self.dir[axis][i] - middle[axis]);
            *off = x * x + y * y + z * z;
        }
        let farthest = off.into_iter().fold(0.0, larger);
        (middle, farthest.sqrt() + 4.0 * DOUBT)
    }
}

/// Which rays of a group may meet a ball, one bit each: its centre lies near the line, neither behind nor beyond the end.
pub(super) struct GroupAndBall<'a> {
    pub(super) group: &'a Group,
    pub(super) centre: Vec3,
    pub(super) radius: f32,
}

impl Kernel for GroupAndBall<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let dir: [E; 3] = load(&self.group.dir);
        let centre = all(self.centre.to_array());
        let radius = E::all(self.radius);
        let limit = E::all(self.radius * self.radius * (1.0 + 4.0 * DOUBT));
        let along = dot(dir, centre);
        let is_near = length_sq(cross(dir, centre)).not_above(limit);
        let is_ahead = E::all(0.0).not_above(along.plus(radius));
        let is_before = along.minus(radius).not_above(E::load(&self.group.end));
        is_near & is_ahead & is_before
    }
}

/// Which rays of a group may meet a box, one bit each.
pub(super) struct GroupAndBox<'a> {
    pub(super) group: &'a Group,
    pub(super) slab: &'a Slab,
}

impl Kernel for GroupAndBox<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let mut enter = E::all(0.0);
        let mut leave = E::load(&self.group.end);
        for axis in 0..3 {
            let inverse = E::all(1.0).over(E::load(&self.group.dir[axis]));
            let low = E::all(self.slab.low[axis]).times(inverse);
            let high = E::all(self.slab.high[axis]).times(inverse);
            // The running bound where a plane says nothing (zero times infinity).
            enter = low.smaller(high).larger(enter);
            leave = high.larger(low).smaller(leave);
        }
        let slack = E::all(4.0 * DOUBT).times(enter.size().plus(leave.size()));
        enter
            .minus(slack)
            .not_above(leave.plus(E::all(f32::MIN_POSITIVE)))
    }
}

/// Which of eight groups may hold a ray that meets a ball, one bit each. Moving a direction by a length moves its
/// distance from the centre by no more than that share of the distance of the centre.
struct ConesAndBall<'a> {
    cones: &'a Cones,
    centre: Vec3,
    radius: f32,
    distance: f32,
}

impl Kernel for ConesAndBall<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let middle: [E; 3] = load(&self.cones.middle);
        let centre = all(self.centre.to_array());
        let reach = E::all(self.distance).times(E::load(&self.cones.spread));
        let limit = E::all(self.radius).plus(reach);
        let limit_sq = limit.times(limit).times(E::all(1.0 + 4.0 * DOUBT));
        let is_near = length_sq(cross(middle, centre)).not_above(limit_sq);
        is_near & E::all(0.0).not_above(limit)
    }
}

#[inline(always)]
pub(super) fn dot<E: Eight>(a: [E; 3], b: [E; 3]) -> E {
    a[0].times(b[0])
        .plus(a[1].times(b[1]))
        .plus(a[2].times(b[2]))
}

#[inline(always)]
pub(super) fn cross<E: Eight>(a: [E; 3], b: [E; 3]) -> [E; 3] {
    [
        a[1].times(b[2]).minus(a[2].times(b[1])),
        a[2].times(b[0]).minus(a[0].times(b[2])),
        a[0].times(b[1]).minus(a[1].times(b[0])),
    ]
}

// A closure would not take part in the wide lanes of its caller, so these are spelt out.

#[inline(always)]
pub(super) fn load<E: Eight>(from: &[[f32; LANES]; 3]) -> [E; 3] {
    [E::load(&from[0]), E::load(&from[1]), E::load(&from[2])]
}

#[inline(always)]
pub(super) fn all<E: Eight>(of: [f32; 3]) -> [E; 3] {
    [E::all(of[0]), E::all(of[1]), E::all(of[2])]
}

#[inline(always)]
pub(super) fn length_sq<E: Eight>(a: [E; 3]) -> E {
    dot(a, a)
}

/// The square of how near each box of a node comes to the origin at the least, and which boxes a ray that ends at `end`
/// may meet, one bit each.
struct PyramidAndNode<'a> {
    pyramid: &'a Pyramid,
    node: &'a Node,
    end: f32,
}

impl Kernel for PyramidAndNode<'_> {
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
struct PyramidAndBlock<'a> {
    pyramid: &'a Pyramid,
    block: &'a Block,
    end: f32,
}

impl Kernel for PyramidAndBlock<'_> {
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

impl Bvh {
    /// Visits, roughly front to back, items with the rays of the bundle that may meet them before the ends of the rays.
    /// `visit` gets the item, the number of the first of eight rays, and which of them are asked, one bit each; it notes
    /// new ends. False if the rays have so little in common that the walk was given up: not all pairs have been
    /// visited then, and each ray is better asked for by itself.
    #[inline(always)]
    #[must_use]
    pub(crate) fn together(
        &self,
        lanes: Lanes,
        bundle: &mut Bundle,
        mut visit: impl FnMut(u32, usize, u32, &mut Ended),
    ) -> bool {
        let mut patience = LEAST_PATIENCE + PATIENCE * bundle.count;
        let mut end = bundle.farthest();
        let mut pending: Stack<Pending<(Child, u32)>> = Stack::new();
        // A child with the place of its box in the list of all nodes' boxes.
        let mut next = self.root.map(|root| (root, 0));
        while let Some((child, at)) = next {
            next = None;
            if patience == 0 {
                return false;
            }
            patience -= usize::from(child.item().is_none());
            // Items to be tried: those from the first on that are marked, one bit each.
            let (first, mut met, block) = match child.kind() {
                Kind::Node(number) => {
                    let node = &self.nodes[number as usize];
                    let asked = PyramidAndNode {
                        pyramid: &bundle.pyramid,
                        node,
                        end,
                    };
                    let (near_sq, met) = eight(lanes, &asked);
                    #[allow(clippy::cast_possible_truncation, reason = "one of eight")]
                    let at = |place: usize| number * WIDTH as u32 + place as u32;
                    let name = |place: usize| node.child(place).map(|child| (child, at(place)));
                    let bottom = pending.make_room();
                    next = nearest_child((&near_sq, met), (&mut pending, bottom), name);
                    (0, 0, None)
                }
                Kind::Block(number) => {
                    let block = &self.blocks[number as usize];
                    let asked = PyramidAndBlock {
                        pyramid: &bundle.pyramid,
                        block,
                        end,
                    };
                    let met = eight(lanes, &asked);
                    (self.firsts[number as usize], met, Some(block))
                }
                Kind::Item(item) => (item, 1, None),
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

    /// A ball that holds an item, whose box is at this place of all nodes, and that box if it tells more.
    #[inline(always)]
    fn ball_or_box(&self, item: u32, at: u32) -> (Ball, Option<Cell>) {
        let cell = || self.nodes[at as usize / WIDTH].cell(at as usize % WIDTH);
        match self.balls.get(item as usize).copied().flatten() {
            Some(ball) if ball.is_filled => (ball, None),
            Some(ball) => (ball, Some(cell())),
            None => {
                let cell = cell();
                (Ball::around(&cell), Some(cell))
            }
        }
    }
}

/// Where a ray ends in the frame, at the latest.
#[inline(always)]
pub(super) fn frame_end(end: f64, scale: f64) -> f32 {
    let end = nearest(end * scale);
    if end.is_nan() {
        f32::INFINITY
    } else {
        end * (1.0 + 4.0 * DOUBT)
    }
}
