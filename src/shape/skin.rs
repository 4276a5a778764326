//! Textures that single pieces of a shape have of their own: the triangles of a mesh, the components of a blob.

use crate::args::{Args, Parse};
use crate::texture::Texture;
use smallvec::SmallVec;
use std::sync::Arc;

/// The texture of some pieces of a shape; the transforms of the object move it with them. Two are the same if they
/// are one value.
#[derive(Clone, Debug)]
pub struct Skin(pub Arc<Texture>);

/// A part of the look of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// How much of the look; all shares of a point add up to one.
    pub weight: f64,
    /// Which of the skins of the shape.
    pub skin: u32,
}

/// The parts of the look of a point; none if it looks as the object does.
pub type Shares = SmallVec<[Share; 3]>;

impl Skin {
    /// Reads a texture behind its word.
    ///
    /// # Errors
    /// A malformed texture.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Self> {
        let expected = |args: &mut dyn Args| args.expected("a texture");
        let texture = args.texture_any()?;
        let texture = texture.downcast::<Texture>();
        texture.map(Skin).map_err(|_| expected(args))
    }
}

impl Skin {
    /// Whether it asks for texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        self.0.uses_uv()
    }
}

impl PartialEq for Skin {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
