//! Photon tracing. Before the target, photons pass only `pass_through` objects; from the target on they are stored at
//! each surface and go on by reflection and refraction, up to the trace level and the bailout.

use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::Photon;
use crate::render::shade::Scratch;
use crate::render::shade::bsdf::ViewPoint;
use crate::render::shade::bsdf::facing_normal;
use crate::render::shade::shading_point::{LightSamples, ShadingPoint};
use crate::render::shade::surface::{Mirror, TextureUse, mirror, mirrored_off};
use crate::render::shade::transmission::interior_stack::{Refraction, bend};
use crate::render::shade::transmission::spectrum;
use crate::render::shade::{InteriorStack, Path, Tracer};
use crate::scene::light::Light;
use crate::scene::texture::{Reflection, WeightedTexture};
use crate::world::PhotonMapping;
use crate::world::{Hit, Query, SpawnSurface};
use glam::DVec3;
use smallvec::SmallVec;

/// The photons of a scene, and the state of their emission.
pub(in crate::render::shade) struct PhotonTally<'p> {
    pub(in crate::render::shade) photons: &'p PhotonMapping,
    /// The current light and target.
    pub(in crate::render::shade) light: Option<&'p Light>,
    pub(in crate::render::shade) target: u32,
    /// The spacing of neighbouring photons at unit distance; for parallel light that at any distance, in units of the
    /// scene.
    pub(in crate::render::shade) spread: f64,
    /// The length of the path of the current photon so far. What was added to it at a surface is subtracted behind it, so
    /// that later branches share POV-Ray's rounding.
    pub(in crate::render::shade) path_length: f64,
    /// The transmittance of the layers of the surface that was refracted through last.
    pub(in crate::render::shade) filter: Rgb,
    /// The random numbers of directions.
    pub(in crate::render::shade) random: Stream,
    /// A photon of the current ring has hit the target.
    pub(in crate::render::shade) has_hit: bool,
    /// The number of emitted photons.
    pub(in crate::render::shade) count: u64,
    /// The most memory that photons may take, in bytes.
    pub(in crate::render::shade) max_bytes: u64,
    pub(in crate::render::shade) on_surfaces: Vec<Photon>,
    pub(in crate::render::shade) in_media: Vec<Photon>,
}

/// A photon on its path.
pub(in crate::render::shade) struct PhotonPath {
    pub(in crate::render::shade) path: Path,
    pub(in crate::render::shade) light: Rgb,
    /// It has hit its target.
    pub(in crate::render::shade) has_hit_target: bool,
}

/// One texture of a hit, and the photon's light on it.
struct PhotonHit<'a> {
    hit: &'a Hit,
    texture: &'a WeightedTexture<'a>,
    light: Rgb,
    refracts: bool,
    reflects: bool,
}

/// A photon at a surface.
struct PhotonInteraction<'a> {
    hit: &'a Hit,
    lit: &'a ShadingPoint<'a>,
    /// The transmittance of the layers.
    filter: Rgb,
    /// The light before the surface.
    light: Rgb,
}

/// The light that a reflection with an exponent mirrors.
fn mirrored_light(light: Rgb, reflection: &Reflection) -> Rgb {
    if reflection.exponent == 1.0 {
        light
    } else {
        light.map(|c| c.powf(1.0 / reflection.exponent))
    }
}

impl PhotonInteraction<'_> {
    fn onward(
        &self,
        dir: DVec3,
        weight: f64,
        inside: InteriorStack,
        light: Rgb,
        wavelength: Option<f64>,
    ) -> PhotonPath {
        let path = self.lit.path;
        PhotonPath {
            path: Path {
                ray: Ray::new(self.hit.point, dir),
                from: Some(self.hit.spawn_surface),
                kind: path.kind,
                level: path.level + 1,
                weight: path.weight * weight,
                irradiance_depth: 0,
                subsurface_depth: 0,
                inside,
                wavelength,
            },
            light,
            has_hit_target: true,
        }
    }
}

impl<'p> PhotonTally<'p> {
    /// Starts a pair of a light and a target.
    pub(in crate::render::shade) fn begin(&mut self, light: &'p Light, target: u32, spread: f64) {
        (self.light, self.target, self.spread) = (Some(light), target, spread);
        if light.is_parallel {
            self.spread /= self.photons.unit;
        }
    }

