//! How plain surfaces take light, worked out once for those of one colour: most of most pictures.

use super::Tracer;
use super::light::Coat;
use crate::color::{Color, Rgb};
use crate::compile::{LightList, Surface};
use crate::texture::{Finish, PreparedPigment};

/// So many surfaces are worked out beforehand, some 50 bytes each; where there are more, each may be seen once at most.
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
    /// Whether it has a mirror image.
    pub(super) is_mirror: bool,
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
    /// mirror images, or scatters light in another way.
    #[inline(always)]
    pub(super) fn plain_coat(
        &self,
        surface: &'w Surface,
        color: impl FnOnce(&PreparedPigment) -> Color,
    ) -> Option<PlainCoat<'w>> {
        let layer = surface.texture.layers().first()?;
        let finish = &*layer.finish;
        let is_mirror = surface.is_plain_mirror();
        if !(surface.is_plain() || is_mirror) || finish.brilliance != 1.0 {
            return None;
        }
        let (own, Coat { rgb, opacity, .. }) = self.coat(layer, color(&layer.pigment));
        Some(PlainCoat {
            own,
            rgb,
            diffuse: f64::from(finish.diffuse) * opacity,
            finish,
            is_shiny: finish.phong != 0.0 || finish.specular != 0.0,
            is_mirror,
            lights: surface.lights,
        })
    }
}
