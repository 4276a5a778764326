//! Files of scenes, and file systems without space.

use crate::folder::{Ended, REST, Sandbox};
use std::fs;
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};

/// Uses of a file named `FILE` by scenes.
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

/// Draws a scene that must be rejected in its last line, and checks that nothing has changed.
fn refused(sandbox: &Sandbox, says: &str) {
    let before = sandbox.files();
    let ended = sandbox.draw();
    let Ended { code, said } = &ended;
    assert_eq!(*code, Some(1), "{said}");
    assert!(said.contains(says), "not `{says}`, but {said}");
    assert!(said.contains("File 's.pov' line 3"), "{said}");
    assert!(sandbox.files() == before, "{said}");
}

#[test]
fn a_pipe_is_not_waited_for() {
    for reader in READERS {
        let sandbox = Sandbox::with(&reader.replace("FILE", "ff"));
        sandbox.pipe("here/ff");
        refused(&sandbox, "`ff` is not a regular file but a pipe");
    }
}

#[test]
fn links_to_devices_and_devices_are_not_read() {
    for file in ["/dev/zero", "link", "/dev/tty"] {
        for reader in [READERS[0], READERS[1], READERS[3], READERS[10]] {
            let sandbox = Sandbox::with(&reader.replace("FILE", file));
            symlink("/dev/zero", sandbox.path("here/link")).expect("links can be made");
            refused(
                &sandbox,
                &format!("`{file}` is not a regular file but a device"),
            );
        }
    }
}

#[test]
fn a_pipe_can_be_tested_for_existence() {
    let sandbox = Sandbox::with("#if (!file_exists(\"ff\")) #error \"not there\" #end");
    sandbox.pipe("here/ff");
    let ended = sandbox.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
}

#[test]
fn pipes_in_the_library_are_no_include_files() {
    // The include files of the library are searched for a name that is not declared.
    let sandbox = Sandbox::with("sphere { 0, 1 texture { T_Stone99 } }");
    sandbox.pipe("other/stones.inc");
    let ended = sandbox.shell("$POVR s.pov +L../other -F -D");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    assert!(ended.said.contains("T_Stone99"), "{}", ended.said);
}

#[test]
fn a_header_may_be_a_pipe() {
    let sandbox = Sandbox::with("#if (A != 1) #error \"not read\" #end");
    sandbox.pipe("here/ff");
    let ended = sandbox.shell("(echo '#declare A = 1;' > ff) & $POVR s.pov +HIff -F -D");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
}

#[test]
fn a_pipe_is_not_written_to() {
    for mode in ["write", "append"] {
        let sandbox = Sandbox::with(&format!("#fopen F \"ff\" {mode} #write(F, 1)"));
        sandbox.pipe("here/ff");
        refused(&sandbox, "`ff` is not a regular file but a pipe");
    }
    let sandbox = Sandbox::with("#fopen F \"link\" append #write(F, 1)");
    symlink("/dev/zero", sandbox.path("here/link")).expect("links can be made");
    refused(&sandbox, "this scene may not write to `link`");
}

/// The scene itself is named by the user, who may well let another program write it.
#[test]
fn the_scene_may_come_out_of_a_pipe() {
    let sandbox = Sandbox::with("#include \"a.inc\"");
    sandbox.write("here/a.inc", "#declare A = 1;");
    sandbox.pipe("here/ff");
    for command in [
        "cat s.pov | $POVR +I/dev/stdin +W16 +H12 -D -o s.png",
        "cat s.pov | $POVR +I- +W16 +H12 -D -o s.png",
        "cat s.pov > ff & $POVR +Iff +W16 +H12 -D -o s.png",
        "cat s.pov | $POVR check /dev/stdin",
    ] {
        sandbox.ends(command, 0);
    }
}

