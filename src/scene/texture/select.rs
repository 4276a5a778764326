//! Textures that a pattern chooses, as rays need them: which ones are seen at a point, and the share of each.

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

/// A texture that is seen at a point.
#[derive(Clone, Copy, Debug)]
pub struct Look<'t> {
    /// Its share.
    pub weight: f32,
    /// The texture; no pattern chooses it further.
    pub texture: &'t PreparedTexture,
    /// Where its own patterns are asked.
    pub point: DVec3,
}

/// The textures that are seen at a point.
pub type Looks<'t> = SmallVec<[Look<'t>; 1]>;

/// The textures that are seen at a place as they are chosen one after the other, in the order in which they are drawn.
#[derive(Clone, Debug)]
pub struct Choosing<'t> {
    /// The textures so far.
    pub looks: Looks<'t>,
    /// The place, with the normal that choices see.
    pub(super) spot: SurfacePoint,
    /// The place itself, where the bumps of what is chosen are seen by choices after it.
    pub(super) flat: Option<SurfacePoint>,
}

impl Choosing<'_> {
    /// Nothing is chosen yet.
    #[must_use]
    pub fn at(spot: SurfacePoint) -> Self {
        Choosing {
            looks: Looks::new(),
            spot,
            flat: None,
        }
    }

    /// The same where the textures are drawn as they are chosen. Then `slope` and `aoi` see the normal that bumps have made
    /// last, if those of an earlier texture have made one, as in POV-Ray: it draws the upper entry of a map before it
    /// chooses within the lower one.
    #[must_use]
    pub fn drawn_at(spot: SurfacePoint) -> Self {
        Choosing {
            flat: Some(spot),
            ..Choosing::at(spot)
        }
    }
}

/// A choice among textures, ready for rays.
#[derive(Debug)]
pub(super) enum Choice {
    /// By the value of a pattern.
    Map(PreparedPattern, Map<PreparedTexture>),
    /// All of them, by weight.
    Average(PreparedWarpChain, Map<PreparedTexture>),
    /// Two in turn, as a checkerboard.
    Tiles(PreparedWarpChain, Box<[PreparedTexture; 2]>),
    /// One, at texture coordinates.
    Uv(Box<PreparedTexture>),
    /// By the pixels of a picture.
    Material(PreparedWarpChain, Box<bitmap::Source>, Vec<PreparedTexture>),
}

impl Choice {
    /// The form for drawing; `None` where there is nothing to choose from.
    /// Points come to the entries as the pattern moves them, but normals as they are, so that the entries must turn them
    /// themselves; they have been turned so `far` on their way to the choice.
    pub(super) fn new(
        patterned: &Patterned,
        after: &[Step],
        far: &NormalTransforms,
        settings: &Settings,
    ) -> Option<Self> {
        let modifiers = &patterned.modifiers;
        let chain = || modifiers.prepare_chain(after, settings);
        let turns = far.then(&chain().normal_transforms(!patterned.has_no_bump_scale));
        let entry = |texture: &Texture| PreparedTexture::new(texture, &[], &turns, settings);
        match &patterned.kind {
            PatternedKind::Map(_, None) | PatternedKind::Average(None) => None,
            PatternedKind::Map(pattern, Some(map)) => {
                let pattern = modifiers.prepare(&**pattern, after, settings);
                Some(Choice::Map(pattern, map.map(entry)))
            }
            PatternedKind::Average(Some(map)) => Some(Choice::Average(chain(), map.map(entry))),
            PatternedKind::Tiles(two) => {
                let [first, second] = &**two;
                Some(Choice::Tiles(
                    chain(),
                    Box::new([entry(first), entry(second)]),
                ))
            }
            PatternedKind::Uv(mapped) => Some(Choice::Uv(Box::new(entry(mapped)))),
            PatternedKind::Material(source, textures) => {
                let textures = textures.iter().map(entry).collect();
                let source = Box::new(source.clone());
                Some(Choice::Material(chain(), source, textures))
            }
        }
    }

