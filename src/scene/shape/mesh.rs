//! `mesh` and `mesh2`: many triangles as one shape, with a BVH of their own.
//!
//! Corners and normals are stored in single precision, as in POV-Ray; everything computed from them is double. Copies
//! of an object share the triangles, and a transform never moves them. Error bound: as for a triangle, 2 roundings of
//! the problem's size from the plane of the stored corners, and no gap at any edge (`math/watertight.rs`).
//!
//! Without `inside_vector` a mesh is a patch. With it a point is inside if a ray from it along the vector crosses an
//! odd number of triangles. If every edge belongs to an even number of triangles this holds along any line, so enter
//! and leave alternate along a ray ([`RayFrame::crossing`] counts exactly). Otherwise the state between two roots is
//! that of the midpoint, and the state beyond the outermost roots is outside.

use super::face_texture::{FaceTexture, TextureWeights};
use super::mesh::attributes::{NO_TRIPLE, TexturesOf, TriangleAttributes, only};
use super::mesh::build::{MeshBuilder, single_pair};
use super::mesh::planes::FacePlane;
use super::patch::smooth_triangle::weights;
use super::{Crossing, Geometry, Root, Start, first_visible, read};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word, declared};
use crate::base::derived::Derived;
use crate::base::math::conditioning::power_of_two;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::watertight::{
    RayFrame, RayFrames4, RaysAndTriangle, TriangleHit, TriangleHits4,
};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::texture::Texture;
use glam::{DVec3, Vec2, Vec3};
use std::sync::{Arc, OnceLock};

/// Triangles that share corners. Copies of the mesh share all of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    triangles: Arc<Triangles>,
    /// True if rays are intersected with POV-Ray's planes ([`planes`]).
    has_povray_planes: bool,
}

/// The parts of a mesh for [`Mesh::from_lists`].
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshLists<'a> {
    /// The vertices.
    pub vertices: &'a [DVec3],
    /// The normal of each vertex, of any length; `None` for flat triangles.
    pub normals: Option<&'a [DVec3]>,
    /// The indices of the vertices of each triangle.
    pub faces: &'a [[u32; 3]],
    /// The textures.
    pub textures: &'a [Arc<Texture>],
    /// The index of the texture of each triangle, which has that of the object where the index is out of range; empty if
    /// all have that.
    pub texture_of_face: &'a [u32],
    /// The `inside_vector`.
    pub inside_vector: Option<DVec3>,
}

/// Vertices, faces and attributes of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    pub(super) vertices: Vec<Vec3>,
    /// Per triangle, the indices of its corners in [`Triangles::vertices`].
    pub(super) corners: Vec<[u32; 3]>,
    /// Unit vectors, or zero.
    pub(super) normals: Vec<Vec3>,
    /// Per triangle, the indices of its corner normals, or [`FLAT`]; empty if all triangles are flat.
    pub(super) smooth: Vec<[u32; 3]>,
    /// Texture coordinates and textures of triangles, if there are any.
    pub(super) attributes: Option<Box<TriangleAttributes>>,
    pub(super) inside: Option<Inside>,
    /// POV-Ray's planes; from the start where they do not follow from the stored corners.
    pub(super) planes: OnceLock<Vec<FacePlane>>,
    pub(super) bounds: Bounds,
    /// BVH over the triangles, built in [`Geometry::prepare`]: a mesh that is never traced needs none.
    pub(super) tree: Derived<Bvh>,
}

/// Entry of [`Triangles::smooth`]: the triangle is shaded with the normal of its plane.
pub(super) const FLAT: [u32; 3] = [u32::MAX; 3];

/// Index of no triangle.
const NONE: u32 = u32::MAX;

/// Definition of the inside of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inside {
    /// The `inside_vector`.
    pub(super) dir: DVec3,
    /// True if every edge belongs to an even number of triangles.
    pub(super) is_closed: bool,
}

impl PartialEq for Triangles {
    /// The BVH follows from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.vertices == other.vertices
            && self.corners == other.corners
            && self.normals == other.normals
            && self.smooth == other.smooth
            && self.attributes == other.attributes
            && self.inside == other.inside
            && self.planes.get() == other.planes.get()
    }
}