    /// The factor by which photons are farther apart after a path of this length: in units of the scene, or 1 for
    /// parallel light.
    pub(in crate::render::shade) fn spreading(&self, path_length: f64) -> f64 {
        let is_parallel = self.light.is_some_and(|light| light.is_parallel);
        if is_parallel {
            1.0
        } else {
            path_length / self.photons.unit
        }
    }

    /// A photon at a point, after a path of this length from its light through `origin`.
    pub(in crate::render::shade) fn photon(
        &self,
        point: DVec3,
        light: Rgb,
        path_length: f64,
        origin: DVec3,
    ) -> Photon {
        let fading = self
            .light
            .map_or(1.0, |light| light.fade.attenuation(path_length));
        let spreading = self.spreading(path_length);
        let flux = light * (fading * self.spread * self.spread) * (spreading * spreading);
        let [point, origin] = [point, origin].map(|x| self.photons.scene_point(x));
        match self.photons.rounds_light {
            true => Photon::rounded(point, flux, origin),
            false => Photon::new(point, flux, origin),
        }
    }
}

impl<'w> Tracer<'w> {
    /// Traces a photon and its reflected and refracted descendants.
    pub(in crate::render::shade) fn trace_photon(
        &self,
        mut photon: PhotonPath,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        for _ in 0..crate::render::shade::MAX_STRAIGHT {
            let Some(light) = tally.light else { return };
            let path = &photon.path;
            if path.level >= tally.photons.max_trace_level
                || path.weight < tally.photons.adc_bailout
            {
                return;
            }
            let query = Query {
                ray: path.ray,
                origin_surface: path.from,
                t_max: f64::INFINITY,
                kind: path.kind,
            };
            let nearest = self.world.nearest(&query, &mut scratch.query);
            let from = path.from.as_ref();
            let again =
                from.and_then(|from| self.world.hit_again(&path.ray, from, nearest.as_ref()));
            let Some(hit) = again.or(nearest) else {
                return;
            };
            let hit = self.world.rounded_for_photon(&path.ray, hit);
            let surface = &self.world.surfaces[hit.surface as usize];
            let role = surface.photons();
            self.through_media(&mut photon, hit.t, surface.lights, tally, scratch);
            tally.path_length += hit.t;
            let had_hit_target = photon.has_hit_target;
            if !had_hit_target {
                if role.target == Some(tally.target) && !role.passes_through {
                    photon.has_hit_target = true;
                    tally.has_hit = true;
                } else if role.passes_through {
                    let filter = self.transmission(&hit, &photon.path.ray);
                    photon.light *= filter;
                    photon.path.weight *= f64::from(filter.max());
                    photon.path.level += 1;
                    let interior = surface.interior;
                    crate::render::shade::transmission::interior_stack::cross(
                        &mut photon.path.inside,
                        interior,
                    );
                    photon.path.ray = Ray::new(hit.point, photon.path.ray.dir);
                    photon.path.from = Some(hit.spawn_surface);
                    continue;
                } else {
                    return;
                }
            }
            if photon.path.inside.contains(&surface.interior) {
                photon.light *= self.interior_of(&hit).fade(hit.t);
            }
            let textures = self.textures_at(surface, &hit, photon.path.ray.dir, TextureUse::Passed);
            for look in &textures {
                let of_look = photon.light * f64::from(look.weight);
                if had_hit_target && !role.collects_none {
                    let origin = photon.path.ray.origin;
                    let stored = tally.photon(hit.point, of_look, tally.path_length, origin);
                    tally.on_surfaces.push(stored);
                }
                let at = PhotonHit {
                    hit: &hit,
                    texture: look,
                    light: of_look,
                    refracts: role.refracts(&light.photons),
                    reflects: role.reflects(&light.photons),
                };
                self.interact(&photon, &at, tally, scratch);
            }
            tally.path_length -= hit.t;
            return;
        }
    }

