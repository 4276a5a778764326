//! Lowering of CSG objects, and of clipped and bounded objects, to CSG programs.

use super::flatten::MOST_TYING;
use super::lowering::Lowering;
use super::parts::inherited::{CsgRole, Inherited, joined};
use super::parts::model::PendingItem;
use super::visibility_box::{holds, seen_in};
use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::scene::{Attached, Kind, Object, Operation};
use crate::world::csg::bounds::{Factors, clip_to_planes};
use crate::world::csg::program::{BoundGate, Combine, CsgProgram, NONE, Node, Operand};
use crate::world::index::index;
use crate::world::primitive::{Extent, Leaf};
use smallvec::{SmallVec, smallvec};
use std::ops::Range;
use std::sync::Arc;

/// Most operands of an intersection whose nested intersections are searched for bounding primitives.
const MAX_FACTORS: usize = 64;

/// Index of the first operand of each child.
type Starts = SmallVec<[usize; 8]>;

/// Bounds of a part of a CSG object.
#[derive(Clone, Copy)]
pub(crate) struct PartBounds {
    /// Bounds of its visible surface.
    pub(crate) shown: Bounds,
    /// Bounds of its inside.
    pub(crate) solid: Bounds,
    /// True if it contains the rays that are outside all its leaves.
    pub(crate) holds_at_rest: bool,
}

impl PartBounds {
    const EMPTY: PartBounds = PartBounds {
        shown: Bounds::EMPTY,
        solid: Bounds::EMPTY,
        holds_at_rest: false,
    };
    const EVERYTHING: PartBounds = PartBounds {
        shown: Bounds::EVERYTHING,
        solid: Bounds::EVERYTHING,
        holds_at_rest: true,
    };
}

/// A bounding object of a CSG program.
#[derive(Debug)]
pub(crate) struct PendingGate {
    /// The operands that it bounds.
    operands: Range<u32>,
    object: Arc<Object>,
    /// The state that it inherits.
    above: Inherited,
}

/// Position of an object in the tree of a CSG program.
#[derive(Clone, Copy)]
struct Slot {
    /// The parent node.
    parent: u32,
    /// True if the object is inverted there.
    is_inverse: bool,
    /// True if its surface is never shown: it only clips.
    is_hidden: bool,
}

impl Lowering {
    pub(crate) fn add_program(&mut self, object: &Object, above: &Inherited) {
        let (mut program, around) = self.program(object, above);
        if let Some(seen_in) = seen_in(object, above)
            && !holds(&seen_in, &around.shown)
        {
            let gate = self.gate(&program, seen_in, object);
            program.gates.push(gate);
        }
        // POV-Ray runs inside tests only on objects whose box contains the camera; probes test all.
        let bounds = if self.needs_insides {
            around.solid
        } else {
            around.shown
        };
        if bounds.is_empty() {
            self.parts.truncate_leaves(program.first);
            return;
        }
        self.parts.push(
            PendingItem::Program(index(self.parts.programs.len())),
            bounds,
        );
        self.parts.programs.push(program);
        if self.parts.program_boxes.len() < MOST_TYING {
            let own_box = object.extent_below(&above.steps);
            self.parts.program_boxes.push(own_box);
        }
    }

    pub(crate) fn program(
        &mut self,
        object: &Object,
        above: &Inherited,
    ) -> (CsgProgram, PartBounds) {
        let root = Node {
            combine: Combine::Union,
            is_inverse: false,
            children: 0,
            parent: NONE,
        };
        let mut program = CsgProgram {
            nodes: smallvec![root],
            first: index(self.parts.leaves.len()),
            widening: self.widening,
            ..CsgProgram::default()
        };
        let outer_bounds = std::mem::take(&mut self.operand_bounds);
        let first_hit = self.hit_order.len();
        let outer_gates = std::mem::take(&mut self.gates);
        let outer_boxed = std::mem::take(&mut self.boxed);
        let above = Inherited {
            role: CsgRole::Whole,
            ..above.clone()
        };
        let slot = Slot {
            parent: 0,
            is_inverse: object.is_inverse,
            is_hidden: false,
        };
        let around = self.add_node(object, &above, &mut program, slot);
        let of_operands = std::mem::replace(&mut self.operand_bounds, outer_bounds);
        let boxed = std::mem::replace(&mut self.boxed, outer_boxed);
        let hit_order = &self.hit_order[first_hit..];
        let leaves = &self.parts.leaves;
        program.prepare_as(&mut self.memo, leaves, &of_operands, boxed, hit_order);
        self.hit_order.truncate(first_hit);
        for gate in std::mem::replace(&mut self.gates, outer_gates) {
            let (bound, _) = self.program(&gate.object, &gate.above);
            program.gates.push(BoundGate {
                operands: gate.operands,
                bound,
                spares_shadows: false,
                needs_tree: false,
            });
        }
        (program, around)
    }

