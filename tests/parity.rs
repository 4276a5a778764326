//! Each scene of `pov_scenes/` is drawn by POV-Ray and by povr, and the pictures are to be the same.
//!
//! A scene's first line is a comment that says what it shows. Further comments may state `// size: 320x240`, switches
//! for both renderers, `// switches: +A0.3 +AM2` (several such lines: the scene is drawn with each), and limits with their
//! reason, `// compare: channel<=2 pixels<=0.5% because "..."`; without them `Limits::DEFAULT` holds, and
//! single pixels (never more than `Limits::DEFAULT` allows) may be off by more if they are explained: POV-Ray loses
//! surfaces nearer than a fixed distance to the one a ray leaves, and with `--pov-distances` povr does so too and must
//! then be within `Limits::DEFAULT`.
//! POV-Ray's pictures are kept in `target/parity/reference/` under a hash of all that goes into them, so that only new
//! and changed scenes cost its start-up time. A failure leaves expected | difference | actual in `target/parity/failed/`.
//! Run one folder with `cargo test --test parity shape/`.

mod support;

use image::DynamicImage;
use libtest_mimic::{Arguments, Failed, Trial};
use povr::compare::{Comparison, Limits, Verdict, compare, side_by_side};
use std::fmt::Display;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::{Arc, LazyLock, Mutex};
use std::time::Duration;

/// POV-Ray needs a second for the slowest scene; a machine under load may need much more.
const TIME_LIMIT: Duration = Duration::from_secs(120);
/// Where Debian keeps the standard include files.
const STANDARD_INCLUDES: &str = "/usr/share/povray-3.7/include";
/// POV-Ray spends most of its wall time asleep, so more tests run at once than there are processors.
const TESTS_PER_PROCESSOR: usize = 4;

/// Remarks on scenes that pass, printed after the last test.
type Remarks = Arc<Mutex<Vec<String>>>;

/// A scene and what it says about its own test.
struct Case {
    path: PathBuf,
    name: String,
    text: String,
    size: (u32, u32),
    limits: Option<Limits>,
    /// Switches for both renderers, behind the usual ones.
    own_switches: Vec<String>,
}

fn main() -> ExitCode {
    let mut arguments = Arguments::from_args();
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    arguments
        .test_threads
        .get_or_insert(TESTS_PER_PROCESSOR * processors);
    let remarks = Remarks::default();
    let trials = match support::scenes(Path::new(support::SCENES)) {
        Ok(scenes) => scenes
            .into_iter()
            .flat_map(|path| trials(&path, &remarks))
            .collect(),
        Err(error) => vec![Trial::test("pov_scenes", move || Err(error.into()))],
    };
    let conclusion = libtest_mimic::run(&arguments, trials);
    let remarks = remarks.lock().map(|list| list.join("\n"));
    if let Ok(remarks) = remarks
        && !remarks.is_empty()
    {
        print_remarks(&remarks);
    }
    conclusion.exit_code()
}

#[allow(
    clippy::print_stderr,
    reason = "the end of a test run is read on the terminal"
)]
fn print_remarks(remarks: &str) {
    eprintln!("{remarks}\n");
}

/// The name of a scene: its path below `pov_scenes/` without extension, with `/` on every system.
fn scene_name(path: &Path) -> String {
    let relative = path.strip_prefix(support::SCENES).unwrap_or(path);
    let parts: Vec<_> = relative.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/").trim_end_matches(".pov").to_owned()
}

/// A test for each line of switches of a scene, or one without any.
fn trials(path: &Path, remarks: &Remarks) -> Vec<Trial> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let comments = text
        .lines()
        .filter_map(|line| line.trim().strip_prefix("//"));
    let lines = comments.filter_map(|comment| comment.trim().strip_prefix("switches:"));
    let mut variants: Vec<Vec<String>> = lines
        .map(|line| line.split_whitespace().map(str::to_owned).collect())
        .collect();
    let is_one = variants.len() < 2;
    if variants.is_empty() {
        variants.push(Vec::new());
    }
    let trial = |switches: Vec<String>| {
        let (path, remarks) = (path.to_owned(), Arc::clone(remarks));
        let mut name = scene_name(&path);
        if !is_one {
            name = format!("{name} {}", switches.join(" "));
        }
        let kept = name.clone();
        Trial::test(name, move || {
            let case = Case::read(path, kept, switches)?;
            let remark = case.check()?;
            if let (Some(remark), Ok(mut list)) = (remark, remarks.lock()) {
                list.push(format!("{}: {remark}", case.name));
            }
            Ok(())
        })
    };
    variants.into_iter().map(trial).collect()
}

