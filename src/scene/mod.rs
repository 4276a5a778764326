//! The hall: what a scene file says, as plain data. Reading fills it, drawing draws it; a Rust program can build it
//! without any file.

pub mod atmosphere;
pub mod camera;
mod default_texture;
mod extent;
pub mod function;
mod globals;
pub mod interior;
pub mod light;
mod moved;
mod object;
mod objects;
pub mod pattern;
mod scaled;
mod seen_in;
pub mod shape;
pub mod texture;

pub use extent::Stored;
pub use globals::{Charset, PhotonDensity, Photons, Radiosity, Subsurface};
pub use object::{
    Attached, Children, Flags, Importance, Kind, LightGroup, Object, Operation, Size,
};
pub(crate) use objects::{Colored, Entry, Taken};
pub use objects::{Look, Objects, Plain};

use crate::base::color::{Color, Gamma, Rgb};
use crate::base::math::noise::NoiseGenerator;
use crate::scene::atmosphere::Atmosphere;
use crate::scene::camera::Camera;
use crate::scene::pattern::Settings;
use glam::DVec3;

/// A whole scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera; the default one where the file has none.
    pub camera: Camera,
    /// The objects and lights in the order of the file.
    pub objects: Objects,
    /// The colour behind everything.
    pub background: Background,
    /// What fills the space between the objects, and the sky before the background.
    pub atmosphere: Atmosphere,
    /// What `global_settings` says.
    pub globals: Globals,
    /// The effective language version: the last `#version` of the run, or 3.62 where there is none.
    pub version: f64,
}

impl Default for Scene {
    /// An empty scene of version 3.7.
    fn default() -> Self {
        Scene {
            camera: Camera::default(),
            objects: Objects::default(),
            background: Background::default(),
            atmosphere: Atmosphere::default(),
            globals: Globals::default(),
            version: 3.7,
        }
    }
}

/// The colour of rays that hit nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// The colour; `None` where the file gives none: black, and fully transparent.
    pub color: Option<Color>,
}

/// Settings of the whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Globals {
    /// The working space; `None` where the file says nothing.
    pub assumed_gamma: Option<Gamma>,
    /// Below this weight a ray is not traced.
    pub adc_bailout: f64,
    /// How many generations of rays there are.
    pub max_trace_level: u32,
    /// The factor of every `ambient`.
    pub ambient_light: Rgb,
    /// How letters beyond ASCII in strings are read.
    pub charset: Charset,
    /// The wavelengths of red, green and blue for `irid`, in micrometres.
    pub irid_wavelength: Rgb,
    /// The length in which POV-Ray's own lengths count: how far away the sky is. 1 in a scene as it is written.
    pub unit: f64,
    /// Where the origin of the file's coordinates lies.
    pub origin: DVec3,
    /// How long the unit of the scene is, in millimetres.
    pub mm_per_unit: f64,
    /// Light that surfaces gather from each other, if the file asks for it.
    pub radiosity: Option<Radiosity>,
    /// How many of the rays that gather light and meet an object count where it does not say (`#default`).
    pub importance: Importance,
    /// How photons are shot, if the file says so.
    pub photons: Option<Photons>,
    /// How light in solids is sampled, if the file says so.
    pub subsurface: Option<Subsurface>,
    /// The noise of patterns that choose none; `None` where the file says nothing.
    pub noise_generator: Option<NoiseGenerator>,
    /// How many sources `waves` and `ripples` have.
    pub number_of_waves: u32,
}

/// The wavelengths for thin films in scenes that give none, in micrometres.
const IRID_WAVELENGTH: Rgb = Rgb::new(0.70, 0.52, 0.48);

impl Default for Globals {
    fn default() -> Self {
        Globals {
            assumed_gamma: None,
            adc_bailout: 1.0 / 255.0,
            max_trace_level: 5,
            ambient_light: Rgb::WHITE,
            charset: Charset::default(),
            irid_wavelength: IRID_WAVELENGTH,
            unit: 1.0,
            origin: DVec3::ZERO,
            mm_per_unit: 10.0,
            radiosity: None,
            importance: Importance::default(),
            photons: None,
            subsurface: None,
            noise_generator: None,
            number_of_waves: Settings::default().number_of_waves,
        }
    }
}

/// Before this version, scenes have the original noise.
const RANGE_CORRECTED_NOISE: f64 = 3.5;

impl Globals {
    /// What patterns take from the whole scene, in a language version.
    #[must_use]
    pub fn pattern_settings(&self, version: f64) -> Settings {
        let by_version = if version < RANGE_CORRECTED_NOISE {
            NoiseGenerator::Original
        } else {
            NoiseGenerator::RangeCorrected
        };
        Settings {
            noise_generator: self.noise_generator.unwrap_or(by_version),
            number_of_waves: self.number_of_waves,
            solid_of: None,
        }
    }
}

impl Scene {
    /// What patterns take from the whole scene.
    #[must_use]
    pub fn pattern_settings(&self) -> Settings {
        self.globals.pattern_settings(self.version)
    }

    /// How stored values relate to the numbers of the scene: `None` means that there is no gamma handling at all,
    /// as in old scenes that set neither `#version 3.7` nor `assumed_gamma`.
    #[must_use]
    pub fn working_gamma(&self) -> Option<Gamma> {
        match self.globals.assumed_gamma {
            Some(gamma) => Some(gamma),
            None if self.version >= 3.7 => Some(Gamma::LINEAR),
            None => None,
        }
    }
}
