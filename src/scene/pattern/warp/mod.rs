//! The warps: one file each. A warp takes a point of the outside to the point of the pattern that shows there.

mod black_hole;
mod cubic;
mod repeat;
mod turbulence;
mod wrap;

use super::Settings;
use crate::base::args::{Args, Parse, Word};
use glam::DVec3;
use std::fmt::Debug;

/// Reads what stands behind the word of a warp, up to the `}` of its block, which it leaves.
type Read = fn(&mut dyn Args) -> Parse<Box<dyn Warp>>;

/// The warps by their words.
static WARPS: &[(Word, Read)] = &[
    (Word::BlackHole, black_hole::read),
    (Word::Cubic, cubic::read),
    (Word::Cylindrical, wrap::cylindrical),
    (Word::Planar, wrap::planar),
    (Word::Repeat, repeat::read),
    (Word::Spherical, wrap::spherical),
    (Word::Toroidal, wrap::toroidal),
    (Word::Turbulence, turbulence::read),
];

/// A warp as a scene describes it.
pub trait Warp: Debug + Send + Sync + CloneWarp {
    /// The form for drawing.
    fn prepare(&self, settings: &Settings) -> Box<dyn Warping>;
}

/// What moves points.
pub trait Warping: Debug + Send + Sync {
    /// The point of the pattern that shows at a point outside.
    fn moved(&self, point: DVec3) -> DVec3;
}

/// Copying behind a `Box`; every type that can be cloned has it.
pub trait CloneWarp {
    /// A copy that can be modified by itself.
    fn copied(&self) -> Box<dyn Warp>;
}

impl<T: Warp + Clone + 'static> CloneWarp for T {
    fn copied(&self) -> Box<dyn Warp> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Warp> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

/// Reads `warp { ... }`; the word is next.
pub(super) fn read(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    args.accept(Word::Warp)?;
    args.open()?;
    let Some(word) = args.word()? else {
        return Err(args.expected("a kind of `warp`"));
    };
    let Some((_, read)) = WARPS.iter().find(|entry| entry.0 == word) else {
        return Err(args.expected("a kind of `warp`"));
    };
    args.accept(word)?;
    let warp = read(args)?;
    args.close()?;
    Ok(warp)
}
