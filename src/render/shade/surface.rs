//! Shading of a surface: its layers from the top down, then transmitted light, then reflections.

use super::bsdf::{LayerBsdf, ViewPoint, facing_normal, fresnel, metallic, mirrored};
use super::direct::shadow_cache::ShadowCache;
use super::indirect::radiosity::{Irradiance, IrradiancePoint};
use super::shading_point::{LightSamples, ShadingPoint};
use super::subsurface::SubsurfaceTransport;
use super::{InteriorStack, Path, Sample, Scratch, Tracer};
use crate::base::color::{Color, Rgb};
use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::base::math::powers::exact_power;
use crate::scene::interior::Interior;
use crate::scene::pattern::SurfacePoint;
use crate::scene::shape::TextureWeights;
use crate::scene::texture::{
    Finish, Irid, PreparedLayer, PreparedTexture, TextureSelection, WeightedTexture,
    WeightedTextures,
};
use crate::world::{Hit, Surface};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// Radiance of a hit.
pub(super) struct SurfaceRadiance {
    /// The surface's own light, and refracted light.
    pub(super) rgb: Rgb,
    /// The transparency along refracted rays to behind the whole scene.
    pub(super) transmit: f32,
    /// Reflected light, added last.
    pub(super) reflected: Rgb,
    /// Transmission without refraction, still to be added.
    pub(super) straight: Option<StraightTransmission>,
}

/// The light of a texture's layers at a hit, before its secondary rays are traced.
pub(super) struct ShadedLayers<'t> {
    /// Its own light.
    pub(super) rgb: Rgb,
    /// The transmittance of all layers.
    pub(super) transmittance: Rgb,
    /// It is worth tracing the transmitted light.
    pub(super) passes: bool,
    /// The film on the top layer.
    pub(super) film: Option<&'t Irid>,
    /// Its reflections, the top layer's first.
    pub(super) mirrors: SmallVec<[Mirror<'t>; 2]>,
}

impl SurfaceRadiance {
    /// No light.
    const NOTHING: SurfaceRadiance = SurfaceRadiance {
        rgb: Rgb::BLACK,
        transmit: 0.0,
        reflected: Rgb::BLACK,
        straight: None,
    };

    /// Adds a weighted texture of the same hit.
    fn add(&mut self, weight: f32, other: SurfaceRadiance) {
        self.rgb += other.rgb * f64::from(weight);
        self.transmit += other.transmit * weight;
        self.reflected += other.reflected * f64::from(weight);
        let Some(mut other) = other.straight else {
            return;
        };
        other.factor *= Rgb::splat(weight);
        other.transmit *= weight;
        self.straight = Some(match self.straight.take() {
            None => other,
            Some(sum) => StraightTransmission {
                factor: sum.factor + other.factor,
                transmit: sum.transmit + other.transmit,
                weight: sum.weight.max(other.weight),
                inside: sum.inside,
            },
        });
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "POV-Ray stores texture weights in single precision, like colours"
)]
pub(super) fn single(weight: f64) -> f32 {
    weight as f32
}

/// The purpose of a texture lookup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextureUse {
    /// Shading.
    Drawn,
    /// Filtering of light that passes.
    Passed,
}

/// A texture of a hit to be shaded.
pub(super) struct TextureShading<'a, 't> {
    pub(super) texture: &'a WeightedTexture<'t>,
    /// The last bumped normal at the hit.
    pub(super) tilted: &'a mut Option<DVec3>,
    /// The shadowed light of earlier textures.
    pub(super) shadow_cache: Option<&'t ShadowCache>,
}

/// A reflection to be traced.
#[derive(Clone, Copy)]
pub(super) struct Mirror<'f> {
    pub(super) reflectivity: Rgb,
    pub(super) weight: f64,
    pub(super) finish: &'f Finish,
    /// The direction of the reflected ray.
    pub(super) dir: DVec3,
    /// The bumped normal of the layer.
    normal: DVec3,
}

