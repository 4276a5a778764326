//! Settings of the whole scene that are blocks of their own, as the file gives them. Subsurface light is not drawn yet.

use std::sync::Arc;

/// How letters beyond ASCII in strings are read (`charset`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Charset {
    /// Each of their bytes is a blank.
    #[default]
    Ascii,
    /// As they are.
    Utf8,
}

/// `radiosity { ... }`; the defaults are those of POV-Ray 3.7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radiosity {
    /// Below this weight no radiosity is asked for.
    pub adc_bailout: f64,
    /// Whether the last pass adds samples wherever there are too few.
    pub always_sample: bool,
    /// The factor of all gathered light.
    pub brightness: f64,
    /// How many rays a sample shoots.
    pub count: u32,
    /// From how many directions those are chosen; `None` for POV-Ray's 1600.
    pub directions: Option<u32>,
    /// How far a sample may be used, as a factor.
    pub error_bound: f64,
    /// How much gathered light is turned to grey, 0 to 1.
    pub gray_threshold: f64,
    /// The factor of `error_bound` in the pretrace.
    pub low_error_factor: f64,
    /// The most light that one ray brings; negative for no limit.
    pub max_sample: f64,
    /// The largest radius in which a sample is used, as a share of the picture's width.
    pub maximum_reuse: f64,
    /// The smallest such radius.
    pub minimum_reuse: f64,
    /// Whether rays see media.
    pub has_media: bool,
    /// Whether normal patterns count.
    pub has_normals: bool,
    /// Whether rays see subsurface light.
    pub has_subsurface: bool,
    /// How many samples are mixed at a point.
    pub nearest_count: u32,
    /// How many when the pretrace goes on by itself; 0 for no such pretrace.
    pub nearest_count_aim: u32,
    /// Size of the cells of the first pass, as a share of the picture.
    pub pretrace_start: f64,
    /// Size of the cells of the last pass.
    pub pretrace_end: f64,
    /// How often light is gathered from gathered light.
    pub recursion_limit: u32,
}

impl Default for Radiosity {
    fn default() -> Self {
        Radiosity {
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

/// How dense photons are shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotonDensity {
    /// The distance of neighbours on the target.
    Spacing(f64),
    /// About so many in all.
    Count(f64),
}

/// `photons { ... }` of the whole scene; the defaults are those of POV-Ray 3.7.
#[derive(Clone, Debug, PartialEq)]
pub struct Photons {
    /// How many there are.
    pub density: PhotonDensity,
    /// The fewest and the most that are gathered at a point.
    pub gather: [u32; 2],
    /// How far directions are moved, as a share of their distance.
    pub jitter: f64,
    /// The share of the largest angle at which shooting may stop.
    pub autostop: f64,
    /// By how much more photons the radius may grow, and up to how many.
    pub expand_thresholds: (f64, u32),
    /// The radius of gathering and its factor, on surfaces and in media; `None` for what POV-Ray works out.
    pub radius: [(Option<f64>, f64); 2],
    /// The most photons left in media by one ray, and the factor of their spacing.
    pub media: (u32, f64),
    /// How many generations of photons there are; `None` for as many as of rays.
    pub max_trace_level: Option<u32>,
    /// Below this weight a photon ends; `None` for the weight of rays.
    pub adc_bailout: Option<f64>,
    /// A file with photons to take instead of shooting any.
    pub load_file: Option<Arc<[u8]>>,
    /// A file to put them into.
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
    /// How many rays are shot for diffuse light, and for light that is scattered once.
    pub samples: [u32; 2],
    /// Whether radiosity counts.
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
