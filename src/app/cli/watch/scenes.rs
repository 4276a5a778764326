//! The scenes that a page can open: those of a folder, or those that povr brings along, with thumbnails that a worker of
//! their own draws.

use crate::app::worker::{Draw, Live, LiveTask, LiveText, Worker};
use crate::base::options::Writes;
use crate::base::sync::lock;
use crate::output::{EncodeOptions, Format};
use hyper::body::Bytes;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use super::shown::Shown;
use crate::app::cli::options::settings::Settings;

/// The scenes that povr brings along.
const SHOWCASE: [(&str, &str); 6] = [
    (
        "colonnade.pov",
        include_str!("../../../../pov_scenes/showcase/colonnade.pov"),
    ),
    (
        "gears.pov",
        include_str!("../../../../pov_scenes/showcase/gears.pov"),
    ),
    (
        "glassware.pov",
        include_str!("../../../../pov_scenes/showcase/glassware.pov"),
    ),
    (
        "igloo.pov",
        include_str!("../../../../pov_scenes/showcase/igloo.pov"),
    ),
    (
        "molecule.pov",
        include_str!("../../../../pov_scenes/showcase/molecule.pov"),
    ),
    (
        "still_life.pov",
        include_str!("../../../../pov_scenes/showcase/still_life.pov"),
    ),
];
/// The most scenes of a folder in the list.
const MOST: usize = 400;
/// Larger side of a thumbnail in pixels, and the time limit to draw it.
const SIDE: u32 = 128;
const PATIENCE: Duration = Duration::from_secs(10);
/// Interval of checks for the end of a picture, beside which no thumbnail is drawn.
const PAUSE: Duration = Duration::from_millis(50);

/// A scene to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SceneFile {
    pub(super) path: PathBuf,
    /// The text of one that povr brings along, which has no file.
    pub(super) built_in: Option<&'static str>,
}

impl SceneFile {
    /// The name in the list.
    pub(super) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// The time of its last change.
    fn time(&self) -> Option<SystemTime> {
        fs::metadata(&self.path).ok()?.modified().ok()
    }
}

/// The scenes of a list.
#[derive(Debug)]
pub(super) struct Scenes {
    /// `None` for those that povr brings along.
    folder: Option<PathBuf>,
    thumbnails: Mutex<Thumbnails>,
    /// Notified when thumbnails are wanted.
    wanted: Condvar,
}

/// A PNG file with its number; `None` where there is no picture.
type Thumbnail = Option<(u64, Bytes)>;

#[derive(Debug, Default)]
struct Thumbnails {
    /// By scene, with its time.
    drawn: BTreeMap<PathBuf, (Option<SystemTime>, Thumbnail)>,
    /// Incremented by each thumbnail.
    number: u64,
    is_wanted: bool,
    is_over: bool,
}

/// A scene as the page receives it.
#[derive(Serialize)]
struct Listed {
    name: String,
    /// The number of its thumbnail, once there is one.
    thumbnail: Option<u64>,
}

impl Scenes {
    /// The scenes of a folder, or those that povr brings along.
    pub(super) fn of(folder: Option<PathBuf>) -> Self {
        Scenes {
            folder,
            thumbnails: Mutex::default(),
            wanted: Condvar::new(),
        }
    }

