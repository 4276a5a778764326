//! What objects hand down to what they hold: texture, interior, switches, lights, and where they stand.

use super::cutaway::Cutaway;
use super::flatten::{Lowering, index};
use crate::base::math::{Step, Transform};
use crate::scene::shape::{FaceTexture, Geometry, Shape};
use crate::scene::texture::{Layer, Texture};
use crate::scene::{Attached, Object};
use crate::world::interiors::InteriorId;
use crate::world::lights::LightList;
use crate::world::primitive::Absorb;
use crate::world::surface::{ObjectSpaceShape, OwnedOrShared, Surface};
use crate::world::surface_flags::ObjectFlags;
use std::borrow::Cow;
use std::sync::Arc;

/// What an object hands down to its children.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inherited {
    pub(crate) texture: Option<PlacedTexture>,
    pub(crate) inside_texture: Option<PlacedTexture>,
    pub(crate) interior: Option<InteriorId>,
    pub(crate) flags: ObjectFlags,
    /// In a combination, the switches that say who sees it.
    pub(crate) obeyed: Option<ObjectFlags>,
    /// Where the children are.
    pub(crate) place: CsgRole,
    /// The lights that shine on it.
    pub(crate) lights: LightList,
    /// Whether lights outside of the light group around it do so; `None` outside of all groups.
    pub(crate) global_lights: Option<bool>,
    /// The list of the light group that it is, which takes in its own lights.
    pub(crate) group: Option<LightList>,
    /// Whether the object itself says `uv_mapping`.
    pub(crate) says_uv: bool,
    /// The transforms of everything above, innermost first.
    pub(crate) steps: Arc<[Step]>,
    /// True if a union above was moved after its parts were complete, so that shapes are not seen within boxes.
    pub(crate) is_moved: bool,
    /// Where what has no texture takes one from, in a combination with `cutaway_textures`.
    pub(crate) cutaway: Option<Arc<Cutaway>>,
    /// In a model that copies share, which of its looks these are; the rest but the steps is unknown then.
    pub(crate) slot: u32,
}

/// Where an object stands as to combinations. POV-Ray obeys the switches `no_shadow`, `no_image` and `no_reflection` of
/// a combination as a whole; within it `no_reflection` counts for the parts of unions and merges, and `no_image` for
/// those of merges (measured for each switch in twelve arrangements). That POV-Ray then also shows what of the other
/// parts of the merge lies in the hidden one is not done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum CsgRole {
    /// In no combination.
    #[default]
    Alone,
    /// It is a combination as a whole.
    Whole,
    /// A part of an intersection or difference.
    Cut,
    /// A part of a union that is not taken apart.
    Union,
    /// A part of a merge.
    Merge,
}

/// A texture with the transforms that came after it.
#[derive(Clone, Debug)]
pub(crate) struct PlacedTexture {
    pub(crate) texture: Arc<Texture>,
    pub(crate) steps: Arc<[Step]>,
}

impl Inherited {
    /// Whether what inherits it asks for texture coordinates.
    pub(crate) fn uses_uv(&self) -> bool {
        let textures = [&self.texture, &self.inside_texture];
        let mut textures = textures.into_iter().flatten();
        self.flags.uv_mapping || textures.any(|placed| placed.texture.uses_uv())
    }

    /// Whether what inherits the one looks like what inherits the other, wherever the two stand. `is_opaque`: all that
    /// inherits them is, so that interiors which no scene has written are alike.
    pub(crate) fn looks_as(&self, other: &Inherited, is_opaque: bool) -> bool {
        let is_unnamed = |one: &Inherited| one.interior.is_none_or(InteriorId::is_unnamed);
        let same = |one: &Option<PlacedTexture>, other: &Option<PlacedTexture>| match (one, other) {
            (None, None) => true,
            (Some(one), Some(other)) => {
                Arc::ptr_eq(&one.texture, &other.texture) && !one.texture.depends_on_place()
            }
            _ => false,
        };
        same(&self.texture, &other.texture)
            && same(&self.inside_texture, &other.inside_texture)
            && (self.interior == other.interior
                || is_opaque && is_unnamed(self) && is_unnamed(other))
            && self.flags == other.flags
            && self.obeyed == other.obeyed
            && self.lights == other.lights
    }
}

