//! Through a surface: in which interiors a ray is, and whether its way bends.

use super::{Inside, Tracer, spectrum};
use crate::world::InteriorId;
use glam::DVec3;

/// The index of refraction outside all objects.
const ATMOSPHERE_IOR: f64 = 1.0;
/// Index of refraction and dispersion outside all objects.
const ATMOSPHERE: [f64; 2] = [ATMOSPHERE_IOR, 1.0];
/// Indices whose ratio differs from 1 by less than this do not bend light; POV-Ray's value.
const NO_BEND: f64 = 1e-10;

/// A crossing of a surface.
pub(super) struct SurfaceCrossing {
    /// The interiors after the crossing.
    pub(super) inside: Inside,
    /// Whether the segment up to here lay in the interior of this surface.
    pub(super) was_inside: bool,
    /// The index of refraction before, divided by that behind.
    pub(super) ratio: f64,
    /// The dispersion before, divided by that behind.
    pub(super) dispersion: f64,
}

/// Where light goes behind a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refraction {
    /// Straight on.
    None,
    /// In another direction, of length 1.
    To(DVec3),
    /// Nowhere: it is reflected as a whole.
    Total,
}

/// Takes a surface of `interior` into the list: out of it if the ray was in that interior, otherwise into it.
/// Says whether the ray was inside.
///
/// A surface does not say from which side it is met. So a lone triangle is entered and never left, as in POV-Ray.
pub(super) fn cross(inside: &mut Inside, interior: InteriorId) -> bool {
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
    /// The index of refraction behind a surface of an interior relative to that before it, as Fresnel's law of mirror
    /// images takes it.
    ///
    /// POV-Ray 3.7 takes the interior entered last for the one behind, even where that is the one being left: inside
    /// a ball of glass, with the camera in the half-space of some plane, nothing is mirrored. Measured in both orders
    /// of two nested balls around the camera.
    pub(super) fn relative_ior(&self, inside: &Inside, id: InteriorId) -> f64 {
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

    /// The crossing of a surface of an interior by a ray that was inside of these.
    pub(super) fn passage(&self, inside: &Inside, id: InteriorId) -> SurfaceCrossing {
        // Index of refraction and dispersion.
        let of = |id: InteriorId| {
            let interior = self.world.interiors.get(id);
            [interior.ior, interior.effective_dispersion()].map(f64::from)
        };
        let outermost = |inside: &Inside| inside.last().map_or(ATMOSPHERE, |&id| of(id));
        let is_innermost = inside.last() == Some(&id);
        let before = outermost(inside);
        let mut inside = Inside::from_slice(inside);
        let was_inside = cross(&mut inside, id);
        let [ratio, dispersion] = match (was_inside, is_innermost) {
            (false, _) => divided(before, of(id)),
            (true, true) => divided(of(id), outermost(&inside)),
            (true, false) => ATMOSPHERE,
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
    /// Whether it splits white light, even such as would go straight on.
    pub(super) fn splits(&self) -> bool {
        (self.dispersion - 1.0).abs() >= NO_BEND
    }

    /// The ratio of the indices for light of a wavelength, or for white light.
    pub(super) fn ratio_at(&self, wavelength: Option<f64>) -> f64 {
        match wavelength {
            Some(wavelength) if self.splits() => {
                self.ratio * spectrum::bending(self.dispersion, wavelength)
            }
            _ => self.ratio,
        }
    }
}

fn divided(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] / b[0], a[1] / b[1]]
}

/// The direction behind a surface of unit `normal` (Snell's law as a vector). Bumps may have turned it from the viewer.
pub(super) fn bend(dir: DVec3, normal: DVec3, ratio: f64) -> Refraction {
    if (ratio - 1.0).abs() < NO_BEND {
        return Refraction::None;
    }
    let along = dir.dot(normal);
    let (normal, cosine) = if along <= 0.0 {
        (normal, -along)
    } else {
        (-normal, along)
    };
    let behind_sq = 1.0 + ratio * ratio * (cosine * cosine - 1.0);
    if behind_sq < 0.0 {
        return Refraction::Total;
    }
    let bent = ratio * dir + (ratio * cosine - behind_sq.sqrt()) * normal;
    bent.try_normalize()
        .map_or(Refraction::None, Refraction::To)
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
    fn light_that_leaves_too_flat_is_reflected() {
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
        let mut inside = Inside::new();
        assert!(!cross(&mut inside, InteriorId(1)));
        assert!(!cross(&mut inside, InteriorId(2)));
        assert!(cross(&mut inside, InteriorId(1)));
        assert_eq!(inside.as_slice(), [InteriorId(2)]);
    }
}
