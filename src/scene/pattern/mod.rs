//! The patterns: one file each, with its mathematics and what it reads.
//!
//! A pattern gives a value at a point of pattern space, to which the [`WarpChain`] moves the point: transforms,
//! warps, turbulence. Behind it the [`Wave`] shapes the value. A [`Map`] then turns the value into entries of any kind:
//! colours, pigments, normals, textures. All that a scene writes beside the pattern's own word is in [`Modifiers`],
//! which pigments, normals, densities and textures share.

/// Patterns that tile space with blocks of one value each.
mod block {
    pub(super) mod brick;
    pub(super) mod cells;
    pub(super) mod checker;
    pub(super) mod hexagon;
    pub(super) mod square;
    pub(super) mod tiling;
    pub(super) mod triangular;
}
mod chain;
mod field;
mod fractal;
/// Patterns that are a formula of the coordinates.
mod geometric {
    pub(super) mod boxed;
    pub(super) mod cubic;
    pub(super) mod cylindrical;
    pub(super) mod formula;
    pub(super) mod gradient;
    pub(super) mod leopard;
    pub(super) mod onion;
    pub(super) mod planar;
    pub(super) mod quilted;
    pub(super) mod radial;
    pub(super) mod spherical;
    pub(super) mod spiral;
}
/// Patterns whose values come from files, functions, objects or the surface.
mod lookup {
    pub(super) mod aoi;
    pub(super) mod density_file;
    pub(super) mod function;
    pub(super) mod image_pattern;
    pub(super) mod object;
    pub(super) mod slope;
}
mod map;
mod modifiers;
/// Patterns made of noise.
mod noise {
    pub(super) mod agate;
    pub(super) mod bozo;
    pub(super) mod crackle;
    pub(super) mod dents;
    pub(super) mod granite;
    pub(super) mod marble;
    pub(super) mod ripples;
    pub(super) mod wood;
    pub(super) mod wrinkles;
}
mod prepared;
#[cfg(test)]
mod tests;
mod warp;
mod wave;

pub use chain::{PreparedWarpChain, Turns, WarpChain};
pub use field::{ReadPattern, read_field};
pub use map::{Between, Keys, MOST_ENTRIES, Map};
pub use modifiers::{Modifiers, read_noise_generator};
pub use noise::crackle::nearest_feature;
pub use prepared::PreparedPattern;
pub use wave::{Shape, Wave};

use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::base::math::rounding::floor;
use crate::base::word::Class;
use glam::{DVec2, DVec3};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// What POV-Ray adds to coordinates, so that a face that lies in a cell boundary does not show rounding noise.
pub const NUDGE: f64 = 1e-10;

/// Reads what stands behind the word of a pattern and belongs to it, and makes the pattern.
type New = fn(&mut dyn Args) -> Parse<Box<dyn Pattern>>;

/// An entry of a map of colours.
pub type Stop = (f32, Color);

/// The patterns by their words.
static PATTERNS: &[(Word, New)] = &[
    (Word::Agate, noise::agate::new),
    (Word::Aoi, lookup::aoi::new),
    (Word::Boxed, geometric::boxed::new),
    (Word::Bozo, noise::bozo::bozo),
    (Word::Brick, block::brick::new),
    (Word::Bumps, noise::bozo::bumps),
    (Word::Cells, block::cells::new),
    (Word::Checker, block::checker::new),
    (Word::Crackle, noise::crackle::new),
    (Word::Cubic, geometric::cubic::new),
    (Word::Cylindrical, geometric::cylindrical::new),
    (Word::DensityFile, lookup::density_file::new),
    (Word::Dents, noise::dents::new),
    (Word::Function, lookup::function::new),
    (Word::Gradient, geometric::gradient::new),
    (Word::Granite, noise::granite::new),
    (Word::Hexagon, block::hexagon::new),
    (Word::ImagePattern, lookup::image_pattern::new),
    (Word::Julia, fractal::julia::new),
    (Word::Leopard, geometric::leopard::new),
    (Word::Magnet, fractal::magnet::new),
    (Word::Mandel, fractal::mandel::new),
    (Word::Marble, noise::marble::new),
    (Word::Object, lookup::object::new),
    (Word::Onion, geometric::onion::new),
    (Word::Planar, geometric::planar::new),
    (Word::Quilted, geometric::quilted::new),
    (Word::Radial, geometric::radial::new),
    (Word::Ripples, noise::ripples::ripples),
    (Word::Slope, lookup::slope::new),
    (Word::Spherical, geometric::spherical::new),
    (Word::Spiral1, geometric::spiral::spiral1),
    (Word::Spiral2, geometric::spiral::spiral2),
    (Word::Spotted, noise::bozo::spotted),
    (Word::Square, block::square::new),
    (Word::Tiling, block::tiling::new),
    (Word::Triangular, block::triangular::new),
    (Word::Waves, noise::ripples::waves),
    (Word::Wood, noise::wood::new),
    (Word::Wrinkles, noise::wrinkles::new),
];

/// The map of colours of patterns that have none of their own.
const GREY: [Stop; 2] = [
    (0.0, Color::opaque(Rgb::BLACK)),
    (1.0, Color::opaque(Rgb::WHITE)),
];

/// A pattern as a scene describes it.
pub trait Pattern: Debug + Send + Sync + ClonePattern {
    /// The form for drawing.
    fn prepare(&self, with: &Preparing<'_>) -> Box<dyn PatternEval>;

    /// The colours where the scene gives none. For a pattern with a list, entry `i` is at the value `i`.
    fn default_map(&self) -> &'static [Stop] {
        &GREY
    }

