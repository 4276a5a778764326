//! Lowering of the objects of a scene to leaves, CSG programs and lights: transforms are folded, unions split up, and
//! texture and interior handed down to children without their own.

use super::csg::is_gated;
use super::inherit::Inherited;
use super::instancing::{SharedModel, SlotTable};
use super::model::{ModelBuilder, PendingItem};
use super::targets::Targets;
use crate::base::math::{Bounds, Step};
use crate::scene::light::Light;
use crate::scene::pattern::Settings;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::texture::{PreparedTexture, Texture};
use crate::scene::{Kind, Look, Object, Plain, Taken};
use crate::world::csg::memo::CsgMemo;
use crate::world::index::index;
use crate::world::interiors::Interiors;
use crate::world::lights::Lights;
use crate::world::primitive::{Absorb, Extent, Leaf};
use crate::world::surface::Surface;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// State and results of lowering.
#[derive(Debug, Default)]
pub(crate) struct Lowering {
    /// The parts of the current model: the world, or a shared union.
    pub(crate) parts: ModelBuilder,
    /// The material slots of the current model, unless it is the world.
    pub(crate) slots: Option<SlotTable>,
    /// The shared models, by the address of their list of children, and by whether they may need texture coordinates.
    pub(crate) shared: FxHashMap<(usize, bool), Box<SharedModel>>,
    /// For each list of children, by its address, the number of copies when the first was lowered.
    pub(crate) copies: FxHashMap<usize, usize>,
    /// True if the current model is one for copies that may need texture coordinates.
    pub(crate) keeps_uv: bool,
    /// True if the insides of objects are needed, which may be larger than their surfaces.
    pub(crate) needs_insides: bool,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) interiors: Interiors,
    /// Scene-wide settings for patterns.
    pub(crate) settings: Settings,
    pub(crate) lights: Lights,
    /// Photon targets, if photons are on.
    pub(crate) targets: Option<Targets>,
    /// Prepared textures by address; the entry owns the texture, so that the address stays taken.
    pub(crate) prepared: FxHashMap<usize, (Arc<Texture>, Arc<PreparedTexture>)>,
    /// The entries added by the current top-level object.
    pub(crate) lately_prepared: Vec<usize>,
    first_surface: usize,
    /// The default texture of objects.
    pub(crate) plain: Option<Arc<PreparedTexture>>,
    pub(crate) last_surface: Option<u32>,
    /// A surface index and the attributes it was made from.
    pub(crate) last_attributes: Option<(u32, Inherited)>,
    /// Memo of the last CSG preparation.
    pub(crate) memo: Option<Box<CsgMemo>>,
    /// Bounding objects of the current CSG program, with the operands they bound and the inherited state.
    pub(crate) gates: Vec<(Range<u32>, Arc<Object>, Inherited)>,
    /// Parts of it with boxes of their own: their operands, and boxes around their insides and visible surfaces.
    pub(crate) boxed: Vec<(Range<u32>, Bounds)>,
    /// Bounds of the operands of the current CSG program.
    pub(crate) operand_bounds: Vec<Bounds>,
    /// Objects that the lights of the current object refer to.
    held: Vec<(Holds, Arc<Object>, Inherited)>,
}

/// Use of an object by a light.
#[derive(Debug)]
enum Holds {
    /// `looks_like`.
    Look,
    /// `projected_through`, with the index of the light.
    Projector(u32),
}

impl Lowering {
    /// Empty; `settings` are the scene-wide settings for patterns.
    pub(crate) fn new(settings: Settings) -> Self {
        Lowering {
            settings,
            ..Lowering::default()
        }
    }

    /// Lowers one top-level object; returns it if it can be dropped now.
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

    /// Drops prepared textures that only this top-level object uses. A surface that is the last user of its texture
    /// takes it over.
    fn forget_textures(&mut self, object: &Object) {
        // The attributes hold its texture too.
        self.last_attributes = None;
        let is_copy =
            matches!(&object.kind, Kind::Csg { children, .. } if Arc::strong_count(children) > 1);
        for texture in self.lately_prepared.drain(..) {
            let known = self.prepared.get(&texture);
            // Two references: here and in the object.
            if !is_copy && known.is_some_and(|(texture, _)| Arc::strong_count(texture) <= 2) {
                self.prepared.remove(&texture);
            }
        }
        let lately = &mut self.surfaces[self.first_surface..];
        lately.iter_mut().for_each(Surface::take_texture);
        self.first_surface = self.surfaces.len();
    }

    /// Lowers one top-level object.
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
        let below = self.inherit(object, above);
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
        self.add_leaf(shape.clone(), &below.steps, absorb, surface);
    }

    fn add_leaf(&mut self, shape: Shape, steps: &[Step], absorb: Absorb, surface: u32) {
        let (leaf, mut bounds) = Leaf::new(shape, steps, absorb, surface, Extent::Surface);
        if bounds.is_empty() {
            return;
        }
        // The inside of a disc is a half-space, far beyond its surface.
        if self.needs_insides && !leaf.shape.solid_bounds().is_finite() {
            bounds = Bounds::EVERYTHING;
        }
        let number = index(self.parts.leaves.len());
        self.parts.push(PendingItem::Leaf(number), bounds);
        self.parts.leaves.push(leaf);
    }

    /// Adds a light and returns its `looks_like` object; the `projected_through` object waits until the object around
    /// it is complete.
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
        let light = self
            .lights
            .add(transformed(light, &below.steps), above.group);
        if let Some(object) = projected_through {
            let holds = Holds::Projector(light);
            self.held.push((holds, Arc::clone(object), below.clone()));
        }
        looks_like
            .as_ref()
            .map(|object| (Arc::clone(object), below))
    }
}

/// A light with transforms applied.
fn transformed(light: &Light, steps: &[Step]) -> Light {
    let mut light = light.clone();
    steps.iter().for_each(|step| light.transform(step));
    light
}
