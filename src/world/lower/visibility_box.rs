//! Boxes outside which objects are invisible (see `scene::seen_in`), as bounds of CSG programs that would show more.

use super::lowering::Lowering;
use super::parts::inherited::Inherited;
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::{Cuboid, Geometry, Shape, Sphere};
use crate::scene::{Kind, Object};
use crate::world::csg::program::{BoundGate, Combine, CsgProgram, NONE, Node, Operand};
use crate::world::index::index;
use crate::world::primitive::{Absorb, Extent, Leaf};
use smallvec::smallvec;

/// Relative amount by which a box may be smaller than its contents: boxes are stored in single precision.
const SLACK: f64 = 1e-6;

/// The world-space box outside which an object is invisible.
pub(crate) fn seen_in(object: &Object, above: &Inherited) -> Option<Bounds> {
    let seen_in = object.seen_in()?;
    if above.is_moved
        && let Kind::Shape(shape) = &object.kind
    {
        return shape
            .shows_beyond_its_box()
            .then(|| object.extent_below(&above.steps));
    }
    let own = object.steps[seen_in.after..].iter();
    let steps: Vec<Step> = own.chain(above.steps.iter()).cloned().collect();
    if steps.is_empty() {
        return Some(seen_in.what);
    }
    let to_world = Transform::from_steps(&steps).world_from_object;
    Some(seen_in.what.transformed(&to_world))
}

/// Returns true if a box contains everything shown, up to the rounding of boxes.
pub(crate) fn holds(seen_in: &Bounds, shown: &Bounds) -> bool {
    let slack = SLACK * seen_in.min.abs().max(seen_in.max.abs()).max_element();
    let is_held = shown.min.cmpge(seen_in.min - slack) & shown.max.cmple(seen_in.max + slack);
    is_held.all()
}

/// Returns true if no ray that hits a shape misses the box outside which it is invisible.
pub(crate) fn is_seen_whole(
    object: &Object,
    shape: &Shape,
    above: &Inherited,
    below: &Inherited,
) -> bool {
    seen_in(object, above).is_none_or(|seen_in| {
        let to_world = Transform::from_steps(&below.steps).world_from_object;
        holds(&seen_in, &shape.bounds().transformed(&to_world))
    })
}

/// Returns true if an object casts its whole shadow, whatever its box hides. In POV-Ray that depends on what blocked the
/// light before; of these kinds most of the shadow is whole.
fn spares_shadows(object: &Object) -> bool {
    matches!(&object.kind, Kind::Shape(shape) if matches!(
        **shape,
        Shape::Sphere(_)
            | Shape::Cuboid(_)
            | Shape::Text(_)
            | Shape::Triangle(_)
            | Shape::SmoothTriangle(_)
    ))
}

fn is_plane(object: &Object) -> bool {
    matches!(&object.kind, Kind::Shape(shape) if matches!(**shape, Shape::Plane(_)))
}

impl Lowering {
    /// A gate that shows a program only to the rays that hit a box.
    pub(crate) fn gate(
        &mut self,
        program: &CsgProgram,
        seen_in: Bounds,
        object: &Object,
    ) -> BoundGate {
        let spares_shadows = spares_shadows(object);
        // No ray hits a box with a negative side, or a sphere of radius zero.
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
        let (leaf, bounds) = Leaf::new(shape, &[], Absorb::AllItCan, surface, Extent::Solid);
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
            spares_shadows,
            needs_tree: spares_shadows || is_plane(object),
        }
    }
}
