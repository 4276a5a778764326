//! The plan: what a scene needs of all that a tracer can do. What it does not need is left out once, when the world is
//! made, not asked about at every ray.

use super::flatten::Item;
use super::world::World;
use crate::options::Plan;
use std::collections::BTreeMap;

impl World {
    /// What this scene needs and what it was spared.
    #[must_use]
    pub fn plan(&self) -> Plan {
        let mut primitives: BTreeMap<&'static str, usize> = BTreeMap::new();
        for leaf in self.leaves() {
            *primitives.entry(leaf.shape.word().spelling()).or_default() += 1;
        }
        let items = self.items();
        let combinations = items
            .iter()
            .filter(|item| matches!(item, Item::Program(_)))
            .count();
        let finder = self.finder();
        let behind_matrix = self
            .leaves()
            .iter()
            .filter(|leaf| leaf.object_from_world.is_some())
            .count();
        Plan {
            combinations,
            unbounded: finder.unbounded.len(),
            behind_matrix,
            surfaces: self.surfaces.len(),
            lights: self.lights.len(),
            tree_bytes: finder.tree.bytes(),
            left_out: self.left_out(combinations, &primitives),
            primitives,
        }
    }

    fn left_out(
        &self,
        combinations: usize,
        primitives: &BTreeMap<&'static str, usize>,
    ) -> Vec<&'static str> {
        let layers = || {
            let textures = self.surfaces.iter().flat_map(|surface| {
                let inside = surface.inside_texture.iter();
                std::iter::once(&surface.texture)
                    .chain(inside)
                    .chain(&surface.skins)
            });
            textures.flat_map(|texture| texture.layers())
        };
        let has = |some: bool, what: &'static str| (!some).then_some(what);
        let mirrors = layers().any(|layer| layer.finish.has_reflection());
        let areas = (0..).take(self.lights.len());
        let areas = areas.filter(|&light| self.lights.get(light).area.is_some());
        [
            has(combinations > 0, "combinations"),
            has(!self.is_opaque(), "transparency"),
            has(mirrors, "mirror images"),
            has(self.hides_some(), "objects hidden from some rays"),
            has(areas.count() > 0, "area lights"),
            has(!self.fogs.is_empty(), "fog"),
            has(self.sky.is_some(), "a sky"),
            has(self.lens.is_some(), "a lens"),
            has(
                primitives.keys().any(|&kind| kind != "sphere"),
                "all shapes but spheres",
            ),
            has(!self.finder().bounded.is_empty(), "the tree"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}
