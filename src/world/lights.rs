//! The lights of a world: which of them shine on a surface, and what they are projected through.

use super::csg::program::{CsgProgram, RawHit};
use super::primitive::Leaf;
use super::query::{Query, Scratch};
use crate::scene::light::Light;

/// Which lights shine on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LightList(u32);

impl LightList {
    /// Those on what lies outside of all groups.
    pub const OUTSIDE: LightList = LightList(0);
}

/// What a `light_group`, or what lies outside of all groups, is lit by.
#[derive(Debug)]
struct Listed {
    has_global: bool,
    own: Vec<u32>,
}

/// The lights of a scene with what they shine on.
#[derive(Debug)]
pub struct Lights {
    lights: Vec<Light>,
    /// The lights outside of all groups.
    global: Vec<u32>,
    listed: Vec<Listed>,
    /// For each list, the numbers of its lights.
    lists: Vec<Box<[u32]>>,
    /// For each light, whether it is on all lists.
    is_global: Vec<bool>,
    /// What lights are projected through, by the numbers of the lights.
    projectors: Vec<(u32, CsgProgram)>,
}

impl Default for Lights {
    fn default() -> Self {
        Lights {
            lights: Vec::new(),
            global: Vec::new(),
            listed: vec![Listed {
                has_global: true,
                own: Vec::new(),
            }],
            lists: Vec::new(),
            is_global: Vec::new(),
            projectors: Vec::new(),
        }
    }
}

impl Lights {
    /// A new list for a group.
    pub(super) fn group(&mut self, has_global: bool) -> LightList {
        self.listed.push(Listed {
            has_global,
            own: Vec::new(),
        });
        LightList(number(self.listed.len() - 1))
    }

    /// Takes in a light, of a group or of all, and gives its number.
    pub(super) fn add(&mut self, light: Light, group: Option<LightList>) -> u32 {
        let light_number = number(self.lights.len());
        self.lights.push(light);
        match group {
            Some(group) => self.listed[group.0 as usize].own.push(light_number),
            None => self.global.push(light_number),
        }
        light_number
    }

    /// What lights are projected through.
    pub(super) fn projectors_mut(&mut self) -> impl Iterator<Item = &mut CsgProgram> {
        self.projectors.iter_mut().map(|(_, program)| program)
    }

    /// Says what a light is projected through.
    pub(super) fn project(&mut self, light: u32, program: CsgProgram) {
        self.projectors.push((light, program));
    }

    /// Makes the lists, when all lights are known.
    pub(super) fn finish(&mut self) {
        let list = |listed: &Listed| {
            let global = self.global.iter().filter(|_| listed.has_global);
            global.chain(&listed.own).copied().collect()
        };
        self.lists = self.listed.iter().map(list).collect();
        let is_on_all = |number| self.lists.iter().all(|list| list.contains(&number));
        self.is_global = (0u32..).take(self.lights.len()).map(is_on_all).collect();
    }

    /// The numbers of the lights in a list.
    #[must_use]
    pub fn of(&self, list: LightList) -> &[u32] {
        &self.lists[list.0 as usize]
    }

    /// The numbers of those in a list that belong to no group.
    #[must_use]
    pub fn outside_groups(&self, list: LightList) -> &[u32] {
        let all = self.of(list);
        &all[..all.len() - self.listed[list.0 as usize].own.len()]
    }

    /// Whether the light of this number belongs to no group.
    #[must_use]
    pub fn is_outside_groups(&self, number: u32) -> bool {
        self.global.contains(&number)
    }

    /// Whether the light of this number shines on all surfaces.
    #[must_use]
    #[inline(always)]
    pub fn shines_on_all(&self, number: u32) -> bool {
        self.is_global[number as usize]
    }

    /// The light of a number.
    #[must_use]
    pub fn get(&self, number: u32) -> &Light {
        &self.lights[number as usize]
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.lights.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// All of them, in the order of the scene.
    pub fn iter(&self) -> impl Iterator<Item = &Light> {
        self.lights.iter()
    }

    /// Whether a light shines only through some object.
    #[must_use]
    pub fn is_projected(&self, light: u32) -> bool {
        self.projector(light).is_some()
    }

    fn projector(&self, light: u32) -> Option<&CsgProgram> {
        let mut projectors = self.projectors.iter();
        projectors
            .find(|(projected, _)| *projected == light)
            .map(|(_, program)| program)
    }

    /// How far things cast shadows on a ray to a light: up to what it is projected through, where that is farther than
    /// `least` and wanted. `None` where the ray misses that, and so the light.
    pub(super) fn reach(
        &self,
        light: u32,
        leaves: &[Leaf],
        (query, least): (&Query, f64),
        wanted: impl FnMut(&RawHit) -> bool,
        scratch: &mut Scratch,
    ) -> Option<f64> {
        let Some(program) = self.projector(light) else {
            return Some(query.t_max);
        };
        let span = (least, query.t_max);
        let (from, sweep) = (query.origin_surface.as_ref(), &mut scratch.sweep);
        program
            .nearest(leaves, &query.ray, span, from, sweep, wanted)
            .map(|found| found.root.t)
    }
}

fn number(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}
