//! Irradiance at a surface: interpolated from the samples near a point, or from a new sample.
//!
//! The numbers are those of [`crate::render::radiosity`].

use crate::base::color::{Color, Rgb};
use crate::render::radiosity::{CachedLight, Mode, Radiosity};
use crate::render::shade::Scratch;
use crate::render::shade::shading_point::ShadingPoint;
use crate::render::shade::{Path, Sample, Tracer, begin_sample};
use crate::scene::RadiositySettings;
use crate::scene::texture::PreparedLayer;
use crate::world::SpawnSurface;
use glam::DVec3;

/// Irradiance of one brilliance on the front and the back of a surface, where computed.
#[derive(Clone, Copy, Default)]
pub(in crate::render::shade) struct Irradiance {
    brilliance: f32,
    front: Option<Rgb>,
    back: Option<Rgb>,
}

/// A point that receives irradiance.
pub(in crate::render::shade) struct IrradiancePoint<'r> {
    pub(in crate::render::shade) radiosity: &'r Radiosity,
    point: DVec3,
    pub(in crate::render::shade) spawn_surface: Option<SpawnSurface>,
    /// The unit normals on the viewer's side: with bump mapping, if the scene uses it, and without.
    normal: DVec3,
    pub(in crate::render::shade) flat: DVec3,
    pub(in crate::render::shade) depth: usize,
    pub(in crate::render::shade) subsurface_depth: u8,
    /// The weight of the ray that hit the point.
    weight: f64,
    /// The exponent of the cosine of the light, not negative.
    brilliance: f32,
}

impl<'r> IrradiancePoint<'r> {
    /// The shading point of a ray on a surface with this normal before bump mapping. The `brilliance` of its finish counts
    /// if the scene asks for that.
    pub(in crate::render::shade) fn new(
        radiosity: &'r Radiosity,
        lit: &ShadingPoint,
        flat: DVec3,
        brilliance: f32,
    ) -> Self {
        let &RadiositySettings {
            has_normals,
            has_brilliance,
            ..
        } = &radiosity.settings;
        IrradiancePoint {
            radiosity,
            point: lit.at.point,
            spawn_surface: lit.spawn_surface.copied(),
            normal: if has_normals { lit.at.normal } else { flat },
            flat,
            depth: lit.path.irradiance_depth,
            subsurface_depth: lit.path.subsurface_depth,
            weight: lit.path.weight,
            brilliance: if has_brilliance {
                brilliance.max(0.0)
            } else {
                1.0
            },
        }
    }

    /// Returns true if irradiance samples may be used and made there.
    fn gathers(&self, scratch: &Scratch) -> bool {
        self.depth < self.radiosity.settings.recursion_limit as usize && scratch.radiosity.is_some()
    }
}

