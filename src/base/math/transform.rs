//! Transforms: a model matrix composed of elementary steps, stored with its inverse, which is the product of the
//! elementary inverses.
//!
//! Points are column vectors: `p' = M · p`. The step written first is applied first, so `then` multiplies from the
//! left. `rotate <a,b,c>` is Rz(c)·Ry(b)·Rx(a), angles in degrees. Only `matrix` is inverted numerically, because it
//! has no other inverse. With the others, coincident surfaces get the same bits whichever sequence of steps placed
//! them.

use glam::{DAffine3, DMat3, DVec3};
use std::cell::Cell;
use std::sync::Arc;

/// An affine transform from object to world space, with its inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Maps object space to world space.
    pub world_from_object: DAffine3,
    /// Maps world space to object space.
    pub object_from_world: DAffine3,
}

/// A transform as written in a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// `translate`.
    Translate(DVec3),
    /// `scale` per axis; no factor is zero.
    Scale(DVec3),
    /// `rotate`, degrees about x, then y, then z.
    Rotate(DVec3),
    /// `matrix` or `transform { ... }`: rare, and five times as large as the others.
    General(Arc<Transform>),
}

/// The number of steps of an object or texture at which they are merged into one.
const MAX_STEPS: usize = 1_000;

/// Merges the steps from `start` on into one if there are very many. A loop that rotates an object a little further
/// in each iteration copies all its steps each time, which takes quadratic time.
pub fn merge_steps(steps: &mut Vec<Step>, start: usize) {
    if steps.len() - start < MAX_STEPS {
        return;
    }
    let sum = steps
        .drain(start..)
        .fold(Transform::IDENTITY, |sum, step| sum.then(&step.transform()));
    steps.push(Step::General(Arc::new(sum)));
}

impl Transform {
    /// The identity.
    pub const IDENTITY: Transform = Transform {
        world_from_object: DAffine3::IDENTITY,
        object_from_world: DAffine3::IDENTITY,
    };

    /// A translation.
    #[must_use]
    pub fn translation(by: DVec3) -> Self {
        Transform {
            world_from_object: DAffine3::from_translation(by),
            object_from_world: DAffine3::from_translation(-by),
        }
    }

    /// A scaling per axis. No component may be zero.
    #[must_use]
    pub fn scaling(by: DVec3) -> Self {
        Transform {
            world_from_object: DAffine3::from_scale(by),
            object_from_world: DAffine3::from_scale(1.0 / by),
        }
    }

    /// A rotation about x, then y, then z, in degrees.
    #[must_use]
    pub fn rotation(degrees: DVec3) -> Self {
        Transform::orthogonal(rotation(degrees))
    }

    /// A rotation about an axis through the origin, in degrees.
    #[must_use]
    pub fn axis_rotation(axis: DVec3, degrees: f64) -> Self {
        Transform::orthogonal(axis_rotation(axis, degrees))
    }

    /// The transform of an orthogonal matrix, whose inverse is its transpose.
    fn orthogonal(matrix: DMat3) -> Self {
        Transform {
            world_from_object: DAffine3::from_mat3(matrix),
            object_from_world: DAffine3::from_mat3(matrix.transpose()),
        }
    }

    /// The transform of a general matrix; `None` if it is singular.
    #[must_use]
    pub fn matrix(world_from_object: DAffine3) -> Option<Self> {
        let det = world_from_object.matrix3.determinant();
        if det == 0.0 || !det.is_finite() {
            return None;
        }
        let object_from_world = world_from_object.inverse();
        object_from_world.is_finite().then_some(Transform {
            world_from_object,
            object_from_world,
        })
    }

    /// This transform followed by another.
    #[must_use]
    pub fn then(&self, next: &Transform) -> Self {
        Transform {
            world_from_object: next.world_from_object * self.world_from_object,
            object_from_world: self.object_from_world * next.object_from_world,
        }
    }

    /// The inverse transform.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Transform {
            world_from_object: self.object_from_world,
            object_from_world: self.world_from_object,
        }
    }

    /// The composition of all steps, the first one applied first.
    #[must_use]
    pub fn from_steps(steps: &[Step]) -> Self {
        steps
            .iter()
            .fold(Transform::IDENTITY, |sum, step| sum.then(&step.transform()))
    }

    /// The world-space normal of an object-space normal, by the inverse transpose; not normalised.
    #[must_use]
    pub fn normal(&self, object_normal: DVec3) -> DVec3 {
        normal_from_inverse(&self.object_from_world, object_normal)
    }
}

/// The world-space normal of an object-space normal, by the inverse transpose; not normalised.
#[must_use]
pub fn normal_from_inverse(object_from_world: &DAffine3, object_normal: DVec3) -> DVec3 {
    let rows = &object_from_world.matrix3;
    DVec3::new(
        rows.x_axis.dot(object_normal),
        rows.y_axis.dot(object_normal),
        rows.z_axis.dot(object_normal),
    )
}