    /// Adds an object and returns its bounds.
    fn add_node(
        &mut self,
        object: &Object,
        above: &Inherited,
        program: &mut CsgProgram,
        slot: Slot,
    ) -> PartBounds {
        let below = self.inherit_part(object, above);
        let first = index(program.operands.len());
        let bounds = self.add_clipped(object, above, &below, program, slot);
        let end = index(program.operands.len());
        let around = bounds.shown.union(&bounds.solid);
        // A ray that misses the box counts as outside all leaves: as outside the part, unless that is made of inverse ones.
        let has_box = around.is_finite() && !around.is_empty() && !bounds.holds_at_rest;
        if end - first > 1 && has_box {
            self.boxed.push((first..end, around));
        }
        // Parts keep their bounds, whatever they are (measured with POV-Ray).
        let is_part = above.role != CsgRole::Whole && !object.bounded_by().is_empty();
        if is_part || is_gated(object) {
            let operands = first..index(program.operands.len());
            for bound in object.bounded_by() {
                self.gates.push(PendingGate {
                    operands: operands.clone(),
                    object: Arc::clone(&bound.what),
                    above: Inherited {
                        steps: joined(&object.steps[bound.after..], &above.steps),
                        ..(*below).clone()
                    },
                });
            }
        }
        bounds
    }

    /// Same, without the object's `bounded_by`.
    fn add_clipped(
        &mut self,
        object: &Object,
        above: &Inherited,
        below: &Inherited,
        program: &mut CsgProgram,
        slot: Slot,
    ) -> PartBounds {
        if clips(object).is_empty() {
            return self.add_bare(object, below, program, slot);
        }
        let first = program.operands.len();
        let node = push_node(program, Combine::Intersection, slot.parent);
        let inner = Slot {
            parent: node,
            ..slot
        };
        let mut starts: Starts = smallvec![first];
        let mut bounds = self.add_bare(object, below, program, inner);
        for clip in clips(object) {
            starts.push(program.operands.len());
            let around = Inherited {
                steps: joined(&object.steps[clip.after..], &above.steps),
                role: CsgRole::Cut,
                ..below.clone()
            };
            let slot = Slot {
                parent: node,
                is_inverse: clip.what.is_inverse,
                is_hidden: true,
            };
            let held = self.add_node(&clip.what, &around, program, slot);
            bounds.shown = bounds.shown.touching_intersection(&held.solid);
            bounds.solid = bounds.solid.touching_intersection(&held.solid);
            bounds.holds_at_rest &= held.holds_at_rest;
        }
        let factors = factors(program, node, &starts);
        bounds.solid = clip_to_planes(&self.parts.leaves, &factors, bounds.solid);
        bounds.shown = bounds.shown.touching_intersection(&bounds.solid);
        bounds
    }

    /// Same, without the object's `clipped_by`.
    fn add_bare(
        &mut self,
        object: &Object,
        below: &Inherited,
        program: &mut CsgProgram,
        slot: Slot,
    ) -> PartBounds {
        let Slot {
            parent,
            is_inverse,
            is_hidden,
        } = slot;
        match &object.kind {
            Kind::Light { .. } => self.add_light_as_part(object, below, program, slot),
            Kind::Shape(shape) => {
                let (surface, absorb) = self.surface_of(shape, below);
                let (leaf, bounds) = Leaf::new(
                    (**shape).clone(),
                    &below.steps,
                    absorb,
                    surface,
                    Extent::Solid,
                );
                let shown = leaf.surface_bounds(&bounds);
                let rounded = self.rounded(shape, &below.steps, &leaf, self.parts.own_boxes.len());
                let number = index(self.parts.leaves.len());
                self.parts.leaves.push(leaf);
                if let Some((rounded, own_box)) = rounded {
                    self.parts.round(number, rounded, own_box);
                }
                self.operand_bounds.push(bounds);
                self.hit_order.push(index(program.operands.len()));
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
                PartBounds {
                    shown,
                    solid,
                    holds_at_rest: is_inverse,
                }
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let is_sum = matches!(operation, Operation::Union | Operation::Merge);
                let combine = match (operation, is_inverse) {
                    (Operation::Union, false) => Combine::Union,
                    // An inverse intersection does not show inner surfaces.
                    _ if is_sum != is_inverse => Combine::Merge,
                    _ => Combine::Intersection,
                };
                let node = push_node(program, combine, parent);
                let signs =
                    (0..).map(|at| is_inverse != (*operation == Operation::Difference && at > 0));
                // Collects the textures of nested unions too.
                let gathers = combine != Combine::Union
                    && object.size().has_cutaways
                    && !self.needs_insides
                    && below.texture.is_none()
                    && below.cutaway.is_none();
                let cutaway = if gathers {
                    Some(Arc::new(self.cutaway(object, is_inverse, below)))
                } else {
                    below.cutaway.clone()
                };
                let below = Inherited {
                    cutaway,
                    role: match operation {
                        Operation::Union => CsgRole::Union,
                        Operation::Merge => CsgRole::Merge,
                        Operation::Intersection | Operation::Difference => CsgRole::Cut,
                    },
                    ..below.clone()
                };
                let reverses_hits = combine != Combine::Union || !clips(object).is_empty();
                let slot = Slot {
                    parent: node,
                    ..slot
                };
                self.add_children(children, signs, &below, program, slot, reverses_hits)
            }
        }
    }

