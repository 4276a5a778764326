//! Objects made of arrays, one for each row.
//!
//! Each array has a model at the end of the scene's text: a sphere, or for triangles a mesh, with the attributes that
//! its objects share. The models are taken out of the scene as soon as it has been read.

use super::value_error;
use glam::DVec3;
use povr::base::color::Color;
use povr::scene::shape::{Cylinder, Mesh, MeshLists, Shape, Sphere};
use povr::scene::texture::Texture;
use povr::scene::{Kind, Object, Objects};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use rustc_hash::FxHashMap;
use std::sync::{Arc, OnceLock};

/// Rows of numbers in native byte order.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Rows {
    /// `sphere`: centre and radius; `cylinder` and `open cylinder`: both ends and radius; `mesh`: a vertex. In double
    /// precision.
    kind: String,
    numbers: PyBackedBytes,
    /// Red, green, blue, filter and transmit of each object or triangle, in single precision.
    colors: Option<PyBackedBytes>,
    /// Of a mesh, the indices of the vertices of each triangle, of 32 bits.
    faces: Option<PyBackedBytes>,
    /// Of a mesh, the normals of its vertices, in double precision.
    normals: Option<PyBackedBytes>,
}

/// Adds the objects of an array, like its model, to those of a scene. The error is the reason why it cannot.
type Add = Box<dyn Fn(&Object, &mut Objects) -> Result<(), String> + Send + Sync>;

/// The reason why an array has no model.
const NO_MODEL: &str = "the attributes of an array end its object: they are what its braces hold, with braces in pairs";

/// Checks arrays and returns the function that puts their objects in the place of their models.
///
/// # Errors
/// `ValueError` for rows that make no object, or lists of unlike length.
pub(crate) fn adding(
    arrays: Vec<Rows>,
) -> PyResult<impl Fn(&mut Objects) -> Result<(), String> + Send + Sync> {
    let arrays: PyResult<Vec<Add>> = arrays.into_iter().map(Rows::checked).collect();
    let arrays = arrays?;
    Ok(move |objects: &mut Objects| {
        let mut models: Vec<_> = arrays.iter().map_while(|_| objects.pop()).collect();
        if models.len() < arrays.len() {
            return Err(NO_MODEL.to_owned());
        }
        let mut arrays = arrays.iter();
        arrays.try_for_each(|add| match models.pop() {
            Some(model) => add(&model, objects),
            None => Ok(()),
        })
    })
}

impl Rows {
    fn checked(self) -> PyResult<Add> {
        let count = match self.kind.as_str() {
            "mesh" => self
                .faces
                .as_deref()
                .map_or(0, |faces| rows::<4, 3>(faces).len()),
            "sphere" => rows::<8, 4>(&self.numbers).len(),
            _ => rows::<8, 7>(&self.numbers).len(),
        };
        let colors = self
            .colors
            .as_deref()
            .map_or(count, |colors| rows::<4, 5>(colors).len());
        if colors != count {
            let message = format!("there are {colors} colors for {count} objects or triangles");
            return Err(value_error(&message));
        }
        match self.kind.as_str() {
            "sphere" => self.each(|[x, y, z, radius]: [f64; 4]| {
                let centre = DVec3::new(x, y, z);
                let radius = radius.abs();
                Some(Shape::Sphere(Sphere { centre, radius }))
            }),
            "cylinder" => self.each(|row| cylinder(row).map(Shape::Cylinder)),
            "open cylinder" => {
                self.each(|row| cylinder(row).map(|closed| Shape::Cylinder(closed.open())))
            }
            "mesh" => self.mesh(),
            other => Err(value_error(&format!("no array makes a `{other}`"))),
        }
    }

    /// One object for each row.
    fn each<const N: usize>(
        self,
        shape: impl Fn([f64; N]) -> Option<Shape> + Send + Sync + 'static,
    ) -> PyResult<Add> {
        let shape = move |row: &[[u8; 8]; N]| shape(row.map(f64::from_ne_bytes));
        let mut numbers = rows::<8, N>(&self.numbers).iter();
        if let Some(at) = numbers.position(|row| shape(row).is_none()) {
            return Err(value_error(&format!(
                "row {at}, counted from 0, makes no {}",
                self.kind
            )));
        }
        Ok(Box::new(move |model, objects| {
            let Some(Shape::Sphere(_)) = shape_of(model) else {
                return Err(NO_MODEL.to_owned());
            };
            let numbers = rows(&self.numbers);
            let shape = |index: usize| shape(&numbers[index]).expect("all rows were checked");
            match self.colors.as_deref().map(rows::<4, 5>) {
                None => objects.extend_like(model, numbers.len(), shape, None),
                Some(colors) => {
                    let color = |index: usize| color(&colors[index]);
                    objects.extend_like(model, numbers.len(), shape, Some(&color));
                }
            }
            Ok(())
        }))
    }

