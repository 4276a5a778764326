//! The plan: the features of the tracer that a scene needs. The others are disabled once, when the world is built, and
//! not checked for every ray.

use super::compiled::World;
use super::model::Instance;
use super::model::Model;
use super::primitive::Leaf;
use super::surface::Surface;
use crate::base::accel::Bvh;
use crate::base::options::Plan;
use crate::scene::texture::PreparedTexture;
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;

impl World {
    /// The features that this scene needs, and those it does not.
    #[must_use]
    pub fn plan(&self) -> Plan {
        let mut primitives: BTreeMap<&'static str, usize> = BTreeMap::new();
        let models = self.models();
        let mut behind_matrix = 0;
        // There may be millions, most of them like their neighbours.
        let are_alike = |a: &Leaf, b: &Leaf| a.shape.word() == b.shape.word();
        for alike in models
            .iter()
            .flat_map(|model| model.leaves.chunk_by(are_alike))
        {
            let word = alike[0].shape.word();
            *primitives.entry(word.spelling()).or_default() += alike.len();
            let is_behind = |leaf: &&Leaf| leaf.object_from_world.is_some();
            behind_matrix += alike.iter().filter(is_behind).count();
        }
        let combinations = models.iter().map(|model| model.programs.len()).sum();
        let trees = models.iter().map(|model| &model.bvh.tree);
        Plan {
            combinations,
            shared: models.len() - 1,
            instances: models.iter().map(|model| model.instances.len()).sum(),
            instance_bytes: size_of::<Instance>(),
            unbounded: self.bvh().unbounded.len(),
            behind_matrix,
            surfaces: self.surfaces.len(),
            lights: self.lights.len(),
            tree_bytes: trees.map(Bvh::bytes).sum(),
            view_bytes: self.light_buffers.bytes(),
            left_out: self.left_out(combinations, &primitives),
            primitives,
        }
    }

    /// The model of the world and those of all instances, each once.
    fn models(&self) -> Vec<&Model> {
        let mut models = vec![&self.model];
        let mut known = FxHashSet::default();
        let mut at = 0;
        while let Some(&model) = models.get(at) {
            let inner = model.instances.iter().map(|instance| &*instance.model);
            let fresh = inner.filter(|&model| known.insert(std::ptr::from_ref(model)));
            let fresh: Vec<_> = fresh.collect();
            models.extend(fresh);
            at += 1;
        }
        models
    }

    fn left_out(
        &self,
        combinations: usize,
        primitives: &BTreeMap<&'static str, usize>,
    ) -> Vec<&'static str> {
        let mut textures = self.surfaces.iter().flat_map(Surface::textures);
        let has = |some: bool, what: &'static str| (!some).then_some(what);
        let mirrors = textures.any(PreparedTexture::has_reflection);
        let areas = (0..).take(self.lights.len());
        let areas = areas.filter(|&light| self.lights.get(light).area.is_some());
        [
            has(combinations > 0, "CSG objects"),
            has(!self.model.instances.is_empty(), "shared unions"),
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
            has(!self.bvh().bounded.is_empty(), "the tree"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}
