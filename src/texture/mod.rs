//! Textures: what a surface looks like. A texture is a stack of layers, each a pigment and a finish.
//!
//! Built are plain and listed pigments, finishes and layers. Normals, texture maps and patterned textures are missing.

mod film;
mod finish;
mod layers;
mod material;
mod pigment;
mod pigment_pattern;
mod prepared;
mod rare;
mod reflection;

pub use film::{Irid, Subsurface};
pub use finish::Finish;
pub use layers::{Layer, Texture};
pub use material::Material;
pub use pigment::{Pigment, PigmentKind};
pub use pigment_pattern::read_pattern;
pub use prepared::{PreparedLayer, PreparedPigment, PreparedTexture};
pub use rare::Rare;
pub use reflection::Reflection;