    /// One mesh of all triangles.
    fn mesh(self) -> PyResult<Add> {
        let (vertices, normals) = (&self.numbers, self.normals.as_deref());
        let vertices = rows::<8, 3>(vertices).len();
        let normals = normals.map_or(vertices, |normals| rows::<8, 3>(normals).len());
        if normals != vertices {
            let message = format!("there are {normals} normals for {vertices} vertices");
            return Err(value_error(&message));
        }
        // Frames share the mesh and its BVH, unless it has colours, whose textures may follow the clock.
        let shared = OnceLock::<Mesh>::new();
        Ok(Box::new(move |model, objects| {
            let Some(Shape::Mesh(own)) = shape_of(model) else {
                return Err(NO_MODEL.to_owned());
            };
            let inside = own.inside_vector();
            let known = shared.get().filter(|mesh| mesh.inside_vector() == inside);
            let mesh = match known {
                Some(mesh) => mesh.clone(),
                None => self.mesh_like(model, inside)?,
            };
            if self.colors.is_none() {
                let _ = shared.set(mesh.clone());
            }
            objects.extend_like(model, 1, |_| Shape::Mesh(mesh.clone()), None);
            Ok(())
        }))
    }

    fn mesh_like(&self, model: &Object, inside_vector: Option<DVec3>) -> Result<Mesh, String> {
        let faces = self.faces.as_deref().map(rows::<4, 3>).unwrap_or_default();
        let faces: Vec<[u32; 3]> = faces
            .iter()
            .map(|face| face.map(u32::from_ne_bytes))
            .collect();
        let own = model.texture.as_ref().map(|own| &own.what);
        let palette = own.and_then(|own| Some(Palette::of(own, self.colors.as_deref()?)));
        let palette = palette.unwrap_or_default();
        Mesh::from_lists(&MeshLists {
            vertices: &points(&self.numbers),
            normals: self.normals.as_deref().map(points).as_deref(),
            faces: &faces,
            textures: &palette.textures,
            texture_of_face: &palette.of_rows,
            inside_vector,
        })
    }
}

/// The shape of an object that has one.
fn shape_of(object: &Object) -> Option<&Shape> {
    match &object.kind {
        Kind::Shape(shape) => Some(shape),
        _ => None,
    }
}

/// The cylinder between two ends; `None` if they coincide.
fn cylinder([x, y, z, to_x, to_y, to_z, radius]: [f64; 7]) -> Option<Cylinder> {
    Cylinder::new(DVec3::new(x, y, z), DVec3::new(to_x, to_y, to_z), radius)
}

/// A texture in the colours of many rows, of which equal ones share one.
#[derive(Default)]
struct Palette {
    textures: Vec<Arc<Texture>>,
    of_rows: Vec<u32>,
    known: FxHashMap<[[u8; 4]; 5], u32>,
}

impl Palette {
    fn of(own: &Texture, colors: &[u8]) -> Self {
        let mut palette = Palette::default();
        for row in rows::<4, 5>(colors) {
            let next = u32::try_from(palette.textures.len()).unwrap_or(u32::MAX);
            let index = *palette.known.entry(*row).or_insert(next);
            if index == next {
                palette.textures.push(Arc::new(own.with_color(color(row))));
            }
            palette.of_rows.push(index);
        }
        palette
    }
}

fn color(row: &[[u8; 4]; 5]) -> Color {
    Color::from_components(row.map(|bytes| f32::from_ne_bytes(bytes).into()))
}

/// Rows of `N` numbers of `BYTES` bytes.
fn rows<const BYTES: usize, const N: usize>(bytes: &[u8]) -> &[[[u8; BYTES]; N]] {
    bytes.as_chunks().0.as_chunks().0
}

/// Points in double precision.
fn points(bytes: &[u8]) -> Vec<DVec3> {
    let rows = rows::<8, 3>(bytes).iter();
    rows.map(|row| DVec3::from_array(row.map(f64::from_ne_bytes)))
        .collect()
}
