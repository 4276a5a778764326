//! Settings of the whole scene that have blocks of their own, as the file gives them.

use std::sync::Arc;

/// Interpretation of non-ASCII letters in strings (`charset`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Charset {
    /// Each of their bytes is a space.
    #[default]
    Ascii,
    /// They are UTF-8.
    Utf8,
}

/// `radiosity { ... }`; the defaults are those of POV-Ray 3.7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiositySettings {
    /// Throughput below which no irradiance is queried.
    pub adc_bailout: f64,
    /// True if samples may be added during the final pass.
    pub always_sample: bool,
    /// Factor of all indirect light.
    pub brightness: f64,
    /// Rays per irradiance sample.
    pub count: u32,
    /// Number of directions from which the rays are chosen; `None` for POV-Ray's 1600.
    pub directions: Option<u32>,
    /// Error bound of sample reuse: a factor of the reuse distance.
    pub error_bound: f64,
    /// Desaturation of indirect light, 0 to 1.
    pub gray_threshold: f64,
    /// Factor of `error_bound` in the pretrace.
    pub low_error_factor: f64,
    /// Largest brightness of a single ray; negative for no limit.
    pub max_sample: f64,
    /// Largest reuse radius of a sample, as a fraction of the picture's width.
    pub maximum_reuse: f64,
    /// Smallest reuse radius, in the same unit.
    pub minimum_reuse: f64,
    /// True if the `brilliance` of a finish shapes its indirect light as it does direct light.
    pub has_brilliance: bool,
    /// True if sample rays include media.
    pub has_media: bool,
    /// True if samples use perturbed normals.
    pub has_normals: bool,
    /// True if sample rays include subsurface scattering.
    pub has_subsurface: bool,
    /// Number of samples interpolated at a point.
    pub nearest_count: u32,
    /// Number of samples for the adaptive pretrace; 0 disables it.
    pub nearest_count_aim: u32,
    /// Cell size of the first pretrace pass, as a fraction of the picture.
    pub pretrace_start: f64,
    /// Cell size of the last pretrace pass.
    pub pretrace_end: f64,
    /// Number of diffuse bounces.
    pub recursion_limit: u32,
}

impl Default for RadiositySettings {
    fn default() -> Self {
        RadiositySettings {
            adc_bailout: 0.01,
            always_sample: false,
            brightness: 1.0,
            count: 35,
            directions: None,
            error_bound: 1.8,
            gray_threshold: 0.0,
            low_error_factor: 0.5,
            max_sample: -1.0,
            maximum_reuse: 0.2,
            minimum_reuse: 0.015,
            has_brilliance: false,
            has_media: false,
            has_normals: false,
            has_subsurface: false,
            nearest_count: 5,
            nearest_count_aim: 0,
            pretrace_start: 0.08,
            pretrace_end: 0.04,
            recursion_limit: 2,
        }
    }
}

/// Density of emitted photons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotonDensity {
    /// Distance of neighbouring photons on the target.
    Spacing(f64),
    /// Approximate total number.
    Count(f64),
}

/// `photons { ... }` of the whole scene; the defaults are those of POV-Ray 3.7.
#[derive(Clone, Debug, PartialEq)]
pub struct Photons {
    /// The density.
    pub density: PhotonDensity,
    /// Smallest and largest number of photons gathered at a point.
    pub gather: [u32; 2],
    /// Jitter of directions, as a fraction of their spacing.
    pub jitter: f64,
    /// Fraction of the largest angle after which emission may stop.
    pub autostop: f64,
    /// Relative growth of the density below which the gather radius expands, and the number of photons below which it
    /// always expands.
    pub expand_thresholds: (f64, u32),
    /// Gather radius and its factor, on surfaces and in media; `None` for the radius that POV-Ray computes.
    pub radius: [(Option<f64>, f64); 2],
    /// Largest number of photons that a ray deposits in media, and the factor of their spacing.
    pub media: (u32, f64),
    /// Recursion depth of photon paths; `None` for that of rays.
    pub max_trace_level: Option<u32>,
    /// Throughput below which a photon path ends; `None` for that of rays.
    pub adc_bailout: Option<f64>,
    /// Content of a photon map file to use instead of emitting photons.
    pub load_file: Option<Arc<[u8]>>,
    /// Name of the file to which the photon maps are saved.
    pub save_file: Option<String>,
}

impl Default for Photons {
    fn default() -> Self {
        Photons {
            density: PhotonDensity::Spacing(1.0),
            gather: [20, 100],
            jitter: 0.4,
            autostop: 0.5,
            expand_thresholds: (0.2, 35),
            radius: [(None, 1.0); 2],
            media: (0, 1.0),
            max_trace_level: None,
            adc_bailout: None,
            load_file: None,
            save_file: None,
        }
    }
}

/// `subsurface { ... }` of the whole scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subsurface {
    /// Number of rays for diffuse and for single scattering.
    pub samples: [u32; 2],
    /// True if radiosity contributes.
    pub has_radiosity: bool,
}

impl Default for Subsurface {
    fn default() -> Self {
        Subsurface {
            samples: [50, 50],
            has_radiosity: false,
        }
    }
}