/// The largest difference of the components of two normals that count as the same.
const SAME_NORMAL: f64 = 1e-10;

impl Mirror<'_> {
    /// Returns true if total internal reflection at a surface with this normal, that of the top layer, replaces it. As in
    /// POV-Ray, layers with other bumps reflect besides (docs/povray-facts.md, section 4.5).
    pub(super) fn is_replaced_by_total(&self, top: DVec3) -> bool {
        (self.normal - top).abs().max_element() < SAME_NORMAL
    }
}

impl<'w> Tracer<'w> {
    /// Shades a hit, without the light that passes unrefracted. `known` are the light samples there.
    pub(super) fn shade(
        &self,
        path: &Path,
        hit: &Hit,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> SurfaceRadiance {
        let surface = &self.world.surfaces[hit.surface as usize];
        match self
            .textures_at(surface, hit, path.ray.dir, TextureUse::Drawn)
            .as_slice()
        {
            [only] if only.weight == 1.0 => {
                let shadow_cache = (only.texture.layers().len() > 1).then(ShadowCache::default);
                let one = TextureShading {
                    texture: only,
                    tilted: &mut None,
                    shadow_cache: shadow_cache.as_ref(),
                };
                self.shade_texture(path, hit, one, known, scratch)
            }
            several => {
                let mut sum = SurfaceRadiance::NOTHING;
                let mut tilted = None;
                let shadow_cache = ShadowCache::default();
                for texture in several {
                    let one = TextureShading {
                        texture,
                        tilted: &mut tilted,
                        shadow_cache: Some(&shadow_cache),
                    };
                    let view = self.shade_texture(path, hit, one, known, scratch);
                    sum.add(texture.weight, view);
                }
                sum
            }
        }
    }

    /// The textures of a hit with their weights. Weights below the bailout are not shaded. The shading normal of a
    /// smooth triangle decides which side is seen, not the order of its corners.
    pub(super) fn textures_at<'s>(
        &self,
        surface: &'s Surface,
        hit: &Hit,
        dir: DVec3,
        purpose: TextureUse,
    ) -> WeightedTextures<'s> {
        let is_inside = || {
            let is_turned = self.world.turns_normals(hit.spawn_surface.leaf);
            (hit.shading_normal.dot(dir) > 0.0) != is_turned && !self.world.has_one_side(hit)
        };
        let outside = match surface.inside_texture() {
            Some(inside) if is_inside() => {
                return self.single_texture(inside, hit, dir, purpose);
            }
            _ => &*surface.texture,
        };
        let weights = if surface.face_textures().is_empty() {
            TextureWeights::new()
        } else {
            self.world.texture_weights(hit)
        };
        if weights.is_empty() {
            return self.single_texture(outside, hit, dir, purpose);
        }
        let least = self.world.globals.adc_bailout;
        let drawn = weights.iter().filter(|share| share.weight >= least);
        let texture_of = |number: u32| {
            surface
                .face_textures()
                .get(number as usize)
                .map_or(outside, |texture| texture)
        };
        let needs_normal = weights
            .iter()
            .any(|share| texture_of(share.texture).needs_normal());
        let (point, mut chosen) = self.choosing(hit, dir, purpose, needs_normal);
        for share in drawn {
            texture_of(share.texture).select(point, single(share.weight), &mut chosen);
        }
        chosen.textures
    }

    /// The point at which the patterns of a hit are evaluated, and a new texture selection there.
    fn choosing<'t>(
        &self,
        hit: &Hit,
        dir: DVec3,
        purpose: TextureUse,
        needs_normal: bool,
    ) -> (DVec3, TextureSelection<'t>) {
        let (point, spot) = self.pattern_point(hit, dir);
        let needs_bumps = needs_normal && purpose == TextureUse::Drawn && self.quality.has_normals;
        let chosen = if needs_bumps {
            TextureSelection::in_shading_order(spot)
        } else {
            TextureSelection::at(spot)
        };
        (point, chosen)
    }

    /// The textures of a hit that one texture covers alone.
    #[inline]
    fn single_texture<'t>(
        &self,
        texture: &'t PreparedTexture,
        hit: &Hit,
        dir: DVec3,
        purpose: TextureUse,
    ) -> WeightedTextures<'t> {
        if texture.is_patterned() {
            let (point, mut chosen) = self.choosing(hit, dir, purpose, texture.needs_normal());
            texture.select(point, 1.0, &mut chosen);
            return chosen.textures;
        }
        let is_mapped = self.world.surfaces[hit.surface as usize].is_mapped();
        WeightedTextures::from_buf([WeightedTexture {
            weight: 1.0,
            texture,
            point: if is_mapped {
                self.pattern_point(hit, dir).0
            } else {
                hit.point
            },
        }])
    }

    /// The point at which the patterns of a hit are evaluated, and its surface point.
    #[inline]
    pub(super) fn pattern_point(&self, hit: &Hit, dir: DVec3) -> (DVec3, SurfacePoint) {
        let mut spot = surface_point(hit, dir);
        let surface = &self.world.surfaces[hit.surface as usize];
        if !surface.uses_uv() {
            return (hit.point, spot);
        }
        spot.uv = self.world.uv(hit);
        let is_mapped = surface.is_mapped();
        let point = if is_mapped {
            spot.uv_point()
        } else {
            hit.point
        };
        (point, spot)
    }

    /// Shades one texture of a hit. `tilted` is the last bumped normal at this hit: as in POV-Ray, slope patterns use
    /// it, even those of later layers and textures without bumps. The cache holds the shadowed light of earlier
    /// textures.
    fn shade_texture(
        &self,
        path: &Path,
        hit: &Hit,
        of: TextureShading,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> SurfaceRadiance {
        let mut view = SurfaceRadiance::NOTHING;
        let (shaded, lit) = self.layers(path, hit, of, known, scratch);
        view.rgb = shaded.rgb;
        let mut is_total = false;
        if shaded.passes {
            is_total = self.pass(
                &lit,
                hit,
                shaded.transmittance,
                shaded.film,
                &mut view,
                scratch,
            );
        }
        if scratch.order_dependent() && (self.has_atmosphere() || !shaded.mirrors.is_empty()) {
            self.trace_unrefracted(&lit, hit, &mut view, scratch);
        }
        for mirror in &shaded.mirrors {
            if !(is_total && mirror.is_replaced_by_total(lit.at.normal)) {
                view.reflected += self.reflect(&lit, hit, mirror, scratch);
            }
        }
        view
    }

    /// Lights all layers of a texture at a hit, and collects their secondary rays.
    pub(super) fn layers<'p>(
        &self,
        path: &'p Path,
        hit: &'p Hit,
        of: TextureShading<'_, 'p>,
        known: LightSamples<'p>,
        scratch: &mut Scratch,
    ) -> (ShadedLayers<'p>, ShadingPoint<'p>)
    where
        'w: 'p,
    {
        let TextureShading {
            texture: look,
            tilted,
            shadow_cache,
        } = of;
        let texture = look.texture;
        let surface = &self.world.surfaces[hit.surface as usize];
        let mut lit = ShadingPoint {
            at: ViewPoint::new(hit, path.ray.dir),
            spawn_surface: Some(&hit.spawn_surface),
            path,
            known,
            shadow_cache,
            is_double_illuminated: surface.is_double_illuminated(),
            lights: self.world.lights.of(surface.lights),
            collects: self.has_caustics() && !surface.photons().collects_none,
        };
        let mut shaded = ShadedLayers {
            rgb: Rgb::BLACK,
            transmittance: Rgb::WHITE,
            passes: false,
            film: None,
            mirrors: SmallVec::new(),
        };
        if !self.quality.has_light {
            if let Some(lowest) = texture.layers().last() {
                let (_, spot) = self.pattern_point(hit, path.ray.dir);
                shaded.rgb = self.color(lowest, look.point, &spot).rgb;
            }
            return (shaded, lit);
        }
        let mut filter = Rgb::WHITE;
        let mut irradiance = Irradiance::default();
        let mut photons = None;
        let mut is_lit_by_radiosity = true;
        let (_, mut spot) = self.pattern_point(hit, path.ray.dir);
        let flat = lit.at.normal;
        let mut top = None;
        for layer in texture.layers() {
            lit.at.normal = match layer.normal() {
                Some(bumps) if self.quality.has_normals => {
                    let (normal, seen) =
                        bumps.perturbed_with_pattern_normal(look.point, flat, &spot);
                    *tilted = Some(seen);
                    normal
                }
                _ => flat,
            };
            top.get_or_insert(lit.at.normal);
            spot.normal = tilted.unwrap_or(flat);
            let color = self.color(layer, look.point, &spot);
            spot.normal = flat;
            let (mut emitted, mut bsdf) = self.layer_bsdf(layer, color);
            let mut entering = 1.0;
            if layer.finish.fresnel != 0.0 {
                bsdf.ior = self.relative_ior(&path.inside, surface.interior);
                entering = bsdf.entering(-lit.at.view.dot(lit.at.normal));
                emitted = emitted * entering;
            }
            let mut own = Rgb::BLACK;
            if let Some((transport, translucency)) = self.subsurface_of(layer) {
                let colors = [
                    translucency,
                    color.rgb * layer.finish.diffuse_without_albedo[0],
                ];
                own = self.subsurface_light(transport, &lit, hit, flat, colors, scratch);
                is_lit_by_radiosity &= !transport.has_radiosity;
                bsdf.opacity = 0.0;
            }
            // Before the lights, as in POV-Ray: both draw random numbers behind an irradiance sample.
            let mut indirect = Rgb::BLACK;
            if let Some(radiosity) = self.radiosity.as_ref().filter(|_| is_lit_by_radiosity) {
                let irradiance_point =
                    IrradiancePoint::new(radiosity, &lit, flat, layer.finish.brilliance);
                indirect = self.irradiance_radiance(
                    &irradiance_point,
                    layer,
                    color,
                    filter,
                    &mut irradiance,
                    scratch,
                );
                indirect = indirect * entering;
            }
            own += emitted;
            own += self.illuminate(&lit, &bsdf, scratch);
            if lit.collects {
                own += self.caustics(&lit, &bsdf, flat, &mut photons, scratch);
            }
            own += indirect;
            shaded.rgb += own * filter;
            if self.quality.has_reflection {
                let ior = || self.relative_ior(&path.inside, surface.interior);
                let mirror = self.layer_mirror(&lit.at, flat, &bsdf, ior, &mut filter);
                shaded.mirrors.extend(mirror);
            }
            filter *= color.transmission();
            if self.is_opaque(path.irradiance_depth, filter) {
                break;
            }
        }
        if let Some(photons) = photons {
            scratch.photons = photons;
        }
        lit.at.normal = top.unwrap_or(flat);
        shaded.transmittance = filter;
        shaded.passes =
            self.quality.has_transparency && !self.is_opaque(path.irradiance_depth, filter);
        shaded.film = texture.layers().first().map(|top| &top.finish.irid);
        (shaded, lit)
    }

    /// The subsurface transport and the translucency of a layer that scatters light below the surface.
    fn subsurface_of(&self, layer: &PreparedLayer) -> Option<(&SubsurfaceTransport, Rgb)> {
        let finish = layer.finish.subsurface.as_ref()?;
        Some((self.subsurface.as_deref()?, finish.translucency))
    }

    /// The own light of a layer, and its reflective properties.
    #[inline]
    pub(super) fn layer_bsdf<'l>(
        &self,
        layer: &'l PreparedLayer,
        color: Color,
    ) -> (Rgb, LayerBsdf<'l>) {
        let finish = &*layer.finish;
        let passing = if self.world.globals.rules_37 {
            color.filter + color.transmit
        } else {
            color.filter * color.rgb.max() + color.transmit
        };
        let bsdf = LayerBsdf {
            finish,
            rgb: color.rgb,
            opacity: f64::from(1.0 - passing),
            ior: 1.0,
        };
        let own = color.rgb * finish.ambient * self.world.globals.ambient_light
            + color.rgb * finish.emission;
        (own * bsdf.opacity, bsdf)
    }

    /// The reflection of a layer behind this filter, if it reflects; updates the filter. `ior` gives the relative index
    /// of refraction behind the surface, `flat` is the normal without bump mapping.
    #[inline]
    pub(super) fn layer_mirror<'l>(
        &self,
        at: &ViewPoint,
        flat: DVec3,
        bsdf: &LayerBsdf<'l>,
        ior: impl FnOnce() -> f64,
        filter: &mut Rgb,
    ) -> Option<Mirror<'l>> {
        let finish = bsdf.finish;
        if !finish.has_reflection() {
            return None;
        }
        let rule = self.world.globals.normalization();
        let mut mirror = mirror(rule, at, flat, finish, bsdf.rgb, ior);
        // The weight falls although the layers above do not darken the reflection.
        mirror.weight *= f64::from(filter.grey());
        if finish.use_alpha {
            mirror.reflectivity = mirror.reflectivity * bsdf.opacity;
        }
        if finish.conserve_energy {
            *filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
        }
        Some(mirror)
    }

    /// Traces the reflection of one layer.
    fn reflect(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        mirror: &Mirror,
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = lit.path;
        let reflected = Path {
            ray: Ray::new(hit.point, mirror.dir),
            from: Some(hit.spawn_surface),
            kind: path.kind.mirrored(),
            level: path.level + 1,
            weight: path.weight * mirror.weight,
            irradiance_depth: path.irradiance_depth,
            subsurface_depth: path.subsurface_depth,
            inside: InteriorStack::from_slice(&path.inside),
            wavelength: path.wavelength,
        };
        let Sample { mut rgb, .. } = self.trace(reflected, None, scratch);
        let irid = &mirror.finish.irid;
        if irid.amount > 0.0 {
            rgb *= self.film(irid, &lit.at, mirror.dir);
        }
        let exponent = mirror.finish.reflection.exponent;
        if exponent != 1.0 {
            rgb = rgb.map(|c| c.powf(1.0 / exponent));
        }
        rgb * mirror.reflectivity
    }

    /// The share of light that a shadow ray keeps at the surface of a hit.
    pub(super) fn transmission(&self, hit: &Hit, ray: &Ray) -> Rgb {
        let surface = &self.world.surfaces[hit.surface as usize];
        let textures = self.textures_at(surface, hit, ray.dir, TextureUse::Passed);
        let caustics = f64::from(self.interior_of(hit).caustics);
        let (_, spot) = self.pattern_point(hit, ray.dir);
        textures.iter().fold(Rgb::BLACK, |sum, weighted| {
            let layers = weighted.texture.layers().iter();
            let light = layers.fold(Rgb::WHITE, |light, layer| {
                let through = self.color(layer, weighted.point, &spot).transmission();
                if caustics == 0.0 {
                    return light * through;
                }
                let normal = self.normal(layer, weighted.point, &spot);
                light * through * (1.0 + normal.dot(ray.dir).abs().powf(caustics))
            });
            sum + light * f64::from(weighted.weight)
        })
    }

    /// The colour of a layer, its quick colour in previews.
    #[inline]
    pub(super) fn color(&self, layer: &PreparedLayer, point: DVec3, spot: &SurfacePoint) -> Color {
        match layer.quick_color() {
            Some(quick) if !self.quality.has_transparency => *quick,
            _ => layer.pigment.color_at(point, spot),
        }
    }

    /// The normal of a layer on the side that is seen, with bump mapping.
    #[inline]
    pub(super) fn normal(&self, layer: &PreparedLayer, point: DVec3, spot: &SurfacePoint) -> DVec3 {
        match layer.normal() {
            Some(bumps) if self.quality.has_normals => bumps.tilted(point, spot.normal, spot),
            _ => spot.normal,
        }
    }

    pub(super) fn interior_of(&self, hit: &Hit) -> &Interior {
        let id = self.world.surfaces[hit.surface as usize].interior;
        self.world.interiors.get(id)
    }

    /// Returns true if too little passes to be traced; negative colours count by their size.
    pub(super) fn is_opaque(&self, irradiance_depth: usize, filter: Rgb) -> bool {
        f64::from(filter.map(f32::abs).grey()) <= self.bailout(irradiance_depth)
    }
}

