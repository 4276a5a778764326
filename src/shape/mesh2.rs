//! Reading `mesh2`: lists of corners and normals, and triangles by their indices, counted from zero.
//!
//! A count or an index loses what stands behind its decimal point, as in POV-Ray. Texture coordinates are checked and
//! not kept.

use super::mesh::read_inside_vector;
use super::mesh_build::{Draft, single, single_normal};
use super::{Mesh, read};
use crate::args::{Args, Parse, Word, not_built};
use crate::source::{Diagnostic, Span};
use glam::{DVec3, Vec3};

impl Mesh {
    /// Reads the lists of `mesh2` and its `inside_vector`. Degenerate triangles are left out without a word.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, counts that do not agree, indices out of range, lists out of order, no
    /// triangle at all, or textures of single triangles.
    pub fn read_mesh2(args: &mut dyn Args) -> Parse<Self> {
        let mut draft = Draft::default();
        if !args.accept(Word::VertexVectors)? {
            return Err(args.expected("`vertex_vectors` at the start of `mesh2`"));
        }
        read_vertices(args, &mut draft)?;
        let mut uv_count = 0;
        loop {
            if args.accept(Word::NormalVectors)? {
                read_normals(args, &mut draft)?;
            } else if args.accept(Word::UvVectors)? {
                uv_count = list::<2>(args, &UV_VECTORS, |_| Ok(()))?;
            } else if args.word()? == Some(Word::TextureList) {
                return Err(not_built(args, Word::TextureList));
            } else {
                break;
            }
        }
        if !args.accept(Word::FaceIndices)? {
            return Err(args.expected("`face_indices` behind the lists of vectors in `mesh2`"));
        }
        let faces_at = args.last_span();
        read_faces(args, &mut draft)?;
        read_indices(args, &mut draft, uv_count, faces_at)?;
        Ok(Mesh::new(draft.build()))
    }
}

/// A list of `mesh2`: its word, and what one item is called.
struct List {
    word: Word,
    item: &'static str,
}

const VERTICES: List = List {
    word: Word::VertexVectors,
    item: "vertex",
};
const NORMALS: List = List {
    word: Word::NormalVectors,
    item: "normal",
};
const UV_VECTORS: List = List {
    word: Word::UvVectors,
    item: "pair of texture coordinates",
};
const FACES: List = List {
    word: Word::FaceIndices,
    item: "triangle",
};
const NORMAL_INDICES: List = List {
    word: Word::NormalIndices,
    item: "triangle",
};
const UV_INDICES: List = List {
    word: Word::UvIndices,
    item: "triangle",
};

fn read_vertices(args: &mut dyn Args, draft: &mut Draft) -> Parse<()> {
    let at = args.last_span();
    let vertices = &mut draft.vertices;
    list::<3>(args, &VERTICES, |point| {
        vertices.push(single(DVec3::from(point))?);
        Ok(())
    })?;
    if draft.vertices.is_empty() {
        return Err(error(at, "a mesh needs at least one vertex"));
    }
    Ok(())
}

fn read_normals(args: &mut dyn Args, draft: &mut Draft) -> Parse<()> {
    let at = args.last_span();
    draft.normals.clear();
    let mut zeros = 0;
    list::<3>(args, &NORMALS, |normal| {
        let mut normal = single_normal(DVec3::from(normal));
        if normal == Vec3::ZERO {
            zeros += 1;
            normal = Vec3::X;
        }
        draft.normals.push(normal);
        Ok(())
    })?;
    if zeros > 0 {
        args.warn(
            Diagnostic::warning(
                at,
                "a normal of a mesh has no direction; it is taken as <1, 0, 0>",
            )
            .with_hint("make every normal longer than zero"),
        );
    }
    Ok(())
}

fn read_faces(args: &mut dyn Args, draft: &mut Draft) -> Parse<()> {
    let at = args.last_span();
    let count = draft.vertices.len();
    list::<3>(args, &FACES, |corners| {
        draft.face(indices(corners, count, "vertex", "vertices")?)
    })?;
    if draft.corners.is_empty() {
        return Err(error(at, "a mesh needs at least one triangle"));
    }
    Ok(())
}

