//! The tree over the items of a model, and their leaves in its order: what lies together in space lies together in
//! memory.

use super::cluster::Cluster;
use super::csg::Program;
use super::instance::Instance;
use super::leaf::Leaf;
use super::model::{Item, Parts};
use crate::accel::Bvh;
use glam::DVec3;
use rayon::prelude::*;

/// An item with its number, which is its place in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbered {
    pub(super) number: u32,
    pub(super) item: Item,
}

/// How the items of a model are found.
#[derive(Debug)]
pub(super) struct Finder {
    /// Over `bounded`.
    pub(super) tree: Bvh,
    /// In the order of the tree.
    pub(super) bounded: Vec<Numbered>,
    /// Those that no box holds.
    pub(super) unbounded: Vec<Numbered>,
}

impl Finder {
    /// Builds the tree and brings what `parts` holds into its order; `projectors` follow their leaves.
    pub(super) fn new<'p>(
        parts: &mut Parts,
        projectors: impl Iterator<Item = &'p mut Program>,
    ) -> Self {
        let numbers = 0u32..;
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) = numbers
            .take(parts.items.len())
            .partition(|&number| parts.bounds[number as usize].is_finite());
        let leaf = |place: usize| match parts.items[bounded[place] as usize] {
            Item::Leaf(leaf) => Some(&parts.leaves[leaf as usize]),
            Item::Program(_) | Item::Instance(_) => None,
        };
        let bounds = |place: usize| {
            let bounds = &parts.bounds[bounded[place] as usize];
            leaf(place).map_or(*bounds, |leaf| leaf.tightened(bounds))
        };
        let (mut tree, order) = Bvh::build_in_order(bounded.len(), bounds);
        // In large scenes the room is needed.
        parts.bounds = Vec::new();
        let bounded: Vec<u32> = order
            .into_iter()
            .map(|place| bounded[place as usize])
            .collect();
        sort_leaves(parts, projectors, unbounded.iter().chain(&bounded));
        let numbered = |&number: &u32| Numbered {
            number,
            item: parts.items[number as usize],
        };
        let bounded: Vec<Numbered> = bounded.iter().map(numbered).collect();
        let (leaves, programs) = (&parts.leaves, &parts.programs);
        tree.know_balls(bounded.len(), |place| match bounded[place].item {
            Item::Leaf(leaf) => leaves[leaf as usize].ball_around(),
            Item::Program(program) => programs[program as usize].ball_around(leaves),
            Item::Instance(_) => None,
        });
        Finder {
            tree,
            bounded,
            unbounded: unbounded.iter().map(numbered).collect(),
        }
    }

    /// All items together, if they are few and round.
    pub(super) fn cluster(&self, parts: &Parts) -> Option<Cluster> {
        if !self.unbounded.is_empty() || parts.leaves.len() != self.bounded.len() {
            return None;
        }
        Cluster::new(self.bounded.len(), |place| match self.bounded[place].item {
            Item::Leaf(leaf) => {
                let leaf = &parts.leaves[leaf as usize];
                leaf.ball().filter(|_| leaf.shape.has_roots_of_four())
            }
            Item::Program(_) | Item::Instance(_) => None,
        })
    }

    /// The items that may hold a point.
    pub(super) fn around(&self, point: DVec3) -> Vec<Numbered> {
        let mut items = self.unbounded.clone();
        self.tree.around(point, |place| {
            items.push(self.bounded[place as usize]);
            false
        });
        items
    }
}

/// Moves leaves, combinations and instances to the order of their items.
fn sort_leaves<'n, 'p>(
    parts: &mut Parts,
    projectors: impl Iterator<Item = &'p mut Program>,
    order: impl Iterator<Item = &'n u32>,
) {
    let mut places = vec![u32::MAX; parts.leaves.len()];
    let mut next = 0;
    let mut place_range = |first: u32, count: u32| {
        for place in &mut places[first as usize..][..count as usize] {
            *place = next;
            next += 1;
        }
    };
    let mut programs = Vec::with_capacity(parts.programs.len());
    let mut instances = Vec::with_capacity(parts.instances.len());
    let mut unsorted: Vec<Option<Instance>> = parts.instances.drain(..).map(Some).collect();
    for &number in order {
        match &mut parts.items[number as usize] {
            Item::Leaf(leaf) => place_range(*leaf, 1),
            Item::Program(at) => {
                let program = std::mem::take(&mut parts.programs[*at as usize]);
                place_range(program.first, program.len());
                *at = u32::try_from(programs.len()).expect("no more than before");
                programs.push(program);
            }
            Item::Instance(at) => {
                let instance = unsorted[*at as usize].take();
                *at = u32::try_from(instances.len()).expect("no more than before");
                instances.extend(instance);
            }
        }
    }
    // Behind them the leaves of what bounds combinations, and of what lights are projected through.
    for place in &mut places {
        if *place == u32::MAX {
            *place = next;
            next += 1;
        }
    }
    parts.programs = programs;
    for instance in &mut instances {
        instance.first = next;
        next += instance.model.len();
    }
    parts.instances = instances;
    let programs = parts.programs.par_iter_mut();
    programs.for_each(|program| program.move_leaves(&places));
    projectors.for_each(|program| program.move_leaves(&places));
    for item in &mut parts.items {
        if let Item::Leaf(leaf) = item {
            *leaf = places[*leaf as usize];
        }
    }
    let mut leaves_at = vec![0; places.len()];
    for (leaf, &place) in (0..).zip(&places) {
        leaves_at[place as usize] = leaf;
    }
    drop(places);
    let mut unsorted = std::mem::take(&mut parts.leaves);
    // Where all are no more than numbers several threads fetch them: each comes from somewhere else.
    parts.leaves = if unsorted.iter().all(|leaf| leaf.ball().is_some()) {
        let fetch = |&leaf: &u32| unsorted[leaf as usize].clone();
        leaves_at.par_iter().map(fetch).collect()
    } else {
        let take = |&leaf: &u32| std::mem::replace(&mut unsorted[leaf as usize], Leaf::NOTHING);
        leaves_at.iter().map(take).collect()
    };
}
