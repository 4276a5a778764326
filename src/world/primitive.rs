//! A primitive in the scene: in world coordinates where possible, otherwise behind an inverse matrix.

use crate::base::accel::BoundingCylinder;
use crate::base::math::conditioning::{Normalization, unit};
use crate::base::math::{Bounds, Ray, Step, Transform, normal_from_inverse};
use crate::scene::shape::{
    Geometry, Root, Rounded, RoundedHit, Shape, Sphere, Start, Steps, TextureWeights,
};
use glam::{DAffine3, DMat3, DVec3};

/// Relative safety margin, larger than the rounding errors of values derived from a matrix.
const MARGIN: f64 = 1e-9;

/// Selects the bounds of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Bounds of the visible surface.
    Surface,
    /// Bounds of everything inside.
    Solid,
}

/// Selects how many of its transforms a shape absorbs into its own parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absorb {
    /// As many as its kind of shape allows.
    AllItCan,
    /// None: its texture coordinates are needed.
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
    /// World-to-object matrix; `None` if the spaces are the same. The forward matrix is not stored, and the normal
    /// matrix is this one transposed.
    pub object_from_world: Option<Box<DAffine3>>,
    /// Index of its surface attributes in the world's list.
    pub surface: u32,
}

impl Leaf {
    /// Placeholder for a leaf that was moved out.
    pub(super) const NOTHING: Leaf = Leaf {
        shape: Shape::Sphere(Sphere {
            centre: DVec3::ZERO,
            radius: 0.0,
        }),
        object_from_world: None,
        surface: 0,
    };

    /// A shape with its transforms: those it can absorb leave no matrix behind. Also returns the bounds selected by
    /// `extent`; those of the solid may be larger than those of the surface.
    #[must_use]
    pub fn new(
        mut shape: Shape,
        steps: &[Step],
        absorb: Absorb,
        surface: u32,
        extent: Extent,
    ) -> (Leaf, Bounds) {
        let absorbed = match absorb {
            Absorb::AllItCan => steps.iter().take_while(|step| shape.absorb(step)).count(),
            Absorb::Nothing => 0,
        };
        let rest = &steps[absorbed..];
        if !rest.is_empty() {
            shape.note_steps(rest);
        }
        shape.prepare();
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
        if !self.shape.extends_beyond_bounds() {
            return *solid;
        }
        let bounds = self.shape.bounds();
        match &self.object_from_world {
            None => bounds,
            Some(matrix) => bounds.transformed(&matrix.inverse()),
        }
    }

