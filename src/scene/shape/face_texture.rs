//! Textures of single pieces of a shape: triangles of a mesh, components of a blob.

use crate::base::args::{Args, Parse, Word, default_of};
use crate::base::source::Diagnostic;
use crate::scene::texture::{Layer, Texture};
use smallvec::SmallVec;
use std::sync::Arc;

/// Texture of some pieces of a shape; the transforms of the object move it with them. Two are equal if they share one
/// value.
#[derive(Clone, Debug)]
pub struct FaceTexture(pub Arc<Texture>);

/// Weight of one texture at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureWeight {
    /// The weight; all weights of a point add up to one.
    pub weight: f64,
    /// Index into [`Geometry::face_textures`](super::Geometry::face_textures), or [`TextureWeight::OF_THE_OBJECT`].
    pub texture: u32,
}

/// Texture weights at a point; empty where the texture of the object applies.
pub type TextureWeights = SmallVec<[TextureWeight; 3]>;

impl TextureWeight {
    /// Value of [`TextureWeight::texture`] for the texture of the object.
    pub const OF_THE_OBJECT: u32 = u32::MAX;
}

impl FaceTexture {
    /// Reads `texture`, `pigment`, `normal` or `finish` with its block, if `word` is one of them, on top of the texture
    /// that a piece of a shape already has. Returns whether it was one of them.
    ///
    /// # Errors
    /// A malformed block, or a texture that cannot be layered over the one before.
    pub(super) fn read_over(
        own: &mut Option<Texture>,
        word: Word,
        args: &mut dyn Args,
    ) -> Parse<bool> {
        let default: Layer = default_of(args);
        if args.accept(Word::Texture)? {
            let upper = Texture::read(args, &default)?;
            match own {
                None => *own = Some(upper),
                Some(lower) => {
                    if let Some(fault) = lower.layering_error(&upper) {
                        return Err(Box::new(Diagnostic::error(args.last_span(), fault)));
                    }
                    lower.lay_over(upper, args.version());
                }
            }
            return Ok(true);
        }
        if !matches!(word, Word::Pigment | Word::Normal | Word::Finish) {
            return Ok(false);
        }
        let texture = own.get_or_insert_with(|| Texture::from(default));
        if texture.is_patterned() {
            let fault = format!("`{word}` cannot change a texture that a pattern chooses");
            return Err(Box::new(Diagnostic::error(args.span(), fault)));
        }
        texture.top_mut().read_part(word, args)
    }

    /// Reads a texture after its keyword.
    ///
    /// # Errors
    /// A malformed texture.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Self> {
        let expected = |args: &mut dyn Args| args.expected("a texture");
        let texture = args.texture_any()?;
        let texture = texture.downcast::<Texture>();
        texture.map(FaceTexture).map_err(|_| expected(args))
    }
}

impl FaceTexture {
    /// True if the texture needs texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        self.0.uses_uv()
    }
}

impl PartialEq for FaceTexture {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
