//! Many pictures in one run, side by side.

mod queue;
mod told;

pub use queue::in_order;
pub use told::Told;
