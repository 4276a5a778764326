//! Other textures for shapes of a compiled world, which stays as it is otherwise.

use super::lowering::Lowering;
use crate::scene::pattern::Settings;
use crate::scene::restyled::Restyled;
use crate::world::compiled::World;
use crate::world::index::index;
use crate::world::model::Item;
use crate::world::surface::Surface;
use rustc_hash::FxHashMap;

/// The most surfaces without a shape, beside twice as many as there are shapes: then the scene is compiled again.
const MOST_LEFT: usize = 1024;

/// Primitives that have got other textures.
#[derive(Debug, Default)]
pub(crate) struct NewTextures {
    /// Their indices, ascending.
    pub(crate) leaves: Vec<u32>,
    /// True if all were opaque and still are, so that shadows stay.
    pub(crate) are_opaque: bool,
}

impl World {
    /// Gives shapes their new textures, if the whole scene would be compiled to the same world with these in place of their
    /// surfaces; otherwise returns `None` and changes nothing. `first_items` are the indices of the first items of all
    /// objects, `settings` the scene-wide settings of patterns.
    pub(crate) fn restyle(
        &mut self,
        restyled: &[Restyled],
        first_items: &[u32],
        settings: &Settings,
    ) -> Option<NewTextures> {
        // Surfaces that are shared or instanced stay when shapes leave them.
        let is_worn = self.surfaces.len() > 2 * self.model.leaves.len() + MOST_LEFT;
        if self.photons.is_some() || is_worn {
            return None;
        }
        let leaves = self.leaves_of_items(restyled, first_items)?;
        let mut surfaces = Vec::with_capacity(restyled.len());
        let mut are_opaque = true;
        for (one, &leaf) in restyled.iter().zip(&leaves) {
            let old = &self.surfaces[self.model.leaves[leaf as usize].surface as usize];
            let mut new = lone_surface(one, settings)?;
            if !new.replaces(old) {
                return None;
            }
            are_opaque &= new.is_opaque();
            surfaces.push(new);
        }
        let mut users = vec![0_u32; self.surfaces.len()];
        for leaf in &self.model.leaves {
            users[leaf.surface as usize] += 1;
        }
        for (&leaf, surface) in leaves.iter().zip(surfaces) {
            self.set_surface(leaf, surface, &mut users);
        }
        let mut leaves = leaves;
        leaves.sort_unstable();
        Some(NewTextures { leaves, are_opaque })
    }

    /// The primitive of each shape.
    fn leaves_of_items(&self, restyled: &[Restyled], first_items: &[u32]) -> Option<Vec<u32>> {
        let mut numbers = FxHashMap::default();
        for (number, one) in restyled.iter().enumerate() {
            let [first, end] = *first_items.get(one.index..one.index + 2)? else {
                return None;
            };
            // Of objects with other items than their shapes, each item is unknown.
            if end - first != one.shapes {
                return None;
            }
            numbers.insert(first + one.before, number);
        }
        let mut leaves = vec![u32::MAX; restyled.len()];
        let mut left = numbers.len();
        for item in self.bvh().bounded.iter().chain(&self.bvh().unbounded) {
            if left == 0 {
                break;
            }
            if let Some(&number) = numbers.get(&item.number) {
                let Item::Leaf(leaf) = item.item else {
                    return None;
                };
                leaves[number] = leaf;
                left -= 1;
            }
        }
        (left == 0 && numbers.len() == restyled.len()).then_some(leaves)
    }

    /// Gives a primitive a surface, in place of its own if no other one has that; `users` are the numbers of primitives
    /// with each surface.
    fn set_surface(&mut self, leaf: u32, surface: Surface, users: &mut Vec<u32>) {
        let old = self.model.leaves[leaf as usize].surface;
        let is_shared = users[old as usize] > 1 || !self.model.instances.is_empty();
        let number = match is_shared {
            true => index(self.surfaces.len()),
            false => old,
        };
        self.summary.put(number as usize, &surface);
        match is_shared {
            true => {
                users[old as usize] -= 1;
                users.push(1);
                self.surfaces.push(surface);
            }
            false => self.surfaces[number as usize] = surface,
        }
        self.model.leaves[leaf as usize].surface = number;
    }
}

/// The surface of a shape that is lowered alone.
fn lone_surface(restyled: &Restyled, settings: &Settings) -> Option<Surface> {
    let mut lowering = Lowering::new(*settings);
    lowering.add(&restyled.object);
    let is_one = lowering.parts.leaves.len() == 1 && lowering.surfaces.len() == 1;
    lowering.surfaces.pop().filter(|_| is_one)
}
