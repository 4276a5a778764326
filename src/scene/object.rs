//! Objects: a shape or a combination of objects, with what it carries.

use crate::interior::Interior;
use crate::light::Light;
use crate::math::{Bounds, Step, Transform};
use crate::shape::{Geometry, Shape};
use crate::texture::Texture;
use std::sync::Arc;

/// An object of a scene. Copies share their children.
#[derive(Clone, Debug)]
pub struct Object {
    /// What it is.
    pub kind: Kind,
    /// Its transforms in the order of the file.
    pub steps: Vec<Step>,
    /// Its texture, if it has one of its own.
    pub texture: Option<Attached<Arc<Texture>>>,
    /// The texture that is seen from inside.
    pub interior_texture: Option<Attached<Arc<Texture>>>,
    /// What fills it, if it says so itself.
    pub interior: Option<Arc<Interior>>,
    /// Its switches.
    pub flags: Flags,
    /// Whether inside and outside are exchanged.
    pub is_inverse: bool,
    /// `clipped_by`: the surface is kept where all of these hold it.
    pub clipped_by: Vec<Attached<Arc<Object>>>,
    /// `bounded_by`: rays that miss any of these miss the object.
    pub bounded_by: Vec<Attached<Arc<Object>>>,
}

/// Something that an object was given after its first `after` transforms, so that only the later ones move it.
#[derive(Clone, Debug)]
pub struct Attached<T> {
    /// The thing.
    pub what: T,
    /// How many steps of the object came before it.
    pub after: usize,
}

/// What an object is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A primitive.
    Shape(Arc<Shape>),
    /// A light, which is moved like an object and may stand inside a union.
    Light(Arc<Light>),
    /// A combination.
    Csg {
        /// How.
        operation: Operation,
        /// Of what, in the order of the file.
        children: Vec<Arc<Object>>,
    },
}

/// How objects are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// All surfaces of all children.
    Union,
    /// All surfaces that are not inside another child.
    Merge,
    /// The surfaces that are inside every other child.
    Intersection,
    /// The first child without the others.
    Difference,
}

/// The switches of an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// Casts no shadow.
    pub no_shadow: bool,
    /// Not seen by camera rays.
    pub no_image: bool,
    /// Not seen by reflected rays.
    pub no_reflection: bool,
    /// Does not displace the atmosphere; `None` takes the parent's.
    pub hollow: Option<bool>,
    /// Lit from both sides.
    pub double_illuminate: bool,
}

impl Object {
    /// A bare object.
    #[must_use]
    pub fn new(kind: Kind) -> Self {
        Object {
            kind,
            steps: Vec::new(),
            texture: None,
            interior_texture: None,
            interior: None,
            flags: Flags::default(),
            is_inverse: false,
            clipped_by: Vec::new(),
            bounded_by: Vec::new(),
        }
    }

    /// A box around the object, its clips taken into account, as POV-Ray gives it: a combination's box is turned as a
    /// box at each step, so it grows.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let whole = match &self.kind {
            _ if self.is_inverse => Bounds::EVERYTHING,
            Kind::Shape(shape) => moved(shape, &self.steps),
            Kind::Light(_) => Bounds::EMPTY,
            Kind::Csg {
                operation,
                children,
            } => turned(combined(*operation, children), &self.steps),
        };
        let clips = self.clipped_by.iter();
        clips.fold(whole, |bounds, clip| {
            bounds.intersection(&turned(clip.what.bounds(), &self.steps[clip.after..]))
        })
    }

    /// Gives the object something that only its later transforms move.
    #[must_use]
    pub fn attach<T>(&self, what: T) -> Attached<T> {
        Attached {
            what,
            after: self.steps.len(),
        }
    }
}

/// The box around a primitive that is moved: the steps it can take in itself leave no slack.
fn moved(shape: &Shape, steps: &[Step]) -> Bounds {
    let mut shape = shape.clone();
    let taken_in = steps.iter().take_while(|step| shape.absorb(step)).count();
    shape
        .bounds()
        .transformed(&Transform::from_steps(&steps[taken_in..]).world_from_object)
}

/// A box after each step in turn.
fn turned(bounds: Bounds, steps: &[Step]) -> Bounds {
    steps.iter().fold(bounds, |bounds, step| {
        bounds.transformed(&step.transform().world_from_object)
    })
}

fn combined(operation: Operation, children: &[Arc<Object>]) -> Bounds {
    let mut bounds = children.iter().map(|child| child.bounds());
    match operation {
        Operation::Union | Operation::Merge => {
            bounds.fold(Bounds::EMPTY, |sum, child| sum.union(&child))
        }
        Operation::Intersection => {
            bounds.fold(Bounds::EVERYTHING, |sum, child| sum.intersection(&child))
        }
        Operation::Difference => bounds.next().unwrap_or(Bounds::EMPTY),
    }
}
