//! `blob { threshold, spheres and cylinders of a field }`: the isosurface at which the sum of all fields equals the
//! threshold.
//!
//! A component has the field `strength · (1 − d²)²`, where `d` is the distance from its centre (of a cylinder: from the
//! segment between its ends) in units of its radius, and none where `d > 1`. Along a ray `d²` is quadratic, so that the
//! sum is a quartic on each interval between two neighbouring joints: the points where the ray enters or leaves a
//! component, or passes an end of a cylinder. Each interval is mapped to -1..1. Neighbouring intervals share the sign
//! of the field at their joint, so that no root is lost there. Error bound: roots lie within 2 roundings of the
//! problem's size from the surface, where the gradient of the field is not zero (`shape/roundings.rs`).
//!
//! With a negative threshold the solid is everything outside the surface (checked with POV-Ray).

mod component;
mod reach;

use self::component::{Component, Segment, Segments};
use self::reach::{BoundingSpheres, Part};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::roots::quartic::quartic_changes_between;
use crate::base::math::simd::with_widest;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Crossings, FaceTexture, Geometry, Root, Start, SurfaceSide, TextureWeight, TextureWeights,
};
use crate::scene::shape::{first_visible, read};
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// POV-Ray's threshold for a blob without `threshold`.
const THRESHOLD: f64 = 1.0;
/// Fields below the threshold by less than this are inside in POV-Ray (measured by bisection).
const INSIDE_TOLERANCE: f64 = 1e-6;
/// Blobs with fewer components have no BVH.
const MIN_COMPONENTS_FOR_BVH: usize = 8;

/// Relative safety margin for a sum of field bounds, above its rounding error.
const SAFETY: f64 = 1.0 - 1e-9;

/// Set of segments, one bit each.
type Bits = SmallVec<[u64; 2]>;
/// Bits per word of [`Bits`].
const WORD: usize = 64;

/// An isosurface of the field. It is one smooth piece, face 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Blob(Arc<Field>);

#[derive(Clone, Debug)]
struct Field {
    components: Vec<Component>,
    /// Textures of single components.
    textures: Vec<FaceTexture>,
    threshold: f64,
    bounds: Bounds,
    bvh: Option<Bvh>,
    /// Bounding spheres, if there are not too many components, in the order of `order`.
    spheres: Option<BoundingSpheres>,
    order: Vec<u32>,
}

impl PartialEq for Field {
    /// The other fields follow from these.
    fn eq(&self, other: &Self) -> bool {
        self.components == other.components
            && self.textures == other.textures
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
        let mut textures = Vec::new();
        loop {
            if args.accept(Word::Threshold)? {
                threshold = read::number(args, "the threshold of the blob")?;
            } else if let Some((mut component, texture)) = Component::read(args)? {
                if let Some(texture) = texture {
                    component.skin =
                        u32::try_from(textures.len()).unwrap_or(TextureWeight::OF_THE_OBJECT);
                    textures.push(FaceTexture(Arc::new(texture)));
                }
                components.push(component);
            } else {
                break;
            }
        }
        if components.is_empty() {
            if args.at_mark(',')? {
                return Err(args.expected("a component or `}` in `blob`"));
            }
            let error = Diagnostic::error(args.span(), "need at least one component in a blob")
                .with_hint("Write `sphere { <centre>, radius, strength }` after the threshold.");
            return Err(Box::new(error));
        }
        Ok(Blob::new(components, textures, threshold))
    }

    /// The sum of the fields of all components at a point.
    pub(crate) fn field(&self, point: DVec3) -> f64 {
        let mut field = 0.0;
        self.0
            .around(point, |component| field += component.field(point));
        field
    }

    /// The field on the surface.
    pub(crate) fn threshold(&self) -> f64 {
        self.0.threshold
    }

    fn new(components: Vec<Component>, textures: Vec<FaceTexture>, threshold: f64) -> Self {
        let boxes: Vec<Bounds> = components.iter().map(Component::bounds).collect();
        let union_of = |sign: f64| {
            let some = components.iter().zip(&boxes);
            some.filter(|(component, _)| sign * component.strength > 0.0)
                .fold(Bounds::EMPTY, |sum, (_, bounds)| sum.union(bounds))
        };
        // Only components of the right sign can lift the field above the threshold.
        let bounds = union_of(if threshold < 0.0 { -1.0 } else { 1.0 });
        let bvh = (components.len() >= MIN_COMPONENTS_FOR_BVH).then(|| Bvh::build(&boxes));
        let order = match &bvh {
            Some(bvh) => bvh.visit_order(),
            None => (0..).zip(&components).map(|(number, _)| number).collect(),
        };
        let ordered = order.iter().map(|&number| &components[number as usize]);
        let spheres = BoundingSpheres::new(ordered, threshold);
        Blob(Arc::new(Field {
            components,
            textures,
            threshold,
            bounds,
            bvh,
            spheres,
            order,
        }))
    }