#[test]
fn a_batch_goes_on_past_pipes() {
    let sandbox = Sandbox::with("#include \"ff\"");
    sandbox.write("here/right.pov", REST);
    sandbox.pipe("here/ff");
    sandbox.pipe("here/pipe.pov");
    let ended = sandbox.shell("$POVR batch . --timeout 60s +W16 +H12 -o ../tmp/out");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "ff` is not a regular file but a pipe";
    assert!(ended.said.contains(says), "{}", ended.said);
    assert!(sandbox.path("tmp/out/right.png").is_file());
    let ended = sandbox.shell("$POVR batch pipe.pov --timeout 60s +W16 +H12 -o ../tmp/out");
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
    let sandbox = Sandbox::with(&photons("map"));
    let before = sandbox.files();
    let ended = sandbox.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let mut after = sandbox.files();
    assert!(after.remove(&sandbox.path("here/s.png")).is_some());
    assert!(after.remove(&sandbox.path("here/map")).is_some());
    assert!(after == before);

    for file in ["OTHER/there", "OTHER/new", "../other/there", "link"] {
        let sandbox = Sandbox::with("");
        let other = sandbox.path("other").display().to_string();
        let scene = photons(&file.replace("OTHER", &other));
        sandbox.write("here/s.pov", &format!("{REST}{scene}"));
        sandbox.write("other/there", "precious");
        symlink(sandbox.path("other/there"), sandbox.path("here/link")).expect("links can be made");
        refused(&sandbox, "this scene may not write to `");
    }
}

#[test]
fn photons_do_not_go_into_a_pipe() {
    let sandbox = Sandbox::with(&photons("ff"));
    sandbox.pipe("here/ff");
    let before = sandbox.files();
    let ended = sandbox.draw();
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let says = "`ff` is not a regular file but a pipe";
    assert!(ended.said.contains(says), "{}", ended.said);
    let mut after = sandbox.files();
    assert!(after.remove(&sandbox.path("here/s.png")).is_some());
    assert!(after == before);
}

#[test]
fn frames_that_save_photons_are_drawn_one_after_the_other() {
    let sandbox = Sandbox::with(&photons("map"));
    let ended = sandbox.shell("$POVR s.pov +KFF3 +W16 +H12 -D -o s.png");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(sandbox.path("here/map").is_file() && sandbox.path("here/s3.png").is_file());
    let ended = sandbox.shell("$POVR batch s.pov +W16 +H12 -o ../tmp/out");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
}

/// All ways in which a scene reads files that it wrote.
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
    let sandbox = Sandbox::with(WRITER);
    sandbox.write("here/there.txt", "3");
    let before = sandbox.files();
    let ended = sandbox.shell("$POVR check s.pov +L../tmp >&2");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(ended.said.contains("12346"), "{}", ended.said);
    assert!(sandbox.files() == before, "{}", ended.said);
    // Drawing gives the same messages and writes.
    let ended = sandbox.shell("$POVR s.pov +L../tmp +W16 +H12 -o s.png");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    assert!(ended.said.contains("12346"), "{}", ended.said);
    let written = fs::read_to_string(sandbox.path("here/there.txt"));
    assert_eq!(written.expect("it is there"), "3,4");
    assert_eq!(sandbox.files().len(), before.len() + 4);
}

#[test]
fn a_check_detects_all_errors_of_drawing() {
    for scene in [
        "#fopen F \"none/a.txt\" write",
        "#fopen F \"none/a.txt\" append",
        "#fopen F \"ff\" write",
        "#fopen F \"../other\" append",
        "#fopen F \"../other/a.txt\" append",
        "#fopen F \"a.txt\" write #fopen G \"b.txt\" read",
    ] {
        let sandbox = Sandbox::with(scene);
        sandbox.pipe("here/ff");
        let before = sandbox.files();
        let errors = |said: &str| {
            let errors = said.lines().filter(|line| line.starts_with("error: "));
            errors.map(str::to_owned).collect::<Vec<_>>()
        };
        let checked = sandbox.shell("$POVR check --message-format human s.pov >&2");
        assert!(sandbox.files() == before, "{}", checked.said);
        let drawn = sandbox.shell("$POVR --message-format human s.pov -F -D");
        assert_eq!((checked.code, drawn.code), (Some(1), Some(1)), "{scene}");
        assert_eq!(errors(&checked.said), errors(&drawn.said), "{scene}");
        assert_eq!(errors(&drawn.said).len(), 1, "{scene}: {}", drawn.said);
    }
}

/// A picture that hardly compresses.
const NOISE: &str = "plane { z, -2 finish { ambient 1 } pigment { cells scale 0.003
  colour_map { [0 rgb 0] [0.3 rgb x] [0.6 rgb <0, 1, 0.5>] [1 rgb 1] } } }";

/// Runs a command in a file system of its own with this size, mounted on the folder `disk`, which holds the scene; also
/// returns the names of the files there afterwards. `None` without the permission to mount.
fn on_a_disk(kib: u32, command: &str) -> Option<(Ended, String)> {
    on_a_disk_with(&format!("size={kib}k"), command)
}

