//! What light passes on its way: found in one search, then met one after the other without searching again.

use super::order::Numbered;
use super::query::{Best, Hit, Query, Scratch};
use super::world::World;
use crate::math::lanes::with_widest;
use smallvec::SmallVec;

/// Some items of a world.
pub(super) type Items = SmallVec<[Numbered; 8]>;

impl World {
    /// Finds all that a ray meets, for [`World::nearest_among`].
    pub fn gather(&self, query: &Query, scratch: &mut Scratch) {
        let mut among = std::mem::take(&mut scratch.among);
        among.clear();
        let search = self.search_for(query);
        with_widest(
            #[inline(always)]
            |lanes| {
                let mut take = |item: Numbered| {
                    let mut best = None;
                    self.try_item(item, (query, &search), query.far, &mut best, scratch);
                    if best.is_some() {
                        among.push(item);
                    }
                };
                self.finder().unbounded.iter().for_each(|&item| take(item));
                self.finder().tree.any_in(
                    lanes,
                    &query.ray,
                    (0.0, query.far),
                    #[inline(always)]
                    |number| {
                        take(self.finder().bounded[number as usize]);
                        false
                    },
                );
            },
        );
        scratch.among = among;
    }

    /// The nearest visible surface on a part of the ray that was last given to [`World::gather`].
    #[must_use]
    pub fn nearest_among(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.filtered += 1;
        let among = std::mem::take(&mut scratch.among);
        let mut best: Option<Best> = None;
        let mut far = query.far;
        let search = self.search_for(query);
        with_widest(
            #[inline(always)]
            |_| {
                for &item in &among {
                    far = self.try_item(item, (query, &search), far, &mut best, scratch);
                }
            },
        );
        scratch.among = among;
        best.map(|best| self.hit(&query.ray, &best.found))
    }
}
