//! Layering: a module uses only modules of lower layers (ARCHITECTURE.md).

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The top-level modules, lowest first, each with those that it may use.
const TOP_LEVEL: &[(&str, &[&str])] = &[
    ("base", &[]),
    ("scene", &["base"]),
    ("lang", &["base", "scene", "output"]),
    ("world", &["base", "scene"]),
    ("lint", &["base", "scene", "lang", "world"]),
    ("output", &["base"]),
    ("render", &["base", "scene", "world"]),
    (
        "app",
        &["base", "scene", "lang", "world", "output", "render"],
    ),
];

/// The modules by layer, lowest first. Modules of one layer do not use each other, except for [`SIBLINGS`]; files of one
/// module may.
const LAYERS: &[&[&str]] = &[
    &["base::derived", "base::file", "base::nearest", "base::sync"],
    &[
        "base::math",
        "base::source",
        "base::color",
        "base::memory",
        "base::word",
    ],
    &["base::encoding", "base::version"],
    &["lang::syntax", "base::accel", "base::film"],
    &["base::args", "base::options"],
    &["base::bitmap"],
    &[
        "scene::shape",
        "scene::pattern",
        "scene::light",
        "scene::camera",
        "scene::interior",
        "scene::atmosphere",
        "scene::texture",
        "scene::function",
    ],
    &[
        "output",
        "app::page",
        "app::picture_file",
        "app::program",
        "app::watchdog",
    ],
    &["app::compare"],
    &["scene"],
    &["lang", "world::ray", "world::index"],
    &[
        "world::primitive",
        "world::interiors",
        "world::photons",
        "world::slabs",
        "world::sphere_soa",
    ],
    &["world::rounding"],
    &["world::csg"],
    &["world::lights", "world::model"],
    &["world::surface", "world::light_buffers"],
    &["world::compiled"],
    &["world::query", "world::plan"],
    &["world::lower"],
    &["world"],
    &["lint"],
    &["render::radiosity", "render::photons"],
    &["render::shade"],
    &["render::checkpoint", "render::photon_pass"],
    &["render::tiles"],
    &["render::tile_cache"],
    &["render::antialias", "render::adaptive", "render::pretrace"],
    &["render::radiosity_pass"],
    &["render", "render::statistics"],
    &["app::worker", "app::server"],
    &["app::curve", "app::batch"],
    &["app::cli"],
    // A package of its own, which uses the library by its name.
    &["app::python"],
];

/// Uses within a layer: elements that are composed of others.
const SIBLINGS: &[(&str, &str)] = &[
    // A texture is composed of patterns, and a material holds an interior beside its texture.
    ("scene::texture", "scene::pattern"),
    ("scene::texture", "scene::interior"),
    // A function may be a pattern, and a function may call patterns and pigments, as scalar or vector fields.
    ("scene::pattern", "scene::function"),
    ("scene::texture", "scene::function"),
    // The sky is painted with pigments.
    ("scene::atmosphere", "scene::texture"),
    // Atmospheric media are those of interiors.
    ("scene::atmosphere", "scene::interior"),
    // The colours of a rainbow are a map.
    ("scene::atmosphere", "scene::pattern"),
    // The bokeh of a camera is painted with a pigment.
    ("scene::camera", "scene::texture"),
    ("scene::camera", "scene::pattern"),
    // A mesh camera shoots rays from the triangles of meshes.
    ("scene::camera", "scene::shape"),
    // The rays of a `user_defined` camera are given by functions.
    ("scene::camera", "scene::function"),
    // Old scenes write `ior` into a finish; the interior takes it over.
    ("scene::interior", "scene::texture"),
    // A pattern selects a density from a map.
    ("scene::interior", "scene::pattern"),
    // The triangles of a mesh have textures of their own.
    ("scene::shape", "scene::texture"),
    // An isosurface is a function.
    ("scene::shape", "scene::function"),
];

