//! Scenes from strangers, and a machine that refuses: each run ends soon, with its message or its picture, and nothing
//! else has changed on disk.

#![cfg(unix)]

#[path = "support/mod.rs"]
mod support;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// A scene that waits for a file waits for ever; all others here are done at once.
const LIMIT: Duration = Duration::from_secs(5);

const REST: &str = "camera { location -5*z look_at 0 } light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }\n";

/// What scenes do with a file that they name `FILE`.
const READERS: [&str; 14] = [
    "#include \"FILE\"",
    "#fopen F \"FILE\" read",
    "sphere { 0, 1 pigment { image_map { \"FILE\" } } }",
    "sphere { 0, 1 pigment { image_map { png \"FILE\" } } }",
    "sphere { 0, 1 pigment { image_map { jpeg \"FILE\" } } }",
    "sphere { 0, 1 pigment { image_map { exr \"FILE\" } } }",
    "sphere { 0, 1 pigment { image_pattern { tga \"FILE\" } } }",
    "sphere { 0, 1 pigment { rgb 1 } normal { bump_map { gif \"FILE\" } } }",
    "sphere { 0, 1 texture { material_map { bmp \"FILE\" texture { pigment { rgb 1 } } } } }",
    "height_field { ppm \"FILE\" }",
    "text { ttf \"FILE\" \"a\", 1, 0 }",
    "sphere { 0, 1 hollow pigment { rgbt 1 } interior { media { density { density_file df3 \"FILE\" } } } }",
    "global_settings { photons { spacing 0.1 load_file \"FILE\" } }",
    "#declare F = function { pigment { image_map { tiff \"FILE\" } } }",
];

/// A folder in which a stranger's scene `s.pov` lies, a folder for temporary files, and one that is nobody's business.
struct Place {
    all: tempfile::TempDir,
}

/// How a run ended: its exit code, if it did end by itself, and what it said.
struct Ended {
    code: Option<i32>,
    said: String,
}

impl Place {
    fn new() -> Self {
        let all = tempfile::tempdir().expect("temporary folders can be made");
        for folder in ["here", "tmp", "other"] {
            fs::create_dir(all.path().join(folder)).expect("folders can be made");
        }
        Place { all }
    }

    fn with(scene: &str) -> Self {
        let place = Place::new();
        place.write("here/s.pov", &format!("{REST}{scene}\n"));
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.all.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("files can be written");
    }

    fn pipe(&self, name: &str) {
        let made = Command::new("mkfifo").arg(self.path(name)).status();
        assert!(made.expect("mkfifo is there").success());
    }

    /// Runs a shell command in the folder of the scene; `$POVR` is the program.
    fn shell(&self, command: &str) -> Ended {
        let mut shell = Command::new("sh");
        // What the shell starts would not end with it.
        let command = command.replace("$POVR", "timeout -s KILL 5 \"$POVR\"");
        shell
            .args(["-c", &command])
            .current_dir(self.path("here"))
            .env("TMPDIR", self.path("tmp"))
            .env("POVR", support::renderer());
        let ended = support::run(&mut shell, 2 * LIMIT).expect("the shell starts");
        Ended {
            code: ended.status.and_then(|status| status.code()),
            said: ended.stderr,
        }
    }

    /// Draws the scene.
    fn draw(&self) -> Ended {
        self.shell("$POVR s.pov +W16 +H12 -D -A +WT2 -o s.png")
    }

    /// All files below, with their contents; of what is no regular file, and of pictures, only that they are there.
    fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        collect(self.all.path(), &mut found);
        found
    }
}

fn collect(folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("the folder is readable") {
        let path = entry.expect("the folder is readable").path();
        let about = fs::symlink_metadata(&path).expect("it is there");
        if about.is_dir() {
            collect(&path, found);
        }
        let is_picture = path.extension().is_some_and(|ending| ending == "png");
        let bytes = match about.is_file() && !is_picture {
            true => fs::read(&path).expect("it is readable"),
            false => Vec::new(),
        };
        found.insert(path, bytes);
    }
}

/// Draws a scene that is to be refused in its last line, and checks that nothing has changed.
fn refused(place: &Place, says: &str) {
    let before = place.files();
    let ended = place.draw();
    let Ended { code, said } = &ended;
    assert_eq!(*code, Some(1), "{said}");
    assert!(said.contains(says), "not `{says}`, but {said}");
    assert!(said.contains("File 's.pov' line 3"), "{said}");
    assert!(place.files() == before, "{said}");
}

