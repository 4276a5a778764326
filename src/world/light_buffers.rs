//! Light buffers of the camera and the lights, built once: rays from there need no traversal. See [`LightBuffer`].

use crate::base::accel::LightBuffer;

/// The light buffers of a world, where they pay off.
#[derive(Debug, Default)]
pub(crate) struct LightBuffers {
    pub(crate) camera: Option<LightBuffer>,
    /// By index of the light; empty if no light has one.
    pub(crate) lights: Vec<Option<LightBuffer>>,
}

impl LightBuffers {
    /// The light buffer of a light.
    #[inline(always)]
    pub(crate) fn of_light(&self, number: u32) -> Option<&LightBuffer> {
        self.lights.get(number as usize)?.as_ref()
    }

    /// Returns true if all of them were built.
    pub(super) fn are_all_known(&self) -> bool {
        self.camera.is_some() && self.lights.iter().all(Option::is_some)
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let all = self.lights.iter().flatten().chain(&self.camera);
        all.map(LightBuffer::bytes).sum()
    }
}
