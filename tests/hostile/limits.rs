//! `--timeout` and `--max-memory`.

use crate::folder::Sandbox;
use std::fs;
use std::time::Instant;

/// Scenes that take for ever, in reading, lowering, photons and rendering.
const ENDLESS: [&str; 4] = [
    "#declare A = 0; #while (A < 1) #declare B = A; #declare A = B * 0.5; #end",
    "global_settings { photons { spacing 1e-300 } }
sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } photons { target refraction on } }",
    "isosurface { function { x*x + y*y + z*z - 1 + 0.01*sin(x*100) } accuracy 1e-300 max_gradient 1e300
contained_by { sphere { 0, 2 } } }",
    "sphere { 0, 3 hollow pigment { rgbt 1 } interior { media { scattering { 1, 1 } intervals 100 samples 100 } } }",
];

#[test]
fn a_timeout_ends_every_stage() {
    for scene in ENDLESS {
        let sandbox = Sandbox::with(scene);
        let before = sandbox.files();
        let started = Instant::now();
        let ended = sandbox.shell("$POVR s.pov +W160 +H120 -D -A +WT2 -o s.png --timeout 100ms");
        assert_eq!(ended.code, Some(1), "{scene}: {}", ended.said);
        let says = "this took longer than 100ms, which `--timeout` allows";
        assert!(ended.said.contains(says), "{scene}: {}", ended.said);
        assert!(started.elapsed().as_secs_f64() < 4.0, "{scene}");
        assert!(sandbox.files() == before, "{}", ended.said);
    }
}

/// Comparing each two of them takes minutes.
#[test]
fn ten_thousand_coincident_spheres_are_drawn() {
    let spheres = "union { sphere { 0, 1 } ".repeat(10_000) + &"}".repeat(10_000);
    let sandbox = Sandbox::with(&format!("{spheres} camera {{ location -5*z }}"));
    sandbox.ends("$POVR s.pov +W16 +H12 -D -A -o s.png --timeout 20s", 0);
}

#[test]
fn a_timeout_ends_a_check() {
    let sandbox = Sandbox::with(ENDLESS[0]);
    let ended = sandbox.shell("$POVR check s.pov --timeout 300ms >&2");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "this took longer than 300ms, which `--timeout` allows";
    assert!(ended.said.contains(says), "{}", ended.said);
}

/// Messages that nobody reads fill their pipe, and the process waits in a system call.
#[cfg(unix)]
#[test]
fn a_timeout_ends_a_process_whose_messages_nobody_reads() {
    let scene = "#for (I, 1, 20000) #debug \"A line of output, of which a pipe holds about a thousand.\\n\" #end\n";
    let sandbox = Sandbox::with(scene);
    sandbox.pipe("here/ff");
    sandbox.ends("exec 3<>ff; $POVR s.pov -F -D --timeout 300ms 2>&3", 1);
}

