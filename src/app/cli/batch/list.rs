//! The pictures of a batch: which scenes there are, and what is to be drawn of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::Wanted;
use crate::app::batch::{Globs, Picture, scenes_below};
use crate::app::cli::options::arg_words;
use crate::app::cli::options::environment::Environment;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::ini::Reader;
use crate::app::cli::options::long_options::Size;
use crate::app::cli::options::raw_args::{Output, RawArgs};
use crate::app::cli::options::settings;
use crate::app::cli::options::settings::{Scene, find_scene};

/// A scene and where its picture goes, below the folder of all, still without an ending.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Found {
    scene: PathBuf,
    output: PathBuf,
}

/// The pictures to draw, and the scenes of which nothing can be drawn, with why.
pub(super) struct List {
    pub(super) pictures: Vec<Picture>,
    pub(super) refused: Vec<(PathBuf, CliError)>,
}

/// Everything that is to be drawn.
pub(super) fn list(wanted: &Wanted, around: &Environment) -> Result<List, CliError> {
    let standard_folders = around.standard_folders()?;
    let typed = around.typed(&standard_folders)?;
    // What is wrong with the command line is wrong with it once.
    let mut tried = typed.clone();
    take_in(wanted, &mut tried, &standard_folders)?;
    let mut list = List {
        pictures: Vec::new(),
        refused: Vec::new(),
    };
    for (series, found) in scenes(wanted)?.into_iter().enumerate() {
        let typed = of_scene(&found, wanted, typed.clone(), &standard_folders);
        let settled = typed
            .and_then(|typed| settings::settle(typed, &standard_folders, around, "povr batch"));
        match settled.and_then(|settings| pictures(&found, series, wanted, settings)) {
            Ok(pictures) => list.pictures.extend(pictures),
            Err(refusal) => list.refused.push((found.scene, refusal)),
        }
    }
    let mut known: BTreeMap<&Path, &Path> = BTreeMap::new();
    for picture in &list.pictures {
        if let Some(other) = known.insert(&picture.output, &picture.scene) {
            return Err(CliError::new(format!(
                "`{}` would be the picture of both `{}` and `{}`",
                picture.output.display(),
                other.display(),
                picture.scene.display()
            ))
            .with_hint("name the folder that holds both, or draw them to different folders"));
        }
    }
    Ok(list)
}

/// What was typed about one scene: the user's ini file, the one beside the scene, the command line.
fn of_scene(
    found: &Found,
    wanted: &Wanted,
    mut typed: RawArgs,
    standard_folders: &[PathBuf],
) -> Result<RawArgs, CliError> {
    let ini = found.scene.with_extension("ini");
    if ini.is_file() {
        let known = typed.library_paths.len();
        Reader::new(&mut typed, standard_folders).read_file(&ini, None)?;
        let folder = ini.parent().unwrap_or(Path::new(""));
        for path in &mut typed.library_paths[known..] {
            let near = folder.join(&*path);
            if near.is_dir() {
                *path = near;
            }
        }
    }
    take_in(wanted, &mut typed, standard_folders)?;
    typed.scene = Some(found.scene.to_string_lossy().into_owned());
    typed.output = Output::Unnamed;
    typed.to_file = true;
    Ok(typed)
}

/// Takes the switches of the command line in.
fn take_in(wanted: &Wanted, typed: &mut RawArgs, folders: &[PathBuf]) -> Result<(), CliError> {
    let mut reader = Reader::new(typed, folders);
    for word in &wanted.switches {
        arg_words::read(&mut reader, word)?;
    }
    if let Some(Size(width, height)) = wanted.size {
        (typed.width, typed.height) = (width, height);
    }
    Ok(())
}

