//! A scene and the comments in it that control its comparison.
//!
//! `// size: 320x240`, switches for both renderers, `// switches: +A0.3 +AM2` (several such lines: the scene is
//! rendered with each), and limits with their reason, `// compare: channel<=2 pixels<=0.5% because "..."`. Switches of
//! a scene may only set antialiasing, quality, the clock and transparency: an untrusted scene must not name files.

use super::renderer::library;
use super::{LimitError, Limits};
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The switches that a scene may use.
const SWITCHES: [&str; 10] = ["A", "AC", "AM", "AG", "FN", "J", "R", "Q", "K", "UA"];
/// One with a method behind it.
const DITHER: &str = "TH";

/// A scene to be compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The scene, as a path from the root.
    pub scene: PathBuf,
    /// The name in reports; includes the switches if the scene has several lines of them.
    pub name: String,
    /// The text of the scene.
    pub text: String,
    /// The size in the scene.
    pub size: Option<(u32, u32)>,
    /// The limits in the scene.
    pub limits: Option<Limits>,
    /// The switches in the scene, which follow the usual ones.
    pub switches: Vec<String>,
}

/// Errors in a scene to be compared or in its comments.
#[derive(Debug)]
pub enum CaseError {
    /// The file cannot be read.
    Read(PathBuf, io::Error),
    /// The limits are malformed.
    Limits(LimitError),
    /// The limits are stated twice.
    LimitsTwice,
    /// A malformed size.
    Size(String),
    /// A switch that a scene may not use.
    Switch(String),
}

impl Case {
    /// The cases of a scene: one for each line of switches, or one without any.
    ///
    /// # Errors
    /// When the scene cannot be read or its comments cannot be understood.
    pub fn of(scene: &Path, name: &str) -> Result<Vec<Case>, CaseError> {
        let unread = |error| CaseError::Read(scene.to_owned(), error);
        let text = fs::read(scene).map_err(unread)?;
        let text = String::from_utf8_lossy(&text).into_owned();
        let mut case = Case {
            scene: std::path::absolute(scene).map_err(unread)?,
            name: name.to_owned(),
            text: String::new(),
            size: None,
            limits: None,
            switches: Vec::new(),
        };
        let mut lines = Vec::new();
        for comment in comments(&text) {
            if let Some(limits) = comment.strip_prefix(Limits::COMMENT) {
                let (limits, _reason) = Limits::from_comment(limits).map_err(CaseError::Limits)?;
                if case.limits.replace(limits).is_some() {
                    return Err(CaseError::LimitsTwice);
                }
            } else if let Some(size) = comment.strip_prefix("size:") {
                let parsed = read_size(size).ok_or_else(|| CaseError::Size(size.to_owned()))?;
                case.size = Some(parsed);
            } else if let Some(switches) = comment.strip_prefix("switches:") {
                let switches: Vec<String> =
                    switches.split_whitespace().map(str::to_owned).collect();
                if let Some(other) = switches.iter().find(|switch| !is_allowed(switch)) {
                    return Err(CaseError::Switch(other.clone()));
                }
                lines.push(switches);
            }
        }
        case.text = text;
        if lines.is_empty() {
            lines.push(Vec::new());
        }
        let is_one = lines.len() < 2;
        let with = |switches: Vec<String>| Case {
            name: match is_one {
                true => case.name.clone(),
                false => format!("{} {}", case.name, switches.join(" ")),
            },
            switches,
            ..case.clone()
        };
        Ok(lines.into_iter().map(with).collect())
    }

    /// The scene without its comments on comparison.
    ///
    /// # Errors
    /// When the scene cannot be read.
    pub fn plain(scene: &Path, name: &str) -> Result<Case, CaseError> {
        let unread = |error| CaseError::Read(scene.to_owned(), error);
        let text = fs::read(scene).map_err(unread)?;
        Ok(Case {
            scene: std::path::absolute(scene).map_err(unread)?,
            name: name.to_owned(),
            text: String::from_utf8_lossy(&text).into_owned(),
            size: None,
            limits: None,
            switches: Vec::new(),
        })
    }

