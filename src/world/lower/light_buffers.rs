//! Builds the light buffers of the camera and the lights.

use crate::base::accel::LightBuffer;
use crate::base::options::RenderOptions;
use crate::scene::light::Light;
use crate::world::compiled::World;
use crate::world::light_buffers::LightBuffers;
use crate::world::model::Item;
use rayon::prelude::*;

/// Size of a pixel block: columns and rows.
const TOGETHER: [f64; 2] = [4.0, 2.0];

impl World {
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
                LightBuffer::for_camera(tree, self.camera.location(), (axes, together), cylinder)
            }
            Some(light) => {
                let light = self.lights.get(u32::try_from(light).ok()?);
                is_point(light).then(|| LightBuffer::for_light(tree, light.centre, cylinder))?
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
