//! `-benchmark`, under the name of POV-Ray: its benchmark scene as installed, with the options of POV-Ray 3.7.0.10.
//!
//! POV-Ray carries the scene in its program; here it comes from the scenes that are distributed with it. Only the
//! number of threads and library paths can be chosen, as in POV-Ray. Nothing waits for a key.

use super::report::say;
use crate::app::cli::options::error::CliError;
use std::path::Path;

/// Where distributions put the scene.
const SCENES: [&str; 4] = [
    "/usr/share/doc/povray/examples/advanced/benchmark/benchmark.pov",
    "/usr/share/povray-3.7/scenes/advanced/benchmark/benchmark.pov",
    "/usr/local/share/povray-3.7/scenes/advanced/benchmark/benchmark.pov",
    "/usr/share/povray/scenes/advanced/benchmark/benchmark.pov",
];

/// Size and antialiasing of the benchmark, without a picture; all messages also go to a file.
const OPTIONS: [&str; 7] = [
    "+W512",
    "+H512",
    "+A0.3",
    "+R3",
    "+J0.3",
    "-F",
    "All_File=alltext.out",
];

/// The arguments of the benchmark, if it is wanted.
///
/// # Errors
/// When the scene is not installed.
pub(crate) fn arguments(given: &[String]) -> Result<Option<Vec<String>>, CliError> {
    let is_wanted = |word: &String| ["-benchmark", "--benchmark"].contains(&word.as_str());
    if !given.iter().any(is_wanted) {
        return Ok(None);
    }
    let scene = SCENES.iter().find(|scene| Path::new(scene).is_file());
    let scene = scene.ok_or_else(|| {
        CliError::new("the benchmark scene of POV-Ray is not installed")
            .with_hint(format!("Looked for `{}`.", SCENES.join("`, `")))
    })?;
    say(format_args!(
        "Running the benchmark scene of POV-Ray, {scene}"
    ));
    let chosen = given.iter().filter(|word| is_choosable(word));
    let fixed = OPTIONS.iter().map(|option| (*option).to_owned());
    Ok(Some(
        std::iter::once(format!("+I{scene}"))
            .chain(fixed)
            .chain(chosen.cloned())
            .collect(),
    ))
}

fn is_choosable(word: &str) -> bool {
    let name = word.strip_prefix(['+', '-']).map(str::to_ascii_lowercase);
    name.is_some_and(|name| name.starts_with("wt") || name.starts_with('l'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_and_library_paths_can_be_chosen() {
        for (word, expected) in [
            ("+WT4", true),
            ("-wt4", true),
            ("+L../include", true),
            ("+W800", false),
            ("s.pov", false),
            ("-benchmark", false),
        ] {
            assert_eq!(is_choosable(word), expected, "{word}");
        }
        let given = vec!["s.pov".to_owned()];
        assert_eq!(arguments(&given).unwrap(), None);
    }
}
