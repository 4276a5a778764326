//! `mesh_camera`: the triangles of meshes send the rays, each from its middle along its normal.
//!
//! Which triangle a pixel asks follows from its place by one of four methods (measured, as is all that is here). In
//! POV-Ray's count of pixels the first two rows are one, and so are here. `location.z` moves the start of rays along
//! the normals; a `direction.z` below 0 turns rays round.

use super::{Frame, Start};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Transform};
use crate::base::source::{Diagnostic, Span};
use crate::scene::shape::PlacedMesh;
use glam::{DVec2, DVec3};
use std::sync::{Arc, OnceLock};

/// Rays of one pixel: no scene wants more meshes.
const MOST_RAYS: f64 = 65536.0;

/// How the pixels of a picture share out the triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// 0: the number of the pixel is that of the triangle; each ray of a pixel has a mesh of its own.
    MeshForRay,
    /// 1: the same with all meshes in one list. Further rays of a pixel see what the first sees.
    OneList,
    /// 2: meshes have a share each of the width of the picture, from left to right.
    SideBySide,
    /// 3: the picture is the square of texture coordinates of the first mesh.
    Coordinates,
}

const METHODS: [Method; 4] = [
    Method::MeshForRay,
    Method::OneList,
    Method::SideBySide,
    Method::Coordinates,
];

/// The meshes of a camera, and how it looks out of them.
#[derive(Clone, Debug)]
pub(super) struct MeshCamera {
    meshes: Vec<Arc<PlacedMesh>>,
    method: Method,
    /// Rays of a pixel.
    rays: u32,
    /// Whether normals are those of smooth triangles.
    is_smooth: bool,
    /// How far from a triangle, along its normal, rays start.
    offset: f64,
    is_turned: bool,
    /// The triangles of the first mesh in the square of texture coordinates, made when they are first asked for.
    map: Arc<OnceLock<Bvh>>,
}

/// Cameras are the same if they come from the same meshes.
impl PartialEq for MeshCamera {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |(a, b): (&Arc<PlacedMesh>, &Arc<PlacedMesh>)| Arc::ptr_eq(a, b);
        (self.method, self.rays, self.is_smooth) == (other.method, other.rays, other.is_smooth)
            && (self.offset, self.is_turned) == (other.offset, other.is_turned)
            && self.meshes.len() == other.meshes.len()
            && self.meshes.iter().zip(&other.meshes).all(is_same)
    }
}

impl MeshCamera {
    /// Reads `{ rays_per_pixel method mesh { ... } ... [smooth] }`.
    ///
    /// # Errors
    /// Malformed values, no mesh, or numbers that do not go together.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Self> {
        args.open()?;
        let at = args.span();
        let rays = args.float()?.trunc();
        let at_rays = at.to(args.last_span());
        if !(1.0..=MOST_RAYS).contains(&rays) {
            let message = format!("the rays per pixel run from 1 to {MOST_RAYS}, not {rays}");
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
            .filter_map(|mesh| mesh.downcast::<PlacedMesh>().ok())
            .collect();
        if meshes.is_empty() {
            return Err(args.expected("`mesh` or `mesh2` in `mesh_camera`"));
        }
        let is_single = matches!(method, Method::SideBySide | Method::Coordinates);
        #[allow(clippy::cast_precision_loss, reason = "nobody writes 2^53 meshes")]
        let most = if is_single { 1.0 } else { meshes.len() as f64 };
        if rays > most && method != Method::OneList {
            let message = format!("method {number} has at most {most} rays per pixel here");
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
        let rays = if method == Method::MeshForRay {
            rays as u32
        } else {
            1
        };
        Ok(MeshCamera {
            meshes,
            method,
            rays,
            is_smooth,
            offset: 0.0,
            is_turned: false,
            map: Arc::default(),
        })
    }

    /// Takes what the vectors of the camera say.
    pub(super) fn look(&mut self, frame: &Frame) {
        self.offset = frame.location.z;
        self.is_turned = frame.direction.z < 0.0;
    }

    /// How many rays a pixel has.
    pub(super) fn rays(&self) -> u32 {
        self.rays
    }

    /// The same in a place of the world that is larger by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        self.offset *= factor;
        self.transform(&Transform::scaling(DVec3::splat(factor)));
    }

