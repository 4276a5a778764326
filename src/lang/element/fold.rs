//! Transformations of an object and its texture, folded into one.

use crate::base::math::merge_steps;
use crate::scene::texture::{Layer, Texture};
use crate::scene::{Attached, Object};
use std::sync::Arc;

/// Folds a long list of steps into one, as far as they follow the last attached texture or clip object.
pub(crate) fn fold_steps(object: &mut Object) {
    let start = object.fixed_steps();
    merge_steps(&mut object.steps, start);
}

/// Gives an object a texture of its own if it has none.
pub(crate) fn own_texture(object: &mut Object, default: &Layer) {
    if object.texture.is_none() {
        let texture = Texture::from(default.clone());
        object.texture = Some(object.attach(Arc::new(texture)));
    }
}

/// The texture of an object that has one, for changes; the steps so far are applied to it first.
pub(crate) fn baked(object: &mut Object) -> &mut Texture {
    let steps = std::mem::take(&mut object.steps);
    let plain = || Attached {
        what: Arc::new(Texture::from(Layer::default())),
        after: 0,
    };
    let attached = object.texture.get_or_insert_with(plain);
    let texture = Arc::make_mut(&mut attached.what);
    if !object.flags.uv_mapping {
        let moved = steps[attached.after..].iter();
        moved.for_each(|step| texture.transform(step));
    }
    attached.after = steps.len();
    object.steps = steps;
    texture
}
