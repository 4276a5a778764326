//! Textures as rays need them: the top layer first, patterns with their inverse matrix, questions answered beforehand.

use super::select::{Choice, Choosing};
use super::{Finish, Layer, Look, Pigment, PigmentKind, PreparedNormal, Texture};
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

/// A texture ready for rays.
#[derive(Debug, Default)]
pub struct PreparedTexture {
    layers: Layers,
}

/// The layers of a texture. There may be a million textures, most of which have one.
#[derive(Debug)]
enum Layers {
    One(PreparedLayer),
    Some(Vec<PreparedLayer>),
    /// What chooses among other textures; the layers do not count then.
    Chosen(Box<(Choice, Vec<PreparedLayer>)>),
}

impl Default for Layers {
    fn default() -> Self {
        Layers::Some(Vec::new())
    }
}

/// A layer ready for rays.
#[derive(Debug)]
pub struct PreparedLayer {
    /// The colour.
    pub pigment: PreparedPigment,
    /// The answer to light.
    pub finish: Arc<Finish>,
    /// What few have.
    more: Option<Box<More>>,
}

/// What few layers have.
#[derive(Debug)]
struct More {
    quick_color: Option<Color>,
    normal: Option<PreparedNormal>,
}

/// A pigment ready for rays. There may be a million of them, most of them plain.
#[derive(Debug)]
pub enum PreparedPigment {
    /// The same colour everywhere.
    Plain(Color),
    /// A pattern whose value is looked up among colours.
    Colors(Box<(PreparedPattern, Map<Color>)>),
    /// A pattern whose value is looked up among pigments.
    Pigments(Box<(PreparedPattern, Map<PreparedPigment>)>),
    /// The mean of pigments by weight.
    Average(Box<(PreparedWarpChain, Map<PreparedPigment>)>),
    /// The colours of a picture.
    Image(Box<(PreparedWarpChain, bitmap::Source)>),
    /// Another pigment at the texture coordinates.
    Uv(Box<PreparedPigment>),
}

impl PreparedTexture {
    /// The form for drawing, with the transforms of what carries it after its own; normals have been turned so `far` on
    /// their way to it.
    pub(super) fn new(
        texture: &Texture,
        after: &[Step],
        far: &NormalTransforms,
        settings: &Settings,
    ) -> Self {
        let prepare = |layer: &Layer| {
            let normal = PreparedNormal::of_layer(layer, after, settings);
            let normal = normal.map(|normal| normal.within(far));
            let quick_color = layer.pigment.quick_color.as_deref().copied();
            let has_more = normal.is_some() || quick_color.is_some();
            PreparedLayer {
                pigment: PreparedPigment::new(&layer.pigment, after, settings),
                finish: Arc::clone(&layer.finish),
                more: has_more.then(|| {
                    Box::new(More {
                        quick_color,
                        normal,
                    })
                }),
            }
        };
        let mut layers: Vec<PreparedLayer> = texture.layers().iter().rev().map(prepare).collect();
        let choice = texture.pattern();
        let choice = choice.and_then(|choice| Choice::new(choice, after, far, settings));
        PreparedTexture {
            layers: match choice {
                Some(choice) => Layers::Chosen(Box::new((choice, layers))),
                None if layers.len() == 1 => layers.pop().map(Layers::One).unwrap_or_default(),
                None => Layers::Some(layers),
            },
        }
    }

    /// The form of a texture that is no more than a colour and how it answers to light.
    #[must_use]
    pub(crate) fn colored(color: Color, finish: Arc<Finish>) -> Self {
        PreparedTexture {
            layers: Layers::One(PreparedLayer {
                pigment: PreparedPigment::Plain(color),
                finish,
                more: None,
            }),
        }
    }

    /// The same in another colour, of what is no more than a colour and how it answers to light.
    #[must_use]
    pub(crate) fn in_color(&self, color: Color) -> Option<Self> {
        match &self.layers {
            Layers::One(PreparedLayer {
                pigment: PreparedPigment::Plain(_),
                finish,
                more: None,
            }) => Some(PreparedTexture::colored(color, Arc::clone(finish))),
            _ => None,
        }
    }

    /// The layers, the top one first; of no meaning if a pattern chooses among other textures.
    #[must_use]
    #[inline]
    pub fn layers(&self) -> &[PreparedLayer] {
        match &self.layers {
            Layers::One(layer) => std::slice::from_ref(layer),
            Layers::Some(layers) => layers,
            Layers::Chosen(chosen) => &chosen.1,
        }
    }

