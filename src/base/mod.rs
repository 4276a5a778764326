//! Foundations that do not depend on scenes: mathematics, acceleration structures, colour, pictures, source texts and
//! options.

pub mod accel;
pub mod args;
pub mod bitmap;
pub mod color;
pub(crate) mod derived;
pub mod encoding;
pub mod file;
pub mod film;
pub mod math;
pub mod memory;
pub(crate) mod nearest;
pub mod options;
pub mod source;
pub(crate) mod sync;
pub mod version;
pub mod word;
