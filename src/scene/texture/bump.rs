//! Bump mapping: `normal` prepared for rendering (Blinn, "Simulation of Wrinkled Surfaces", 1978).

use super::numbers::single;
use super::{Facets, Layer, Normal, NormalKind};
use crate::base::bitmap;
use crate::base::math::Step;
use crate::base::math::noise::vector_noise;
use crate::scene::pattern::{
    Between, Map, Modifiers, NormalTransforms, PreparedPattern, PreparedWarpChain, Settings,
    SurfacePoint, nearest_feature,
};
use glam::{DVec2, DVec3};

/// The corners of a tetrahedron around a point, at which a pattern is sampled for its slope.
const CORNERS: [DVec3; 4] = [
    DVec3::new(0.942_809_041, -0.333_333_333, 0.0),
    DVec3::new(-0.471_404_521, -0.333_333_333, 0.816_496_581),
    DVec3::new(-0.471_404_521, -0.333_333_333, -0.816_496_581),
    DVec3::new(0.0, 1.0, 0.0),
];
/// The factor on the slope between these samples.
const SLOPE: f64 = -5.0;
/// The distance between samples at which the slope is not scaled.
const UNIT_ACCURACY: f64 = 0.02;
/// The smallest size of `facets`.
const MIN_FACET_SIZE: f64 = 1e-6;

/// A prepared normal.
#[derive(Debug)]
pub struct PreparedNormal {
    relief: Relief,
    /// The transforms of normals by the texture maps around this normal.
    outer: NormalTransforms,
    /// The transforms of normals by the modifiers of this normal.
    transforms: NormalTransforms,
    /// The height of the bumps, and the distance between samples of a slope: in POV-Ray of single precision.
    amount: f64,
    accuracy: f64,
    /// True if normals are normalized after each transform to the pattern, so that scaled bumps keep their slope.
    is_unit: bool,
}

#[derive(Debug)]
enum Relief {
    /// No bumps.
    Flat,
    /// The values of a pattern, or the pattern's own formula for normals.
    Pattern(PreparedPattern),
    /// The values of a pattern, mapped by a `slope_map` of heights and slopes.
    Slopes(PreparedPattern, Map<DVec2>),
    /// A pattern that selects among normals.
    Normals(PreparedPattern, Map<PreparedNormal>),
    /// The weighted mean of normals.
    Average(PreparedWarpChain, Map<PreparedNormal>),
    /// The brightness of an image.
    Image(PreparedWarpChain, bitmap::MappedBitmap),
    /// Flat faces.
    Facets(PreparedWarpChain, Facets),
    /// Other bumps, evaluated at the texture coordinates.
    Uv(Box<PreparedNormal>),
}

impl PreparedNormal {
    /// Prepares a normal for rendering. `after` are transforms that follow the normal's own. `None` if it has no bumps.
    #[must_use]
    pub fn new(normal: &Normal, after: &[Step], settings: &Settings) -> Option<Self> {
        PreparedNormal::within_normal(normal, after, settings, true)
    }

    /// Prepares the normal of a layer.
    pub(super) fn of_layer(layer: &Layer, after: &[Step], settings: &Settings) -> Option<Self> {
        let is_unit = !layer.has_no_bump_scale;
        PreparedNormal::within_normal(layer.normal.as_ref()?, after, settings, is_unit)
    }

