//! Light that a surface gathers from others: what samples near a point know of it, or what a new sample finds.
//!
//! The numbers are those of [`crate::render::radiosity`].

use super::direct::light::ShadingPoint;
use super::{Path, Sample, Tracer, begin_sample};
use crate::base::color::{Color, Rgb};
use crate::render::radiosity::{CachedLight, Mode, Radiosity};
use crate::scene::texture::PreparedLayer;
use crate::world::{Scratch, SpawnSurface};
use glam::DVec3;

/// Light that arrives at the front and at the back of a surface, where it was asked for.
#[derive(Clone, Copy, Default)]
pub(super) struct Irradiance {
    front: Option<Rgb>,
    back: Option<Rgb>,
}

/// A point that gathers light.
pub(super) struct IrradiancePoint<'r> {
    pub(super) radiosity: &'r Radiosity,
    point: DVec3,
    pub(super) departure: Option<SpawnSurface>,
    /// The unit normals on the side of the viewer: with bumps, if those count, and without.
    normal: DVec3,
    pub(super) flat: DVec3,
    pub(super) depth: usize,
    /// The weight of the ray that came here.
    weight: f64,
}

impl<'r> IrradiancePoint<'r> {
    /// Where a ray meets a surface of this normal without bumps.
    pub(super) fn new(radiosity: &'r Radiosity, lit: &ShadingPoint, flat: DVec3) -> Self {
        let has_normals = radiosity.settings.has_normals;
        IrradiancePoint {
            radiosity,
            point: lit.at.point,
            departure: lit.departure.copied(),
            normal: if has_normals { lit.at.normal } else { flat },
            flat,
            depth: lit.path.gathered,
            weight: lit.path.weight,
        }
    }
}

impl Tracer<'_> {
    /// The weight below which a ray is not followed on which light was gathered so often.
    pub(super) fn bailout(&self, depth: usize) -> f64 {
        match &self.world.radiosity {
            Some(radiosity) if depth > 0 => radiosity.settings.adc_bailout,
            _ => self.world.globals.adc_bailout,
        }
    }

    /// Whether a ray meets neither fog nor media.
    pub(super) fn is_airless(&self, path: &Path) -> bool {
        let radiosity = self.world.radiosity.as_ref();
        path.gathered > 0 && !radiosity.is_some_and(|radiosity| radiosity.settings.has_media)
    }

    /// What is seen at a point of the picture; what was noted of it and still holds is not looked at again.
    pub(super) fn noted(
        &self,
        (x, y): (f64, f64),
        scratch: &mut Scratch,
        see: impl FnOnce(&mut Scratch) -> Sample,
    ) -> Sample {
        if let Some(session) = &mut scratch.radiosity {
            match session.mode {
                Mode::Watch => session.notes.begin(),
                Mode::Grow => {
                    if let Some((rgb, transmit)) = session.notes.recall(x, y, &session.cache) {
                        return Sample { rgb, transmit };
                    }
                }
                Mode::Lone => {}
            }
        } else {
            scratch.radiosity.clone_from(&self.samples);
        }
        begin_sample(x, y, scratch);
        let seen = see(scratch);
        if let Some(session) = &mut scratch.radiosity
            && session.mode == Mode::Watch
        {
            session.notes.end(x, y, (seen.rgb, seen.transmit));
        }
        seen
    }

    /// What a layer throws back of the light that its surface gathers.
    pub(super) fn gathered(
        &self,
        gathering: &IrradiancePoint,
        (layer, color, filter): (&PreparedLayer, Color, Rgb),
        known: &mut Irradiance,
        scratch: &mut Scratch,
    ) -> Rgb {
        let settings = &gathering.radiosity.settings;
        if gathering.depth >= settings.recursion_limit as usize || scratch.radiosity.is_none() {
            return Rgb::BLACK;
        }
        let (_, coat) = self.coat(layer, color);
        let [front, back] = layer.finish.diffuse_as_given;
        let mut sum = Rgb::BLACK;
        let sides = [
            (front, &mut known.front, 1.0),
            (back, &mut known.back, -1.0),
        ];
        for (diffuse, known, side) in sides {
            let share = coat.opacity * f64::from(diffuse);
            let weight = f64::from((filter * coat.rgb).grey()) * share;
            let light = match *known {
                Some(light) => light,
                None if weight > self.bailout(gathering.depth) => {
                    let weight = gathering.weight * weight;
                    *known.insert(self.light_around(gathering, side, weight, scratch))
                }
                None => continue,
            };
            sum += coat.rgb * light * share;
        }
        sum
    }

    /// The light that arrives at a point in front (1) or at the back (-1).
    fn light_around(
        &self,
        gathering: &IrradiancePoint,
        side: f64,
        weight: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = gathering;
        let Some(session) = scratch.radiosity.as_deref_mut() else {
            return Rgb::BLACK;
        };
        let at = (gathering.point, side * gathering.normal);
        let look = session.look(radiosity, at, depth, weight);
        let mut mean = match session.known(radiosity, &look) {
            CachedLight::Unknown => return Rgb::BLACK,
            CachedLight::Enough(mean) => mean,
            CachedLight::Short(mut mean) => {
                let quality = session.quality;
                session.begin(depth);
                let (sample, is_kept) = self.gather(gathering, (&look, side), scratch);
                mean.weight += sample.quality;
                mean.sum += sample.light * sample.quality;
                if let Some(session) = scratch.radiosity.as_deref_mut() {
                    session.quality = quality;
                    if is_kept {
                        session.keep(radiosity, sample);
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
