//! The scene as read so far, with the defaults for what follows.

use crate::base::color::Color;
use crate::base::options::ReadOptions;
use crate::base::source::Span;
use crate::base::version::{Novelty, has_defaults_of_3_8};
use crate::scene::atmosphere::Atmosphere;
use crate::scene::camera::Camera;
use crate::scene::texture::{Layer, Texture};
use crate::scene::{Background, Globals, Objects, Scene};
use std::sync::Arc;

/// The effective version of scenes without any `#version` (docs/povray-facts.md, section 3.1).
const VERSION_OF_SCENES_WITHOUT: f64 = 3.62;

/// The parts of a scene that were read, and the `#default` of textures and cameras.
#[derive(Debug)]
pub(super) struct SceneDraft {
    pub(super) version: f64,
    pub(super) has_version: bool,
    /// The novelties of version 3.8 read so far, each once.
    pub(super) novelties: Vec<Novelty>,
    /// True once a `#default` was read: a later `#version` leaves the defaults alone.
    pub(super) has_default: bool,
    /// Width over height of the image, for pixels as wide as high.
    aspect: f64,
    pub(super) default_layer: Layer,
    pub(super) default_texture: Arc<Texture>,
    pub(super) default_camera: Camera,
    /// The camera, with its keyword and its whole statement.
    pub(super) camera: Option<(Camera, [Span; 2])>,
    /// True once a light source was read.
    pub(super) has_light: bool,
    pub(super) background: Option<Color>,
    pub(super) atmosphere: Atmosphere,
    pub(super) globals: Globals,
    pub(super) objects: Objects,
}

impl SceneDraft {
    /// An empty scene.
    pub(super) fn new(options: &ReadOptions) -> SceneDraft {
        let mut draft = SceneDraft {
            version: options.version.unwrap_or(3.7),
            has_version: options.version.is_some(),
            novelties: Vec::new(),
            has_default: false,
            aspect: f64::from(options.width) / f64::from(options.height),
            default_layer: Layer::default(),
            default_texture: Arc::new(Texture::from(Layer::default())),
            default_camera: Camera::default(),
            camera: None,
            has_light: false,
            background: None,
            atmosphere: Atmosphere::default(),
            globals: Globals::default(),
            objects: Objects::default(),
        };
        draft.set_stock_defaults();
        draft
    }

    /// Sets the defaults of the version in force.
    pub(super) fn set_stock_defaults(&mut self) {
        let is_3_8 = has_defaults_of_3_8(self.version);
        self.default_layer = match is_3_8 {
            true => Layer::of_3_8(),
            false => Layer::default(),
        };
        self.default_texture = Arc::new(Texture::from(self.default_layer.clone()));
        self.default_camera = match is_3_8 {
            true => Camera::with_aspect(self.aspect),
            false => Camera::default(),
        };
    }

    /// True if no `#default` has changed the camera.
    pub(super) fn has_stock_camera(&self) -> bool {
        let camera = &self.default_camera;
        *camera == Camera::default() || *camera == Camera::with_aspect(self.aspect)
    }

    /// The version whose rules hold for lights and images at this point.
    pub(super) fn version_of_rules(&self) -> f64 {
        if self.has_version {
            self.version
        } else {
            VERSION_OF_SCENES_WITHOUT
        }
    }

    /// Notes that the scene has something which POV-Ray 3.7 lacks.
    pub(super) fn note_novelty(&mut self, novelty: Novelty) {
        if !self.novelties.contains(&novelty) {
            self.novelties.push(novelty);
        }
    }

    /// The scene, at the end of its text.
    pub(super) fn into_scene(mut self) -> Scene {
        let version = self.version_of_rules();
        if self.novelties.is_empty() && self.globals.is_for_3_8 {
            self.novelties.push(Novelty::Version);
        }
        // Without any camera the aspect ratio plays no part in version 3.8 either.
        let camera_of_none = match self.has_stock_camera() {
            true => Camera::default(),
            false => self.default_camera,
        };
        Scene {
            camera: self.camera.map_or(camera_of_none, |(camera, _)| camera),
            objects: self.objects,
            background: Background {
                color: self.background,
            },
            atmosphere: self.atmosphere,
            globals: self.globals,
            version,
            novelties: self.novelties,
        }
    }
}
