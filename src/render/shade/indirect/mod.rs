//! Indirect diffuse light: irradiance samples and their use in shading.

pub(super) mod irradiance;
pub(super) mod radiosity;
