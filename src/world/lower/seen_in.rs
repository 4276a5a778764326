//! Boxes within which objects are seen (see `scene::seen_in`), as bounds of combinations that show more.

use super::flatten::{Lowering, index};
use super::inherit::Inherited;
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::{Cuboid, Shape, Sphere};
use crate::scene::{Kind, Object};
use crate::world::csg::program::{BoundGate, Combine, CsgProgram, NONE, Node, Operand};
use crate::world::primitive::{Absorb, Extent, Leaf};
use smallvec::smallvec;

/// By how much of its size a box may be smaller than what it holds: boxes are kept in single precision.
const SLACK: f64 = 1e-6;

/// The box in the world within which an object is seen.
pub(crate) fn seen_in(object: &Object, above: &Inherited) -> Option<Bounds> {
    let seen_in = object.seen_in()?;
    if above.is_moved && matches!(object.kind, Kind::Shape(_)) {
        return None;
    }
    let own = object.steps[seen_in.after..].iter();
    let steps: Vec<Step> = own.chain(above.steps.iter()).cloned().collect();
    if steps.is_empty() {
        return Some(seen_in.what);
    }
    let to_world = Transform::from_steps(&steps).world_from_object;
    Some(seen_in.what.transformed(&to_world))
}

/// Tells whether a box holds what is shown, but for the roundings of boxes.
pub(crate) fn holds(seen_in: &Bounds, shown: &Bounds) -> bool {
    let slack = SLACK * seen_in.min.abs().max(seen_in.max.abs()).max_element();
    let is_held = shown.min.cmpge(seen_in.min - slack) & shown.max.cmple(seen_in.max + slack);
    is_held.all()
}

impl Lowering {
    /// What shows a combination to those rays alone that meet a box.
    pub(crate) fn gate(&mut self, program: &CsgProgram, seen_in: Bounds) -> BoundGate {
        // No ray meets a box of which one side is negative, nor a ball of no size.
        let shape = if seen_in.is_empty() {
            Shape::Sphere(Sphere {
                centre: seen_in.min,
                radius: 0.0,
            })
        } else {
            Shape::Cuboid(Cuboid::new(seen_in.min, seen_in.max))
        };
        let leaves = &mut self.parts.leaves;
        let surface = leaves
            .get(program.first as usize)
            .map_or(0, |leaf| leaf.surface);
        let nowhere: (&[Step], Absorb) = (&[], Absorb::AllItCan);
        let (leaf, bounds) = Leaf::new(shape, nowhere, surface, Extent::Solid);
        let mut bound = CsgProgram {
            nodes: smallvec![Node {
                combine: Combine::Union,
                is_inverse: false,
                children: 1,
                parent: NONE,
            }],
            operands: smallvec![Operand {
                parent: 0,
                is_inverse: false,
                is_hidden: false,
            }],
            first: index(leaves.len()),
            ..CsgProgram::default()
        };
        leaves.push(leaf);
        bound.prepare(leaves, &[bounds], Vec::new());
        BoundGate {
            operands: 0..program.len(),
            bound,
        }
    }
}