impl Case {
    fn read(path: PathBuf, name: String, own_switches: Vec<String>) -> Result<Case, Failed> {
        let text = String::from_utf8_lossy(&fs::read(&path)?).into_owned();
        let first = text.lines().next().unwrap_or_default();
        if first
            .strip_prefix("// ")
            .is_none_or(|fact| fact.trim().len() < 10)
        {
            return Err("the first line is to be a comment that says what the scene shows".into());
        }
        let mut case = Case {
            name,
            path,
            size: (160, 120),
            limits: None,
            own_switches,
            text: String::new(),
        };
        let comments = text
            .lines()
            .filter_map(|line| line.trim().strip_prefix("//"));
        for comment in comments.map(str::trim) {
            if let Some(limits) = comment.strip_prefix(Limits::COMMENT) {
                let (limits, _reason) = Limits::from_comment(limits)?;
                if case.limits.replace(limits).is_some() {
                    return Err("the scene states its limits twice".into());
                }
            } else if let Some(size) = comment.strip_prefix("size:") {
                case.size = read_size(size)?;
            }
        }
        case.text = text;
        Ok(case)
    }

    /// Draws the scene twice and compares. Gives a remark if the scene passes but is worth a look.
    fn check(&self) -> Result<Option<String>, Failed> {
        let expected = image::open(self.reference()?)?;
        let picture = support::scratch("parity/actual")?.join(self.file_name("png"));
        self.render(&support::renderer(), &[], &picture)?;
        let actual = image::open(&picture)?;
        let sheet = support::scratch("parity/failed")?.join(self.file_name("png"));
        let found = compare(&expected, &actual).map_err(|mismatch| {
            let saved = side_by_side(&expected, &actual).save(&sheet);
            format!("{mismatch}{}", seen_in(&sheet, saved))
        })?;
        let limits = self.limits.unwrap_or(Limits::DEFAULT);
        let broken = match limits.verdict(&found) {
            Verdict::Within => None,
            Verdict::TooManyPixels => Some("too many pixels differ"),
            Verdict::ChannelOff if self.is_explained(&found, &expected)? => None,
            Verdict::ChannelOff => Some("a channel is off by too much"),
        };
        if let Some(broken) = broken {
            let saved = side_by_side(&expected, &actual).save(&sheet);
            return Err(
                format!("{broken} for `{limits}`\n{found}{}", seen_in(&sheet, saved)).into(),
            );
        }
        // An old sheet would tell of a failure that is over.
        let _ = fs::remove_file(&sheet);
        let is_idle = self.limits.is_some() && Limits::DEFAULT.verdict(&found) == Verdict::Within;
        Ok(is_idle.then(|| format!("no longer needs its limits `{limits}`; {found}")))
    }

    /// Whether the few pixels that differ do so only because POV-Ray loses surfaces that are too near to each other.
    fn is_explained(&self, found: &Comparison, expected: &DynamicImage) -> Result<bool, Failed> {
        if self.limits.is_some() || found.differing_percent() > Limits::DEFAULT.pixels {
            return Ok(false);
        }
        let picture = support::scratch("parity/pov-distances")?.join(self.file_name("png"));
        self.render(&support::renderer(), &["--pov-distances"], &picture)?;
        let as_pov_ray = compare(expected, &image::open(&picture)?)?;
        Ok(Limits::DEFAULT.verdict(&as_pov_ray) == Verdict::Within)
    }

