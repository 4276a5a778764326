//! Large meshes and many rays from one point: the rays go through the mesh's own tree together.

use super::csg::Found;
use super::leaf::Leaf;
use super::lot::Lot;
use super::model::Item;
use super::order::Numbered;
use super::query::{Best, Query, Scratch, Way};
use super::together::each_bit;
use super::world::World;
use crate::accel::Bundle;
use crate::math::lanes::Lanes;
use crate::math::watertight::{FourFrames, RayFrame};
use crate::shape::{Mesh, Shape};
use glam::DVec3;

/// Meshes of fewer triangles are asked by one ray at a time, as all other shapes.
const LEAST_TRIANGLES: usize = 256;
/// Among more meshes than this rays find their way one by one.
const MOST_MESHES: usize = 8;

/// Buffers that a thread keeps between meshes.
#[derive(Debug, Default)]
pub(super) struct MeshScratch {
    bundle: Bundle,
    frames: Vec<RayFrame>,
    /// Them, four by four, where they are longest along the same axis.
    fours: Vec<Option<FourFrames>>,
}

/// A mesh of a world, for rays that go together.
struct Asked<'w> {
    number: u32,
    leaf: &'w Leaf,
    mesh: &'w Mesh,
}

impl World {
    /// The items that are meshes through which rays go together; none if there are too many of them.
    pub(super) fn large_meshes(&self) -> Vec<Numbered> {
        let is_large = |item: &&Numbered| {
            let asked = self.asked(**item);
            asked.is_some_and(|asked| asked.mesh.is_patch() && asked.mesh.len() >= LEAST_TRIANGLES)
        };
        let meshes: Vec<Numbered> = self
            .finder()
            .bounded
            .iter()
            .filter(is_large)
            .copied()
            .collect();
        if meshes.len() <= MOST_MESHES {
            meshes
        } else {
            Vec::new()
        }
    }

    /// Whether rays that go together have been through an item already.
    #[inline(always)]
    pub(super) fn is_large_mesh(&self, item: Numbered) -> bool {
        self.meshes.iter().any(|mesh| mesh.number == item.number)
    }

    fn asked(&self, item: Numbered) -> Option<Asked<'_>> {
        let Item::Leaf(number) = item.item else {
            return None;
        };
        let leaf = &self.model.leaves[number as usize];
        match &leaf.shape {
            Shape::Mesh(mesh) => Some(Asked { number, leaf, mesh }),
            _ => None,
        }
    }

    /// Lets the queries of a lot, which start at one point, go through the large meshes that they may meet, and makes
    /// `bests` and `bundle` know what they find. False if some could not go together.
    #[inline(always)]
    pub(super) fn see_meshes(
        &self,
        lanes: Lanes,
        (lot, bests): (&mut Lot, &mut [Option<Best>]),
        query: impl Fn(usize) -> Query,
        (bundle, origin): (&mut Bundle, DVec3),
        scratch: &mut Scratch,
    ) -> bool {
        for &item in &self.meshes {
            let Some(asked) = self.asked(item).filter(|_| self.may_meet(bundle, item)) else {
                continue;
            };
            let mut own = std::mem::take(&mut scratch.mesh);
            let count = bests.len();
            let mut bundle_of_mesh = std::mem::take(&mut own.bundle);
            let is_done = asked.enter((&mut own, &mut bundle_of_mesh), (origin, 1.0), count, lot)
                && asked.mesh.tree().together(
                    lanes,
                    &mut bundle_of_mesh,
                    #[inline(always)]
                    |face, first, rays, ended| {
                        asked.meet(
                            lanes,
                            (&own, lot),
                            (face, first, rays),
                            #[inline(always)]
                            |lot, ray, t| {
                                let found = asked.found(t, face);
                                let far = lot.far(ray);
                                let best = &mut bests[ray];
                                // Of several triangles at the same distance the first in the list is drawn.
                                if let Some(best) = best
                                    && best.item == item.number
                                    && best.found.root.t == t
                                {
                                    if face < best.found.root.face {
                                        best.found = found;
                                    }
                                    return;
                                }
                                let query = query(ray);
                                if !self.is_seen(&found, query.seen) {
                                    return;
                                }
                                let new = self.offer(item.number, found, &query, far, best);
                                if new < far {
                                    lot.shorten(ray, new);
                                    bundle.shorten(ray, new);
                                    ended.note(ray - first, asked.way(new, &own.frames[ray]));
                                }
                            },
                        );
                    },
                );
            own.bundle = bundle_of_mesh;
            scratch.mesh = own;
            if !is_done {
                return false;
            }
        }
        true
    }

    /// The same for rays to a light at `centre`: `ways` learns what is blocked.
    #[inline(always)]
    pub(super) fn meshes_block(
        &self,
        lanes: Lanes,
        (lot, ways): (&mut Lot, &mut [Way]),
        query: impl Fn(usize) -> Query,
        (bundle, centre): (&mut Bundle, DVec3),
        scratch: &mut Scratch,
    ) -> bool {
        for &item in &self.meshes {
            let Some(asked) = self.asked(item).filter(|_| self.may_meet(bundle, item)) else {
                continue;
            };
            let mut own = std::mem::take(&mut scratch.mesh);
            let count = ways.len();
            let mut bundle_of_mesh = std::mem::take(&mut own.bundle);
            let is_done = asked.enter((&mut own, &mut bundle_of_mesh), (centre, -1.0), count, lot)
                && asked.mesh.tree().together(
                    lanes,
                    &mut bundle_of_mesh,
                    #[inline(always)]
                    |face, first, rays, ended| {
                        asked.meet(
                            lanes,
                            (&own, lot),
                            (face, first, rays),
                            #[inline(always)]
                            |_, ray, t| {
                                if ways[ray] == Way::Blocked {
                                    return;
                                }
                                let query = query(ray);
                                let is_left = query.from.is_some_and(|left| {
                                    left.leaf == asked.number && left.face == face
                                });
                                if is_left || t >= query.far {
                                    return;
                                }
                                let found = asked.found(t, face);
                                if self.blocks_light(&found, &query, &mut ways[ray]) {
                                    ways[ray] = Way::Blocked;
                                    bundle.shorten(ray, f64::NEG_INFINITY);
                                    ended.note(ray - first, f64::NEG_INFINITY);
                                }
                            },
                        );
                    },
                );
            own.bundle = bundle_of_mesh;
            scratch.mesh = own;
            if !is_done {
                return false;
            }
        }
        true
    }

    fn may_meet(&self, bundle: &Bundle, item: Numbered) -> bool {
        let bounds = self.boxes[item.number as usize].bounds();
        bundle.may_meet(&self.finder().tree, &bounds)
    }
}

