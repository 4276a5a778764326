//! Textures prepared for rendering: the top layer first, with inverse matrices for patterns and precomputed properties.

use super::select::{Selector, TextureSelection};
use super::{
    ColorFunctions, Finish, Layer, Pigment, PigmentKind, PreparedNormal, Texture, WeightedTexture,
};
use crate::base::bitmap;
use crate::base::color::Color;
use crate::base::math::Step;
use crate::scene::function::ColorField;
use crate::scene::pattern::{
    Between, Map, Modifiers, NormalTransforms, PreparedPattern, PreparedWarpChain, Settings,
    SurfacePoint,
};
use glam::DVec3;
use std::sync::Arc;

/// A prepared texture.
#[derive(Debug, Default)]
pub struct PreparedTexture {
    layers: Layers,
}

/// The layers of a texture. A scene may have a million textures, most of them with one layer.
#[derive(Debug)]
enum Layers {
    One(PreparedLayer),
    Some(Vec<PreparedLayer>),
    /// A selector of other textures; the layers are unused.
    Patterned(Box<(Selector, Vec<PreparedLayer>)>),
}

impl Default for Layers {
    fn default() -> Self {
        Layers::Some(Vec::new())
    }
}

/// A prepared layer.
#[derive(Debug)]
pub struct PreparedLayer {
    /// The colour.
    pub pigment: PreparedPigment,
    /// The reflection properties.
    pub finish: Arc<Finish>,
    /// Rarely used parts.
    extras: Option<Box<LayerExtras>>,
}

/// The parts that most layers do not have.
#[derive(Debug)]
struct LayerExtras {
    quick_color: Option<Color>,
    normal: Option<PreparedNormal>,
}

/// A prepared pigment. A scene may have a million of them, most of them plain.
#[derive(Debug)]
pub enum PreparedPigment {
    /// The same colour everywhere.
    Plain(Color),
    /// A pattern with a map of colours.
    Colors(Box<(PreparedPattern, Map<Color>)>),
    /// A pattern with a map of pigments.
    Pigments(Box<(PreparedPattern, Map<PreparedPigment>)>),
    /// The weighted mean of pigments.
    Average(Box<(PreparedWarpChain, Map<PreparedPigment>)>),
    /// The colours of an image.
    Image(Box<(PreparedWarpChain, bitmap::MappedBitmap)>),
    /// The values of functions.
    Functions(Box<(PreparedWarpChain, ColorFunctions)>),
    /// Another pigment, evaluated at the texture coordinates.
    Uv(Box<PreparedPigment>),
}

impl PreparedTexture {
    /// Prepares a texture for rendering. `after` are transforms that follow the texture's own, `outer` the transforms
    /// of normals by the texture maps around it.
    pub(super) fn new(
        texture: &Texture,
        after: &[Step],
        outer: &NormalTransforms,
        settings: &Settings,
    ) -> Self {
        let prepare = |layer: &Layer| {
            let normal = PreparedNormal::of_layer(layer, after, settings);
            let normal = normal.map(|normal| normal.within(outer));
            let quick_color = layer.pigment.quick_color.as_deref().copied();
            let has_extras = normal.is_some() || quick_color.is_some();
            PreparedLayer {
                pigment: PreparedPigment::new(&layer.pigment, after, settings),
                finish: Arc::clone(&layer.finish),
                extras: has_extras.then(|| {
                    Box::new(LayerExtras {
                        quick_color,
                        normal,
                    })
                }),
            }
        };
        let mut layers: Vec<PreparedLayer> = texture.layers().iter().rev().map(prepare).collect();
        let pattern = texture.pattern();
        let selector = pattern.and_then(|pattern| Selector::new(pattern, after, outer, settings));
        PreparedTexture {
            layers: match selector {
                Some(selector) => Layers::Patterned(Box::new((selector, layers))),
                None if layers.len() == 1 => layers.pop().map(Layers::One).unwrap_or_default(),
                None => Layers::Some(layers),
            },
        }
    }

    /// A prepared texture of one colour and a finish.
    #[must_use]
    pub(crate) fn colored(color: Color, finish: Arc<Finish>) -> Self {
        PreparedTexture {
            layers: Layers::One(PreparedLayer {
                pigment: PreparedPigment::Plain(color),
                finish,
                extras: None,
            }),
        }
    }

