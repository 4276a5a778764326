//! Roots and normals of shapes with the rounding of POV-Ray (docs/povray-shapes.md, section 5.4): of a root that is
//! known to within rounding, the distance, the point and the normal to the last bit.
//!
//! A scene that goes on from what `trace` returns may raise differences in the last bit to the size of a picture.

use super::implicit::julia_fractal::ExactSearch;
use super::mesh::height_field::RoundedField;
use super::patch::triangle::turns_over;
use super::solid::axial::{APEX, BASE, SIDE};
use super::solid::cone::is_almost_cylinder;
use super::swept::rounded::RoundedSweep;
use super::{Cone, Cylinder, Disc, Quadric, Sphere, Triangle};
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Ray, Step, Transform, normal_from_inverse, rotation};
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

/// The axis of a cylinder that is closer than this to the z axis counts as it.
const TINY: f64 = 1e-10;

/// A shape with all its transforms, as POV-Ray stores it.
#[derive(Clone, Debug)]
pub struct Rounded {
    form: Form,
    normalization: Normalization,
}

/// The transforms of a shape, and the rounding of what is divided by a length.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a> {
    /// The transforms, in order.
    pub steps: &'a [Step],
    /// The rounding.
    pub normalization: Normalization,
}

impl Steps<'_> {
    fn rounded(&self, form: Form) -> Rounded {
        Rounded {
            form,
            normalization: self.normalization,
        }
    }
}

/// A hit with the rounding of POV-Ray.
#[derive(Clone, Copy, Debug)]
pub struct RoundedHit {
    /// Distance along the ray.
    pub t: f64,
    /// The point.
    pub point: DVec3,
    /// The unit normal, out of the solid.
    pub normal: DVec3,
}

#[derive(Clone, Debug)]
enum Form {
    Sphere(Sphere),
    /// A sphere that is transformed unevenly.
    Ellipsoid(Sphere, Box<Transform>),
    /// A cylinder of radius 1 from z = 0 to 1, or a cone with the radius z from `start` to 1.
    Axial {
        stored: Box<DAffine3>,
        start: f64,
        is_cone: bool,
        /// The face at z = 1.
        wide: u32,
    },
    /// The plane z = 0, with its normal in the world.
    Disc(Box<DAffine3>, DVec3),
    Triangle {
        normal: DVec3,
        distance: f64,
    },
    Quadric(Box<Quadratic>),
    Search(Box<ExactSearch>),
    Field(Box<RoundedField>),
    Sweep(Box<DAffine3>, Box<RoundedSweep>),
}

/// The coefficients of a quadric in the world: of `x²`, `y²`, `z²`, of `xy`, `xz`, `yz`, of `x`, `y`, `z`, and the constant.
#[derive(Clone, Debug)]
struct Quadratic {
    squares: DVec3,
    mixed: DVec3,
    linear: DVec3,
    constant: f64,
}

impl Rounded {
    /// A sphere with these steps.
    pub(super) fn of_sphere(sphere: Sphere, steps: &Steps<'_>) -> Self {
        steps.rounded(moved_sphere(sphere, steps.steps))
    }

    /// A cylinder with these steps.
    pub(super) fn of_cylinder(cylinder: &Cylinder, steps: &Steps<'_>) -> Self {
        let (first, second, radius) = cylinder.ends_and_radius();
        steps.rounded(axial_along(first, second, radius, steps))
    }

    /// A cone with these steps; `None` for an hourglass.
    pub(super) fn of_cone(cone: &Cone, steps: &Steps<'_>) -> Option<Self> {
        Some(steps.rounded(moved_cone(cone, steps)?))
    }

    /// A disc with these steps.
    pub(super) fn of_disc(disc: &Disc, steps: &Steps<'_>) -> Self {
        steps.rounded(moved_disc(disc, steps))
    }

    /// A triangle with these steps.
    pub(crate) fn of_triangle(triangle: &Triangle, steps: &Steps<'_>) -> Self {
        steps.rounded(moved_triangle(triangle, steps))
    }

    /// A quadric with these steps.
    pub(super) fn of_quadric(quadric: &Quadric, steps: &Steps<'_>) -> Self {
        steps.rounded(Form::Quadric(Box::new(moved_quadric(quadric, steps.steps))))
    }

    /// The search of a fractal.
    pub(super) fn of_search(search: ExactSearch, steps: &Steps<'_>) -> Self {
        steps.rounded(Form::Search(Box::new(search)))
    }

    /// The planes of a height field.
    pub(super) fn of_field(field: RoundedField, steps: &Steps<'_>) -> Self {
        steps.rounded(Form::Field(Box::new(field)))
    }