    /// All switches for both renderers: the size, then others, the folders of includes, and those of the scene.
    pub(super) fn all_switches(
        &self,
        size: (u32, u32),
        includes: &Path,
        others: &[String],
    ) -> Vec<String> {
        let (width, height) = self.size.unwrap_or(size);
        let mut switches = vec![format!("+W{width}"), format!("+H{height}")];
        switches.extend(["-D", "-A"].map(String::from));
        switches.extend(library(&self.scene, includes));
        switches.extend(others.iter().cloned());
        switches.extend(self.switches.iter().cloned());
        switches
    }

    /// A file name for the case.
    #[must_use]
    pub fn file_name(&self, extension: &str) -> String {
        format!("{}.{extension}", self.name.replace(['/', ' '], "-"))
    }
}

/// The texts of the comments on lines of their own.
fn comments(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .filter_map(|line| Some(line.trim().strip_prefix("//")?.trim()))
}

fn is_allowed(switch: &str) -> bool {
    let body = switch.strip_prefix(['+', '-']).unwrap_or_default();
    let digits = |c: char| c.is_ascii_digit() || c == '.';
    let name = body.trim_end_matches(digits).to_ascii_uppercase();
    SWITCHES.contains(&name.as_str()) || name.starts_with(DITHER)
}

fn read_size(text: &str) -> Option<(u32, u32)> {
    let (width, height) = text.trim().split_once('x')?;
    let size = (width.parse().ok()?, height.parse().ok()?);
    (size.0 > 0 && size.1 > 0).then_some(size)
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CaseError::Read(path, error) => write!(f, "cannot read `{}`: {error}", path.display()),
            CaseError::Limits(error) => error.fmt(f),
            CaseError::LimitsTwice => f.write_str("the scene states its limits twice"),
            CaseError::Size(actual) => write!(f, "expected `size: 320x240`, found `size:{actual}`"),
            CaseError::Switch(switch) => write!(f, "a scene may not set `{switch}` in `switches:`"),
        }
    }
}

impl std::error::Error for CaseError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn cases(text: &str) -> Result<Vec<Case>, CaseError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), text).unwrap();
        Case::of(file.path(), "a/b")
    }

    #[test]
    fn comments_say_how_a_scene_is_compared() {
        let parsed = cases(
            "// A fact.\n// size: 32x24\n  // switches: +A0.3 +AM2 -J\n// switches: +Q4\n\
             // compare: channel<=2 pixels<=1% because \"why\"\nsphere { }",
        )
        .unwrap();
        let names: Vec<_> = parsed.iter().map(|case| case.name.as_str()).collect();
        assert_eq!(names, ["a/b +A0.3 +AM2 -J", "a/b +Q4"]);
        assert_eq!(parsed[0].size, Some((32, 24)));
        assert_eq!(
            parsed[1].limits,
            Some(Limits {
                channel: 2,
                pixels: 1.0
            })
        );
        assert_eq!(parsed[1].file_name("png"), "a-b-+Q4.png");
        let switches = parsed[1].all_switches((160, 120), Path::new("/"), &[]);
        assert_eq!(
            (switches[0].as_str(), switches.last().unwrap().as_str()),
            ("+W32", "+Q4")
        );
    }

    #[test]
    fn a_scene_may_not_name_files_or_be_unclear() {
        for (text, expected) in [
            (
                "// switches: +O/etc/passwd",
                "a scene may not set `+O/etc/passwd` in `switches:`",
            ),
            (
                "// switches: +A --output",
                "a scene may not set `--output` in `switches:`",
            ),
            (
                "// switches: Output_File_Name=x",
                "a scene may not set `Output_File_Name=x` in `switches:`",
            ),
            (
                "// size: big",
                "expected `size: 320x240`, found `size: big`",
            ),
            (
                "// size: 0x3",
                "expected `size: 320x240`, found `size: 0x3`",
            ),
        ] {
            assert_eq!(cases(text).unwrap_err().to_string(), expected);
        }
        let twice = "// compare: channel<=2 pixels<=1% because \"a\"\n".repeat(2);
        assert!(matches!(cases(&twice), Err(CaseError::LimitsTwice)));
    }
}
