//! Objects made of arrays, one for each row.

use super::session::model_of;
use super::value_error;
use glam::DVec3;
use povr::base::color::Color;
use povr::base::options::ReadOptions;
use povr::scene::shape::{Cylinder, Mesh, Shape, Sphere};
use povr::scene::texture::Texture;
use povr::scene::{Object, Objects};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Rows of numbers in native byte order, with the attributes that all objects share.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Rows {
    /// `sphere`: centre and radius; `cylinder` and `open cylinder`: both ends and radius; `mesh`: a vertex. In double
    /// precision.
    kind: String,
    numbers: PyBackedBytes,
    /// A text whose last object has the attributes.
    model: String,
    /// Red, green, blue, filter and transmit of each object or triangle, in single precision.
    colors: Option<PyBackedBytes>,
    /// Of a mesh, the indices of the vertices of each triangle, of 32 bits.
    faces: Option<PyBackedBytes>,
    /// Of a mesh, the normals of its vertices, in double precision.
    normals: Option<PyBackedBytes>,
}

/// Adds objects to those of a scene.
pub(crate) type Add = Box<dyn Fn(&mut Objects) + Send + Sync>;

impl Rows {
    /// Checks the numbers, reads the attributes, and returns the function that adds the objects.
    pub(crate) fn added(self, read: &ReadOptions) -> PyResult<Add> {
        let model = model_of(&self.model, read)?;
        match self.kind.as_str() {
            "sphere" => {
                let sphere = |[x, y, z, radius]: [f64; 4]| {
                    let centre = DVec3::new(x, y, z);
                    let radius = radius.abs();
                    Some(Shape::Sphere(Sphere { centre, radius }))
                };
                self.each(model, sphere)
            }
            "cylinder" => self.each(model, |row| cylinder(row).map(Shape::Cylinder)),
            "open cylinder" => self.each(model, |row| {
                cylinder(row).map(|closed| Shape::Cylinder(closed.open()))
            }),
            "mesh" => self.mesh(&model),
            other => Err(value_error(&format!("no array makes a `{other}`"))),
        }
    }

    /// One object for each row.
    fn each<const N: usize>(
        self,
        model: Arc<Object>,
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
        Ok(Box::new(move |objects| {
            let numbers = rows(&self.numbers);
            let shape = |index: usize| shape(&numbers[index]).expect("all rows were checked");
            match self.colors.as_deref().map(rows::<4, 5>) {
                None => objects.extend_like(&model, numbers.len(), shape, None),
                Some(colors) => {
                    let color = |index: usize| color(&colors[index]);
                    objects.extend_like(&model, numbers.len(), shape, Some(&color));
                }
            }
        }))
    }

    /// One mesh of all triangles.
    fn mesh(self, model: &Arc<Object>) -> PyResult<Add> {
        let vertices = points(&self.numbers);
        let normals = self.normals.as_deref().map(points);
        let faces = self
            .faces
            .as_deref()
            .map(rows::<4, 3>)
            .unwrap_or_default()
            .iter();
        let faces: Vec<[u32; 3]> = faces.map(|face| face.map(u32::from_ne_bytes)).collect();
        let own = model.texture.as_ref().map(|own| &own.what);
        let palette = own.and_then(|own| Some(Palette::of(own, self.colors.as_deref()?)));
        let Palette {
            textures, of_rows, ..
        } = palette.unwrap_or_default();
        let mesh = Mesh::from_lists(&vertices, normals.as_deref(), &faces, textures, of_rows);
        let mesh = mesh.map_err(|fault| value_error(&fault))?;
        let model = Arc::clone(model);
        Ok(Box::new(move |objects| {
            objects.extend_like(&model, 1, |_| Shape::Mesh(mesh.clone()), None);
        }))
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
