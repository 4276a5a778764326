//! Photon tracing: emission, paths and photons in media.

pub(super) mod caustics;
pub(super) mod emission;
pub(super) mod path;
pub(super) mod volume;