impl Mesh {
    pub(super) fn new(triangles: Triangles) -> Self {
        Mesh {
            triangles: Arc::new(triangles),
            has_povray_planes: false,
        }
    }

    /// A mesh of triangles by the indices of their vertices, without degenerate ones.
    ///
    /// # Errors
    /// A vertex that single precision cannot hold, an index of a vertex out of range, fewer or more normals than
    /// vertices, fewer or more textures of triangles than triangles, or no triangle left. The error is the reason.
    pub fn from_lists(lists: &MeshLists<'_>) -> Result<Self, String> {
        let mut builder = MeshBuilder::default();
        builder.inside = lists.inside_vector;
        builder.lists(lists.vertices, lists.normals, lists.faces)?;
        if !lists.texture_of_face.is_empty() {
            let (count, faces) = (lists.texture_of_face.len(), lists.faces.len());
            if count != faces {
                return Err(format!(
                    "there are {count} textures of faces for {faces} faces"
                ));
            }
            builder.attributes.textures = lists.textures.iter().cloned().map(FaceTexture).collect();
            builder.attributes.textures_of = TexturesOf::One(lists.texture_of_face.to_vec());
        }
        let mesh = builder.build();
        if mesh.corners.is_empty() {
            return Err("all triangles of this mesh are degenerate".to_owned());
        }
        Ok(Mesh::new(mesh))
    }

    /// Reads the triangles of `mesh` and its `inside_vector`. Degenerate triangles are dropped silently.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, or no triangle at all.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let start = args.span();
        let mut builder = MeshBuilder::default();
        loop {
            if args.accept(Word::Triangle)? {
                read_triangle(args, &mut builder, Shading::Flat)?;
            } else if args.accept(Word::SmoothTriangle)? {
                read_triangle(args, &mut builder, Shading::Smooth)?;
            } else if args.word()? == Some(Word::InsideVector) {
                read_inside_vector(args, &mut builder)?;
            } else {
                break;
            }
        }
        if builder.corners.is_empty() {
            return Err(args.expected("`triangle` or `smooth_triangle` in `mesh`"));
        }
        let mesh = builder.build();
        if mesh.corners.is_empty() {
            return Err(Box::new(Diagnostic::error(
                start.to(args.last_span()),
                "all triangles of this mesh are degenerate: none is left to draw",
            )));
        }
        Ok(Mesh::new(mesh))
    }

    /// The vertices, faces and attributes.
    pub(super) fn triangles(&self) -> &Triangles {
        &self.triangles
    }

    /// The BVH over the triangles.
    pub(crate) fn tree(&self) -> &Bvh {
        self.triangles.tree()
    }

    /// The `inside_vector`; `None` if the mesh has no inside.
    #[must_use]
    pub fn inside_vector(&self) -> Option<DVec3> {
        self.triangles.inside.map(|inside| inside.dir)
    }

    /// True if the mesh has no inside.
    pub(crate) fn is_patch(&self) -> bool {
        self.triangles.inside.is_none()
    }

    /// Makes rays intersect the triangles of a patch as POV-Ray does ([`planes`]).
    pub(crate) fn use_povray_planes(&mut self) {
        self.has_povray_planes = self.is_patch();
        if self.has_povray_planes {
            self.triangles.fill_planes();
        }
    }

    /// True if ray packets intersect its triangles: there is no inside, and none of POV-Ray's planes.
    pub(crate) fn suits_packets(&self) -> bool {
        self.is_patch() && !self.has_povray_planes
    }

    /// Intersects the whole line of a ray with a triangle of a patch; returns `t`.
    #[inline(always)]
    pub(crate) fn intersect_triangle(&self, frame: &RayFrame, face: u32) -> Option<f64> {
        frame.hit(&self.triangles.corners(face)).map(|hit| hit.t)
    }

    /// Intersects the whole lines of a ray packet with a triangle of a patch.
    #[inline(always)]
    pub(crate) fn intersect_triangle_packet(
        &self,
        lanes: SimdLevel,
        rays: &RayFrames4,
        face: u32,
    ) -> TriangleHits4 {
        let corners = &self.triangles.corners(face);
        lanes.run(RaysAndTriangle { rays, corners })
    }

    /// A root of a patch on triangle `face`.
    pub(crate) fn root(t: f64, face: u32) -> Root {
        root(t, face, Crossing::Touch)
    }

    /// Barycentric coordinates of a point of a triangle.
    fn weights(&self, point: DVec3, face: u32) -> [f64; 3] {
        weights(
            &self.triangles.corners(face),
            self.normal(point, face),
            point,
        )
    }

    /// Number of triangles, degenerate ones not counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.triangles.corners.len()
    }

    /// True if there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles.corners.is_empty()
    }

    /// Memory in bytes, shared by all copies.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let lists = self.triangles.vertices.capacity() + self.triangles.normals.capacity();
        let triples = self.triangles.corners.capacity() + self.triangles.smooth.capacity();
        size_of::<Triangles>()
            + lists * size_of::<Vec3>()
            + triples * size_of::<[u32; 3]>()
            + self.triangles.planes.get().map_or(0, Vec::capacity) * size_of::<FacePlane>()
            + self.triangles.attributes.as_ref().map_or(0, |attributes| {
                size_of::<TriangleAttributes>() + attributes.bytes()
            })
            + self.triangles.tree.get().map_or(0, Bvh::bytes)
    }
}

