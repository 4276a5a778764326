//! Doubts about colours and textures.

use super::{Located, doubt};
use crate::base::color::Color;
use crate::base::source::{Code, Diagnostic};
use crate::base::version::has_defaults_of_3_8;
use crate::scene::shape::Geometry;
use crate::scene::texture::{Pigment, PigmentKind, Texture};
use crate::scene::{Kind, Object, Scene};

/// Colours with whole channels from this one on count from 0 to 255.
const BYTE: f32 = 32.0;
/// Reports of one kind in a scene; more say nothing new.
const MOST: usize = 5;

pub(super) fn doubts(scene: &Scene, located: impl Iterator<Item = Located>) -> Vec<Diagnostic> {
    let (mut black, mut bright) = (Vec::new(), Vec::new());
    for one in located {
        if black.len() < MOST
            && !has_defaults_of_3_8(scene.version)
            && one.has_stock_texture
            && !matches!(one.object.kind, Kind::Light { .. })
            && is_bare(&one.object)
        {
            black.push(doubt(
                Code::NoPigment,
                one.span,
                "this object has no pigment, and is black",
                "Write `pigment { rgb <1, 0.5, 0> }` in it.",
            ));
        }
        if bright.len() < MOST && has_byte_color(&one.object) {
            bright.push(doubt(
                Code::ByteColor,
                one.span,
                "a colour of this object counts from 0 to 255",
                "Colours count from 0 to 1: write `rgb <255, 128, 0>/255`.",
            ));
        }
    }
    black.append(&mut bright);
    black
}

/// True if no part has a texture but the default one of the whole.
fn is_bare(object: &Object) -> bool {
    fn has_texture(object: &Object) -> bool {
        match &object.kind {
            Kind::Shape(shape) => !shape.face_textures().is_empty(),
            Kind::Light { .. } => true,
            Kind::Csg { children, .. } => children
                .iter()
                .any(|child| child.texture.is_some() || has_texture(child)),
        }
    }
    object.interior.is_none() && object.interior_texture().is_none() && !has_texture(object)
}

fn has_byte_color(object: &Object) -> bool {
    let own = object
        .texture
        .iter()
        .any(|texture| is_byte_color(&texture.what));
    own || match &object.kind {
        Kind::Csg { children, .. } => children.iter().any(|child| has_byte_color(child)),
        _ => false,
    }
}

fn is_byte_color(texture: &Texture) -> bool {
    let layers = texture.layers().iter();
    layers
        .map(|layer| &layer.pigment)
        .any(|pigment: &Pigment| match pigment.kind {
            PigmentKind::Plain(Color { rgb, .. }) => {
                let channels = [rgb.r, rgb.g, rgb.b];
                let is_byte =
                    |channel: &f32| (0.0..=255.0).contains(channel) && channel.fract() == 0.0;
                channels.iter().all(is_byte) && channels.iter().any(|&channel| channel >= BYTE)
            }
            _ => false,
        })
}
