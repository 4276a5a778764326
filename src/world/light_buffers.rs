//! Light buffers of the camera and the lights, built once: rays from there need no traversal. See [`LightBuffer`].

use crate::base::accel::LightBuffer;
use crate::base::options::RenderOptions;
use crate::scene::light::Light;
use crate::world::compiled::World;
use crate::world::model::Item;
use rayon::prelude::*;

/// Size of a pixel block: columns and rows.
const TOGETHER: [f64; 2] = [4.0, 2.0];

/// The light buffers of a world, where they pay off.
#[derive(Debug, Default)]
pub(crate) struct LightBuffers {
    pub(crate) camera: Option<LightBuffer>,
    /// By index of the light; empty if no light has one.
    lights: Vec<Option<LightBuffer>>,
}

impl LightBuffers {
    /// The light buffer of a light.
    #[inline(always)]
    pub(crate) fn of_light(&self, number: u32) -> Option<&LightBuffer> {
        self.lights.get(number as usize)?.as_ref()
    }

    /// Returns true if all of them were built.
    fn are_all_known(&self) -> bool {
        self.camera.is_some() && self.lights.iter().all(Option::is_some)
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let all = self.lights.iter().flatten().chain(&self.camera);
        all.map(LightBuffer::bytes).sum()
    }
}

impl World {
    /// Returns true if the camera and all lights have light buffers.
    #[must_use]
    pub fn has_all_light_buffers(&self) -> bool {
        self.light_buffers.are_all_known()
    }

    /// Returns true if camera rays between these slopes certainly hit nothing; slopes run across and up the picture
    /// from -0.5 to 0.5.
    #[must_use]
    pub fn is_background(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let camera = self.light_buffers.camera.as_ref();
        self.bvh().unbounded.is_empty()
            && camera.is_some_and(|light_buffer| light_buffer.is_empty(low, high))
    }

    /// Builds the light buffers of camera and lights, if the picture has enough pixels to make that pay off.
    pub(crate) fn build_light_buffers(&mut self, options: &RenderOptions) {
        let items = self.bvh().bounded.len() as u64;
        let pixels = u64::from(options.width) * u64::from(options.height);
        let points = 1 + self.lights.len() as u64;
        if !self.meshes.is_empty() || items == 0 || items.saturating_mul(points) > pixels {
            return;
        }
        let tree = &self.bvh().tree;
        let cylinder = |position: u32| match self.bvh().bounded[position as usize].item {
            Item::Leaf(leaf) => self.model.leaves[leaf as usize].bounding_cylinder(),
            Item::Program(_) | Item::Instance(_) => None,
        };
        let build = |point: u64| match point.checked_sub(1) {
            None => {
                let (axes, width, height) = (self.camera.axes()?, options.width, options.height);
                let [columns, rows] = TOGETHER;
                let together = [columns / f64::from(width), rows / f64::from(height)];
                LightBuffer::of_picture(tree, self.camera.location(), (axes, together), cylinder)
            }
            Some(light) => {
                let light = self.lights.get(u32::try_from(light).ok()?);
                is_point(light).then(|| LightBuffer::from_outside(tree, light.centre, cylinder))?
            }
        };
        let mut buffers: Vec<_> = (0..points).into_par_iter().map(build).collect();
        let lights = buffers.split_off(1);
        self.light_buffers = LightBuffers {
            camera: buffers.pop().flatten(),
            lights,
        };
    }
}

/// Returns true if all light of a light source comes from one point.
fn is_point(light: &Light) -> bool {
    light.area.is_none() && !light.is_parallel && !light.is_shadowless()
}