#[test]
fn a_pipe_is_not_waited_for() {
    for reader in READERS {
        let place = Place::with(&reader.replace("FILE", "ff"));
        place.pipe("here/ff");
        refused(&place, "`ff` is not a regular file but a pipe");
    }
}

#[test]
fn links_to_devices_and_devices_are_not_read() {
    for file in ["/dev/zero", "link", "/dev/tty"] {
        for reader in [READERS[0], READERS[1], READERS[3], READERS[10]] {
            let place = Place::with(&reader.replace("FILE", file));
            symlink("/dev/zero", place.path("here/link")).expect("links can be made");
            refused(
                &place,
                &format!("`{file}` is not a regular file but a device"),
            );
        }
    }
}

#[test]
fn that_a_pipe_is_there_can_be_asked() {
    let place = Place::with("#if (!file_exists(\"ff\")) #error \"not there\" #end");
    place.pipe("here/ff");
    let ended = place.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
}

#[test]
fn pipes_in_the_library_are_no_include_files() {
    // A name that is not declared is looked for in the include files of the library.
    let place = Place::with("sphere { 0, 1 texture { T_Stone99 } }");
    place.pipe("other/stones.inc");
    let ended = place.shell("$POVR s.pov +L../other -F -D");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    assert!(ended.said.contains("T_Stone99"), "{}", ended.said);
}

#[test]
fn a_header_is_a_regular_file() {
    let place = Place::with("");
    place.pipe("here/ff");
    let ended = place.shell("$POVR s.pov +HIff -F -D");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "`ff` is not a regular file but a pipe";
    assert!(ended.said.contains(says), "{}", ended.said);
}

#[test]
fn a_pipe_is_not_written_to() {
    for mode in ["write", "append"] {
        let place = Place::with(&format!("#fopen F \"ff\" {mode} #write(F, 1)"));
        place.pipe("here/ff");
        refused(&place, "`ff` is not a regular file but a pipe");
    }
    let place = Place::with("#fopen F \"link\" append #write(F, 1)");
    symlink("/dev/zero", place.path("here/link")).expect("links can be made");
    refused(&place, "this scene may not write to `link`");
}

/// The scene itself is named by the user, who may well let another program write it.
#[test]
fn the_scene_may_come_out_of_a_pipe() {
    let place = Place::with("#include \"a.inc\"");
    place.write("here/a.inc", "#declare A = 1;");
    place.pipe("here/ff");
    for command in [
        "cat s.pov | $POVR +I/dev/stdin +W16 +H12 -D -o s.png",
        "cat s.pov | $POVR +I- +W16 +H12 -D -o s.png",
        "cat s.pov > ff & $POVR +Iff +W16 +H12 -D -o s.png",
        "cat s.pov | $POVR check /dev/stdin",
    ] {
        let ended = place.shell(command);
        assert_eq!(ended.code, Some(0), "{command}: {}", ended.said);
    }
}

#[test]
fn a_batch_goes_on_past_pipes() {
    let place = Place::with("#include \"ff\"");
    place.write("here/right.pov", REST);
    place.pipe("here/ff");
    place.pipe("here/pipe.pov");
    let ended = place.shell("$POVR batch . --timeout 60s +W16 +H12 -o ../tmp/out");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "ff` is not a regular file but a pipe";
    assert!(ended.said.contains(says), "{}", ended.said);
    assert!(place.path("tmp/out/right.png").is_file());
    let ended = place.shell("$POVR batch pipe.pov --timeout 60s +W16 +H12 -o ../tmp/out");
    assert!(ended.code.is_some_and(|code| code > 0 && code < 100));
    let says = "a batch reads regular files only";
    assert!(ended.said.contains(says), "{}", ended.said);
}

/// A scene with photons that it saves in `FILE`.
fn photons(file: &str) -> String {
    format!(
        "global_settings {{ photons {{ spacing 0.3 save_file \"{file}\" }} }}
sphere {{ 0, 1 pigment {{ rgbt 1 }} interior {{ ior 1.5 }} photons {{ target refraction on }} }}"
    )
}