impl Lowering {
    /// [`Lowering::heritage`] of a part of a combination. Most say nothing but what they are: in intersections and differences
    /// it is then that of the combination, as far as it counts.
    pub(crate) fn heritage_of_part<'h>(
        &mut self,
        object: &Object,
        above: &'h Inherited,
    ) -> Cow<'h, Inherited> {
        let is_known = above.place == CsgRole::Cut
            && above.obeyed.is_some()
            && above.group.is_none()
            && !above.says_uv
            && self.slots.is_none()
            && self.targets.is_none();
        match above.interior {
            Some(interior) if is_known && object.is_plain_part() => {
                self.interiors.set_hollow(interior, above.flags.hollow);
                Cow::Borrowed(above)
            }
            _ => Cow::Owned(self.heritage(object, above)),
        }
    }

    /// What an object's children, or the object itself if it is a shape, look like and where they stand.
    pub(crate) fn heritage(&mut self, object: &Object, above: &Inherited) -> Inherited {
        if let Some(slots) = &mut self.slots {
            return Inherited {
                slot: slots.object(object, above),
                steps: joined(&object.steps, &above.steps),
                flags: handed_down(object, above),
                is_moved: above.is_moved || object.moves_parts(),
                ..Inherited::default()
            };
        }
        let place =
            |own: Option<&Attached<Arc<Texture>>>, inherited: &Option<PlacedTexture>| match own {
                Some(own) => Some(PlacedTexture {
                    texture: Arc::clone(&own.what),
                    steps: texture_steps(object, own.after, above),
                }),
                None => inherited.clone(),
            };
        let layers = object
            .texture
            .as_ref()
            .map_or(&[][..], |own| own.what.layers());
        let finishes = layers.iter().map(|layer| &*layer.finish);
        let interior = self
            .interiors
            .of_object(object.interior.as_ref(), above.interior, finishes);
        self.fill(interior, object, above);
        let mut flags = handed_down(object, above);
        if let Some(targets) = &mut self.targets {
            flags.photons = targets.role(object, above);
        }
        self.interiors.set_hollow(interior, flags.hollow);
        let global_lights = object.light_group.map_or(above.global_lights, |group| {
            Some(above.global_lights.unwrap_or(group.global_lights))
        });
        let group = object
            .light_group
            .map(|_| self.lights.group(global_lights.unwrap_or(true)));
        Inherited {
            lights: group.unwrap_or(above.lights),
            global_lights,
            group,
            texture: place(object.texture.as_ref(), &above.texture),
            inside_texture: place(object.interior_texture(), &above.inside_texture),
            interior: Some(interior),
            flags,
            obeyed: obeyed(&flags, above),
            place: CsgRole::Alone,
            says_uv: object.flags.uv_mapping,
            steps: joined(&object.steps, &above.steps),
            is_moved: above.is_moved || object.moves_parts(),
            cutaway: above.cutaway.clone(),
            slot: 0,
        }
    }

    /// Makes the media of an object's interior ready.
    fn fill(&mut self, interior: InteriorId, object: &Object, above: &Inherited) {
        match &object.interior {
            Some(own) if !own.media.is_empty() => {
                let steps = joined(&object.steps, &above.steps);
                let media = own.media.iter();
                let media = media.map(|media| media.prepare(&steps, &self.settings));
                self.interiors.fill(interior, media.collect());
            }
            Some(_) => {}
            None => self.interiors.hand_down(above.interior, interior),
        }
    }

    /// The number of the surface of a shape with these looks, and whether the shape has to stay as it is, all its
    /// transforms outside of it.
    pub(crate) fn surface_of(&mut self, shape: &Shape, looks: &Inherited) -> (u32, Absorb) {
        let loses_uv = shape.loses_uv() && !looks.steps.is_empty();
        if let Some(slots) = &mut self.slots {
            let absorb = if loses_uv && self.keeps_uv {
                Absorb::Nothing
            } else {
                Absorb::AllItCan
            };
            return (slots.shape(looks, shape.skins()), absorb);
        }
        // POV-Ray moves the textures of the components of blobs in any case.
        let moves_skins = looks.says_uv && matches!(shape, Shape::Blob(_));
        let skins_moved = moves_skins.then(|| Inherited {
            says_uv: false,
            ..looks.clone()
        });
        let looks = skins_moved.as_ref().unwrap_or(looks);
        if let Some(last) = self.looks_as_last(shape, looks) {
            return (last, Absorb::AllItCan);
        }
        let mut surface = self.new_surface(looks, shape.skins());
        if loses_uv && surface.uses_uv() {
            surface.set_unmoved(ObjectSpaceShape::new(shape, &looks.steps));
        }
        let number = self.number_of(surface);
        self.last_looks = Some((number, looks.clone()));
        (number, Absorb::AllItCan)
    }

    /// The last surface, if that of a shape with these looks would be the same: so it is with the parts of a combination.
    fn looks_as_last(&self, shape: &Shape, looks: &Inherited) -> Option<u32> {
        let (number, last) = self.last_looks.as_ref()?;
        let surface = &self.surfaces[*number as usize];
        let is_same = self.last_surface == Some(*number)
            && shape.skins().is_empty()
            && surface.skins().is_empty()
            && looks.cutaway.is_none()
            && !surface.uses_uv()
            && looks.looks_as(last, surface.is_opaque());
        is_same.then_some(*number)
    }

    /// The number of a surface. Neighbours in the file often share theirs.
    pub(crate) fn number_of(&mut self, surface: Surface) -> u32 {
        if let Some(last) = self
            .last_surface
            .filter(|&last| self.surfaces[last as usize].is_same(&surface))
        {
            return last;
        }
        let number = index(self.surfaces.len());
        self.surfaces.push(surface);
        self.last_surface = Some(number);
        number
    }

    /// A surface with these looks.
    pub(crate) fn new_surface(&mut self, looks: &Inherited, skins: &[FaceTexture]) -> Surface {
        let texture = match &looks.texture {
            Some(placed) => self.prepare(placed),
            None => {
                let fresh = || Texture::from(Layer::default()).prepare(&[], &self.settings);
                let plain = self.plain.get_or_insert_with(|| Arc::new(fresh()));
                OwnedOrShared::Shared(Arc::clone(plain))
            }
        };
        let inside_texture = looks
            .inside_texture
            .as_ref()
            .map(|placed| self.prepare(placed).shared());
        let skin = |skin: &FaceTexture| {
            let steps = if looks.says_uv {
                Arc::default()
            } else {
                Arc::clone(&looks.steps)
            };
            let texture = Arc::clone(&skin.0);
            self.prepare(&PlacedTexture { texture, steps }).shared()
        };
        let lent = looks.cutaway.as_ref();
        let lent = lent.filter(|_| looks.texture.is_none() && skins.is_empty());
        let skins = match lent {
            Some(cutaway) => cutaway.textures().iter().cloned().collect(),
            None => skins.iter().map(skin).collect(),
        };
        let interior = looks.interior.unwrap_or(InteriorId::AIR);
        let flags = looks
            .obeyed
            .as_ref()
            .map_or(looks.flags, |obeyed| ObjectFlags {
                no_shadow: obeyed.no_shadow,
                no_image: obeyed.no_image,
                no_reflection: obeyed.no_reflection,
                no_radiosity: obeyed.no_radiosity,
                ..looks.flags
            });
        let lit = (looks.lights, flags);
        let mut surface = Surface::new(texture, inside_texture, skins, interior, lit);
        if let Some(cutaway) = lent {
            surface.set_cutaway(Arc::clone(cutaway));
        }
        surface
    }

    /// A texture ready for points of the world. One without patterns is prepared once, wherever it is used.
    pub(crate) fn prepare(&mut self, placed: &PlacedTexture) -> OwnedOrShared {
        if placed.texture.depends_on_place() {
            return OwnedOrShared::Own(placed.texture.prepare(&placed.steps, &self.settings));
        }
        // The object has it and hands it down; whoever shares it makes more.
        if Arc::strong_count(&placed.texture) <= 2 {
            return OwnedOrShared::Own(placed.texture.prepare(&[], &self.settings));
        }
        let key = Arc::as_ptr(&placed.texture).addr();
        if let Some((_, known)) = self.prepared.get(&key) {
            return OwnedOrShared::Shared(Arc::clone(known));
        }
        let fresh = Arc::new(placed.texture.prepare(&[], &self.settings));
        let kept = (Arc::clone(&placed.texture), Arc::clone(&fresh));
        self.prepared.insert(key, kept);
        self.lately_prepared.push(key);
        OwnedOrShared::Shared(fresh)
    }
}