impl Tracer<'_> {
    /// The weight below which a ray behind this many nested irradiance samples is not traced.
    pub(in crate::render::shade) fn bailout(&self, depth: usize) -> f64 {
        match &self.radiosity {
            Some(radiosity) if depth > 0 => radiosity.settings.adc_bailout,
            _ => self.world.globals.adc_bailout,
        }
    }

    /// Returns true if a ray ignores fog and media.
    pub(in crate::render::shade) fn is_without_atmosphere(&self, path: &Path) -> bool {
        let radiosity = self.radiosity.as_ref();
        path.irradiance_depth > 0
            && !radiosity.is_some_and(|radiosity| radiosity.settings.has_media)
    }

    /// Traces a point of the picture with `trace`, unless a recorded sample of it is still valid.
    pub(in crate::render::shade) fn recall_or_trace(
        &self,
        x: f64,
        y: f64,
        scratch: &mut Scratch,
        trace: impl FnOnce(&mut Scratch) -> Sample,
    ) -> Sample {
        if let Some(session) = &mut scratch.radiosity {
            match session.mode {
                Mode::Record => session.notes.begin(),
                Mode::Store => {
                    if let Some((rgb, transmit)) = session.notes.recall(x, y, &session.cache) {
                        return Sample { rgb, transmit };
                    }
                }
                Mode::Isolated => {}
            }
        } else {
            scratch.radiosity.clone_from(&self.session);
        }
        begin_sample(x, y, scratch);
        let sample = trace(scratch);
        if let Some(session) = &mut scratch.radiosity
            && session.mode == Mode::Record
        {
            session.notes.end(x, y, (sample.rgb, sample.transmit));
        }
        sample
    }

    /// The light that a layer scatters of the irradiance of its surface.
    pub(in crate::render::shade) fn irradiance_radiance(
        &self,
        irradiance_point: &IrradiancePoint,
        layer: &PreparedLayer,
        color: Color,
        filter: Rgb,
        known: &mut Irradiance,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !irradiance_point.gathers(scratch) {
            return Rgb::BLACK;
        }
        let (_, bsdf) = self.layer_bsdf(layer, color);
        let brilliance = irradiance_point.brilliance;
        if known.brilliance != brilliance {
            *known = Irradiance {
                brilliance,
                ..Irradiance::default()
            };
        }
        let [front, back] = if irradiance_point.radiosity.settings.has_brilliance {
            // Relative to light from everywhere, which a higher brilliance reflects less of.
            let share = 2.0 / (1.0 + brilliance);
            [layer.finish.diffuse, layer.finish.diffuse_back].map(|diffuse| diffuse * share)
        } else {
            layer.finish.diffuse_without_albedo
        };
        let mut sum = Rgb::BLACK;
        let sides = [
            (front, &mut known.front, 1.0),
            (back, &mut known.back, -1.0),
        ];
        for (diffuse, known, side) in sides {
            let share = bsdf.opacity * f64::from(diffuse);
            let weight = f64::from((filter * bsdf.rgb).grey()) * share;
            let light = match *known {
                Some(light) => light,
                None if weight > self.bailout(irradiance_point.depth) => {
                    let weight = irradiance_point.weight * weight;
                    *known.insert(self.irradiance(irradiance_point, side, weight, scratch))
                }
                None => continue,
            };
            sum += bsdf.rgb * light * share;
        }
        sum
    }

    /// The irradiance at a point where light enters a body. Its weight is that of the point alone.
    pub(in crate::render::shade) fn irradiance_below(
        &self,
        irradiance_point: &IrradiancePoint,
        weight: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        if irradiance_point.gathers(scratch) {
            self.irradiance(irradiance_point, 1.0, weight, scratch)
        } else {
            Rgb::BLACK
        }
    }

    /// The irradiance at a point on the front (1) or the back (-1).
    fn irradiance(
        &self,
        irradiance_point: &IrradiancePoint,
        side: f64,
        weight: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = irradiance_point;
        let Some(session) = scratch.radiosity.as_deref_mut() else {
            return Rgb::BLACK;
        };
        let (point, normal) = (irradiance_point.point, side * irradiance_point.normal);
        let brilliance = irradiance_point.brilliance;
        let cache_query = session.query(radiosity, [point, normal], depth, weight, brilliance);
        let mut mean = match session.known(radiosity, &cache_query) {
            CachedLight::Unknown => return Rgb::BLACK,
            CachedLight::Enough(mean) => mean,
            CachedLight::Short(mut mean) => {
                let quality = session.quality;
                session.begin(depth);
                let (sample, is_stored) =
                    self.gather(irradiance_point, &cache_query, side, scratch);
                mean.weight += sample.quality;
                mean.sum += sample.light * sample.quality;
                if let Some(session) = scratch.radiosity.as_deref_mut() {
                    session.quality = quality;
                    if is_stored {
                        session.store(radiosity, sample);
                    }
                }
                mean
            }
        };
        if let Some(session) = scratch.radiosity.as_deref_mut() {
            session.used(radiosity, depth, &mean);
        }
        mean.sum = mean.sum * (1.0 / mean.weight);
        let settings = &radiosity.settings;
        let grey = settings.gray_threshold;
        if grey > 0.0 {
            let light = mean.sum;
            mean.sum = light * (1.0 - grey) + Rgb::splat(light.grey()) * grey;
        }
        mean.sum * settings.brightness
    }
}