    /// A world ray in object space: the ray itself, or its transform stored in `transformed`. The untransformed ray is
    /// borrowed, not copied: a vector just stored as a pair and a single is slow to load as a single and a pair.
    #[inline(always)]
    fn to_object<'r>(&self, ray: &'r Ray, transformed: &'r mut Option<Ray>) -> &'r Ray {
        match &self.object_from_world {
            None => ray,
            Some(matrix) => transformed.insert(ray.to_object(matrix)),
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

    /// The roots on the whole line of a world ray beyond `from`, at least up to the first beyond `enough`. Returns true
    /// if these are certainly all roots.
    pub(super) fn roots_from(
        &self,
        ray: &Ray,
        from: f64,
        enough: f64,
        roots: &mut Vec<Root>,
    ) -> bool {
        let transformed = &mut None;
        let ray = self.to_object(ray, transformed);
        self.shape.roots_from(ray, from, enough, roots)
    }

    /// The root that a world ray is known to have at `t`; `None` if it turns out to have none.
    pub(super) fn root_at(&self, ray: &Ray, t: f64, roots: &mut Vec<Root>) -> Option<Root> {
        let transformed = &mut None;
        let direct = match self.world_sphere() {
            Some(sphere) => sphere.root_of_unit_ray(ray, t),
            None if self.shape.has_faces() => {
                self.shape.root_at(self.to_object(ray, transformed), t)
            }
            None => None,
        };
        if direct.is_some() {
            return direct;
        }
        roots.clear();
        self.roots(ray, roots);
        roots.iter().find(|root| root.t == t).copied()
    }

    /// Returns true if the ray is well inside from its origin to `to`; false if unknown.
    #[must_use]
    #[inline]
    pub(super) fn holds(&self, ray: &Ray, to: f64) -> bool {
        self.shape.tests_well_inside()
            && self
                .shape
                .is_well_inside(self.to_object(ray, &mut None), to)
    }

    /// The first visible root of a world ray with `from < t < to`.
    #[must_use]
    #[inline(always)]
    pub fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.shape.nearest(self.to_object(ray, &mut None), from, to)
    }

    /// True if POV-Ray's rounding of its hits follows from what is stored here.
    pub(super) fn knows_rounding(&self) -> bool {
        self.world_sphere().is_some() || self.decides_ties_itself()
    }

    /// True for such shapes whose rounded distances decide ties.
    pub(super) fn decides_ties_itself(&self) -> bool {
        match &self.shape {
            Shape::Triangle(_) => self.object_from_world.is_none(),
            Shape::Mesh(_) => true,
            _ => false,
        }
    }

    /// The hit of a world ray on a face near `t` with POV-Ray's rounding, if [`Leaf::knows_rounding`].
    pub(super) fn rounded_hit(
        &self,
        ray: &Ray,
        t: f64,
        face: u32,
        normalization: Normalization,
    ) -> Option<RoundedHit> {
        match (&self.shape, self.object_from_world.as_deref()) {
            (Shape::Sphere(sphere), None) => Some(sphere.rounded_hit(ray, t, normalization)),
            (Shape::Triangle(triangle), None) => {
                let steps = &[];
                let form = Rounded::of_triangle(
                    triangle,
                    &Steps {
                        steps,
                        normalization,
                    },
                );
                form.hit(ray, t, face)
            }
            (Shape::Mesh(mesh), stored) => mesh.rounded_hit(ray, stored, face, normalization),
            _ => None,
        }
    }

    /// Returns true if a world ray that leaves the shape outward cannot hit it again; false if unknown.
    #[must_use]
    #[inline(always)]
    pub fn has_exited_convex(&self, ray: &Ray) -> bool {
        match self.world_sphere() {
            Some(sphere) => sphere.is_exiting(ray),
            None => self.other_has_exited_convex(ray),
        }
    }

    /// Returns true if everything on the line of a world ray lies before its origin; false if unknown.
    #[must_use]
    pub fn is_exiting(&self, ray: &Ray) -> bool {
        self.shape.is_exiting(self.to_object(ray, &mut None))
    }

    /// True for a convex solid in world coordinates whose whole surface is seen.
    #[must_use]
    pub(super) fn is_convex_solid(&self) -> bool {
        self.object_from_world.is_none()
            && match &self.shape {
                Shape::Sphere(_) | Shape::Cuboid(_) => true,
                Shape::Cylinder(cylinder) => !cylinder.is_open(),
                _ => false,
            }
    }

    /// A `t` up to which a world ray that leaves the shape outward certainly does not hit it again; `None` if unknown.
    #[must_use]
    #[inline]
    pub(super) fn departure(&self, ray: &Ray) -> Option<f64> {
        match &self.shape {
            Shape::Blob(blob) => blob.departure(self.to_object(ray, &mut None)),
            _ => None,
        }
    }

    #[inline(never)]
    fn other_has_exited_convex(&self, ray: &Ray) -> bool {
        !self.shape.is_faceted() && self.is_exiting(ray)
    }

    /// The first visible root of a world ray with `from < t < to` on any face of a faceted shape except `face`.
    #[must_use]
    pub fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let transformed = &mut None;
        self.shape
            .nearest_beside(self.to_object(ray, transformed), from, to, face)
    }