/// The transforms of a texture that an object has been given after its first `after` steps. Texture coordinates stay
/// where they are: the transforms of an object that says `uv_mapping` itself do not move its texture. Those of what hands
/// it down do (checked with POV-Ray, which tells the parts when the whole is complete).
pub(crate) fn texture_steps(object: &Object, after: usize, above: &Inherited) -> Arc<[Step]> {
    if object.flags.uv_mapping {
        return Arc::default();
    }
    joined(&object.steps[after..], &above.steps)
}

/// The switches of an object and of what hands them down to it.
fn handed_down(object: &Object, above: &Inherited) -> ObjectFlags {
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

/// Which of its switches an object obeys.
fn obeyed(flags: &ObjectFlags, above: &Inherited) -> Option<ObjectFlags> {
    let is_merged = above.place == CsgRole::Merge;
    let is_united = is_merged || above.place == CsgRole::Union;
    match (above.place, &above.obeyed) {
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

/// With more steps above than this they are made one, so that objects in objects in objects do not each keep the steps
/// of all around them. No scene written by hand comes near.
const KEPT_STEPS: usize = 250;

/// The steps of an object, then those of everything above it.
pub(crate) fn joined(own: &[Step], above: &Arc<[Step]>) -> Arc<[Step]> {
    if own.is_empty() {
        return Arc::clone(above);
    }
    if above.len() > KEPT_STEPS {
        let one = Step::General(Arc::new(Transform::from_steps(above)));
        return own.iter().cloned().chain([one]).collect();
    }
    own.iter().chain(above.iter()).cloned().collect()
}
