//! `mesh` and `mesh2`: many triangles as one shape, with a tree of their own.
//!
//! Corners and normals are kept in single precision, as POV-Ray keeps them; what is computed from them is not. Copies
//! of an object share the triangles, and a transform never moves them. Error bound: that of a triangle, 2 roundings of the
//! problem's size from the plane of its corners as they are kept, and no gap at any edge (`math/watertight.rs`).
//!
//! Without `inside_vector` a mesh is a patch. With it a point is inside if a ray from it along the vector crosses an
//! odd number of triangles. If every edge belongs to an even number of triangles this is so along any line, and so
//! enter and leave alternate along a ray ([`RayFrame::crossing`] counts without fault). If not, the state between two
//! roots is that of the point midway, and outside beyond them.

use super::face_texture::{FaceTexture, TextureWeights};
use super::mesh::attributes::{Looks, NO_TRIPLE};
use super::mesh::build::{Draft, single_pair};
use super::patch::smooth_triangle::weights;
use super::{Crossing, Geometry, Root, Start, first_visible, read};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word, declared};
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

/// Triangles that share corners. Copies share all of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh(Arc<Triangles>);

/// What a mesh is made of.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    pub(super) vertices: Vec<Vec3>,
    /// For each triangle its corners in [`Triangles::vertices`].
    pub(super) corners: Vec<[u32; 3]>,
    /// Unit vectors, or zero.
    pub(super) normals: Vec<Vec3>,
    /// For each triangle the normals at its corners, or [`FLAT`]; empty if all triangles are flat.
    pub(super) smooth: Vec<[u32; 3]>,
    /// Texture coordinates and textures of triangles, if it has any.
    pub(super) looks: Option<Box<Looks>>,
    pub(super) inside: Option<Inside>,
    pub(super) bounds: Bounds,
    /// Made when the mesh is prepared for rays: one that is never seen needs none.
    pub(super) tree: OnceLock<Bvh>,
}

/// In [`Triangles::smooth`]: the normals of the triangle are that of its plane.
pub(super) const FLAT: [u32; 3] = [u32::MAX; 3];

/// No triangle.
const NONE: u32 = u32::MAX;

/// How a mesh has an inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inside {
    /// The `inside_vector`.
    pub(super) dir: DVec3,
    /// Whether every edge belongs to an even number of triangles.
    pub(super) is_closed: bool,
}

impl PartialEq for Triangles {
    /// The tree follows from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.vertices == other.vertices
            && self.corners == other.corners
            && self.normals == other.normals
            && self.smooth == other.smooth
            && self.looks == other.looks
            && self.inside == other.inside
    }
}

impl Mesh {
    pub(super) fn new(triangles: Triangles) -> Self {
        Mesh(Arc::new(triangles))
    }

    /// Reads the triangles of `mesh` and its `inside_vector`. Degenerate triangles are left out without a word.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, or no triangle at all.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let start = args.span();
        let mut draft = Draft::default();
        loop {
            if args.accept(Word::Triangle)? {
                read_triangle(args, &mut draft, Shading::Flat)?;
            } else if args.accept(Word::SmoothTriangle)? {
                read_triangle(args, &mut draft, Shading::Smooth)?;
            } else {
                break;
            }
        }
        if draft.corners.is_empty() {
            return Err(args.expected("`triangle` or `smooth_triangle` in `mesh`"));
        }
        read_inside_vector(args, &mut draft)?;
        let mesh = draft.build();
        if mesh.corners.is_empty() {
            return Err(Box::new(Diagnostic::error(
                start.to(args.last_span()),
                "all triangles of this mesh are degenerate: none is left to draw",
            )));
        }
        Ok(Mesh::new(mesh))
    }

    /// What it is made of.
    pub(super) fn triangles(&self) -> &Triangles {
        &self.0
    }

    /// The tree over its triangles.
    pub(crate) fn tree(&self) -> &Bvh {
        self.0.tree()
    }

    /// Whether it has no inside.
    pub(crate) fn is_patch(&self) -> bool {
        self.0.inside.is_none()
    }

    /// Where the whole line of a ray meets a triangle of a patch.
    #[inline(always)]
    pub(crate) fn meet(&self, frame: &RayFrame, face: u32) -> Option<f64> {
        frame.hit(&self.0.corners(face)).map(|hit| hit.t)
    }

    /// Where the whole lines of four rays meet a triangle of a patch.
    #[inline(always)]
    pub(crate) fn meet_four(
        &self,
        lanes: SimdLevel,
        rays: &RayFrames4,
        face: u32,
    ) -> TriangleHits4 {
        let corners = &self.0.corners(face);
        lanes.run(RaysAndTriangle { rays, corners })
    }

    /// The root of a patch on a triangle.
    pub(crate) fn root(t: f64, face: u32) -> Root {
        root(t, face, Crossing::Touch)
    }

    /// The weights of the corners of a triangle at a point of it.
    fn weights(&self, point: DVec3, face: u32) -> [f64; 3] {
        weights(&self.0.corners(face), self.normal(point, face), point)
    }

    /// How many triangles it has, degenerate ones not counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.corners.len()
    }

    /// Whether it has no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.corners.is_empty()
    }

    /// The memory it takes, shared by all copies.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let lists = self.0.vertices.capacity() + self.0.normals.capacity();
        let triples = self.0.corners.capacity() + self.0.smooth.capacity();
        size_of::<Triangles>()
            + lists * size_of::<Vec3>()
            + triples * size_of::<[u32; 3]>()
            + self
                .0
                .looks
                .as_ref()
                .map_or(0, |looks| size_of::<Looks>() + looks.bytes())
            + self.0.tree.get().map_or(0, Bvh::bytes)
    }
}

