//! Light buffers of the camera and the lights, built once: rays from there need no traversal. See [`LightBuffer`].

use crate::base::accel::LightBuffer;
use crate::base::options::RenderOptions;
use crate::scene::light::Light;
use crate::world::compiled::World;
use crate::world::model::Item;
use rayon::prelude::*;

/// Pixels that lie together in a block: columns and rows.
const TOGETHER: [f64; 2] = [4.0, 2.0];

/// The light buffers of a world, where they pay.
#[derive(Debug, Default)]
pub(crate) struct LightBuffers {
    pub(crate) camera: Option<LightBuffer>,
    /// By the number of the light; empty if no light has one.
    lights: Vec<Option<LightBuffer>>,
}

impl LightBuffers {
    /// What the lamp of this number sees.
    #[inline(always)]
    pub(crate) fn of_light(&self, number: u32) -> Option<&LightBuffer> {
        self.lights.get(number as usize)?.as_ref()
    }

    /// Whether all is known that can be.
    fn are_all_known(&self) -> bool {
        self.camera.is_some() && self.lights.iter().all(Option::is_some)
    }

    /// The memory they take.
    pub(crate) fn bytes(&self) -> usize {
        let all = self.lights.iter().flatten().chain(&self.camera);
        all.map(LightBuffer::bytes).sum()
    }
}

impl World {
    /// Whether it is known what lies around the camera and all lamps.
    #[must_use]
    pub fn has_all_light_buffers(&self) -> bool {
        self.vistas.are_all_known()
    }

    /// Whether it is known that the camera meets nothing between these slopes, across and up the picture from -0.5 to 0.5.
    #[must_use]
    pub fn is_background(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let camera = self.vistas.camera.as_ref();
        self.finder().unbounded.is_empty() && camera.is_some_and(|vista| vista.is_empty(low, high))
    }

    /// Finds out what camera and lamps see, if the picture has so many pixels that this is worth while.
    pub(crate) fn build_light_buffers(&mut self, options: &RenderOptions) {
        let items = self.finder().bounded.len() as u64;
        let pixels = u64::from(options.width) * u64::from(options.height);
        let points = 1 + self.lights.len() as u64;
        if !self.meshes.is_empty() || items == 0 || items.saturating_mul(points) > pixels {
            return;
        }
        let tree = &self.finder().tree;
        let rod = |place: u32| match self.finder().bounded[place as usize].item {
            Item::Leaf(leaf) => self.model.leaves[leaf as usize].rod_around(),
            Item::Program(_) | Item::Instance(_) => None,
        };
        let look = |point: u64| match point.checked_sub(1) {
            None => {
                let (axes, width, height) = (self.camera.axes()?, options.width, options.height);
                let [columns, rows] = TOGETHER;
                let together = [columns / f64::from(width), rows / f64::from(height)];
                LightBuffer::of_picture(tree, self.camera.location(), (axes, together), rod)
            }
            Some(light) => {
                let light = self.lights.get(u32::try_from(light).ok()?);
                is_point(light).then(|| LightBuffer::from_outside(tree, light.centre, rod))?
            }
        };
        let mut vistas: Vec<_> = (0..points).into_par_iter().map(look).collect();
        let lights = vistas.split_off(1);
        self.vistas = LightBuffers {
            camera: vistas.pop().flatten(),
            lights,
        };
    }
}

/// Whether all light of a lamp comes from one point.
fn is_point(light: &Light) -> bool {
    light.area.is_none() && !light.is_parallel && !light.is_shadowless()
}