/// The pictures of a scene: one, or its frames.
fn pictures(
    found: &Found,
    series: usize,
    wanted: &Wanted,
    settings: settings::Settings,
) -> Result<Vec<Picture>, CliError> {
    let Scene::File(scene) = settings.scene else {
        return Err(CliError::new("a batch reads no standard input"));
    };
    // Frames, and runs that follow, read it again; and no time limit ends the wait for a pipe.
    if !scene.is_file() {
        return Err(CliError::new("a batch reads regular files only"));
    }
    let Some((_, encode)) = settings.output else {
        return Err(CliError::new("a batch writes files")
            .with_hint("leave `-F` (or `Output_To_File=off`) out"));
    };
    let mut name = found.output.clone().into_os_string();
    name.push(format!(".{}", encode.format.extension()));
    let output = PathBuf::from(name);
    let mut read = settings.read;
    read.memory = wanted.memory;
    let picture = Picture {
        scene,
        series,
        output,
        read,
        render: settings.render,
        encode,
    };
    let Some(frames) = settings.frames else {
        return Ok(vec![picture]);
    };
    let numbers = frames.numbers();
    let frame = |number: u32| Picture {
        output: frames.path(number, &picture.output),
        read: frames.tell(number, &picture.read),
        ..picture.clone()
    };
    Ok(numbers.into_iter().map(frame).collect())
}

/// The scenes that were named, in the order of their pictures, none twice.
fn scenes(wanted: &Wanted) -> Result<Vec<Found>, CliError> {
    let globs = Globs::new(&wanted.only, &wanted.except).map_err(refused)?;
    let roots: Vec<Root> = wanted.names.iter().map(|name| Root::of(name)).collect();
    let folders = roots.iter().filter(|root| root.is_folder()).count();
    let mut all = BTreeMap::new();
    for root in &roots {
        for scene in root.scenes(&globs)? {
            let below = scene.strip_prefix(&root.folder).unwrap_or(&scene);
            let mut output = below.with_extension("");
            if folders > 1 && root.is_folder() {
                output = Path::new(root.folder.file_name().unwrap_or_default()).join(output);
            }
            all.insert((output.clone(), scene.clone()), Found { scene, output });
        }
    }
    if all.is_empty() {
        let names = wanted.names.join("`, `");
        return Err(
            CliError::new(format!("no scene (`.pov`) is meant by `{names}`"))
                .with_hint("`--only` and `--exclude` may leave none"),
        );
    }
    Ok(all.into_values().collect())
}

/// A name on the command line.
struct Root {
    /// What pictures are named below.
    folder: PathBuf,
    what: What,
}

enum What {
    Folder,
    Scene(String),
    Pattern(String),
}

impl Root {
    fn of(name: &str) -> Self {
        let path = Path::new(name);
        let is_pattern = name.contains(['*', '?', '[', '{']) && !path.exists();
        if path.is_dir() {
            return Root {
                folder: path.to_owned(),
                what: What::Folder,
            };
        }
        if !is_pattern {
            return Root {
                folder: path.parent().unwrap_or(Path::new("")).to_owned(),
                what: What::Scene(name.to_owned()),
            };
        }
        // A pattern is searched below the folders before its first special letter.
        let plain = |part: &&str| !part.contains(['*', '?', '[', '{']);
        let parts: Vec<&str> = name.split('/').collect();
        let fixed = parts.iter().take_while(|part| plain(part)).count();
        Root {
            folder: PathBuf::from(parts[..fixed].join("/")),
            what: What::Pattern(parts[fixed..].join("/")),
        }
    }

    fn is_folder(&self) -> bool {
        !matches!(self.what, What::Scene(_))
    }

    fn scenes(&self, globs: &Globs) -> Result<Vec<PathBuf>, CliError> {
        let folder = match self.folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => &self.folder,
        };
        let meant =
            |scene: &PathBuf, globs: &Globs| globs.has(scene.strip_prefix(folder).unwrap_or(scene));
        let mut scenes = match &self.what {
            What::Scene(name) => return Ok(vec![find_scene(name, &[])?]),
            What::Folder | What::Pattern(_) => scenes_below(folder).map_err(refused)?,
        };
        if let What::Pattern(pattern) = &self.what {
            let own = Globs::new(std::slice::from_ref(pattern), &[]).map_err(refused)?;
            scenes.retain(|scene| meant(scene, &own));
        }
        scenes.retain(|scene| meant(scene, globs));
        Ok(match self.folder.as_os_str().is_empty() {
            true => scenes
                .iter()
                .map(|scene| scene.strip_prefix(".").unwrap_or(scene).to_owned())
                .collect(),
            false => scenes,
        })
    }
}

/// A refusal of the room of batches, as this program says it.
pub(super) fn refused(error: crate::app::batch::BatchError) -> CliError {
    CliError::new(error.to_string())
}
