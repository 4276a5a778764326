//! `--sandbox`, and the folders of `povray.conf`.

use crate::folder::Sandbox;
use std::fs;

#[test]
fn a_sandbox_reads_beside_the_scene_and_in_library_folders() {
    let scene =
        "#include \"a.inc\" #include \"below/b.inc\" #include \"c.inc\" #include \"colors.inc\"
#if (file_exists(\"../other/secret\") | file_exists(\"/etc/passwd\")) #error \"seen\" #end
#debug str(A + B + C, 0, 0)";
    let sandbox = Sandbox::with(scene);
    fs::create_dir(sandbox.path("here/below")).expect("folders can be made");
    sandbox.write("here/a.inc", "#declare A = 1;");
    sandbox.write("here/below/b.inc", "#declare B = 2;");
    sandbox.write("other/c.inc", "#declare C = 4;");
    sandbox.write("other/secret", "secret");
    sandbox.write("home/colors.inc", "#declare Red = rgb x;");
    let before = sandbox.files();
    for (command, code) in [
        ("$POVR s.pov -D +W16 +H12 +L../other -o s.png", 1),
        ("$POVR s.pov -D +W16 +H12 --sandbox +L../home -o s.png", 1),
        (
            "$POVR s.pov -D +W16 +H12 --sandbox +L../home/ +L../other -o s.png",
            1,
        ),
    ] {
        // `../other/secret` is seen without a sandbox, and with its folder in the library.
        let ended = sandbox.ends(command, code);
        assert!(sandbox.files() == before, "{}", ended.said);
    }
    fs::create_dir(sandbox.path("other/inc")).expect("folders can be made");
    sandbox.write("other/inc/c.inc", "#declare C = 4;");
    for command in [
        "$POVR s.pov -D +W16 +H12 --sandbox +L../home +L../other/inc -o s.png",
        "cd ..; $POVR here/s.pov -D +W16 +H12 --sandbox +Lhome +Lother/inc -o here/s.png",
        "$POVR check s.pov --sandbox +L../home +L../other/inc >&2",
        "$POVR batch s.pov +W16 +H12 --sandbox --max-memory 500M +L../home +L../other/inc -o ../tmp/out",
    ] {
        sandbox.ends(command, 0);
    }
    assert!(sandbox.path("tmp/out/s.png").is_file());
}

#[test]
fn a_folder_of_includes_can_be_allowed_alone() {
    let sandbox = Sandbox::with("#include \"../other/a.inc\"");
    sandbox.write("other/a.inc", "#declare A = 1;");
    let ended = sandbox.shell("$POVR s.pov -F -D --sandbox --allow-read ../other");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let ended = sandbox.shell("$POVR s.pov -F -D --allow-read ../tmp");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
}

#[test]
fn ini_files_beside_scenes_do_not_count_in_a_sandbox() {
    let sandbox = Sandbox::with("#include \"a.inc\"");
    sandbox.write("other/a.inc", "#declare A = 1;");
    for ini in ["here/s.ini", "here/povray.ini"] {
        sandbox.write(ini, "Library_Path=../other\n");
    }
    for (command, code) in [
        ("$POVR s.pov -F -D", 0),
        ("$POVR s.pov -F -D --sandbox", 1),
        ("$POVR batch s.pov +W16 +H12 -o ../tmp/out", 0),
        ("$POVR batch s.pov +W16 +H12 --sandbox -o ../tmp/again", 1),
    ] {
        sandbox.ends(command, code);
    }
}

/// Drawings of `watch`, and all of `curve`.
#[test]
fn watch_and_curve_have_a_sandbox() {
    let scene = "#if (file_exists(\"../other/secret\")) #error \"seen\" #end";
    let sandbox = Sandbox::with(scene);
    sandbox.write("other/secret", "secret");
    let curve = "$POVR curve s.pov +W8 +H6 --runs 1 --settings +A0.3 --out ../tmp/curve";
    for command in ["$POVR watch s.pov +W8 +H6 --times 1 -o s.png", curve] {
        let ended = sandbox.shell(command);
        assert!(ended.said.contains("seen"), "{command}: {}", ended.said);
        let command = format!("{command} --sandbox");
        let ended = sandbox.ends(&command, 0);
        assert!(!ended.said.contains("rror:"), "{command}: {}", ended.said);
    }
    assert!(sandbox.path("here/s.png").is_file());
    assert!(sandbox.path("tmp/curve/index.html").is_file());
    let ended = sandbox.ends(&format!("{curve} --sandbox --povray"), 2);
    assert!(ended.said.contains("Leave `--povray`"), "{}", ended.said);
}

#[test]
fn a_sandbox_writes_its_picture_only() {
    let sandbox = Sandbox::with("");
    let before = sandbox.files();
    for command in [
        "$POVR s.pov +W16 +H12 -D --sandbox -o s.png --stats",
        "$POVR s.pov +W16 +H12 -D --sandbox +Os +KFF2 +FJ",
        "$POVR s.pov +W16 +H12 -D --sandbox -o - | cat > s.png",
        "$POVR --sandbox s.pov +W16 +H12 -D -o ../tmp/t.png",
        "$POVR --sandbox s.pov +W16 +H12 -D -o /dev/null +FN",
        "$POVR - --sandbox < s.pov +W16 +H12 -D -o s.png",
        "cat s.pov | $POVR +I/dev/stdin --sandbox +W16 +H12 -D -o s.png",
        "ln -sf ../tmp/t.png l.png && $POVR s.pov --sandbox +W16 +H12 -D -o l.png && rm l.png",
    ] {
        let ended = sandbox.ends(command, 0);
        assert!(
            !ended.said.contains("failed to add a rule"),
            "{command}: {}",
            ended.said
        );
    }
    let mut after = sandbox.files();
    for name in ["here/s.png", "here/s1.jpg", "here/s2.jpg", "tmp/t.png"] {
        assert!(after.remove(&sandbox.path(name)).is_some(), "{name}");
    }
    assert!(after == before);
}

/// Debian's POV-Ray reads the file and limits nothing; here it says where scenes may write.
#[test]
fn povray_conf_says_where_scenes_write() {
    let write = "#fopen F \"../other/a.txt\" write #write(F, 1)";
    for (conf, code) in [
        ("[File I/O Security]\nnone\n", 0),
        (
            "[File I/O Security]\nread-only\n[Permitted Paths]\nread+write = \"../other\"\n",
            0,
        ),
        (
            "[File I/O Security]\nrestricted\n[Permitted Paths]\nread* = ../other\n",
            1,
        ),
    ] {
        let sandbox = Sandbox::with(write);
        sandbox.write("home/.povray/3.7/povray.conf", conf);
        let ended = sandbox.shell("$POVR s.pov -F -D");
        assert_eq!(ended.code, Some(code), "{conf}: {}", ended.said);
    }
    let sandbox = Sandbox::with("");
    sandbox.write(
        "home/.povray/3.7/povray.conf",
        "\n[Shellout Security]\nno\n",
    );
    let ended = sandbox.shell("$POVR s.pov -F -D");
    assert_eq!(ended.code, Some(0), "{}", ended.said);
    let says = "povray.conf: 3: unknown setting `no`";
    assert!(ended.said.contains(says), "{}", ended.said);
}
