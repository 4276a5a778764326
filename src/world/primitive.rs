//! A shape in its place: in the world's own coordinates where it can be, otherwise behind an inverse matrix.

use crate::base::accel::BoundingCylinder;
use crate::base::math::conditioning::unit;
use crate::base::math::{Bounds, Ray, Step, Transform, normal_from_inverse};
use crate::scene::shape::{Geometry, Root, Shape, Sphere, Start, TextureWeights};
use glam::{DAffine3, DMat3, DVec3};

/// More than the roundings of what is worked out from a matrix, as a share.
const CARE: f64 = 1e-9;

/// Which bounds of a shape are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Of what can be seen.
    Surface,
    /// Of all that lies inside.
    Solid,
}

/// How much of its transforms a shape takes into its own numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absorb {
    /// As many as leave it of its kind.
    AllItCan,
    /// None: its texture coordinates are asked for.
    Nothing,
}

impl Extent {
    fn of(self, shape: &Shape) -> Bounds {
        match self {
            Extent::Surface => shape.bounds(),
            Extent::Solid => shape.solid_bounds(),
        }
    }
}

/// A prepared primitive.
#[derive(Clone, Debug)]
pub struct Leaf {
    /// The shape, in its object space.
    pub shape: Shape,
    /// Takes the world to the object space; `None` where they are the same. The forward matrix is not kept, and the
    /// normal matrix is this one transposed.
    pub object_from_world: Option<Box<DAffine3>>,
    /// Its looks: an index into the world's surfaces.
    pub surface: u32,
}

impl Leaf {
    /// What stands where a leaf was taken away.
    pub(super) const NOTHING: Leaf = Leaf {
        shape: Shape::Sphere(Sphere {
            centre: DVec3::ZERO,
            radius: 0.0,
        }),
        object_from_world: None,
        surface: 0,
    };

    /// A shape moved by `steps`: as many of them as it can take in leave no matrix behind. Gives the bounds of its
    /// surface too, or with `extent` those of the solid, which may be larger.
    #[must_use]
    pub fn new(
        mut shape: Shape,
        (steps, absorb): (&[Step], Absorb),
        surface: u32,
        extent: Extent,
    ) -> (Leaf, Bounds) {
        let absorbed = match absorb {
            Absorb::AllItCan => steps.iter().take_while(|step| shape.absorb(step)).count(),
            Absorb::Nothing => 0,
        };
        shape.prepare();
        let rest = &steps[absorbed..];
        if rest.is_empty() {
            let bounds = extent.of(&shape);
            return (
                Leaf {
                    shape,
                    object_from_world: None,
                    surface,
                },
                bounds,
            );
        }
        let transform = Transform::from_steps(rest);
        let bounds = extent.of(&shape).transformed(&transform.world_from_object);
        (
            Leaf {
                shape,
                object_from_world: Some(Box::new(transform.object_from_world)),
                surface,
            },
            bounds,
        )
    }

    /// Bounds of its surface, given those of the solid.
    pub(super) fn surface_bounds(&self, solid: &Bounds) -> Bounds {
        if !self.shape.reaches_out() {
            return *solid;
        }
        let bounds = self.shape.bounds();
        match &self.object_from_world {
            None => bounds,
            Some(matrix) => bounds.transformed(&matrix.inverse()),
        }
    }

    /// A world ray in the space of the shape: itself, or one in `room`. What is only read is not copied: a vector that was
    /// just written as one pair of numbers and a single is slow to read as a single and a pair.
    #[inline(always)]
    fn to_object<'r>(&self, ray: &'r Ray, room: &'r mut Option<Ray>) -> &'r Ray {
        match &self.object_from_world {
            None => ray,
            Some(matrix) => room.insert(ray.to_object(matrix)),
        }
    }

    #[inline(always)]
    pub(super) fn point_to_object(&self, point: DVec3) -> DVec3 {
        self.object_from_world
            .as_ref()
            .map_or(point, |matrix| matrix.transform_point3(point))
    }

