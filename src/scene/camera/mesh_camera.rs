//! `mesh_camera`: rays start at the centroids of mesh triangles and follow the normals.
//!
//! One of four methods maps a pixel to a triangle. All of this is measured from POV-Ray: there the first two rows of
//! pixels use the same triangles, and so they do here. `location.z` moves ray origins along the normals; a negative
//! `direction.z` reverses the rays.

use super::{Frame, Start};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::derived::Derived;
use crate::base::math::{Bounds, Transform};
use crate::base::source::{Diagnostic, Span};
use crate::scene::shape::MeshInstance;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Largest accepted number of rays per pixel.
const MAX_RAYS: f64 = 65536.0;

/// The mapping of pixels to triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// 0: the pixel index is the triangle index; each ray of a pixel uses its own mesh.
    MeshForRay,
    /// 1: the same with the triangles of all meshes in one list. Further rays of a pixel repeat the first.
    OneList,
    /// 2: the meshes divide the width of the image equally, from left to right.
    SideBySide,
    /// 3: the image covers the unit square of texture coordinates of the first mesh.
    Coordinates,
}

const METHODS: [Method; 4] = [
    Method::MeshForRay,
    Method::OneList,
    Method::SideBySide,
    Method::Coordinates,
];

/// The meshes of a camera and their parameters.
#[derive(Clone, Debug)]
pub(super) struct MeshCamera {
    meshes: Vec<Arc<MeshInstance>>,
    method: Method,
    rays_per_pixel: usize,
    /// True if normals of smooth triangles are interpolated.
    is_smooth: bool,
    /// Offset of ray origins from the triangle, along its normal.
    offset: f64,
    is_reversed: bool,
    /// BVH over the triangles of the first mesh in texture space, built on first use.
    uv_bvh: Arc<Derived<Bvh>>,
}

/// Meshes are compared by identity.
impl PartialEq for MeshCamera {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |(a, b): (&Arc<MeshInstance>, &Arc<MeshInstance>)| Arc::ptr_eq(a, b);
        (self.method, self.rays_per_pixel, self.is_smooth)
            == (other.method, other.rays_per_pixel, other.is_smooth)
            && (self.offset, self.is_reversed) == (other.offset, other.is_reversed)
            && self.meshes.len() == other.meshes.len()
            && self.meshes.iter().zip(&other.meshes).all(is_same)
    }
}

