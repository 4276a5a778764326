//! `blob { threshold, spheres and cylinders of a field }`: where the sum of all fields exceeds the threshold.
//!
//! A component has the field `strength · (1 − d²)²`, where `d` is the distance from its centre (of a cylinder: from the
//! stretch between its ends) in units of its radius, and none where `d > 1`. Along a ray `d²` is quadratic, so that
//! between the places where the ray enters or leaves a component, or passes an end of a cylinder, the sum is a quartic.
//! Each such stretch is centred and scaled to -1..1. Neighbouring stretches share the sign of the field, taken at the
//! place between them, so that no root is lost there. Error bound: roots lie within 2 roundings of the problem's size from
//! the surface, where the field does not stand still (`shape/roundings.rs`).
//!
//! Where the threshold is negative the solid is everything outside the surface (checked with POV-Ray).

mod component;

use self::component::{Component, Part, Parts};
use super::{Crossing, Crossings, Geometry, Root, Share, Shares, Skin, Start};
use super::{first_visible, read};
use crate::accel::Bvh;
use crate::args::{Args, Parse, Word};
use crate::math::polynomial::{is_quartic_positive, sign_changes_between};
use crate::math::{Bounds, Ray, Step};
use crate::source::Diagnostic;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// POV-Ray's, for a blob without `threshold`.
const THRESHOLD: f64 = 1.0;
/// With fewer components each is asked by itself.
const TREE_FROM: usize = 8;

/// The numbers of the parts that cover a stretch.
type Here = SmallVec<[u32; 16]>;

/// A surface of equal field. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Blob(Arc<Field>);

#[derive(Clone, Debug)]
struct Field {
    components: Vec<Component>,
    /// The textures that components have of their own.
    skins: Vec<Skin>,
    threshold: f64,
    bounds: Bounds,
    tree: Option<Bvh>,
}

impl PartialEq for Field {
    /// The rest follows.
    fn eq(&self, other: &Self) -> bool {
        self.components == other.components
            && self.skins == other.skins
            && self.threshold == other.threshold
    }
}

impl Blob {
    /// Reads components and `threshold`, in any order.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, a cylinder without length, no component at all.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let mut threshold = THRESHOLD;
        let mut components = Vec::new();
        let mut skins = Vec::new();
        loop {
            if args.accept(Word::Threshold)? {
                threshold = read::number(args, "the threshold of the blob")?;
            } else if let Some((mut component, texture)) = Component::read(args)? {
                if let Some(texture) = texture {
                    component.skin = u32::try_from(skins.len()).unwrap_or(Share::OF_THE_OBJECT);
                    skins.push(Skin(Arc::new(texture)));
                }
                components.push(component);
            } else {
                break;
            }
        }
        if components.is_empty() {
            let error = Diagnostic::error(args.span(), "need at least one component in a blob")
                .with_hint("write `sphere { <centre>, radius, strength }` behind the threshold");
            return Err(Box::new(error));
        }
        Ok(Blob::new(components, skins, threshold))
    }

    fn new(components: Vec<Component>, skins: Vec<Skin>, threshold: f64) -> Self {
        let boxes: Vec<Bounds> = components.iter().map(Component::bounds).collect();
        let reach = |sign: f64| {
            let some = components.iter().zip(&boxes);
            some.filter(|(component, _)| sign * component.strength > 0.0)
                .fold(Bounds::EMPTY, |sum, (_, bounds)| sum.union(bounds))
        };
        // Only what adds can lift the field above a threshold that it is not above anyway.
        let bounds = reach(if threshold < 0.0 { -1.0 } else { 1.0 });
        let tree = (components.len() >= TREE_FROM).then(|| Bvh::build(&boxes));
        Blob(Arc::new(Field {
            components,
            skins,
            threshold,
            bounds,
            tree,
        }))
    }
}

impl Field {
    /// Gathers the parts of components that the line of a ray passes.
    fn gather(&self, ray: &Ray, parts: &mut Parts) {
        match &self.tree {
            None => {
                for component in &self.components {
                    component.parts(ray, parts);
                }
            }
            Some(tree) => {
                tree.any(ray, f64::NEG_INFINITY, f64::INFINITY, |number| {
                    self.components[number as usize].parts(ray, parts);
                    false
                });
            }
        }
    }