/// Shading of a triangle of a `mesh`: flat, or smooth with a normal at each corner.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shading {
    Flat,
    Smooth,
}

/// Reads `{ corners and normals [uv_vectors] }` after `triangle` or `smooth_triangle`.
fn read_triangle(args: &mut dyn Args, builder: &mut MeshBuilder, shading: Shading) -> Parse<()> {
    args.open()?;
    let at = args.span();
    let count = if shading == Shading::Smooth { 6 } else { 3 };
    let mut given = [DVec3::ZERO; 6];
    let mut taken = 0;
    args.literal_vectors(3, &mut |vector| {
        let is_wanted = taken < count && vector.iter().all(|c| c.is_finite());
        if is_wanted {
            given[taken] = DVec3::from_slice(vector);
            taken += 1;
        }
        is_wanted
    });
    for vector in &mut given[taken..count] {
        let what = "the corners and normals of a triangle";
        *vector = read::vector(args, what)?;
    }
    let added = match shading {
        Shading::Flat => builder.triangle([given[0], given[1], given[2]], None),
        Shading::Smooth => builder.triangle(
            [given[0], given[2], given[4]],
            Some([given[1], given[3], given[5]]),
        ),
    };
    if let Err(fault) = added {
        let location = at.to(args.last_span());
        return Err(Box::new(Diagnostic::error(location, fault)));
    }
    if args.accept(Word::UvVectors)? {
        let mut pairs = [Vec2::ZERO; 3];
        for pair in &mut pairs {
            args.comma()?;
            *pair = single_pair(args.vector2()?);
        }
        builder.set_uv_of_last(pairs);
    }
    if let Some(textures) = read_textures(args, builder)? {
        builder.set_textures_of_last(textures);
    }
    args.close()
}

