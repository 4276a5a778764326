//! The patterns: one file each, with its mathematics and its parameters.
//!
//! A [`WarpChain`] (transforms, warps, turbulence) takes a shading point to pattern space. The pattern gives the value
//! there, and a [`Wave`] shapes it. A [`Map`] then turns the value into entries of any kind: colours, pigments,
//! normals, textures. The modifiers that any pattern may have are in [`Modifiers`], which pigments, normals, densities
//! and textures share.

/// Patterns that divide space into regions of constant value.
mod block {
    pub(super) mod brick;
    pub(super) mod cells;
    pub(super) mod checker;
    pub(super) mod dodecagons;
    pub(super) mod hexagon;
    pub(super) mod pavement;
    pub(super) mod penrose;
    pub(super) mod square;
    pub(super) mod tiling;
    pub(super) mod triangular;
}
mod chain;
mod field;
mod fractal;
mod octaves;
/// Patterns given by a formula of the coordinates.
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
/// Patterns whose values come from files, functions, objects or the surface normal.
mod lookup {
    pub(super) mod aoi;
    pub(super) mod density_file;
    pub(super) mod function;
    pub(super) mod image_pattern;
    pub(super) mod object;
    pub(super) mod potential;
    pub(super) mod slope;
}
mod map;
mod modifiers;
/// Patterns based on noise.
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

pub use chain::{NormalTransforms, PreparedWarpChain, WarpChain};
pub use field::{ReadPattern, read_field};
pub use lookup::potential::Field;
pub(crate) use map::Blend;
pub use map::{Between, Keys, MAX_ENTRIES, Map};
pub use modifiers::{Modifiers, read_noise_generator};
pub use noise::crackle::nearest_feature;
pub use prepared::PreparedPattern;
pub use wave::{Shape, Wave};

use crate::base::args::{AnyObject, Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::base::math::rounding::floor;
use crate::base::word::Class;
use glam::{DVec2, DVec3};
use std::fmt::Debug;
use std::sync::Arc;

/// Offset that POV-Ray adds to coordinates, so that a face lying in a cell boundary shows no rounding noise.
pub const NUDGE: f64 = 1e-10;

/// Reads the parameters after the keyword of a pattern and makes the pattern.
type New = fn(&mut dyn Args) -> Parse<Box<dyn Pattern>>;

/// An entry of a colour map: position and colour.
pub type Stop = (f32, Color);

/// The patterns by keyword.
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
    (Word::Pavement, block::pavement::new),
    (Word::Planar, geometric::planar::new),
    (Word::Potential, lookup::potential::new),
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

/// Default colour map of most patterns.
const GREY: [Stop; 2] = [
    (0.0, Color::opaque(Rgb::BLACK)),
    (1.0, Color::opaque(Rgb::WHITE)),
];

/// A pattern as a scene describes it.
pub trait Pattern: Debug + Send + Sync + ClonePattern {
    /// The pattern prepared for evaluation.
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval>;

    /// The default colour map. For a pattern with a list, entry `i` is at the value `i`.
    fn default_map(&self) -> &'static [Stop] {
        &GREY
    }

    /// The default wave.
    fn default_wave(&self) -> Wave {
        Wave::default()
    }

    /// True if the pattern selects from a list after its keyword, as `checker` does.
    fn has_list(&self) -> bool {
        false
    }

    /// True if `new` leaves a block of the pattern open, in which the list follows, as for `object`.
    fn has_open_block(&self) -> bool {
        false
    }

    /// True if `turbulence` displaces the point; otherwise the formula of the pattern uses it, and in 3.8 both.
    fn is_displaced(&self) -> bool {
        true
    }

    /// The numbers of samples along the axes, for patterns made of the samples of a file.
    fn sample_counts(&self) -> Option<DVec3> {
        None
    }

    /// Reads `word`, the next token, and its value if the pattern has such a parameter. Returns whether it has.
    ///
    /// # Errors
    /// A malformed value.
    fn read_modifier(&mut self, _word: Word, _args: &mut dyn Args) -> Parse<bool> {
        Ok(false)
    }

    /// Checks the parameters together, once all of them are read.
    ///
    /// # Errors
    /// Parameters that do not fit each other.
    fn check(&self, _args: &dyn Args) -> Parse<()> {
        Ok(())
    }
}

/// Evaluates a pattern.
pub trait PatternEval: Debug + Send + Sync {
    /// The value at a point of pattern space, before waves. For a pattern with a list, the index of an entry.
    fn value(&self, point: DVec3, spot: &SurfacePoint) -> f64;

    /// The values at four points of pattern space.
    fn values_x4(&self, points: &[DVec3; 4], spots: [&SurfacePoint; 4]) -> [f64; 4] {
        std::array::from_fn(|i| self.value(points[i], spots[i]))
    }