    /// Everything that may be chosen.
    pub(super) fn textures(&self) -> Box<dyn Iterator<Item = &PreparedTexture> + '_> {
        match self {
            Choice::Map(_, map) | Choice::Average(_, map) => {
                Box::new(map.entries().iter().map(|entry| &entry.1))
            }
            Choice::Tiles(_, two) => Box::new(two.iter()),
            Choice::Uv(mapped) => Box::new(std::iter::once(&**mapped)),
            Choice::Material(_, _, textures) => Box::new(textures.iter()),
        }
    }

    /// Whether something in it asks for the texture coordinates of the surface.
    pub(super) fn uses_uv(&self) -> bool {
        matches!(self, Choice::Uv(_)) || self.textures().any(PreparedTexture::uses_uv)
    }

    /// Whether normals decide what is chosen, here or further on.
    pub(super) fn minds_normal(&self) -> bool {
        matches!(self, Choice::Map(pattern, _) if pattern.needs_normal())
            || self.textures().any(PreparedTexture::minds_normal)
    }

    /// Adds what is seen at a point.
    pub(super) fn look<'t>(&'t self, point: DVec3, weight: f32, to: &mut Choosing<'t>) {
        match self {
            Choice::Map(pattern, map) => {
                let moved = pattern.to_pattern_space(point);
                match map.between(pattern.value(moved, &to.spot)) {
                    Between::One(entry) => entry.look(moved, weight, to),
                    Between::Two(first, second, share) => {
                        #[allow(
                            clippy::cast_possible_truncation,
                            reason = "shares are single precision, like colours"
                        )]
                        let share = share as f32;
                        second.look(moved, weight * share, to);
                        first.look(moved, weight * (1.0 - share), to);
                    }
                }
            }
            Choice::Average(chain, map) => {
                let moved = chain.to_pattern_space(point);
                let total: f32 = map.entries().iter().map(|entry| entry.0).sum();
                for (own, entry) in map.entries() {
                    entry.look(moved, weight * own / total, to);
                }
            }
            Choice::Tiles(chain, two) => {
                let moved = chain.to_pattern_space(point);
                two[tile(moved)].look(moved, weight, to);
            }
            Choice::Uv(mapped) => mapped.look(to.spot.uv_point(), weight, to),
            Choice::Material(chain, source, textures) => {
                let moved = chain.to_pattern_space(point);
                if let Some(texture) = textures.get(source.material(moved, textures.len())) {
                    texture.look(moved, weight, to);
                }
            }
        }
    }
}

/// The number of the tile that a point lies in: 0 where the sum of the whole parts of its coordinates is odd, otherwise 1.
fn tile(point: DVec3) -> usize {
    let cell = (point + NUDGE).map(floor);
    usize::from(remainder(cell.element_sum(), 2.0) == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::texture::Layer;

    /// The shares of what is seen at a point.
    fn weights(text: &str, x: f64) -> Vec<f32> {
        let known = Texture::from(Layer::default());
        let mut args = TextArgs::new(text).with("T", known);
        let texture = Texture::read(&mut args, &Layer::default()).unwrap();
        let texture = texture.prepare(&[], &Settings::default());
        let point = DVec3::new(x, 0.5, 0.5);
        let mut chosen = Choosing::at(SurfacePoint::at(point));
        texture.look(point, 1.0, &mut chosen);
        chosen.looks.iter().map(|look| look.weight).collect()
    }

    #[test]
    fn the_shares_of_all_textures_add_up_to_one() {
        let map = "{ gradient <1,0,0> texture_map { [0 T] [0.5 T] } }";
        assert_eq!(weights(map, 0.125), [0.25, 0.75]);
        assert_eq!(weights(map, 0.75), [1.0]);
        let mean = "{ average texture_map { [T] [3 T] } }";
        assert_eq!(weights(mean, 0.0), [0.25, 0.75]);
        let nested = "{ average texture_map { [T] [average texture_map { [T] [T] }] } }";
        assert_eq!(weights(nested, 0.0), [0.5, 0.25, 0.25]);
    }

    /// The number of textures that are seen of a bumpy one beside one that shows two where the surface is level.
    fn seen_beside_bumps(begin: fn(SurfacePoint) -> Choosing<'static>) -> usize {
        let known = Texture::from(Layer::default());
        let text = "{ average texture_map { [normal { bumps 2 }] \
                    [slope <0,1,0> texture_map { [0.99 T] [0.99 average texture_map { [T] [T] }] }] } }";
        let mut args = TextArgs::new(text).with("T", known);
        let texture = Texture::read(&mut args, &Layer::default()).unwrap();
        let texture = Box::leak(Box::new(texture.prepare(&[], &Settings::default())));
        assert!(texture.minds_normal());
        let point = DVec3::new(0.3, 0.5, 0.4);
        let mut chosen = begin(SurfacePoint {
            normal: DVec3::Y,
            ..SurfacePoint::at(point)
        });
        texture.look(point, 1.0, &mut chosen);
        chosen.looks.len()
    }

    #[test]
    fn slope_sees_the_bumps_of_a_texture_drawn_before() {
        assert_eq!(seen_beside_bumps(Choosing::at), 3);
        assert_eq!(seen_beside_bumps(Choosing::drawn_at), 2);
    }

    #[test]
    fn tiles_begin_with_the_second_texture() {
        assert_eq!(tile(DVec3::splat(0.5)), 1);
        assert_eq!(tile(DVec3::new(1.5, 0.5, 0.5)), 0);
        assert_eq!(tile(DVec3::new(-0.5, 0.5, 0.5)), 0);
    }
}
