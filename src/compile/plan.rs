//! The plan: what a scene needs of all that a tracer can do. What it does not need is left out once, when the world is
//! made, not asked about at every ray.

use super::flatten::Item;
use super::world::World;
use std::collections::BTreeMap;
use std::fmt;

/// What a scene needs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// How many primitives there are of each kind, those of combinations included.
    pub primitives: BTreeMap<&'static str, usize>,
    /// How many combinations there are.
    pub combinations: usize,
    /// Objects that no box holds; every ray tries them.
    pub unbounded: usize,
    /// Primitives that stand behind a matrix; the others are in the world's own coordinates.
    pub behind_matrix: usize,
    /// The looks that are told apart.
    pub surfaces: usize,
    /// The lights.
    pub lights: usize,
    /// The memory of the tree in bytes.
    pub tree_bytes: usize,
    /// What no ray needs.
    pub left_out: Vec<&'static str>,
}

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

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds: Vec<String> = self
            .primitives
            .iter()
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        writeln!(
            f,
            "primitives  {} ({} behind a matrix), in {} combinations; {} unbounded",
            kinds.join(", "),
            self.behind_matrix,
            self.combinations,
            self.unbounded
        )?;
        writeln!(
            f,
            "looks       {}, lights {}, tree {} bytes",
            self.surfaces, self.lights, self.tree_bytes
        )?;
        writeln!(f, "left out    {}", self.left_out.join(", "))
    }
}
