//! The warps: one file each. A warp takes a point to the point of pattern space whose value appears there.

mod black_hole;
mod cubic;
mod repeat;
mod turbulence;
mod wrap;

use super::Settings;
use crate::base::args::{Args, Parse, Word};
use glam::DVec3;
use std::fmt::Debug;
pub(super) use turbulence::Turbulence;

/// Reads the parameters after the keyword of a warp, up to the `}` of its block, which it leaves.
type Read = fn(&mut dyn Args) -> Parse<Box<dyn Warp>>;

/// The warps by keyword.
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
    /// The warp prepared for evaluation.
    fn prepare(&self, settings: &Settings) -> Box<dyn WarpEval>;
}

/// Evaluates a warp.
pub trait WarpEval: Debug + Send + Sync {
    /// The point in pattern space for a point before the warp.
    fn moved(&self, point: DVec3) -> DVec3;
}

/// Cloning of a boxed warp; implemented for every warp that is `Clone`.
pub trait CloneWarp {
    /// A boxed copy.
    fn clone_box(&self) -> Box<dyn Warp>;
}

impl<T: Warp + Clone + 'static> CloneWarp for T {
    fn clone_box(&self) -> Box<dyn Warp> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Warp> {
    fn clone(&self) -> Self {
        (**self).clone_box()
    }
}

/// Reads `warp { ... }`, keyword included.
pub(super) fn read(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    args.accept(Word::Warp)?;
    args.open()?;
    let Some(word) = args.word()? else {
        return Err(args.expected("a kind of `warp`"));
    };
    let Some((_, read)) = WARPS.iter().find(|entry| entry.0 == word) else {
        let error = args.expected("a kind of `warp`");
        return Err(match word {
            Word::Disc => Box::new(
                error
                    .with_hint("`warp { disc }` is of HG-POV, which POV-Ray does not read either."),
            ),
            _ => error,
        });
    };
    args.accept(word)?;
    let warp = read(args)?;
    args.close()?;
    Ok(warp)
}