impl MeshCamera {
    /// Reads `{ rays_per_pixel method mesh { ... } ... [smooth] }`.
    ///
    /// # Errors
    /// Malformed values, no mesh, or an invalid combination of method and rays.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Self> {
        args.open()?;
        let at = args.span();
        let rays = args.float()?.trunc();
        let at_rays = at.to(args.last_span());
        if !(1.0..=MAX_RAYS).contains(&rays) {
            let message = format!("the rays per pixel run from 1 to {MAX_RAYS}, not {rays}");
            return fault(at_rays, message);
        }
        let at = args.span();
        let number = args.float()?.trunc();
        let mut numbered = (0u32..).zip(METHODS);
        let Some((_, method)) = numbered.find(|(known, _)| f64::from(*known) == number) else {
            let message = format!("`mesh_camera` has the methods 0 to 3, not {number}");
            return fault(at.to(args.last_span()), message);
        };
        let mut meshes = Vec::new();
        while matches!(args.word()?, Some(Word::Mesh | Word::Mesh2)) {
            meshes.push(args.mesh_any()?);
        }
        let meshes: Vec<_> = meshes
            .into_iter()
            .filter_map(|mesh| mesh.downcast::<MeshInstance>().ok())
            .collect();
        if meshes.is_empty() {
            return Err(args.expected("`mesh` or `mesh2` in `mesh_camera`"));
        }
        let is_single = matches!(method, Method::SideBySide | Method::Coordinates);
        #[allow(clippy::cast_precision_loss, reason = "nobody writes 2^53 meshes")]
        let max_rays = if is_single { 1.0 } else { meshes.len() as f64 };
        if rays > max_rays && method != Method::OneList {
            let message = format!("method {number} has at most {max_rays} rays per pixel here");
            return fault(at_rays, message);
        }
        let at = args.span();
        let is_smooth = args.accept(Word::Smooth)?;
        if is_smooth && method != Method::Coordinates {
            return fault(at, "`smooth` goes only with method 3".to_owned());
        }
        args.close()?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above"
        )]
        let rays_per_pixel = if method == Method::MeshForRay {
            rays as usize
        } else {
            1
        };
        Ok(MeshCamera {
            meshes,
            method,
            rays_per_pixel,
            is_smooth,
            offset: 0.0,
            is_reversed: false,
            uv_bvh: Arc::default(),
        })
    }

    /// Applies `location` and `direction` of the camera.
    pub(super) fn apply_frame(&mut self, frame: &Frame) {
        self.offset = frame.location.z;
        self.is_reversed = frame.direction.z < 0.0;
    }

    /// Number of rays per pixel.
    pub(super) fn rays_per_pixel(&self) -> usize {
        self.rays_per_pixel
    }

    /// Multiplies all lengths by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        self.offset *= factor;
        self.transform(&Transform::scaling(DVec3::splat(factor)));
    }

    /// Transforms the meshes.
    pub(super) fn transform(&mut self, by: &Transform) {
        for instance in &mut self.meshes {
            let transform = instance.transform.then(by);
            let mesh = instance.mesh.clone();
            *instance = Arc::new(MeshInstance::new(mesh, transform));
        }
    }

    /// Origin and direction of the ray of this index at an image point.
    pub(super) fn start(&self, index: usize, raster: RasterPoint) -> Option<Start> {
        let (point, normal) = match self.method {
            Method::Coordinates => self.at_coordinates(raster.coordinates())?,
            _ => {
                let (mesh, face) = self.face(index, raster)?;
                (mesh.centroid(face), mesh.normal(face))
            }
        };
        let normal = normal.try_normalize()?;
        let origin = point + self.offset * normal;
        Some((origin, if self.is_reversed { -normal } else { normal }))
    }

    /// The triangle from which a ray starts.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "raster points are clamped to the picture, and the fraction is to be dropped"
    )]
    fn face(&self, index: usize, raster: RasterPoint) -> Option<(&MeshInstance, usize)> {
        let (column, row) = (raster.x as usize, raster.y as usize);
        let width = raster.width as usize;
        match self.method {
            Method::MeshForRay => {
                let mesh = self.meshes.get(index)?;
                let face = row * width + column;
                (face < mesh.len()).then_some((mesh, face))
            }
            Method::SideBySide => {
                let strip_width = raster.width / self.meshes.len() as f64;
                let mesh = self.meshes.get((raster.x / strip_width) as usize)?;
                let face = row * strip_width as usize + column;
                (face < mesh.len()).then_some((mesh, face))
            }
            Method::OneList | Method::Coordinates => {
                let mut face = row * width + column;
                for mesh in &self.meshes {
                    if face < mesh.len() {
                        return Some((mesh, face));
                    }
                    face -= mesh.len();
                }
                None
            }
        }
    }

    /// The point with these texture coordinates, on the first triangle that contains them, and its normal.
    fn at_coordinates(&self, at: DVec2) -> Option<(DVec3, DVec3)> {
        let mesh = self.meshes.first()?;
        let bvh = self.uv_bvh.get_or_init(|| {
            Bvh::build_of(mesh.len(), |face| {
                let [a, b, c] = mesh.coordinates(face).map(|uv| uv.extend(0.0));
                Bounds::new(a, b).with_point(c)
            })
        });
        let mut best: Option<(u32, [f64; 3])> = None;
        bvh.visit_containing(at.extend(0.0), |face| {
            if best.is_none_or(|(before, _)| face < before)
                && let Some(weights) = barycentric(mesh.coordinates(face as usize), at)
            {
                best = Some((face, weights));
            }
            false
        });
        let (face, weights) = best?;
        let face = face as usize;
        let mean = |of: [DVec3; 3]| (0..3).fold(DVec3::ZERO, |sum, i| sum + weights[i] * of[i]);
        let smooth = mesh.normals(face).filter(|_| self.is_smooth).map(mean);
        let normal = smooth.map(|normal| mesh.transform.normal(normal));
        Some((
            mean(mesh.corners(face)),
            normal.unwrap_or_else(|| mesh.normal(face)),
        ))
    }
}

/// Barycentric coordinates of a point in a triangle; `None` outside. A point on an edge shared by two triangles is in
/// at least one of them: the edge's areas differ only in sign.
fn barycentric(corners: [DVec2; 3], at: DVec2) -> Option<[f64; 3]> {
    let [a, b, c] = corners.map(|corner| corner - at);
    let areas = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let sum: f64 = areas.iter().sum();
    let is_inside = sum != 0.0 && areas.iter().all(|area| area / sum >= 0.0);
    is_inside.then(|| areas.map(|area| area / sum))
}

/// An image point in POV-Ray's raster coordinates for this camera, clamped to the image.
#[derive(Clone, Copy, Debug)]
pub(super) struct RasterPoint {
    /// Column, half a pixel to the right of the pixel-centre convention.
    x: f64,
    /// Row, half a pixel above the pixel-centre convention.
    y: f64,
    width: f64,
    height: f64,
}