    /// What chooses among other textures, if that is done.
    fn choice(&self) -> Option<&Choice> {
        match &self.layers {
            Layers::Chosen(chosen) => Some(&chosen.0),
            Layers::One(_) | Layers::Some(_) => None,
        }
    }

    /// Whether a pattern chooses among other textures.
    #[must_use]
    pub fn is_patterned(&self) -> bool {
        self.choice().is_some()
    }

    /// Whether some layer is of this kind, of the texture itself or of any that it chooses from.
    pub fn has_layer(&self, is_such: &dyn Fn(&PreparedLayer) -> bool) -> bool {
        match self.choice() {
            None => self.layers().iter().any(is_such),
            Some(choice) => choice.textures().any(|texture| texture.has_layer(is_such)),
        }
    }

    /// Adds the textures that are seen of it, whose patterns are asked at `point`.
    pub fn look<'t>(&'t self, point: DVec3, weight: f32, to: &mut Choosing<'t>) {
        if let Some(choice) = self.choice() {
            return choice.look(point, weight, to);
        }
        to.looks.push(Look {
            weight,
            texture: self,
            point,
        });
        if let Some(flat) = &to.flat
            && let Some(normal) = self.normal_left(point, flat)
        {
            to.spot.normal = normal;
        }
    }

    /// The normal that the bumps of its layers have made last once all that can be seen of them are drawn, as slope patterns
    /// see it.
    fn normal_left(&self, point: DVec3, flat: &SurfacePoint) -> Option<DVec3> {
        let mut layers = self.layers().iter();
        let lowest = layers.position(|layer| !layer.pigment.can_be_transparent());
        let seen = lowest.map_or(self.layers().len(), |lowest| lowest + 1);
        let mut bumps = self.layers()[..seen].iter().rev();
        let bumps = bumps.find_map(PreparedLayer::normal)?;
        Some(bumps.tilted_and_seen(point, flat.normal, flat).1)
    }

    /// Whether normals decide which textures are seen of it.
    #[must_use]
    pub fn minds_normal(&self) -> bool {
        self.choice().is_some_and(Choice::minds_normal)
    }

    /// Whether something in it asks for the texture coordinates of the surface.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        match self.choice() {
            None => self.layers().iter().any(PreparedLayer::uses_uv),
            Some(choice) => choice.uses_uv(),
        }
    }

    /// Whether no light passes anywhere: some layer has neither filter nor transmit.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let is_opaque = |layer: &PreparedLayer| !layer.pigment.can_be_transparent();
        match self.choice() {
            None => self.layers().iter().any(is_opaque),
            Some(choice) => choice.textures().all(PreparedTexture::is_opaque),
        }
    }

    /// Whether it is one opaque layer with nothing to it but light and highlights: no bumps, no mirror image, no film, no
    /// grain.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.is_opaque() && !self.has_reflection() && self.is_nearly_plain()
    }

    /// Whether it is that but for a mirror image and what shines through.
    #[must_use]
    pub fn is_nearly_plain(&self) -> bool {
        match self.layers() {
            [layer] if self.choice().is_none() => {
                let finish = &layer.finish;
                layer.normal().is_none()
                    && finish.crand <= 0.0
                    && finish.irid.amount <= 0.0
                    && (!finish.has_reflection() || finish.reflection.exponent == 1.0)
            }
            _ => false,
        }
    }

    /// Whether each of its layers has one colour.
    #[must_use]
    pub fn is_even(&self) -> bool {
        let is_plain = |layer: &PreparedLayer| matches!(layer.pigment, PreparedPigment::Plain(_));
        self.choice().is_none() && self.layers().iter().all(is_plain)
    }

    /// Whether some layer has a mirror image.
    #[must_use]
    pub fn has_reflection(&self) -> bool {
        let has_reflection = |layer: &PreparedLayer| layer.finish.has_reflection();
        match self.choice() {
            None => self.layers().iter().any(has_reflection),
            Some(choice) => choice.textures().any(PreparedTexture::has_reflection),
        }
    }

    /// The only layer and its colour, if there is one layer and it is of one colour.
    #[must_use]
    pub fn plain(&self) -> Option<(Color, &Finish)> {
        match self.layers() {
            [layer] if self.choice().is_none() && layer.normal().is_none() => {
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
    /// The colour in previews of quality 5 and less: `quick_color`, if the scene gives one.
    #[must_use]
    #[inline]
    pub fn quick_color(&self) -> Option<&Color> {
        self.more.as_ref()?.quick_color.as_ref()
    }

    /// Bumps.
    #[must_use]
    #[inline]
    pub fn normal(&self) -> Option<&PreparedNormal> {
        self.more.as_ref()?.normal.as_ref()
    }

    fn uses_uv(&self) -> bool {
        let normal = self.normal();
        self.pigment.uses_uv() || normal.is_some_and(PreparedNormal::uses_uv)
    }
}

impl PreparedPigment {
    /// The form for drawing, with the transforms of what carries the pigment after its own.
    #[must_use]
    pub fn new(pigment: &Pigment, after: &[Step], settings: &Settings) -> Self {
        let none = Modifiers::default();
        let modifiers = pigment.modifiers.get().unwrap_or(&none);
        // The entries of a map are where the pattern takes the point; no other transforms act on them.
        let entries = |map: &Map<Pigment>| map.map(|entry| Self::new(entry, &[], settings));
        match &pigment.kind {
            PigmentKind::Plain(color) => PreparedPigment::Plain(*color),
            PigmentKind::Colors(mapped) => {
                let pattern = modifiers.prepare(&*mapped.pattern, after, settings);
                PreparedPigment::Colors(Box::new((pattern, mapped.map.clone())))
            }
            PigmentKind::Pigments(mapped) => {
                let pattern = modifiers.prepare(&*mapped.pattern, after, settings);
                PreparedPigment::Pigments(Box::new((pattern, entries(&mapped.map))))
            }
            PigmentKind::Average(Some(map)) => {
                let chain = modifiers.prepare_chain(after, settings);
                PreparedPigment::Average(Box::new((chain, entries(map))))
            }
            PigmentKind::Image(source) => {
                let chain = modifiers.prepare_chain(after, settings);
                PreparedPigment::Image(Box::new((chain, (**source).clone())))
            }
            // Neither its own transforms nor those around it move texture coordinates.
            PigmentKind::Uv(mapped) => {
                PreparedPigment::Uv(Box::new(Self::new(mapped, &[], settings)))
            }
            PigmentKind::Average(None) => PreparedPigment::Plain(Color::default()),
        }
    }

    /// The colour at a place.
    #[must_use]
    #[inline]
    pub fn color(&self, spot: &SurfacePoint) -> Color {
        match self {
            PreparedPigment::Plain(color) => *color,
            _ => self.patterned(spot.point, spot),
        }
    }

    /// The colour at a point, which for the entries of maps is one of the pattern around them.
    #[must_use]
    pub fn patterned(&self, point: DVec3, spot: &SurfacePoint) -> Color {
        match self {
            PreparedPigment::Plain(color) => *color,
            PreparedPigment::Colors(both) => {
                let (pattern, map) = &**both;
                map.color(pattern.value(pattern.to_pattern_space(point), spot))
            }
            PreparedPigment::Pigments(both) => {
                let (pattern, map) = &**both;
                let moved = pattern.to_pattern_space(point);
                match map.between(pattern.value(moved, spot)) {
                    Between::One(entry) => entry.patterned(moved, spot),
                    Between::Two(from, to, share) => {
                        let to = to.patterned(moved, spot);
                        from.patterned(moved, spot).blended(&to, share)
                    }
                }
            }
            PreparedPigment::Average(both) => {
                let (chain, map) = &**both;
                let moved = chain.to_pattern_space(point);
                let weighted = |(weight, entry): &(f32, PreparedPigment)| {
                    (*weight, entry.patterned(moved, spot))
                };
                Color::average(map.entries().iter().map(weighted))
            }
            PreparedPigment::Image(both) => both.1.color(both.0.to_pattern_space(point)),
            PreparedPigment::Uv(mapped) => mapped.patterned(spot.uv_point(), spot),
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
            PreparedPigment::Uv(mapped) => mapped.can_be_transparent(),
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
            PreparedPigment::Plain(_) | PreparedPigment::Colors(_) | PreparedPigment::Image(_) => {
                false
            }
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
    fn one_plain_layer_is_told_apart() {
        let plain = prepare("{ pigment { rgb 0.5 } finish { phong 1 } }", &[]);
        let (color, finish) = plain.plain().expect("it is plain");
        assert_eq!((color.rgb, finish.phong), (Rgb::splat(0.5), 1.0));
        assert!(prepare("{ pigment { checker } }", &[]).plain().is_none());
    }

    #[test]
    fn reflection_is_noticed() {
        assert!(prepare("{ finish { reflection 0.5 } }", &[]).has_reflection());
        assert!(!prepare("{ finish { reflection 0 } }", &[]).has_reflection());
    }

    #[test]
    fn what_is_uv_mapped_is_asked_at_the_texture_coordinates() {
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
