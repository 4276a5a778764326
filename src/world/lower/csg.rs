//! From objects that are combined, clipped or bounded to programs over leaves.

use super::flatten::{Lowering, index};
use super::inherit::{CsgRole, Inherited, joined};
use super::seen_in::{holds, seen_in};
use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::scene::{Kind, Object, Operation};
use crate::world::csg::bounds::{Factors, limited};
use crate::world::csg::program::{BoundGate, Combine, CsgProgram, NONE, Node, Operand};
use crate::world::model::PendingItem;
use crate::world::primitive::{Extent, Leaf};
use smallvec::smallvec;
use std::sync::Arc;

/// Most operands of an intersection whose nested intersections are searched for bounding primitives.
const MOST_FACTORS: usize = 64;

/// What lies around a part of a combination.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings {
    /// A box around what can be seen of it.
    pub(crate) shown: Bounds,
    /// A box around its inside.
    pub(crate) solid: Bounds,
}

impl Surroundings {
    const EMPTY: Surroundings = Surroundings {
        shown: Bounds::EMPTY,
        solid: Bounds::EMPTY,
    };
    const EVERYTHING: Surroundings = Surroundings {
        shown: Bounds::EVERYTHING,
        solid: Bounds::EVERYTHING,
    };
}

impl Lowering {
    pub(crate) fn add_program(&mut self, object: &Object, above: &Inherited) {
        let (mut program, around) = self.program(object, above);
        if let Some(seen_in) = seen_in(object, above)
            && !holds(&seen_in, &around.shown)
        {
            let gate = self.gate(&program, seen_in);
            program.gates.push(gate);
        }
        // POV-Ray asks only what has the camera in its box whether it lies inside; questions for insides ask all.
        let bounds = if self.asks_insides {
            around.solid
        } else {
            around.shown
        };
        if bounds.is_empty() {
            self.parts.leaves.truncate(program.first as usize);
            return;
        }
        self.parts.push(
            PendingItem::Program(index(self.parts.programs.len())),
            bounds,
        );
        self.parts.programs.push(program);
    }

    pub(crate) fn program(
        &mut self,
        object: &Object,
        above: &Inherited,
    ) -> (CsgProgram, Surroundings) {
        let root = Node {
            combine: Combine::Union,
            is_inverse: false,
            children: 0,
            parent: NONE,
        };
        let mut program = CsgProgram {
            nodes: smallvec![root],
            first: index(self.parts.leaves.len()),
            ..CsgProgram::default()
        };
        let outer_bounds = std::mem::take(&mut self.operand_bounds);
        let outer_gates = std::mem::take(&mut self.gates);
        let outer_boxed = std::mem::take(&mut self.boxed);
        let above = Inherited {
            place: CsgRole::Whole,
            ..above.clone()
        };
        let place = (0, object.is_inverse);
        let around = self.add_node(object, &above, &mut program, place, false);
        let of_operands = std::mem::replace(&mut self.operand_bounds, outer_bounds);
        let boxed = std::mem::replace(&mut self.boxed, outer_boxed);
        program.prepare_as(&mut self.ready, &self.parts.leaves, &of_operands, boxed);
        for (operands, object, around) in std::mem::replace(&mut self.gates, outer_gates) {
            let (bound, _) = self.program(&object, &around);
            program.gates.push(BoundGate { operands, bound });
        }
        (program, around)
    }

