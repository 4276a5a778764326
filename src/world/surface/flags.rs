//! Surface properties that any ray may need, as single bits: the switches of the object, and properties of its
//! textures, which are stored elsewhere in memory.

use crate::scene::Importance;
use crate::scene::light::PhotonRole;
use crate::world::ray::RayKind;

/// The object switches that matter while tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ObjectFlags {
    /// Casts no shadow.
    pub(crate) no_shadow: bool,
    /// Not seen by camera rays and their straight or refracted continuations.
    pub(crate) no_image: bool,
    /// Not seen by reflected rays.
    pub(crate) no_reflection: bool,
    /// Invisible to radiosity sample rays.
    pub(crate) no_radiosity: bool,
    /// Share of the radiosity sample rays to it that count, if set.
    pub(crate) importance: Option<Importance>,
    /// Does not displace the atmosphere around it.
    pub(crate) hollow: bool,
    /// Lit from both sides.
    pub(crate) double_illuminate: bool,
    /// All its patterns are evaluated at texture coordinates.
    pub(crate) uv_mapping: bool,
    /// Its photon settings, if photons are on.
    pub(crate) photons: PhotonRole,
}

/// One bit per property.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SurfaceFlags(u32);

impl SurfaceFlags {
    pub(crate) const OPAQUE: u32 = 1;
    pub(crate) const TAKES_LIGHT: u32 = 1 << 1;
    pub(crate) const LIT_FROM_BEHIND: u32 = 1 << 2;
    pub(crate) const FRESNEL: u32 = 1 << 3;
    pub(crate) const PLAIN: u32 = 1 << 4;
    pub(crate) const NEARLY_PLAIN: u32 = 1 << 5;
    pub(crate) const BUMPY: u32 = 1 << 6;
    pub(crate) const GRAINY: u32 = 1 << 7;
    pub(crate) const USES_UV: u32 = 1 << 8;
    pub(crate) const FILTERS_EVENLY: u32 = 1 << 9;
    pub(crate) const NO_SHADOW: u32 = 1 << 10;
    pub(crate) const NO_IMAGE: u32 = 1 << 11;
    pub(crate) const NO_REFLECTION: u32 = 1 << 12;
    pub(crate) const NO_RADIOSITY: u32 = 1 << 13;
    pub(crate) const HOLLOW: u32 = 1 << 14;
    pub(crate) const DOUBLE_ILLUMINATE: u32 = 1 << 15;
    pub(crate) const UV_MAPPING: u32 = 1 << 16;
    pub(crate) const SUBSURFACE: u32 = 1 << 17;
    pub(crate) const PLAIN_FINISHES: u32 = 1 << 18;
    /// All its textures but the `interior_texture` end light.
    pub(crate) const OUTSIDE_ENDS_LIGHT: u32 = 1 << 19;
    /// It ends shadow rays: all its textures are opaque, or count as opaque in POV-Ray.
    pub(crate) const ENDS_LIGHT: u32 = 1 << 20;

    const HIDDEN: u32 = Self::NO_SHADOW | Self::NO_IMAGE | Self::NO_REFLECTION | Self::NO_RADIOSITY;

    /// The properties that hold, with the switches of the object.
    pub(crate) fn new(all: &[(u32, bool)], flags: &ObjectFlags) -> Self {
        let switches = [
            (Self::NO_SHADOW, flags.no_shadow),
            (Self::NO_IMAGE, flags.no_image),
            (Self::NO_REFLECTION, flags.no_reflection),
            (Self::NO_RADIOSITY, flags.no_radiosity),
            (Self::HOLLOW, flags.hollow),
            (Self::DOUBLE_ILLUMINATE, flags.double_illuminate),
            (Self::UV_MAPPING, flags.uv_mapping),
        ];
        let held = all.iter().chain(&switches).filter(|(_, holds)| *holds);
        SurfaceFlags(held.fold(0, |bits, (bit, _)| bits | bit))
    }

    /// Returns true if any of these bits is set.
    #[inline(always)]
    pub(crate) fn has(self, bits: u32) -> bool {
        self.0 & bits != 0
    }

    /// Returns true if some kinds of ray do not see the object.
    pub(crate) fn hides_from_some(self) -> bool {
        self.has(Self::HIDDEN)
    }

    /// Returns true if this kind of ray sees the object.
    #[inline]
    pub(crate) fn is_seen(self, kind: RayKind) -> bool {
        !self.has(match kind {
            RayKind::Camera => Self::NO_IMAGE,
            RayKind::Reflection => Self::NO_REFLECTION,
            RayKind::Radiosity => Self::NO_RADIOSITY,
            RayKind::RadiosityReflection => Self::NO_REFLECTION | Self::NO_RADIOSITY,
            RayKind::Shadow => Self::NO_SHADOW,
            RayKind::Photon => Self::NO_SHADOW | Self::NO_IMAGE,
            RayKind::PhotonReflection => Self::NO_SHADOW | Self::NO_REFLECTION,
            RayKind::Subsurface => 0,
        })
    }

    /// Makes the object visible to the camera.
    pub(crate) fn show(&mut self) {
        self.0 &= !Self::NO_IMAGE;
    }
}
