//! Materials of plain surfaces. Those of a single colour, the majority in most pictures, are cached: neighbouring
//! pixels mostly show the same few.

use super::Tracer;
use super::bsdf::LayerBsdf;
use crate::base::color::{Color, Rgb};
use crate::scene::texture::PreparedPigment;
use crate::world::{LightList, Surface};

/// The size of the cache: somewhat more than the number of surfaces in a block.
const CACHE_SIZE: usize = 128;
/// No surface has this index.
const NO_SURFACE: u32 = u32::MAX;

/// The material of a plain surface: diffuse light, highlights and secondary rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlainMaterial {
    /// Ambient light and emission.
    pub(super) own: Rgb,
    pub(super) rgb: Rgb,
    /// The share of white light at normal incidence that is scattered diffusely.
    pub(super) diffuse: f64,
    /// It has highlights.
    pub(super) is_shiny: bool,
    /// It has a `brilliance`: diffuse light does not simply follow the cosine.
    pub(super) is_brilliant: bool,
    /// It reflects or transmits: secondary rays are needed.
    pub(super) has_secondary: bool,
    /// Its transmittance.
    pub(super) transmittance: Rgb,
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
        has_secondary: false,
        transmittance: Rgb::BLACK,
        lights: LightList::OUTSIDE,
    };

    /// The material of a layer of this colour without secondary rays.
    #[inline(always)]
    pub(super) fn new(own: Rgb, bsdf: &LayerBsdf, surface: &Surface, color: Color) -> Self {
        let finish = bsdf.finish;
        PlainMaterial {
            own,
            rgb: bsdf.rgb,
            diffuse: f64::from(finish.diffuse) * bsdf.opacity,
            is_shiny: finish.phong != 0.0 || finish.specular != 0.0,
            is_brilliant: finish.brilliance != 1.0,
            has_secondary: false,
            transmittance: color.transmission(),
            lights: surface.lights,
        }
    }
}

/// A per-thread, direct-mapped cache of the materials of single-colour surfaces.
#[derive(Debug)]
pub(super) struct ShadeCache {
    entries: Box<[(u32, PlainMaterial); CACHE_SIZE]>,
    /// The last material that was not cacheable.
    other: PlainMaterial,
}

impl Default for ShadeCache {
    fn default() -> Self {
        ShadeCache {
            entries: Box::new([(NO_SURFACE, PlainMaterial::NOTHING); CACHE_SIZE]),
            other: PlainMaterial::NOTHING,
        }
    }
}

impl ShadeCache {
    /// The material of a surface: the cached one, or else the result of `evaluate`, which is cached if it has one
    /// colour.
    #[inline(always)]
    pub(super) fn of(
        &mut self,
        number: u32,
        evaluate: impl FnOnce() -> (Option<PlainMaterial>, bool),
    ) -> Option<&PlainMaterial> {
        let at = number as usize % CACHE_SIZE;
        if self.entries[at].0 == number {
            return Some(&self.entries[at].1);
        }
        let (material, has_one_color) = evaluate();
        if has_one_color {
            self.entries[at] = (number, material?);
            return Some(&self.entries[at].1);
        }
        self.other = material?;
        Some(&self.other)
    }

    /// The cached material of a surface.
    #[inline(always)]
    pub(super) fn known(&self, number: u32) -> Option<&PlainMaterial> {
        let (entry, material) = &self.entries[number as usize % CACHE_SIZE];
        (*entry == number).then_some(material)
    }
}

impl Tracer<'_> {
    /// The material of a surface whose pigment has the colour that `color` returns; `None` if the surface needs more
    /// than diffuse light, highlights and secondary rays.
    #[inline(always)]
    pub(super) fn plain_material(
        &self,
        surface: &Surface,
        color: impl FnOnce(&PreparedPigment) -> Color,
    ) -> Option<PlainMaterial> {
        let layer = surface.texture.layers().first()?;
        let has_secondary = !surface.is_plain();
        let is_known = !has_secondary || surface.is_nearly_plain() && self.fast_paths.wavefront;
        if !is_known {
            return None;
        }
        let color = color(&layer.pigment);
        let (own, bsdf) = self.layer_bsdf(layer, color);
        Some(PlainMaterial {
            has_secondary,
            ..PlainMaterial::new(own, &bsdf, surface, color)
        })
    }
}