#[test]
fn photons_are_saved_where_a_scene_may_write() {
    let place = Place::with(&photons("map"));
    let before = place.files();
    let ended = place.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let mut after = place.files();
    assert!(after.remove(&place.path("here/s.png")).is_some());
    assert!(after.remove(&place.path("here/map")).is_some());
    assert!(after == before);

    for file in ["OTHER/there", "OTHER/new", "../other/there", "link"] {
        let place = Place::with("");
        let other = place.path("other").display().to_string();
        let scene = photons(&file.replace("OTHER", &other));
        place.write("here/s.pov", &format!("{REST}{scene}"));
        place.write("other/there", "precious");
        symlink(place.path("other/there"), place.path("here/link")).expect("links can be made");
        refused(&place, "this scene may not write to `");
    }
}

#[test]
fn photons_do_not_go_into_a_pipe() {
    let place = Place::with(&photons("ff"));
    place.pipe("here/ff");
    let before = place.files();
    let ended = place.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let says = "`ff` is not a regular file but a pipe";
    assert!(ended.said.contains(says), "{}", ended.said);
    let mut after = place.files();
    assert!(after.remove(&place.path("here/s.png")).is_some());
    assert!(after == before);
}

#[test]
fn frames_that_save_photons_are_drawn_one_after_the_other() {
    let place = Place::with(&photons("map"));
    let ended = place.shell("$POVR s.pov +KFF3 +W16 +H12 -D -o s.png");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(place.path("here/map").is_file() && place.path("here/s3.png").is_file());
    let ended = place.shell("$POVR batch s.pov +W16 +H12 -o ../tmp/out");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
}

/// Every way in which a scene reads again what it wrote.
const WRITER: &str = "#fopen F \"new.txt\" write #write(F, \"1,\") #fclose F
#fopen F \"new.txt\" append #write(F, \"2,\") #fclose F
#fopen F \"there.txt\" append #write(F, \",4\") #fclose F
#fopen F \"../tmp/part.inc\" write #write(F, \"#declare B = 5;\")
#include \"../tmp/part.inc\"
#include \"part\"
#write(F, \"#declare B = B + 1;\")
#include \"../here/../tmp/part.inc\"
#fopen G \"new.txt\" read #read(G, One, Two)
#fopen H \"there.txt\" read #read(H, Three, Four)
#fopen P \"p.pgm\" write #write(P, \"P2 2 2 255 0 255 255 0 \") #fclose P
plane { z, 9 pigment { image_map { pgm \"p.pgm\" } } }
#if (!file_exists(\"p.pgm\") | file_exists(\"none\")) #error \"wrong\" #end
#debug concat(str(One, 0, 0), str(Two, 0, 0), str(Three, 0, 0), str(Four, 0, 0), str(B, 0, 0))\n";

#[test]
fn a_check_writes_nothing_and_reads_what_was_written() {
    let place = Place::with(WRITER);
    place.write("here/there.txt", "3");
    let before = place.files();
    let ended = place.shell("$POVR check s.pov +L../tmp >&2");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(ended.said.contains("12346"), "{}", ended.said);
    assert!(place.files() == before, "{}", ended.said);
    // Drawing says the same and writes.
    let ended = place.shell("$POVR s.pov +L../tmp +W16 +H12 -o s.png");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(ended.said.contains("12346"), "{}", ended.said);
    let written = fs::read_to_string(place.path("here/there.txt"));
    assert_eq!(written.expect("it is there"), "3,4");
    assert_eq!(place.files().len(), before.len() + 4);
}

#[test]
fn a_check_finds_what_drawing_would() {
    for scene in [
        "#fopen F \"none/a.txt\" write",
        "#fopen F \"none/a.txt\" append",
        "#fopen F \"ff\" write",
        "#fopen F \"../other\" append",
        "#fopen F \"../other/a.txt\" append",
        "#fopen F \"a.txt\" write #fopen G \"b.txt\" read",
    ] {
        let place = Place::with(scene);
        place.pipe("here/ff");
        let before = place.files();
        let errors = |said: &str| {
            let errors = said.lines().filter(|line| line.starts_with("error: "));
            errors.map(str::to_owned).collect::<Vec<_>>()
        };
        let checked = place.shell("$POVR check --message-format human s.pov >&2");
        assert!(place.files() == before, "{}", checked.said);
        let drawn = place.shell("$POVR --message-format human s.pov -F -D");
        assert_eq!((checked.code, drawn.code), (Some(1), Some(1)), "{scene}");
        assert_eq!(errors(&checked.said), errors(&drawn.said), "{scene}");
        assert_eq!(errors(&drawn.said).len(), 1, "{scene}: {}", drawn.said);
    }
}

/// A picture that hardly gets shorter in its file.
const NOISE: &str = "plane { z, -2 finish { ambient 1 } pigment { cells scale 0.003
  colour_map { [0 rgb 0] [0.3 rgb x] [0.6 rgb <0, 1, 0.5>] [1 rgb 1] } } }";

/// Runs a command in a file system of its own of so many KiB, mounted on the folder `disk`, where the scene lies; and
/// then says which files are there. `None` where nobody may mount.
#[allow(
    clippy::print_stderr,
    reason = "a test that is left out says so on the terminal"
)]
fn on_a_disk(kib: u32, command: &str) -> Option<(Ended, String)> {
    let place = Place::with(NOISE);
    fs::create_dir(place.path("here/disk")).expect("folders can be made");
    let mount = format!("mount -t tmpfs -o size={kib}k none disk");
    let unshare = |command: &str| {
        let mut unshare = Command::new("unshare");
        unshare
            .args(["--mount", "--map-root-user", "sh", "-c", command])
            .current_dir(place.path("here"))
            .stderr(Stdio::null());
        unshare.status().is_ok_and(|status| status.success())
    };
    if !unshare(&mount) {
        eprintln!("skipped: file systems cannot be mounted here");
        return None;
    }
    let inner = format!(
        "{mount} && cd disk && cp ../s.pov . && {command}; echo $? > ../code; ls -A > ../names"
    );
    place.write(
        "here/run.sh",
        &inner.replace("$POVR", "timeout -s KILL 5 \"$POVR\""),
    );
    let ended = place.shell("unshare --mount --map-root-user sh run.sh");
    let read = |name: &str| fs::read_to_string(place.path(name)).expect("it is there");
    let code = read("here/code").trim().parse().ok();
    let names = read("here/names").replace('\n', " ");
    let said = ended.said;
    Some((Ended { code, said }, names))
}

