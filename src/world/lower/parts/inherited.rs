//! Attributes that an object hands down to its children.

use crate::base::math::{Step, Transform};
use crate::scene::Object;
use crate::scene::texture::Texture;
use crate::world::interiors::InteriorId;
use crate::world::lights::LightList;
use crate::world::surface::cutaway::Cutaway;
use crate::world::surface::flags::ObjectFlags;
use std::sync::Arc;

/// Attributes that an object hands down to its children.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inherited {
    pub(crate) texture: Option<TransformedTexture>,
    pub(crate) inside_texture: Option<TransformedTexture>,
    pub(crate) interior: Option<InteriorId>,
    pub(crate) flags: ObjectFlags,
    /// Within a CSG object, the visibility switches that take effect.
    pub(crate) obeyed: Option<ObjectFlags>,
    /// The role of the children in a CSG object.
    pub(crate) role: CsgRole,
    /// The lights that shine on it.
    pub(crate) lights: LightList,
    /// If in a light group, true if lights outside the group shine on it too.
    pub(crate) global_lights: Option<bool>,
    /// If the object is a light group, the list to which its lights are added.
    pub(crate) group: Option<LightList>,
    /// True if the object itself says `uv_mapping`.
    pub(crate) says_uv: bool,
    /// The photon target's factor on spacings, if the union above is a target whose parts are targets of their own.
    pub(crate) split_target: Option<f64>,
    /// The transforms of all ancestors, innermost first.
    pub(crate) steps: Arc<[Step]>,
    /// True if a union above was transformed after its parts were complete: then no `seen_in` boxes apply to shapes.
    pub(crate) is_moved: bool,
    /// The texture source of parts without a texture, in a CSG object with `cutaway_textures`.
    pub(crate) cutaway: Option<Arc<Cutaway>>,
    /// In a shared model, the material slot; the other attributes except the transforms are unknown then.
    pub(crate) slot: u32,
}

/// Role of an object in CSG. POV-Ray applies the switches `no_shadow`, `no_image` and `no_reflection` of a CSG object
/// to the whole; within it, `no_reflection` takes effect for the parts of unions and merges, and `no_image` for those
/// of merges (measured for each switch in twelve arrangements). Not reproduced: POV-Ray then also shows the surfaces of
/// other parts of the merge inside the hidden one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum CsgRole {
    /// Outside CSG.
    #[default]
    Alone,
    /// The CSG object as a whole.
    Whole,
    /// A part of an intersection or difference.
    Cut,
    /// A part of a union that is not split up.
    Union,
    /// A part of a merge.
    Merge,
}

/// A texture and the transforms applied after it.
#[derive(Clone, Debug)]
pub(crate) struct TransformedTexture {
    pub(crate) texture: Arc<Texture>,
    pub(crate) steps: Arc<[Step]>,
}

impl Inherited {
    /// Returns true if the texture has a finish that changes the interior, which then every part does that inherits it.
    pub(crate) fn has_interior_finish(&self) -> bool {
        let texture = self.texture.as_ref();
        texture.is_some_and(|above| above.texture.has_interior_finish())
    }

    /// Returns true if some attribute needs texture coordinates.
    pub(crate) fn uses_uv(&self) -> bool {
        let textures = [&self.texture, &self.inside_texture];
        let mut textures = textures.into_iter().flatten();
        self.flags.uv_mapping || textures.any(|transformed| transformed.texture.uses_uv())
    }

    /// Returns true if both give the same surface, whatever their transforms. With `hides_interior` interiors not
    /// written in the scene do not matter.
    pub(crate) fn is_same_material(&self, other: &Inherited, hides_interior: bool) -> bool {
        let is_unnamed = |one: &Inherited| one.interior.is_none_or(InteriorId::is_unnamed);
        let same = |one: &Option<TransformedTexture>, other: &Option<TransformedTexture>| match (
            one, other,
        ) {
            (None, None) => true,
            (Some(one), Some(other)) => {
                Arc::ptr_eq(&one.texture, &other.texture) && !one.texture.depends_on_position()
            }
            _ => false,
        };
        same(&self.texture, &other.texture)
            && same(&self.inside_texture, &other.inside_texture)
            && (self.interior == other.interior
                || hides_interior && is_unnamed(self) && is_unnamed(other))
            && self.flags == other.flags
            && self.obeyed == other.obeyed
            && self.lights == other.lights
    }
}

/// The switches of an object, combined with those it inherits.
pub(crate) fn handed_down(object: &Object, above: &Inherited) -> ObjectFlags {
    let (own, above) = (&object.flags, &above.flags);
    ObjectFlags {
        no_shadow: own.no_shadow || above.no_shadow,
        no_image: own.no_image || above.no_image,
        no_reflection: own.no_reflection || above.no_reflection,
        no_radiosity: own.no_radiosity || above.no_radiosity,
        importance: own.importance.or(above.importance),
        hollow: own.hollow.unwrap_or(above.hollow),
        double_illuminate: own.double_illuminate || above.double_illuminate,
        uv_mapping: own.uv_mapping || above.uv_mapping,
        photons: above.photons,
    }
}

/// The visibility switches that take effect for an object.
pub(crate) fn obeyed(flags: &ObjectFlags, above: &Inherited) -> Option<ObjectFlags> {
    let is_merged = above.role == CsgRole::Merge;
    let is_united = is_merged || above.role == CsgRole::Union;
    match (above.role, &above.obeyed) {
        (CsgRole::Alone, _) => None,
        (CsgRole::Whole, _) | (_, None) => Some(*flags),
        (_, Some(whole)) => Some(ObjectFlags {
            no_image: whole.no_image || is_merged && flags.no_image,
            no_reflection: whole.no_reflection || is_united && flags.no_reflection,
            no_radiosity: whole.no_radiosity || is_united && flags.no_radiosity,
            ..*whole
        }),
    }
}

/// Longer lists of inherited steps are combined into one matrix, so that deeply nested objects do not each store the
/// steps of all ancestors. No hand-written scene comes near.
pub(crate) const MAX_STEPS: usize = 250;

/// The steps of an object, then those of its ancestors.
pub(crate) fn joined(own: &[Step], above: &Arc<[Step]>) -> Arc<[Step]> {
    if own.is_empty() {
        return Arc::clone(above);
    }
    if above.len() > MAX_STEPS {
        let one = Step::General(Arc::new(Transform::from_steps(above)));
        return own.iter().cloned().chain([one]).collect();
    }
    own.iter().chain(above.iter()).cloned().collect()
}
