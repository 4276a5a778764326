//! Preparation of CSG programs: fewer nodes, operands in the order that decides earliest, and a BVH over many operands.
//!
//! The surfaces shown do not change, not even where surfaces coincide: by the rules of `csg`, an intersection within an
//! intersection, and the inverse of a merge within one, are one intersection of all their operands.

use super::inside::InsideInit;
use super::program::{BoxedPart, Combine, CsgProgram, NONE, Node, OperandBvh, OperandOrder};
use crate::base::accel::Bvh;
use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::world::primitive::Leaf;
use glam::DVec3;
use std::ops::Range;

/// With fewer bounded operands each is tested by itself; packets test up to eight that way.
const TREE_FROM: usize = 9;
/// Same, where some operand lacks packet code and no required operand clips the interval.
const TREE_OF_LONE_RAYS_FROM: usize = 4;

/// Parts of a program, as ranges of operands, with their boxes.
type PartBoxes = Vec<(Range<u32>, Bounds)>;

impl CsgProgram {
    /// Simplifies the nodes and computes the order. `bounds` are those of the operands, `boxed` the parts with boxes.
    pub(crate) fn prepare(&mut self, leaves: &[Leaf], bounds: &[Bounds], boxed: PartBoxes) {
        self.leave_patches(leaves);
        self.join_nodes();
        self.drop_lone_root();
        self.nodes.shrink_to_fit();
        self.rest = self.state_outside_all();
        let (order, bounded) = self.order(leaves, bounds);
        self.order = order;
        self.order.boxed = self.boxed(bounded, bounds, boxed).map(Box::new);
    }

    /// The BVH over the `bounded` operands and the parts. Parts are used if their boxes cull more than the box of the
    /// whole: they must not be required, and must have operands outside the BVH.
    fn boxed(
        &self,
        bounded: Vec<u32>,
        bounds: &[Bounds],
        mut parts: PartBoxes,
    ) -> Option<OperandBvh> {
        let mut is_in_tree = vec![false; self.operands.len()];
        for &number in &bounded {
            is_in_tree[number as usize] = true;
        }
        parts.retain(|(operands, _)| {
            let mut required = self.order.required.iter();
            let is_needed = required.any(|number| operands.contains(number));
            // A ray is put inside these by its points, wherever the other operands of the part are at rest.
            let mut point_tested = self.order.point_tested.iter();
            let is_at_rest = !point_tested.any(|number| operands.contains(number));
            let own = &is_in_tree[operands.start as usize..operands.end as usize];
            !is_needed && is_at_rest && own.len() < self.operands.len() && own.contains(&false)
        });
        // Ranges are nested or apart. Of equal ones the last is the outer object.
        parts.reverse();
        parts.sort_by_key(|(operands, _)| (operands.start, std::cmp::Reverse(operands.end)));
        // Those of which all operands are in the BVH, or in smaller parts, are tested in vain.
        let part_of = smallest_parts(&parts, self.len());
        let mut has_others = vec![false; parts.len()];
        for &number in &self.order.others {
            if let Some(has_others) = has_others.get_mut(part_of[number as usize] as usize) {
                *has_others = true;
            }
        }
        let mut has_others = has_others.into_iter();
        parts.retain(|_| has_others.next() == Some(true));
        let mut boxes: Vec<_> = bounded.iter().map(|&n| bounds[n as usize]).collect();
        boxes.extend(parts.iter().map(|(_, bounds)| *bounds));
        if boxes.is_empty() {
            return None;
        }
        let part_of = smallest_parts(&parts, self.len());
        let mut parts = nested(&parts);
        let mut others = self.order.others.to_vec();
        others.sort_by_key(|&number| (part_of[number as usize], number));
        let before =
            |part: u32| index(others.partition_point(|&number| part_of[number as usize] < part));
        for (number, part) in (0..).zip(&mut parts) {
            part.others = before(number)..before(number + 1);
        }
        let all = boxes.iter().fold(Bounds::EMPTY, |all, own| all.union(own));
        Some(OperandBvh {
            tree: Bvh::build(&boxes),
            size: (all.max - all.min).max_element(),
            part_of_bounded: bounded.iter().map(|&n| part_of[n as usize]).collect(),
            first_part: index(bounded.len()),
            bounded,
            others_in_parts: before(NONE),
            parts,
            others,
            resting: self.resting(),
        })
    }