    /// Returns true if a world point lies in the solid.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.shape.contains(self.point_to_object(point))
    }

    /// The unit outward normals at a world point of a face that a ray in direction `dir` hit: the geometric one and the
    /// shading normal.
    #[must_use]
    #[inline]
    pub fn normals(&self, point: DVec3, dir: DVec3, face: u32) -> (DVec3, DVec3) {
        if let Some(sphere) = self.world_sphere() {
            let normal = unit_normal(point - sphere.centre);
            return (normal, normal);
        }
        self.other_normals(point, dir, face)
    }

    #[inline(never)]
    fn other_normals(&self, point: DVec3, dir: DVec3, face: u32) -> (DVec3, DVec3) {
        let local = self.point_to_object(point);
        let matrix = self.object_from_world.as_ref();
        let dir = matrix.map_or(dir, |matrix| matrix.transform_vector3(dir));
        let geometric = self.to_world(self.shape.normal_along(local, dir, face));
        let shading = self.shape.shading_normal(local, face);
        (
            geometric,
            shading.map_or(geometric, |normal| self.to_world(normal)),
        )
    }

    /// The texture coordinates at a world point of a face; `None` if the world's apply.
    pub(super) fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        self.shape.uv(self.point_to_object(point), face)
    }

    /// The weights of the shape's own textures at a world point of a face.
    pub(super) fn texture_weights(&self, point: DVec3, face: u32) -> TextureWeights {
        self.shape
            .texture_weights(self.point_to_object(point), face)
    }

    #[inline(always)]
    fn to_world(&self, normal: DVec3) -> DVec3 {
        let normal = match &self.object_from_world {
            Some(matrix) => normal_from_inverse(matrix, normal),
            None => normal,
        };
        unit_normal(normal)
    }

    /// Centre and radius, if the leaf is a sphere in world coordinates.
    #[must_use]
    pub fn sphere(&self) -> Option<(DVec3, f64)> {
        self.world_sphere()
            .map(|sphere| (sphere.centre, sphere.radius))
    }

    /// The shape, if it is a sphere in world coordinates: the most frequent one, which queries treat first.
    #[must_use]
    #[inline(always)]
    pub(super) fn world_sphere(&self) -> Option<&Sphere> {
        match (&self.shape, &self.object_from_world) {
            (Shape::Sphere(sphere), None) => Some(sphere),
            _ => None,
        }
    }

    /// A tight bounding sphere by centre and radius, and whether the leaf fills it.
    #[must_use]
    pub(super) fn bounding_sphere(&self) -> Option<(DVec3, f64, bool)> {
        let Some((centre, radius)) = self.shape.bounding_sphere() else {
            let (centre, radius) = self.sphere()?;
            return Some((centre, radius, true));
        };
        let slack = |centre: DVec3| MARGIN * centre.abs().max_element();
        let Some(matrix) = &self.object_from_world else {
            return Some((centre, radius + slack(centre), false));
        };
        let scale = similarity(&matrix.matrix3)?;
        let centre = matrix.inverse().transform_point3(centre);
        let radius = radius / scale * (1.0 + MARGIN) + slack(centre);
        radius.is_normal().then_some((centre, radius, false))
    }

    /// A tight infinite bounding cylinder.
    #[must_use]
    pub(super) fn bounding_cylinder(&self) -> Option<BoundingCylinder> {
        let (base, axis, radius) = self.shape.bounding_cylinder()?;
        let Some(matrix) = &self.object_from_world else {
            return Some((base, axis, radius));
        };
        let scale = similarity(&matrix.matrix3)?;
        let to_world = matrix.inverse();
        let base = to_world.transform_point3(base);
        let slack = MARGIN * base.abs().max_element();
        let radius = radius / scale * (1.0 + MARGIN) + slack;
        let is_sound = radius.is_normal() && base.is_finite();
        is_sound.then(|| (base, to_world.transform_vector3(axis), radius))
    }

    /// Bounds of the leaf no larger than `bounds`: tighter for a rotated torus. The box of a rotated box, which POV-Ray
    /// uses, may have twice the surface area.
    #[must_use]
    pub(super) fn tightened(&self, bounds: &Bounds) -> Bounds {
        let Some(matrix) = &self.object_from_world else {
            return *bounds;
        };
        let world_from_object = matrix.inverse();
        let there_and_back = world_from_object.matrix3 * matrix.matrix3;
        if !there_and_back.abs_diff_eq(DMat3::IDENTITY, 0.5 * MARGIN) {
            return *bounds;
        }
        let Some((centre, reach)) = self.shape.tight_extent(&world_from_object.matrix3) else {
            return *bounds;
        };
        let centre = world_from_object.transform_point3(centre);
        let reach = reach * (1.0 + MARGIN) + MARGIN * centre.abs().max_element();
        let tight = Bounds::new(centre - reach, centre + reach);
        if tight.is_finite() {
            tight.intersection(bounds)
        } else {
            *bounds
        }
    }

    /// Memory of this leaf in bytes, with its matrix.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Leaf>()
            + self
                .object_from_world
                .as_ref()
                .map_or(0, |_| size_of::<DAffine3>())
    }
}

/// The scale factor of a similarity transform; `None` for other matrices.
fn similarity(matrix: &DMat3) -> Option<f64> {
    let squares = matrix.transpose() * *matrix;
    let size = squares.x_axis.x;
    let even = DMat3::from_diagonal(DVec3::splat(size));
    squares
        .abs_diff_eq(even, 0.1 * MARGIN * size)
        .then(|| size.sqrt())
}

/// The unit normal, or zero if it has no direction.
#[inline]
fn unit_normal(normal: DVec3) -> DVec3 {
    if normal.length_squared().is_normal() {
        normal.normalize_or_zero()
    } else {
        unit(normal).unwrap_or(DVec3::ZERO)
    }
}
