//! The list of the pictures of a batch, with their settings.

use crate::app::cli::options::ini;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::Wanted;
use crate::app::batch::{Globs, Picture, scenes_below};
use crate::app::cli::options::environment::Environment;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::ini::Reader;
use crate::app::cli::options::long_options::Size;
use crate::app::cli::options::raw_args::{Output, RawArgs};
use crate::app::cli::options::settings;
use crate::app::cli::options::settings::{Scene, find_scene};

/// A scene, and its picture relative to the output folder, without an ending.
#[derive(Clone, Debug, PartialEq, Eq)]
struct BatchScene {
    scene: PathBuf,
    output: PathBuf,
}

/// The pictures to render, and the scenes that cannot be rendered, with the reason.
pub(super) struct List {
    pub(super) pictures: Vec<Picture>,
    pub(super) refused: Vec<(PathBuf, CliError)>,
}

/// Lists everything to render.
pub(super) fn list(wanted: &Wanted, environment: &Environment) -> Result<List, CliError> {
    let standard_folders = environment.standard_folders()?;
    let raw_args = environment.raw_args(&standard_folders)?;
    // An error in the command line is reported once, not for each scene.
    let mut tried = raw_args.clone();
    take_in(wanted, &mut tried, &standard_folders)?;
    let mut list = List {
        pictures: Vec::new(),
        refused: Vec::new(),
    };
    for (series, entry) in scenes(wanted)?.into_iter().enumerate() {
        let raw_args = of_scene(&entry, wanted, raw_args.clone(), &standard_folders);
        let settled = raw_args.and_then(|raw_args| {
            settings::settle(raw_args, &standard_folders, environment, "povr batch")
        });
        match settled.and_then(|settings| pictures(&entry, series, wanted, settings)) {
            Ok(pictures) => list.pictures.extend(pictures),
            Err(refusal) => list.refused.push((entry.scene, refusal)),
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
            .with_hint("Name the folder that holds both, or draw them to different folders."));
        }
    }
    Ok(list)
}

/// The options for one scene: the user's ini file, the one beside the scene, the command line.
fn of_scene(
    entry: &BatchScene,
    wanted: &Wanted,
    mut raw_args: RawArgs,
    standard_folders: &[PathBuf],
) -> Result<RawArgs, CliError> {
    let ini = entry.scene.with_extension("ini");
    // It would come with the scene, and could name other library folders.
    if ini.is_file() && !wanted.safety.sandbox {
        let known = raw_args.library_paths.len();
        Reader::new(&mut raw_args, standard_folders).read_file(&ini, None)?;
        let folder = ini.parent().unwrap_or(Path::new(""));
        for path in &mut raw_args.library_paths[known..] {
            let near = folder.join(&*path);
            if near.is_dir() {
                *path = near;
            }
        }
    }
    take_in(wanted, &mut raw_args, standard_folders)?;
    raw_args.scene = Some(entry.scene.to_string_lossy().into_owned());
    raw_args.output = Output::Unnamed;
    raw_args.to_file = true;
    Ok(raw_args)
}

/// Reads the switches of the command line.
fn take_in(wanted: &Wanted, raw_args: &mut RawArgs, folders: &[PathBuf]) -> Result<(), CliError> {
    let mut reader = Reader::new(raw_args, folders);
    for word in &wanted.switches {
        ini::read(&mut reader, word)?;
    }
    raw_args.safety.add(wanted.safety.clone());
    if let Some(Size(width, height)) = wanted.size {
        (raw_args.width, raw_args.height) = (width, height);
    }
    Ok(())
}

/// The pictures of a scene: one, or its frames.
fn pictures(
    entry: &BatchScene,
    series: usize,
    wanted: &Wanted,
    settings: settings::Settings,
) -> Result<Vec<Picture>, CliError> {
    let Scene::File(scene) = settings.scene else {
        return Err(CliError::new("a batch reads no standard input"));
    };
    // Frames, and later runs, read it again; and no time limit ends the wait for a pipe.
    if !scene.is_file() {
        return Err(CliError::new("a batch reads regular files only"));
    }
    let Some((_, encode)) = settings.output else {
        return Err(CliError::new("a batch writes files")
            .with_hint("Leave `-F` (or `Output_To_File=off`) out."));
    };
    let mut name = entry.output.clone().into_os_string();
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
        read: frames.read_options_for(number, &picture.read),
        ..picture.clone()
    };
    Ok(numbers.into_iter().map(frame).collect())
}

/// The scenes named, in the order of their pictures, without duplicates.
fn scenes(wanted: &Wanted) -> Result<Vec<BatchScene>, CliError> {
    let globs = Globs::new(&wanted.only, &wanted.except)?;
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
            all.insert(
                (output.clone(), scene.clone()),
                BatchScene { scene, output },
            );
        }
    }
    if all.is_empty() {
        let names = wanted.names.join("`, `");
        return Err(
            CliError::new(format!("no scene (`.pov`) is meant by `{names}`"))
                .with_hint("`--only` and `--exclude` may leave none."),
        );
    }
    Ok(all.into_values().collect())
}

/// A name on the command line.
struct Root {
    /// The folder that pictures are named relative to.
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
        // A pattern is searched below the folders before its first special character.
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
            What::Folder | What::Pattern(_) => scenes_below(folder)?,
        };
        if let What::Pattern(pattern) = &self.what {
            let own = Globs::new(std::slice::from_ref(pattern), &[])?;
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
