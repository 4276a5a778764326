//! Sets the camera of a world, and builds the light buffers of camera and lights.

use crate::base::accel::LightBuffer;
use crate::base::options::RenderOptions;
use crate::scene::camera::{Camera, Lens};
use crate::scene::light::Light;
use crate::scene::likeness::text_of;
use crate::scene::pattern::Settings;
use crate::world::compiled::World;
use rayon::prelude::*;

/// Size of a pixel block: columns and rows.
const TOGETHER: [f64; 2] = [4.0, 2.0];

impl World {
    /// Sets the camera for pictures of a size; `settings` are the scene-wide settings of patterns.
    pub(crate) fn set_camera(
        &mut self,
        camera: &Camera,
        settings: &Settings,
        options: &RenderOptions,
    ) {
        self.camera = camera.prepared(settings);
        self.lens = Lens::new(camera, settings);
        let size = (options.width, options.height);
        let view = text_of(camera).map(|camera| format!("{camera} {size:?}"));
        if !self.light_buffers.turn_to(view) {
            self.build_light_buffers(options);
        }
    }

    /// Builds the light buffers of camera and lights, if the picture has enough pixels to make that pay off. Those of
    /// lights stay, as they are the same for any picture.
    pub(crate) fn build_light_buffers(&mut self, options: &RenderOptions) {
        self.light_buffers.camera = None;
        let items = self.bvh().bounded.len() as u64;
        let pixels = u64::from(options.width) * u64::from(options.height);
        let points = 1 + self.lights.len() as u64;
        if !self.meshes.is_empty() || items == 0 || items.saturating_mul(points) > pixels {
            return;
        }
        let tree = &self.bvh().tree;
        let item = |position: u32| self.bvh().bounded[position as usize].item;
        let cylinder = |position: u32| self.model.bounding_cylinder(item(position));
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
        let new = match self.light_buffers.lights.is_empty() {
            true => points,
            false => 1,
        };
        let mut buffers: Vec<_> = (0..new).into_par_iter().map(build).collect();
        let lights = buffers.split_off(1);
        self.light_buffers.camera = buffers.pop().flatten();
        self.light_buffers.lights.extend(lights);
    }
}

/// Returns true if all light of a light source comes from one point.
fn is_point(light: &Light) -> bool {
    light.area.is_none() && !light.is_parallel && !light.is_shadowless()
}
