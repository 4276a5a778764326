//! Transmission through a surface: straight, refracted, totally reflected, or dispersed.

use super::interior_stack::{Refraction, SurfaceCrossing, bend};
use super::spectrum;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::render::shade::bsdf::facing_normal;
use crate::render::shade::shading_point::ShadingPoint;
use crate::render::shade::surface::{StraightTransmission, SurfaceRadiance, mirrored_off, single};
use crate::render::shade::{InteriorStack, Path, Sample, Scratch, Tracer};
use crate::scene::texture::Irid;
use crate::world::{Hit, InteriorId};
use glam::DVec3;

/// Limit on nested surfaces that are passed recursively: each takes part of the stack.
const MAX_NESTED: u32 = 100;

/// The transmission of a surface.
pub(in crate::render::shade) struct LayerTransmission<'f> {
    /// The film on the top layer.
    film: Option<&'f Irid>,
    /// The factor on light.
    pub(in crate::render::shade) factor: Rgb,
    /// The same for total internal reflection, without the filter of the layers.
    pub(in crate::render::shade) total_reflection: Rgb,
    /// The factor on the transparency behind.
    pub(in crate::render::shade) transmit: f32,
    /// The factor on the weight of the ray.
    pub(in crate::render::shade) weight: f64,
    pub(in crate::render::shade) crossing: SurfaceCrossing,
}

