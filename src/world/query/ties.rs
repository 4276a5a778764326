//! Ties: which of the hits at almost one distance is shown.

use super::{ClosestHit, Tie, with_inner_scratch};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::world::compiled::World;
use crate::world::index::index;
use crate::world::model::{IndexedItem, ItemBvh, Model};
use crate::world::ray::{BLUR, Query, RayKind};
use crate::world::slabs::SlabTree;
use smallvec::SmallVec;

/// Hits this near to each other, relative to the distance, may be one point: some thousand roundings.
const TIE: f64 = 1.0 / (1_u64 << 42) as f64;

/// Comparisons of pairs of tied hits of one ray, each of some hundred box tests, after which all are sorted at once.
const MOST_PAIRS: u8 = 8;

/// The distance within which other hits may be one point with a hit: some thousand roundings of its parameter and of the
/// ray's origin.
#[inline(always)]
pub(super) fn tie_slack(t: f64, query: &Query) -> f64 {
    let blur = query.origin_surface.map_or(0.0, |origin| origin.blur);
    TIE * t + TIE / BLUR * blur
}

/// A far limit that leaves in hits at the same point as one at this distance.
#[inline(always)]
pub(super) fn behind(t: f64, query: &Query) -> f64 {
    t + tie_slack(t, query)
}

/// One of several tied hits.
#[derive(Clone, Copy)]
struct TiedHit {
    of: ClosestHit,
    /// Its distance as POV-Ray rounds it.
    distance: f64,
    /// The distance at which the ray enters the box of its item.
    box_entry: f64,
}

impl TiedHit {
    /// The hit that is shown, if that does not depend on the order of the items: POV-Ray tests them all, since each box
    /// begins before all hits, and only one hit is nearest.
    fn nearest_in_any_order(tied: &[TiedHit]) -> Option<ClosestHit> {
        let distances = tied.iter().map(|hit| hit.distance);
        let least = distances.fold(f64::INFINITY, f64::min);
        let mut nearest = tied.iter().filter(|hit| hit.distance == least);
        let first = nearest.next()?;
        let is_only = nearest.next().is_none();
        let are_all_tested = tied.iter().all(|hit| hit.box_entry < least);
        (is_only && are_all_tested).then_some(first.of)
    }
}

impl World {
    /// The hit that is shown of all within a tie of the nearest, among which these two are. POV-Ray comes to one item
    /// after the other, leaves out one whose box begins behind the nearest hit so far, and replaces that by a hit whose
    /// distance it rounds to a smaller number. Where no roundings are known, the least distance decides.
    #[cold]
    #[inline(never)]
    pub(super) fn shown_of_tied(
        &self,
        new: &ClosestHit,
        best: &ClosestHit,
        query: &Query,
    ) -> ClosestHit {
        let ray = &query.ray;
        let item = |of: &ClosestHit| of.item;
        let box_entry = |of: &ClosestHit| self.box_entry(of.item, ray);
        if best.tie != Tie::Settled && self.is_alike_for_shadows(new, best, query) {
            let order = |of: &ClosestHit| (of.hit.root.t, of.item);
            return if order(new) < order(best) {
                *new
            } else {
                *best
            };
        }
        // Neither is rounded otherwise: the order of all tied hits is that of each pair. Many are sorted at once.
        if let Tie::Pairs(pairs @ 0..MOST_PAIRS) = best.tie
            && !self.decides_ties(best)
            && !self.decides_ties(new)
        {
            let mut both = [*best, *new].map(|of| ClosestHit {
                tie: Tie::Pairs(pairs + 1),
                ..of
            });
            if best.hit.root.t == new.hit.root.t {
                self.sort_as_povray(&mut both, item, box_entry, ray);
            } else {
                both.sort_by(|a, b| a.hit.root.t.total_cmp(&b.hit.root.t));
            }
            return both[0];
        }
        // All of them, so that the order in which rays come to items does not matter.
        let mut tied = self.tied_hits(query, new.hit.root.t.min(best.hit.root.t));
        if !tied.iter().any(|of| self.decides_ties(of)) {
            let distances = tied.iter().map(|of| of.hit.root.t);
            let least = distances.fold(f64::INFINITY, f64::min);
            tied.retain(|of| of.hit.root.t == least);
            self.sort_as_povray(&mut tied, item, box_entry, ray);
            return tied.first().copied().unwrap_or(*best);
        }
        let mut tied: SmallVec<[TiedHit; 4]> = tied
            .iter()
            .map(|of| TiedHit {
                of: *of,
                distance: self.povray_distance(of, query),
                box_entry: self.box_entry(of.item, ray),
            })
            .collect();
        if let Some(nearest) = TiedHit::nearest_in_any_order(&tied) {
            return nearest;
        }
        self.sort_as_povray(&mut tied, |tied| tied.of.item, |tied| tied.box_entry, ray);
        let nearer = |a: TiedHit, b: TiedHit| {
            if b.box_entry < a.distance && b.distance < a.distance {
                b
            } else {
                a
            }
        };
        let nearest = tied.into_iter().reduce(nearer);
        nearest.map_or(*best, |nearest| nearest.of)
    }