    /// Adds the `looks_like` object of a light as a part instead of the light.
    fn add_light_as_part(
        &mut self,
        light: &Object,
        below: &Inherited,
        program: &mut CsgProgram,
        slot: Slot,
    ) -> PartBounds {
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
                let slot = Slot {
                    is_inverse: slot.is_inverse != look.is_inverse,
                    ..slot
                };
                self.add_node(&look, &around, program, slot)
            }
            None => PartBounds::EMPTY,
        }
    }

    /// Adds children, each inverse or not by itself, flipped where `signs` says so: a CSG object hands its inversion
    /// down to its parts, but not to the objects that clip them (measured with POV-Ray). The slot is that of the children.
    fn add_children(
        &mut self,
        children: &[Arc<Object>],
        signs: impl Iterator<Item = bool>,
        below: &Inherited,
        program: &mut CsgProgram,
        Slot {
            parent: node,
            is_hidden,
            ..
        }: Slot,
        reverses_hits: bool,
    ) -> PartBounds {
        let is_product = program.nodes[node as usize].combine == Combine::Intersection;
        let mut sum = if is_product {
            PartBounds::EVERYTHING
        } else {
            PartBounds::EMPTY
        };
        let mut starts = Starts::new();
        for (child, is_exchanged) in children.iter().zip(signs) {
            starts.push(program.operands.len());
            let slot = Slot {
                parent: node,
                is_inverse: child.is_inverse != is_exchanged,
                is_hidden,
            };
            let is_unseen = matches!(
                child.kind,
                Kind::Light {
                    looks_like: None,
                    ..
                }
            );
            let first_hit = self.hit_order.len();
            let child = self.add_node(child, below, program, slot);
            if reverses_hits {
                self.hit_order[first_hit..].reverse();
            }
            if is_unseen {
                // A light cuts nothing: intersections and differences ignore it.
                continue;
            }
            if is_product {
                sum.solid = sum.solid.touching_intersection(&child.solid);
                sum.shown = sum.solid;
                sum.holds_at_rest &= child.holds_at_rest;
            } else {
                sum.solid = sum.solid.union(&child.solid);
                sum.shown = sum.shown.union(&child.shown);
                sum.holds_at_rest |= child.holds_at_rest;
            }
        }
        if is_product {
            let factors = factors(program, node, &starts);
            sum.solid = clip_to_planes(&self.parts.leaves, &factors, sum.solid);
            sum.shown = sum.solid;
        }
        sum
    }
}

/// Returns true if the bounding objects themselves are tested: of most shapes that are no part of a CSG object only their
/// box is, see [`seen_in`].
pub(crate) fn is_gated(object: &Object) -> bool {
    let tests_bounds = match &object.kind {
        Kind::Shape(shape) => shape.tests_bounds(!clips(object).is_empty()),
        _ => true,
    };
    tests_bounds && !object.bounded_by().is_empty()
}

/// The objects that clip an object.
pub(crate) fn clips(object: &Object) -> &[Attached<Arc<Object>>] {
    match &object.kind {
        Kind::Shape(shape) if shape.is_never_clipped() => &[],
        _ => object.clipped_by(),
    }
}

/// The primitives whose intersection a node is: those of nested intersections too unless there are many operands, which
/// would take quadratic time in a deep nest. Each child begins with the operand at its start.
fn factors(program: &CsgProgram, node: u32, starts: &Starts) -> Factors {
    let operands = &program.operands;
    let all = starts.first().map_or(0..0, |&first| first..operands.len());
    let is_factor = |mut parent: u32| {
        while parent > node && parent != NONE {
            let between = &program.nodes[parent as usize];
            if between.combine != Combine::Intersection {
                return false;
            }
            parent = between.parent;
        }
        parent == node
    };
    let factor = |at: usize| (program.first + index(at), operands[at].is_inverse);
    if all.len() <= MAX_FACTORS {
        let nested = all.filter(|&at| is_factor(operands[at].parent));
        return nested.map(factor).collect();
    }
    let children = starts.iter().copied().filter(|&at| at < operands.len());
    let direct = children.filter(|&at| operands[at].parent == node);
    direct.map(factor).collect()
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