    /// A swept shape with these steps.
    pub(super) fn of_sweep(sweep: RoundedSweep, steps: &Steps<'_>) -> Self {
        let stored = with_steps(&Transform::IDENTITY, steps.steps);
        steps.rounded(Form::Sweep(stored, Box::new(sweep)))
    }

    /// True if its hits are those of another search, with their own normals.
    #[must_use]
    pub fn is_search(&self) -> bool {
        matches!(self.form, Form::Search(_))
    }

    /// The hit of a ray on a face near `t`; `None` in doubt.
    #[must_use]
    pub fn hit(&self, ray: &Ray, t: f64, face: u32) -> Option<RoundedHit> {
        let normalization = self.normalization;
        let hit = match &self.form {
            Form::Sphere(sphere) => sphere.rounded_hit(ray, t, normalization),
            Form::Ellipsoid(sphere, stored) => {
                let (local, length) = to_stored(ray, &stored.object_from_world, normalization);
                let local_t = sphere.rounded_root(&local, t * length);
                let forward = &stored.world_from_object;
                let point = forward.transform_point3(local.at(local_t));
                let back = &stored.object_from_world;
                let normal = stored.normal(back.transform_point3(point) - sphere.centre);
                let normal = normalization.unit(normal);
                let t = local_t / length;
                RoundedHit { t, point, normal }
            }
            Form::Axial {
                stored,
                start,
                is_cone,
                wide,
            } => {
                let (local, length) = to_stored(ray, stored, normalization);
                let end = |z: f64| (z - local.origin.z) / local.dir.z;
                let local_t = match face {
                    SIDE => side(&local, *is_cone, t * length),
                    face if face == *wide => end(1.0),
                    _ => end(*start),
                };
                let t = local_t / length;
                let point = ray.at(t);
                let normal = match face {
                    SIDE => {
                        let local = stored.transform_point3(point);
                        local.with_z(if *is_cone { -local.z } else { 0.0 })
                    }
                    face if face == *wide => DVec3::Z,
                    _ => -DVec3::Z,
                };
                RoundedHit {
                    t,
                    point,
                    normal: normalization.unit(normal_from_inverse(stored, normal)),
                }
            }
            Form::Disc(stored, normal) => {
                let (local, length) = to_stored(ray, stored, normalization);
                let t = -local.origin.z / local.dir.z / length;
                RoundedHit {
                    t,
                    point: ray.at(t),
                    normal: *normal,
                }
            }
            Form::Triangle { normal, distance } => {
                let t = -(distance + normal.dot(ray.origin)) / normal.dot(ray.dir);
                RoundedHit {
                    t,
                    point: ray.at(t),
                    normal: *normal,
                }
            }
            Form::Search(search) => search.hit(ray, t)?,
            Form::Field(field) => field.hit(ray, face)?,
            Form::Sweep(stored, sweep) => {
                let (local, length) = to_stored(ray, stored, normalization);
                let (t, normal) = sweep.hit(&local, length, t, face)?;
                RoundedHit {
                    t,
                    point: ray.at(t),
                    normal: normalization.unit(normal_from_inverse(stored, normal)),
                }
            }
            Form::Quadric(quadratic) => {
                let t = quadratic.root(ray, t);
                let point = ray.at(t);
                RoundedHit {
                    t,
                    point,
                    normal: normalization.unit(quadratic.gradient(point)),
                }
            }
        };
        (hit.point.is_finite() && hit.normal.is_finite()).then_some(hit)
    }
}

impl Quadratic {
    /// The root next to `t`.
    fn root(&self, ray: &Ray, t: f64) -> f64 {
        let Quadratic {
            squares: s,
            mixed: m,
            linear: l,
            constant,
        } = self;
        let (o, d) = (ray.origin, ray.dir);
        let a = d.x * (s.x * d.x + m.x * d.y + m.y * d.z)
            + d.y * (s.y * d.y + m.z * d.z)
            + d.z * s.z * d.z;
        let b = d.x * (s.x * o.x + 0.5 * (m.x * o.y + m.y * o.z + l.x))
            + d.y * (s.y * o.y + 0.5 * (m.x * o.x + m.z * o.z + l.y))
            + d.z * (s.z * o.z + 0.5 * (m.y * o.x + m.z * o.y + l.z));
        let c = o.x * (s.x * o.x + m.x * o.y + m.y * o.z + l.x)
            + o.y * (s.y * o.y + m.z * o.z + l.y)
            + o.z * (s.z * o.z + l.z)
            + constant;
        if a == 0.0 {
            return -0.5 * c / b;
        }
        let root = (b * b - a * c).sqrt();
        nearer([(-b + root) / a, (-b - root) / a], t)
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        let (s, m, l) = (self.squares, self.mixed, self.linear);
        DVec3::new(
            2.0 * s.x * p.x + m.x * p.y + m.y * p.z + l.x,
            m.x * p.x + 2.0 * s.y * p.y + m.z * p.z + l.y,
            m.y * p.x + m.z * p.y + 2.0 * s.z * p.z + l.z,
        )
    }
}