/// Whether a triangle of a `mesh` has normals at its corners.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shading {
    Flat,
    Smooth,
}

/// `{ corners and normals [uv_vectors] }` behind the word of a triangle.
fn read_triangle(args: &mut dyn Args, draft: &mut Draft, shading: Shading) -> Parse<()> {
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
        Shading::Flat => draft.triangle([given[0], given[1], given[2]], None),
        Shading::Smooth => draft.triangle(
            [given[0], given[2], given[4]],
            Some([given[1], given[3], given[5]]),
        ),
    };
    if let Err(fault) = added {
        let place = at.to(args.last_span());
        return Err(Box::new(Diagnostic::error(place, fault)));
    }
    if args.accept(Word::UvVectors)? {
        let mut pairs = [Vec2::ZERO; 3];
        for pair in &mut pairs {
            args.comma()?;
            *pair = single_pair(args.vector2()?);
        }
        draft.uv_of_last(pairs);
    }
    if let Some(skins) = read_skins(args, draft)? {
        draft.skins_of_last(skins);
    }
    args.close()
}

/// `texture { ... }` for a whole triangle, or `texture_list { T1 T2 T3 }` for its corners.
fn read_skins(args: &mut dyn Args, draft: &mut Draft) -> Parse<Option<[u32; 3]>> {
    if args.accept(Word::Texture)? {
        let skin = draft.skin(FaceTexture::read(args)?);
        return Ok(Some([skin; 3]));
    }
    if !args.accept(Word::TextureList)? {
        return Ok(None);
    }
    args.open()?;
    let mut skins = NO_TRIPLE;
    for skin in &mut skins {
        args.comma()?;
        let named = match declared::<Texture>(args)? {
            Some(named) => FaceTexture(named),
            None if args.accept(Word::Texture)? => FaceTexture::read(args)?,
            None => return Err(args.expected("the names of three textures in `texture_list`")),
        };
        *skin = draft.skin(named);
    }
    args.comma()?;
    args.close()?;
    Ok(Some(skins))
}

/// `inside_vector` if it stands here; the zero vector takes the inside away again.
pub(super) fn read_inside_vector(args: &mut dyn Args, draft: &mut Draft) -> Parse<()> {
    while args.accept(Word::InsideVector)? {
        let dir = read::vector(args, "the `inside_vector` of the mesh")?;
        draft.inside = (dir != DVec3::ZERO).then_some(dir);
    }
    Ok(())
}

impl Triangles {
    /// The box of a triangle.
    pub(super) fn bounds_of(&self, corners: &[u32; 3]) -> Bounds {
        // Spelt out: `map` is not always inlined.
        let [a, b, c] = *corners;
        let corner = |number: u32| self.vertices[number as usize].as_dvec3();
        let [a, b, c] = [corner(a), corner(b), corner(c)];
        Bounds::new(a, b).with_point(c)
    }

    /// Finds the bounds, when all triangles are known.
    pub(super) fn bounded(mut self) -> Self {
        let boxes = self.corners.iter().map(|corners| self.bounds_of(corners));
        self.bounds = boxes.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        self
    }

    /// The tree over the triangles. Threads that ask for it at once before it was ever made would each make one; whoever
    /// makes it holds nothing that others wait for.
    fn tree(&self) -> &Bvh {
        if let Some(tree) = self.tree.get() {
            return tree;
        }
        let tree = Bvh::build_of(self.corners.len(), |face| {
            self.bounds_of(&self.corners[face])
        });
        self.tree.get_or_init(|| tree)
    }

    // Spelt out: `map` is not always inlined.
    #[inline(always)]
    fn corners(&self, face: u32) -> [DVec3; 3] {
        let [a, b, c] = self.corners[face as usize];
        let corner = |number: u32| self.vertices[number as usize].as_dvec3();
        [corner(a), corner(b), corner(c)]
    }

    #[inline]
    fn meet(&self, frame: &RayFrame, face: u32) -> Option<TriangleHit> {
        match self.inside {
            Some(_) => frame.crossing(&self.corners(face)),
            None => frame.hit(&self.corners(face)),
        }
    }