/// The surface point at which patterns are evaluated.
#[inline]
pub(super) fn surface_point(hit: &Hit, dir: DVec3) -> SurfacePoint {
    SurfacePoint {
        point: hit.point,
        normal: facing_normal(hit, dir),
        dir,
        uv: DVec2::ZERO,
    }
}

/// The reflection of a layer with this pigment colour; `ior` gives the relative index of refraction behind the surface,
/// `flat` is the normal without bump mapping.
pub(super) fn mirror<'f>(
    normalization: Normalization,
    at: &ViewPoint,
    flat: DVec3,
    finish: &'f Finish,
    pigment: Rgb,
    ior: impl FnOnce() -> f64,
) -> Mirror<'f> {
    let reflection = &finish.reflection;
    let cosine = -at.view.dot(at.normal);
    let mut reflectivity = if reflection.min == reflection.max {
        reflection.min
    } else {
        let share = if reflection.is_fresnel {
            fresnel(cosine, ior())
        } else {
            exact_power((1.0 - cosine).max(0.0), f64::from(reflection.falloff))
        };
        reflection.max * share + reflection.min * (1.0 - share)
    };
    // The tint of metal does not count here (measured with POV-Ray).
    let weight = if reflection.is_fresnel {
        reflectivity.max()
    } else {
        reflection.min.max().max(reflection.max.max())
    };
    if reflection.metallic != 0.0 {
        reflectivity *= metallic(reflection.metallic, pigment, cosine);
    }
    Mirror {
        reflectivity,
        weight: f64::from(weight),
        finish,
        dir: mirrored_off(normalization, at.view, at.normal, flat),
        normal: at.normal,
    }
}