    /// This texture in another colour; `None` if it is more than one colour and a finish.
    #[must_use]
    pub(crate) fn with_color(&self, color: Color) -> Option<Self> {
        match &self.layers {
            Layers::One(PreparedLayer {
                pigment: PreparedPigment::Plain(_),
                finish,
                extras: None,
            }) => Some(PreparedTexture::colored(color, Arc::clone(finish))),
            _ => None,
        }
    }

    /// The layers, the top one first; unused if a pattern selects among other textures.
    #[must_use]
    #[inline]
    pub fn layers(&self) -> &[PreparedLayer] {
        match &self.layers {
            Layers::One(layer) => std::slice::from_ref(layer),
            Layers::Some(layers) => layers,
            Layers::Patterned(both) => &both.1,
        }
    }

    /// The selector of other textures, if there is one.
    fn selector(&self) -> Option<&Selector> {
        match &self.layers {
            Layers::Patterned(both) => Some(&both.0),
            Layers::One(_) | Layers::Some(_) => None,
        }
    }

    /// True if a pattern selects among other textures.
    #[must_use]
    pub fn is_patterned(&self) -> bool {
        self.selector().is_some()
    }

    /// True if the predicate holds for any layer of the texture or of a texture that it selects from.
    pub fn has_layer(&self, is_such: &dyn Fn(&PreparedLayer) -> bool) -> bool {
        match self.selector() {
            None => self.layers().iter().any(is_such),
            Some(selector) => selector
                .textures()
                .any(|texture| texture.has_layer(is_such)),
        }
    }

