//! `+C`: going on with a picture whose drawing was interrupted.
//!
//! As in POV-Ray every drawing leaves what it has done beside its picture, as `NAME.povr-state`, until the picture is
//! whole; one of less than two seconds leaves nothing unless `+C` is given. POV-Ray 3.7.0.10 was seen to do this with
//! `+C`: without a state it draws all, and if the picture is there it says so and draws nothing; with a state of another
//! size it ends without a picture; with one of a scene that has changed since, it goes on and mixes both, which this
//! program does not.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use super::report::say;
use crate::app::cli::options::settings::Settings;
use crate::base::options::CheckpointOptions;
use crate::output::Target;

/// What is appended to the name of the picture.
const ENDING: &str = ".povr-state";

/// Whether there is nothing to go on with because the picture is there. Says so.
pub(crate) fn is_done(settings: &Settings) -> bool {
    let Some(picture) = picture(settings) else {
        return false;
    };
    let is_done = settings.continues && picture.is_file() && !state(picture).exists();
    if is_done && !settings.talk.quiet {
        say(format_args!(
            "povr: `{}` is there and nothing unfinished: skipping, as `+C` has it",
            picture.display()
        ));
    }
    is_done
}

/// Has the drawing keep what it has done.
pub(crate) fn keep(settings: &mut Settings) {
    if let Some(picture) = picture(settings) {
        settings.render.keep = Some(CheckpointOptions {
            file: state(picture),
            continues: settings.continues,
            build: build(),
        });
    }
}

/// Removes what was kept: the picture is whole.
pub(crate) fn forget(settings: &Settings) {
    if let Some(keep) = &settings.render.keep {
        // Mostly there is none.
        let _ = fs::remove_file(&keep.file);
    }
}

fn picture(settings: &Settings) -> Option<&Path> {
    match &settings.output {
        // A device or a pipe has no place beside it.
        Some((Target::File(path), _)) if !path.exists() || path.is_file() => Some(path),
        _ => None,
    }
}

fn state(picture: &Path) -> PathBuf {
    let mut name = picture.as_os_str().to_owned();
    name.push(ENDING);
    PathBuf::from(name)
}

/// What tells this program from others of the same version: its length and when it was made.
fn build() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let about = std::env::current_exe().and_then(fs::metadata);
    let made = about.ok().and_then(|about| {
        let since = about.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
        Some((about.len(), since.as_nanos()))
    });
    format!("{version} {made:?}")
}