    /// The first hit with `from < t < to` on any triangle but `but`; of several at the same `t` the first in the list.
    fn first(&self, ray: &Ray, from: f64, to: f64, but: u32) -> Option<(f64, u32)> {
        with_widest(
            #[inline(always)]
            |lanes| self.first_found(lanes, ray, (from, to), but),
        )
    }

    #[inline(always)]
    fn first_found(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        (from, to): (f64, f64),
        but: u32,
    ) -> Option<(f64, u32)> {
        let frame = RayFrame::new(ray);
        let mut best = None;
        let visit = |face, end| {
            let Some(TriangleHit { t, .. }) = self.meet(&frame, face) else {
                return end;
            };
            let is_first = match best {
                None => true,
                Some((best_t, best_face)) => t < best_t || (t == best_t && face < best_face),
            };
            if face != but && from < t && t < to && is_first {
                best = Some((t, face));
                return t;
            }
            end
        };
        self.tree().nearest_in(lanes, ray, (from, to), visit);
        best
    }

    /// How many triangles a ray crosses at `from <= t <= to`.
    fn count(&self, ray: &Ray, from: f64, to: f64) -> usize {
        let frame = RayFrame::new(ray);
        let mut count = 0;
        self.tree().any(ray, from, to, |face| {
            let hit = self.meet(&frame, face);
            count += usize::from(hit.is_some_and(|hit| from <= hit.t && hit.t <= to));
            false
        });
        count
    }

    /// What the first root of a closed mesh beyond `from` does, on any triangle but `left`, which lies behind even if
    /// it rounds to the other side.
    fn crossing_after(&self, ray: &Ray, from: f64, left: u32) -> Crossing {
        let mut passed = self.count(ray, f64::NEG_INFINITY, from);
        if left != NONE {
            let hit = self.meet(&RayFrame::new(ray), left);
            passed += usize::from(hit.is_some_and(|hit| hit.t > from));
        }
        if passed.is_multiple_of(2) {
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

    /// Says for each root of a line what happens there.
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
        self.0.tree();
    }

    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let mesh = &*self.0;
        let frame = RayFrame::new(ray);
        let first = roots.len();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        mesh.tree().any(ray, from, to, |face| {
            let hit = mesh.meet(&frame, face);
            roots.extend(hit.map(|hit| root(hit.t, face, Crossing::Touch)));
            false
        });
        let found = &mut roots[first..];
        found.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        if let Some(inside) = &mesh.inside {
            mesh.label(ray, inside, found);
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.nearest_beside(ray, from, to, NONE)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        let inside = self.0.inside.as_ref();
        if inside.is_some_and(|inside| !inside.is_closed) {
            let mut roots = Vec::new();
            self.roots(ray, &mut roots);
            roots.retain(|root| root.face != face);
            return first_visible(&roots, from, to);
        }
        let (t, hit) = self.0.first(ray, from, to, face)?;
        let crossing = inside.map_or(Crossing::Touch, |_| self.0.crossing_after(ray, from, face));
        Some(root(t, hit, crossing))
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        let [a, b, c] = self.0.corners(face);
        let size = power_of_two((b - a).abs().max((c - a).abs()).max_element());
        // This way round `interior_texture` shows on the side where POV-Ray shows it.
        ((c - a) / size).cross((b - a) / size)
    }

    fn contains(&self, point: DVec3) -> bool {
        let inside = self.0.inside.as_ref();
        inside.is_some_and(|inside| self.0.contains(point, inside))
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let smooth = self.0.smooth.get(face as usize).copied();
        let smooth = smooth.filter(|smooth| *smooth != FLAT)?;
        let shares = self.weights(point, face);
        let normals = smooth.map(|normal| self.0.normals[normal as usize].as_dvec3());
        let mean = (0..3).fold(DVec3::ZERO, |sum, i| sum + shares[i] * normals[i]);
        (mean.is_finite() && mean != DVec3::ZERO).then_some(mean)
    }

    fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let Some(looks) = &self.0.looks else {
            return Some([0.0; 2]);
        };
        Some(looks.uv(
            face,
            self.0.corners[face as usize],
            self.weights(point, face),
        ))
    }

    fn skins(&self) -> &[FaceTexture] {
        self.0.looks.as_ref().map_or(&[], |looks| &looks.skins)
    }

    fn shares(&self, point: DVec3, face: u32) -> TextureWeights {
        match &self.0.looks {
            Some(looks) => looks.shares(face, || self.weights(point, face)),
            None => TextureWeights::new(),
        }
    }

    fn is_faceted(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        self.0.inside.is_some()
    }
}

pub(super) mod attributes;
pub(super) mod build;
pub(super) mod height_field;
pub(super) mod mesh2;
pub(super) mod placed;
#[cfg(test)]
mod tests;
