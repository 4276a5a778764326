//! Direct light: light samples, shadows and the fast path of opaque surfaces.

pub(super) mod area;
pub(super) mod block;
pub(super) mod block_hits;
pub(super) mod light;
mod materials;
pub(super) mod opaque;
pub(super) mod packet;
pub(super) mod shadow_cache;
pub(super) mod transmittance;
