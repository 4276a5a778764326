//! The lights of a world: light groups, and the objects that lights are projected through.

use super::csg::program::CsgProgram;
use crate::scene::light::Light;

/// Identifies the set of lights that shine on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LightList(u32);

impl LightList {
    /// The lights on objects outside all groups.
    pub const OUTSIDE: LightList = LightList(0);
}

/// The lights of a `light_group`, or of the objects outside all groups.
#[derive(Debug)]
struct Listed {
    has_global: bool,
    own: Vec<u32>,
}

/// The lights of a scene and their groups.
#[derive(Debug)]
pub struct Lights {
    lights: Vec<Light>,
    /// The lights outside all groups.
    global: Vec<u32>,
    listed: Vec<Listed>,
    /// For each list, the indices of its lights.
    lists: Vec<Box<[u32]>>,
    /// For each light, true if it is on all lists.
    is_global: Vec<bool>,
    /// The objects that lights are projected through, with the index of the light.
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

    /// Adds a light to a group, or to the lights outside all groups, and returns its index.
    pub(super) fn add(&mut self, light: Light, group: Option<LightList>) -> u32 {
        let light_number = number(self.lights.len());
        self.lights.push(light);
        match group {
            Some(group) => self.listed[group.0 as usize].own.push(light_number),
            None => self.global.push(light_number),
        }
        light_number
    }

    /// The objects that lights are projected through.
    pub(super) fn projectors_mut(&mut self) -> impl Iterator<Item = &mut CsgProgram> {
        self.projectors.iter_mut().map(|(_, program)| program)
    }

    /// Sets the object that a light is projected through.
    pub(super) fn project(&mut self, light: u32, program: CsgProgram) {
        self.projectors.push((light, program));
    }

    /// Builds the lists once all lights are known.
    pub(super) fn finish(&mut self) {
        let list = |listed: &Listed| {
            let global = self.global.iter().filter(|_| listed.has_global);
            global.chain(&listed.own).copied().collect()
        };
        self.lists = self.listed.iter().map(list).collect();
        let is_on_all = |number| self.lists.iter().all(|list| list.contains(&number));
        self.is_global = (0u32..).take(self.lights.len()).map(is_on_all).collect();
    }

    /// The indices of the lights on a list.
    #[must_use]
    pub fn of(&self, list: LightList) -> &[u32] {
        &self.lists[list.0 as usize]
    }

    /// Returns true if the light belongs to no group.
    #[must_use]
    pub fn is_outside_groups(&self, number: u32) -> bool {
        self.global.contains(&number)
    }

    /// Returns true if the light shines on all surfaces.
    #[must_use]
    #[inline(always)]
    pub fn shines_on_all(&self, number: u32) -> bool {
        self.is_global[number as usize]
    }

    /// The light with this index.
    #[must_use]
    pub fn get(&self, number: u32) -> &Light {
        &self.lights[number as usize]
    }

    /// Number of lights.
    #[must_use]
    pub fn len(&self) -> usize {
        self.lights.len()
    }

    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// All lights, in file order.
    pub fn iter(&self) -> impl Iterator<Item = &Light> {
        self.lights.iter()
    }

    /// Returns true if a light is projected through an object.
    #[must_use]
    pub fn is_projected(&self, light: u32) -> bool {
        self.projector(light).is_some()
    }

    /// The object that a light is projected through.
    pub(super) fn projector(&self, light: u32) -> Option<&CsgProgram> {
        let mut projectors = self.projectors.iter();
        projectors
            .find(|(projected, _)| *projected == light)
            .map(|(_, program)| program)
    }
}

fn number(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}