    /// Prepares a normal or an entry of its map. `no_bump_scale` of a map holds for all its entries (measured with
    /// POV-Ray).
    fn within_normal(
        normal: &Normal,
        after: &[Step],
        settings: &Settings,
        is_unit: bool,
    ) -> Option<Self> {
        let is_unit = is_unit && !normal.has_no_bump_scale;
        let modifiers: &Modifiers = &normal.modifiers;
        let chain = || modifiers.prepare_chain(after, settings);
        let pattern = |pattern| modifiers.prepare(pattern, after, settings);
        // No other transforms act on the entries of a map.
        let entry = |normal: &Normal| {
            PreparedNormal::within_normal(normal, &[], settings, is_unit)
                .unwrap_or_else(PreparedNormal::flat)
        };
        let relief = match &normal.kind {
            NormalKind::None | NormalKind::Average(None) => return None,
            NormalKind::Pattern(of) => Relief::Pattern(pattern(&**of)),
            NormalKind::Slopes(of, map) => Relief::Slopes(pattern(&**of), map.clone()),
            NormalKind::Normals(of, map) => {
                Relief::Normals(pattern(&**of), map.map(|normal| entry(normal)))
            }
            NormalKind::Average(Some(map)) => {
                Relief::Average(chain(), map.map(|normal| entry(normal)))
            }
            NormalKind::Image(source) => Relief::Image(chain(), source.clone()),
            NormalKind::Facets(facets) => Relief::Facets(chain(), *facets),
            NormalKind::Uv(mapped) => Relief::Uv(Box::new(entry(mapped))),
        };
        let transforms = match &relief {
            Relief::Flat | Relief::Uv(_) => NormalTransforms::default(),
            Relief::Pattern(pattern) | Relief::Slopes(pattern, _) | Relief::Normals(pattern, _) => {
                pattern.normal_transforms(is_unit)
            }
            Relief::Average(chain, _) | Relief::Image(chain, _) | Relief::Facets(chain, _) => {
                chain.normal_transforms(is_unit)
            }
        };
        Some(PreparedNormal {
            relief,
            outer: NormalTransforms::default(),
            transforms,
            amount: f64::from(single(normal.amount)),
            accuracy: f64::from(single(normal.accuracy)),
            is_unit,
        })
    }

    /// Sets the transforms of normals by the texture maps around this normal.
    #[must_use]
    pub(super) fn within(mut self, outer: &NormalTransforms) -> Self {
        self.outer = outer.clone();
        self
    }

    /// No bumps, as an entry of a map.
    fn flat() -> Self {
        PreparedNormal {
            relief: Relief::Flat,
            outer: NormalTransforms::default(),
            transforms: NormalTransforms::default(),
            amount: 0.0,
            accuracy: UNIT_ACCURACY,
            is_unit: true,
        }
    }

    /// The perturbed normal for a unit surface normal. A unit vector except in textures selected by a pattern with
    /// `no_bump_scale`. `point` is the surface point or, for an entry of a map, the point in the space of the pattern
    /// around it.
    #[must_use]
    pub fn tilted(&self, point: DVec3, normal: DVec3, spot: &SurfacePoint) -> DVec3 {
        self.perturbed_with_pattern_normal(point, normal, spot).0
    }

    /// The perturbed normal, and the normal that slope patterns use: transformed to the space of the innermost texture
    /// map, and with `no_bump_scale` not normalized (measured with POV-Ray).
    #[must_use]
    pub fn perturbed_with_pattern_normal(
        &self,
        point: DVec3,
        normal: DVec3,
        spot: &SurfacePoint,
    ) -> (DVec3, DVec3) {
        let turned = self.outer.to_pattern(normal);
        let here = if self.is_unit && !self.outer.is_unit() {
            turned.normalize_or_zero()
        } else {
            turned
        };
        let seen = self.tilted_locally(point, here, spot);
        if self.is_unit && self.outer.is_unit() {
            return (self.outer.from_pattern(seen), seen);
        }
        // Only the texture maps around it change its length again. POV-Ray shades with a normal of that length.
        let unit = seen.normalize_or_zero();
        let unit = if unit == DVec3::ZERO { here } else { unit };
        (self.outer.from_pattern(unit), seen)
    }