    /// Adds an object and gives its bounds. `place` is the node above and whether the object is inverted.
    fn add_node(
        &mut self,
        object: &Object,
        above: &Inherited,
        program: &mut CsgProgram,
        place: (u32, bool),
        is_hidden: bool,
    ) -> Surroundings {
        let below = self.heritage_of_part(object, above);
        let first = index(program.operands.len());
        let bounds = self.add_clipped(object, (above, &below), program, place, is_hidden);
        let end = index(program.operands.len());
        let around = bounds.shown.union(&bounds.solid);
        if end - first > 1 && around.is_finite() && !around.is_empty() {
            self.boxed.push((first..end, around));
        }
        // Parts keep theirs whatever they are (measured with POV-Ray).
        let is_part = above.place != CsgRole::Whole && !object.bounded_by().is_empty();
        if is_part || is_gated(object) {
            let operands = first..index(program.operands.len());
            for bound in object.bounded_by() {
                let around = Inherited {
                    steps: joined(&object.steps[bound.after..], &above.steps),
                    ..(*below).clone()
                };
                self.gates
                    .push((operands.clone(), Arc::clone(&bound.what), around));
            }
        }
        bounds
    }

    /// The same without what bounds the object.
    fn add_clipped(
        &mut self,
        object: &Object,
        (above, below): (&Inherited, &Inherited),
        program: &mut CsgProgram,
        (parent, is_inverse): (u32, bool),
        is_hidden: bool,
    ) -> Surroundings {
        if object.clipped_by().is_empty() {
            return self.add_bare(object, below, program, (parent, is_inverse), is_hidden);
        }
        let first = program.operands.len();
        let node = push_node(program, Combine::Intersection, parent);
        let mut bounds = self.add_bare(object, below, program, (node, is_inverse), is_hidden);
        for clip in object.clipped_by() {
            let around = Inherited {
                steps: joined(&object.steps[clip.after..], &above.steps),
                place: CsgRole::Cut,
                ..below.clone()
            };
            let place = (node, clip.what.is_inverse);
            let held = self.add_node(&clip.what, &around, program, place, true);
            bounds.shown = bounds.shown.intersection(&held.solid);
            bounds.solid = bounds.solid.intersection(&held.solid);
        }
        let factors = factors(program, node, first);
        bounds.solid = limited(&self.parts.leaves, &factors, bounds.solid);
        bounds.shown = bounds.shown.intersection(&bounds.solid);
        bounds
    }

    /// The same without what clips the object. `place` is the node above and whether the object is inverted.
    fn add_bare(
        &mut self,
        object: &Object,
        below: &Inherited,
        program: &mut CsgProgram,
        place: (u32, bool),
        is_hidden: bool,
    ) -> Surroundings {
        let (parent, is_inverse) = place;
        match &object.kind {
            Kind::Light { .. } => self.add_light_as_part(object, below, program, place, is_hidden),
            Kind::Shape(shape) => {
                let (surface, absorb) = self.surface_of(shape, below);
                let place = (below.steps.as_ref(), absorb);
                let (leaf, bounds) = Leaf::new((**shape).clone(), place, surface, Extent::Solid);
                let shown = leaf.surface_bounds(&bounds);
                self.parts.leaves.push(leaf);
                self.operand_bounds.push(bounds);
                program.nodes[parent as usize].children += 1;
                program.operands.push(Operand {
                    parent,
                    is_inverse,
                    is_hidden,
                });
                let solid = if is_inverse {
                    Bounds::EVERYTHING
                } else {
                    bounds
                };
                Surroundings { shown, solid }
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let is_sum = matches!(operation, Operation::Union | Operation::Merge);
                let combine = match (operation, is_inverse) {
                    (Operation::Union, false) => Combine::Union,
                    // Of an inverse intersection inner surfaces do not show.
                    _ if is_sum != is_inverse => Combine::Merge,
                    _ => Combine::Intersection,
                };
                let node = push_node(program, combine, parent);
                let signs =
                    (0..).map(|at| is_inverse != (*operation == Operation::Difference && at > 0));
                // Among others those of what stands in unions are gathered here.
                let gathers = combine != Combine::Union
                    && object.size().has_cutaways
                    && !self.asks_insides
                    && below.texture.is_none()
                    && below.cutaway.is_none();
                let cutaway = if gathers {
                    Some(Arc::new(self.cutaway(object, is_inverse, below)))
                } else {
                    below.cutaway.clone()
                };
                let below = Inherited {
                    cutaway,
                    place: match operation {
                        Operation::Union => CsgRole::Union,
                        Operation::Merge => CsgRole::Merge,
                        Operation::Intersection | Operation::Difference => CsgRole::Cut,
                    },
                    ..below.clone()
                };
                self.add_children(children, signs, &below, program, (node, is_hidden))
            }
        }
    }