/// The mirror image of a direction about a bumped normal. If it points below the flat surface it is mirrored again
/// there, or mirrored by the flat normal alone if it points below the bumped surface too (docs/povray-facts.md,
/// section 4.5).
pub(super) fn mirrored_off(
    normalization: Normalization,
    dir: DVec3,
    tilted: DVec3,
    flat: DVec3,
) -> DVec3 {
    let image = mirrored(dir, tilted);
    let image = if tilted == flat || image.dot(flat) >= 0.0 {
        image
    } else if image.dot(tilted) < 0.0 {
        mirrored(dir, flat)
    } else {
        mirrored(image, flat)
    };
    normalization.unit_or_zero(image)
}

/// Transmission without refraction.
pub(crate) struct StraightTransmission {
    /// The factor on light from behind.
    pub(crate) factor: Rgb,
    /// The factor on the transparency behind.
    pub(crate) transmit: f32,
    /// The factor on the weight of the ray.
    pub(crate) weight: f64,
    /// The interior stack behind.
    pub(crate) inside: InteriorStack,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glass_reflects_4_percent_at_normal_incidence_and_all_when_grazing() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((fresnel(0.0, 1.5) - 1.0).abs() < 1e-15);
        assert_eq!(fresnel(0.2, 1.0 / 1.5), 1.0);
    }
}
