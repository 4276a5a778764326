//! `material`: a texture, an interior texture and an interior under one name.

use super::{Layer, Texture};
use crate::base::args::{Args, Parse, Word, declared, transform_step};
use crate::base::math::Step;
use crate::base::source::Diagnostic;
use crate::scene::interior::Interior;

/// The attributes of an object that a material sets.
#[derive(Clone, Debug, Default)]
pub struct Material {
    /// The texture of the surface.
    pub texture: Option<Texture>,
    /// The texture of the surface seen from inside.
    pub interior_texture: Option<Texture>,
    /// The interior.
    pub interior: Option<Interior>,
}

impl Material {
    /// Reads a material block. Several textures become layers, also over the texture of a named material.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read(args: &mut dyn Args, default: &Layer) -> Parse<Material> {
        args.open()?;
        let mut material = match declared::<Material>(args)? {
            Some(known) => Material::clone(&known),
            None => Material::default(),
        };
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                material.transform(&step);
            } else if args.accept(Word::Texture)? {
                let texture = Texture::read(args, default)?;
                lay(&mut material.texture, texture, args)?;
            } else if args.accept(Word::InteriorTexture)? {
                let texture = Texture::read(args, default)?;
                lay(&mut material.interior_texture, texture, args)?;
            } else if args.accept(Word::Interior)? {
                material.interior = Some(Interior::read(args)?);
            } else {
                return Err(args.expected("`texture`, `interior` or `}` in `material`"));
            }
        }
        Ok(material)
    }

    /// The material as an object takes it: its textures are the lowest of the object's.
    #[must_use]
    pub fn in_version(mut self, version: f64) -> Material {
        for texture in [&mut self.texture, &mut self.interior_texture] {
            *texture = texture.take().map(|texture| texture.as_lowest(version));
        }
        self
    }

    /// Transforms the textures and the media of the interior that have been read so far.
    pub fn transform(&mut self, step: &Step) {
        let textures = [&mut self.texture, &mut self.interior_texture];
        for texture in textures.into_iter().flatten() {
            texture.transform(step);
        }
        if let Some(interior) = &mut self.interior {
            interior.transform(step);
        }
    }
}

/// Layers `upper` over the texture in `slot`.
fn lay(slot: &mut Option<Texture>, upper: Texture, args: &dyn Args) -> Parse<()> {
    match slot {
        Some(lower) if lower.is_patterned() || upper.is_patterned() => {
            let message = "a texture chosen by a pattern cannot be a layer of another";
            return Err(Box::new(Diagnostic::error(args.last_span(), message)));
        }
        Some(lower) => lower.lay_over(upper, args.version()),
        None => *slot = Some(upper),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn read(args: &mut TextArgs) -> Material {
        Material::read(args, &Layer::default()).unwrap()
    }

    #[test]
    fn a_material_holds_texture_and_interior() {
        let mut args = TextArgs::new(
            "{ texture { pigment { rgb 1 } } interior_texture { pigment { rgb 0 } } interior { ior 1.5 } }",
        );
        let material = read(&mut args);
        assert!(material.texture.is_some() && material.interior_texture.is_some());
        assert_eq!(material.interior.expect("it has an interior").ior, 1.5);
    }

    #[test]
    fn two_textures_make_layers() {
        let material = read(&mut TextArgs::new("{ texture { } texture { } }"));
        assert_eq!(
            material.texture.expect("it has a texture").layers().len(),
            2
        );
    }
}