    /// A `t` up to which a ray that leaves the surface outward certainly does not hit it again; `None` if unknown.
    pub(crate) fn departure(&self, ray: &Ray) -> Option<f64> {
        let spheres = self.0.spheres.as_ref().filter(|spheres| spheres.is_plain);
        let line = spheres?.line(ray)?;
        with_widest(
            #[inline(always)]
            |lanes| line.departure(lanes),
        )
    }
}

impl Field {
    /// Collects the segments of the ray inside the components; of those with bounding spheres only in the ones of a bit
    /// mask.
    #[inline(always)]
    fn gather(&self, ray: &Ray, mut reached: u64, segments: &mut Segments) {
        if self.spheres.is_some() {
            while let Some(&number) = self.order.get(reached.trailing_zeros() as usize) {
                reached &= reached - 1;
                self.components[number as usize].segments(ray, segments);
            }
            return;
        }
        match &self.bvh {
            None => {
                for component in &self.components {
                    component.segments(ray, segments);
                }
            }
            Some(bvh) => {
                bvh.any(ray, f64::NEG_INFINITY, f64::INFINITY, |number| {
                    self.components[number as usize].segments(ray, segments);
                    false
                });
            }
        }
    }

    /// Roots of a ray in the intervals that overlap `from..to`, perhaps with some outside; roots after the first one
    /// beyond `enough` may be missing, with `skips` also some before.
    fn crossings(&self, ray: &Ray, [from, to, enough]: [f64; 3], skips: bool) -> Crossings {
        let mut roots = Crossings::new();
        let spheres = self.spheres.as_ref();
        let line = spheres.and_then(|spheres| spheres.line(ray));
        let is_plain = spheres.is_some_and(|spheres| spheres.is_plain);
        let scanned = (is_plain && enough < f64::INFINITY).then_some(enough);
        with_widest(
            #[inline(always)]
            |lanes| {
                let part = match &line {
                    Some(line) => line.part(lanes, [from, to], scanned, skips),
                    None => Some(Part {
                        from,
                        to,
                        reached: u64::MAX,
                    }),
                };
                if let Some(part) = part {
                    self.find_crossings(ray, &part, enough, &mut roots);
                }
            },
        );
        roots
    }

    #[inline(always)]
    fn find_crossings(&self, ray: &Ray, part: &Part, enough: f64, roots: &mut Crossings) {
        let Part { from, to, reached } = *part;
        let mut segments = Segments::new();
        self.gather(ray, reached, &mut segments);
        let segments = &segments[..];
        // The safety factor is squared since this sum has another order than the sum of an interval.
        if segments.iter().map(Segment::max_field).sum::<f64>() < SAFETY * SAFETY * self.threshold {
            return;
        }
        // Their ends, sorted, each with the index of its segment.
        let mut ends: SmallVec<[(f64, u32); 24]> = SmallVec::new();
        for (segment, number) in segments.iter().zip(0..) {
            ends.push((segment.from, number));
            ends.push((segment.to, number));
        }
        ends.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut bits = Bits::from_elem(0, segments.len().div_ceil(WORD));
        let mut active = ActiveSegments::none(&mut bits);
        let (mut interval_start, mut starts_inside) = (f64::NEG_INFINITY, self.is_inside(0.0));
        let mut rest = &ends[..];
        while let Some(&(joint, _)) = rest.first() {
            if interval_start >= to || roots.last().is_some_and(|root| root.t > enough) {
                break;
            }
            let at_joint = rest.iter().take_while(|end| end.0 == joint).count();
            let (at_joint, behind) = rest.split_at(at_joint);
            rest = behind;
            // Skip intervals that end before the ray begins.
            if joint > from || rest.first().is_some_and(|end| end.0 > from) {
                let is_gap = active.len == 0;
                let max_field = active.max_field(segments);
                let ends_inside = if is_gap || active.len_behind(at_joint) == 0 {
                    self.is_inside(0.0)
                } else {
                    !self.is_surely_below(max_field)
                        && self.is_inside(active.field(segments, joint))
                };
                let is_outside = !starts_inside && !ends_inside && self.is_surely_below(max_field);
                if !is_gap && joint > from && !is_outside {
                    let interval = Interval {
                        low: interval_start,
                        high: joint,
                        starts_inside,
                        ends_inside,
                    };
                    self.solve(segments, &active, &interval, roots);
                }
                starts_inside = ends_inside;
            }
            interval_start = joint;
            active.pass(at_joint);
        }
    }

    /// True if a field bounded by `max_field` is below the threshold, by more than rounding.
    fn is_surely_below(&self, max_field: f64) -> bool {
        max_field < SAFETY * self.threshold
    }