impl Asked<'_> {
    /// Makes the queries ready for the tree of the mesh. They have the point `origin` in common and go from there in
    /// their direction, or come from there (`sign` -1).
    #[inline(always)]
    fn enter(
        &self,
        (own, bundle): (&mut MeshScratch, &mut Bundle),
        (origin, sign): (DVec3, f64),
        count: usize,
        lot: &Lot,
    ) -> bool {
        let origin = self.leaf.point_to_object(origin);
        own.frames.clear();
        for ray in 0..count {
            let ray = self.leaf.to_object(&lot.ray(ray));
            own.frames.push(RayFrame::new(&ray));
        }
        let frames = &own.frames;
        own.fours.clear();
        own.fours.extend(frames.chunks(4).map(FourFrames::new));
        bundle.fill(
            self.mesh.tree(),
            origin,
            count,
            #[inline(always)]
            |four| {
                let (mut dirs, mut ends) = ([[0.0; 4]; 3], [0.0; 4]);
                for lane in 0..4 {
                    let ray = (4 * four + lane).min(count - 1);
                    // The queries have unit directions.
                    let dir = match self.leaf.object_from_world {
                        None => sign * frames[ray].dir(),
                        Some(_) => sign * frames[ray].unit_dir(),
                    };
                    for axis in 0..3 {
                        dirs[axis][lane] = dir[axis];
                    }
                    ends[lane] = self.end(lot, ray, &frames[ray], sign, origin);
                }
                (dirs, ends)
            },
        )
    }

    /// Calls `take` with the number and the parameter of each of some rays, those of `rays` from the first on, that meet
    /// a triangle before they end.
    #[inline(always)]
    fn meet(
        &self,
        lanes: Lanes,
        (own, lot): (&MeshScratch, &mut Lot),
        (face, first, rays): (u32, usize, u32),
        mut take: impl FnMut(&mut Lot, usize, f64),
    ) {
        for half in [0, 4] {
            let some = rays >> half & 0b1111;
            if some == 0 {
                continue;
            }
            let start = first + half as usize;
            let mut singly = some;
            if let Some(four) = &own.fours[start / 4]
                && !some.is_power_of_two()
            {
                let found = self.mesh.meet_four(lanes, four, face);
                singly &= found.unknown;
                each_bit(found.met & some, |lane| {
                    let (ray, t) = (start + lane, found.t[lane % 4]);
                    if lot.from(ray) < t && t <= lot.far(ray) {
                        take(lot, ray, t);
                    }
                });
            }
            each_bit(singly, |lane| {
                let ray = start + lane;
                if let Some(t) = self.mesh.meet(&own.frames[ray], face)
                    && lot.from(ray) < t
                    && t <= lot.far(ray)
                {
                    take(lot, ray, t);
                }
            });
        }
    }

    /// Where a query ends, in the space of the mesh and from the common point.
    #[inline(always)]
    fn end(&self, lot: &Lot, ray: usize, frame: &RayFrame, sign: f64, origin: DVec3) -> f64 {
        if lot.far(ray) < 0.0 {
            f64::NEG_INFINITY
        } else if sign < 0.0 {
            frame.origin().distance(origin)
        } else {
            self.way(lot.far(ray), frame)
        }
    }

    /// The way in the space of the mesh that a ray goes up to a parameter.
    #[inline(always)]
    fn way(&self, t: f64, frame: &RayFrame) -> f64 {
        match self.leaf.object_from_world {
            None => t,
            Some(_) => t * frame.speed(),
        }
    }

    #[inline(always)]
    fn found(&self, t: f64, face: u32) -> Found {
        Found {
            root: Mesh::root(t, face),
            leaf: self.number,
            surface: self.leaf.surface,
        }
    }
}
