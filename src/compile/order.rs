//! The tree over the items of a world, and their leaves in its order: what lies together in space lies together in
//! memory.

use super::flatten::{Flat, Item};
use crate::accel::Bvh;

/// An item with its number, which is its place in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbered {
    pub(super) number: u32,
    pub(super) item: Item,
}

/// How the items of a world are found.
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
    /// Builds the tree and brings the leaves of `flat` into its order.
    pub(super) fn new(flat: &mut Flat) -> Self {
        let numbers = 0u32..;
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) = numbers
            .take(flat.items.len())
            .partition(|&number| flat.bounds[number as usize].is_finite());
        let boxes: Vec<_> = bounded
            .iter()
            .map(|&number| flat.bounds[number as usize])
            .collect();
        let radius = |place: usize| match flat.items[bounded[place] as usize] {
            Item::Leaf(leaf) => flat.leaves[leaf as usize].ball_radius(),
            Item::Program(_) => None,
        };
        let (tree, order) = Bvh::build_in_order(&boxes, radius);
        drop(boxes);
        let bounded: Vec<u32> = order
            .into_iter()
            .map(|place| bounded[place as usize])
            .collect();
        sort_leaves(flat, unbounded.iter().chain(&bounded));
        let numbered = |&number: &u32| Numbered {
            number,
            item: flat.items[number as usize],
        };
        Finder {
            tree,
            bounded: bounded.iter().map(numbered).collect(),
            unbounded: unbounded.iter().map(numbered).collect(),
        }
    }
}

/// Moves leaves and combinations to the order of their items.
fn sort_leaves<'n>(flat: &mut Flat, order: impl Iterator<Item = &'n u32>) {
    let mut places = vec![u32::MAX; flat.leaves.len()];
    let mut next = 0;
    let mut place_range = |first: u32, count: u32| {
        for place in &mut places[first as usize..][..count as usize] {
            *place = next;
            next += 1;
        }
    };
    let mut programs = Vec::with_capacity(flat.programs.len());
    for &number in order {
        match &mut flat.items[number as usize] {
            Item::Leaf(leaf) => place_range(*leaf, 1),
            Item::Program(at) => {
                let program = std::mem::take(&mut flat.programs[*at as usize]);
                place_range(program.first, program.len());
                *at = u32::try_from(programs.len()).expect("no more than before");
                programs.push(program);
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
    flat.programs = programs;
    let projectors = flat.lights.projectors_mut();
    for program in flat.programs.iter_mut().chain(projectors) {
        program.move_leaves(&places);
    }
    for item in &mut flat.items {
        if let Item::Leaf(leaf) = item {
            *leaf = places[*leaf as usize];
        }
    }
    for at in 0..places.len() {
        while places[at] as usize != at {
            let to = places[at] as usize;
            flat.leaves.swap(at, to);
            places.swap(at, to);
        }
    }
}