    /// For each node, the numbers of its children that do not contain a ray at rest, and of those that do.
    fn resting(&self) -> Vec<[u32; 2]> {
        let mut resting = vec![[0; 2]; self.nodes.len()];
        for operand in &self.operands {
            resting[operand.parent as usize][usize::from(operand.is_inverse)] += 1;
        }
        for (node, &count) in self.nodes.iter().zip(&self.rest.counts) {
            if let Some(resting) = resting.get_mut(node.parent as usize) {
                resting[usize::from(node.holds(count))] += 1;
            }
        }
        resting
    }

    /// Undoes the inversion of patches. A patch has no inside, nor has its inverse (measured with POV-Ray, which hands
    /// the inversion of a CSG object down to its parts and cannot invert a patch): subtracting it shows only the patch.
    fn leave_patches(&mut self, leaves: &[Leaf]) {
        let own = &leaves[self.first as usize..];
        for (number, leaf) in (0..self.len()).zip(own) {
            let is_new = || self.turned.binary_search(&number).is_err();
            if !leaf.shape.is_solid() && is_new() && self.is_inverse(number) {
                let operand = &mut self.operands[number as usize];
                operand.is_inverse = !operand.is_inverse;
                self.turned.push(number);
            }
        }
    }

    /// Merges each node that its parent's operation includes into the parent.
    fn join_nodes(&mut self) {
        // For each node, the node its children moved to, and whether they are inverted there. Parents come first.
        let mut target: Vec<(u32, bool)> = Vec::with_capacity(self.nodes.len());
        for number in 0..self.nodes.len() {
            let node = self.nodes[number].clone();
            let mut own = (index(number), false);
            if node.parent != NONE {
                let (parent, is_flipped) = target[node.parent as usize];
                let is_inverse = node.is_inverse != is_flipped;
                if is_part(&node, is_inverse, self.nodes[parent as usize].combine) {
                    self.nodes[parent as usize].children += node.children - 1;
                    own = (parent, is_inverse);
                } else {
                    self.nodes[number].parent = parent;
                    self.nodes[number].is_inverse = is_inverse;
                }
            }
            target.push(own);
        }
        for operand in &mut self.operands {
            let (parent, is_flipped) = target[operand.parent as usize];
            operand.parent = parent;
            operand.is_inverse ^= is_flipped;
        }
        let stays: Vec<bool> = (0..).zip(&target).map(|(n, to)| to.0 == n).collect();
        self.keep_nodes(&stays);
    }

    /// Removes a root union with a single node as its child.
    fn drop_lone_root(&mut self) {
        let root = &self.nodes[0];
        let is_idle = root.combine == Combine::Union && !root.is_inverse && root.children == 1;
        if is_idle && self.nodes.get(1).is_some_and(|node| node.parent == 0) {
            self.nodes[1].parent = NONE;
            let stays: Vec<bool> = (0..self.nodes.len()).map(|n| n > 0).collect();
            self.keep_nodes(&stays);
        }
    }

    /// Removes unreferenced nodes.
    fn keep_nodes(&mut self, stays: &[bool]) {
        let mut count = 0;
        let number: Vec<u32> = stays
            .iter()
            .map(|&stays| {
                count += u32::from(stays);
                count.wrapping_sub(1)
            })
            .collect();
        let mut stays = stays.iter();
        self.nodes.retain(|_| stays.next() == Some(&true));
        let parents = self.nodes.iter_mut().map(|node| &mut node.parent);
        for parent in parents.chain(self.operands.iter_mut().map(|operand| &mut operand.parent)) {
            if *parent != NONE {
                *parent = number[*parent as usize];
            }
        }
    }

    /// The state at a point outside all leaves.
    fn state_outside_all(&self) -> InsideInit {
        let mut counts = vec![0; self.nodes.len()];
        for operand in self.operands.iter().filter(|operand| operand.is_inverse) {
            counts[operand.parent as usize] += 1;
        }
        self.count_from_below(&mut counts);
        let leaf_in = self.operands.iter().map(|operand| operand.is_inverse);
        InsideInit::new(leaf_in, &counts)
    }

