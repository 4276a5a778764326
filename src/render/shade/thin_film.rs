//! `irid`: thin-film interference on a surface.

use super::Tracer;
use super::bsdf::ViewPoint;
use crate::base::color::Rgb;
use crate::base::math::noise::Octaves;
use crate::scene::texture::Irid;
use glam::DVec3;
use std::f64::consts::TAU;

/// The octaves of the noise that varies the thickness of films.
const OCTAVES: Octaves = Octaves {
    count: 5,
    lambda: 2.0,
    omega: 0.5,
};

impl Tracer<'_> {
    /// The factor of a film on light from a unit direction to the viewer: `1 + amount · cos(2π · length / wavelength)`
    /// for each colour, with the path length through the film taken as its thickness times both cosines.
    pub(super) fn film(&self, irid: &Irid, at: &ViewPoint, from: DVec3) -> Rgb {
        let globals = &self.world.globals;
        let mut thickness = f64::from(irid.thickness);
        if irid.turbulence != 0.0 {
            let noise = 2.0 * globals.noise.turbulence(at.point, &OCTAVES) - 1.0;
            thickness *= 1.0 + f64::from(irid.turbulence) * noise;
        }
        let length = thickness * (at.normal.dot(from).abs() + at.normal.dot(at.view).abs());
        globals.irid_wavelength.map(|wavelength| {
            let wave = (TAU * length / f64::from(wavelength)).cos();
            #[allow(
                clippy::cast_possible_truncation,
                reason = "colours are single precision"
            )]
            let factor = (1.0 + f64::from(irid.amount) * wave) as f32;
            factor
        })
    }
}
