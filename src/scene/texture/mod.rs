//! Textures: the appearance of a surface. A texture is a stack of layers, each with a pigment, a finish and optional
//! bumps, or a pattern that selects among other textures.

mod boxed_default;
mod bump;
mod color_functions;
mod film;
mod finish;
mod layers;
mod material;
mod normal;
mod numbers;
mod patterned;
mod pigment;
mod pigment_pattern;
mod prepared;
mod reflection;
mod select;
mod version_2;

pub use boxed_default::BoxedDefault;
pub use bump::PreparedNormal;
pub use color_functions::ColorFunctions;
pub use film::{Irid, Subsurface};
pub use finish::Finish;
pub use layers::{Layer, Texture};
pub use material::Material;
pub use normal::{Facets, Normal, NormalKind};
pub use patterned::{Patterned, PatternedKind};
pub use pigment::{Mapped, Pigment, PigmentKind, PigmentSyntax};
pub use pigment_pattern::read_pattern;
pub use prepared::{PreparedLayer, PreparedPigment, PreparedTexture};
pub use reflection::Reflection;
pub use select::{TextureSelection, WeightedTexture, WeightedTextures};
