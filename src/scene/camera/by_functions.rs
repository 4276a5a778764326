//! `user_defined`: rays whose origin and direction are functions of the image point; since version 3.8.
//!
//! The functions take `x` and `y` from -0.5 at the left and the bottom to 0.5. Where the functions of one of the two are
//! left out, it is that of the camera's frame. As in POV-Ray, transforms of the camera do not act on the functions.

use super::{Frame, Screen, Start};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::Transform;
use crate::scene::function::{self, Function};
use glam::DVec3;
use std::sync::Arc;

/// A function for each component of a vector.
type VectorFunction = [Arc<Function>; 3];

/// The functions of a camera.
#[derive(Clone, Debug)]
pub(super) struct CameraFunctions {
    location: Option<VectorFunction>,
    direction: Option<VectorFunction>,
    /// The change of the unit of length and of the origin by the program, not by the scene.
    transform: Transform,
}

impl Default for CameraFunctions {
    fn default() -> Self {
        CameraFunctions {
            location: None,
            direction: None,
            transform: Transform::IDENTITY,
        }
    }
}

impl PartialEq for CameraFunctions {
    /// Functions are equal if they share one value.
    fn eq(&self, other: &Self) -> bool {
        let is_same = |a: &Option<VectorFunction>, b: &Option<VectorFunction>| match (a, b) {
            (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b)),
            (a, b) => a.is_none() && b.is_none(),
        };
        is_same(&self.location, &other.location)
            && is_same(&self.direction, &other.direction)
            && self.transform == other.transform
    }
}

impl CameraFunctions {
    /// Reads `location { function { ... } ... }`, or that of `direction`; false, with nothing taken but the word, where
    /// no block follows.
    pub(super) fn read_item(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if !args.accept_mark('{')? {
            return Ok(false);
        }
        let mut one = || {
            if !args.accept(Word::Function)? {
                return Err(args.expected("`function`, one for each of x, y and z"));
            }
            let read = function::read_of_point(args);
            args.comma()?;
            read
        };
        let read = [one()?, one()?, one()?];
        args.close()?;
        match word {
            Word::Location => self.location = Some(read),
            _ => self.direction = Some(read),
        }
        Ok(true)
    }

    /// Applies a transform to all rays.
    pub(super) fn transform(&mut self, by: &Transform) {
        self.transform = self.transform.then(by);
    }

    /// The ray through a point of the image.
    pub(super) fn start(&self, frame: &Frame, screen: Screen) -> Start {
        let value = |functions: &VectorFunction| {
            let at = [screen.u, screen.v, 0.0];
            DVec3::from_array(functions.each_ref().map(|function| function.eval(&at)))
        };
        let to_world = &self.transform.world_from_object;
        let origin = self.location.as_ref().map(value);
        let dir = self.direction.as_ref().map(value);
        (
            origin.map_or(frame.location, |origin| to_world.transform_point3(origin)),
            dir.map_or(frame.direction, |dir| to_world.transform_vector3(dir)),
        )
    }
}
