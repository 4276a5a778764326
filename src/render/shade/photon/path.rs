//! A photon on its way: through what it may pass, off its target and on, and where it comes to rest.

use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::{Photon, Photons};
use crate::render::shade::direct::light::{LightSamples, ShadingPoint, ViewPoint};
use crate::render::shade::interior_stack::{Refraction, bend};
use crate::render::shade::surface::{Mirror, TextureUse, facing_normal, mirror, mirrored_off};
use crate::render::shade::{Inside, Path, Tracer, spectrum};
use crate::scene::light::Light;
use crate::scene::texture::Look;
use crate::world::{Hit, Query, Scratch, SpawnSurface};
use glam::DVec3;
use smallvec::SmallVec;

/// What all photons of a scene come to.
pub(in crate::render::shade) struct PhotonTally<'p> {
    pub(in crate::render::shade) photons: &'p Photons,
    /// The light and the target at hand.
    pub(in crate::render::shade) light: Option<&'p Light>,
    pub(in crate::render::shade) target: u32,
    /// The distance of neighbouring photons one unit away; of parallel ones everywhere.
    pub(in crate::render::shade) spread: f64,
    /// The random numbers of directions.
    pub(in crate::render::shade) random: Stream,
    /// Whether a photon of the ring at hand has met the target.
    pub(in crate::render::shade) has_hit: bool,
    /// How many were sent.
    pub(in crate::render::shade) count: u64,
    pub(in crate::render::shade) on_surfaces: Vec<Photon>,
    pub(in crate::render::shade) in_media: Vec<Photon>,
}

/// A photon.
pub(in crate::render::shade) struct PhotonPath {
    pub(in crate::render::shade) path: Path,
    pub(in crate::render::shade) light: Rgb,
    /// How far it has come.
    pub(in crate::render::shade) way: f64,
    /// Whether it has met its target.
    pub(in crate::render::shade) has_met: bool,
}

/// What a surface does with a photon.
struct PhotonInteraction<'a> {
    hit: &'a Hit,
    lit: &'a ShadingPoint<'a>,
    /// The share of light that its layers let through.
    filter: Rgb,
    /// The light before them.
    light: Rgb,
    way: f64,
}

impl PhotonInteraction<'_> {
    fn onward(
        &self,
        dir: DVec3,
        weight: f64,
        inside: Inside,
        light: Rgb,
        wavelength: Option<f64>,
    ) -> PhotonPath {
        let path = self.lit.path;
        PhotonPath {
            path: Path {
                ray: Ray::new(self.hit.point, dir),
                from: Some(self.hit.departure),
                seen: path.seen,
                level: path.level + 1,
                weight: path.weight * weight,
                gathered: 0,
                inside,
                wavelength,
            },
            light,
            way: self.way,
            has_met: true,
        }
    }
}

impl<'p> PhotonTally<'p> {
    /// Starts with a light and a target.
    pub(in crate::render::shade) fn begin(&mut self, light: &'p Light, target: u32, spread: f64) {
        (self.light, self.target, self.spread) = (Some(light), target, spread);
    }

    /// How far neighbouring photons are apart that have come so far, in units of the scene.
    pub(in crate::render::shade) fn width(&self, way: f64) -> f64 {
        let is_parallel = self.light.is_some_and(|light| light.is_parallel);
        self.spread * if is_parallel { 1.0 } else { way } / self.photons.unit
    }

    /// Keeps a photon on a surface.
    fn keep(&mut self, point: DVec3, light: Rgb, way: f64, origin: DVec3) {
        let Some(source) = self.light else { return };
        let width = self.width(way);
        let light = light * (width * width) * source.fade.share(way);
        let [point, origin] = [point, origin].map(|place| self.photons.own(place));
        self.on_surfaces.push(Photon::new(point, light, origin));
    }
}

impl<'w> Tracer<'w> {
    /// Follows a photon, and what comes of it.
    pub(in crate::render::shade) fn fly(
        &self,
        mut flight: PhotonPath,
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        for _ in 0..crate::render::shade::MOST_PASSED {
            let Some(light) = shot.light else { return };
            let path = &flight.path;
            if path.level >= shot.photons.max_trace_level || path.weight < shot.photons.adc_bailout
            {
                return;
            }
            let query = Query {
                ray: path.ray,
                origin_surface: path.from,
                t_max: f64::INFINITY,
                kind: path.seen,
            };
            let Some(hit) = self.world.nearest(&query, scratch) else {
                return;
            };
            let surface = &self.world.surfaces[hit.surface as usize];
            let role = surface.photons();
            self.through_media(&mut flight, hit.t, surface.lights, shot, scratch);
            flight.way += hit.t;
            let was_met = flight.has_met;
            if !was_met {
                if role.target == Some(shot.target) && !role.is_passed {
                    flight.has_met = true;
                    shot.has_hit = true;
                } else if role.is_passed {
                    flight.light *= self.transmission(&hit, &flight.path.ray);
                    let interior = surface.interior;
                    crate::render::shade::interior_stack::cross(&mut flight.path.inside, interior);
                    flight.path.ray = Ray::new(hit.point, flight.path.ray.dir);
                    flight.path.from = Some(hit.departure);
                    continue;
                } else {
                    return;
                }
            }
            if flight.path.inside.contains(&surface.interior) {
                flight.light *= self.interior_of(&hit).fade(hit.t);
            }
            let looks = self.looks(surface, &hit, flight.path.ray.dir, TextureUse::Passed);
            for look in &looks {
                let of_look = flight.light * f64::from(look.weight);
                if was_met && !role.keeps_none {
                    shot.keep(hit.point, of_look, flight.way, flight.path.ray.origin);
                }
                let goes_on = (role.refracts(&light.photons), role.reflects(&light.photons));
                self.meet(&flight, (&hit, look, of_look), goes_on, shot, scratch);
            }
            return;
        }
    }

