//! The line about a finished picture, for people: `gears.png  1280x960  11.2 s`.

use std::fs;
use std::time::Duration;

use super::report::say;
use crate::app::cli::options::settings::{Settings, Verbosity};
use crate::base::film::Film;
use crate::base::source::{Code, Diagnostic, Message, Sources, allows_lint};
use crate::output::Target;

/// Reports a finished picture, on a terminal.
pub(crate) fn report(settings: &Settings, took: Duration) {
    if is_reported(settings.verbosity) {
        say(line(&name(settings), settings, took));
    }
}

/// Reports the finished frames of an animation, on a terminal.
pub(crate) fn report_frames(settings: &Settings, first: &str, last: &str, took: Duration) {
    if is_reported(settings.verbosity) {
        let name = match first == last {
            true => first.to_owned(),
            false => format!("{first} to {last}"),
        };
        say(line(&name, settings, took));
    }
}

/// Fewer pixels are of one colour without a reason.
const LEAST_PIXELS: usize = 1000;

/// A warning, for people, if the whole picture has one colour.
pub(crate) fn flat(settings: &Settings, film: &Film) -> Option<Message> {
    let pixels = film.columns.len() * film.rows.len();
    if pixels < LEAST_PIXELS || !is_reported(settings.verbosity) || !film.is_flat() {
        return None;
    }
    let name = settings.scene.name();
    let text = fs::read_to_string(&name).unwrap_or_default();
    if allows_lint(&text, Code::OneColor.lint_name()?) {
        return None;
    }
    let warning = Diagnostic::warning(None, "all pixels of this picture have one colour")
        .with_code(Code::OneColor)
        .with_hint(format!("`povr check {name}` looks for the reason."));
    Some(Message::new(&warning, &Sources::default()))
}

fn is_reported(verbosity: Verbosity) -> bool {
    verbosity.is_terminal && !verbosity.is_povray && !verbosity.quiet && !verbosity.json
}

/// The name of the output.
fn name(settings: &Settings) -> String {
    match &settings.output {
        Some((Target::File(path), _)) => path.display().to_string(),
        Some((Target::Stdout, _)) => "standard output".to_owned(),
        None => format!("{} (not written)", settings.scene.name()),
    }
}

fn line(name: &str, settings: &Settings, took: Duration) -> String {
    let (width, height) = (settings.render.width, settings.render.height);
    format!("{name}  {width}x{height}  {}", time(took))
}

/// `0.42 s`, `11.2 s`, `3 min 20 s`.
fn time(took: Duration) -> String {
    let seconds = took.as_secs_f64();
    match took.as_secs() {
        0 => format!("{seconds:.2} s"),
        1..120 => format!("{seconds:.1} s"),
        whole => format!("{} min {} s", whole / 60, whole % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_as_many_digits_as_people_read() {
        for (milliseconds, expected) in [
            (4, "0.00 s"),
            (423, "0.42 s"),
            (11_240, "11.2 s"),
            (119_900, "119.9 s"),
            (200_900, "3 min 20 s"),
        ] {
            assert_eq!(time(Duration::from_millis(milliseconds)), expected);
        }
    }
}