/// The same with these options of `mount`; `$MORE` in the command mounts it again with more of them.
#[allow(
    clippy::print_stderr,
    reason = "a test that is left out says so on the terminal"
)]
fn on_a_disk_with(options: &str, command: &str) -> Option<(Ended, String)> {
    let sandbox = Sandbox::with(NOISE);
    fs::create_dir(sandbox.path("here/disk")).expect("folders can be made");
    let mount = format!("mount -t tmpfs -o {options} none disk");
    let unshare = |command: &str| {
        let mut unshare = Command::new("unshare");
        unshare
            .args(["--mount", "--map-root-user", "sh", "-c", command])
            .current_dir(sandbox.path("here"))
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
    sandbox.write(
        "here/run.sh",
        &inner
            .replace("$POVR", "timeout -s KILL 5 \"$POVR\"")
            .replace("$MORE", "mount -o remount,"),
    );
    let ended = sandbox.shell("unshare --mount --map-root-user sh run.sh");
    let read = |name: &str| fs::read_to_string(sandbox.path(name)).expect("it is there");
    let code = read("here/code").trim().parse().ok();
    let names = read("here/names").replace('\n', " ");
    let said = ended.said;
    Some((Ended { code, said }, names))
}

#[test]
fn the_state_of_a_drawing_is_dropped_for_its_picture() {
    // These pixels take 1.2 MB while they are drawn and about 190 kB as a picture.
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
    let sandbox = Sandbox::with(NOISE);
    let before = sandbox.files();
    let drawn = |blocks: u32| {
        let limit = format!("ulimit -f {blocks}; ");
        sandbox.shell(&(limit + "exec $POVR s.pov +C +W320 +H240 -D -A +WT2 -o s.png"))
    };
    let ended = drawn(16);
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "cannot write `s.png`: file too large";
    assert!(ended.said.contains(says), "{}", ended.said);
    assert!(sandbox.files() == before, "{}", ended.said);
    // The state exceeds the limit, the picture does not.
    let ended = drawn(1000);
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let mut after = sandbox.files();
    assert!(after.remove(&sandbox.path("here/s.png")).is_some());
    assert!(after == before);
}

#[test]
fn a_limit_on_files_stops_the_output_of_a_scene() {
    let scene = "#fopen F \"a.txt\" write #for (I, 1, 20000) #write(F, \"0123456789\") #end";
    let sandbox = Sandbox::with(scene);
    let before = sandbox.files();
    let ended = sandbox.shell("ulimit -f 16; exec $POVR s.pov -F -D");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    assert!(
        ended.said.contains("cannot write `a.txt`"),
        "{}",
        ended.said
    );
    assert!(sandbox.files() == before, "{}", ended.said);
}

#[test]
fn a_disk_that_is_full_or_read_only_is_named_and_stays_as_it_was() {
    let photons = photons("a.txt").replace('\n', " ");
    for (scene, is_saved_last) in [
        (
            "#fopen F \"a.txt\" write #for (I, 1, 9999) #write(F, \"0123456789\") #end",
            false,
        ),
        (
            "#fopen F \"a.txt\" append #for (I, 1, 9999) #write(F, \"0123456789\") #end",
            false,
        ),
        (&photons, true),
    ] {
        for prepare in ["head -c 9999999 /dev/zero > fill 2>&- ; ", "$MOREro . && "] {
            let make = format!("echo '{REST}{scene}' > s.pov && ");
            let draw = "$POVR s.pov +W16 +H12 -D -A +WT2 -F";
            let Some((ended, names)) =
                on_a_disk_with("size=64k", &format!("{make}{prepare}{draw}"))
            else {
                return;
            };
            // Photons that cannot be saved are a warning: their picture is right.
            let code = i32::from(!is_saved_last);
            assert_eq!(ended.code, Some(code), "{scene}: {}", ended.said);
            let says = [
                "cannot write `a.txt`: No space",
                "cannot write `a.txt`: Read-only",
            ];
            let says = says[usize::from(prepare.starts_with("$MORE"))];
            let is_said = ended.said.to_lowercase().contains(&says.to_lowercase());
            assert!(is_said, "not `{says}`, but {}", ended.said);
            assert!(!ended.said.contains("part"), "{}", ended.said);
            assert!(!names.contains("part"), "{names}");
        }
    }
}
