//! The interior stack of a ray, and refraction at surfaces.

use super::spectrum;
use crate::render::shade::{InteriorStack, Tracer};
use crate::world::InteriorId;
use glam::DVec3;

/// The index of refraction outside all objects.
const ATMOSPHERE_IOR: f64 = 1.0;
/// Index of refraction and dispersion outside all objects.
const ATMOSPHERE: [f64; 2] = [ATMOSPHERE_IOR, 1.0];
/// The ratios at a surface that bends no light.
const SAME: [f64; 2] = [1.0, 1.0];
/// Indices whose ratio differs from 1 by less than this do not refract light; POV-Ray's value.
const NO_BEND: f64 = 1e-10;

/// The crossing of a surface.
pub(in crate::render::shade) struct SurfaceCrossing {
    /// The interior stack after the crossing.
    pub(in crate::render::shade) inside: InteriorStack,
    /// The segment before the surface lay in its interior.
    pub(in crate::render::shade) was_inside: bool,
    /// The index of refraction before, divided by that behind.
    pub(in crate::render::shade) ratio: f64,
    /// The dispersion before, divided by that behind.
    pub(in crate::render::shade) dispersion: f64,
}

/// The direction of light behind a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::render::shade) enum Refraction {
    /// Unchanged.
    None,
    /// Refracted, a unit direction.
    To(DVec3),
    /// None: total internal reflection.
    Total,
}

/// Updates the interior stack at a surface of `interior`: removes it if the ray was inside, otherwise pushes it.
/// Returns true if the ray was inside.
///
/// A surface does not know from which side it is hit. So a lone triangle is entered and never left, as in POV-Ray.
pub(in crate::render::shade) fn cross(inside: &mut InteriorStack, interior: InteriorId) -> bool {
    match inside.iter().position(|&id| id == interior) {
        Some(at) => {
            inside.remove(at);
            true
        }
        None => {
            inside.push(interior);
            false
        }
    }
}

impl Tracer<'_> {
    /// The relative index of refraction behind a surface for Fresnel's equations.
    ///
    /// POV-Ray 3.7 takes the interior entered last for the one behind, even if that is the one being left: inside a
    /// glass sphere, with the camera in the half-space of some plane, nothing is reflected. Measured in both orders of
    /// two nested spheres around the camera.
    pub(in crate::render::shade) fn relative_ior(
        &self,
        inside: &[InteriorId],
        id: InteriorId,
    ) -> f64 {
        let ior = |id: InteriorId| f64::from(self.world.interiors.get(id).ior);
        let last = inside.last().map_or(ATMOSPHERE_IOR, |&id| ior(id));
        if !inside.contains(&id) {
            ior(id) / last
        } else if inside.len() == 1 {
            ATMOSPHERE_IOR / ior(id)
        } else {
            last / ior(id)
        }
    }

    /// The crossing of a surface of an interior by a ray with this interior stack.
    pub(in crate::render::shade) fn crossing(
        &self,
        inside: &InteriorStack,
        id: InteriorId,
    ) -> SurfaceCrossing {
        // Index of refraction and dispersion.
        let of = |id: InteriorId| {
            let interior = self.world.interiors.get(id);
            Some([interior.ior, interior.effective_dispersion()])
        };
        let outermost = |inside: &InteriorStack| inside.last().and_then(|&id| of(id));
        let is_innermost = inside.last() == Some(&id);
        let before = outermost(inside);
        let mut inside = InteriorStack::from_slice(inside);
        let was_inside = cross(&mut inside, id);
        let [ratio, dispersion] = match (was_inside, is_innermost) {
            (false, _) => divided(before, of(id)),
            (true, true) => divided(of(id), outermost(&inside)),
            (true, false) => SAME,
        };
        SurfaceCrossing {
            inside,
            was_inside,
            ratio,
            dispersion,
        }
    }
}

impl SurfaceCrossing {
    /// Returns true if it disperses white light, even light that is not refracted.
    pub(in crate::render::shade) fn splits(&self) -> bool {
        (self.dispersion - 1.0).abs() >= NO_BEND
    }

    /// The ratio of the indices for light of a wavelength, or for white light.
    pub(in crate::render::shade) fn ratio_at(&self, wavelength: Option<f64>) -> f64 {
        match wavelength {
            Some(wavelength) if self.splits() => {
                self.ratio * spectrum::bending(self.dispersion, wavelength)
            }
            _ => self.ratio,
        }
    }
}

/// The quotients of the indices and of the dispersions of two interiors; `None` is the atmosphere. As in POV-Ray, those
/// of two interiors are in single precision, those of one and the atmosphere in double precision.
fn divided(a: Option<[f32; 2]>, b: Option<[f32; 2]>) -> [f64; 2] {
    if let (Some(a), Some(b)) = (a, b) {
        return [a[0] / b[0], a[1] / b[1]].map(f64::from);
    }
    let [a, b] = [a, b].map(|of| of.map_or(ATMOSPHERE, |of| of.map(f64::from)));
    [a[0] / b[0], a[1] / b[1]]
}

/// The direction behind a surface with a unit `normal` (Snell's law as a vector), as long as rounding leaves it. Bump mapping
/// may have turned the normal away from the viewer.
pub(in crate::render::shade) fn bend(dir: DVec3, normal: DVec3, ratio: f64) -> Refraction {
    if (ratio - 1.0).abs() < NO_BEND {
        return Refraction::None;
    }
    match snell(dir, normal, ratio) {
        None => Refraction::Total,
        Some(bent) if bent.is_finite() && bent != DVec3::ZERO => Refraction::To(bent),
        Some(_) => Refraction::None,
    }
}

/// The unit direction behind a surface, also if the indices are equal; `None` for total internal reflection.
pub(in crate::render::shade) fn refracted(dir: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    snell(dir, normal, ratio).and_then(DVec3::try_normalize)
}

/// The direction behind a surface, of length 1 but for rounding; `None` for total internal reflection.
fn snell(dir: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let along = dir.dot(normal);
    let (normal, cosine) = if along <= 0.0 {
        (normal, -along)
    } else {
        (-normal, along)
    };
    let behind_sq = 1.0 + ratio * ratio * (cosine * cosine - 1.0);
    if behind_sq < 0.0 {
        return None;
    }
    Some(ratio * dir + (ratio * cosine - behind_sq.sqrt()) * normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_bends_by_snells_law() {
        let dir = DVec3::new(0.6, -0.8, 0.0);
        let Refraction::To(bent) = bend(dir, DVec3::Y, 1.0 / 1.5) else {
            panic!("it goes into the glass");
        };
        assert!((bent.x - 0.4).abs() < 1e-15 && bent.y < 0.0);
    }

    #[test]
    fn grazing_exit_is_totally_reflected() {
        assert_eq!(
            bend(DVec3::new(0.8, -0.6, 0.0), DVec3::Y, 1.5),
            Refraction::Total
        );
    }

    #[test]
    fn equal_indices_do_not_bend() {
        assert_eq!(bend(DVec3::NEG_Y, DVec3::Y, 1.0), Refraction::None);
    }

    #[test]
    fn an_interior_is_entered_and_left() {
        let mut inside = InteriorStack::new();
        assert!(!cross(&mut inside, InteriorId(1)));
        assert!(!cross(&mut inside, InteriorId(2)));
        assert!(cross(&mut inside, InteriorId(1)));
        assert_eq!(inside.as_slice(), [InteriorId(2)]);
    }
}