    /// The roots on the stretches of a ray between `from` and `to`, with perhaps some outside; what comes behind a root
    /// beyond `enough` may be missing.
    fn crossings(&self, ray: &Ray, (from, to): (f64, f64), enough: f64) -> Crossings {
        let mut roots = Crossings::new();
        let mut parts = Parts::new();
        self.gather(ray, &mut parts);
        // Where one begins or ends, in order.
        let mut stops: SmallVec<[f64; 24]> = SmallVec::new();
        for part in &parts {
            stops.extend_from_slice(&[part.from, part.to]);
        }
        stops.sort_unstable_by(f64::total_cmp);
        stops.dedup();
        let is_met = |high: &f64| *high > from;
        let Some(first) = stops.iter().skip(1).position(is_met) else {
            return roots;
        };
        // None cover a gap, and none what lies outside.
        let covering = |number: usize, here: &mut Here| {
            here.clear();
            if let Some(&[low, high]) = stops.get(number..).and_then(<[f64]>::first_chunk) {
                let numbers = parts.iter().zip(0..);
                let covering = numbers.filter(|(part, _)| part.covers(low, high));
                here.extend(covering.map(|(_, number)| number));
            }
        };
        // The side at the joint of two stretches.
        let is_inside = |before: &Here, behind: &Here, joint: f64| {
            if before.is_empty() || behind.is_empty() {
                return self.is_inside(0.0);
            }
            self.is_inside(parts_of(&parts, before).map(|part| part.field(joint)).sum())
        };
        let (mut here, mut next) = (Here::new(), Here::new());
        if let Some(before) = first.checked_sub(1) {
            covering(before, &mut here);
        }
        covering(first, &mut next);
        let mut starts_inside = is_inside(&here, &next, stops[first]);
        for (number, pair) in stops.windows(2).enumerate().skip(first) {
            let (low, high) = (pair[0], pair[1]);
            if low >= to || roots.last().is_some_and(|root| root.t > enough) {
                break;
            }
            std::mem::swap(&mut here, &mut next);
            covering(number + 1, &mut next);
            let ends_inside = is_inside(&here, &next, high);
            if !here.is_empty() {
                let sides = (starts_inside, ends_inside);
                self.solve(parts_of(&parts, &here), (low, high), sides, &mut roots);
            }
            starts_inside = ends_inside;
        }
        roots
    }

    fn solve<'p>(
        &self,
        parts: impl Iterator<Item = &'p Part>,
        (low, high): (f64, f64),
        (starts_inside, ends_inside): (bool, bool),
        roots: &mut Crossings,
    ) {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // How much the field lacks.
        let mut quartic = [self.threshold, 0.0, 0.0, 0.0, 0.0];
        for part in parts {
            part.take_from(&mut quartic, middle, half);
        }
        if !starts_inside && !ends_inside && is_quartic_positive(&quartic) {
            return;
        }
        let mut is_inside = starts_inside;
        for place in sign_changes_between(&quartic, starts_inside, ends_inside) {
            roots.push(Root {
                t: middle + half * place,
                crossing: if is_inside {
                    Crossing::Leave
                } else {
                    Crossing::Enter
                },
                face: 0,
                is_visible: true,
            });
            is_inside = !is_inside;
        }
    }

    fn is_inside(&self, field: f64) -> bool {
        field > self.threshold
    }

    /// The components that may reach a point.
    fn around(&self, point: DVec3, mut visit: impl FnMut(&Component)) {
        match &self.tree {
            None => self.components.iter().for_each(visit),
            Some(tree) => {
                tree.around(point, |number| {
                    visit(&self.components[number as usize]);
                    false
                });
            }
        }
    }
}

/// The parts of these numbers.
fn parts_of<'p>(parts: &'p Parts, numbers: &'p Here) -> impl Iterator<Item = &'p Part> {
    numbers.iter().map(|&number| &parts[number as usize])
}

impl Geometry for Blob {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        roots.extend(self.0.crossings(ray, everywhere, f64::INFINITY));
        if self.0.is_inside(0.0) {
            Start::Inside
        } else {
            Start::Outside
        }
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.0.crossings(ray, (from, to), from), from, to)
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        let mut normal = DVec3::ZERO;
        self.0
            .around(point, |component| normal += component.outward(point));
        if normal == DVec3::ZERO {
            DVec3::X
        } else {
            normal
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let mut field = 0.0;
        self.0
            .around(point, |component| field += component.field(point));
        self.0.is_inside(field)
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn solid_bounds(&self) -> Bounds {
        if self.0.is_inside(0.0) {
            Bounds::EVERYTHING
        } else {
            self.0.bounds
        }
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn skins(&self) -> &[Skin] {
        &self.0.skins
    }

    /// Each component has a share as large as its field there, whether it adds or takes away.
    fn shares(&self, point: DVec3, _: u32) -> Shares {
        let mut shares = Shares::new();
        if self.0.skins.is_empty() {
            return shares;
        }
        let mut sum = 0.0;
        self.0.around(point, |component| {
            let weight = component.field(point).abs();
            if weight > 0.0 {
                let skin = component.skin;
                shares.push(Share { weight, skin });
                sum += weight;
            }
        });
        for share in &mut shares {
            share.weight /= sum;
        }
        shares
    }
}

#[cfg(test)]
mod tests;
