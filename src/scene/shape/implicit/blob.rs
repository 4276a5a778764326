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
mod reach;

use self::component::{Component, Part, Parts};
use self::reach::Reach;
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::roots::quartic::quartic_changes_between;
use crate::base::math::simd::with_widest;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Crossings, FaceTexture, Geometry, Root, Start, TextureWeight, TextureWeights,
};
use crate::scene::shape::{first_visible, read};
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// POV-Ray's, for a blob without `threshold`.
const THRESHOLD: f64 = 1.0;
/// With fewer components each is asked by itself.
const TREE_FROM: usize = 8;

/// A sum of bounds on fields is right to more than this, as a share of the threshold.
const LOW: f64 = 1.0 - 1e-9;

/// Some of the parts, one bit each.
type Bits = SmallVec<[u64; 2]>;
/// Bits of one number of them.
const WORD: usize = 64;

/// A surface of equal field. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Blob(Arc<Field>);

#[derive(Clone, Debug)]
struct Field {
    components: Vec<Component>,
    /// The textures that components have of their own.
    skins: Vec<FaceTexture>,
    threshold: f64,
    bounds: Bounds,
    tree: Option<Bvh>,
    /// The balls around components that are not too many, in the order in which they are visited.
    reach: Option<Reach>,
    order: Vec<u32>,
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
                    component.skin =
                        u32::try_from(skins.len()).unwrap_or(TextureWeight::OF_THE_OBJECT);
                    skins.push(FaceTexture(Arc::new(texture)));
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

    fn new(components: Vec<Component>, skins: Vec<FaceTexture>, threshold: f64) -> Self {
        let boxes: Vec<Bounds> = components.iter().map(Component::bounds).collect();
        let reach = |sign: f64| {
            let some = components.iter().zip(&boxes);
            some.filter(|(component, _)| sign * component.strength > 0.0)
                .fold(Bounds::EMPTY, |sum, (_, bounds)| sum.union(bounds))
        };
        // Only what adds can lift the field above a threshold that it is not above anyway.
        let bounds = reach(if threshold < 0.0 { -1.0 } else { 1.0 });
        let tree = (components.len() >= TREE_FROM).then(|| Bvh::build(&boxes));
        let order = match &tree {
            Some(tree) => tree.order(),
            None => (0..).zip(&components).map(|(number, _)| number).collect(),
        };
        let visited = order.iter().map(|&number| &components[number as usize]);
        let reach = Reach::new(visited);
        Blob(Arc::new(Field {
            components,
            skins,
            threshold,
            bounds,
            tree,
            reach,
            order,
        }))
    }
}

impl Field {
    /// Gathers the parts of components that the line of a ray passes.
    fn gather(&self, ray: &Ray, parts: &mut Parts) {
        if let Some(reach) = &self.reach {
            let mut met = with_widest(|lanes| reach.met(lanes, ray));
            while let Some(&number) = self.order.get(met.trailing_zeros() as usize) {
                met &= met - 1;
                self.components[number as usize].parts(ray, parts);
            }
            return;
        }
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
        // Summed in another order than those of a stretch.
        if parts.iter().map(Part::most).sum::<f64>() < LOW * LOW * self.threshold {
            return roots;
        }
        let ends = Ends::new(&parts);
        let mut at = 0;
        let (mut here, mut next) = (Covering::none_of(&parts), Covering::none_of(&parts));
        let (mut low, mut starts_inside) = (f64::NEG_INFINITY, self.is_inside(0.0));
        while let Some(joint) = ends.place(at) {
            if low >= to || roots.last().is_some_and(|root| root.t > enough) {
                break;
            }
            next.covers.copy_from_slice(&here.covers);
            at = ends.cross(at, &mut next.covers);
            next.bound(&parts);
            // None is looked at that ends before the ray begins.
            if joint > from || ends.place(at).is_some_and(|end| end > from) {
                let ends_inside = self.is_inside_at(&parts, (&here, &next), joint);
                let is_empty = here.is_empty() || joint <= from;
                let is_outside = !starts_inside && !ends_inside && self.is_too_low(here.most);
                if !is_empty && !is_outside {
                    let sides = (starts_inside, ends_inside);
                    self.solve((&parts, &here), (low, joint), sides, &mut roots);
                }
                starts_inside = ends_inside;
            }
            low = joint;
            std::mem::swap(&mut here, &mut next);
        }
        roots
    }