/// The layer of the innermost module of a path that has one, with the module.
fn layer_of(path: &str) -> Option<(usize, &'static str)> {
    let holds = |module: &str| path == module || path.starts_with(&format!("{module}::"));
    let modules = LAYERS.iter().enumerate();
    let modules = modules.flat_map(|(layer, modules)| modules.iter().map(move |m| (layer, *m)));
    let held = modules.filter(|(_, module)| holds(module));
    held.max_by_key(|(_, module)| module.len())
}

/// All source files below a folder except tests, which may use everything.
fn files(folder: &Path, sources: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the sources are readable") {
        let path = entry.expect("the sources are readable").path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "tests") {
                files(&path, sources);
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            sources.push(path);
        }
    }
}

/// The module that a file belongs to, as a path.
fn module_of(inside: &Path) -> String {
    let names = inside
        .with_extension("")
        .iter()
        .map(|name| name.to_string_lossy().into_owned())
        .collect::<Vec<_>>();
    names.join("::")
}

/// The paths that a file uses outside of its tests, from the root of the crate: those that begin with `crate::` and
/// `super::`.
fn paths_used(module: &str, text: &str) -> Vec<String> {
    if module.ends_with("::tests") {
        return Vec::new();
    }
    let is_test = |line: &&str| line.ends_with("mod tests {");
    let code: String = text
        .lines()
        .take_while(|line| !is_test(line))
        .filter(|line| !line.trim_start().starts_with("//"))
        .map(|line| line.replace("pub(in crate::", ""))
        .collect::<Vec<_>>()
        .join("\n");
    let path_at = |rest: &str| -> String {
        rest.chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':')
            .collect()
    };
    let absolute = code.split("crate::").skip(1).map(path_at);
    // Each `super::` but those behind another begins a path.
    let starts = code.match_indices("super::").map(|(at, _)| at);
    let starts = starts.filter(|&at| !code[..at].ends_with("super::"));
    let relative = starts.map(|at| {
        let path = path_at(&code[at..]);
        let ups = path.matches("super::").count();
        let own: Vec<&str> = module.trim_end_matches("::mod").split("::").collect();
        let mut full = own[..own.len().saturating_sub(ups)].join("::");
        full.push_str("::");
        full.push_str(path.trim_start_matches("super::"));
        full
    });
    absolute.chain(relative).collect()
}

fn is_allowed(module: &str, used: &str) -> bool {
    let top = |path: &str| path.split("::").next().unwrap_or_default().to_owned();
    let (own, other) = (top(module), top(used));
    let top_level = TOP_LEVEL.iter().find(|(name, _)| *name == own);
    let may_use = own == other || top_level.is_some_and(|(_, used)| used.contains(&other.as_str()));
    let (Some((layer, module)), Some((below, used))) = (layer_of(module), layer_of(used)) else {
        return true;
    };
    may_use && (module == used || below < layer || SIBLINGS.contains(&(module, used)))
}

#[test]
fn a_module_uses_only_lower_layers() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = Vec::new();
    files(&root, &mut sources);
    assert!(sources.len() > 400, "the sources are found");
    let mut faults = BTreeMap::new();
    for path in &sources {
        let inside = path
            .strip_prefix(&root)
            .expect("the file lies in the sources");
        let module = module_of(inside);
        if layer_of(&module).is_none() {
            let is_root = ["lib", "compiled", "main", "base::mod", "app::mod"]
                .contains(&module.as_str())
                || module.starts_with("compiled::");
            assert!(is_root, "`{module}` is in no layer");
            continue;
        }
        let text = fs::read_to_string(path).expect("the sources are readable");
        for used in paths_used(&module, &text) {
            if !is_allowed(&module, &used) {
                faults.entry(inside.display().to_string()).or_insert(used);
            }
        }
    }
    assert!(
        faults.is_empty(),
        "these files use modules that are not below theirs: {faults:#?}"
    );
}
