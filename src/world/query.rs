//! Ray queries, and the buffers that a thread reuses between them.

mod again;
pub(super) mod blocker_memory;
pub(super) mod closest;
pub(super) mod hit_leaves;
mod instance;
pub(super) mod intersect;
pub(super) mod occlusion;
pub(super) mod packet;
mod projector;
pub(super) mod ray_counts;
mod ties;
pub(super) mod transmission;

use super::csg::sweep::{RawHit, Sweep};
use super::model::IndexedItem;
use super::query::blocker_memory::BlockerMemory;
use super::query::hit_leaves::HitLeaves;
use super::query::packet::mesh::MeshScratch;
use super::query::packet::rays::RayStream;
use super::query::ray_counts::RayCounts;
use super::query::transmission::ItemSet;
use crate::base::accel::{Bundle, ParallelBundle};
use crate::scene::shape::Root;
use smallvec::SmallVec;
use std::cell::Cell;

/// Per-thread buffers that ray queries reuse.
#[derive(Debug, Default)]
pub struct QueryScratch {
    /// Numbers of rays traced.
    pub rays: RayCounts,
    pub(super) sweep: Sweep,
    pub(super) roots: Vec<Root>,
    /// For each light, the item that last blocked a shadow ray to it.
    pub(super) blockers: SmallVec<[Option<IndexedItem>; 8]>,
    /// POV-Ray's memory of blockers, if shadow rays are traced in its order.
    pub memory: Option<Box<BlockerMemory>>,
    pub(super) bundle: Bundle,
    pub(super) parallel_bundle: ParallelBundle,
    pub(super) bests: Vec<Option<ClosestHit>>,
    pub(super) ray_stream: RayStream,
    pub(super) mesh: MeshScratch,
    /// Transmissive items on the current shadow ray.
    pub(super) transmissive_items: ItemSet,
    /// Hits on the CSG programs among them: one program after the other, each in order of distance.
    pub(super) passed: Vec<RawHit>,
    /// The primitives hit, if they are noted.
    pub hit_leaves: Option<Box<HitLeaves>>,
}

impl QueryScratch {
    /// Notes the primitives of closest hits, if that is wanted.
    #[inline(always)]
    pub(super) fn note_leaves(&mut self, bests: &[Option<ClosestHit>]) {
        if let Some(hit_leaves) = &mut self.hit_leaves {
            hit_leaves.note_all(bests);
        }
    }
}

thread_local! {
    static INNER: Cell<Option<Box<QueryScratch>>> = const { Cell::new(None) };
}

/// Calls `query`, which is part of a query whose own buffers are in use, with other buffers.
fn with_inner_scratch<T>(query: impl FnOnce(&mut QueryScratch) -> T) -> T {
    let mut scratch = INNER.take().unwrap_or_default();
    let result = query(&mut scratch);
    INNER.set(Some(scratch));
    result
}

/// The rule by which a hit was chosen among those at the same distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tie {
    /// In this number of comparisons with one other hit.
    Pairs(u8),
    /// Among all of them: no other at the same distance, or behind it, is shown instead.
    Settled,
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestHit {
    pub(super) hit: RawHit,
    pub(super) item: u32,
    pub(super) tie: Tie,
}
