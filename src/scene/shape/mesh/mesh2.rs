//! Parser for `mesh2`: lists of vertices and normals, and triangles by zero-based indices.
//!
//! Counts and indices are truncated to integers, as in POV-Ray. A triangle may be followed by the index of its texture,
//! or by those of its three corners.

use super::attributes::{UvOf, only};
use super::build::{MeshBuilder, single, single_normal, single_pair};
use super::read_inside_vector;
use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::scene::shape::face_texture::FaceTexture;
use crate::scene::shape::{Mesh, read};
use glam::{DVec2, DVec3, Vec3};

impl Mesh {
    /// Reads the lists of `mesh2` and its `inside_vector`. Degenerate triangles are dropped silently.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, counts that do not agree, indices out of range, lists out of order, or no
    /// triangle at all.
    pub fn read_mesh2(args: &mut dyn Args) -> Parse<Self> {
        let mut builder = MeshBuilder::default();
        if !args.accept(Word::VertexVectors)? {
            return Err(args.expected("`vertex_vectors` at the start of `mesh2`"));
        }
        read_vertices(args, &mut builder)?;
        // Of lists that are written twice the last one counts.
        loop {
            if args.accept(Word::VertexVectors)? {
                read_vertices(args, &mut builder)?;
            } else if args.accept(Word::NormalVectors)? {
                read_normals(args, &mut builder)?;
            } else if args.accept(Word::UvVectors)? {
                read_uvs(args, &mut builder)?;
            } else if args.accept(Word::TextureList)? {
                read_textures(args, &mut builder)?;
            } else {
                break;
            }
        }
        if !args.accept(Word::FaceIndices)? {
            return Err(args.expected("`face_indices` after the lists of vectors in `mesh2`"));
        }
        let faces_at = args.last_span();
        read_faces(args, &mut builder)?;
        read_indices(args, &mut builder, faces_at)?;
        Ok(Mesh::new(builder.build()))
    }
}