    /// Returns true if light is transmitted alike whichever of two tied hits is shown.
    fn is_alike_for_shadows(&self, a: &ClosestHit, b: &ClosestHit, query: &Query) -> bool {
        query.kind == RayKind::Shadow
            && a.hit.surface == b.hit.surface
            && self.uniform_transmittance(a.hit.surface).is_some()
    }

    /// The first hits of all items within a tie of the nearest one, which lies at `least` or before.
    fn tied_hits(&self, query: &Query, mut least: f64) -> SmallVec<[ClosestHit; 4]> {
        with_inner_scratch(|scratch| {
            let search = self.search_for(query);
            let mut tied = SmallVec::<[ClosestHit; 4]>::new();
            // Items nearer than a tie replace these when the search comes to them; others at their distance are not looked for.
            let from = least - tie_slack(least, query);
            let mut far = behind(least, query);
            let mut visit = |item: IndexedItem| {
                let hit = self.intersect_item(item, query, &search, behind(least, query), scratch);
                if let Some(hit) = hit.filter(|hit| (from..query.t_max).contains(&hit.root.t)) {
                    least = least.min(hit.root.t);
                    let item = item.number;
                    tied.push(ClosestHit {
                        hit,
                        item,
                        tie: Tie::Settled,
                    });
                }
                behind(least, query)
            };
            for &item in &self.bvh().unbounded {
                far = visit(item);
            }
            let ItemBvh { tree, bounded, .. } = self.bvh();
            with_widest(|lanes| {
                tree.nearest_in(lanes, &query.ray, (from, far), |number, _| {
                    visit(bounded[number as usize])
                });
            });
            tied.retain(|of| of.hit.root.t <= behind(least, query));
            tied
        })
    }

    /// Returns true if POV-Ray's rounding of the distance of a hit is known and decides ties.
    fn decides_ties(&self, of: &ClosestHit) -> bool {
        let Model {
            rounding, leaves, ..
        } = &self.model;
        rounding.decides_ties(of.hit.leaf, leaves)
    }

    /// The distance of a hit as POV-Ray rounds it where that is known.
    fn povray_distance(&self, of: &ClosestHit, query: &Query) -> f64 {
        let Model {
            rounding, leaves, ..
        } = &self.model;
        let t = of.hit.root.t;
        rounding
            .tied_distance(of.hit.leaf, leaves, &query.ray, &of.hit.root)
            .filter(|rounded| (rounded - t).abs() <= tie_slack(t, query))
            .unwrap_or(t)
    }

    /// The distance at which a ray enters the box of an item, as POV-Ray rounds it; none for an unbounded item, or where
    /// it uses no boxes.
    fn box_entry(&self, item: u32, ray: &Ray) -> f64 {
        let item_box = self.tree_box(item).filter(|_| self.ties_by_box);
        item_box.map_or(f64::NEG_INFINITY, |item_box| item_box.entry(ray))
    }

    /// Sorts hits at one distance as POV-Ray comes to their items: as its tree of boxes delivers them, unbounded ones
    /// first, then mostly by the distance at which the ray enters the box (docs/povray-shapes.md, section 5.2).
    #[cold]
    fn sort_as_povray<T: Copy>(
        &self,
        tied: &mut [T],
        item: impl Fn(&T) -> u32,
        box_entry: impl Fn(&T) -> f64,
        ray: &Ray,
    ) {
        tied.sort_by_key(&item);
        if self.ties_by_box && tied.len() > 1 {
            let tree = self.slab_tree.get_or_init(|| {
                SlabTree::new((0..index(self.boxes.len())).map(|item| self.tree_box(item)))
            });
            tree.sort(tied, item, box_entry, ray);
        }
    }
}
