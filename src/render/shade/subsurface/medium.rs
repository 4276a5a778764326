//! The medium below a surface: its coefficients at one hit, Fresnel transmission, and the dipole (Jensen et al. 2001).

use crate::base::color::Rgb;
use crate::render::shade::surface::single;
use crate::world::World;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;

/// The number of steps of an albedo table.
const STEPS: usize = 100;

/// The error in reflectance at which the search for an albedo ends.
const PRECISION: f64 = 1e-10;

/// The number of steps after which it ends in any case: at extreme indices of refraction no albedo is that near.
const MAX_SEARCH: usize = 1000;

/// Reduced albedos by diffuse reflectance, for each index of refraction of a world's bodies.
#[derive(Debug)]
pub(in crate::render::shade) struct AlbedoTables(FxHashMap<u32, Box<[f32; STEPS + 1]>>);

/// The coefficients of a medium in the three channels, per millimetre.
pub(super) struct Medium {
    /// Reduced scattering.
    pub(super) scattering: [f64; 3],
    /// Reduced extinction.
    pub(super) extinction: [f64; 3],
    absorption: [f64; 3],
    /// The index of refraction behind the surface, relative to that before it.
    pub(super) eta: f64,
}

impl AlbedoTables {
    /// The tables for the surfaces of a world that scatter light.
    pub(super) fn new(world: &World) -> AlbedoTables {
        let scattering = world
            .surfaces
            .iter()
            .filter(|surface| surface.has_subsurface());
        let iors = scattering.map(|surface| world.interiors.get(surface.interior).ior);
        let mut tables = FxHashMap::default();
        for ior in iors {
            let table = || Box::new(albedo_table(f64::from(ior)));
            tables.entry(ior.to_bits()).or_insert_with(table);
        }
        AlbedoTables(tables)
    }

    /// The reduced albedos of a medium that reflects these shares of light diffusely.
    pub(super) fn of(&self, ior: f32, reflectance: Rgb) -> [f64; 3] {
        let Some(table) = self.0.get(&ior.to_bits()) else {
            return [0.0; 3];
        };
        reflectance
            .channels()
            .map(|share| interpolated(table, share))
    }
}

impl Medium {
    /// The medium of a body with this translucency (the mean free path of scattering in millimetres) and albedo.
    pub(super) fn new(translucency: Rgb, albedo: [f64; 3], eta: f64) -> Medium {
        let scattering = translucency.channels().map(|path| 1.0 / path);
        let of = |channel: usize| scattering[channel] / albedo[channel];
        let extinction = [of(0), of(1), of(2)];
        let of = |channel: usize| extinction[channel] - scattering[channel];
        let absorption = [of(0), of(1), of(2)];
        Medium {
            scattering,
            extinction,
            absorption,
            eta,
        }
    }

    /// The mean free path over all channels in millimetres.
    pub(super) fn mean_free_path(&self) -> f64 {
        1.0 / (grey(self.absorption) + grey(self.scattering))
    }

    /// Fresnel's transmittance at the cosine of incidence; all where that is out of range.
    pub(super) fn transmittance(&self, cosine: f64) -> f64 {
        let g = (self.eta * self.eta + cosine * cosine - 1.0).sqrt();
        if g.is_nan() || cosine.abs() > 1.0 {
            return 1.0;
        }
        let across = ((g - cosine) / (g + cosine)).powi(2);
        let along = ((cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0)).powi(2);
        1.0 - (0.5 * across * (1.0 + along)).clamp(0.0, 1.0)
    }

    /// The cosine of refraction for a cosine of incidence; NaN for total reflection.
    pub(super) fn refracted_cosine(&self, cosine: f64) -> f64 {
        (1.0 - (1.0 - cosine * cosine) / (self.eta * self.eta)).sqrt()
    }

    /// The diffuse reflectance of each channel per square millimetre, by the squared distance between entry and exit
    /// in square millimetres: the light of a real source below the surface and of a virtual one above it.
    pub(super) fn dipole(&self, separation_sq: f64) -> [f64; 3] {
        let inner = inner_reflection(self.eta);
        let of = |channel: usize| {
            let extinction = self.scattering[channel] + self.absorption[channel];
            let effective = (3.0 * self.absorption[channel] * extinction).sqrt();
            let source = |depth: f64| {
                let distance_sq = depth * depth + separation_sq;
                let distance = distance_sq.sqrt();
                let falloff = effective + 1.0 / distance;
                depth * falloff * (-effective * distance).exp() / distance_sq
            };
            let real = 1.0 / extinction;
            let virtual_depth = real * (1.0 + inner * 4.0 / 3.0);
            let albedo = self.scattering[channel] / extinction;
            albedo / (4.0 * PI) * (source(real) + source(virtual_depth))
        };
        [of(0), of(1), of(2)]
    }
}

