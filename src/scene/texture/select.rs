//! Patterned textures prepared for rendering: selects the textures at a point and the weight of each.

use super::{Patterned, PatternedKind, PreparedTexture, Texture};
use crate::base::bitmap;
use crate::base::math::Step;
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::{
    Between, Map, NUDGE, NormalTransforms, PreparedPattern, PreparedWarpChain, Settings,
    SurfacePoint,
};
use glam::DVec3;
use smallvec::SmallVec;

/// A texture that is selected at a point.
#[derive(Clone, Copy, Debug)]
pub struct WeightedTexture<'t> {
    /// The share of the texture in the colour of the surface.
    pub weight: f32,
    /// The texture; never a patterned one.
    pub texture: &'t PreparedTexture,
    /// The point at which its own patterns are evaluated.
    pub point: DVec3,
}

/// The textures that are selected at a point.
pub type WeightedTextures<'t> = SmallVec<[WeightedTexture<'t>; 1]>;

/// The selection of textures at a surface point, in shading order.
#[derive(Clone, Debug)]
pub struct TextureSelection<'t> {
    /// The textures selected so far.
    pub textures: WeightedTextures<'t>,
    /// The surface point, with the normal that slope patterns use.
    pub(super) spot: SurfacePoint,
    /// The surface point with its own normal, if slope patterns use the bumps of textures selected before them.
    pub(super) flat: Option<SurfacePoint>,
}

impl TextureSelection<'_> {
    /// An empty selection.
    #[must_use]
    pub fn at(spot: SurfacePoint) -> Self {
        TextureSelection {
            textures: WeightedTextures::new(),
            spot,
            flat: None,
        }
    }

    /// An empty selection for patterns that depend on the normal. `slope` and `aoi` use the normal that the bumps of an
    /// earlier texture have perturbed last, as in POV-Ray, which shades the upper entry of a map before it selects
    /// within the lower one.
    #[must_use]
    pub fn in_shading_order(spot: SurfacePoint) -> Self {
        TextureSelection {
            flat: Some(spot),
            ..TextureSelection::at(spot)
        }
    }
}

/// A prepared selector of textures.
#[derive(Debug)]
pub(super) enum Selector {
    /// By the value of a pattern.
    Map(PreparedPattern, Map<PreparedTexture>),
    /// All textures, by weight.
    Average(PreparedWarpChain, Map<PreparedTexture>),
    /// Two textures, alternating as in a checkerboard.
    Tiles(PreparedWarpChain, Box<[PreparedTexture; 2]>),
    /// One texture, evaluated at the texture coordinates.
    Uv(Box<PreparedTexture>),
    /// By the pixels of an image.
    Material(
        PreparedWarpChain,
        Box<bitmap::MappedBitmap>,
        Vec<PreparedTexture>,
    ),
}

impl Selector {
    /// Prepares a selector for rendering; `None` if it has no textures.
    ///
    /// Entries receive points in the space of the pattern but untransformed normals, and transform these
    /// themselves: `outer` are the transforms of normals by the texture maps around this selector.
    pub(super) fn new(
        patterned: &Patterned,
        after: &[Step],
        outer: &NormalTransforms,
        settings: &Settings,
    ) -> Option<Self> {
        let modifiers = &patterned.modifiers;
        let chain = || modifiers.prepare_chain(after, settings);
        let transforms = outer.then(&chain().normal_transforms(!patterned.has_no_bump_scale));
        let entry = |texture: &Texture| PreparedTexture::new(texture, &[], &transforms, settings);
        match &patterned.kind {
            PatternedKind::Map(_, None) | PatternedKind::Average(None) => None,
            PatternedKind::Map(pattern, Some(map)) => {
                let pattern = modifiers.prepare(&**pattern, after, settings);
                Some(Selector::Map(pattern, map.map(entry)))
            }
            PatternedKind::Average(Some(map)) => Some(Selector::Average(chain(), map.map(entry))),
            PatternedKind::Tiles(two) => {
                let [first, second] = &**two;
                Some(Selector::Tiles(
                    chain(),
                    Box::new([entry(first), entry(second)]),
                ))
            }
            PatternedKind::Uv(mapped) => Some(Selector::Uv(Box::new(entry(mapped)))),
            PatternedKind::Material(source, textures) => {
                let textures = textures.iter().map(entry).collect();
                let source = Box::new(source.clone());
                Some(Selector::Material(chain(), source, textures))
            }
        }
    }

