//! `+C`: continues a picture from the checkpoint of an interrupted run.
//!
//! As in POV-Ray every rendering stores its finished pixels beside its picture, as `NAME.povr-state`, until the picture
//! is complete; one of less than two seconds stores nothing unless `+C` is given. Behaviour of POV-Ray 3.7.0.10 with
//! `+C`, as observed: without a state it renders everything, and if the picture is there it says so and renders
//! nothing; with a state of another size it ends without a picture; with a state of a scene that has changed since, it
//! continues and mixes both, which this program does not.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use super::report::say;
use crate::app::cli::options::settings::Settings;
use crate::app::program;
use crate::base::options::CheckpointOptions;
use crate::output::Target;

/// Suffix of the checkpoint after the name of the picture.
const ENDING: &str = ".povr-state";

/// True if there is nothing to continue because the picture is complete. Prints a message then.
pub(crate) fn is_done(settings: &Settings) -> bool {
    let Some(picture) = picture(settings) else {
        return false;
    };
    let is_done = settings.continues && picture.is_file() && !state(picture).exists();
    if is_done && !settings.verbosity.quiet {
        say(format_args!(
            "povr: `{}` is there and nothing unfinished: skipping, as `+C` has it",
            picture.display()
        ));
    }
    is_done
}

/// Enables checkpoints for the rendering.
pub(crate) fn keep(settings: &mut Settings) {
    // A sandbox writes its picture only.
    if settings.is_sandboxed && !settings.continues {
        return;
    }
    if let Some(picture) = picture(settings) {
        settings.render.checkpoint = Some(CheckpointOptions {
            file: state(picture),
            resume: settings.continues,
            build: build(),
        });
    }
}

/// Removes the checkpoint: the picture is complete.
pub(crate) fn forget(settings: &Settings) {
    if let Some(keep) = &settings.render.checkpoint {
        // Usually there is none.
        let _ = fs::remove_file(&keep.file);
    }
}

fn picture(settings: &Settings) -> Option<&Path> {
    match &settings.output {
        // A device or a pipe cannot have a checkpoint beside it.
        Some((Target::File(path), _)) if !path.exists() || path.is_file() => Some(path),
        _ => None,
    }
}

fn state(picture: &Path) -> PathBuf {
    let mut name = picture.as_os_str().to_owned();
    name.push(ENDING);
    PathBuf::from(name)
}

/// Distinguishes builds of the same version: length and modification time of the program.
fn build() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let about = program::code().and_then(fs::metadata);
    let made = about.ok().and_then(|about| {
        let since = about.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
        Some((about.len(), since.as_nanos()))
    });
    format!("{version} {made:?}")
}