    /// The same of a light: what it looks like is a part in its place.
    fn add_light_as_part(
        &mut self,
        light: &Object,
        below: &Inherited,
        program: &mut CsgProgram,
        (parent, is_inverse): (u32, bool),
        is_hidden: bool,
    ) -> Surroundings {
        let held = Inherited {
            obeyed: None,
            ..below.clone()
        };
        let outside = Inherited {
            group: None,
            ..held.clone()
        };
        match self.add_light(&light.kind, &outside, held) {
            Some((look, around)) => {
                let place = (parent, is_inverse != look.is_inverse);
                self.add_node(&look, &around, program, place, is_hidden)
            }
            None => Surroundings::EMPTY,
        }
    }

    /// Adds children, each inverse or not as it is itself, unless `signs` exchange that: a combination hands its
    /// inversion down to its parts, and what clips them stays as it is (measured with POV-Ray).
    fn add_children(
        &mut self,
        children: &[Arc<Object>],
        signs: impl Iterator<Item = bool>,
        below: &Inherited,
        program: &mut CsgProgram,
        (node, is_hidden): (u32, bool),
    ) -> Surroundings {
        let is_product = program.nodes[node as usize].combine == Combine::Intersection;
        let mut sum = if is_product {
            Surroundings::EVERYTHING
        } else {
            Surroundings::EMPTY
        };
        let first = program.operands.len();
        for (child, is_exchanged) in children.iter().zip(signs) {
            let place = (node, child.is_inverse != is_exchanged);
            let is_unseen = matches!(
                child.kind,
                Kind::Light {
                    looks_like: None,
                    ..
                }
            );
            let child = self.add_node(child, below, program, place, is_hidden);
            if is_unseen {
                // A light cuts nothing: intersections and differences pass it over.
                continue;
            }
            if is_product {
                sum.solid = sum.solid.intersection(&child.solid);
                sum.shown = sum.solid;
            } else {
                sum.solid = sum.solid.union(&child.solid);
                sum.shown = sum.shown.union(&child.shown);
            }
        }
        if is_product {
            let factors = factors(program, node, first);
            sum.solid = limited(&self.parts.leaves, &factors, sum.solid);
            sum.shown = sum.solid;
        }
        sum
    }
}

/// Whether `bounded_by` decides anything: POV-Ray drops it from finite primitives, which have bounds of their own.
pub(crate) fn is_gated(object: &Object) -> bool {
    let needs_none = matches!(&object.kind, Kind::Shape(shape) if shape.bounds().is_finite());
    !object.bounded_by().is_empty() && !needs_none
}

/// Primitives that an intersection is the common inside of, those of nested intersections included; its operands are those
/// from `first` on.
fn factors(program: &CsgProgram, node: u32, first: usize) -> Factors {
    let added = program.operands[first..].iter();
    let is_small = added.len() <= MOST_FACTORS;
    let is_factor = |mut parent: u32| {
        while is_small && parent > node && parent != NONE {
            let between = &program.nodes[parent as usize];
            if between.combine != Combine::Intersection {
                return false;
            }
            parent = between.parent;
        }
        parent == node
    };
    let numbers = program.first + index(first)..;
    let factors = numbers
        .zip(added)
        .filter(|(_, operand)| is_factor(operand.parent));
    factors
        .map(|(number, operand)| (number, operand.is_inverse))
        .collect()
}

fn push_node(program: &mut CsgProgram, combine: Combine, parent: u32) -> u32 {
    let node = index(program.nodes.len());
    program.nodes[parent as usize].children += 1;
    program.nodes.push(Node {
        combine,
        is_inverse: false,
        children: 0,
        parent,
    });
    node
}