    /// The side at the joint of two stretches.
    fn is_inside_at(
        &self,
        parts: &[Part],
        (before, behind): (&Covering, &Covering),
        joint: f64,
    ) -> bool {
        if before.is_empty() || behind.is_empty() {
            return self.is_inside(0.0);
        }
        if self.is_too_low(before.most) {
            return false;
        }
        let mut field = 0.0;
        before.each(parts, |part| field += part.field(joint));
        self.is_inside(field)
    }

    /// Tells whether a field that is nowhere above this is nowhere above the threshold, by more than rounding.
    fn is_too_low(&self, most: f64) -> bool {
        most < LOW * self.threshold
    }

    fn solve(
        &self,
        (parts, here): (&[Part], &Covering),
        (low, high): (f64, f64),
        (starts_inside, ends_inside): (bool, bool),
        roots: &mut Crossings,
    ) {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // How much the field lacks.
        let mut quartic = [self.threshold, 0.0, 0.0, 0.0, 0.0];
        here.each(parts, |part| part.take_from(&mut quartic, middle, half));
        let mut is_inside = starts_inside;
        for place in quartic_changes_between(&quartic, starts_inside, ends_inside) {
            roots.push(Root::on_smooth(middle + half * place, is_inside));
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

/// The parts that cover a stretch.
struct Covering {
    covers: Bits,
    /// Nowhere the field is above this.
    most: f64,
}

impl Covering {
    fn none_of(parts: &[Part]) -> Self {
        Covering {
            covers: Bits::from_elem(0, parts.len().div_ceil(WORD)),
            most: 0.0,
        }
    }

    fn is_empty(&self) -> bool {
        self.covers.iter().all(|word| *word == 0)
    }

    fn bound(&mut self, parts: &[Part]) {
        let mut most = 0.0;
        self.each(parts, |part| most += part.most());
        self.most = most;
    }

    /// In the order of their numbers.
    #[inline(always)]
    fn each(&self, parts: &[Part], mut visit: impl FnMut(&Part)) {
        for (&word, first) in self.covers.iter().zip((0..).step_by(WORD)) {
            let mut left = word;
            while left != 0 {
                visit(&parts[first + left.trailing_zeros() as usize]);
                left &= left - 1;
            }
        }
    }
}

/// Where parts begin and end on a ray, in order.
struct Ends(SmallVec<[(f64, u32); 24]>);

impl Ends {
    fn new(parts: &[Part]) -> Self {
        let mut ends: SmallVec<[(f64, u32); 24]> = SmallVec::with_capacity(2 * parts.len());
        for (part, number) in parts.iter().zip(0..) {
            ends.push((part.from, number));
            ends.push((part.to, number));
        }
        ends.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        Ends(ends)
    }

    fn place(&self, at: usize) -> Option<f64> {
        self.0.get(at).map(|end| end.0)
    }

    /// Goes past all ends at one place: what begins there covers what follows, and what ends there does not.
    fn cross(&self, mut at: usize, covers: &mut [u64]) -> usize {
        let Some(joint) = self.place(at) else {
            return at;
        };
        while let Some(&(place, number)) = self.0.get(at)
            && place == joint
        {
            covers[number as usize / WORD] ^= 1 << (number as usize % WORD);
            at += 1;
        }
        at
    }
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

    fn roots_from(&self, ray: &Ray, from: f64, enough: f64, roots: &mut Vec<Root>) -> bool {
        let ahead = (from, f64::INFINITY);
        roots.extend(self.0.crossings(ray, ahead, enough));
        false
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

    fn skins(&self) -> &[FaceTexture] {
        &self.0.skins
    }

    /// Each component has a share as large as its field there, whether it adds or takes away.
    fn shares(&self, point: DVec3, _: u32) -> TextureWeights {
        let mut shares = TextureWeights::new();
        if self.0.skins.is_empty() {
            return shares;
        }
        let mut sum = 0.0;
        self.0.around(point, |component| {
            let weight = component.field(point).abs();
            if weight > 0.0 {
                let skin = component.skin;
                shares.push(TextureWeight { weight, skin });
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
