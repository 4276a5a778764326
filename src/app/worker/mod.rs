//! Worker processes, which draw scenes for a command: a scene that brings its process down, by an abort, a limit or a
//! fault, does not end the command.
//!
//! A worker is this program again, called with the argument [`COMMAND`]. It reads requests from standard input, draws
//! one picture after the other, and writes replies to standard output, the encoded pictures among them, so that it needs
//! no permission to write files. When its standard input ends, which means that the
//! command has ended, it ends too. Linux continues it then in case it is stopped.
//!
//! A scene may have taken its worker over, so a command believes nothing: replies have a maximum length, files other than
//! those that the scene may read are ignored, and the number of pictures must be that of the request.

mod client;
#[cfg(test)]
mod fuzz;
mod wire;

pub use client::read_replies;
pub(crate) use client::{Control, Lost, Worker};
pub(crate) use wire::{
    CameraReport, Draw, LONGEST_PARTIAL, Limit, Live, LiveTask, LiveText, MapKind, MapReport,
    Patch, Picked, PickedSurface, PictureKey, Reply, Report, Request, Splice,
};

/// The first argument of a worker process.
pub(crate) const COMMAND: &str = "draw-for-parent";
