//! Light buffers of the camera and the lights, built once: rays from there need no traversal. See [`LightBuffer`].

use crate::base::accel::LightBuffer;

/// The light buffers of a world, where they pay off.
#[derive(Debug, Default)]
pub(crate) struct LightBuffers {
    pub(crate) camera: Option<LightBuffer>,
    /// The camera and the size of the picture that it is for, as a text.
    view: Option<String>,
    /// That of the picture before, with its view: previews and pictures alternate.
    other: Option<(String, Option<LightBuffer>)>,
    /// By index of the light; empty if no light has one.
    pub(crate) lights: Vec<Option<LightBuffer>>,
}

impl LightBuffers {
    /// Turns to the pictures of a camera and a size. Returns false if the light buffer of the camera has to be built.
    pub(crate) fn turn_to(&mut self, view: Option<String>) -> bool {
        if view.is_some() && view == self.view {
            return true;
        }
        let known = self.other.take();
        let last = std::mem::replace(&mut self.view, view);
        let camera = self.camera.take();
        self.other = last.map(|view| (view, camera));
        match known.filter(|(view, _)| self.view.as_ref() == Some(view)) {
            Some((_, camera)) => {
                self.camera = camera;
                true
            }
            None => false,
        }
    }

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
