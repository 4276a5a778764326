//! The colour of a surface: its layers from the top down, then what comes through, then its mirror images.

use super::direct::light::{LayerBsdf, LightSamples, ShadingPoint, ViewPoint, metallic, mirrored};
use super::direct::shadow_cache::ShadowCache;
use super::radiosity::{Irradiance, IrradiancePoint};
use super::refraction::StraightTransmission;
use super::{Inside, Path, Sample, Tracer};
use crate::base::color::{Color, Rgb};
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use crate::scene::interior::Interior;
use crate::scene::pattern::SurfacePoint;
use crate::scene::shape::TextureWeights;
use crate::scene::texture::{Choosing, Finish, Irid, Look, Looks, PreparedLayer, PreparedTexture};
use crate::world::{Hit, Scratch, Surface};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// What is seen at a hit.
pub(super) struct SurfaceRadiance {
    /// Light of the surface itself, and light that comes through on another way.
    pub(super) rgb: Rgb,
    /// The share of light that would come through from behind the whole scene on another way.
    pub(super) transmit: f32,
    /// Light of the mirror images, added last.
    pub(super) reflected: Rgb,
    /// What is still to be added if light also comes straight through.
    pub(super) straight_on: Option<StraightTransmission>,
}

/// The light of a texture's layers at a hit, before the rays that go on from there are followed.
pub(super) struct ShadedLayers<'t> {
    /// Its own light.
    pub(super) rgb: Rgb,
    /// The share of light that passes all layers.
    pub(super) filter: Rgb,
    /// Whether that is worth following.
    pub(super) passes: bool,
    /// The film on the top layer.
    pub(super) film: Option<&'t Irid>,
    /// Its mirror images, the top layer's first.
    pub(super) mirrors: SmallVec<[Mirror<'t>; 2]>,
}

impl SurfaceRadiance {
    /// Nothing is seen.
    const NOTHING: SurfaceRadiance = SurfaceRadiance {
        rgb: Rgb::BLACK,
        transmit: 0.0,
        reflected: Rgb::BLACK,
        straight_on: None,
    };

    /// Adds a share of another view of the same point.
    fn add(&mut self, weight: f32, other: SurfaceRadiance) {
        self.rgb += other.rgb * f64::from(weight);
        self.transmit += other.transmit * weight;
        self.reflected += other.reflected * f64::from(weight);
        let Some(mut other) = other.straight_on else {
            return;
        };
        other.factor *= Rgb::splat(weight);
        other.transmit *= weight;
        self.straight_on = Some(match self.straight_on.take() {
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
    reason = "POV-Ray keeps shares of textures in single precision, like colours"
)]
pub(super) fn single(weight: f64) -> f32 {
    weight as f32
}

/// What textures are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextureUse {
    /// They are drawn.
    Drawn,
    /// They only filter light.
    Passed,
}

/// A mirror image to be traced.
pub(super) struct Mirror<'f> {
    pub(super) reflectivity: Rgb,
    pub(super) weight: f64,
    pub(super) finish: &'f Finish,
    /// The direction of the mirrored ray.
    pub(super) dir: DVec3,
}