    /// Moves its meshes.
    pub(super) fn transform(&mut self, by: &Transform) {
        for mesh in &mut self.meshes {
            let place = mesh.place.then(by);
            let mesh_of = mesh.mesh.clone();
            *mesh = Arc::new(PlacedMesh::new(mesh_of, place));
        }
    }

    /// Where the ray of this number of a place of a picture starts, and where it goes.
    pub(super) fn start(&self, number: u32, place: Place) -> Option<Start> {
        let (point, normal) = match self.method {
            Method::Coordinates => self.at_coordinates(place.coordinates())?,
            _ => {
                let (mesh, face) = self.face(number, place)?;
                let corners = mesh.corners(face);
                (
                    (corners[0] + corners[1] + corners[2]) / 3.0,
                    mesh.normal(face),
                )
            }
        };
        let normal = normal.try_normalize()?;
        let origin = point + self.offset * normal;
        Some((origin, if self.is_turned { -normal } else { normal }))
    }

    /// The triangle of a ray.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "places are held within the picture, and the part behind the point is to go"
    )]
    fn face(&self, number: u32, place: Place) -> Option<(&PlacedMesh, usize)> {
        let (column, row) = (place.x as usize, place.y as usize);
        let width = place.width as usize;
        match self.method {
            Method::MeshForRay => {
                let mesh = self.meshes.get(number as usize)?;
                let face = row * width + column;
                (face < mesh.len()).then_some((mesh, face))
            }
            Method::SideBySide => {
                let share = place.width / self.meshes.len() as f64;
                let mesh = self.meshes.get((place.x / share) as usize)?;
                let face = row * share as usize + column;
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

    /// The point with these texture coordinates, on the first triangle that has them, and the normal there.
    fn at_coordinates(&self, at: DVec2) -> Option<(DVec3, DVec3)> {
        let mesh = self.meshes.first()?;
        let map = self.map.get_or_init(|| {
            Bvh::build_of(mesh.len(), |face| {
                let [a, b, c] = mesh.coordinates(face).map(|uv| uv.extend(0.0));
                Bounds::new(a, b).with_point(c)
            })
        });
        let mut best: Option<(u32, [f64; 3])> = None;
        map.around(at.extend(0.0), |face| {
            if best.is_none_or(|(before, _)| face < before)
                && let Some(shares) = shares(mesh.coordinates(face as usize), at)
            {
                best = Some((face, shares));
            }
            false
        });
        let (face, shares) = best?;
        let face = face as usize;
        let mean = |of: [DVec3; 3]| (0..3).fold(DVec3::ZERO, |sum, i| sum + shares[i] * of[i]);
        let smooth = mesh.normals(face).filter(|_| self.is_smooth).map(mean);
        let normal = smooth.map(|normal| mesh.place.normal(normal));
        Some((
            mean(mesh.corners(face)),
            normal.unwrap_or_else(|| mesh.normal(face)),
        ))
    }
}

/// The shares of the corners of a triangle in a point of it; `None` outside. A point on a common edge is in one of the
/// two at least: the areas at it differ only in sign.
fn shares(corners: [DVec2; 3], at: DVec2) -> Option<[f64; 3]> {
    let [a, b, c] = corners.map(|corner| corner - at);
    let areas = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let sum: f64 = areas.iter().sum();
    let is_inside = sum != 0.0 && areas.iter().all(|area| area / sum >= 0.0);
    is_inside.then(|| areas.map(|area| area / sum))
}

/// A point of a picture as POV-Ray counts it here, held within the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Columns, half of one to the right of the centre of a pixel.
    x: f64,
    /// Rows, half of one above it.
    y: f64,
    width: f64,
    height: f64,
}

impl Place {
    /// The place of a point; whole numbers are centres of pixels.
    pub(super) fn new(x: f64, y: f64, width: u32, height: u32) -> Self {
        let (width, height) = (f64::from(width), f64::from(height));
        Place {
            x: (x + 0.5).clamp(0.0, width - 1.0),
            y: (y - 0.5).clamp(0.0, height - 1.0),
            width,
            height,
        }
    }

    /// The texture coordinates that are asked for here.
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

    /// Triangles with the middles <i+1, 1, 0> that look along z.
    fn row(count: u32, shift: f64) -> Arc<PlacedMesh> {
        let triangle = |i| format!("triangle {{ <{i},0,0>, <{i},3,0>, <{}, 0, 0> }}", i + 3);
        let text: String = (0..count).map(triangle).collect();
        let mesh = Mesh::read(&mut TextArgs::new(&text)).unwrap();
        let place = Transform::translation(DVec3::Z * shift);
        Arc::new(PlacedMesh::new(mesh, place))
    }

    fn camera(method: Method, meshes: Vec<Arc<PlacedMesh>>) -> MeshCamera {
        MeshCamera {
            meshes,
            method,
            rays: 1,
            is_smooth: false,
            offset: 0.0,
            is_turned: false,
            map: Arc::default(),
        }
    }

    fn origin(camera: &MeshCamera, x: f64, y: f64) -> Option<[f64; 3]> {
        let (origin, dir) = camera.start(0, Place::new(x, y, 4, 3))?;
        assert_eq!(dir, DVec3::Z);
        Some(origin.to_array())
    }

    #[test]
    fn the_first_two_rows_are_one() {
        let camera = camera(Method::MeshForRay, vec![row(7, 0.0)]);
        assert_eq!(origin(&camera, 1.0, 0.0), Some([2.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 1.0, 1.0), Some([2.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 2.0, 2.0), Some([7.0, 1.0, 0.0]));
        assert_eq!(origin(&camera, 3.0, 2.0), None);
    }

    #[test]
    fn one_list_goes_on_with_the_next_mesh() {
        let camera = camera(Method::OneList, vec![row(3, 0.0), row(3, 5.0)]);
        assert_eq!(origin(&camera, 3.0, 0.0), Some([1.0, 1.0, 5.0]));
    }

    #[test]
    fn meshes_side_by_side_count_the_columns_of_the_whole_picture() {
        // POV-Ray 3.7 with three meshes and four columns.
        let meshes = vec![row(9, 0.0), row(9, 5.0), row(9, 7.0)];
        let camera = camera(Method::SideBySide, meshes);
        let found = [0.0, 1.0, 2.0, 3.0].map(|x| origin(&camera, x, 2.0));
        let expected = [[2.0, 0.0], [3.0, 5.0], [4.0, 5.0], [5.0, 7.0]];
        assert_eq!(found, expected.map(|[x, z]| Some([x, 1.0, z])));
    }

    #[test]
    fn a_direction_backwards_turns_the_ray_and_not_its_start() {
        let mut camera = camera(Method::MeshForRay, vec![row(9, 0.0)]);
        (camera.offset, camera.is_turned) = (0.25, true);
        let start = camera.start(0, Place::new(0.0, 0.0, 4, 3));
        assert_eq!(start, Some((DVec3::new(1.0, 1.0, 0.25), -DVec3::Z)));
    }

    #[test]
    fn texture_coordinates_lead_to_a_point_of_a_triangle() {
        let text = "triangle { <0,0,0>, <0,300,0>, <300,0,0> uv_vectors <0, 0>, <0, 1>, <1, 0> }";
        let mesh = Mesh::read(&mut TextArgs::new(text)).unwrap();
        let mesh = Arc::new(PlacedMesh::new(mesh, Transform::IDENTITY));
        let camera = camera(Method::Coordinates, vec![mesh]);
        let at = |x, y| origin(&camera, x, y).map(|origin| origin[0]);
        // The last column is half a pixel nearer.
        assert_eq!((at(2.0, 2.0), at(3.0, 2.0)), (Some(150.0), Some(187.5)));
        assert_eq!(at(3.0, 1.0), None);
    }
}
