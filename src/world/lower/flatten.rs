//! From the objects of a scene to leaves, combinations and lights: transforms folded, unions taken apart, texture and
//! interior handed down to the children that have none of their own.

use super::csg::is_gated;
use super::inherit::Inherited;
use super::instancing::{SharedModel, SlotTable};
use super::targets::Targets;
use crate::base::math::{Bounds, Step};
use crate::scene::light::Light;
use crate::scene::pattern::Settings;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::texture::{PreparedTexture, Texture};
use crate::scene::{Kind, Look, Object, Plain, Taken};
use crate::world::csg::memo::CsgMemo;
use crate::world::interiors::Interiors;
use crate::world::lights::Lights;
use crate::world::model::{ModelBuilder, PendingItem};
use crate::world::primitive::{Absorb, Extent, Leaf};
use crate::world::surface::Surface;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// Everything the objects of a scene come to.
#[derive(Debug, Default)]
pub(crate) struct Lowering {
    /// What the model at hand is made from: the world, or what copies share.
    pub(crate) parts: ModelBuilder,
    /// The looks in the model at hand, unless that is the world.
    pub(crate) slots: Option<SlotTable>,
    /// What copies share, by the address of their list of parts, and by whether they may ask for texture coordinates.
    pub(crate) shared: FxHashMap<(usize, bool), Box<SharedModel>>,
    /// How many copies each list of parts had when the first was met, by its address.
    pub(crate) copies: FxHashMap<usize, usize>,
    /// Whether the model at hand is one for copies that may ask for texture coordinates.
    pub(crate) keeps_uv: bool,
    /// Whether what is asked for is the insides of objects, which may be larger than their surfaces.
    pub(crate) asks_insides: bool,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) interiors: Interiors,
    /// What patterns take from the whole scene.
    pub(crate) settings: Settings,
    pub(crate) lights: Lights,
    /// What photons are sent to, where they are shot.
    pub(crate) targets: Option<Targets>,
    /// By address, which stays taken as long as the texture is kept.
    pub(crate) prepared: FxHashMap<usize, (Arc<Texture>, Arc<PreparedTexture>)>,
    /// Which of them the last object of the top level has brought, and its first surface.
    pub(crate) lately_prepared: Vec<usize>,
    first_surface: usize,
    /// What objects without a texture look like.
    pub(crate) plain: Option<Arc<PreparedTexture>>,
    pub(crate) last_surface: Option<u32>,
    /// A surface by its number, with the looks that it came of.
    pub(crate) last_looks: Option<(u32, Inherited)>,
    /// The last combination that was made ready.
    pub(crate) ready: Option<Box<CsgMemo>>,
    /// Bounding objects of the combination being built, with the operands they bound and where they stand.
    pub(crate) gates: Vec<(Range<u32>, Arc<Object>, Inherited)>,
    /// Parts of it that have boxes of their own: their operands, and boxes around what is inside of them and what shows.
    pub(crate) boxed: Vec<(Range<u32>, Bounds)>,
    /// Bounds of the operands of the combination being built.
    pub(crate) operand_bounds: Vec<Bounds>,
    /// What the lights of the object being taken in hold.
    held: Vec<(Holds, Arc<Object>, Inherited)>,
}

/// Why a light holds an object.
#[derive(Debug)]
enum Holds {
    /// To look like it.
    Look,
    /// To be projected through it: the light of this number.
    Projector(u32),
}

impl Lowering {
    /// Nothing yet; `settings` are what patterns take from the whole scene.
    pub(crate) fn new(settings: Settings) -> Self {
        Lowering {
            settings,
            ..Lowering::default()
        }
    }

    /// Takes in one object of the scene's top level; what is left of it is needed no more.
    pub(crate) fn take(&mut self, object: Taken) -> Option<Arc<Object>> {
        match object {
            Taken::Colored(shape, color, finish) => {
                let look = Look::Color(color, finish);
                self.add(&Plain { shape, look }.into());
                None
            }
            Taken::Object(object) => {
                self.add(&object);
                self.forget_textures(&object);
                Some(object)
            }
        }
    }