    /// All roots on the whole line of a world ray.
    pub fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        self.shape.roots(self.to_object(ray, &mut None), roots)
    }

    /// Of all roots on the whole line of a world ray at least those beyond `from` up to the first beyond `enough`. Says
    /// whether these are all of them for certain.
    pub(super) fn roots_from(
        &self,
        ray: &Ray,
        from: f64,
        enough: f64,
        roots: &mut Vec<Root>,
    ) -> bool {
        let room = &mut None;
        let ray = self.to_object(ray, room);
        self.shape.roots_from(ray, from, enough, roots)
    }

    /// The root that a world ray is known to have at `t`; none where it is none after all.
    pub(super) fn root_at(&self, ray: &Ray, t: f64, roots: &mut Vec<Root>) -> Option<Root> {
        let room = &mut None;
        let by_place = match &self.shape {
            Shape::Sphere(sphere) if self.object_from_world.is_none() => sphere.root_at(ray, t),
            Shape::Cuboid(cuboid) => cuboid.root_at(self.to_object(ray, room), t),
            Shape::Cylinder(cylinder) => cylinder.root_at(self.to_object(ray, room), t),
            _ => None,
        };
        if by_place.is_some() {
            return by_place;
        }
        roots.clear();
        self.roots(ray, roots);
        roots.iter().find(|root| root.t == t).copied()
    }

    /// Whether all of a world ray from its start to `to` lies well inside; what is not known is false.
    #[must_use]
    #[inline]
    pub(super) fn holds(&self, ray: &Ray, to: f64) -> bool {
        match &self.shape {
            Shape::Sphere(sphere) => sphere.holds(self.to_object(ray, &mut None), to),
            Shape::Cuboid(cuboid) => cuboid.holds(self.to_object(ray, &mut None), to),
            _ => false,
        }
    }

    /// The first visible root of a world ray with `from < t < to`.
    #[must_use]
    #[inline(always)]
    pub fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.shape.nearest(self.to_object(ray, &mut None), from, to)
    }

    /// Whether a world ray that leaves the shape outward cannot meet it again; what is not known is false.
    #[must_use]
    #[inline(always)]
    pub fn is_left_for_good(&self, ray: &Ray) -> bool {
        match (&self.shape, &self.object_from_world) {
            (Shape::Sphere(sphere), None) => sphere.is_exiting(ray),
            _ => self.is_other_left_for_good(ray),
        }
    }

    /// Whether all that the line of a world ray enters lies before its start; what is not known is false.
    #[must_use]
    pub fn is_exiting(&self, ray: &Ray) -> bool {
        self.shape.is_exiting(self.to_object(ray, &mut None))
    }

    #[inline(never)]
    fn is_other_left_for_good(&self, ray: &Ray) -> bool {
        !self.shape.is_faceted() && self.is_exiting(ray)
    }

    /// The first visible root of a world ray with `from < t < to` on any piece of a faceted shape but `face`.
    #[must_use]
    pub fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let room = &mut None;
        self.shape
            .nearest_beside(self.to_object(ray, room), from, to, face)
    }

    /// Whether a world point lies in the solid.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.shape.contains(self.point_to_object(point))
    }

    /// The unit outward normals at a world point of a piece of the surface: the geometric one, and that for shading.
    #[must_use]
    #[inline]
    pub fn normals(&self, point: DVec3, face: u32) -> (DVec3, DVec3) {
        if let (Shape::Sphere(sphere), None) = (&self.shape, &self.object_from_world) {
            let normal = unit_normal(point - sphere.centre);
            return (normal, normal);
        }
        self.other_normals(point, face)
    }

    #[inline(never)]
    fn other_normals(&self, point: DVec3, face: u32) -> (DVec3, DVec3) {
        let local = self.point_to_object(point);
        let geometric = self.to_world(self.shape.normal(local, face));
        let shading = self.shape.shading_normal(local, face);
        (
            geometric,
            shading.map_or(geometric, |normal| self.to_world(normal)),
        )
    }

    /// The texture coordinates at a world point of a piece of the surface; `None` for those of the world.
    pub(super) fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        self.shape.uv(self.point_to_object(point), face)
    }

    /// The shares of the shape's own textures at a world point of a piece of its surface.
    pub(super) fn shares(&self, point: DVec3, face: u32) -> TextureWeights {
        self.shape.shares(self.point_to_object(point), face)
    }

    #[inline(always)]
    fn to_world(&self, normal: DVec3) -> DVec3 {
        let normal = match &self.object_from_world {
            Some(matrix) => normal_from_inverse(matrix, normal),
            None => normal,
        };
        unit_normal(normal)
    }

    /// Centre and radius of a leaf that is a ball.
    #[must_use]
    pub fn ball(&self) -> Option<(DVec3, f64)> {
        match (&self.shape, &self.object_from_world) {
            (Shape::Sphere(sphere), None) => Some((sphere.centre, sphere.radius)),
            _ => None,
        }
    }

    /// A ball that holds the leaf and not much else, by centre and radius, and whether the leaf fills it.
    #[must_use]
    pub(super) fn ball_around(&self) -> Option<(DVec3, f64, bool)> {
        let (centre, radius) = match &self.shape {
            Shape::Torus(torus) => (torus.centre, torus.rim()),
            Shape::Cuboid(cuboid) => {
                let half = 0.5 * cuboid.max - 0.5 * cuboid.min;
                (cuboid.min + half, half.length() * (1.0 + CARE))
            }
            _ => {
                let (centre, radius) = self.ball()?;
                return Some((centre, radius, true));
            }
        };
        let slack = |centre: DVec3| CARE * centre.abs().max_element();
        let Some(matrix) = &self.object_from_world else {
            return Some((centre, radius + slack(centre), false));
        };
        let scale = similarity(&matrix.matrix3)?;
        let centre = matrix.inverse().transform_point3(centre);
        let radius = radius / scale * (1.0 + CARE) + slack(centre);
        radius.is_normal().then_some((centre, radius, false))
    }

    /// A round rod without ends that holds the leaf and not much else.
    #[must_use]
    pub(super) fn rod_around(&self) -> Option<BoundingCylinder> {
        let Shape::Cylinder(cylinder) = &self.shape else {
            return None;
        };
        let (base, way, radius) = cylinder.rod();
        let Some(matrix) = &self.object_from_world else {
            return Some((base, way, radius));
        };
        let scale = similarity(&matrix.matrix3)?;
        let to_world = matrix.inverse();
        let base = to_world.transform_point3(base);
        let slack = CARE * base.abs().max_element();
        let radius = radius / scale * (1.0 + CARE) + slack;
        let is_sound = radius.is_normal() && base.is_finite();
        is_sound.then(|| (base, to_world.transform_vector3(way), radius))
    }

    /// Bounds of the leaf that are no larger than `bounds`: smaller where it is a torus that is turned. The box of a
    /// turned box, by which POV-Ray knows things, may have twice the surface.
    #[must_use]
    pub(super) fn tightened(&self, bounds: &Bounds) -> Bounds {
        let (Shape::Torus(torus), Some(matrix)) = (&self.shape, &self.object_from_world) else {
            return *bounds;
        };
        let world_from_object = matrix.inverse();
        let there_and_back = world_from_object.matrix3 * matrix.matrix3;
        if !there_and_back.abs_diff_eq(DMat3::IDENTITY, 0.5 * CARE) {
            return *bounds;
        }
        let Some(reach) = torus.reach_under(&world_from_object.matrix3) else {
            return *bounds;
        };
        let centre = world_from_object.transform_point3(torus.centre);
        let reach = reach * (1.0 + CARE) + CARE * centre.abs().max_element();
        let tight = Bounds::new(centre - reach, centre + reach);
        if tight.is_finite() {
            tight.intersection(bounds)
        } else {
            *bounds
        }
    }

    /// The memory of this leaf in bytes, its matrix included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Leaf>()
            + self
                .object_from_world
                .as_ref()
                .map_or(0, |_| size_of::<DAffine3>())
    }
}

/// The factor of a matrix that turns and scales evenly.
fn similarity(matrix: &DMat3) -> Option<f64> {
    let squares = matrix.transpose() * *matrix;
    let size = squares.x_axis.x;
    let even = DMat3::from_diagonal(DVec3::splat(size));
    squares
        .abs_diff_eq(even, 0.1 * CARE * size)
        .then(|| size.sqrt())
}

/// The normal of length 1, or zero where there is none.
#[inline]
fn unit_normal(normal: DVec3) -> DVec3 {
    if normal.length_squared().is_normal() {
        normal.normalize_or_zero()
    } else {
        unit(normal).unwrap_or(DVec3::ZERO)
    }
}