impl RasterPoint {
    /// The raster point of an image point, for which integers are pixel centres.
    pub(super) fn new(x: f64, y: f64, width: u32, height: u32) -> Self {
        let (width, height) = (f64::from(width), f64::from(height));
        RasterPoint {
            x: (x + 0.5).clamp(0.0, width - 1.0),
            y: (y - 0.5).clamp(0.0, height - 1.0),
            width,
            height,
        }
    }

    /// Texture coordinates of this image point.
    fn coordinates(self) -> DVec2 {
        DVec2::new(
            (self.x - 0.5) / self.width,
            1.0 - (self.y + 0.5) / self.height,
        )
    }
}

fn fault<T>(at: Span, message: String) -> Parse<T> {
    Err(Box::new(Diagnostic::error(at, message)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::shape::Mesh;

    /// Triangles with centroids <i+1, 1, 0> that face along z.
    fn row(count: u32, shift: f64) -> Arc<MeshInstance> {
        let triangle = |i| format!("triangle {{ <{i},0,0>, <{i},3,0>, <{}, 0, 0> }}", i + 3);
        let text: String = (0..count).map(triangle).collect();
        let mesh = Mesh::read(&mut TextArgs::new(&text)).unwrap();
        let transform = Transform::translation(DVec3::Z * shift);
        Arc::new(MeshInstance::new(mesh, transform))
    }

    fn camera(method: Method, meshes: Vec<Arc<MeshInstance>>) -> MeshCamera {
        MeshCamera {
            meshes,
            method,
            rays_per_pixel: 1,
            is_smooth: false,
            offset: 0.0,
            is_reversed: false,
            uv_bvh: Arc::default(),
        }
    }

    fn origin(camera: &MeshCamera, x: f64, y: f64) -> Option<[f64; 3]> {
        let (origin, dir) = camera.start(0, RasterPoint::new(x, y, 4, 3))?;
        assert_eq!(dir, DVec3::Z);
        Some(origin.to_array())
    }

    #[test]
    fn the_first_two_rows_use_the_same_triangles() {
        let camera = camera(Method::MeshForRay, vec![row(7, 0.0)]);
        assert_eq!(origin(&camera, 1.0, 0.0), Some([2.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 1.0, 1.0), Some([2.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 2.0, 2.0), Some([7.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 3.0, 2.0), None);
    }

    #[test]
    fn one_list_continues_with_the_next_mesh() {
        let camera = camera(Method::OneList, vec![row(3, 0.0), row(3, 5.0)]);
        assert_eq!(origin(&camera, 3.0, 0.0), Some([1.0, 1.0, 5.0]));
    }

    #[test]
    fn meshes_side_by_side_use_columns_of_the_whole_image() {
        // POV-Ray 3.7 with three meshes and four columns.
        let meshes = vec![row(9, 0.0), row(9, 5.0), row(9, 7.0)];
        let camera = camera(Method::SideBySide, meshes);
        let origins = [0.0, 1.0, 2.0, 3.0].map(|x| origin(&camera, x, 2.0));
        let expected = [[2.0, 0.0], [3.0, 5.0], [4.0, 5.0], [5.0, 7.0]];
        assert_eq!(origins, expected.map(|[x, z]| Some([x, 1.0, z])));
    }

    #[test]
    fn a_negative_direction_reverses_the_ray_but_not_its_offset() {
        let mut camera = camera(Method::MeshForRay, vec![row(9, 0.0)]);
        (camera.offset, camera.is_reversed) = (0.25, true);
        let start = camera.start(0, RasterPoint::new(0.0, 0.0, 4, 3));
        assert_eq!(start, Some((DVec3::new(1.0, 1.0, 0.25), -DVec3::Z)));
    }

    #[test]
    fn texture_coordinates_map_to_a_point_of_a_triangle() {
        let text = "triangle { <0,0,0>, <0,300,0>, <300,0,0> uv_vectors <0, 0>, <0, 1>, <1, 0> }";
        let mesh = Mesh::read(&mut TextArgs::new(text)).unwrap();
        let mesh = Arc::new(MeshInstance::new(mesh, Transform::IDENTITY));
        let camera = camera(Method::Coordinates, vec![mesh]);
        let at = |x, y| origin(&camera, x, y).map(|origin| origin[0]);
        // The last column is clamped, half a pixel nearer to the one before.
        assert_eq!((at(2.0, 2.0), at(3.0, 2.0)), (Some(150.0), Some(187.5)));
        assert_eq!(at(3.0, 1.0), None);
    }
}
