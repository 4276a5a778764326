//! What photons give to a surface and to media, and where direct light gives way to them.

use super::Tracer;
use super::direct::light::{LayerBsdf, LightContribution, ShadingPoint};
use crate::base::color::Rgb;
use crate::render::photons::Near;
use crate::world::Scratch;
use glam::DVec3;
use std::f64::consts::PI;

/// Photons that graze a surface count as if they came at this cosine.
const LEAST_COSINE: f64 = 0.1;

impl Tracer<'_> {
    /// Whether photons lie on surfaces: then they stand for light that goes through their targets.
    #[inline]
    pub(super) fn has_caustics(&self) -> bool {
        self.kept
            .as_ref()
            .is_some_and(|kept| !kept.surface.is_empty())
    }

    /// What photons give to a layer. Those around the point are found once for all layers, with the normal of the first.
    pub(super) fn caustics(
        &self,
        lit: &ShadingPoint,
        coat: &LayerBsdf,
        flat: DVec3,
        near: &mut Option<Near>,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(kept) = self.kept.as_deref() else {
            return Rgb::BLACK;
        };
        let finish = coat.finish;
        let takes = [
            finish.diffuse,
            finish.diffuse_back,
            finish.phong,
            finish.specular,
        ];
        if takes.iter().all(|&share| share == 0.0) {
            return Rgb::BLACK;
        }
        let near = near.get_or_insert_with(|| {
            let mut near = std::mem::take(&mut scratch.photons);
            let search = &kept.on_surfaces;
            let place = self.own_place(lit.at.point);
            kept.surface.gather(search, place, lit.at.normal, &mut near);
            near
        });
        let mut sum = Rgb::BLACK;
        for (to_light, light) in kept.surface.of(near) {
            let Some(side) = coat.side(lit.at.normal.dot(to_light), lit.is_double_illuminated)
            else {
                continue;
            };
            let cosine = flat.dot(to_light).max(LEAST_COSINE);
            let shining = LightContribution {
                to_light,
                side,
                arriving: light * (1.0 / cosine),
                has_highlights: side.is_in_front && lit.path.gathered == 0,
            };
            sum += self.add_contribution(&shining, &lit.at, coat, scratch);
        }
        sum * (1.0 / (PI * near.radius * near.radius))
    }

    /// A point by the numbers of the scene, by which photons are kept.
    pub(super) fn own_place(&self, point: DVec3) -> DVec3 {
        let globals = &self.world.globals;
        (point - globals.origin) / globals.unit
    }

    /// Whether photons stand for the light of a lamp that a surface lets through.
    pub(super) fn replaces(&self, surface: u32, light: u32) -> bool {
        let role = self.world.surfaces[surface as usize].photons();
        role.target.is_some() && role.refracts(&self.world.lights.get(light).photons)
    }
}