    /// How the value is shaped where the scene does not say it.
    fn default_wave(&self) -> Wave {
        Wave::default()
    }

    /// Whether the pattern selects from a list that stands behind its word, as `checker` does.
    fn has_list(&self) -> bool {
        false
    }

    /// Whether the list stands in a block of the pattern that is still open, as that of `object` does.
    fn has_open_block(&self) -> bool {
        false
    }

    /// Whether `turbulence` displaces the point; otherwise it has its place in the formula of the pattern.
    fn is_displaced(&self) -> bool {
        true
    }

    /// Takes and reads `word` and its value if the pattern has such a parameter, and says whether it has.
    ///
    /// # Errors
    /// A malformed value.
    fn read_modifier(&mut self, _word: Word, _args: &mut dyn Args) -> Parse<bool> {
        Ok(false)
    }
}

/// What draws a pattern.
pub trait PatternEval: Debug + Send + Sync {
    /// The value at a point of pattern space, before waves. For a pattern with a list, the index of an entry.
    fn value(&self, point: DVec3, spot: &SurfacePoint) -> f64;

    /// How a `normal` of height 1 tilts a surface at a point of pattern space: what is added to the unit normal; `None`
    /// for the patterns whose values are the heights.
    fn tilt(&self, _point: DVec3) -> Option<DVec3> {
        None
    }

    /// Whether the value hangs on the normal of the surface.
    fn minds_normal(&self) -> bool {
        false
    }
}

/// The place that is coloured, for the patterns that ask for more than a point of their own space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point of the world.
    pub point: DVec3,
    /// The unit normal of the surface on the side that is seen; zero where there is no surface.
    pub normal: DVec3,
    /// The direction of the ray that sees it; zero where there is none.
    pub dir: DVec3,
    /// The texture coordinates for `uv_mapping`; zero where nothing asks for them.
    pub uv: DVec2,
}

impl SurfacePoint {
    /// The point of pattern space for what is mapped by texture coordinates.
    #[must_use]
    pub fn on_the_map(&self) -> DVec3 {
        self.uv.extend(0.0)
    }

    /// A point in no surface, seen by nobody in particular.
    #[must_use]
    pub fn at(point: DVec3) -> Self {
        SurfacePoint {
            point,
            normal: DVec3::ZERO,
            dir: DVec3::ZERO,
            uv: DVec2::ZERO,
        }
    }
}

/// What a whole scene says about its patterns.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The noise of patterns that choose none.
    pub noise_generator: NoiseGenerator,
    /// How many sources `waves` and `ripples` have.
    pub number_of_waves: u32,
    /// What makes an object of the scene ready for points; without it nothing is inside of anything.
    pub solid_of: Option<SolidOf>,
}

/// Makes an object, as `Args` reads it, ready for points; `None` if it is none.
pub type SolidOf = fn(&Arc<dyn Any + Send + Sync>) -> Option<Arc<dyn Solid>>;

/// An object that points may lie in.
pub trait Solid: Debug + Send + Sync {
    /// Whether a point of the object's space lies inside.
    fn holds(&self, point: DVec3) -> bool;
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            noise_generator: NoiseGenerator::default(),
            number_of_waves: 10,
            solid_of: None,
        }
    }
}

/// What a pattern may take into its form for drawing.
#[derive(Debug)]
pub struct Preparing<'a> {
    /// The noise that the pattern uses.
    pub noise: NoiseGenerator,
    /// The amounts of `turbulence`, zero where the scene gives none.
    pub turbulence: DVec3,
    /// How the octaves of `turbulence` are summed.
    pub octaves: Octaves,
    /// How the value will be shaped.
    pub wave: Wave,
    /// What the scene says.
    pub settings: &'a Settings,
}

/// Copying behind a `Box`; every type that can be cloned has it.
pub trait ClonePattern {
    /// A copy that can be modified by itself.
    fn copied(&self) -> Box<dyn Pattern>;
}

impl<T: Pattern + Clone + 'static> ClonePattern for T {
    fn copied(&self) -> Box<dyn Pattern> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Pattern> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

/// The pattern of this word, if there is one and it is built. Takes the word and what belongs to it.
///
/// # Errors
/// A malformed value behind the word.
pub fn read_named(word: Word, args: &mut dyn Args) -> Parse<Option<Box<dyn Pattern>>> {
    let Some((_, new)) = PATTERNS.iter().find(|entry| entry.0 == word) else {
        return Ok(None);
    };
    args.accept(word)?;
    new(args).map(Some)
}

/// Whether the language has a pattern of this word, built or not.
#[must_use]
pub fn is_pattern(word: Word) -> bool {
    // These words have a second meaning, under which the grammar lists them.
    const ELSEWHERE: [Word; 4] = [Word::Cubic, Word::Function, Word::Object, Word::Spherical];
    let is_parameter = matches!(word, Word::BumpMap | Word::Pattern | Word::Solid);
    ELSEWHERE.contains(&word) || (word.class() == Class::Pattern && !is_parameter)
}

/// The part of `x` above the next lower integer, in `[0, 1)`.
fn fraction(x: f64) -> f64 {
    x - floor(x)
}

/// The unit cube that a point lies in; the numbers saturate far out.
#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
#[inline]
fn cell(point: DVec3) -> [i64; 3] {
    point.to_array().map(|coordinate| floor(coordinate) as i64)
}