/// A list of `mesh2`: its keyword, and the name of one item in messages.
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
const TEXTURES: List = List {
    word: Word::TextureList,
    item: "texture",
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

fn read_vertices(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    let at = args.last_span();
    let vertices = &mut builder.vertices;
    vertices.clear();
    list::<3>(args, &VERTICES, |point| {
        vertices.push(single(DVec3::from(point))?);
        Ok(())
    })?;
    if builder.vertices.is_empty() {
        return Err(error(at, "a mesh needs at least one vertex"));
    }
    Ok(())
}

fn read_normals(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    let at = args.last_span();
    builder.normals.clear();
    let mut zeros = 0;
    list::<3>(args, &NORMALS, |normal| {
        let mut normal = single_normal(DVec3::from(normal));
        if normal == Vec3::ZERO {
            zeros += 1;
            normal = Vec3::X;
        }
        builder.normals.push(normal);
        Ok(())
    })?;
    if zeros > 0 {
        args.warn(
            Diagnostic::warning(
                at,
                "a normal of a mesh has no direction; it is taken as <1, 0, 0>",
            )
            .with_hint("Make every normal longer than zero."),
        );
    }
    Ok(())
}

fn read_uvs(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    let uvs = &mut builder.attributes.uvs;
    uvs.clear();
    list::<2>(args, &UV_VECTORS, |pair| {
        uvs.push(single_pair(DVec2::from(pair)));
        Ok(())
    })?;
    Ok(())
}

/// Reads `{ count, texture { ... }, ... }`.
fn read_textures(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    args.open()?;
    let count = read_count(args, &TEXTURES)?;
    builder.attributes.textures.clear();
    for number in 1..=count {
        args.comma()?;
        if !args.accept(Word::Texture)? {
            let what = format!("`texture` {number} of {count} in `texture_list`");
            return Err(args.expected(&what));
        }
        builder.attributes.textures.push(FaceTexture::read(args)?);
    }
    close_list(args, &TEXTURES, count)
}

fn read_faces(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    let at = args.last_span();
    let count = builder.vertices.len();
    if builder.attributes.textures.is_empty() {
        list::<3>(args, &FACES, |corners| {
            builder.face(indices(corners, count, "vertex", "vertices")?)
        })?;
    } else {
        read_textured_faces(args, builder)?;
    }
    if builder.corners.is_empty() {
        return Err(error(at, "a mesh needs at least one triangle"));
    }
    Ok(())
}

/// Reads triangles that may each be followed by one or three texture indices.
fn read_textured_faces(args: &mut dyn Args, builder: &mut MeshBuilder) -> Parse<()> {
    let vertex_count = builder.vertices.len();
    let texture_count = builder.attributes.textures.len();
    args.open()?;
    let count = read_count(args, &FACES)?;
    for number in 0..count {
        args.comma()?;
        let at = args.span();
        let corners: [f64; 3] = item(args, &FACES, number, count)?;
        let fault = |args: &dyn Args, fault| error(at.to(args.last_span()), fault);
        let corners = indices(corners, vertex_count, "vertex", "vertices");
        builder
            .face(corners.map_err(|wrong| fault(args, wrong))?)
            .map_err(|wrong| fault(args, wrong))?;
        let mut given = [0.0; 3];
        let mut len = 0;
        while len < 3
            && let Some(index) = texture_index(args)?
        {
            given[len] = index;
            len += 1;
        }
        let textures = match len {
            0 => continue,
            1 => indices([given[0]], texture_count, "texture", "textures")
                .map(|[texture]| only(texture)),
            3 => indices(given, texture_count, "texture", "textures"),
            _ => {
                return Err(fault(
                    args,
                    "a triangle has one texture or three, found two indices".to_owned(),
                ));
            }
        };
        builder.set_textures_of_last(textures.map_err(|wrong| fault(args, wrong))?);
    }
    close_list(args, &FACES, count)
}

/// Reads a texture index, if one comes next rather than the next triangle.
fn texture_index(args: &mut dyn Args) -> Parse<Option<f64>> {
    if let Some(number) = args.literal_number() {
        return Ok(Some(number));
    }
    args.comma()?;
    if args.at_mark('<')? || !args.at_expression()? {
        return Ok(None);
    }
    args.float().map(Some)
}

/// Reads the lists that may follow the triangles: `normal_indices`, `uv_indices`, `inside_vector`.
fn read_indices(args: &mut dyn Args, builder: &mut MeshBuilder, faces_at: Span) -> Parse<()> {
    let uvs = builder.attributes.uvs.len();
    let faces = builder.corners.len();
    let mut has_uv_indices = false;
    loop {
        if args.accept(Word::NormalIndices)? {
            let at = args.last_span();
            let count = builder.normals.len();
            let smooth = &mut builder.smooth;
            smooth.clear();
            let triangles = list::<3>(args, &NORMAL_INDICES, |normals| {
                smooth.push(indices(normals, count, "normal", "normals")?);
                Ok(())
            })?;
            if triangles > faces {
                return Err(error(
                    at,
                    format!(
                        "`normal_indices` has {triangles} triangles, `face_indices` only {faces}"
                    ),
                ));
            }
        } else if args.accept(Word::UvIndices)? {
            let at = args.last_span();
            has_uv_indices = true;
            if builder.attributes.uvs.is_empty() {
                builder.attributes.uvs.push(glam::Vec2::ZERO);
            }
            let mut triples = Vec::new();
            let triangles = list::<3>(args, &UV_INDICES, |pairs| {
                triples.push(indices(pairs, uvs.max(1), "uv vector", "uv vectors")?);
                Ok(())
            })?;
            builder.attributes.uv_of = UvOf::Triangles(triples);
            if triangles != faces {
                return Err(error(
                    at,
                    format!("`uv_indices` has {triangles} triangles, `face_indices` has {faces}"),
                ));
            }
        } else if args.word()? == Some(Word::InsideVector) {
            read_inside_vector(args, builder)?;
        } else {
            break;
        }
    }
    let vertices = builder.vertices.len();
    if !builder.normals.is_empty() && builder.smooth.is_empty() {
        if builder.normals.len() != vertices {
            let count = builder.normals.len();
            return Err(missing(
                faces_at,
                Word::NormalIndices,
                count,
                "normals",
                vertices,
            ));
        }
        builder.smooth.clone_from(&builder.corners);
    }
    if uvs > 0 && !has_uv_indices {
        if uvs != vertices {
            return Err(missing(
                faces_at,
                Word::UvIndices,
                uvs,
                "uv vectors",
                vertices,
            ));
        }
        builder.attributes.uv_of = UvOf::Corners;
    }
    Ok(())
}

fn missing(at: Span, word: Word, count: usize, what: &str, vertices: usize) -> Box<Diagnostic> {
    let message = format!("`{word}` is missing: {count} {what} do not match {vertices} vertices");
    Box::new(
        Diagnostic::error(at, message)
            .with_hint(format!("Give each triangle its {what} with `{word}`.")),
    )
}

/// Reads `{ count, vectors }` after the keyword of a list, passes each vector to `add` and returns the count.
fn list<const N: usize>(
    args: &mut dyn Args,
    list: &List,
    mut add: impl FnMut([f64; N]) -> Result<(), String>,
) -> Parse<usize> {
    args.open()?;
    let count = read_count(args, list)?;
    let mut len = 0;
    while len < count {
        args.literal_vectors(N, &mut |vector| {
            let is_wanted = len < count
                && <[f64; N]>::try_from(vector)
                    .is_ok_and(|vector| is_finite(&vector) && add(vector).is_ok());
            len += usize::from(is_wanted);
            is_wanted
        });
        if len == count {
            break;
        }
        args.comma()?;
        let at = args.span();
        let vector = slow_item::<N>(args, list, len, count)?;
        add(vector).map_err(|fault| error(at.to(args.last_span()), fault))?;
        len += 1;
    }
    close_list(args, list, count)?;
    Ok(count)
}

/// Reads the optional comma after the last item of a list, and the closing `}`.
fn close_list(args: &mut dyn Args, list: &List, count: usize) -> Parse<()> {
    args.comma()?;
    if args.accept_close()? {
        return Ok(());
    }
    let word = list.word;
    Err(args.expected(&format!("`}}` after item {count}, the last of `{word}`")))
}

/// Reads vector number `index` of a list.
fn item<const N: usize>(
    args: &mut dyn Args,
    list: &List,
    index: usize,
    count: usize,
) -> Parse<[f64; N]> {
    let mut item = None;
    args.literal_vectors(N, &mut |vector| {
        let is_wanted = item.is_none() && is_finite(vector);
        if is_wanted {
            item = <[f64; N]>::try_from(vector).ok();
        }
        is_wanted
    });
    match item {
        Some(item) => Ok(item),
        None => slow_item(args, list, index, count),
    }
}

/// As [`item`], for a vector that is not written in literal numbers.
fn slow_item<const N: usize>(
    args: &mut dyn Args,
    list: &List,
    index: usize,
    count: usize,
) -> Parse<[f64; N]> {
    let List { word, item } = list;
    let number = index + 1;
    args.comma()?;
    if !args.at_expression()? {
        return Err(args.expected(&format!("{item} {number} of {count} in `{word}`")));
    }
    let at = args.span();
    let vector: [f64; N] = one(args)?;
    if !is_finite(&vector) {
        return Err(error(
            at.to(args.last_span()),
            format!("{item} {number} in `{word}` must be finite"),
        ));
    }
    Ok(vector)
}

/// Evaluates one vector of a list that is not literal.
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

/// Converts `N` numbers to indices below `count`, or names the one that is out of range.
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
