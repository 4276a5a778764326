//! Features that `+Q` switches off.

/// Features switched off by a quality below 9 (`+Q`); measured with POV-Ray 3.7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quality {
    /// From 2 on: lighting. Below, the pigment of the lowest layer is the colour.
    pub(crate) has_light: bool,
    /// From 4 on: shadows.
    pub(crate) has_shadows: bool,
    /// From 5 on: area lights.
    pub(crate) has_area_lights: bool,
    /// From 6 on: the real pigments rather than `quick_color`, and transparency.
    pub(crate) has_transparency: bool,
    /// From 8 on: reflection.
    pub(crate) has_reflection: bool,
    /// From 8 on: bump mapping.
    pub(crate) has_normals: bool,
}

impl Quality {
    /// Every feature.
    pub(crate) const FULL: Quality = Quality {
        has_light: true,
        has_shadows: true,
        has_area_lights: true,
        has_transparency: true,
        has_reflection: true,
        has_normals: true,
    };

    /// The features of a quality (`+Q`).
    pub(crate) fn new(quality: u8) -> Quality {
        Quality {
            has_light: quality >= 2,
            has_shadows: quality >= 4,
            has_area_lights: quality >= 5,
            has_transparency: quality >= 6,
            has_reflection: quality >= 8,
            has_normals: quality >= 8,
        }
    }
}
