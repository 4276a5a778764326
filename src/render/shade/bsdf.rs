//! Reflection of light by one layer of a texture: diffuse, `phong` and `specular`.

use crate::base::color::Rgb;
use crate::base::math::powers::exact_power;
use crate::scene::texture::Finish;
use crate::world::Hit;
use glam::DVec3;
use std::f64::consts::FRAC_2_PI;

/// Below this a colour counts as no light, and the cosine of light as grazing; POV-Ray's value.
pub(in crate::render::shade) const NEGLIGIBLE: f64 = 1e-10;

/// From this `phong_size` on, small highlights are cut off.
const SMALL_PHONG: f32 = 60.0;

/// The cosine at which they are cut off.
const PHONG_CUT: f64 = 0.0008;

/// A surface point with its view direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct ViewPoint {
    pub(in crate::render::shade) point: DVec3,
    /// The unit normal on the viewer's side.
    pub(in crate::render::shade) normal: DVec3,
    /// The unit direction from the viewer.
    pub(in crate::render::shade) view: DVec3,
}

impl ViewPoint {
    /// The point that a ray of this direction hits.
    #[inline]
    pub(in crate::render::shade) fn new(hit: &Hit, dir: DVec3) -> ViewPoint {
        ViewPoint {
            point: hit.point,
            normal: facing_normal(hit, dir),
            view: dir,
        }
    }
}

/// The reflective properties of a layer at a point.
pub(in crate::render::shade) struct LayerBsdf<'f> {
    pub(in crate::render::shade) finish: &'f Finish,
    pub(in crate::render::shade) rgb: Rgb,
    /// The share of light that does not pass the layer.
    pub(in crate::render::shade) opacity: f64,
    /// The index of refraction behind the surface, relative to the one before it. Counts where the finish has `fresnel`.
    pub(in crate::render::shade) ior: f64,
}

/// The side of a layer that receives light from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct Side {
    pub(crate) diffuse: f32,
    pub(in crate::render::shade) is_in_front: bool,
    /// The cosine between the normal and the direction to the light.
    pub(crate) cosine: f64,
}

/// Light that arrives at a layer from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightContribution {
    /// The unit direction to the light.
    pub(in crate::render::shade) to_light: DVec3,
    pub(in crate::render::shade) side: Side,
    /// The light after shadows.
    pub(in crate::render::shade) arriving: Rgb,
    pub(in crate::render::shade) has_highlights: bool,
}

impl LayerBsdf<'_> {
    /// The share of light that Fresnel's law with the finish's `fresnel` lets through the surface at an angle of this
    /// cosine.
    pub(in crate::render::shade) fn entering(&self, cosine: f64) -> f64 {
        1.0 - self.mirrored(cosine)
    }

    /// The share that it mirrors.
    fn mirrored(&self, cosine: f64) -> f64 {
        f64::from(self.finish.fresnel) * fresnel(cosine, self.ior)
    }

    /// The highlights of light from one direction.
    #[inline]
    pub(in crate::render::shade) fn highlight(&self, at: &ViewPoint, to_light: DVec3) -> Highlight {
        let finish = self.finish;
        match finish.fresnel != 0.0 || finish.use_alpha {
            true => self.reduced_highlight(at, to_light),
            false => Highlight::of(finish, at, to_light),
        }
    }

    #[inline(never)]
    fn reduced_highlight(&self, at: &ViewPoint, to_light: DVec3) -> Highlight {
        let mut phong = phong(self.finish, at, to_light);
        let mut specular = specular(self.finish, at, to_light);
        if self.finish.fresnel != 0.0 {
            phong *= self.mirrored(at.normal.dot(to_light).abs());
            specular *= self.mirrored(half_cosine(at, to_light).abs());
        }
        let share = if self.finish.use_alpha {
            self.opacity
        } else {
            1.0
        };
        Highlight {
            strength: (phong + specular) * share,
            specular: specular * share,
        }
    }

    /// The side lit by light at this cosine to the normal; `None` if the layer receives none from there.
    #[inline]
    pub(in crate::render::shade) fn side(
        &self,
        cosine: f64,
        is_double_illuminated: bool,
    ) -> Option<Side> {
        let (diffuse, is_in_front) = if cosine >= NEGLIGIBLE || is_double_illuminated {
            (self.finish.diffuse, true)
        } else if self.finish.diffuse_back != 0.0 {
            (self.finish.diffuse_back, false)
        } else {
            return None;
        };
        Some(Side {
            diffuse,
            is_in_front,
            cosine,
        })
    }
}