    /// Lets go of prepared textures that nothing but this object of the top level asks for. Those of one surface become
    /// its own.
    fn forget_textures(&mut self, object: &Object) {
        // These have its texture too.
        self.last_looks = None;
        let is_copy =
            matches!(&object.kind, Kind::Csg { children, .. } if Arc::strong_count(children) > 1);
        for texture in self.lately_prepared.drain(..) {
            let known = self.prepared.get(&texture);
            // Here and in the object.
            if !is_copy && known.is_some_and(|(texture, _)| Arc::strong_count(texture) <= 2) {
                self.prepared.remove(&texture);
            }
        }
        let lately = &mut self.surfaces[self.first_surface..];
        lately.iter_mut().for_each(Surface::take_texture);
        self.first_surface = self.surfaces.len();
    }

    /// Takes in one object of the scene's top level.
    pub(crate) fn add(&mut self, object: &Object) {
        let nothing = Inherited::default();
        self.add_below(object, &nothing);
        while let Some((holds, object, around)) = self.held.pop() {
            match holds {
                Holds::Look => self.add_below(&object, &around),
                Holds::Projector(light) => {
                    let (program, _) = self.program(&object, &around);
                    self.lights.project(light, program);
                }
            }
        }
    }

    pub(crate) fn add_below(&mut self, object: &Object, above: &Inherited) {
        let targets = self.targets.as_ref().map_or(0, Targets::len);
        let below = self.heritage(object, above);
        if let Some(children) = object.plain_union() {
            if !self.add_copy(object, &below) {
                for child in &**children {
                    self.add_below(child, &below);
                }
            }
            return;
        }
        let is_bare = object.clipped_by().is_empty() && !is_gated(object) && !object.is_inverse;
        match &object.kind {
            Kind::Light { .. } => {
                let look = self.add_light(&object.kind, above, below);
                let held = look.map(|(object, around)| (Holds::Look, object, around));
                self.held.extend(held);
            }
            Kind::Shape(shape) if is_bare => self.add_shape(shape, &below),
            _ => {
                // The program hands everything down once more.
                if let Some(known) = &mut self.targets {
                    known.truncate(targets);
                }
                self.add_program(object, above);
            }
        }
    }

    fn add_shape(&mut self, shape: &Shape, below: &Inherited) {
        let (surface, absorb) = self.surface_of(shape, below);
        self.add_leaf(shape.clone(), (&below.steps, absorb), surface);
    }

    fn add_leaf(&mut self, shape: Shape, place: (&[Step], Absorb), surface: u32) {
        let (leaf, mut bounds) = Leaf::new(shape, place, surface, Extent::Surface);
        if bounds.is_empty() {
            return;
        }
        // The inside of a disc is a half-space, far beyond its surface.
        if self.asks_insides && !leaf.shape.solid_bounds().is_finite() {
            bounds = Bounds::EVERYTHING;
        }
        let number = index(self.parts.leaves.len());
        self.parts.push(PendingItem::Leaf(number), bounds);
        self.parts.leaves.push(leaf);
    }

    /// Takes in a light and gives what it looks like; what it is projected through waits until the object around it is
    /// complete.
    pub(crate) fn add_light(
        &mut self,
        light: &Kind,
        above: &Inherited,
        below: Inherited,
    ) -> Option<(Arc<Object>, Inherited)> {
        let Kind::Light {
            light,
            looks_like,
            projected_through,
        } = light
        else {
            return None;
        };
        let light = self.lights.add(placed(light, &below.steps), above.group);
        if let Some(object) = projected_through {
            let holds = Holds::Projector(light);
            self.held.push((holds, Arc::clone(object), below.clone()));
        }
        looks_like
            .as_ref()
            .map(|object| (Arc::clone(object), below))
    }
}

/// A light where the steps move it.
fn placed(light: &Light, steps: &[Step]) -> Light {
    let mut light = light.clone();
    steps.iter().for_each(|step| light.transform(step));
    light
}

pub(crate) fn index(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}