    #[inline(always)]
    fn solve(
        &self,
        segments: &[Segment],
        active: &ActiveSegments,
        interval: &Interval,
        roots: &mut Crossings,
    ) {
        let Interval {
            low,
            high,
            starts_inside,
            ends_inside,
        } = *interval;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // Threshold minus field.
        let mut quartic = [self.threshold, 0.0, 0.0, 0.0, 0.0];
        active.each_segment(segments, |segment| {
            segment.subtract_from(&mut quartic, middle, half)
        });
        let mut is_exit = starts_inside;
        for x in quartic_changes_between(&quartic, starts_inside, ends_inside) {
            roots.push(Root::on_smooth(middle + half * x, is_exit));
            is_exit = !is_exit;
        }
    }

    fn is_inside(&self, field: f64) -> bool {
        field > self.threshold
    }

    /// Visits the components whose field may reach a point.
    fn around(&self, point: DVec3, mut visit: impl FnMut(&Component)) {
        match &self.bvh {
            None => self.components.iter().for_each(visit),
            Some(bvh) => {
                bvh.visit_containing(point, |number| {
                    visit(&self.components[number as usize]);
                    false
                });
            }
        }
    }
}

/// An interval between two joints of a ray, with the inside state at both.
struct Interval {
    low: f64,
    high: f64,
    starts_inside: bool,
    ends_inside: bool,
}

/// The segments that overlap an interval.
struct ActiveSegments<'a> {
    bits: &'a mut [u64],
    len: usize,
}

impl<'a> ActiveSegments<'a> {
    fn none(bits: &'a mut [u64]) -> Self {
        ActiveSegments { bits, len: 0 }
    }

    fn contains(&self, number: u32) -> bool {
        self.bits[number as usize / WORD] >> (number as usize % WORD) & 1 == 1
    }

    /// Number of the segments behind a joint with these ends.
    fn len_behind(&self, joint: &[(f64, u32)]) -> usize {
        let closing = joint.iter().filter(|end| self.contains(end.1)).count();
        self.len + joint.len() - 2 * closing
    }

    /// Passes all ends at one joint: segments that begin there become active, segments that end there inactive.
    fn pass(&mut self, joint: &[(f64, u32)]) {
        self.len = self.len_behind(joint);
        for &(_, number) in joint {
            self.bits[number as usize / WORD] ^= 1 << (number as usize % WORD);
        }
    }

    /// Upper bound of the field.
    fn max_field(&self, segments: &[Segment]) -> f64 {
        let mut max_field = 0.0;
        self.each_segment(segments, |segment| max_field += segment.max_field());
        max_field
    }

    /// The field at `t`.
    fn field(&self, segments: &[Segment], t: f64) -> f64 {
        let mut field = 0.0;
        self.each_segment(segments, |segment| field += segment.field(t));
        field
    }

    /// Visits the segments in the order of their indices.
    #[inline(always)]
    fn each_segment(&self, segments: &[Segment], mut visit: impl FnMut(&Segment)) {
        for (&word, first) in self.bits.iter().zip((0..).step_by(WORD)) {
            let mut remaining = word;
            while remaining != 0 {
                visit(&segments[first + remaining.trailing_zeros() as usize]);
                remaining &= remaining - 1;
            }
        }
    }
}

impl Geometry for Blob {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let all = [f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];
        roots.extend_from_slice(&self.0.crossings(ray, all, false));
        if self.0.is_inside(0.0) {
            Start::Inside
        } else {
            Start::Outside
        }
    }

    fn roots_from(&self, ray: &Ray, from: f64, enough: f64, roots: &mut Vec<Root>) -> bool {
        roots.extend_from_slice(&self.0.crossings(ray, [from, f64::INFINITY, enough], false));
        false
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.0.crossings(ray, [from, to, from], true), from, to)
    }

    fn is_exiting(&self, ray: &Ray) -> bool {
        self.departure(ray) == Some(f64::INFINITY)
    }

    /// Rays may pass a component on all sides.
    fn exits_in_cones(&self) -> bool {
        false
    }

    fn moves_face_textures(&self) -> bool {
        true
    }

    fn casts_shadow_of_outside(&self) -> bool {
        true
    }

    fn has_one_side(&self) -> bool {
        !self.face_textures().is_empty()
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
        self.0.is_inside(self.field(point) + INSIDE_TOLERANCE)
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Inside
    }

    fn keeps_its_box(&self) -> bool {
        true
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

    fn face_textures(&self) -> &[FaceTexture] {
        &self.0.textures
    }

    /// Each component is weighted by its field at the point, whether it adds or subtracts.
    fn texture_weights(&self, point: DVec3, _: u32) -> TextureWeights {
        let mut weights = TextureWeights::new();
        if self.0.textures.is_empty() {
            return weights;
        }
        let mut sum = 0.0;
        self.0.around(point, |component| {
            let weight = component.field(point).abs();
            if weight > 0.0 {
                let skin = component.skin;
                weights.push(TextureWeight {
                    weight,
                    texture: skin,
                });
                sum += weight;
            }
        });
        for entry in &mut weights {
            entry.weight /= sum;
        }
        weights
    }

    fn takes_sturm(&self) -> bool {
        true
    }

    fn takes_hierarchy(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