impl<'w> Tracer<'w> {
    /// What a ray sees at a hit, without what comes straight through. `known` is what is known of
    /// the lights.
    pub(super) fn shade(
        &self,
        path: &Path,
        hit: &Hit,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> SurfaceRadiance {
        let surface = &self.world.surfaces[hit.surface as usize];
        match self
            .looks(surface, hit, path.ray.dir, TextureUse::Drawn)
            .as_slice()
        {
            [only] if only.weight == 1.0 => {
                let arrived = (only.texture.layers().len() > 1).then(ShadowCache::default);
                let one = (only, &mut None, arrived.as_ref());
                self.shade_texture(path, hit, one, known, scratch)
            }
            several => {
                let mut sum = SurfaceRadiance::NOTHING;
                let mut tilted = None;
                let arrived = ShadowCache::default();
                for look in several {
                    let one = (look, &mut tilted, Some(&arrived));
                    let view = self.shade_texture(path, hit, one, known, scratch);
                    sum.add(look.weight, view);
                }
                sum
            }
        }
    }

    /// The textures that a ray sees at a hit, with the share of each. Shares below the bailout are not drawn. The normals
    /// of a smooth triangle decide which side is seen, not the order of its corners.
    pub(super) fn looks<'s>(
        &self,
        surface: &'s Surface,
        hit: &Hit,
        dir: DVec3,
        sight: TextureUse,
    ) -> Looks<'s> {
        let outside = match surface.inside_texture() {
            Some(inside) if hit.shading_normal.dot(dir) > 0.0 && !self.world.has_one_side(hit) => {
                return self.look_of(inside, hit, dir, sight);
            }
            _ => &*surface.texture,
        };
        let shares = if surface.skins().is_empty() {
            TextureWeights::new()
        } else {
            self.world.shares(hit)
        };
        if shares.is_empty() {
            return self.look_of(outside, hit, dir, sight);
        }
        let least = self.world.globals.adc_bailout;
        let drawn = shares.iter().filter(|share| share.weight >= least);
        let texture_of = |number: u32| {
            surface
                .skins()
                .get(number as usize)
                .map_or(outside, |skin| skin)
        };
        let minds_normal = shares
            .iter()
            .any(|share| texture_of(share.skin).minds_normal());
        let (point, mut chosen) = self.choosing(hit, dir, sight, minds_normal);
        for share in drawn {
            texture_of(share.skin).look(point, single(share.weight), &mut chosen);
        }
        chosen.looks
    }

    /// The point at which the patterns of a hit are asked, and the begin of a choice of textures there.
    fn choosing<'t>(
        &self,
        hit: &Hit,
        dir: DVec3,
        sight: TextureUse,
        minds_normal: bool,
    ) -> (DVec3, Choosing<'t>) {
        let (point, spot) = self.place(hit, dir);
        let follows = minds_normal && sight == TextureUse::Drawn && self.quality.has_normals;
        let chosen = if follows {
            Choosing::drawn_at(spot)
        } else {
            Choosing::at(spot)
        };
        (point, chosen)
    }

    /// What a ray sees of a texture that covers a hit alone.
    #[inline]
    fn look_of<'t>(
        &self,
        texture: &'t PreparedTexture,
        hit: &Hit,
        dir: DVec3,
        sight: TextureUse,
    ) -> Looks<'t> {
        if texture.is_patterned() {
            let (point, mut chosen) = self.choosing(hit, dir, sight, texture.minds_normal());
            texture.look(point, 1.0, &mut chosen);
            return chosen.looks;
        }
        let is_mapped = self.world.surfaces[hit.surface as usize].is_mapped();
        Looks::from_buf([Look {
            weight: 1.0,
            texture,
            point: if is_mapped {
                self.place(hit, dir).0
            } else {
                hit.point
            },
        }])
    }

    /// The point at which the patterns of a hit are asked, and the place itself.
    #[inline]
    pub(super) fn place(&self, hit: &Hit, dir: DVec3) -> (DVec3, SurfacePoint) {
        let mut spot = spot(hit, dir);
        let surface = &self.world.surfaces[hit.surface as usize];
        if !surface.uses_uv() {
            return (hit.point, spot);
        }
        spot.uv = self.world.uv(hit);
        let is_mapped = surface.is_mapped();
        let point = if is_mapped {
            spot.on_the_map()
        } else {
            hit.point
        };
        (point, spot)
    }

    /// What a ray sees of one texture at a hit. `tilted` is the normal that bumps have made last at this hit: as in POV-Ray
    /// that is the one whose slope patterns see, also those of layers and textures that have no bumps. `arrived` is what is
    /// known of light from textures before.
    fn shade_texture(
        &self,
        path: &Path,
        hit: &Hit,
        of: (&Look, &mut Option<DVec3>, Option<&ShadowCache>),
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> SurfaceRadiance {
        let mut view = SurfaceRadiance::NOTHING;
        let (shaded, lit) = self.layers(path, hit, of, known, scratch);
        view.rgb = shaded.rgb;
        let mut is_total = false;
        if shaded.passes {
            let filter = (shaded.filter, shaded.film);
            is_total = self.pass(&lit, hit, filter, &mut view, scratch);
        }
        if scratch.order_dependent() && (self.has_air() || !shaded.mirrors.is_empty()) {
            self.follow_straight_on(&lit, hit, &mut view, scratch);
        }
        if !is_total {
            for mirror in &shaded.mirrors {
                view.reflected += self.reflect(&lit, hit, mirror, scratch);
            }
        }
        view
    }

    /// The light of all layers of a texture at a hit, and what of others they show.
    pub(super) fn layers<'p>(
        &self,
        path: &'p Path,
        hit: &'p Hit,
        (look, tilted, arrived): (&Look<'p>, &mut Option<DVec3>, Option<&'p ShadowCache>),
        known: LightSamples<'p>,
        scratch: &mut Scratch,
    ) -> (ShadedLayers<'p>, ShadingPoint<'p>)
    where
        'w: 'p,
    {
        let texture = look.texture;
        let surface = &self.world.surfaces[hit.surface as usize];
        let mut lit = ShadingPoint {
            at: ViewPoint::new(hit, path.ray.dir),
            departure: Some(&hit.departure),
            path,
            known,
            arrived,
            is_double_illuminated: surface.is_double_illuminated(),
            lights: self.world.lights.of(surface.lights),
            collects: self.has_caustics() && !surface.photons().keeps_none,
        };
        let mut shaded = ShadedLayers {
            rgb: Rgb::BLACK,
            filter: Rgb::WHITE,
            passes: false,
            film: None,
            mirrors: SmallVec::new(),
        };
        if !self.quality.has_light {
            if let Some(lowest) = texture.layers().last() {
                let (_, spot) = self.place(hit, path.ray.dir);
                shaded.rgb = self.color(lowest, look.point, &spot).rgb;
            }
            return (shaded, lit);
        }
        let mut filter = Rgb::WHITE;
        let mut gathered = Irradiance::default();
        let mut photons = None;
        let (_, mut spot) = self.place(hit, path.ray.dir);
        let flat = lit.at.normal;
        let mut top = None;
        for layer in texture.layers() {
            lit.at.normal = match layer.normal() {
                Some(bumps) if self.quality.has_normals => {
                    let (normal, seen) = bumps.tilted_and_seen(look.point, flat, &spot);
                    *tilted = Some(seen);
                    normal
                }
                _ => flat,
            };
            top.get_or_insert(lit.at.normal);
            spot.normal = tilted.unwrap_or(flat);
            let color = self.color(layer, look.point, &spot);
            spot.normal = flat;
            let mut own = self.layer(&lit, layer, color, scratch);
            if lit.collects {
                let (_, coat) = self.coat(layer, color);
                own += self.caustics(&lit, &coat, flat, &mut photons, scratch);
            }
            if let Some(radiosity) = &self.world.radiosity {
                let gathering = IrradiancePoint::new(radiosity, &lit, flat);
                own += self.gathered(&gathering, (layer, color, filter), &mut gathered, scratch);
            }
            shaded.rgb += own * filter;
            if self.quality.has_reflection && layer.finish.has_reflection() {
                let coat = (&*layer.finish, color.rgb);
                let ior = || self.relative_ior(&path.inside, surface.interior);
                let mut mirror = mirror(&lit.at, flat, coat, ior);
                // Though the layers above take nothing from it.
                mirror.weight *= f64::from(filter.grey());
                if layer.finish.conserve_energy {
                    filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
                }
                shaded.mirrors.push(mirror);
            }
            filter *= color.transmission();
            if self.is_opaque(path.gathered, filter) {
                break;
            }
        }
        if let Some(photons) = photons {
            scratch.photons = photons;
        }
        lit.at.normal = top.unwrap_or(flat);
        shaded.filter = filter;
        shaded.passes = self.quality.has_transparency && !self.is_opaque(path.gathered, filter);
        shaded.film = texture.layers().first().map(|top| &top.finish.irid);
        (shaded, lit)
    }

    /// The light of one layer itself.
    fn layer(
        &self,
        lit: &ShadingPoint,
        layer: &PreparedLayer,
        color: Color,
        scratch: &mut Scratch,
    ) -> Rgb {
        let (own, coat) = self.coat(layer, color);
        own + self.illuminate(lit, &coat, scratch)
    }

    /// What one layer shines of itself, and how it takes light.
    #[inline]
    pub(super) fn coat<'l>(&self, layer: &'l PreparedLayer, color: Color) -> (Rgb, LayerBsdf<'l>) {
        let finish = &*layer.finish;
        let passing = if self.world.globals.rules_37 {
            color.filter + color.transmit
        } else {
            color.filter * color.rgb.max() + color.transmit
        };
        let coat = LayerBsdf {
            finish,
            rgb: color.rgb,
            opacity: f64::from(1.0 - passing),
        };
        let own = color.rgb * finish.ambient * self.world.globals.ambient_light
            + color.rgb * finish.emission;
        (own * coat.opacity, coat)
    }

    /// The mirror image of one layer.
    fn reflect(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        mirror: &Mirror,
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = lit.path;
        let onward = Path {
            ray: Ray::new(hit.point, mirror.dir),
            from: Some(hit.departure),
            seen: path.seen.mirrored(),
            level: path.level + 1,
            weight: path.weight * mirror.weight,
            gathered: path.gathered,
            inside: Inside::from_slice(&path.inside),
            wavelength: path.wavelength,
        };
        let Sample { mut rgb, .. } = self.trace(onward, None, scratch);
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

    /// The share of shadow light that passes the surface of a hit.
    pub(super) fn transmission(&self, hit: &Hit, ray: &Ray) -> Rgb {
        let surface = &self.world.surfaces[hit.surface as usize];
        let looks = self.looks(surface, hit, ray.dir, TextureUse::Passed);
        let caustics = f64::from(self.interior_of(hit).caustics);
        let (_, spot) = self.place(hit, ray.dir);
        looks.iter().fold(Rgb::BLACK, |sum, look| {
            let layers = look.texture.layers().iter();
            let light = layers.fold(Rgb::WHITE, |light, layer| {
                let through = self.color(layer, look.point, &spot).transmission();
                if caustics == 0.0 {
                    return light * through;
                }
                let normal = self.normal(layer, look.point, &spot);
                light * through * (1.0 + normal.dot(ray.dir).abs().powf(caustics))
            });
            sum + light * f64::from(look.weight)
        })
    }

    /// The colour of a layer, in previews its quick colour.
    #[inline]
    pub(super) fn color(&self, layer: &PreparedLayer, point: DVec3, spot: &SurfacePoint) -> Color {
        match layer.quick_color() {
            Some(quick) if !self.quality.has_transparency => *quick,
            _ => layer.pigment.patterned(point, spot),
        }
    }

    /// The normal of a layer on the side that is seen, tilted by its bumps.
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

    /// Whether too little passes to be looked at; colours that take light away count as much as those that give it.
    pub(super) fn is_opaque(&self, gathered: usize, filter: Rgb) -> bool {
        f64::from(filter.map(f32::abs).grey()) <= self.bailout(gathered)
    }
}

