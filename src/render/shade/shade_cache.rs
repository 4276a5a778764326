//! How plain surfaces take light. What is worked out of those of one colour, which are most of most pictures, is kept for
//! a while: neighbours mostly see the same few.

use super::Tracer;
use super::direct::light::LayerBsdf;
use crate::base::color::{Color, Rgb};
use crate::scene::texture::PreparedPigment;
use crate::world::{LightList, Surface};

/// So many are kept, a few more than a block of places shows of surfaces.
const KEPT: usize = 128;
/// No surface has this number.
const NO_SURFACE: u32 = u32::MAX;

/// How a plain surface takes light where diffuse light and highlights are all that there is.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlainMaterial {
    /// What it shines of itself.
    pub(super) own: Rgb,
    pub(super) rgb: Rgb,
    /// How much of white light from straight above it scatters.
    pub(super) diffuse: f64,
    /// Whether it has highlights.
    pub(super) is_shiny: bool,
    /// Whether it scatters less of what arrives at an angle than the cosine says.
    pub(super) is_brilliant: bool,
    /// Whether it has a mirror image or something shines through: there is more to be seen than the surface itself.
    pub(super) shows_more: bool,
    /// The share of light that it lets through.
    pub(super) through: Rgb,
    /// The lights that shine on it.
    pub(super) lights: LightList,
}

impl PlainMaterial {
    const NOTHING: PlainMaterial = PlainMaterial {
        own: Rgb::BLACK,
        rgb: Rgb::BLACK,
        diffuse: 0.0,
        is_shiny: false,
        is_brilliant: false,
        shows_more: false,
        through: Rgb::BLACK,
        lights: LightList::OUTSIDE,
    };
}

/// The coats of surfaces of one colour that a thread has seen last, each where the end of its number says.
#[derive(Debug)]
pub(super) struct ShadeCache {
    kept: Box<[(u32, PlainMaterial); KEPT]>,
    /// One that is not to be kept.
    other: PlainMaterial,
}

impl Default for ShadeCache {
    fn default() -> Self {
        ShadeCache {
            kept: Box::new([(NO_SURFACE, PlainMaterial::NOTHING); KEPT]),
            other: PlainMaterial::NOTHING,
        }
    }
}

impl ShadeCache {
    /// The coat of the surface of this number: the one kept, or else what `coat` says, which is kept if it has one colour.
    #[inline(always)]
    pub(super) fn of(
        &mut self,
        number: u32,
        coat: impl FnOnce() -> (Option<PlainMaterial>, bool),
    ) -> Option<&PlainMaterial> {
        let at = number as usize % KEPT;
        if self.kept[at].0 == number {
            return Some(&self.kept[at].1);
        }
        let (coat, has_one_color) = coat();
        if has_one_color {
            self.kept[at] = (number, coat?);
            return Some(&self.kept[at].1);
        }
        self.other = coat?;
        Some(&self.other)
    }

    /// The coat of the surface of this number, if it is kept.
    #[inline(always)]
    pub(super) fn known(&self, number: u32) -> Option<&PlainMaterial> {
        let (kept, coat) = &self.kept[number as usize % KEPT];
        (*kept == number).then_some(coat)
    }
}

impl Tracer<'_> {
    /// How a surface takes light where its pigment has the colour that `color` tells; `None` if it is not plain but for
    /// what it shows of others, or scatters light in another way.
    #[inline(always)]
    pub(super) fn plain_coat(
        &self,
        surface: &Surface,
        color: impl FnOnce(&PreparedPigment) -> Color,
    ) -> Option<PlainMaterial> {
        let layer = surface.texture.layers().first()?;
        let finish = &*layer.finish;
        let shows_more = !surface.is_plain();
        let is_known = !shows_more || surface.is_nearly_plain() && self.sends_waves;
        if !is_known {
            return None;
        }
        let color = color(&layer.pigment);
        let (own, LayerBsdf { rgb, opacity, .. }) = self.coat(layer, color);
        Some(PlainMaterial {
            own,
            rgb,
            diffuse: f64::from(finish.diffuse) * opacity,
            is_shiny: finish.phong != 0.0 || finish.specular != 0.0,
            is_brilliant: finish.brilliance != 1.0,
            shows_more,
            through: color.transmission(),
            lights: surface.lights,
        })
    }
}