    /// What a photon does at a surface.
    fn meet(
        &self,
        flight: &PhotonPath,
        (hit, look, light): (&Hit, &Look, Rgb),
        (refracts, reflects): (bool, bool),
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let path = &flight.path;
        let departure: SpawnSurface = hit.departure;
        let mut lit = ShadingPoint {
            at: ViewPoint::new(hit, path.ray.dir),
            departure: Some(&departure),
            path,
            known: LightSamples::NONE,
            arrived: None,
            is_double_illuminated: false,
            lights: &[],
            collects: false,
        };
        let mut mirrors: SmallVec<[Mirror; 2]> = SmallVec::new();
        let mut filter = Rgb::WHITE;
        let (_, spot) = self.place(hit, path.ray.dir);
        let flat = lit.at.normal;
        let mut top = None;
        for layer in look.texture.layers() {
            lit.at.normal = self.normal(layer, look.point, &spot);
            top.get_or_insert(lit.at.normal);
            let color = self.color(layer, look.point, &spot);
            if reflects && layer.finish.has_reflection() {
                let coat = (&*layer.finish, color.rgb);
                let mirror = mirror(&lit.at, flat, coat, || {
                    let surface = &self.world.surfaces[hit.surface as usize];
                    self.relative_ior(&path.inside, surface.interior)
                });
                if layer.finish.conserve_energy {
                    filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
                }
                mirrors.push(mirror);
            }
            filter *= color.transmission();
            if f64::from(filter.grey()) <= shot.photons.adc_bailout {
                break;
            }
        }
        lit.at.normal = top.unwrap_or(flat);
        let meeting = PhotonInteraction {
            hit,
            lit: &lit,
            filter,
            light,
            way: flight.way,
        };
        let mut is_total = false;
        if refracts && f64::from(filter.map(f32::abs).grey()) > shot.photons.adc_bailout {
            is_total = self.refract(&meeting, shot, scratch);
        }
        if is_total || !reflects {
            return;
        }
        for mirror in &mirrors {
            let weight = mirror.weight * f64::from(mirror.reflectivity.max());
            let inside = Inside::from_slice(&path.inside);
            let onward = meeting.onward(
                mirror.dir,
                weight,
                inside,
                light * mirror.reflectivity,
                path.wavelength,
            );
            self.fly(onward, shot, scratch);
        }
    }

    /// Sends a photon through a surface; says whether it is reflected as a whole instead.
    fn refract(
        &self,
        meeting: &PhotonInteraction,
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) -> bool {
        let path = meeting.lit.path;
        let interior = self.world.surfaces[meeting.hit.surface as usize].interior;
        let passage = self.passage(&path.inside, interior);
        let normal = meeting.lit.at.normal;
        let light = meeting.light * meeting.filter;
        let weight = f64::from(meeting.filter.max());
        let mut send = |dir: DVec3, inside: &Inside, light: Rgb, wavelength: Option<f64>| {
            let inside = Inside::from_slice(inside);
            let onward = meeting.onward(dir, weight, inside, light, wavelength);
            self.fly(onward, shot, scratch);
        };
        let thrown_back = || {
            let flat = facing_normal(meeting.hit, path.ray.dir);
            mirrored_off(path.ray.dir, normal, flat)
        };
        if path.wavelength.is_none() && passage.splits() {
            let count = self.interior_of(meeting.hit).dispersion_samples;
            let share = 1.0 / f64::from(count);
            for number in 0..count {
                let band = spectrum::band(number, count);
                let wavelength = Some(band.wavelength);
                let light = light * band.hue * share;
                match bend(path.ray.dir, normal, passage.ratio_at(wavelength)) {
                    Refraction::None => send(path.ray.dir, &passage.inside, light, wavelength),
                    Refraction::To(dir) => send(dir, &passage.inside, light, wavelength),
                    Refraction::Total => send(thrown_back(), &path.inside, light, wavelength),
                }
            }
            return false;
        }
        match bend(path.ray.dir, normal, passage.ratio_at(path.wavelength)) {
            Refraction::None => send(path.ray.dir, &passage.inside, light, path.wavelength),
            Refraction::To(dir) => send(dir, &passage.inside, light, path.wavelength),
            Refraction::Total => {
                send(thrown_back(), &path.inside, meeting.light, path.wavelength);
                return true;
            }
        }
        false
    }
}
