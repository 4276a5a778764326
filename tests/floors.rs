//! The house has floors: a room uses only rooms below it (see the crate's documentation).

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms by floor, lowest first. Rooms of one floor do not use each other, but for [`NEIGHBOURS`].
const FLOORS: &[&[&str]] = &[
    &["math", "source", "color", "memory"],
    &["encoding"],
    &["syntax", "accel", "film"],
    &["args", "options"],
    &["bitmap"],
    &[
        "shape",
        "pattern",
        "light",
        "camera",
        "interior",
        "atmosphere",
        "texture",
        "function",
    ],
    &["output", "compare"],
    &["scene"],
    &["radiosity", "photons"],
    &["lang", "compile"],
    &["trace"],
    &["render"],
    &["statistics"],
    &["curve", "batch"],
    &["cli"],
];

/// Elements that are made of others: who uses whom on the same floor.
const NEIGHBOURS: &[(&str, &str)] = &[
    // A texture is made of patterns, and a material holds an interior beside its texture.
    ("texture", "pattern"),
    ("texture", "interior"),
    // A function may be a pattern, and a function may call patterns and pigments, which it knows as fields.
    ("pattern", "function"),
    ("texture", "function"),
    // The sky is painted with pigments.
    ("atmosphere", "texture"),
    // The media of the air are those of interiors.
    ("atmosphere", "interior"),
    // The colours of a rainbow are a map.
    ("atmosphere", "pattern"),
    // The bokeh of a camera is painted with a pigment.
    ("camera", "texture"),
    ("camera", "pattern"),
    // A camera may look out of the triangles of meshes.
    ("camera", "shape"),
    // Old scenes write `ior` into a finish; the interior takes it over.
    ("interior", "texture"),
    // A density is chosen by a pattern, out of a map.
    ("interior", "pattern"),
    // The triangles of a mesh have textures of their own.
    ("shape", "texture"),
    // An isosurface is a function.
    ("shape", "function"),
];

fn floor_of(room: &str) -> Option<usize> {
    FLOORS.iter().position(|rooms| rooms.contains(&room))
}

/// All source files below a folder, tests left out: they may look at the whole house.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the sources are readable") {
        let path = entry.expect("the sources are readable").path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "tests") {
                files(&path, found);
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The rooms that a file uses, by its `crate::` paths outside of its tests.
fn rooms_used(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text);
    let code: String = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n");
    code.split("crate::")
        .skip(1)
        .map(|rest| {
            rest.chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_')
                .collect()
        })
        .filter(|room: &String| floor_of(room).is_some())
        .collect()
}

#[test]
fn a_room_uses_only_rooms_below_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    files(&root, &mut found);
    let mut faults = BTreeMap::new();
    for path in &found {
        let inside = path
            .strip_prefix(&root)
            .expect("the file lies in the sources");
        let first = inside
            .iter()
            .next()
            .expect("a file has a name")
            .to_string_lossy();
        let room = first.trim_end_matches(".rs").to_owned();
        let Some(floor) = floor_of(&room) else {
            assert!(
                ["lib", "main"].contains(&room.as_str()),
                "the room `{room}` is on no floor"
            );
            continue;
        };
        let text = fs::read_to_string(path).expect("the sources are readable");
        for used in rooms_used(&text) {
            let is_neighbour = NEIGHBOURS.contains(&(room.as_str(), used.as_str()));
            if used != room && !is_neighbour && floor_of(&used).is_none_or(|other| other >= floor) {
                faults.entry(inside.display().to_string()).or_insert(used);
            }
        }
    }
    assert!(
        faults.is_empty(),
        "these files use rooms that are not below theirs: {faults:#?}"
    );
}
