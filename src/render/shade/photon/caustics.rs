//! Photon radiance at surfaces, and the direct light that it replaces.

use crate::base::color::Rgb;
use crate::render::photons::Near;
use crate::render::shade::Scratch;
use crate::render::shade::Tracer;
use crate::render::shade::bsdf::{LayerBsdf, LightContribution};
use crate::render::shade::shading_point::ShadingPoint;
use glam::DVec3;
use std::f64::consts::PI;

/// Photons at grazing angles count as if they came at this cosine.
const MIN_COSINE: f64 = 0.1;

impl Tracer<'_> {
    /// Returns true if photons are stored on surfaces: then they replace the light that passes through their targets.
    #[inline]
    pub(in crate::render::shade) fn has_caustics(&self) -> bool {
        self.photon_maps
            .as_ref()
            .is_some_and(|photon_maps| !photon_maps.surface.is_empty())
    }

    /// The radiance estimate of a layer from photons. The photons around the point are gathered once for all layers,
    /// with the normal of the first.
    pub(in crate::render::shade) fn caustics(
        &self,
        lit: &ShadingPoint,
        bsdf: &LayerBsdf,
        flat: DVec3,
        near: &mut Option<Near>,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(photon_maps) = self.photon_maps.as_deref() else {
            return Rgb::BLACK;
        };
        let finish = bsdf.finish;
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
            let search = &photon_maps.on_surfaces;
            let point_in_scene = self.scene_point(lit.at.point);
            photon_maps
                .surface
                .gather(search, point_in_scene, lit.at.normal, &mut near);
            near
        });
        let mut sum = Rgb::BLACK;
        for (to_light, light) in photon_maps.surface.of(near) {
            let Some(side) = bsdf.side(lit.at.normal.dot(to_light), lit.is_double_illuminated)
            else {
                continue;
            };
            let cosine = flat.dot(to_light).clamp(MIN_COSINE, 1.0);
            let contribution = LightContribution {
                to_light,
                side,
                arriving: light * (1.0 / cosine),
                has_highlights: side.is_in_front && lit.path.irradiance_depth == 0,
            };
            sum += self.add_contribution(&contribution, &lit.at, bsdf, scratch);
        }
        sum / (PI * near.radius * near.radius)
    }

    /// A point in the scene's own coordinates, in which photons are stored.
    pub(in crate::render::shade) fn scene_point(&self, point: DVec3) -> DVec3 {
        let globals = &self.world.globals;
        (point - globals.origin) / globals.unit
    }

    /// Returns true if photons replace the light from a light source that a surface transmits.
    pub(in crate::render::shade) fn replaces(&self, surface: u32, light: u32) -> bool {
        let role = self.world.surfaces[surface as usize].photons();
        role.target.is_some() && role.refracts(&self.world.lights.get(light).photons)
    }
}