    /// The scenes in the order of their names.
    pub(super) fn all(&self) -> Vec<SceneFile> {
        let Some(folder) = &self.folder else {
            let built_in = SHOWCASE.iter().map(|(name, text)| SceneFile {
                path: Path::new("showcase").join(name),
                built_in: Some(text),
            });
            return built_in.collect();
        };
        let read = match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        };
        let entries = fs::read_dir(read).into_iter().flatten().flatten();
        let is_scene = |path: &PathBuf| {
            let ending = path.extension().unwrap_or_default();
            ending.eq_ignore_ascii_case("pov") && path.is_file()
        };
        let mut paths: Vec<_> = entries
            .map(|entry| folder.join(entry.file_name()))
            .filter(is_scene)
            .collect();
        paths.sort();
        paths.truncate(MOST);
        let file = |path| SceneFile {
            path,
            built_in: None,
        };
        paths.into_iter().map(file).collect()
    }

    /// The scene of a name.
    pub(super) fn named(&self, name: &str) -> Option<SceneFile> {
        self.all().into_iter().find(|scene| scene.name() == name)
    }

    /// The list as JSON; its thumbnails are drawn from now on.
    pub(super) fn json(&self) -> String {
        let mut thumbnails = lock(&self.thumbnails);
        thumbnails.is_wanted = true;
        self.wanted.notify_all();
        let listed = |scene: SceneFile| Listed {
            name: scene.name(),
            thumbnail: thumbnails
                .drawn
                .get(&scene.path)
                .and_then(|(_, drawn)| Some(drawn.as_ref()?.0)),
        };
        let scenes: Vec<_> = self.all().into_iter().map(listed).collect();
        serde_json::to_string(&scenes).unwrap_or_default()
    }

    /// A thumbnail by its number, as a PNG file.
    pub(super) fn thumbnail(&self, wanted: u64) -> Option<Bytes> {
        let thumbnails = lock(&self.thumbnails);
        let mut drawn = thumbnails
            .drawn
            .values()
            .filter_map(|(_, one)| one.as_ref());
        drawn
            .find(|(number, _)| *number == wanted)
            .map(|(_, png)| png.clone())
    }

    /// Ends the drawing of thumbnails, after the current one.
    pub(super) fn end(&self) {
        lock(&self.thumbnails).is_over = true;
        self.wanted.notify_all();
    }

    /// Draws thumbnails until the end, whenever they are wanted and no picture is being drawn.
    pub(super) fn draw_thumbnails(
        &self,
        settings_of: impl Fn(&SceneFile) -> Option<Settings>,
        shown: &Shown,
    ) {
        let mut worker = None;
        while !lock(&self.thumbnails).is_over {
            let thumbnails = lock(&self.thumbnails);
            let is_idle =
                |thumbnails: &mut Thumbnails| !thumbnails.is_wanted && !thumbnails.is_over;
            let waited = self.wanted.wait_while(thumbnails, is_idle);
            waited.unwrap_or_else(PoisonError::into_inner).is_wanted = false;
            for scene in self.all() {
                let time = scene.time();
                let is_known = || {
                    let thumbnails = lock(&self.thumbnails);
                    let known = thumbnails.drawn.get(&scene.path);
                    known.is_some_and(|(known, _)| *known == time)
                };
                if is_known() {
                    continue;
                }
                while shown.is_drawing() && !lock(&self.thumbnails).is_over {
                    std::thread::sleep(PAUSE);
                }
                if lock(&self.thumbnails).is_over {
                    return;
                }
                let settings = settings_of(&scene);
                let png = settings.and_then(|settings| thumbnail(&mut worker, &scene, &settings));
                if png.is_none() && shown.is_drawing() {
                    // Other work came first; it is drawn for the next list.
                    continue;
                }
                let mut thumbnails = lock(&self.thumbnails);
                thumbnails.number += 1;
                let png = png.map(|png| (thumbnails.number, png.into()));
                thumbnails.drawn.insert(scene.path, (time, png));
                let number = thumbnails.number;
                drop(thumbnails);
                shown.thumbnails(number);
            }
        }
    }
}

/// The thumbnail of a scene as a PNG file.
fn thumbnail(
    worker: &mut Option<Worker>,
    scene: &SceneFile,
    settings: &Settings,
) -> Option<Vec<u8>> {
    if settings.is_sandboxed {
        // A worker in a sandbox draws one scene.
        *worker = None;
    }
    let whole = &settings.render;
    let larger = whole.width.max(whole.height).max(1);
    let part = |side: u32| (side * SIDE / larger).clamp(1, SIDE);
    let (width, height) = (part(whole.width), part(whole.height));
    let mut read = settings.read.clone();
    read.writes = Writes::InMemory;
    let draw = Draw {
        scene: scene.path.clone(),
        series: None,
        read,
        render: whole.coarse(width, height),
        threads: None,
        files: vec![EncodeOptions::new(Format::PNG)],
        tells_output: false,
        timeout: Some(PATIENCE),
        max_memory: settings.max_memory,
        is_sandboxed: settings.is_sandboxed,
        // A picture may be begun before the thumbnail ends.
        is_background: true,
        live: scene.built_in.map(|text| Live {
            number: 0,
            text: LiveText::Whole(text.to_owned()),
            is_built_in: true,
            camera: None,
            task: LiveTask::Coarse,
        }),
    };
    // Each scene has a number of its own, or the last one would be drawn again.
    *worker = worker.take().filter(|_| scene.built_in.is_none());
    let drawn = Worker::ready(worker).ok()?.draw(draw, &|_| {}, &|_| {});
    drawn.ok()?.into_iter().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_a_folder_are_listed_by_name() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.pov", "a.POV", "c.inc", "d.png"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        fs::create_dir(folder.path().join("e.pov")).unwrap();
        let scenes = Scenes::of(Some(folder.path().to_owned()));
        let names: Vec<String> = scenes.all().iter().map(SceneFile::name).collect();
        assert_eq!(names, ["a.POV", "b.pov"]);
        assert!(scenes.named("../b.pov").is_none());
        let expected = r#"[{"name":"a.POV","thumbnail":null},{"name":"b.pov","thumbnail":null}]"#;
        assert_eq!(scenes.json(), expected);
    }

    #[test]
    fn the_showcase_has_no_files() {
        let scenes = Scenes::of(None).all();
        assert_eq!(scenes.len(), SHOWCASE.len());
        assert!(scenes.iter().all(|scene| scene.built_in.is_some()));
    }
}