    /// The order without the operands in the BVH, and those operands.
    fn order(&self, leaves: &[Leaf], bounds: &[Bounds]) -> (OperandOrder, Vec<u32>) {
        let mut order = OperandOrder::default();
        let mut bounded = Vec::new();
        for (number, operand) in (0..).zip(&self.operands) {
            let bounds = &bounds[number as usize];
            let is_point_tested = leaves[(self.first + number) as usize]
                .shape
                .may_miss_roots();
            if is_point_tested {
                order.point_tested.push(number);
            }
            if !is_point_tested && !operand.is_inverse && self.is_required(operand.parent) {
                order.required.push(number);
            } else if bounds.is_finite() && !bounds.is_empty() {
                bounded.push(number);
            } else {
                order.others.push(number);
            }
        }
        // Operands without a matrix are the cheapest, and most rays that miss miss the bounded ones. Packets of rays
        // know more of an open quadric once other operands have clipped the interval.
        let first = self.first as usize;
        order.required.sort_by_key(|&number| {
            let leaf = &leaves[first + number as usize];
            let is_bounded = bounds[number as usize].is_finite();
            let is_open = leaf.shape.gains_from_intervals() && !is_bounded;
            (is_open, leaf.object_from_world.is_some(), !is_bounded)
        });
        let mut own = leaves[first..][..self.operands.len()].iter();
        let least = if order.required.is_empty() && !own.all(|leaf| leaf.shape.has_span_packet()) {
            TREE_OF_LONE_RAYS_FROM
        } else {
            TREE_FROM
        };
        if bounded.len() < least {
            order.others.extend(bounded.drain(..));
        }
        (order, bounded)
    }

    /// A bounding sphere of everything shown, by centre and radius, with `false` for not filled: the smallest one
    /// around a required operand.
    pub(crate) fn bounding_sphere(&self, leaves: &[Leaf]) -> Option<(DVec3, f64, bool)> {
        let own = &leaves[self.first as usize..];
        let required = self.order.required.iter();
        let spheres = required.filter_map(|&number| own[number as usize].bounding_sphere());
        let least = spheres.min_by(|a, b| a.1.total_cmp(&b.1));
        least.map(|(centre, radius, _)| (centre, radius, false))
    }

    /// Returns true if nothing shows outside the children of this node.
    fn is_required(&self, mut node: u32) -> bool {
        while node != NONE {
            let Node {
                combine,
                is_inverse,
                children,
                parent,
            } = self.nodes[node as usize];
            if (combine != Combine::Intersection && children != 1) || is_inverse {
                return false;
            }
            node = parent;
        }
        true
    }
}

/// Parts with these boxes, each of which comes before those within it. Their other operands are filled in later.
fn nested(parts: &PartBoxes) -> Vec<BoxedPart> {
    let mut open: Vec<(u32, u32)> = Vec::new();
    let part = |(number, (operands, _)): (u32, &(Range<u32>, Bounds))| {
        while open.last().is_some_and(|(_, end)| *end <= operands.start) {
            open.pop();
        }
        let around = open.last().map_or(NONE, |(part, _)| *part);
        open.push((number, operands.end));
        BoxedPart {
            around,
            others: 0..0,
        }
    };
    (0..).zip(parts).map(part).collect()
}

/// For each of a number of operands, the smallest part that contains it, or [`NONE`].
fn smallest_parts(parts: &PartBoxes, operands: u32) -> Vec<u32> {
    let mut smallest = vec![NONE; operands as usize];
    for (number, (operands, _)) in (0..).zip(parts) {
        smallest[operands.start as usize..operands.end as usize].fill(number);
    }
    smallest
}

/// Returns true if a node, inverse or not, can be merged into its parent.
fn is_part(node: &Node, is_inverse: bool, parent: Combine) -> bool {
    let is_same = match (parent, is_inverse) {
        (Combine::Intersection, true) => node.combine == Combine::Merge,
        (Combine::Merge, true) => node.combine == Combine::Intersection,
        (_, true) => false,
        (_, false) => node.combine == parent,
    };
    is_same && node.children > 0
}

