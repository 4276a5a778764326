//! Many pictures in one run: frames of an animation, scenes of whole folders.
//!
//! [`run`] draws what is not up to date, several pictures side by side with the threads of one pool, so that one large
//! scene and a thousand small ones both fill the machine. A picture takes its place as a whole, and what it was made of
//! is noted in a log, so that a run that was killed goes on where it was. What a scene does wrong ends that scene alone.

mod contact;
mod error;
mod find;
mod fingerprint;
mod journal;
mod message_buffer;
mod queue;
mod run;
mod shard;
mod watchdog;

pub use contact::{Figure, escaped, page, pasted, write_index};
pub use error::BatchError;
pub use find::{Globs, scenes_below};
pub use message_buffer::MessageBuffer;
pub use queue::in_order;
pub use run::{Batch, News, Outcome, Picture, Status, run};
pub use shard::Shard;
