//! What comes through a surface: straight on, bent, thrown back as a whole, or split into its colours.

use super::direct::light::ShadingPoint;
use super::interior_stack::{Refraction, SurfaceCrossing, bend};
use super::surface::{SurfaceRadiance, facing_normal, mirrored_off, single};
use super::{Inside, Path, Sample, Tracer, spectrum};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::scene::texture::Irid;
use crate::world::{Hit, InteriorId, Scratch};
use glam::DVec3;

/// So many surfaces one behind the other are followed while others wait: each takes some of the stack.
const MOST_FOLLOWED: u32 = 100;

/// What shines through without a bend.
pub(super) struct StraightTransmission {
    /// The factor on light from behind.
    pub(super) factor: Rgb,
    /// The factor on the transparency of what is behind.
    pub(super) transmit: f32,
    /// The factor on the weight of the ray.
    pub(super) weight: f64,
    /// The interiors behind.
    pub(super) inside: Inside,
}

/// What a surface does to light that comes through it.
pub(super) struct LayerTransmission<'f> {
    /// The film on the top layer.
    film: Option<&'f Irid>,
    /// The factor on light.
    pub(super) factor: Rgb,
    /// The same if all light comes back, whatever the layers would filter.
    pub(super) thrown_back: Rgb,
    /// The factor on the transparency of what is behind.
    pub(super) transmit: f32,
    /// The factor on the weight of the ray.
    pub(super) weight: f64,
    pub(super) passage: SurfaceCrossing,
}

impl Tracer<'_> {
    /// What a surface of an interior, with such a filter and film, does to light that comes through it after a way of this
    /// length, inside of these.
    pub(super) fn through<'f>(
        &self,
        (inside, length): (&Inside, f64),
        interior: InteriorId,
        filter: Rgb,
        film: Option<&'f Irid>,
    ) -> LayerTransmission<'f> {
        let passage = self.passage(inside, interior);
        let interior = self.world.interiors.get(interior);
        let fade = if passage.was_inside {
            interior.fade(length)
        } else {
            Rgb::WHITE
        };
        LayerTransmission {
            film,
            factor: filter * fade * interior.refraction,
            thrown_back: fade * interior.refraction,
            transmit: fade.grey() * filter.grey(),
            weight: f64::from(filter.map(f32::abs).max()),
            passage,
        }
    }

    /// Adds what comes through a surface. Says whether it is the mirror image of a total reflection, beside which
    /// there is no other.
    pub(super) fn pass(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        (filter, film): (Rgb, Option<&Irid>),
        view: &mut SurfaceRadiance,
        scratch: &mut Scratch,
    ) -> bool {
        let path = lit.path;
        let interior = self.world.surfaces[hit.surface as usize].interior;
        let through = self.through((&path.inside, hit.t), interior, filter, film);
        if path.wavelength.is_none() && through.passage.splits() {
            self.split(lit, hit, &through, view, scratch);
            return false;
        }
        let ratio = through.passage.ratio_at(path.wavelength);
        match bend(path.ray.dir, lit.at.normal, ratio) {
            Refraction::None => {
                view.straight_on = Some(StraightTransmission {
                    factor: through.factor,
                    transmit: through.transmit,
                    weight: through.weight,
                    inside: through.passage.inside,
                });
                false
            }
            Refraction::To(dir) => {
                let behind = self.bent(lit, hit, &through, dir, path.wavelength, scratch);
                view.rgb += behind.rgb;
                view.transmit = behind.transmit;
                false
            }
            Refraction::Total => {
                let image = self.thrown_back(lit, hit, &through, path.wavelength, scratch);
                view.rgb += through.thrown_back * image;
                true
            }
        }
    }

    /// Adds what shines through without a bend at once, for what comes after it in POV-Ray's order. Behind too many
    /// surfaces it is left to the one who asked.
    pub(super) fn follow_straight_on(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        view: &mut SurfaceRadiance,
        scratch: &mut Scratch,
    ) {
        let path = lit.path;
        if scratch.followed >= MOST_FOLLOWED {
            return;
        }
        let Some(onward) = view.straight_on.take() else {
            return;
        };
        let behind = if path.level + 1 < self.world.globals.max_trace_level {
            scratch.followed += 1;
            let path = Path {
                ray: Ray::new(hit.point, path.ray.dir),
                from: Some(hit.departure),
                weight: path.weight * onward.weight,
                inside: onward.inside,
                ..*path
            };
            let behind = self.trace(path, None, scratch);
            scratch.followed -= 1;
            behind
        } else {
            Sample::BLACK
        };
        view.rgb += onward.factor * behind.rgb;
        view.transmit = onward.transmit * behind.transmit;
    }

    /// What comes through a surface from a direction.
    fn bent(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        through: &LayerTransmission,
        dir: DVec3,
        wavelength: Option<f64>,
        scratch: &mut Scratch,
    ) -> Sample {
        let path = lit.path;
        let onward = Path {
            ray: Ray::new(hit.point, dir),
            from: Some(hit.departure),
            seen: path.seen,
            level: path.level + 1,
            weight: path.weight * through.weight,
            gathered: path.gathered,
            inside: Inside::from_slice(&through.passage.inside),
            wavelength,
        };
        let behind = self.trace(onward, None, scratch);
        Sample {
            rgb: through.factor * behind.rgb,
            transmit: through.transmit * behind.transmit,
        }
    }

    /// The mirror image of a total reflection.
    fn thrown_back(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        through: &LayerTransmission,
        wavelength: Option<f64>,
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = lit.path;
        let flat = facing_normal(hit, path.ray.dir);
        let dir = mirrored_off(path.ray.dir, lit.at.normal, flat);
        let onward = Path {
            ray: Ray::new(hit.point, dir),
            from: Some(hit.departure),
            seen: path.seen.mirrored(),
            level: path.level + 1,
            weight: path.weight * through.weight,
            gathered: path.gathered,
            inside: Inside::from_slice(&path.inside),
            wavelength,
        };
        let rgb = self.trace(onward, None, scratch).rgb;
        match through.film {
            Some(film) if film.amount > 0.0 => rgb * self.film(film, &lit.at, dir),
            _ => rgb,
        }
    }

    /// Adds what comes through a surface that splits white light: the mean of its colours, each on a way of its own.
    /// Colours that are reflected as a whole are filtered like the others, unlike light that is not split (measured).
    fn split(
        &self,
        lit: &ShadingPoint,
        hit: &Hit,
        through: &LayerTransmission,
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
            let dir = match bend(dir, lit.at.normal, through.passage.ratio_at(wavelength)) {
                Refraction::None => dir,
                Refraction::To(dir) => dir,
                Refraction::Total => {
                    let light = self.thrown_back(lit, hit, through, wavelength, scratch);
                    sum += band.hue * through.factor * light;
                    continue;
                }
            };
            let behind = self.bent(lit, hit, through, dir, wavelength, scratch);
            sum += band.hue * behind.rgb;
            transmit += f64::from(behind.transmit);
        }
        view.rgb += sum * share;
        view.transmit = single(transmit * share);
    }
}