/// Reads `texture { ... }` for a whole triangle, or `texture_list { T1 T2 T3 }` for its corners.
fn read_textures(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<Option<[u32; 3]>> {
    if args.accept(Word::Texture)? {
        let texture = builder.texture_index(FaceTexture::read(args)?);
        return Ok(Some(only(texture)));
    }
    if !args.accept(Word::TextureList)? {
        return Ok(None);
    }
    args.open()?;
    let mut textures = NO_TRIPLE;
    for texture in &mut textures {
        args.comma()?;
        let named = match declared::<Texture>(args)? {
            Some(named) => FaceTexture(named),
            None if args.accept(Word::Texture)? => FaceTexture::read(args)?,
            None => return Err(args.expected("the names of three textures in `texture_list`")),
        };
        *texture = builder.texture_index(named);
    }
    args.comma()?;
    args.close()?;
    Ok(Some(textures))
}

/// Reads any `inside_vector`; the zero vector removes the inside again.
pub(super) fn read_inside_vector(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    while args.accept(Word::InsideVector)? {
        let dir = read::vector(args, "the `inside_vector` of the mesh")?;
        builder.inside = (dir != DVec3::ZERO).then_some(dir);
    }
    Ok(())
}

impl Triangles {
    /// Bounding box of a triangle.
    pub(super) fn bounds_of(&self, corners: &[u32; 3]) -> Bounds {
        // Written out: `map` is not always inlined.
        let [a, b, c] = *corners;
        let corner = |number: u32| self.vertices[number as usize].as_dvec3();
        let [a, b, c] = [corner(a), corner(b), corner(c)];
        Bounds::new(a, b).with_point(c)
    }

    /// Computes the bounds once all triangles are known.
    pub(super) fn bounded(mut self) -> Self {
        let boxes = self.corners.iter().map(|corners| self.bounds_of(corners));
        self.bounds = boxes.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        self
    }

    /// The BVH over the triangles. Threads that need it before it exists each build one, and one of the results is
    /// stored: no thread waits for another while holding a lock.
    fn tree(&self) -> &Bvh {
        if let Some(tree) = self.tree.get() {
            return tree;
        }
        let tree = Bvh::build_of(self.corners.len(), |face| {
            self.bounds_of(&self.corners[face])
        });
        self.tree.get_or_init(|| tree)
    }

    // Written out: `map` is not always inlined.
    #[inline(always)]
    fn corners(&self, face: u32) -> [DVec3; 3] {
        let [a, b, c] = self.corners[face as usize];
        let corner = |number: u32| self.vertices[number as usize].as_dvec3();
        [corner(a), corner(b), corner(c)]
    }

    #[inline(always)]
    fn intersect(&self, frame: &RayFrame, face: u32) -> Option<TriangleHit> {
        match self.inside {
            Some(_) => frame.crossing(&self.corners(face)),
            None => frame.hit(&self.corners(face)),
        }
    }

    /// Closest hit with `from < t < to` on any triangle except `skip`; at equal `t` the one first in the list.
    fn first(&self, ray: &Ray, from: f64, to: f64, skip: u32) -> Option<(f64, u32)> {
        with_widest(
            #[inline(always)]
            |lanes| self.first_in(lanes, ray, from, to, skip),
        )
    }

    #[inline(always)]
    fn first_in(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        from: f64,
        to: f64,
        skip: u32,
    ) -> Option<(f64, u32)> {
        let frame = RayFrame::new(ray);
        let mut closest = None;
        self.tree().nearest_in(
            lanes,
            ray,
            (from, to),
            #[inline(always)]
            |face, end| {
                let Some(TriangleHit { t, .. }) = self.intersect(&frame, face) else {
                    return end;
                };
                let is_first = match closest {
                    None => true,
                    Some((closest_t, closest_face)) => {
                        t < closest_t || (t == closest_t && face < closest_face)
                    }
                };
                if face != skip && from < t && t < to && is_first {
                    closest = Some((t, face));
                    return t;
                }
                end
            },
        );
        closest
    }

    /// Number of triangles that a ray crosses at `from <= t <= to`.
    fn count(&self, ray: &Ray, from: f64, to: f64) -> usize {
        let frame = RayFrame::new(ray);
        let mut count = 0;
        self.tree().any(ray, from, to, |face| {
            let hit = self.intersect(&frame, face);
            count += usize::from(hit.is_some_and(|hit| from <= hit.t && hit.t <= to));
            false
        });
        count
    }

    /// Crossing at the first root of a closed mesh beyond `from`. `left`, the triangle that the ray starts on, counts
    /// as behind even if its hit rounds to the other side.
    fn crossing_after(&self, ray: &Ray, from: f64, left: u32) -> Crossing {
        let mut crossed = self.count(ray, f64::NEG_INFINITY, from);
        if left != NONE {
            let hit = self.intersect(&RayFrame::new(ray), left);
            crossed += usize::from(hit.is_some_and(|hit| hit.t > from));
        }
        if crossed.is_multiple_of(2) {
            Crossing::Enter
        } else {
            Crossing::Leave
        }
    }

    fn contains(&self, point: DVec3, inside: &Inside) -> bool {
        let Bounds { min, max } = self.bounds;
        let is_near = point.cmpge(min).all() && point.cmple(max).all();
        is_near && self.count(&Ray::new(point, inside.dir), 0.0, f64::INFINITY) % 2 == 1
    }

    /// Sets the crossing of each root of a line.
    fn label(&self, ray: &Ray, inside: &Inside, roots: &mut [Root]) {
        let mut is_inside = false;
        for i in 0..roots.len() {
            let is_last = i + 1 == roots.len();
            let goes_in = if is_last {
                false
            } else if inside.is_closed {
                !is_inside
            } else {
                let middle = 0.5 * roots[i].t + 0.5 * roots[i + 1].t;
                self.contains(ray.at(middle), inside)
            };
            roots[i].crossing = match (is_inside, goes_in) {
                (false, true) => Crossing::Enter,
                (true, false) => Crossing::Leave,
                _ => Crossing::Touch,
            };
            is_inside = goes_in;
        }
    }
}

fn root(t: f64, face: u32, crossing: Crossing) -> Root {
    Root {
        t,
        crossing,
        face,
        is_visible: true,
    }
}

impl Geometry for Mesh {
    fn prepare(&mut self) {
        self.triangles.tree();
    }

    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let mesh = &*self.triangles;
        let frame = RayFrame::new(ray);
        let first = roots.len();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        mesh.tree().any(ray, from, to, |face| {
            let hit = mesh.intersect(&frame, face);
            roots.extend(hit.map(|hit| root(hit.t, face, Crossing::Touch)));
            false
        });
        let own = &mut roots[first..];
        own.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        if let Some(inside) = &mesh.inside {
            mesh.label(ray, inside, own);
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.nearest_beside(ray, from, to, NONE)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        if self.has_povray_planes {
            let (t, face) = self.triangles.first_on_planes(ray, to)?;
            return (from < t).then(|| root(t, face, Crossing::Touch));
        }
        let inside = self.triangles.inside.as_ref();
        if inside.is_some_and(|inside| !inside.is_closed) {
            let mut roots = Vec::new();
            self.roots(ray, &mut roots);
            roots.retain(|root| root.face != face);
            return first_visible(&roots, from, to);
        }
        let (t, hit) = self.triangles.first(ray, from, to, face)?;
        let crossing = inside.map_or(Crossing::Touch, |_| {
            self.triangles.crossing_after(ray, from, face)
        });
        Some(root(t, hit, crossing))
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        if self.has_povray_planes {
            return self.triangles.plane(face).normal.as_dvec3();
        }
        let [a, b, c] = self.triangles.corners(face);
        let size = power_of_two((b - a).abs().max((c - a).abs()).max_element());
        // With this winding `interior_texture` shows on the side where POV-Ray shows it.
        ((c - a) / size).cross((b - a) / size)
    }

    fn contains(&self, point: DVec3) -> bool {
        let inside = self.triangles.inside.as_ref();
        inside.is_some_and(|inside| self.triangles.contains(point, inside))
    }

    fn bounds(&self) -> Bounds {
        self.triangles.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let smooth = self.triangles.smooth.get(face as usize).copied();
        let smooth = smooth.filter(|smooth| *smooth != FLAT)?;
        let weights = self.weights(point, face);
        let normals = smooth.map(|normal| self.triangles.normals[normal as usize].as_dvec3());
        let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + weights[i] * normals[i]);
        (mean.is_finite() && mean != DVec3::ZERO).then_some(mean)
    }

    fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let Some(attributes) = &self.triangles.attributes else {
            return Some([0.0; 2]);
        };
        Some(attributes.uv(
            face,
            self.triangles.corners[face as usize],
            self.weights(point, face),
        ))
    }

    fn casts_shadow_of_outside(&self) -> bool {
        true
    }

    fn face_textures(&self) -> &[FaceTexture] {
        self.triangles
            .attributes
            .as_ref()
            .map_or(&[], |attributes| &attributes.textures)
    }

    fn texture_weights(&self, point: DVec3, face: u32) -> TextureWeights {
        match &self.triangles.attributes {
            Some(attributes) => attributes.texture_weights(face, || self.weights(point, face)),
            None => TextureWeights::new(),
        }
    }

    fn is_faceted(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        self.triangles.inside.is_some()
    }

    fn takes_hierarchy(&self) -> bool {
        true
    }
}

pub(super) mod attributes;
pub(super) mod build;
pub(super) mod height_field;
pub(super) mod instance;
pub(super) mod mesh2;
pub(super) mod planes;
#[cfg(test)]
mod tests;
