//! povr reads POV-Ray scene files and draws the picture POV-Ray 3.7 draws.
//!
//! ```text
//!  text ──syntax──▶ tokens ──lang──▶ scene ──compile──▶ world ──trace──▶ colour ──render──▶ film ──output──▶ files
//! ```

pub mod args;
pub mod camera;
pub mod color;
pub mod compile;
pub mod interior;
pub mod light;
pub mod math;
pub mod pattern;
pub mod shape;
pub mod source;
pub mod syntax;
pub mod texture;
pub mod trace;