/// The factor by which reflection inside the surface raises the diffuse light below it.
fn inner_reflection(eta: f64) -> f64 {
    let reflectance = if eta < 1.0 {
        eta * eta - eta.powf(2.25)
    } else {
        let bent = 1.0 - 1.0 / eta;
        (bent + 3.0 * bent.powf(4.5)) / 4.0
    };
    (1.0 + reflectance) / (1.0 - reflectance)
}

/// The reduced albedo for each hundredth of diffuse reflectance.
fn albedo_table(ior: f64) -> [f32; STEPS + 1] {
    let inner = inner_reflection(ior);
    let reflectance = |albedo: f64| {
        let root = (3.0 * (1.0 - albedo)).sqrt();
        albedo / 2.0 * (1.0 + (-4.0 / 3.0 * inner * root).exp()) * (-root).exp()
    };
    let mut table = [0.0; STEPS + 1];
    table[STEPS] = 1.0;
    let (mut albedo, mut reached) = (1.0, 1.0);
    for (step, entry) in (0u8..=100).zip(&mut table).skip(1).take(STEPS - 1).rev() {
        let wanted = f64::from(step) / 100.0;
        let mut low = (0.0, 0.0);
        let mut high = (albedo, reached);
        for _ in 0..MAX_SEARCH {
            if (reached - wanted).abs() < PRECISION {
                break;
            }
            let share = (wanted - low.1) / (high.1 - low.1);
            albedo = low.0 + share * (high.0 - low.0);
            reached = reflectance(albedo);
            let end = if reached < wanted {
                &mut low
            } else {
                &mut high
            };
            *end = (albedo, reached);
        }
        *entry = single(albedo);
    }
    table
}

/// The interpolated entry of a table at a share from 0 to 1.
fn interpolated(table: &[f32; STEPS + 1], share: f64) -> f64 {
    let at = (share * 100.0).clamp(0.0, 100.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 0 to 100"
    )]
    let entry = |at: f64| f64::from(table[at as usize]);
    let rest = at - at.floor();
    (1.0 - rest) * entry(at.floor()) + rest * entry(at.ceil())
}

/// POV-Ray's luminance weights.
fn grey([r, g, b]: [f64; 3]) -> f64 {
    0.297 * r + 0.589 * g + 0.114 * b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_albedo_table_inverts_the_reflectance_of_a_thick_body() {
        let table = albedo_table(1.3);
        assert_eq!((table[0], table[STEPS]), (0.0, 1.0));
        assert!(table.windows(2).all(|pair| pair[0] < pair[1]));
        let inner = inner_reflection(1.3);
        let albedo = f64::from(table[40]);
        let root = (3.0 * (1.0 - albedo)).sqrt();
        let reflected = albedo / 2.0 * (1.0 + (-4.0 / 3.0 * inner * root).exp()) * (-root).exp();
        assert!((reflected - 0.4).abs() < 1e-6);
    }

    #[test]
    fn the_search_for_an_albedo_ends_at_any_index_of_refraction() {
        for ior in [1e-5, 0.5, 1.0, 2.5, 280.0, 1e5] {
            let table = albedo_table(ior);
            let is_share = |albedo: &f32| (0.0..=1.0).contains(albedo);
            assert!(table.iter().all(is_share), "{ior}: {table:?}");
        }
        let _ends = [0.0, 1e30, f64::INFINITY, f64::NAN].map(albedo_table);
    }

    #[test]
    fn the_dipole_reflects_the_share_of_its_table_over_the_whole_plane() {
        let albedo = f64::from(albedo_table(1.4)[70]);
        let medium = Medium::new(Rgb::splat(2.0), [albedo; 3], 1.4);
        // The integral over rings in steps of 1/1000 of the distance.
        let ratio: f64 = 1.001;
        let rings = (0..20_000).map(|ring| 1e-5 * ratio.powi(ring));
        let total: f64 = rings
            .map(|r| medium.dipole(r * r)[0] * 2.0 * PI * r * r * (ratio - 1.0))
            .sum();
        assert!((total - 0.7).abs() < 2e-3, "{total}");
    }

    #[test]
    fn light_enters_a_body_all_but_4_percent_head_on() {
        let medium = Medium::new(Rgb::WHITE, [0.5; 3], 1.5);
        assert!((medium.transmittance(1.0) - 0.96).abs() < 1e-12);
        assert!(medium.transmittance(1e-3) < 0.01);
    }
}
