//! Many pictures in one run: frames of an animation, or scenes of whole folders.
//!
//! [`run()`] renders all pictures that are not up to date, several in parallel with the threads of one pool, so that one
//! large scene and a thousand small ones both use the whole machine. Each picture is written atomically and its inputs
//! are recorded in a log, so that a killed run continues where it stopped. An error in a scene ends that scene alone.

mod contact;
mod error;
mod find;
mod fingerprint;
mod journal;
mod message_buffer;
pub(crate) mod picture;
mod queue;
mod run;
mod shard;
mod sharing;

pub use contact::{Figure, pasted, write_index};
pub use error::BatchError;
pub use find::{Globs, scenes_below};
pub use message_buffer::MessageBuffer;
pub use picture::Picture;
pub use queue::in_order;
pub use run::{Batch, News, Outcome, Status, run};
pub use shard::Shard;
