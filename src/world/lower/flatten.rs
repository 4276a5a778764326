//! Lowering of the objects of a scene to leaves, CSG programs and lights: transforms are folded, unions split up, and
//! texture and interior handed down to children without their own.

use super::csg::{clips, is_gated};
use super::lowering::{Holds, Lowering};
use super::parts::inherited::Inherited;
use super::parts::model::PendingItem;
use super::parts::targets::Targets;
use super::visibility_box::is_seen_whole;
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Bounds, Step};
use crate::scene::light::Light;
use crate::scene::pattern::Settings;
use crate::scene::shape::{Geometry, Rounded, Shape, Steps};
use crate::scene::{ColorOrTexture, ExtentBox, Kind, Object, OwnedObject, PlainObject};
use crate::world::csg::coincidence::Widening;
use crate::world::index::index;
use crate::world::primitive::{Absorb, Extent, Leaf};
use crate::world::surface::Surface;
use std::sync::Arc;

/// The most discs, cylinders, cones, quadrics, prisms and lathes that are rounded for the pixels in which they coincide with others, and
/// the most CSG objects, and the most meshes, of which POV-Ray's boxes are stored for them.
pub(crate) const MOST_TYING: usize = 1 << 9;

impl Lowering {
    /// Empty; `settings` are the scene-wide settings for patterns.
    pub(crate) fn new(settings: Settings) -> Self {
        Lowering {
            settings,
            ..Lowering::default()
        }
    }

    /// Lowers one top-level object; returns it if it can be dropped now.
    pub(crate) fn take(&mut self, object: OwnedObject) -> Option<Arc<Object>> {
        match object {
            OwnedObject::Colored(shape, color, finish) => {
                let look = ColorOrTexture::Color(color, finish);
                self.add(&PlainObject { shape, look }.into());
                None
            }
            OwnedObject::Object(object) => {
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
            if below.split_target.is_some() || !self.add_copy(object, &below) {
                for child in &**children {
                    self.add_below(child, &below);
                }
            }
            return;
        }
        let is_bare = clips(object).is_empty() && !is_gated(object) && !object.is_inverse;
        match &object.kind {
            Kind::Light { .. } => {
                let look = self.add_light(&object.kind, above, below);
                let held = look.map(|(object, around)| (Holds::Look, object, around));
                self.held.extend(held);
            }
            Kind::Shape(shape) if is_bare && is_seen_whole(object, shape, above, &below) => {
                self.add_shape(shape, &below);
            }
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
        self.add_leaf(shape, &below.steps, absorb, surface);
    }

    fn add_leaf(&mut self, shape: &Shape, steps: &[Step], absorb: Absorb, surface: u32) {
        let alone = self.shape_alone(shape.clone());
        let (leaf, mut bounds) = Leaf::new(alone, steps, absorb, surface, Extent::Surface);
        if bounds.is_empty() {
            return;
        }
        // The inside of a disc is a half-space, far beyond its surface.
        if self.needs_insides && !leaf.shape.solid_bounds().is_finite() {
            bounds = Bounds::EVERYTHING;
        }
        let number = index(self.parts.leaves.len());
        self.parts.push(PendingItem::Leaf(number), bounds);
        let rounded = self.rounded(shape, steps, &leaf, self.parts.own_boxes.len());
        let is_turned = leaf.object_from_world.is_some();
        if is_turned && matches!(shape, Shape::Mesh(_)) && self.parts.mesh_boxes.len() < MOST_TYING
        {
            let own_box = ExtentBox::of_shape(shape, steps);
            self.parts.mesh_boxes.insert(number, own_box);
        }
        self.parts.leaves.push(leaf);
        if let Some((rounded, own_box)) = rounded {
            self.parts.round(number, rounded, own_box);
        }
    }

    /// A shape that is no part of a CSG object: POV-Ray's faults show unless cuts are to be clean.
    pub(crate) fn shape_alone(&self, mut shape: Shape) -> Shape {
        if let Shape::Sor(sor) = &mut shape
            && self.widening != Widening::NONE
        {
            sor.use_povray_hits();
        }
        shape
    }

    /// The rounded form of a shape, if [`Lowering::may_round`] holds for its leaf and the form is known, and POV-Ray's box of
    /// one that decides ties; `tying` of these are stored before it.
    pub(crate) fn rounded(
        &self,
        shape: &Shape,
        steps: &[Step],
        leaf: &Leaf,
        tying: usize,
    ) -> Option<(Rounded, Option<Bounds>)> {
        let normalization = Normalization::of_version(self.settings.is_3_8);
        let form = self.may_round(leaf, tying).then(|| {
            shape.rounded(&Steps {
                steps,
                normalization,
            })
        })??;
        let own_box = || ExtentBox::of_shape(shape, steps);
        Some((form, shape.decides_ties().then(own_box)))
    }

    /// Returns true if hits on a leaf may be wanted with POV-Ray's rounding; `tying` of those that
    /// decide ties are already stored.
    pub(crate) fn may_round(&self, leaf: &Leaf, tying: usize) -> bool {
        if leaf.knows_rounding() {
            return false;
        }
        if leaf.shape.is_searched() {
            return true;
        }
        let may_tie = leaf.shape.decides_ties();
        let is_wanted = || {
            let surface = self.surfaces.get(leaf.surface as usize);
            surface.is_some_and(|surface| surface.has_jumps() || surface.sends_rays())
        };
        self.rounds || self.slots.is_none() && (may_tie && tying < MOST_TYING || is_wanted())
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
        let mut light = transformed(light, &below.steps);
        light.normalization = Normalization::of_version(self.settings.is_3_8);
        let light = self.lights.add(light, above.group);
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