/// Of two roots the one next to `t`.
fn nearer(roots: [f64; 2], t: f64) -> f64 {
    let [first, second] = roots.map(|root| (root - t).abs());
    roots[usize::from(second < first)]
}

/// A ray in the space of a stored shape, with a direction of length 1, and the factor of distances there.
pub(super) fn to_stored(ray: &Ray, stored: &DAffine3, normalization: Normalization) -> (Ray, f64) {
    let local = ray.to_object(stored);
    let length = local.dir.length();
    let dir = normalization.divided(local.dir, length);
    (Ray::new(local.origin, dir), length)
}

/// The root next to `t` on the side of a cylinder of radius 1 along z, or of a cone of the radius z.
fn side(ray: &Ray, is_cone: bool, t: f64) -> f64 {
    let (p, d) = (ray.origin, ray.dir);
    let [mut a, mut b, mut c] = [
        d.x * d.x + d.y * d.y,
        p.x * d.x + p.y * d.y,
        p.x * p.x + p.y * p.y,
    ];
    if is_cone {
        a -= d.z * d.z;
        b -= d.z * p.z;
        c -= p.z * p.z;
        if a.abs() < TINY {
            return -0.5 * c / b;
        }
    } else {
        c -= 1.0;
    }
    let root = (b * b - a * c).sqrt();
    nearer([(-b - root) / a, (-b + root) / a], t)
}

fn moved_sphere(mut sphere: Sphere, steps: &[Step]) -> Form {
    let mut steps = steps.iter();
    while let Some(step) = steps.next() {
        match step {
            Step::Translate(by) => sphere.centre += *by,
            Step::Rotate(degrees) => sphere.centre = rotation(*degrees) * sphere.centre,
            Step::Scale(by) if by.x == by.y && by.y == by.z => {
                sphere.centre *= *by;
                sphere.radius *= by.x.abs();
            }
            Step::Scale(_) | Step::General(_) => {
                let rest = Transform::from_steps(std::slice::from_ref(step));
                let whole = steps.fold(rest, |sum, step| sum.then(&step.transform()));
                return Form::Ellipsoid(sphere, Box::new(whole));
            }
        }
    }
    Form::Sphere(sphere)
}

/// The transform from a space along z to one along a unit vector: scaling, rotation about an axis across z, translation.
fn along_axis(
    dir: DVec3,
    origin: DVec3,
    [radius, length]: [f64; 2],
    normalization: Normalization,
) -> Transform {
    let (axis, z) = if dir.z.abs() > 1.0 - TINY {
        (DVec3::X, dir.z.signum())
    } else {
        (normalization.unit(DVec3::new(-dir.y, dir.x, 0.0)), dir.z)
    };
    let (sin, cos) = z.acos().sin_cos();
    let (x, y) = (axis.x, axis.y);
    let xy = x * y * (1.0 - cos);
    // Zeros are added as in the general case, for their signs.
    let turn = DMat3::from_cols(
        DVec3::new(x * x + cos * (1.0 - x * x), xy + 0.0, 0.0 - y * sin),
        DVec3::new(xy - 0.0, y * y + cos * (1.0 - y * y), 0.0 + x * sin),
        DVec3::new(0.0 + y * sin, 0.0 - x * sin, cos),
    );
    let turn = Transform {
        world_from_object: DAffine3::from_mat3(turn),
        object_from_world: DAffine3::from_mat3(turn.transpose()),
    };
    Transform::scaling(DVec3::new(radius, radius, length))
        .then(&turn)
        .then(&Transform::translation(origin))
}

/// The inverse matrix of a space with further steps.
fn with_steps(stored: &Transform, steps: &[Step]) -> Box<DAffine3> {
    Box::new(steps.iter().fold(stored.object_from_world, |sum, step| {
        sum * step.transform().object_from_world
    }))
}

fn axial_along(first: DVec3, second: DVec3, radius: f64, steps: &Steps<'_>) -> Form {
    let axis = first - second;
    let length = axis.length();
    let normalization = steps.normalization;
    let dir = normalization.divided(axis, length);
    let stored = along_axis(dir, second, [radius, length], normalization);
    Form::Axial {
        stored: with_steps(&stored, steps.steps),
        start: 0.0,
        is_cone: false,
        wide: BASE,
    }
}