/// What may stand behind the triangles: `normal_indices`, `uv_indices`, `inside_vector`.
fn read_indices(args: &mut dyn Args, draft: &mut Draft, uvs: usize, faces_at: Span) -> Parse<()> {
    let faces = draft.corners.len();
    let mut has_uv_indices = false;
    loop {
        if args.accept(Word::NormalIndices)? {
            let at = args.last_span();
            let count = draft.normals.len();
            let smooth = &mut draft.smooth;
            smooth.clear();
            let found = list::<3>(args, &NORMAL_INDICES, |normals| {
                smooth.push(indices(normals, count, "normal", "normals")?);
                Ok(())
            })?;
            if found > faces {
                return Err(error(
                    at,
                    format!("`normal_indices` has {found} triangles, `face_indices` only {faces}"),
                ));
            }
        } else if args.accept(Word::UvIndices)? {
            let at = args.last_span();
            has_uv_indices = true;
            let found = list::<3>(args, &UV_INDICES, |pairs| {
                indices(pairs, uvs.max(1), "uv vector", "uv vectors").map(|_| ())
            })?;
            if found != faces {
                return Err(error(
                    at,
                    format!("`uv_indices` has {found} triangles, `face_indices` has {faces}"),
                ));
            }
        } else if args.word()? == Some(Word::InsideVector) {
            read_inside_vector(args, draft)?;
        } else {
            break;
        }
    }
    let vertices = draft.vertices.len();
    if !draft.normals.is_empty() && draft.smooth.is_empty() {
        if draft.normals.len() != vertices {
            let count = draft.normals.len();
            return Err(missing(
                faces_at,
                Word::NormalIndices,
                (count, "normals"),
                vertices,
            ));
        }
        draft.smooth.clone_from(&draft.corners);
    }
    if uvs > 0 && !has_uv_indices && uvs != vertices {
        return Err(missing(
            faces_at,
            Word::UvIndices,
            (uvs, "uv vectors"),
            vertices,
        ));
    }
    Ok(())
}

fn missing(at: Span, word: Word, found: (usize, &str), vertices: usize) -> Box<Diagnostic> {
    let (count, what) = found;
    let message =
        format!("`{word}` is missing: {count} {what} cannot stand for {vertices} vertices");
    Box::new(
        Diagnostic::error(at, message)
            .with_hint(format!("give each triangle its {what} with `{word}`")),
    )
}

/// `{ count, vectors }` behind the word of a list: gives each vector to `add` and says how many there were.
fn list<const N: usize>(
    args: &mut dyn Args,
    list: &List,
    mut add: impl FnMut([f64; N]) -> Result<(), String>,
) -> Parse<usize> {
    let List { word, item } = list;
    args.open()?;
    let count = read_count(args, list)?;
    let mut found = 0;
    while found < count {
        args.literal_vectors(N, &mut |vector| {
            let is_wanted = found < count
                && <[f64; N]>::try_from(vector)
                    .is_ok_and(|vector| is_finite(&vector) && add(vector).is_ok());
            found += usize::from(is_wanted);
            is_wanted
        });
        if found == count {
            break;
        }
        args.comma()?;
        if !args.at_expression()? {
            let number = found + 1;
            return Err(args.expected(&format!("{item} {number} of {count} in `{word}`")));
        }
        let at = args.span();
        let vector: [f64; N] = one(args)?;
        let place = at.to(args.last_span());
        if !is_finite(&vector) {
            return Err(error(
                place,
                format!("{item} {} in `{word}` must be finite", found + 1),
            ));
        }
        add(vector).map_err(|fault| error(place, fault))?;
        found += 1;
    }
    args.comma()?;
    if args.accept_close()? {
        return Ok(count);
    }
    Err(args.expected(&format!("`}}` behind item {count}, the last of `{word}`")))
}

/// One vector of a list that is not literal.
fn one<const N: usize>(args: &mut dyn Args) -> Parse<[f64; N]> {
    let mut vector = [0.0; N];
    if N == 2 {
        vector.copy_from_slice(&args.vector2()?.to_array());
    } else {
        vector.copy_from_slice(&args.vector()?.to_array());
    }
    Ok(vector)
}

fn is_finite(vector: &[f64]) -> bool {
    vector.iter().all(|c| c.is_finite())
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be a whole number that fits"
)]
fn read_count(args: &mut dyn Args, list: &List) -> Parse<usize> {
    let at = args.span();
    let what = format!("the count of `{}`", list.word);
    let count = read::number(args, &what)?.trunc();
    if !(0.0..f64::from(u32::MAX)).contains(&count) {
        return Err(error(
            at.to(args.last_span()),
            format!("{what} must be zero or more, found {count}"),
        ));
    }
    Ok(count as usize)
}

/// Three indices below `count`, or which of them is not.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "checked to be a whole number below a count, and counts are below 2^32"
)]
fn indices<const N: usize>(
    given: [f64; N],
    count: usize,
    one: &str,
    many: &str,
) -> Result<[u32; N], String> {
    let mut indices = [0; N];
    for (index, value) in indices.iter_mut().zip(given) {
        let value = value.trunc();
        if !(0.0..count as f64).contains(&value) {
            return Err(out_of_range(value, count, one, many));
        }
        *index = value as u32;
    }
    Ok(indices)
}

#[cold]
fn out_of_range(value: f64, count: usize, one: &str, many: &str) -> String {
    match count {
        0 => format!("{one} {value} is out of range: this mesh has no {many}"),
        1 => format!("{one} {value} is out of range: this mesh has one, with the index 0"),
        _ => format!(
            "{one} {value} is out of range: this mesh has {count} {many}, from 0 to {}",
            count - 1
        ),
    }
}

fn error(at: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(at, message))
}