    /// Adds this texture, or the textures that it selects, to a selection. Patterns are evaluated at `point`.
    pub fn select<'t>(&'t self, point: DVec3, weight: f32, to: &mut TextureSelection<'t>) {
        if let Some(selector) = self.selector() {
            return selector.select(point, weight, to);
        }
        to.textures.push(WeightedTexture {
            weight,
            texture: self,
            point,
        });
        if let Some(flat) = &to.flat
            && let Some(normal) = self.last_perturbed_normal(point, flat)
        {
            to.spot.normal = normal;
        }
    }

    /// The normal perturbed by the bumps of the visible layer that is shaded last among those with bumps, as slope
    /// patterns use it.
    fn last_perturbed_normal(&self, point: DVec3, flat: &SurfacePoint) -> Option<DVec3> {
        let mut layers = self.layers().iter();
        let lowest = layers.position(|layer| !layer.pigment.can_be_transparent());
        let seen = lowest.map_or(self.layers().len(), |lowest| lowest + 1);
        let mut bumps = self.layers()[..seen].iter().rev();
        let bumps = bumps.find_map(PreparedLayer::normal)?;
        Some(
            bumps
                .perturbed_with_pattern_normal(point, flat.normal, flat)
                .1,
        )
    }

    /// True if the selection of textures depends on the normal.
    #[must_use]
    pub fn needs_normal(&self) -> bool {
        self.selector().is_some_and(Selector::needs_normal)
    }

    /// True if a selector or layer in it depends on the texture coordinates of the surface.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        match self.selector() {
            None => self.layers().iter().any(PreparedLayer::uses_uv),
            Some(selector) => selector.uses_uv(),
        }
    }

    /// True if no light is transmitted anywhere: some layer has neither filter nor transmit.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let is_opaque = |layer: &PreparedLayer| !layer.pigment.can_be_transparent();
        match self.selector() {
            None => self.layers().iter().any(is_opaque),
            Some(selector) => selector.textures().all(PreparedTexture::is_opaque),
        }
    }

    /// True if it ends all shadow rays: POV-Ray takes some layer for opaque, though rays of the camera may see through it
    /// (docs/povray-facts.md, section 4.4).
    #[must_use]
    pub fn ends_light(&self) -> bool {
        let ends_light = |layer: &PreparedLayer| layer.pigment.ends_light();
        match self.selector() {
            None => self.layers().iter().any(ends_light),
            Some(selector @ Selector::Material(..)) => {
                selector.textures().all(PreparedTexture::ends_light)
            }
            Some(_) => self.is_opaque(),
        }
    }

    /// True for one opaque layer with only diffuse light and highlights: no bumps, reflection, thin film or `crand`.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.is_opaque() && !self.has_reflection() && self.is_nearly_plain()
    }

    /// True for one layer without bumps, thin film, `crand` or subsurface light; reflection and transparency are allowed.
    #[must_use]
    pub fn is_nearly_plain(&self) -> bool {
        match self.layers() {
            [layer] if self.selector().is_none() => {
                layer.normal().is_none() && layer.has_plain_finish()
            }
            _ => false,
        }
    }

    /// True if each of its layers has a uniform colour.
    #[must_use]
    pub fn has_uniform_color(&self) -> bool {
        let is_plain = |layer: &PreparedLayer| matches!(layer.pigment, PreparedPigment::Plain(_));
        self.selector().is_none() && self.layers().iter().all(is_plain)
    }

    /// True if some pattern in it jumps where surfaces may lie.
    #[must_use]
    pub fn jumps(&self) -> bool {
        let layers = || {
            self.layers().iter().any(|layer| {
                layer.pigment.jumps() || layer.normal().is_some_and(PreparedNormal::jumps)
            })
        };
        self.selector().map_or_else(layers, Selector::jumps)
    }

    /// True if any layer has specular reflection.
    #[must_use]
    pub fn has_reflection(&self) -> bool {
        let has_reflection = |layer: &PreparedLayer| layer.finish.has_reflection();
        match self.selector() {
            None => self.layers().iter().any(has_reflection),
            Some(selector) => selector.textures().any(PreparedTexture::has_reflection),
        }
    }

    /// The colour and the finish of a single layer of uniform colour without bumps.
    #[must_use]
    pub fn plain(&self) -> Option<(Color, &Finish)> {
        match self.layers() {
            [layer] if self.selector().is_none() && layer.normal().is_none() => {
                match &layer.pigment {
                    PreparedPigment::Plain(color) => Some((*color, &layer.finish)),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

impl PreparedLayer {
    /// `quick_color`: the colour in previews of quality 5 and less, if set.
    #[must_use]
    #[inline]
    pub fn quick_color(&self) -> Option<&Color> {
        self.extras.as_ref()?.quick_color.as_ref()
    }

    /// The bumps, if any.
    #[must_use]
    #[inline]
    pub fn normal(&self) -> Option<&PreparedNormal> {
        self.extras.as_ref()?.normal.as_ref()
    }

    /// True for diffuse light, highlights and reflection alone: no thin film, `crand` or subsurface light.
    #[must_use]
    pub fn has_plain_finish(&self) -> bool {
        let finish = &self.finish;
        finish.crand <= 0.0
            && finish.subsurface.is_none()
            && finish.fresnel == 0.0
            && !finish.use_alpha
            && finish.irid.amount <= 0.0
            && (!finish.has_reflection() || finish.reflection.exponent == 1.0)
    }

    fn uses_uv(&self) -> bool {
        let normal = self.normal();
        self.pigment.uses_uv() || normal.is_some_and(PreparedNormal::uses_uv)
    }
}

impl PreparedPigment {
    /// Prepares a pigment for rendering. `after` are transforms that follow the pigment's own.
    #[must_use]
    pub fn new(pigment: &Pigment, after: &[Step], settings: &Settings) -> Self {
        let none = Modifiers::default();
        let modifiers = pigment.modifiers.get().unwrap_or(&none);
        // Entries of a map receive points in the space of the pattern; no other transforms apply to them.
        let entries = |map: &Map<Pigment>| map.map(|entry| Self::new(entry, &[], settings));
        match &pigment.kind {
            PigmentKind::Plain(color) => PreparedPigment::Plain(*color),
            PigmentKind::Colors(mapped) => {
                let pattern = modifiers.prepare(&*mapped.pattern, after, settings);
                let map = mapped.map.clone().rounded_for(settings.is_3_8);
                PreparedPigment::Colors(Box::new((pattern, map)))
            }
            PigmentKind::Pigments(mapped) => {
                let pattern = modifiers.prepare(&*mapped.pattern, after, settings);
                let map = entries(&mapped.map).rounded_for(settings.is_3_8);
                PreparedPigment::Pigments(Box::new((pattern, map)))
            }
            PigmentKind::Average(Some(map)) => {
                let chain = modifiers.prepare_chain(after, settings);
                PreparedPigment::Average(Box::new((chain, entries(map))))
            }
            PigmentKind::Image(source) => {
                let chain = modifiers.prepare_chain(after, settings);
                PreparedPigment::Image(Box::new((chain, (**source).clone())))
            }
            PigmentKind::Functions(functions) => {
                let chain = modifiers.prepare_chain(after, settings);
                PreparedPigment::Functions(Box::new((chain, (**functions).clone())))
            }
            // No transforms apply to texture coordinates.
            PigmentKind::Uv(mapped) => {
                PreparedPigment::Uv(Box::new(Self::new(mapped, &[], settings)))
            }
            PigmentKind::Average(None) => PreparedPigment::Plain(Color::default()),
        }
    }

    /// The colour at a surface point.
    #[must_use]
    #[inline]
    pub fn color(&self, spot: &SurfacePoint) -> Color {
        match self {
            PreparedPigment::Plain(color) => *color,
            _ => self.color_at(spot.point, spot),
        }
    }

    /// The colour at `point`: the surface point or, for an entry of a map, the point in the space of the pattern
    /// around it.
    #[must_use]
    pub fn color_at(&self, point: DVec3, spot: &SurfacePoint) -> Color {
        match self {
            PreparedPigment::Plain(color) => *color,
            PreparedPigment::Colors(both) => {
                let (pattern, map) = &**both;
                map.color(pattern.value(pattern.to_pattern_space(point), spot))
            }
            PreparedPigment::Pigments(both) => {
                let (pattern, map) = &**both;
                let pattern_point = pattern.to_pattern_space(point);
                match map.between(pattern.value(pattern_point, spot)) {
                    Between::One(entry) => entry.color_at(pattern_point, spot),
                    Between::Two(from, to, share) => {
                        let to = to.color_at(pattern_point, spot);
                        let from = from.color_at(pattern_point, spot);
                        map.blend().of(&from, &to, share)
                    }
                }
            }
            PreparedPigment::Average(both) => {
                let (chain, map) = &**both;
                let pattern_point = chain.to_pattern_space(point);
                let weighted = |(weight, entry): &(f32, PreparedPigment)| {
                    (*weight, entry.color_at(pattern_point, spot))
                };
                Color::average(map.entries().iter().map(weighted))
            }
            PreparedPigment::Image(both) => both.1.color(both.0.to_pattern_space(point)),
            PreparedPigment::Functions(both) => both.1.color(both.0.to_pattern_space(point)),
            PreparedPigment::Uv(mapped) => mapped.color_at(spot.uv_point(), spot),
        }
    }

    /// The colours at four points on no surface.
    #[must_use]
    pub fn colors_x4(&self, points: &[DVec3; 4]) -> [Color; 4] {
        match self {
            PreparedPigment::Colors(both) => {
                let (pattern, map) = &**both;
                let [a, b, c, d] = points.map(SurfacePoint::at);
                let points = pattern.to_pattern_space_x4(points);
                let values = pattern.values_x4(&points, [&a, &b, &c, &d]);
                values.map(|value| map.color(value))
            }
            _ => points.map(|point| self.color(&SurfacePoint::at(point))),
        }
    }

    fn can_be_transparent(&self) -> bool {
        let any = |map: &Map<PreparedPigment>| {
            let mut entries = map.entries().iter();
            entries.any(|(_, entry)| entry.can_be_transparent())
        };
        match self {
            PreparedPigment::Plain(color) => color.is_transparent(),
            PreparedPigment::Colors(both) => {
                let mut entries = both.1.entries().iter();
                entries.any(|(_, color)| color.is_transparent())
            }
            PreparedPigment::Pigments(both) => any(&both.1),
            PreparedPigment::Average(both) => any(&both.1),
            PreparedPigment::Image(both) => both.1.can_be_transparent(),
            PreparedPigment::Functions(both) => both.1.can_be_transparent(),
            PreparedPigment::Uv(mapped) => mapped.can_be_transparent(),
        }
    }

    /// True if it ends all shadow rays. Images within another pigment count as opaque in more cases than by themselves.
    fn ends_light(&self) -> bool {
        let within = |entry: &PreparedPigment| match entry {
            PreparedPigment::Image(both) => both.1.is_opaque_within(),
            _ => entry.ends_light(),
        };
        match self {
            PreparedPigment::Pigments(both) => {
                both.1.entries().iter().all(|(_, entry)| within(entry))
            }
            PreparedPigment::Average(both) => {
                both.1.entries().iter().all(|(_, entry)| within(entry))
            }
            PreparedPigment::Uv(mapped) => within(mapped),
            _ => !self.can_be_transparent(),
        }
    }

    fn jumps(&self) -> bool {
        let any = |map: &Map<PreparedPigment>| {
            let mut entries = map.entries().iter();
            entries.any(|(_, entry)| entry.jumps())
        };
        match self {
            PreparedPigment::Plain(_)
            | PreparedPigment::Image(_)
            | PreparedPigment::Functions(_) => false,
            PreparedPigment::Colors(both) => both.0.jumps(),
            PreparedPigment::Pigments(both) => both.0.jumps() || any(&both.1),
            PreparedPigment::Average(both) => any(&both.1),
            PreparedPigment::Uv(mapped) => mapped.jumps(),
        }
    }

    fn uses_uv(&self) -> bool {
        let any = |map: &Map<PreparedPigment>| {
            let mut entries = map.entries().iter();
            entries.any(|(_, entry)| entry.uses_uv())
        };
        match self {
            PreparedPigment::Uv(_) => true,
            PreparedPigment::Pigments(both) => any(&both.1),
            PreparedPigment::Average(both) => any(&both.1),
            PreparedPigment::Plain(_)
            | PreparedPigment::Colors(_)
            | PreparedPigment::Image(_)
            | PreparedPigment::Functions(_) => false,
        }
    }
}

impl ColorField for PreparedPigment {
    fn color(&self, point: DVec3) -> Color {
        PreparedPigment::color(self, &SurfacePoint::at(point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::color::Rgb;

    fn prepare(text: &str, after: &[Step]) -> PreparedTexture {
        let texture = Texture::read(&mut TextArgs::new(text), &Layer::default());
        texture.unwrap().prepare(after, &Settings::default())
    }

    #[test]
    fn the_transforms_of_the_object_act_after_those_of_the_texture() {
        let text = "{ pigment { checker rgb 1 rgb 0.5 scale 2 } }";
        let texture = prepare(text, &[Step::Translate(DVec3::X)]);
        let grey = |x: f64| {
            texture.layers()[0]
                .pigment
                .color(&SurfacePoint::at(DVec3::new(x, 0.5, 0.5)))
                .rgb
                .r
        };
        assert_eq!(
            (grey(0.5), grey(1.5), grey(2.9), grey(3.1)),
            (0.5, 1.0, 1.0, 0.5)
        );
    }

    #[test]
    fn a_texture_with_one_opaque_layer_is_opaque() {
        assert!(prepare("{ pigment { rgb 1 } }", &[]).is_opaque());
        assert!(!prepare("{ pigment { rgbf 0.5 } }", &[]).is_opaque());
        assert!(!prepare("{ pigment { checker rgb 1 rgbt 1 } }", &[]).is_opaque());
    }

    #[test]
    fn one_layer_of_uniform_colour_is_recognized() {
        let plain = prepare("{ pigment { rgb 0.5 } finish { phong 1 } }", &[]);
        let (color, finish) = plain.plain().expect("it is plain");
        assert_eq!((color.rgb, finish.phong), (Rgb::splat(0.5), 1.0));
        assert!(prepare("{ pigment { checker } }", &[]).plain().is_none());
    }

    #[test]
    fn reflection_is_recognized() {
        assert!(prepare("{ finish { reflection 0.5 } }", &[]).has_reflection());
        assert!(!prepare("{ finish { reflection 0 } }", &[]).has_reflection());
    }

    #[test]
    fn films_grain_and_light_in_the_surface_are_no_plain_finish() {
        let is_plain = |finish: &str| {
            let texture = prepare(
                &format!("{{ finish {{ {finish} }} normal {{ bumps }} }}"),
                &[],
            );
            texture.layers()[0].has_plain_finish()
        };
        assert!(is_plain(
            "phong 1 specular 1 diffuse 0.3, 0.2 reflection { 0.2 metallic }"
        ));
        for finish in [
            "crand 0.1",
            "irid { 0.3 }",
            "reflection { 0.2 exponent 0.5 }",
        ] {
            assert!(!is_plain(finish), "{finish}");
        }
    }

    #[test]
    fn uv_mapped_pigments_are_evaluated_at_the_texture_coordinates() {
        let text = "{ pigment { gradient <0,0,1> pigment_map { [0 uv_mapping gradient <1,0,0>] [1 rgb 0] } scale 8 } }";
        let texture = prepare(text, &[Step::Scale(DVec3::splat(2.0))]);
        let spot = SurfacePoint {
            uv: glam::DVec2::new(0.25, 0.5),
            ..SurfacePoint::at(DVec3::new(0.9, 0.9, 0.0))
        };
        assert!(texture.uses_uv());
        assert_eq!(texture.layers()[0].pigment.color(&spot).rgb.r, 0.25);
        assert!(!prepare("{ pigment { gradient <1,0,0> } normal { bumps } }", &[]).uses_uv());
        assert!(prepare("{ normal { uv_mapping bumps } }", &[]).uses_uv());
        assert!(prepare("{ uv_mapping pigment { rgb 1 } }", &[]).uses_uv());
    }
}
