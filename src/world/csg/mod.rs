//! CSG programs: evaluation along a ray, inside states, simplification and bounds.

pub(super) mod bounds;
pub(super) mod coincidence;
pub(super) mod inside;
pub(super) mod memo;
pub(super) mod packet_strategy;
pub(super) mod program;
pub(super) mod simplify;
pub(super) mod sweep;