    /// All textures that can be selected.
    pub(super) fn textures(&self) -> Box<dyn Iterator<Item = &PreparedTexture> + '_> {
        match self {
            Selector::Map(_, map) | Selector::Average(_, map) => {
                Box::new(map.entries().iter().map(|entry| &entry.1))
            }
            Selector::Tiles(_, two) => Box::new(two.iter()),
            Selector::Uv(mapped) => Box::new(std::iter::once(&**mapped)),
            Selector::Material(_, _, textures) => Box::new(textures.iter()),
        }
    }

    /// True if a selector or texture in it depends on the texture coordinates of the surface.
    pub(super) fn uses_uv(&self) -> bool {
        matches!(self, Selector::Uv(_)) || self.textures().any(PreparedTexture::uses_uv)
    }

    /// True if some pattern in it jumps where surfaces may lie.
    pub(super) fn jumps(&self) -> bool {
        let own = match self {
            Selector::Map(pattern, _) => pattern.jumps(),
            Selector::Material(_, source, _) => source.rounds_index(),
            _ => false,
        };
        own || self.textures().any(PreparedTexture::jumps)
    }

    /// True if this selector, or one in its textures, depends on the normal.
    pub(super) fn needs_normal(&self) -> bool {
        matches!(self, Selector::Map(pattern, _) if pattern.needs_normal())
            || self.textures().any(PreparedTexture::needs_normal)
    }

    /// Adds the textures at a point to a selection.
    pub(super) fn select<'t>(&'t self, point: DVec3, weight: f32, to: &mut TextureSelection<'t>) {
        match self {
            Selector::Map(pattern, map) => {
                let pattern_point = pattern.to_pattern_space(point);
                match map.between(pattern.value(pattern_point, &to.spot)) {
                    Between::One(entry) => entry.select(pattern_point, weight, to),
                    Between::Two(first, second, share) => {
                        #[allow(
                            clippy::cast_possible_truncation,
                            reason = "shares are single precision, like colours"
                        )]
                        let share = share as f32;
                        second.select(pattern_point, weight * share, to);
                        first.select(pattern_point, weight * (1.0 - share), to);
                    }
                }
            }
            Selector::Average(chain, map) => {
                let pattern_point = chain.to_pattern_space(point);
                let total: f32 = map.entries().iter().map(|entry| entry.0).sum();
                for (own, entry) in map.entries() {
                    entry.select(pattern_point, weight * own / total, to);
                }
            }
            Selector::Tiles(chain, two) => {
                let pattern_point = chain.to_pattern_space(point);
                two[tile(pattern_point)].select(pattern_point, weight, to);
            }
            Selector::Uv(mapped) => mapped.select(to.spot.uv_point(), weight, to),
            Selector::Material(chain, source, textures) => {
                let pattern_point = chain.to_pattern_space(point);
                if let Some(texture) = textures.get(source.material(pattern_point, textures.len()))
                {
                    texture.select(pattern_point, weight, to);
                }
            }
        }
    }
}

/// The index of the tile at a point: 0 if the sum of the floors of its coordinates is odd, otherwise 1.
fn tile(point: DVec3) -> usize {
    let cell = (point + NUDGE).map(floor);
    usize::from(remainder(cell.element_sum(), 2.0) == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::texture::Layer;

    /// The weights of the textures at a point.
    fn weights(text: &str, x: f64) -> Vec<f32> {
        let known = Texture::from(Layer::default());
        let mut args = TextArgs::new(text).with("T", known);
        let texture = Texture::read(&mut args, &Layer::default()).unwrap();
        let texture = texture.prepare(&[], &Settings::default());
        let point = DVec3::new(x, 0.5, 0.5);
        let mut chosen = TextureSelection::at(SurfacePoint::at(point));
        texture.select(point, 1.0, &mut chosen);
        chosen.textures.iter().map(|look| look.weight).collect()
    }

    #[test]
    fn weights_of_all_textures_add_up_to_one() {
        let map = "{ gradient <1,0,0> texture_map { [0 T] [0.5 T] } }";
        assert_eq!(weights(map, 0.125), [0.25, 0.75]);
        assert_eq!(weights(map, 0.75), [1.0]);
        let mean = "{ average texture_map { [T] [3 T] } }";
        assert_eq!(weights(mean, 0.0), [0.25, 0.75]);
        let nested = "{ average texture_map { [T] [average texture_map { [T] [T] }] } }";
        assert_eq!(weights(nested, 0.0), [0.5, 0.25, 0.25]);
    }

    /// The number of textures selected from the mean of a bumpy texture and a map by slope, which has two where the
    /// surface is level.
    fn count_beside_bumps(begin: fn(SurfacePoint) -> TextureSelection<'static>) -> usize {
        let known = Texture::from(Layer::default());
        let text = "{ average texture_map { [normal { bumps 2 }] \
                    [slope <0,1,0> texture_map { [0.99 T] [0.99 average texture_map { [T] [T] }] }] } }";
        let mut args = TextArgs::new(text).with("T", known);
        let texture = Texture::read(&mut args, &Layer::default()).unwrap();
        let texture = Box::leak(Box::new(texture.prepare(&[], &Settings::default())));
        assert!(texture.needs_normal());
        let point = DVec3::new(0.3, 0.5, 0.4);
        let mut chosen = begin(SurfacePoint {
            normal: DVec3::Y,
            ..SurfacePoint::at(point)
        });
        texture.select(point, 1.0, &mut chosen);
        chosen.textures.len()
    }

    #[test]
    fn slope_uses_the_bumps_of_a_texture_shaded_before() {
        assert_eq!(count_beside_bumps(TextureSelection::at), 3);
        assert_eq!(count_beside_bumps(TextureSelection::in_shading_order), 2);
    }

    #[test]
    fn tiles_begin_with_the_second_texture() {
        assert_eq!(tile(DVec3::splat(0.5)), 1);
        assert_eq!(tile(DVec3::new(1.5, 0.5, 0.5)), 0);
        assert_eq!(tile(DVec3::new(-0.5, 0.5, 0.5)), 0);
    }
}
