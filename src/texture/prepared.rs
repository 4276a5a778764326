//! Textures as rays need them: the top layer first, patterns with their inverse matrix, questions answered beforehand.

use super::{Finish, Layer, Pigment, PigmentKind, Texture};
use crate::color::Color;
use crate::math::{Step, Transform};
use crate::pattern::Pattern;
use glam::{DAffine3, DVec3};

/// A texture ready for rays.
#[derive(Debug)]
pub struct PreparedTexture {
    layers: Vec<PreparedLayer>,
    is_opaque: bool,
    has_reflection: bool,
}

/// A layer ready for rays.
#[derive(Debug)]
pub struct PreparedLayer {
    /// The colour.
    pub pigment: PreparedPigment,
    /// The colour in previews of quality 5 and less: `quick_color`, if the scene gives one.
    pub quick_color: Option<Color>,
    /// The answer to light.
    pub finish: Finish,
}

/// A pigment ready for rays.
#[derive(Debug)]
pub enum PreparedPigment {
    /// The same colour everywhere.
    Plain(Color),
    /// A list of colours from which a pattern selects.
    List {
        /// The pattern.
        pattern: Box<dyn Pattern>,
        /// Its colours, never none.
        colors: Vec<Color>,
        /// Takes points of the world to the pattern.
        pattern_from_world: DAffine3,
    },
}

impl PreparedTexture {
    pub(super) fn new(texture: &Texture, after: &[Step]) -> Self {
        let prepare = |layer: &Layer| PreparedLayer {
            pigment: PreparedPigment::new(&layer.pigment, after),
            quick_color: layer.pigment.quick_color,
            finish: Finish::clone(&layer.finish),
        };
        let layers: Vec<_> = texture.layers().iter().rev().map(prepare).collect();
        PreparedTexture {
            is_opaque: layers
                .iter()
                .any(|layer| !layer.pigment.can_be_transparent()),
            has_reflection: layers.iter().any(|layer| layer.finish.has_reflection()),
            layers,
        }
    }

    /// The layers, the top one first.
    #[must_use]
    pub fn layers(&self) -> &[PreparedLayer] {
        &self.layers
    }

    /// Whether no light passes anywhere: some layer has neither filter nor transmit.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.is_opaque
    }

    /// Whether some layer has a mirror image.
    #[must_use]
    pub fn has_reflection(&self) -> bool {
        self.has_reflection
    }

    /// The only layer and its colour, if there is one layer and it is of one colour.
    #[must_use]
    pub fn plain(&self) -> Option<(Color, &Finish)> {
        match self.layers.as_slice() {
            [
                PreparedLayer {
                    pigment: PreparedPigment::Plain(color),
                    finish,
                    ..
                },
            ] => Some((*color, finish)),
            _ => None,
        }
    }
}

impl PreparedPigment {
    fn new(pigment: &Pigment, after: &[Step]) -> Self {
        match &pigment.kind {
            PigmentKind::Plain(color) => PreparedPigment::Plain(*color),
            PigmentKind::List(pattern, colors) => {
                let steps: Vec<Step> = pigment.steps.iter().chain(after).cloned().collect();
                PreparedPigment::List {
                    pattern: pattern.clone(),
                    colors: colors.clone(),
                    pattern_from_world: Transform::from_steps(&steps).object_from_world,
                }
            }
        }
    }

    /// The colour at a point of the world.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        match self {
            PreparedPigment::Plain(color) => *color,
            PreparedPigment::List {
                pattern,
                colors,
                pattern_from_world,
            } => {
                let value = pattern.value(pattern_from_world.transform_point3(point));
                colors[entry(value).min(colors.len() - 1)]
            }
        }
    }

    fn can_be_transparent(&self) -> bool {
        match self {
            PreparedPigment::Plain(color) => color.is_transparent(),
            PreparedPigment::List { colors, .. } => colors.iter().any(|c| c.is_transparent()),
        }
    }
}

/// The entry that a value selects; negative values and NaN select the first.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, and the caller cuts to the length of the list"
)]
fn entry(value: f64) -> usize {
    value as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;
    use crate::color::Rgb;

    fn prepare(text: &str, after: &[Step]) -> PreparedTexture {
        let texture = Texture::read(&mut TextArgs::new(text), &Layer::default());
        texture.unwrap().prepare(after)
    }

    #[test]
    fn the_transforms_of_the_object_act_after_those_of_the_texture() {
        let text = "{ pigment { checker rgb 1 rgb 0.5 scale 2 } }";
        let texture = prepare(text, &[Step::Translate(DVec3::X)]);
        let grey = |x: f64| {
            texture.layers()[0]
                .pigment
                .color(DVec3::new(x, 0.5, 0.5))
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
}
