//! The ini file of `Create_Ini`: all options of a run, one a line.
//!
//! As in POV-Ray 3.7.0.10, options of the system's ini file are among them, a later value replaces an earlier one, names
//! are in quotes, and switches are written by their keys.

use super::raw_args::RawArgs;
use std::fmt::Write;

/// Options that may be set several times.
const REPEATED: [&str; 3] = ["Declare", "Library_Path", "Library_Path_38"];

/// The text of the file.
pub(crate) fn text(system: &RawArgs, own: &RawArgs) -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = ("Work_Threads", cores.to_string());
    let mut last: Vec<(&str, &str)> = Vec::new();
    for (key, value) in std::iter::once(&threads)
        .chain(&system.given)
        .chain(&own.given)
    {
        if !REPEATED.contains(key) {
            last.retain(|(other, _)| other != key);
        }
        last.push((key, value));
    }
    last.sort_by_key(|(key, _)| *key);
    let mut text = String::new();
    for (key, value) in last {
        let _ = writeln!(text, "{key}={}", written(key, value));
    }
    text
}

/// A value as POV-Ray writes it.
fn written(key: &str, value: &str) -> String {
    let key = key.to_ascii_lowercase();
    let is_name = ["_file", "_name", "_path", "_header", "_ini", "_command"]
        .iter()
        .any(|end| key.ends_with(end))
        && key != "output_to_file";
    match value.to_ascii_lowercase().as_str() {
        _ if is_name => format!("\"{value}\""),
        _ if key == "output_file_type" => value.chars().take(1).collect(),
        "on" | "yes" | "true" => "On".to_owned(),
        "off" | "no" | "false" => "Off".to_owned(),
        _ => value
            .parse::<f64>()
            .map_or_else(|_| value.to_owned(), |number| number.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_values_count_and_declarations_are_all_retained() {
        let given = |options: &[(&'static str, &str)]| RawArgs {
            given: options
                .iter()
                .map(|(key, value)| (*key, (*value).to_owned()))
                .collect(),
            ..RawArgs::default()
        };
        let system = given(&[
            ("Verbose", "true"),
            ("Work_Threads", "2"),
            ("Library_Path", "/a"),
        ]);
        let own = given(&[
            ("Width", "12.50"),
            ("Declare", "B=2"),
            ("Verbose", "off"),
            ("Declare", "A=1"),
            ("Output_To_File", "on"),
            ("Output_File_Type", "N8"),
            ("Library_Path", "b"),
        ]);
        assert_eq!(
            text(&system, &own),
            "Declare=B=2\nDeclare=A=1\nLibrary_Path=\"/a\"\nLibrary_Path=\"b\"\nOutput_File_Type=N\n\
             Output_To_File=On\nVerbose=Off\nWidth=12.5\nWork_Threads=2\n"
        );
    }
}
