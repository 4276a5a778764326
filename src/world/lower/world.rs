//! Assembles the compiled world from what lowering has gathered.

use super::lowering::Lowering;
use crate::base::color::{Color, Rgb};
use crate::base::options::{RenderOptions, TMinRule};
use crate::scene::Scene;
use crate::scene::camera::Lens;
use crate::scene::shape::{Geometry, Rounded, Shape};
use crate::world::compiled::{Globals, World};
use crate::world::light_buffers::LightBuffers;
use crate::world::model::Model;
use crate::world::photons::PhotonMapping;
use crate::world::primitive::Leaf;
use crate::world::query::closest::POV_RAY_T_MAX;
use crate::world::surface::{Surface, SurfaceSummary};
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// With fewer objects and lights than this POV-Ray builds no tree, and ties are decided by file order.
const TREE_FROM: usize = 3;

/// The most other items for each CSG program with which streams are faster: packets of rays gain on programs, and on other
/// items lose the best order of traversal.
const STREAM_OTHERS: usize = 8;

/// Below this quality there is no radiosity (docs/povray-facts.md, section 4.11).
const QUALITY_OF_RADIOSITY: u8 = 9;

/// Below this quality subsurface light is drawn as ordinary diffuse light.
const QUALITY_OF_SUBSURFACE: u8 = 9;

impl World {
    /// The compiled scene, once all of its objects are added.
    pub(in crate::world) fn new(
        scene: &Scene,
        mut flat: Lowering,
        options: &RenderOptions,
    ) -> World {
        let has_tree = flat.parts.items.len() + flat.lights.len() >= TREE_FROM;
        if !has_tree {
            for program in &mut flat.parts.programs {
                program.gates.retain(|gate| !gate.needs_tree);
            }
        }
        let boxes = flat.parts.single_boxes();
        let povray_boxes = flat.parts.povray_boxes();
        let sends_rays = flat.surfaces.par_iter().any(Surface::sends_rays);
        let may_tie = sends_rays && flat.parts.has_flush_faces();
        let parts = std::mem::take(&mut flat.parts);
        let model = Model::new(parts, &mut flat.surfaces, flat.lights.projectors_mut());
        let transparent = Color {
            transmit: 1.0,
            ..Color::default()
        };
        let radiosity = scene.globals.radiosity;
        let radiosity = radiosity.filter(|_| options.quality >= QUALITY_OF_RADIOSITY);
        // From version 3.7 on, radiosity replaces `ambient`.
        let ambient_light = match radiosity {
            Some(_) if scene.version >= 3.7 => Rgb::BLACK,
            _ => scene.globals.ambient_light,
        };
        // A ray of radiosity that hits a plane farther away makes a sample, which shifts the directions of all after it.
        let t_max = match radiosity {
            Some(_) => POV_RAY_T_MAX * scene.globals.unit,
            None => f64::INFINITY,
        };
        let summary = SurfaceSummary::of(&flat.surfaces);
        let subsurface = scene.globals.subsurface;
        let subsurface = subsurface
            .filter(|_| summary.has_subsurface && options.quality >= QUALITY_OF_SUBSURFACE);
        let mut world = World {
            camera: scene.camera.prepared(&scene.pattern_settings()),
            lens: Lens::new(&scene.camera, &scene.pattern_settings()),
            background: scene.background.color.unwrap_or(transparent),
            sky: scene
                .atmosphere
                .sky_sphere
                .as_ref()
                .map(|sky| sky.prepare(&scene.pattern_settings(), scene.version >= 3.7)),
            media: scene
                .atmosphere
                .media
                .iter()
                .map(|media| media.prepare(&[], &scene.pattern_settings()))
                .collect(),
            fogs: scene
                .atmosphere
                .fogs
                .iter()
                .filter(|fog| fog.exists())
                .cloned()
                .collect(),
            rainbows: scene.atmosphere.rainbows.clone(),
            globals: Globals {
                noise: scene.pattern_settings().noise_generator,
                adc_bailout: scene.globals.adc_bailout,
                unit: scene.globals.unit,
                mm_per_unit: scene.globals.mm_per_unit / scene.globals.unit,
                origin: scene.globals.origin,
                max_trace_level: scene.globals.max_trace_level,
                importance: scene.globals.importance.share(),
                ambient_light,
                irid_wavelength: scene.globals.irid_wavelength,
                rules_37: scene.version >= 3.7,
                is_3_8: scene.globals.is_for_3_8,
                has_alpha: options.alpha,
                working_gamma: scene.working_gamma(),
                ridged_calls: Arc::clone(&scene.globals.ridged_calls),
            },
            ties_by_box: has_tree,
            least_distance: options.t_min_rule,
            t_max,
            summary,
            radiosity,
            subsurface,
            photons: flat
                .targets
                .and_then(|targets| PhotonMapping::new(scene, targets.into_list())),
            boxes,
            povray_boxes,
            slab_tree: OnceLock::new(),
            lights: flat.lights,
            surfaces: flat.surfaces,
            interiors: flat.interiors,
            model,
            meshes: Vec::new(),
            light_buffers: LightBuffers::default(),
            uses_packets: false,
            streams: false,
        };
        let has_povray_hits =
            |leaf: &Leaf| matches!(&leaf.shape, Shape::Sor(sor) if sor.has_povray_hits());
        let shows_sors = world.model.leaves.par_iter().any(has_povray_hits);
        let gathers = world.radiosity.is_some();
        // Not with subsurface light: 12 of its scenes differ more from POV-Ray then.
        if (world.draws_in_order(options) || shows_sors || gathers) && world.subsurface.is_none() {
            world.least_distance = TMinRule::PovRay;
        }
        if world.has_povray_distances() {
            world.t_max = POV_RAY_T_MAX * world.globals.unit;
            let summary = &world.summary;
            for leaf in &mut world.model.leaves {
                match &mut leaf.shape {
                    Shape::Mesh(mesh) => mesh.use_povray_planes(),
                    Shape::Sor(sor)
                        if summary.is_opaque || summary.ends_light[leaf.surface as usize] =>
                    {
                        sor.use_near_shadows();
                    }
                    _ => {}
                }
            }
        }
        let (suited, _) = world.packet_programs(&world.bvh().unbounded);
        world.uses_packets = suited > 0;
        let (suited, others) = world.packet_programs(&world.bvh().bounded);
        world.streams = suited > 0 && STREAM_OTHERS * suited >= others;
        world.meshes = world.large_meshes();
        world.model.rounding.normalization = world.globals.normalization();
        world.round_hits(flat.rounds, may_tie);
        world
    }

    /// Decides which hits get POV-Ray's rounding: where a pattern jumps, and where rays go on, to such textures or to faces
    /// that may coincide, if `may_tie`. `always` holds for the forms of all leaves.
    fn round_hits(&mut self, always: bool, may_tie: bool) {
        let surfaces = &self.surfaces;
        if (may_tie && !always) || surfaces.par_iter().any(Surface::has_jumps) {
            let is_wanted = |surface: u32| {
                let surface = surfaces.get(surface as usize);
                surface.is_some_and(|surface| surface.has_jumps() || surface.sends_rays())
            };
            self.model.round_leaves(is_wanted);
            return;
        }
        let forms = &mut self.model.rounding.forms;
        let are_searched = forms.values().any(Rounded::is_search);
        if !always && self.photons.is_none() {
            let leaves = &self.model.leaves;
            forms.retain(|&leaf, form| {
                form.is_search() || leaves[leaf as usize].shape.decides_ties()
            });
            forms.shrink_to_fit();
        }
        if are_searched {
            self.model.round_leaves(|_| false);
        }
    }
}