    /// Vector that a `normal` of height 1 adds to the unit normal at a point of pattern space; `None` for patterns
    /// whose values serve as a height field for bump mapping.
    fn tilt(&self, _point: DVec3) -> Option<DVec3> {
        None
    }

    /// True if the value depends on the surface normal.
    fn needs_normal(&self) -> bool {
        false
    }

    /// True if the value jumps where surfaces may lie, at whole coordinates or distances: rounding decides there.
    fn jumps(&self) -> bool {
        true
    }
}

/// The shading point, for patterns that need more than a point in pattern space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point in world space.
    pub point: DVec3,
    /// The unit surface normal on the side of the viewer; zero where there is no surface.
    pub normal: DVec3,
    /// The direction of the ray that hits the surface; zero where there is none.
    pub dir: DVec3,
    /// The texture coordinates for `uv_mapping`; zero where nothing needs them.
    pub uv: DVec2,
}

impl SurfacePoint {
    /// The point in pattern space under `uv_mapping`: (u, v, 0).
    #[must_use]
    pub fn uv_point(&self) -> DVec3 {
        self.uv.extend(0.0)
    }

    /// A point on no surface, without a viewing ray.
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

/// Global settings for the patterns of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The noise generator of patterns that set none.
    pub noise_generator: NoiseGenerator,
    /// Number of wave sources of `waves` and `ripples`.
    pub number_of_waves: u32,
    /// True for the rules of version 3.8: `turbulence` displaces the points of `marble` and `wood` besides entering
    /// their formulas, and the lens of a camera is jittered by other numbers.
    pub is_3_8: bool,
    /// Prepares an object for inside tests; without it every point is outside of all objects.
    pub solid_of: Option<SolidOf>,
}

/// Prepares an object, as [`Args`] reads it, for inside tests; `None` if the value is no object.
pub type SolidOf = fn(&Arc<dyn AnyObject + Send + Sync>) -> Option<Arc<dyn Solid>>;

/// An object with an inside test.
pub trait Solid: Debug + Send + Sync {
    /// Inside test for a point in the space around the object, before its own transforms are undone.
    fn contains(&self, point: DVec3) -> bool;
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            noise_generator: NoiseGenerator::default(),
            number_of_waves: 10,
            is_3_8: false,
            solid_of: None,
        }
    }
}

/// Modifiers and settings that a pattern may use in [`Pattern::prepare`].
#[derive(Debug)]
pub struct PrepareContext<'a> {
    /// The noise generator of the pattern.
    pub noise: NoiseGenerator,
    /// The amounts of `turbulence` along the axes; zero without it.
    pub turbulence: DVec3,
    /// The octaves of `turbulence`.
    pub octaves: Octaves,
    /// The wave that will shape the value.
    pub wave: Wave,
    /// The global settings.
    pub settings: &'a Settings,
}

/// Cloning of a boxed pattern; implemented for every pattern that is `Clone`.
pub trait ClonePattern {
    /// A boxed copy.
    fn clone_box(&self) -> Box<dyn Pattern>;
}

impl<T: Pattern + Clone + 'static> ClonePattern for T {
    fn clone_box(&self) -> Box<dyn Pattern> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Pattern> {
    fn clone(&self) -> Self {
        (**self).clone_box()
    }
}

/// Reads the pattern of this keyword with its parameters; `None`, with nothing read, if it is not implemented.
///
/// # Errors
/// A malformed parameter.
pub fn read_named(word: Word, args: &mut dyn Args) -> Parse<Option<Box<dyn Pattern>>> {
    let Some((_, new)) = PATTERNS.iter().find(|entry| entry.0 == word) else {
        return Ok(None);
    };
    args.accept(word)?;
    new(args).map(Some)
}

/// True for keywords of patterns of the language, implemented or not.
#[must_use]
pub fn is_pattern(word: Word) -> bool {
    // These keywords have a second meaning, under which the grammar lists them.
    const ELSEWHERE: [Word; 4] = [Word::Cubic, Word::Function, Word::Object, Word::Spherical];
    let is_parameter = matches!(word, Word::BumpMap | Word::Pattern | Word::Solid);
    ELSEWHERE.contains(&word) || (word.class() == Class::Pattern && !is_parameter)
}

/// The fractional part of `x`, in `[0, 1)`.
fn fraction(x: f64) -> f64 {
    x - floor(x)
}

/// The unit cell that contains a point; far out the indices saturate.
#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
#[inline]
fn cell(point: DVec3) -> [i64; 3] {
    point.to_array().map(|coordinate| floor(coordinate) as i64)
}