fn index(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::program::Operand;
    use super::super::sweep::{RayInterval, Sweep, SweepContext};
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::{Ray, Step};
    use crate::scene::shape::{Cuboid, Plane, Shape, Sphere, Triangle};
    use crate::world::primitive::{Absorb, Extent};
    use glam::DVec3;

    /// A point on a coarse grid, so that surfaces coincide often.
    pub(in crate::world) fn coarse(rng: &mut Random) -> DVec3 {
        rng.vector(3.0).round()
    }

    fn shape(rng: &mut Random) -> Shape {
        let point = coarse(rng);
        match rng.bits() % 8 {
            0 => Shape::Plane(Plane::new(DVec3::AXES[usize::from(point.x > 0.0)], point.y)),
            1 => Shape::Triangle(Triangle {
                corners: [point, coarse(rng), coarse(rng)],
            }),
            2 | 3 => Shape::Sphere(Sphere {
                centre: point,
                radius: point.x.abs() + 1.0,
            }),
            _ => Shape::Cuboid(Cuboid::new(point, coarse(rng))),
        }
    }

    /// An unprepared program of random nodes and operands, and its leaves with their bounds.
    pub(in crate::world) fn random_program(
        rng: &mut Random,
    ) -> (CsgProgram, Vec<Leaf>, Vec<Bounds>) {
        let mut program = CsgProgram::default();
        for number in 0..1 + rng.bits() % 6 {
            let parent = match number {
                0 => NONE,
                _ => index(usize::try_from(rng.bits() % number).expect("few nodes")),
            };
            if parent != NONE {
                program.nodes[parent as usize].children += 1;
            }
            let kinds = [Combine::Union, Combine::Merge, Combine::Intersection];
            program.nodes.push(Node {
                combine: kinds[usize::try_from(rng.bits() % 3).expect("three")],
                is_inverse: number > 0 && rng.bits().is_multiple_of(3),
                children: 0,
                parent,
            });
        }
        let (mut leaves, mut bounds) = (Vec::new(), Vec::new());
        for _ in 0..2 + rng.bits() % 20 {
            let nodes = program.nodes.len();
            let parent = usize::try_from(rng.bits()).expect("64 bits") % nodes;
            program.nodes[parent].children += 1;
            program.operands.push(Operand {
                parent: index(parent),
                is_inverse: rng.bits().is_multiple_of(2),
                is_hidden: rng.bits().is_multiple_of(9),
            });
            let steps = [Step::Rotate(DVec3::new(0.0, 90.0, 0.0))];
            let steps = &steps[..usize::from(rng.bits().is_multiple_of(4))];
            let (leaf, around) = Leaf::new(shape(rng), steps, Absorb::AllItCan, 0, Extent::Solid);
            leaves.push(leaf);
            bounds.push(around);
        }
        program.rest = program.state_outside_all();
        program.order.others = (0..index(leaves.len())).collect();
        (program, leaves, bounds)
    }

    #[test]
    fn a_prepared_program_shows_the_same_surfaces() {
        let mut rng = Random::new(21);
        let mut sweep = Sweep::default();
        let (mut hits, mut trees, mut narrowed) = (0, 0, 0);
        for _ in 0..8000 {
            let (mut plain, leaves, bounds) = random_program(&mut rng);
            plain.leave_patches(&leaves);
            plain.rest = plain.state_outside_all();
            let mut prepared = plain.clone();
            prepared.prepare(&leaves, &bounds, Vec::new());
            trees += usize::from(prepared.order.boxed.is_some());
            narrowed += usize::from(!prepared.order.required.is_empty());
            for _ in 0..12 {
                let origin = coarse(&mut rng) * 2.0 + DVec3::splat(0.25);
                let ray = Ray::new(
                    origin,
                    (coarse(&mut rng) - origin * 0.5).normalize_or(DVec3::X),
                );
                let to = if rng.bits().is_multiple_of(2) {
                    f64::INFINITY
                } else {
                    4.0
                };
                let mut find = |program: &CsgProgram| {
                    let interval = RayInterval { from: 0.0, to };
                    program
                        .nearest(
                            SweepContext::free(&leaves, &ray),
                            interval,
                            &mut sweep,
                            |_| true,
                        )
                        .map(|hit| (hit.root, hit.leaf))
                };
                let expected = find(&plain);
                assert_eq!(find(&prepared), expected);
                hits += usize::from(expected.is_some());
            }
        }
        assert!(
            hits > 10_000 && trees > 300 && narrowed > 300,
            "{hits} {trees} {narrowed}"
        );
    }

    /// An unprepared union of parts, and its leaves with their bounds, and the parts with their boxes. A part is a cuboid
    /// between or beside planes, or a merge of two of them.
    pub(in crate::world) fn random_parts(
        rng: &mut Random,
        count: u64,
    ) -> (CsgProgram, Vec<Leaf>, Vec<Bounds>, PartBoxes) {
        let mut program = CsgProgram::default();
        let node = |program: &mut CsgProgram, combine, parent: u32| {
            if let Some(parent) = program.nodes.get_mut(parent as usize) {
                parent.children += 1;
            }
            program.nodes.push(Node {
                combine,
                is_inverse: false,
                children: 0,
                parent,
            });
            index(program.nodes.len() - 1)
        };
        let root = node(&mut program, Combine::Union, NONE);
        let (mut leaves, mut bounds, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..count {
            let is_merge = rng.bits().is_multiple_of(2);
            let group = match is_merge {
                true => node(&mut program, Combine::Merge, root),
                false => root,
            };
            let (first, mut around) = (program.len(), Bounds::EMPTY);
            for _ in 0..2 {
                let start = program.len();
                let own = node(&mut program, Combine::Intersection, group);
                // Off the grid: where faces of different parts coincide, they decide about each other.
                let (low, size) = (rng.vector(3.0), coarse(rng).abs() + 1.0);
                let cuboid = Shape::Cuboid(Cuboid::new(low, low + size));
                let plane = |axis: usize| Shape::Plane(Plane::new(DVec3::AXES[axis], low[axis]));
                for (number, shape) in [cuboid, plane(0), plane(2)].into_iter().enumerate() {
                    program.nodes[own as usize].children += 1;
                    program.operands.push(Operand {
                        parent: own,
                        is_inverse: number > 0 && rng.bits().is_multiple_of(2),
                        is_hidden: false,
                    });
                    let (leaf, own) = Leaf::new(shape, &[], Absorb::AllItCan, 0, Extent::Solid);
                    leaves.push(leaf);
                    bounds.push(own);
                }
                let own = bounds[start as usize];
                parts.push((start..program.len(), own));
                around = around.union(&own);
            }
            if is_merge {
                parts.push((first..program.len(), around));
            }
        }
        program.rest = program.state_outside_all();
        (program, leaves, bounds, parts)
    }

    #[test]
    fn parts_with_boxes_show_the_same_surfaces() {
        let mut rng = Random::new(33);
        let mut sweep = Sweep::default();
        let (mut hits, mut most) = (0, 0);
        for _ in 0..400 {
            let count = 1 + rng.bits() % 60;
            let (program, leaves, bounds, parts) = random_parts(&mut rng, count);
            let [mut plain, mut boxed] = [program.clone(), program];
            plain.prepare(&leaves, &bounds, Vec::new());
            boxed.prepare(&leaves, &bounds, parts);
            let own = boxed.order.boxed.as_ref();
            most = most.max(own.map_or(0, |own| own.parts.len()));
            for _ in 0..40 {
                let origin = coarse(&mut rng) * 2.0 + DVec3::splat(0.25);
                let towards = coarse(&mut rng) + rng.vector(0.5);
                let ray = Ray::new(origin, (towards - origin).normalize_or(DVec3::X));
                let from = rng.uniform() * 4.0;
                let to = from + 1.0 / rng.uniform();
                // The first of them are passed, as transparent ones are.
                let passed = rng.bits() % 6;
                let mut find = |program: &CsgProgram| {
                    let context = SweepContext::free(&leaves, &ray);
                    let (mut seen, interval) = (Vec::new(), RayInterval { from, to });
                    program.nearest(context, interval, &mut sweep, |hit| {
                        seen.push((hit.root, hit.leaf));
                        seen.len() as u64 > passed
                    });
                    seen.retain(|(root, _)| root.t <= to);
                    seen
                };
                let expected = find(&plain);
                assert_eq!(find(&boxed), expected);
                hits += expected.len();
            }
        }
        assert!(hits > 10_000 && most > 100, "{hits} {most}");
    }

    #[test]
    fn nested_differences_become_one_intersection() {
        let mut program = CsgProgram::default();
        for parent in [NONE, 0, 1, 2] {
            program.nodes.push(Node {
                combine: if parent == NONE {
                    Combine::Union
                } else {
                    Combine::Intersection
                },
                is_inverse: false,
                children: 2 - u32::from(parent == NONE),
                parent,
            });
        }
        for (parent, is_inverse) in [(3, false), (3, true), (2, true), (1, true)] {
            program.operands.push(Operand {
                parent,
                is_inverse,
                is_hidden: false,
            });
        }
        let sphere = Shape::Sphere(Sphere {
            centre: DVec3::ZERO,
            radius: 1.0,
        });
        let (leaf, bounds) = Leaf::new(sphere, &[], Absorb::AllItCan, 0, Extent::Solid);
        program.prepare(&vec![leaf; 4], &[bounds; 4], Vec::new());
        assert_eq!(program.nodes.len(), 1);
        assert_eq!(program.nodes[0].children, 4);
        assert_eq!(program.order.required[..], [0]);
        assert_eq!(program.rest.counts[..], [3]);
    }
}