fn moved_cone(cone: &Cone, steps: &Steps<'_>) -> Option<Form> {
    let [(first, first_radius), (second, second_radius)] = cone.ends();
    if second_radius < 0.0 {
        return None;
    }
    if is_almost_cylinder(first_radius, second_radius) {
        return Some(axial_along(first, second, first_radius, steps));
    }
    let ((wide, radius), (narrow, other), face) = if first_radius < second_radius {
        ((second, second_radius), (first, first_radius), APEX)
    } else {
        ((first, first_radius), (second, second_radius), BASE)
    };
    let axis = wide - narrow;
    let length = axis.length();
    let normalization = steps.normalization;
    let dir = normalization.divided(axis, length);
    let beyond = other * length / (radius - other);
    let whole = length + beyond;
    let stored = along_axis(dir, narrow - dir * beyond, [radius, whole], normalization);
    Some(Form::Axial {
        stored: with_steps(&stored, steps.steps),
        start: beyond / whole,
        is_cone: true,
        wide: face,
    })
}

fn moved_disc(disc: &Disc, steps: &Steps<'_>) -> Form {
    let &Steps {
        steps,
        normalization,
    } = steps;
    let stored = along_axis(disc.normal, disc.centre, [1.0, 1.0], normalization);
    let mut normal = disc.normal;
    for step in steps {
        normal = normalization.unit(step.transform().normal(normal));
    }
    Form::Disc(with_steps(&stored, steps), normal)
}

/// A quadric is moved by products of 4 by 4 matrices with each step; what stands below the diagonal is then added to what
/// stands above.
fn moved_quadric(quadric: &Quadric, steps: &[Step]) -> Quadratic {
    let columns = &quadric.matrix;
    let mixed = DVec3::new(columns.y_axis.x, columns.z_axis.x, columns.z_axis.y);
    let mut sum = Quadratic {
        squares: DVec3::new(columns.x_axis.x, columns.y_axis.y, columns.z_axis.z),
        mixed: 2.0 * mixed,
        linear: quadric.linear,
        constant: quadric.constant,
    };
    for step in steps {
        let inverse = step.transform().object_from_world;
        let [x, y, z] = [0, 1, 2].map(|row| inverse.matrix3.col(row).extend(0.0));
        let back = DMat4::from_cols(x, y, z, inverse.translation.extend(1.0));
        let (s, m, l) = (sum.squares, sum.mixed, sum.linear);
        // Rows of the matrices of row vectors are columns here.
        let own = DMat4::from_cols(
            DVec4::new(s.x, m.x, m.y, l.x),
            DVec4::new(0.0, s.y, m.z, l.y),
            DVec4::new(0.0, 0.0, s.z, l.z),
            DVec4::new(0.0, 0.0, 0.0, sum.constant),
        );
        let [a, b, c, d] = (back.transpose() * (own * back)).to_cols_array_2d();
        sum = Quadratic {
            squares: DVec3::new(a[0], b[1], c[2]),
            mixed: DVec3::new(a[1] + b[0], a[2] + c[0], b[2] + c[1]),
            linear: DVec3::new(a[3] + d[0], b[3] + d[1], c[3] + d[2]),
            constant: d[3],
        };
    }
    sum
}

/// POV-Ray may exchange the first two corners whenever it computes the plane, so with each step.
fn moved_triangle(triangle: &Triangle, steps: &Steps<'_>) -> Form {
    let &Steps {
        steps,
        normalization,
    } = steps;
    let mut corners = triangle.corners;
    let mut normal = plane_of(&mut corners, normalization);
    for step in steps {
        corners = corners.map(|corner| match step {
            Step::Translate(by) => corner + *by,
            Step::Scale(by) => corner * *by,
            Step::Rotate(_) | Step::General(_) => {
                step.transform().world_from_object.transform_point3(corner)
            }
        });
        normal = plane_of(&mut corners, normalization);
    }
    Form::Triangle {
        normal: normal.0,
        distance: normal.1,
    }
}

/// The plane of three corners, the first two of which are exchanged where their projection turns the other way.
fn plane_of(corners: &mut [DVec3; 3], normalization: Normalization) -> (DVec3, f64) {
    let [a, b, c] = *corners;
    let normal = normalization.unit((a - b).cross(c - b));
    let distance = -normal.dot(a);
    if turns_over(corners, normal) {
        corners.swap(0, 1);
    }
    (normal, distance)
}
