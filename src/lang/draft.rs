//! The scene as read so far, with the defaults for what follows.

use crate::base::color::Color;
use crate::base::options::ReadOptions;
use crate::base::source::Span;
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
    pub(super) default_layer: Layer,
    pub(super) default_texture: Arc<Texture>,
    pub(super) default_camera: Camera,
    pub(super) camera: Option<(Camera, Span)>,
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
        SceneDraft {
            version: options.version.unwrap_or(3.7),
            has_version: options.version.is_some(),
            default_layer: Layer::default(),
            default_texture: Arc::new(Texture::from(Layer::default())),
            default_camera: Camera::default(),
            camera: None,
            has_light: false,
            background: None,
            atmosphere: Atmosphere::default(),
            globals: Globals::default(),
            objects: Objects::default(),
        }
    }

    /// The version whose rules hold for lights and images at this point.
    pub(super) fn version_of_rules(&self) -> f64 {
        if self.has_version {
            self.version
        } else {
            VERSION_OF_SCENES_WITHOUT
        }
    }

    /// The scene, at the end of its text.
    pub(super) fn into_scene(self) -> Scene {
        let version = self.version_of_rules();
        Scene {
            camera: self
                .camera
                .map_or(self.default_camera, |(camera, _)| camera),
            objects: self.objects,
            background: Background {
                color: self.background,
            },
            atmosphere: self.atmosphere,
            globals: self.globals,
            version,
        }
    }
}