/// A worker that is stopped reports nothing.
#[cfg(target_os = "linux")]
#[test]
fn a_timeout_of_watch_ends_a_worker_that_is_stopped() {
    let sandbox = Sandbox::with(ENDLESS[0]);
    // The worker is a child of the program, which is one of the background process.
    let command = "$POVR watch s.pov --no-terminal --times 1 --timeout 900ms -o s.png & P=$!;
below() { cat $(for of in $*; do echo /proc/$of/task/*/children; done); }
until W=$(below $(below $P)) && [ -n \"$W\" ]; do sleep 0.02; done; sleep 0.2; kill -STOP $W; wait $P";
    let ended = sandbox.ends(command, 0);
    let says = "it took longer than 900ms, which `--timeout` allows";
    assert!(ended.said.contains(says), "{}", ended.said);
}

#[test]
fn a_limit_is_a_finding_for_programs() {
    let sandbox = Sandbox::with(ENDLESS[0]);
    for command in [
        "$POVR s.pov -F -D --timeout 100ms --message-format json",
        "$POVR check s.pov --timeout 100ms --message-format json >&2",
    ] {
        let ended = sandbox.ends(command, 1);
        let is_limit = |line: &str| {
            let line: Result<serde_json::Value, _> = serde_json::from_str(line);
            line.is_ok_and(|line| line["type"] == "finding" && line["code"] == "limit")
        };
        assert!(ended.said.lines().any(is_limit), "{}", ended.said);
    }
}

#[test]
fn a_timeout_ends_drawings_of_watch_and_a_curve() {
    let says = "took longer than 300ms, which `--timeout` allows";
    for (command, code) in [
        ("$POVR watch s.pov --times 1 -o s.png", 0),
        ("$POVR curve s.pov --settings +A0.3", 1),
    ] {
        for scene in ENDLESS {
            let sandbox = Sandbox::with(scene);
            let command = format!("{command} +W64 +H48 --timeout 300ms --max-memory 1G");
            let ended = sandbox.ends(&command, code);
            assert!(ended.said.contains(says), "{command}: {}", ended.said);
            assert!(!sandbox.path("here/s.png").exists());
        }
    }
}

#[test]
fn a_limit_of_a_curve_leaves_no_temporary_files() {
    let sandbox = Sandbox::with(
        "#fopen F \"mine.txt\" write\n#write (F, \"text\")\n#declare A = 1; #while (A > 0) #declare A = sin(A) + 2; #end",
    );
    let command = "$POVR curve s.pov --settings +A0.3 +W64 +H48 --timeout 1s";
    let ended = sandbox.ends(command, 1);
    let says = "took longer than 1s, which `--timeout` allows";
    assert!(ended.said.contains(says), "{}", ended.said);
    assert!(!ended.said.contains("cannot be drawn"), "{}", ended.said);
    let files = std::fs::read_dir(sandbox.path("here")).expect("the folder is there");
    for file in files.flatten() {
        let name = file.file_name().to_string_lossy().into_owned();
        assert!(!name.contains(".povr-"), "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_of_a_curve_ends_pov_ray() {
    let sandbox = Sandbox::with("");
    // It writes its process number, and then takes the place of POV-Ray for a minute.
    sandbox.write(
        "home/povray",
        "#!/bin/sh\necho $$ > \"$PID_FILE\"\nexec sleep 60\n",
    );
    let command = "chmod +x ../home/povray; export PID_FILE=$PWD/pid; PATH=$PWD/../home:$PATH; \
        $POVR curve s.pov --povray --settings +A0.3 --truth 20 --runs 1 +W16 +H12 --timeout 2s";
    let ended = sandbox.ends(command, 1);
    assert!(ended.said.contains("took longer than 2s"), "{}", ended.said);
    let process = std::fs::read_to_string(sandbox.path("here/pid")).expect("it was started");
    let status = std::fs::read_to_string(format!("/proc/{}/status", process.trim()));
    assert!(!status.is_ok_and(|status| status.contains("VmRSS")));
}

#[test]
fn the_memory_of_drawings_of_watch_and_a_curve_is_limited() {
    let sandbox = Sandbox::with("");
    for (command, code) in [
        ("$POVR watch s.pov --times 1 -o s.png", 0),
        ("$POVR curve s.pov --settings +A0.3", 1),
    ] {
        let command = format!("{command} +W8000 +H8000 --max-memory 100M");
        let ended = sandbox.ends(&command, code);
        let says = "took more memory than the 100 MB that `--max-memory` allows";
        assert!(ended.said.contains(says), "{command}: {}", ended.said);
    }
}

/// In each round they would be copied or searched otherwise, which takes a minute.
#[test]
fn what_grows_in_a_loop_takes_time_in_proportion() {
    for scene in [
        "#version 3.8; #declare A = array; #for (I, 0, 199999) #declare A[I] = I; #end",
        "#version 3.8; #declare A = array; #declare A[0] = array; #for (I, 0, 199999) #declare A[0][I] = I; #end",
        "#declare A = array[200000]; #for (I, 0, 199999) #declare B = A; #end",
        "#declare A = array[100000]; #for (I, 99999, 0, -1) #declare A[I] = function(x) { x }; #declare B = A[I](2); #end",
        "#declare S = \"\"; #for (I, 0, 699999) #declare S = concat(S, \"x\"); #end",
        "#declare S = \"\"; #macro M(X) #declare S = concat(S, X, X) #end #for (I, 0, 399999) M(\"x\") #end",
    ] {
        let sandbox = Sandbox::with(scene);
        sandbox.ends("$POVR check s.pov", 0);
    }
}

#[test]
fn a_wait_for_the_scene_itself_ends() {
    let sandbox = Sandbox::with("");
    sandbox.pipe("here/ff");
    let ended = sandbox.shell("$POVR +Iff -F -D --timeout 300ms");
    assert_eq!(ended.code, Some(1), "{}", ended.said);
    let says = "this took longer than 300ms, which `--timeout` allows";
    assert!(ended.said.contains(says), "{}", ended.said);
}

#[test]
fn the_memory_of_film_tables_and_pictures_counts() {
    for (scene, options, says) in [
        ("", "+W8000 +H8000", "`--max-memory` allows"),
        (
            "#declare A = array[30000000]; #for (I, 0, 29999999) #declare A[I] = I; #end",
            "+W16 +H12",
            "memory",
        ),
        (
            "plane { z, 1 pigment { image_map { pgm \"p.pgm\" } } }",
            "+W16 +H12",
            "memory",
        ),
    ] {
        let sandbox = Sandbox::with(scene);
        sandbox.write("here/p.pgm", "P5 8000 8000 255\n");
        let picture = fs::File::options()
            .append(true)
            .open(sandbox.path("here/p.pgm"));
        let picture = picture.expect("it can be opened");
        picture
            .set_len(17 + 8000 * 8000)
            .expect("files may be sparse");
        let draw = "$POVR s.pov -D -A +WT2 -F --max-memory 100M ";
        let ended = sandbox.shell(&format!("{draw}{options}"));
        assert_eq!(ended.code, Some(1), "{scene}: {}", ended.said);
        assert!(ended.said.contains(says), "{scene}: {}", ended.said);
    }
}
