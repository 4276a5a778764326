//! From objects that are combined, clipped or bounded to programs over leaves.

use super::csg::{Combine, Gate, NONE, Node, Operand, Program};
use super::flatten::{Flat, index};
use super::leaf::{Extent, Leaf};
use super::looks::{Heritage, Place, joined};
use super::model::Item;
use crate::math::Bounds;
use crate::scene::{Kind, Object, Operation};
use crate::shape::Geometry;
use std::sync::Arc;

impl Flat {
    pub(super) fn add_program(&mut self, object: &Object, above: &Heritage) {
        let (program, bounds) = self.program(object, above);
        if bounds.is_empty() {
            self.parts.leaves.truncate(program.first as usize);
            return;
        }
        self.parts
            .push(Item::Program(index(self.parts.programs.len())), bounds);
        self.parts.programs.push(program);
    }

    pub(super) fn program(&mut self, object: &Object, above: &Heritage) -> (Program, Bounds) {
        let root = Node {
            combine: Combine::Union,
            is_inverse: false,
            children: 0,
            parent: NONE,
        };
        let mut program = Program {
            nodes: vec![root],
            first: index(self.parts.leaves.len()),
            ..Program::default()
        };
        let outer_bounds = std::mem::take(&mut self.operand_bounds);
        let outer_gates = std::mem::take(&mut self.gates);
        let around = Heritage {
            place: Place::Whole,
            ..above.clone()
        };
        let bounds = self.add_node(object, &around, &mut program, 0, false);
        let of_operands = std::mem::replace(&mut self.operand_bounds, outer_bounds);
        program.prepare(&self.parts.leaves, &of_operands);
        for (operands, object, around) in std::mem::replace(&mut self.gates, outer_gates) {
            let (bound, _) = self.program(&object, &around);
            program.gates.push(Gate { operands, bound });
        }
        (program, bounds)
    }

    /// Adds an object under a node and gives the bounds of what it shows.
    fn add_node(
        &mut self,
        object: &Object,
        above: &Heritage,
        program: &mut Program,
        parent: u32,
        is_hidden: bool,
    ) -> Bounds {
        let below = self.heritage(object, above);
        let first = index(program.operands.len());
        let bounds = self.add_clipped(object, above, &below, program, (parent, is_hidden));
        if is_gated(object) {
            let operands = first..index(program.operands.len());
            for bound in &object.bounded_by {
                let around = Heritage {
                    steps: joined(&object.steps[bound.after..], &above.steps),
                    ..below.clone()
                };
                self.gates
                    .push((operands.clone(), Arc::clone(&bound.what), around));
            }
        }
        bounds
    }

    /// The same without what bounds the object. `place` is the node above and whether the object only clips.
    fn add_clipped(
        &mut self,
        object: &Object,
        above: &Heritage,
        below: &Heritage,
        program: &mut Program,
        (parent, is_hidden): (u32, bool),
    ) -> Bounds {
        if object.clipped_by.is_empty() {
            return self.add_bare(
                object,
                below,
                program,
                (parent, object.is_inverse),
                is_hidden,
            );
        }
        let node = push_node(program, Combine::Intersection, false, parent);
        let mut bounds =
            self.add_bare(object, below, program, (node, object.is_inverse), is_hidden);
        for clip in &object.clipped_by {
            let around = Heritage {
                steps: joined(&object.steps[clip.after..], &above.steps),
                place: Place::Cut,
                ..below.clone()
            };
            let held = self.add_node(&clip.what, &around, program, node, true);
            bounds = bounds.intersection(&held);
        }
        bounds
    }

    /// The same without what clips the object. `place` is the node above and whether the object is inverted.
    fn add_bare(
        &mut self,
        object: &Object,
        below: &Heritage,
        program: &mut Program,
        place: (u32, bool),
        is_hidden: bool,
    ) -> Bounds {
        let (parent, is_inverse) = place;
        match &object.kind {
            Kind::Light { .. } => {
                let held = Heritage {
                    obeyed: None,
                    ..below.clone()
                };
                let outside = Heritage {
                    group: None,
                    ..held.clone()
                };
                self.add_light(&object.kind, &outside, held);
                Bounds::EMPTY
            }
            Kind::Shape(shape) => {
                let surface = self.surface(below, shape.skins());
                let (leaf, bounds) =
                    Leaf::new((**shape).clone(), &below.steps, surface, Extent::Solid);
                self.parts.leaves.push(leaf);
                self.operand_bounds.push(bounds);
                program.nodes[parent as usize].children += 1;
                program.operands.push(Operand {
                    parent,
                    is_inverse,
                    is_hidden,
                });
                if is_inverse {
                    Bounds::EVERYTHING
                } else {
                    bounds
                }
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let combine = match operation {
                    // The inverse of a union is the intersection of inverses: inner surfaces do not show.
                    Operation::Union if is_inverse => Combine::Merge,
                    Operation::Union => Combine::Union,
                    Operation::Merge => Combine::Merge,
                    Operation::Intersection | Operation::Difference => Combine::Intersection,
                };
                let node = push_node(program, combine, is_inverse, parent);
                let bounds =
                    self.add_children(*operation, children, below, program, (node, is_hidden));
                if is_inverse {
                    Bounds::EVERYTHING
                } else {
                    bounds
                }
            }
        }
    }

    fn add_children(
        &mut self,
        operation: Operation,
        children: &[Arc<Object>],
        below: &Heritage,
        program: &mut Program,
        (node, is_hidden): (u32, bool),
    ) -> Bounds {
        let is_sum = matches!(operation, Operation::Union | Operation::Merge);
        let below = &Heritage {
            place: match operation {
                Operation::Union => Place::Union,
                Operation::Merge => Place::Merge,
                Operation::Intersection | Operation::Difference => Place::Cut,
            },
            ..below.clone()
        };
        let mut sum = if is_sum {
            Bounds::EMPTY
        } else {
            Bounds::EVERYTHING
        };
        for (at, child) in children.iter().enumerate() {
            let child = if operation == Operation::Difference && at > 0 {
                let mut cut = (**child).clone();
                cut.is_inverse = !cut.is_inverse;
                self.add_cut(&cut, below, program, node, is_hidden)
            } else {
                self.add_node(child, below, program, node, is_hidden)
            };
            sum = if is_sum {
                sum.union(&child)
            } else {
                sum.intersection(&child)
            };
        }
        sum
    }

    /// What a difference takes away: its inverse as a whole, clips included.
    fn add_cut(
        &mut self,
        cut: &Object,
        above: &Heritage,
        program: &mut Program,
        node: u32,
        is_hidden: bool,
    ) -> Bounds {
        if cut.clipped_by.is_empty() {
            return self.add_node(cut, above, program, node, is_hidden);
        }
        let mut inner = cut.clone();
        inner.is_inverse = !inner.is_inverse;
        let outer = push_node(program, Combine::Union, true, node);
        self.add_node(&inner, above, program, outer, is_hidden);
        Bounds::EVERYTHING
    }
}

/// Whether `bounded_by` decides anything: POV-Ray drops it from finite primitives, which have bounds of their own.
pub(super) fn is_gated(object: &Object) -> bool {
    let needs_none = matches!(&object.kind, Kind::Shape(shape) if shape.bounds().is_finite());
    !object.bounded_by.is_empty() && !needs_none
}

fn push_node(program: &mut Program, combine: Combine, is_inverse: bool, parent: u32) -> u32 {
    let node = index(program.nodes.len());
    program.nodes[parent as usize].children += 1;
    program.nodes.push(Node {
        combine,
        is_inverse,
        children: 0,
        parent,
    });
    node
}