impl Step {
    /// The step as a transform.
    #[must_use]
    pub fn transform(&self) -> Transform {
        match self {
            Step::Translate(by) => Transform::translation(*by),
            Step::Scale(by) => Transform::scaling(*by),
            Step::Rotate(degrees) => Transform::rotation(*degrees),
            Step::General(transform) => **transform,
        }
    }
}

/// The matrix of `rotate` for column vectors: Rz·Ry·Rx, angles in degrees. The last one of each thread is cached.
#[must_use]
pub fn rotation(degrees: DVec3) -> DMat3 {
    thread_local! {
        /// The last rotation: the parts of a CSG object often have the same one.
        static LAST: Cell<(DVec3, DMat3)> = const { Cell::new((DVec3::ZERO, DMat3::IDENTITY)) };
    }
    let (last, matrix) = LAST.get();
    // Compares bits: 0.0 and -0.0 give matrices with zeros of different sign.
    let bits = |degrees: DVec3| degrees.to_array().map(f64::to_bits);
    if bits(last) == bits(degrees) {
        return matrix;
    }
    let matrix = uncached_rotation(degrees);
    LAST.set((degrees, matrix));
    matrix
}

/// [`rotation`] without the cache.
fn uncached_rotation(degrees: DVec3) -> DMat3 {
    let (sx, cx) = degrees.x.to_radians().sin_cos();
    let (sy, cy) = degrees.y.to_radians().sin_cos();
    let (sz, cz) = degrees.z.to_radians().sin_cos();
    let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
    let about_y = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let about_z = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
    about_z * (about_y * about_x)
}

/// The matrix of a rotation by `degrees` about `axis` (Rodrigues' formula); the identity for a zero axis.
#[must_use]
pub fn axis_rotation(axis: DVec3, degrees: f64) -> DMat3 {
    let Some(k) = axis.try_normalize() else {
        return DMat3::IDENTITY;
    };
    let (s, c) = degrees.to_radians().sin_cos();
    let rotated = |v: DVec3| v * c + k.cross(v) * s + k * (k.dot(v) * (1.0 - c));
    DMat3::from_cols(rotated(DVec3::X), rotated(DVec3::Y), rotated(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-12
    }

    #[test]
    fn very_many_steps_become_one_equivalent_step() {
        let step = Step::Rotate(DVec3::new(0.0, 0.0, 0.36));
        let mut below_limit = vec![step.clone(); MAX_STEPS - 1];
        merge_steps(&mut below_limit, 0);
        assert_eq!(below_limit.len(), MAX_STEPS - 1);
        let mut at_limit = vec![Step::Scale(DVec3::splat(2.0))];
        at_limit.extend(vec![step; MAX_STEPS]);
        merge_steps(&mut at_limit, 1);
        assert_eq!(at_limit.len(), 2);
        let turned = at_limit[1].transform().world_from_object;
        assert!(close(turned.transform_point3(DVec3::X), DVec3::X));
    }

    #[test]
    fn rotate_turns_about_x_then_y_then_z() {
        // Printed by POV-Ray 3.7 for vrotate(<1,2,3>, <10,20,30>).
        let expected = DVec3::new(1.067_425_379_399, 2.289_059_482_621, 2.760_581_414_202);
        assert!(close(
            rotation(DVec3::new(10.0, 20.0, 30.0)) * DVec3::new(1.0, 2.0, 3.0),
            expected
        ));
    }

    #[test]
    fn axis_rotation_matches_vaxis_rotate() {
        let expected = DVec3::new(2.480_536_211_457, 0.519_463_788_543, 2.752_652_807_029);
        let turned = axis_rotation(DVec3::new(1.0, 1.0, 0.0), 40.0) * DVec3::new(1.0, 2.0, 3.0);
        assert!(close(turned, expected));
    }

    #[test]
    fn the_step_written_first_is_applied_first() {
        let steps = [Step::Scale(DVec3::splat(2.0)), Step::Translate(DVec3::X)];
        let transform = Transform::from_steps(&steps);
        assert_eq!(
            transform.world_from_object.transform_point3(DVec3::X),
            DVec3::new(3.0, 0.0, 0.0)
        );
        assert_eq!(
            transform
                .object_from_world
                .transform_point3(DVec3::new(3.0, 0.0, 0.0)),
            DVec3::X
        );
    }

    #[test]
    fn the_normal_of_a_scaled_circle_uses_the_inverse_transpose() {
        let squash = Transform::scaling(DVec3::new(2.0, 1.0, 1.0));
        assert_eq!(
            squash.normal(DVec3::new(1.0, 1.0, 0.0)),
            DVec3::new(0.5, 1.0, 0.0)
        );
    }

    #[test]
    fn a_singular_matrix_has_no_transform() {
        assert!(Transform::matrix(DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0))).is_none());
    }
}