impl Tracer<'_> {
    /// The transmission of a surface with this filter and film, for a ray with an interior stack and the length of its
    /// segment.
    pub(in crate::render::shade) fn layer_transmission<'f>(
        &self,
        inside: &InteriorStack,
        length: f64,
        interior: InteriorId,
        filter: Rgb,
        film: Option<&'f Irid>,
    ) -> LayerTransmission<'f> {
        let crossing = self.crossing(inside, interior);
        let interior = self.world.interiors.get(interior);
        let fade = if crossing.was_inside {
            interior.fade(length)
        } else {
            Rgb::WHITE
        };
        LayerTransmission {
            film,
            factor: filter * fade * interior.refraction,
            total_reflection: fade * interior.refraction,
            transmit: fade.grey() * filter.grey(),
            weight: f64::from(filter.map(f32::abs).max()),
            crossing,
        }
    }

    /// Adds the light transmitted through a surface. Returns true for total internal reflection, which replaces
    /// that of layers with the same normal.
    pub(in crate::render::shade) fn pass(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        filter: Rgb,
        film: Option<&Irid>,
        view: &mut SurfaceRadiance,
        scratch: &mut Scratch,
    ) -> bool {
        let path = lit.path;
        let interior = self.world.surfaces[hit.surface as usize].interior;
        let transmission = self.layer_transmission(&path.inside, hit.t, interior, filter, film);
        if path.wavelength.is_none() && transmission.crossing.splits() {
            self.split(lit, hit, &transmission, view, scratch);
            return false;
        }
        let ratio = transmission.crossing.ratio_at(path.wavelength);
        match bend(path.ray.dir, lit.at.normal, ratio) {
            Refraction::None => {
                view.straight = Some(StraightTransmission {
                    factor: transmission.factor,
                    transmit: transmission.transmit,
                    weight: transmission.weight,
                    inside: transmission.crossing.inside,
                });
                false
            }
            Refraction::To(dir) => {
                let behind = self.refracted(lit, hit, &transmission, dir, path.wavelength, scratch);
                view.rgb += behind.rgb;
                view.transmit = behind.transmit;
                false
            }
            Refraction::Total => {
                let image =
                    self.total_reflection(lit, hit, &transmission, path.wavelength, scratch);
                view.rgb += transmission.total_reflection * image;
                true
            }
        }
    }

    /// Traces the light behind a surface without refraction at once, for the rays that follow in POV-Ray's order.
    /// Beyond the nesting limit the caller has to do it.
    pub(in crate::render::shade) fn trace_unrefracted(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        view: &mut SurfaceRadiance,
        scratch: &mut Scratch,
    ) {
        let path = lit.path;
        if scratch.depth >= MAX_NESTED {
            return;
        }
        let Some(onward) = view.straight.take() else {
            return;
        };
        let behind = if path.level + 1 < self.world.globals.max_trace_level {
            scratch.depth += 1;
            let path = Path {
                ray: Ray::new(hit.point, path.ray.dir),
                from: Some(hit.spawn_surface),
                weight: path.weight * onward.weight,
                inside: onward.inside,
                ..*path
            };
            let behind = self.trace(path, None, scratch);
            scratch.depth -= 1;
            behind
        } else {
            Sample::BLACK
        };
        view.rgb += onward.factor * behind.rgb;
        view.transmit = onward.transmit * behind.transmit;
    }

    /// The light through a surface from a refracted direction.
    fn refracted(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        transmission: &LayerTransmission,
        dir: DVec3,
        wavelength: Option<f64>,
        scratch: &mut Scratch,
    ) -> Sample {
        let path = lit.path;
        let onward = Path {
            ray: Ray::new(hit.point, dir),
            from: Some(hit.spawn_surface),
            kind: path.kind,
            level: path.level + 1,
            weight: path.weight * transmission.weight,
            irradiance_depth: path.irradiance_depth,
            subsurface_depth: path.subsurface_depth,
            inside: InteriorStack::from_slice(&transmission.crossing.inside),
            wavelength,
        };
        let behind = self.trace(onward, None, scratch);
        Sample {
            rgb: transmission.factor * behind.rgb,
            transmit: transmission.transmit * behind.transmit,
        }
    }

    /// The light of a total internal reflection.
    fn total_reflection(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        transmission: &LayerTransmission,
        wavelength: Option<f64>,
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = lit.path;
        let flat = facing_normal(hit, path.ray.dir);
        let rule = self.world.globals.normalization();
        let dir = mirrored_off(rule, path.ray.dir, lit.at.normal, flat);
        let onward = Path {
            ray: Ray::new(hit.point, dir),
            from: Some(hit.spawn_surface),
            kind: path.kind.mirrored(),
            level: path.level + 1,
            weight: path.weight * transmission.weight,
            irradiance_depth: path.irradiance_depth,
            subsurface_depth: path.subsurface_depth,
            inside: InteriorStack::from_slice(&path.inside),
            wavelength,
        };
        let rgb = self.trace(onward, None, scratch).rgb;
        match transmission.film {
            Some(film) if film.amount > 0.0 => rgb * self.film(film, &lit.at, dir),
            _ => rgb,
        }
    }

    /// Adds the light through a surface that disperses white light: the mean over its spectral bands, each refracted on
    /// its own. Totally reflected bands are filtered like the others, unlike light that is not dispersed (measured).
    fn split(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        transmission: &LayerTransmission,
        view: &mut SurfaceRadiance,
        scratch: &mut Scratch,
    ) {
        let count = self.interior_of(hit).dispersion_samples;
        let share = 1.0 / f64::from(count);
        let mut sum = Rgb::BLACK;
        let mut transmit = 0.0;
        for number in 0..count {
            let band = spectrum::band(number, count);
            let wavelength = Some(band.wavelength);
            let dir = lit.path.ray.dir;
            let dir = match bend(
                dir,
                lit.at.normal,
                transmission.crossing.ratio_at(wavelength),
            ) {
                Refraction::None => dir,
                Refraction::To(dir) => dir,
                Refraction::Total => {
                    let light = self.total_reflection(lit, hit, transmission, wavelength, scratch);
                    sum += band.hue * transmission.factor * light;
                    continue;
                }
            };
            let behind = self.refracted(lit, hit, transmission, dir, wavelength, scratch);
            sum += band.hue * behind.rgb;
            transmit += f64::from(behind.transmit);
        }
        view.rgb += sum * share;
        view.transmit = single(transmit * share);
    }
}
