//! How plain surfaces take light, worked out once for those of one colour: most of most pictures.

use super::Tracer;
use super::light::Coat;
use crate::color::{Color, Rgb};
use crate::compile::{LightList, Surface};
use crate::texture::{Finish, PreparedPigment};

/// So many surfaces are worked out beforehand, some 80 bytes each; where there are more, each may be seen once at most.
const MOST_SURFACES: usize = 1 << 17;

/// How a plain surface takes light where diffuse light and highlights are all that there is.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlainCoat<'w> {
    /// What it shines of itself.
    pub(super) own: Rgb,
    pub(super) rgb: Rgb,
    /// How much of white light from straight above it scatters.
    pub(super) diffuse: f64,
    pub(super) finish: &'w Finish,
    /// Whether it has highlights.
    pub(super) is_shiny: bool,
    /// Whether it has a mirror image or something shines through: there is more to be seen than the surface itself.
    pub(super) shows_more: bool,
    /// The share of light that it lets through.
    pub(super) through: Rgb,
    /// The lights that shine on it.
    pub(super) lights: LightList,
}

impl<'w> Tracer<'w> {
    /// The same with the coats of all plain surfaces of one colour worked out.
    pub(super) fn with_coats(mut self) -> Self {
        let surfaces = &self.world.surfaces;
        if self.takes_plain && surfaces.len() <= MOST_SURFACES {
            self.coats = surfaces
                .iter()
                .map(|surface| match surface.texture.layers().first()?.pigment {
                    PreparedPigment::Plain(color) => self.plain_coat(surface, |_| color),
                    _ => None,
                })
                .collect();
        }
        self
    }

    /// How a surface takes light where its pigment has the colour that `color` tells; `None` if it is not plain but for
    /// what it shows of others, or scatters light in another way.
    #[inline(always)]
    pub(super) fn plain_coat(
        &self,
        surface: &'w Surface,
        color: impl FnOnce(&PreparedPigment) -> Color,
    ) -> Option<PlainCoat<'w>> {
        let layer = surface.texture.layers().first()?;
        let finish = &*layer.finish;
        let shows_more = !surface.is_plain();
        let is_known = !shows_more || surface.is_nearly_plain() && self.sends_waves;
        if !is_known || finish.brilliance != 1.0 {
            return None;
        }
        let color = color(&layer.pigment);
        let (own, Coat { rgb, opacity, .. }) = self.coat(layer, color);
        Some(PlainCoat {
            own,
            rgb,
            diffuse: f64::from(finish.diffuse) * opacity,
            finish,
            is_shiny: finish.phong != 0.0 || finish.specular != 0.0,
            shows_more,
            through: color.transmission(),
            lights: surface.lights,
        })
    }
}