/// Lights farther behind a surface are hardly ever faced after bump mapping.
pub(in crate::render::shade) const MAX_TILTED: f64 = -0.5;

#[inline]
pub(in crate::render::shade) fn is_negligible(light: Rgb) -> bool {
    let is_small = |c: f32| f64::from(c).abs() < NEGLIGIBLE;
    is_small(light.r) && is_small(light.g) && is_small(light.b)
}

/// The highlights of light from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct Highlight {
    /// That of both kinds.
    pub(in crate::render::shade) strength: f64,
    /// That of `specular` alone.
    specular: f64,
}

impl Highlight {
    /// The highlights without the effects of `fresnel` and `use_alpha`.
    #[inline]
    pub(in crate::render::shade) fn of(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> Self {
        let specular = specular(finish, at, to_light);
        Highlight {
            strength: phong(finish, at, to_light) + specular,
            specular,
        }
    }

    /// The highlights of this light on a pigment, at this cosine between the normal and the light.
    #[inline]
    pub(in crate::render::shade) fn tinted(
        &self,
        finish: &Finish,
        pigment: Rgb,
        arriving: Rgb,
        cosine: f64,
        half_cosine: impl FnOnce() -> f64,
    ) -> Rgb {
        let tint = |cosine| arriving * metallic(finish.metallic, pigment, cosine);
        if finish.tints_by_half_vector && finish.metallic != 0.0 && self.specular != 0.0 {
            let phong = self.strength - self.specular;
            return tint(cosine) * phong + tint(half_cosine()) * self.specular;
        }
        tint(cosine) * self.strength
    }
}

/// The cosine between the light and the half vector.
pub(in crate::render::shade) fn half_cosine(at: &ViewPoint, to_light: DVec3) -> f64 {
    (to_light - at.view).normalize_or_zero().dot(to_light)
}

/// Phong's highlight: the cosine between the reflected view direction and the light.
#[inline]
fn phong(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    if finish.phong == 0.0 {
        return 0.0;
    }
    let cosine = mirrored(at.view, at.normal).dot(to_light);
    let is_lit = cosine > 0.0 && (finish.phong_size < SMALL_PHONG || cosine > PHONG_CUT);
    if is_lit {
        f64::from(finish.phong) * exact_power(cosine, f64::from(finish.phong_size))
    } else {
        0.0
    }
}

/// Blinn's highlight: the cosine between the normal and the half vector.
#[inline]
fn specular(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    if finish.specular == 0.0 {
        return 0.0;
    }
    let half_vector = 0.5 * (to_light - at.view);
    let cosine = half_vector.dot(at.normal) / half_vector.length();
    if cosine > 0.0 {
        f64::from(finish.specular) * exact_power(cosine, f64::from(finish.shininess))
    } else {
        0.0
    }
}

/// The reflectance of unpolarised light by Fresnel's equations, for a relative index of refraction.
pub(in crate::render::shade) fn fresnel(cosine: f64, ior: f64) -> f64 {
    let g_sq = ior * ior + cosine * cosine - 1.0;
    if g_sq < 0.0 {
        return 1.0;
    }
    let g = g_sq.sqrt();
    let across = (g - cosine) / (g + cosine);
    let along = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    (0.5 * across * across * (1.0 + along * along)).clamp(0.0, 1.0)
}

/// The mirror image of a direction.
pub(in crate::render::shade) fn mirrored(dir: DVec3, normal: DVec3) -> DVec3 {
    dir - 2.0 * dir.dot(normal) * normal
}

/// The tint that a `metallic` of strength `m` gives to light at an angle of this cosine: less of the pigment's colour
/// the more grazing.
pub(in crate::render::shade) fn metallic(m: f32, pigment: Rgb, cosine: f64) -> Rgb {
    if m == 0.0 {
        return Rgb::WHITE;
    }
    let x = cosine.clamp(-1.0, 1.0).acos() * FRAC_2_PI;
    let fresnel = (0.014_567_225 / (x - 1.12).powi(2) - 0.011_612_903).clamp(0.0, 1.0);
    Rgb::WHITE + (pigment - Rgb::WHITE) * (f64::from(m) * (1.0 - fresnel))
}

/// The shading normal on the side of the ray's origin.
#[inline]
pub(crate) fn facing_normal(hit: &Hit, dir: DVec3) -> DVec3 {
    if hit.shading_normal.dot(dir) > 0.0 {
        -hit.shading_normal
    } else {
        hit.shading_normal
    }
}