    /// The path of POV-Ray's picture, drawn now if no earlier run kept it.
    fn reference(&self) -> Result<PathBuf, Failed> {
        let version = POVRAY_VERSION.as_ref().map_err(Failed::from)?;
        let mut hasher = DefaultHasher::new();
        (version, self.switches()).hash(&mut hasher);
        hash_with_includes(&self.text, self.folder(), &mut hasher);
        let key = hasher.finish();
        let folder = support::scratch("parity/reference")?;
        let kept = folder.join(format!("{key:016x}.png"));
        if !kept.exists() {
            let drawn = folder.join(format!("{key:016x}-{}.png", std::process::id()));
            self.render("povray".as_ref(), &["+WT1"], &drawn)?;
            fs::rename(&drawn, &kept)?;
        }
        Ok(kept)
    }

    fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new("."))
    }

    fn file_name(&self, extension: &str) -> String {
        format!("{}.{extension}", self.name.replace(['/', ' '], "-"))
    }

    fn switches(&self) -> Vec<String> {
        let (width, height) = self.size;
        let mut switches = vec![format!("+W{width}"), format!("+H{height}")];
        switches.extend(["-D", "-A"].map(String::from));
        switches.push(format!("+L{}", self.folder().display()));
        switches.push(format!("+L{STANDARD_INCLUDES}"));
        switches.extend(self.own_switches.iter().cloned());
        switches
    }

    /// Draws the scene to `picture`.
    ///
    /// POV-Ray writes only into the folder it runs in and reads only below it and the home folder, so the one is the
    /// picture's and the other the scenes'.
    fn render(
        &self,
        renderer: &std::ffi::OsStr,
        more: &[&str],
        picture: &Path,
    ) -> Result<(), Failed> {
        let _ = fs::remove_file(picture);
        let mut command = Command::new(renderer);
        command
            .current_dir(picture.parent().unwrap_or(Path::new(".")))
            .env("HOME", support::SCENES)
            .arg(format!("+I{}", self.path.display()))
            .arg(format!(
                "+O{}",
                picture.file_name().unwrap_or_default().display()
            ))
            .args(self.switches())
            .args(more);
        let program = renderer.display();
        let ended = support::run(&mut command, TIME_LIMIT)
            .map_err(|error| format!("{program} does not start: {error}"))?;
        match ended.status {
            None => Err(format!("{program} ran for more than {TIME_LIMIT:?}").into()),
            Some(status) if !status.success() => {
                Err(format!("{program} ended with {status}:\n{}", tail(&ended.stderr)).into())
            }
            Some(_) if !picture.exists() => {
                Err(format!("{program} drew no picture:\n{}", tail(&ended.stderr)).into())
            }
            Some(_) => Ok(()),
        }
    }
}

/// What `povray --version` says, or why there is nothing to compare with.
static POVRAY_VERSION: LazyLock<Result<String, String>> = LazyLock::new(|| {
    support::run(Command::new("povray").arg("--version"), TIME_LIMIT)
        .map(|ended| ended.stderr)
        .map_err(|error| {
            format!(
                "`povray` does not run ({error}); `tools/test` installs it and then runs this test"
            )
        })
});

fn read_size(text: &str) -> Result<(u32, u32), Failed> {
    let sides = text.trim().split_once('x');
    sides
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)))
        .filter(|&(width, height): &(u32, u32)| width > 0 && height > 0)
        .ok_or_else(|| format!("expected `size: 320x240`, found `size:{text}`").into())
}

/// Takes in a scene and all files it may include from its own folder. Names in comments only cost a needless drawing.
fn hash_with_includes(text: &str, folder: &Path, hasher: &mut DefaultHasher) {
    let mut texts = vec![text.to_owned()];
    let mut seen = Vec::new();
    while let Some(text) = texts.pop() {
        text.hash(hasher);
        for name in text.split('"').skip(1) {
            let path = folder.join(name);
            if name.len() < 200 && !seen.contains(&path) && path.is_file() {
                texts.extend(
                    fs::read(&path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()),
                );
                seen.push(path);
            }
        }
    }
}

/// The last lines of a renderer's messages.
fn tail(stderr: &str) -> String {
    let lines: Vec<_> = stderr
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    lines[lines.len().saturating_sub(12)..].join("\n")
}

fn seen_in(sheet: &Path, saved: Result<(), impl Display>) -> String {
    match saved {
        Ok(()) => format!("\nexpected | difference | actual: {}", sheet.display()),
        Err(error) => format!("\n{} cannot be written: {error}", sheet.display()),
    }
}