#[test]
fn what_is_kept_of_a_drawing_makes_room_for_its_picture() {
    // So many pixels take 1.2 MB while they are drawn and about 190 kB as a picture.
    let draw = "$POVR s.pov +C +W320 +H240 -D -A +WT2 -o s.png";
    let Some((ended, names)) = on_a_disk(300, draw) else {
        return;
    };
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert_eq!(names, "s.png s.pov ");
    assert!(ended.said.lines().count() <= 1, "{}", ended.said);

    let (ended, names) = on_a_disk(100, draw).expect("it could be mounted before");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    assert_eq!(names, "s.pov ");
    let says = "cannot write `s.png`: no space left on device";
    assert!(ended.said.contains(says), "{}", ended.said);
}

#[test]
fn a_limit_on_files_ends_in_a_message() {
    let place = Place::with(NOISE);
    let before = place.files();
    let drawn = |blocks: u32| {
        let limit = format!("ulimit -f {blocks}; ");
        place.shell(&(limit + "exec $POVR s.pov +C +W320 +H240 -D -A +WT2 -o s.png"))
    };
    let ended = drawn(16);
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "cannot write `s.png`: file too large";
    assert!(ended.said.contains(says), "{}", ended.said);
    assert!(place.files() == before, "{}", ended.said);
    // What is kept meets the limit, the picture does not.
    let ended = drawn(1000);
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let mut after = place.files();
    assert!(after.remove(&place.path("here/s.png")).is_some());
    assert!(after == before);
}

#[test]
fn a_limit_on_files_ends_what_a_scene_writes() {
    let scene = "#fopen F \"a.txt\" write #for (I, 1, 20000) #write(F, \"0123456789\") #end";
    let place = Place::with(scene);
    let before = place.files();
    let ended = place.shell("ulimit -f 16; exec $POVR s.pov -F -D");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    assert!(
        ended.said.contains("cannot write `a.txt`"),
        "{}",
        ended.said
    );
    assert!(place.files() == before, "{}", ended.said);
}