    fn tilted_locally(&self, point: DVec3, normal: DVec3, spot: &SurfacePoint) -> DVec3 {
        // POV-Ray normalizes twice to and twice from the pattern, with a transform in between if there is one.
        let is_direct = self.transforms.is_empty();
        let own = match (self.is_unit, is_direct) {
            (true, true) => normal.normalize_or_zero().normalize_or_zero(),
            (true, false) => self.transforms.to_pattern(normal.normalize_or_zero()),
            (false, _) => self.transforms.to_pattern(normal),
        };
        let tilted = match &self.relief {
            Relief::Flat => own,
            Relief::Pattern(pattern) => {
                let pattern_point = pattern.to_pattern_space(point);
                match pattern.tilt(pattern_point) {
                    Some(tilt) => own + self.amount * tilt,
                    None => self.by_gradient(own, pattern_point, |corners| {
                        pattern.values_x4(corners, [spot; 4])
                    }),
                }
            }
            Relief::Slopes(pattern, map) => {
                let pattern_point = pattern.to_pattern_space(point);
                match pattern.tilt(pattern_point) {
                    Some(tilt) => own + self.amount * tilt,
                    None => self.by_gradient(own, pattern_point, |corners| {
                        let values = pattern.values_x4(corners, [spot; 4]);
                        values.map(|value| height(map, value))
                    }),
                }
            }
            Relief::Normals(pattern, map) => {
                let pattern_point = pattern.to_pattern_space(point);
                let of = |entry: &PreparedNormal| entry.tilted_locally(pattern_point, own, spot);
                match map.between(pattern.value(pattern_point, spot)) {
                    Between::One(entry) => of(entry),
                    Between::Two(from, to, share) => (1.0 - share) * of(from) + share * of(to),
                }
            }
            Relief::Average(chain, map) => {
                let pattern_point = chain.to_pattern_space(point);
                let mut sum = DVec3::ZERO;
                let mut total = 0.0;
                for (weight, entry) in map.entries() {
                    let weight = f64::from(*weight);
                    sum += weight * entry.tilted_locally(pattern_point, own, spot);
                    total += weight;
                }
                sum / total
            }
            Relief::Image(chain, source) => {
                self.by_image(own, chain.to_pattern_space(point), source)
            }
            Relief::Facets(chain, facets) => facet(own, chain.to_pattern_space(point), facets),
            Relief::Uv(mapped) => mapped.tilted_locally(spot.uv_point(), own, spot),
        };
        let result = match (self.is_unit, is_direct) {
            (true, true) => tilted.normalize_or_zero().normalize_or_zero(),
            (true, false) => self.transforms.from_pattern(tilted.normalize_or_zero()),
            (false, _) => self.transforms.from_pattern(tilted),
        };
        if result == DVec3::ZERO {
            normal
        } else {
            result
        }
    }

    /// True if some pattern in it jumps where surfaces may lie.
    pub(super) fn jumps(&self) -> bool {
        let any = |map: &Map<PreparedNormal>| {
            let mut entries = map.entries().iter();
            entries.any(|(_, entry)| entry.jumps())
        };
        match &self.relief {
            Relief::Flat | Relief::Facets(..) => false,
            Relief::Image(_, source) => source.uses_index && source.rounds_index(),
            Relief::Pattern(pattern) | Relief::Slopes(pattern, _) => pattern.jumps(),
            Relief::Normals(pattern, map) => pattern.jumps() || any(map),
            Relief::Average(_, map) => any(map),
            Relief::Uv(mapped) => mapped.jumps(),
        }
    }

    pub(super) fn uses_uv(&self) -> bool {
        let any = |map: &Map<PreparedNormal>| {
            let mut entries = map.entries().iter();
            entries.any(|(_, entry)| entry.uses_uv())
        };
        match &self.relief {
            Relief::Uv(_) => true,
            Relief::Normals(_, map) | Relief::Average(_, map) => any(map),
            _ => false,
        }
    }

    /// Tilts a normal by the gradient of a height field at a point, from its heights at four corners around it.
    fn by_gradient(
        &self,
        normal: DVec3,
        point: DVec3,
        heights: impl Fn(&[DVec3; 4]) -> [f64; 4],
    ) -> DVec3 {
        let amount = self.amount * SLOPE * (UNIT_ACCURACY / self.accuracy);
        let heights = heights(&CORNERS.map(|corner| point + self.accuracy * corner));
        let corners = CORNERS.iter().zip(heights);
        corners.fold(normal, |sum, (&corner, height)| {
            sum + (height * amount) * corner
        })
    }

    /// Tilts a normal by the gradient of an image's brightness.
    fn by_image(&self, normal: DVec3, point: DVec3, source: &bitmap::MappedBitmap) -> DVec3 {
        let Some(at) = source.mapping.image_position(&source.bitmap, point) else {
            return normal;
        };
        // Each position is computed from the previous one and wrapped: with interpolated palette indices the last bits
        // of a position matter.
        let to_the_left = source.bitmap.wrapped(at + DVec2::new(-1.0, 1.0));
        let to_the_right = source.bitmap.wrapped(to_the_left + DVec2::new(2.0, 0.0));
        let heights = source.heights([at, to_the_left, to_the_right]);
        let [first, left, right] = heights.map(|height| self.amount * height);
        let first = DVec3::new(0.0, first, 0.0);
        let left = DVec3::new(-1.0, left, 1.0);
        let right = DVec3::new(1.0, right, 1.0);
        let bump = (right - left).cross(first - left).normalize_or_zero();
        let (across, upward) = match normal.cross(DVec3::Y).try_normalize() {
            Some(across) => (across, normal),
            None => (DVec3::X, DVec3::new(0.0, normal.y.signum(), 0.0)),
        };
        let along = across.cross(upward);
        across * bump.x + upward * bump.y - along * bump.z
    }
}

