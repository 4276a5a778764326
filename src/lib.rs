//! povr reads POV-Ray scene files and draws the picture POV-Ray 3.7 draws.
//!
//! ```text
//!  text ──syntax──▶ tokens ──lang──▶ scene ──compile──▶ world ──trace──▶ colour ──render──▶ film ──output──▶ files
//! ```

pub mod accel;
pub mod args;
pub mod color;
pub mod math;
pub mod shape;
pub mod source;
pub mod syntax;