    /// Reflects and refracts a photon at a surface.
    fn interact(
        &self,
        photon: &PhotonPath,
        at: &PhotonHit,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let &PhotonHit {
            hit,
            texture: look,
            light,
            refracts,
            reflects,
        } = at;
        let path = &photon.path;
        let spawn_surface: SpawnSurface = hit.spawn_surface;
        let mut lit = ShadingPoint {
            at: ViewPoint::new(hit, path.ray.dir),
            spawn_surface: Some(&spawn_surface),
            path,
            known: LightSamples::NONE,
            shadow_cache: None,
            is_double_illuminated: false,
            lights: &[],
            collects: false,
        };
        let mut mirrors: SmallVec<[Mirror; 2]> = SmallVec::new();
        let mut filter = Rgb::WHITE;
        let (_, spot) = self.pattern_point(hit, path.ray.dir);
        let flat = lit.at.normal;
        let mut top = None;
        let rule = self.world.globals.normalization();
        for layer in look.texture.layers() {
            lit.at.normal = self.normal(layer, look.point, &spot);
            top.get_or_insert(lit.at.normal);
            let mut color = self.color(layer, look.point, &spot);
            // The layers above colour it.
            color.rgb *= filter;
            filter *= color.transmission();
            if layer.finish.has_reflection() {
                let mirror = mirror(rule, &lit.at, flat, &layer.finish, color.rgb, || {
                    let surface = &self.world.surfaces[hit.surface as usize];
                    self.relative_ior(&path.inside, surface.interior)
                });
                if layer.finish.conserve_energy {
                    filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
                }
                mirrors.push(mirror);
            }
            if f64::from(filter.grey()) <= tally.photons.adc_bailout {
                break;
            }
        }
        let lowest = lit.at.normal;
        let top = top.unwrap_or(flat);
        lit.at.normal = top;
        let interaction = PhotonInteraction {
            hit,
            lit: &lit,
            filter,
            light,
        };
        let mut is_total = false;
        if refracts && f64::from(filter.map(f32::abs).grey()) > tally.photons.adc_bailout {
            tally.filter = filter;
            is_total = self.refract(&interaction, tally, scratch);
        }
        if !reflects {
            return;
        }
        // All layers mirror about the normal of the lowest one.
        let dir = mirrored_off(rule, path.ray.dir, lowest, flat);
        for mirror in &mirrors {
            if is_total && mirror.is_replaced_by_total(top) {
                continue;
            }
            let weight = mirror.weight * f64::from(mirror.reflectivity.max());
            let inside = InteriorStack::from_slice(&path.inside);
            let mut onward = interaction.onward(
                dir,
                weight,
                inside,
                mirrored_light(light, &mirror.finish.reflection) * mirror.reflectivity,
                path.wavelength,
            );
            onward.path.kind = path.kind.mirrored();
            self.trace_photon(onward, tally, scratch);
        }
    }

    /// Refracts a photon. Returns true for total internal reflection.
    fn refract(
        &self,
        interaction: &PhotonInteraction,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) -> bool {
        let path = interaction.lit.path;
        let interior = self.world.surfaces[interaction.hit.surface as usize].interior;
        let crossing = self.crossing(&path.inside, interior);
        let normal = interaction.lit.at.normal;
        let weight = f64::from(interaction.filter.max());
        let mut send = |light: Rgb, wavelength: Option<f64>| {
            let bent = bend(path.ray.dir, normal, crossing.ratio_at(wavelength));
            let is_total = matches!(bent, Refraction::Total);
            let (inside, light) = match is_total {
                true => (&path.inside, light),
                // As in POV-Ray, dispersed light after the first wavelength is filtered as by the surface that the one
                // before it passed last.
                false => (&crossing.inside, light * tally.filter),
            };
            let dir = match bent {
                Refraction::None => path.ray.dir,
                Refraction::To(dir) => dir,
                Refraction::Total => {
                    let flat = facing_normal(interaction.hit, path.ray.dir);
                    mirrored_off(
                        self.world.globals.normalization(),
                        path.ray.dir,
                        normal,
                        flat,
                    )
                }
            };
            let inside = InteriorStack::from_slice(inside);
            let mut onward = interaction.onward(dir, weight, inside, light, wavelength);
            if is_total {
                onward.path.kind = path.kind.mirrored();
            }
            self.trace_photon(onward, tally, scratch);
            is_total
        };
        if path.wavelength.is_none() && crossing.splits() {
            let count = self.interior_of(interaction.hit).dispersion_samples;
            for number in 0..count {
                let band = spectrum::band(number, count);
                let light = interaction.light * band.hue / f64::from(count);
                send(light, Some(band.wavelength));
            }
            return false;
        }
        send(interaction.light, path.wavelength)
    }
}