/// The height at a value: the cubic through the heights and slopes of the adjacent entries.
fn height(map: &Map<DVec2>, value: f64) -> f64 {
    match map.between(value) {
        Between::One(entry) => entry.x,
        Between::Two(from, to, t) => {
            let fall = from.x - to.x;
            let cubic = from.y + to.y + 2.0 * fall;
            let square = 2.0 * from.y + to.y + 3.0 * fall;
            t * (t * (t * cubic - square) + from.y) + from.x
        }
    }
}

/// The normal of the facet at a point.
fn facet(normal: DVec3, point: DVec3, facets: &Facets) -> DVec3 {
    let by_position = facets.coords != 0.0;
    let lookup_point = if by_position { point } else { normal };
    let feature = nearest_feature(
        lookup_point / facets.size.max(MIN_FACET_SIZE),
        facets.metric,
    );
    if by_position {
        let noise = vector_noise(feature);
        normal + facets.coords * (noise - normal * normal.dot(noise))
    } else {
        feature.normalize_or_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn prepare(text: &str) -> PreparedNormal {
        let normal = Normal::read(&mut TextArgs::new(text), None).unwrap();
        PreparedNormal::new(&normal, &[], &Settings::default()).expect("it has a pattern")
    }

    fn tilted(text: &str, point: DVec3) -> DVec3 {
        prepare(text).tilted(point, DVec3::Y, &SurfacePoint::at(point))
    }

    fn close(a: DVec3, b: DVec3) -> bool {
        (a - b).abs().max_element() < 1e-7
    }

    #[test]
    fn bumps_add_noise_to_the_normal() {
        let point = DVec3::new(1.3, 0.2, -4.7);
        let expected = (DVec3::Y + 0.6 * vector_noise(point)).normalize();
        assert!(close(tilted("{ bumps 0.6 }", point), expected));
    }

    #[test]
    fn a_ramp_tilts_against_its_slope() {
        // Four samples of a slope of 1: the sum over a tetrahedron of (t . x) t is 4/3 x.
        let expected = (DVec3::Y - 5.0 * 0.02 * 0.5 * 4.0 / 3.0 * DVec3::X).normalize();
        let point = DVec3::new(0.4, 0.0, 0.0);
        assert!(close(tilted("{ gradient <1,0,0> 0.5 }", point), expected));
        assert!(close(
            tilted("{ gradient <1,0,0> 0.5 accuracy 0.1 }", point),
            expected
        ));
    }

    #[test]
    fn heights_run_through_the_entries_with_their_slopes() {
        let map = Map::new(vec![
            (0.0, DVec2::new(0.0, 1.0)),
            (1.0, DVec2::new(1.0, 1.0)),
        ]);
        let map = map.expect("it has entries");
        assert!((0..=4).all(|i| height(&map, f64::from(i) / 4.0) == f64::from(i) / 4.0));
    }

    #[test]
    fn scaled_bumps_keep_their_slope_without_no_bump_scale() {
        let point = DVec3::new(0.4, 0.3, 0.2);
        let plain = tilted("{ bumps 0.6 }", point);
        assert!(close(tilted("{ bumps 0.6 scale 3 }", 3.0 * point), plain));
        let unscaled = tilted("{ bumps 0.6 scale 3 no_bump_scale }", 3.0 * point);
        assert!(close(unscaled, tilted("{ bumps 0.2 }", point)));
    }

    #[test]
    fn a_pattern_blends_normals() {
        let point = DVec3::new(0.25, 0.3, 0.2);
        let blend = tilted(
            "{ gradient <1,0,0> normal_map { [0 bumps 0] [1 bumps 1] } }",
            point,
        );
        let expected = 0.75 * DVec3::Y + 0.25 * tilted("{ bumps 1 }", point);
        assert!(close(blend, expected.normalize()));
    }
}
