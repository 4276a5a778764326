//! `material`: a texture, a texture for the inside and an interior under one name.

use super::{Layer, Texture};
use crate::base::args::{Args, Parse, Word, declared, transform_step};
use crate::base::math::Step;
use crate::base::source::Diagnostic;
use crate::scene::interior::Interior;

/// The parts of an object that a material brings along.
#[derive(Clone, Debug, Default)]
pub struct Material {
    /// The look of the surface.
    pub texture: Option<Texture>,
    /// The look of the surface from inside.
    pub interior_texture: Option<Texture>,
    /// What fills the object.
    pub interior: Option<Interior>,
}

impl Material {
    /// The material of a block. Several textures make layers, also over that of a named material.
    ///
    /// # Errors
    /// A malformed value, or a word that is not built yet.
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

    /// Moves the textures and the media of the interior, as far as they have been read.
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

fn lay(slot: &mut Option<Texture>, upper: Texture, args: &dyn Args) -> Parse<()> {
    match slot {
        Some(lower) if lower.is_patterned() || upper.is_patterned() => {
            let message = "a texture that a pattern chooses is no layer of another";
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