/// The place that patterns are asked about.
#[inline]
pub(super) fn spot(hit: &Hit, dir: DVec3) -> SurfacePoint {
    SurfacePoint {
        point: hit.point,
        normal: facing_normal(hit, dir),
        dir,
        uv: DVec2::ZERO,
    }
}

/// The shading normal on the side from which a ray comes.
#[inline]
pub(super) fn facing_normal(hit: &Hit, dir: DVec3) -> DVec3 {
    if hit.shading_normal.dot(dir) > 0.0 {
        -hit.shading_normal
    } else {
        hit.shading_normal
    }
}

/// How much of its surroundings a layer with a pigment of this colour reflects at this angle; `ior` is that of what is
/// behind relative to that before it, `flat` the normal without bumps.
pub(super) fn mirror<'f>(
    at: &ViewPoint,
    flat: DVec3,
    (finish, pigment): (&'f Finish, Rgb),
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
    // What metal takes away does not count here (measured with POV-Ray).
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
        dir: mirrored_off(at.view, at.normal, flat),
    }
}

/// The mirror image of a direction in a surface tilted by bumps. Where that goes into the flat surface it is mirrored
/// there as well, or there alone if it goes into the tilted one too (facts 4.5).
pub(super) fn mirrored_off(dir: DVec3, tilted: DVec3, flat: DVec3) -> DVec3 {
    let image = mirrored(dir, tilted);
    if tilted == flat || image.dot(flat) >= 0.0 {
        image
    } else if image.dot(tilted) < 0.0 {
        mirrored(dir, flat)
    } else {
        mirrored(image, flat)
    }
}

/// The reflectance of unpolarised light by Fresnel's equations, for a relative index of refraction of what is behind.
fn fresnel(cosine: f64, ior: f64) -> f64 {
    let g_sq = ior * ior + cosine * cosine - 1.0;
    if g_sq < 0.0 {
        return 1.0;
    }
    let g = g_sq.sqrt();
    let across = (g - cosine) / (g + cosine);
    let along = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    (0.5 * across * across * (1.0 + along * along)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glass_reflects_four_percent_straight_and_all_when_grazing() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((fresnel(0.0, 1.5) - 1.0).abs() < 1e-15);
        assert_eq!(fresnel(0.2, 1.0 / 1.5), 1.0);
    }
}
