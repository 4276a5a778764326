//! Patterns made of noise.

pub(super) mod agate;
pub(super) mod bozo;
pub(super) mod crackle;
pub(super) mod dents;
pub(super) mod granite;
pub(super) mod marble;
pub(super) mod ripples;
pub(super) mod wood;
pub(super) mod wrinkles;
