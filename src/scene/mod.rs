//! Content of a scene file as plain data. The reader fills it and lowering consumes it; a Rust program can build it
//! without a file.

pub mod atmosphere;
pub mod camera;
mod default_texture;
mod extent;
mod field;
pub mod function;
mod globals;
pub mod interior;
pub mod light;
pub(crate) mod likeness;
mod object;
mod objects;
pub mod pattern;
pub(crate) mod restyled;
mod scaled;
pub mod shape;
pub mod texture;
mod translation;
mod visibility_box;

pub use extent::ExtentBox;
pub use field::ObjectField;
pub use globals::{Charset, PhotonDensity, Photons, RadiositySettings, Subsurface};
pub use object::{
    Attached, Children, Flags, Importance, Kind, LightGroup, Object, Operation, Size,
};
pub use objects::{ColorOrTexture, Objects, PlainObject};
pub(crate) use objects::{Colored, Entry, OwnedObject, SharedEntries};
pub(crate) use scaled::CameraLimit;

use crate::base::color::{Color, Gamma, Rgb};
use crate::base::encoding::Rounding;
use crate::base::math::noise::NoiseGenerator;
use crate::base::version::Novelty;
use crate::scene::atmosphere::Atmosphere;
use crate::scene::camera::Camera;
use crate::scene::function::RidgedCalls;
use crate::scene::pattern::Settings;
use glam::DVec3;
use std::sync::Arc;

/// A whole scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera; the default if the file has none.
    pub camera: Camera,
    /// The objects and lights, in file order.
    pub objects: Objects,
    /// The colour behind everything.
    pub background: Background,
    /// Fog and media between the objects, and the sky in front of the background.
    pub atmosphere: Atmosphere,
    /// The values of `global_settings`.
    pub globals: Globals,
    /// The effective language version: the last `#version` of the file, or 3.62 without any.
    pub version: f64,
    /// The novelties of version 3.8 in the scene, each once; the version alone if it asks for 3.8 without any.
    pub novelties: Vec<Novelty>,
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
            novelties: Vec::new(),
        }
    }
}

/// The colour of rays that hit nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// The colour; `None` if the file sets none: black and fully transparent.
    pub color: Option<Color>,
}

/// Settings of the whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Globals {
    /// True if the scene is for POV-Ray 3.8, by whose rules it is drawn then.
    pub is_for_3_8: bool,
    /// Gamma of the working space; `None` if the file does not set it.
    pub assumed_gamma: Option<Gamma>,
    /// Throughput below which a ray is not traced.
    pub adc_bailout: f64,
    /// Maximum recursion depth of rays.
    pub max_trace_level: u32,
    /// Factor of every `ambient`.
    pub ambient_light: Rgb,
    /// Interpretation of non-ASCII letters in strings.
    pub charset: Charset,
    /// The wavelengths of red, green and blue for `irid`, in micrometres.
    pub irid_wavelength: Rgb,
    /// Unit of the lengths that are built into POV-Ray, such as the distance of the sky. 1 in a scene as it is written.
    pub unit: f64,
    /// Position of the origin of the file's coordinates.
    pub origin: DVec3,
    /// Length of the scene's unit in millimetres.
    pub mm_per_unit: f64,
    /// Radiosity, if the file enables it.
    pub radiosity: Option<RadiositySettings>,
    /// Default importance of objects for irradiance rays (`#default`).
    pub importance: Importance,
    /// Photon mapping, if the file enables it.
    pub photons: Option<Photons>,
    /// Subsurface scattering, if the file enables it.
    pub subsurface: Option<Subsurface>,
    /// The noise generator of patterns that choose none; `None` if the file does not set it.
    pub noise_generator: Option<NoiseGenerator>,
    /// Number of sources of `waves` and `ripples`.
    pub number_of_waves: u32,
    /// The calls of `f_ridged_mf`.
    pub ridged_calls: Arc<RidgedCalls>,
}

/// Wavelengths for thin-film interference in scenes that set none, in micrometres.
const IRID_WAVELENGTH: Rgb = Rgb::new(0.70, 0.52, 0.48);

impl Default for Globals {
    fn default() -> Self {
        Globals {
            is_for_3_8: false,
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
            ridged_calls: Arc::default(),
        }
    }
}

/// Scenes before this version use the original noise.
const RANGE_CORRECTED_NOISE: f64 = 3.5;

impl Globals {
    /// Global settings of patterns, for a language version.
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
            is_3_8: self.is_for_3_8,
            solid_of: None,
        }
    }
}

impl Scene {
    /// Global settings of patterns.
    #[must_use]
    pub fn pattern_settings(&self) -> Settings {
        self.globals.pattern_settings(self.version)
    }

    /// The rule by which pixels are rounded to the levels of a file: in the working space from version 3.8 on.
    #[must_use]
    pub fn rounding(&self) -> Rounding {
        match self.globals.is_for_3_8 {
            true => Rounding::Working,
            false => Rounding::Encoded,
        }
    }

    /// Gamma of the working space. `None` means no gamma handling at all, as in old scenes that set neither `#version
    /// 3.7` nor `assumed_gamma`.
    #[must_use]
    pub fn working_gamma(&self) -> Option<Gamma> {
        match self.globals.assumed_gamma {
            Some(gamma) => Some(gamma),
            None if self.version >= 3.7 => Some(Gamma::LINEAR),
            None => None,
        }
    }
}
