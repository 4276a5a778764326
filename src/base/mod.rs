//! Foundations that know nothing of scenes: mathematics, colour, pictures, sources and settings.

pub mod accel;
pub mod args;
pub mod bitmap;
pub mod color;
pub mod encoding;
pub mod film;
pub mod math;
pub mod memory;
pub mod options;
pub mod source;
pub mod word;
