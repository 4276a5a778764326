//! Expressions, functions, directives and files compared with POV-Ray: every scene here runs through both programs,
//! which write their values by `#debug` in lines that begin with `= `.
//!
//! POV-Ray's answers are cached in `target/tmp/values/` under a hash of the scene, so that only new scenes cost its
//! start-up time. A scene may have further files: `@@@ name` begins one.

mod arrays;
mod bytes;
mod directives;
mod expressions;
mod extents;
mod files;
mod functions;
mod lexical;
mod macros;
mod probes;
mod rows_of_facts;
mod rows_of_language;
mod semicolons;
mod settings;
mod tables;
mod textures;

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Statements before every scene; one that begins with `!` has none.
const BEFORE: &str = "#version 3.7; global_settings { assumed_gamma 1 }\n";
/// POV-Ray spends most of its wall time asleep, so more scenes run in parallel than there are processors.
const AT_ONCE: usize = 8;
/// The file that scenes write to.
const WRITTEN: &str = "out.txt";

/// The answer of a program to a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Answer {
    is_accepted: bool,
    lines: Vec<String>,
    written: Option<String>,
}

/// Checks that POV-Ray reads each of these scenes, and that both programs write the same for it.
fn agree(topic: &str, scenes: &[&str]) {
    each(topic, scenes, |scene, expected, found| {
        assert!(expected.is_accepted, "POV-Ray refuses {scene}");
        assert_eq!(found, expected, "left povr, right POV-Ray: {scene}");
    });
}

/// Checks that both programs reject each of these scenes.
fn refused(topic: &str, scenes: &[&str]) {
    each(topic, scenes, |scene, expected, actual| {
        assert!(!expected.is_accepted, "POV-Ray reads {scene}");
        assert!(!actual.is_accepted, "povr reads {scene}");
    });
}

fn each(topic: &str, scenes: &[&str], check: impl Fn(&str, &Answer, &Answer) + Sync) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|threads| {
        for _ in 0..AT_ONCE {
            threads.spawn(|| {
                while let Some(scene) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let expected = cached_answer(topic, scene);
                    check(scene, &expected, &answer("povr", topic, scene));
                }
            });
        }
    });
}

/// Runs a scene in a folder of its own.
fn answer(program: &str, topic: &str, scene: &str) -> Answer {
    let folder = folder(&format!("{topic}/{:016x}-{program}", hash(scene)));
    let _ = fs::remove_file(folder.join(WRITTEN));
    let mut parts = scene.split("\n@@@ ");
    let main = parts.next().unwrap_or_default();
    let main = match main.strip_prefix('!') {
        Some(main) => main.to_owned(),
        None => format!("{BEFORE}{main}"),
    };
    fs::write(folder.join("scene.pov"), bytes(&(main + "\n"))).expect("test files can be written");
    for part in parts {
        let (name, text) = part.split_once('\n').unwrap_or((part, ""));
        fs::write(folder.join(name), bytes(text)).expect("test files can be written");
    }
    let path = match program {
        "povr" => env!("CARGO_BIN_EXE_povr"),
        other => other,
    };
    let output = Command::new(path)
        .current_dir(&folder)
        // Radiosity is read, but has no effect at this quality.
        .args(["+Iscene.pov", "+W4", "+H4", "-D", "-F", "-A", "+Q8", "+WT1"])
        .output()
        .unwrap_or_else(|error| {
            panic!("{program} cannot be run ({error}); tools/test installs what is missing")
        });
    let text = String::from_utf8_lossy(&output.stderr);
    let lines = text.lines().filter(|line| line.starts_with("= "));
    Answer {
        is_accepted: output.status.success(),
        lines: lines.map(|line| unsigned_zeros(line.trim_end())).collect(),
        written: fs::read_to_string(folder.join(WRITTEN)).ok(),
    }
}

/// The bytes of a text in a file: UTF-8, except that letters from U+F780 to U+F7FF stand for single bytes.
fn bytes(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    for letter in text.chars() {
        match u32::from(letter).to_be_bytes() {
            [0, 0, 0xf7, byte] if byte >= 0x80 => bytes.push(byte),
            _ => bytes.extend(letter.encode_utf8(&mut [0; 4]).bytes()),
        }
    }
    bytes
}

/// Removes the signs of zeros, which rounding decides and which may differ.
fn unsigned_zeros(line: &str) -> String {
    let mut out = String::new();
    for word in line.split_inclusive([' ', ',', '|']) {
        let is_zero = word.starts_with("-0") && !word.chars().any(|c| ('1'..='9').contains(&c));
        out.push_str(if is_zero { &word[1..] } else { word });
    }
    out
}

/// POV-Ray's answer, from an earlier run if there was one.
fn cached_answer(topic: &str, scene: &str) -> Answer {
    let file = folder("answers").join(format!("{:016x}", hash(scene)));
    if let Some(cached) = fs::read_to_string(&file)
        .ok()
        .and_then(|text| parse_cached(&text))
    {
        return cached;
    }
    let answer = answer("povray", topic, scene);
    let lines = answer.lines.join("\n");
    let written = answer.written.as_deref();
    let written = written.map_or("none".to_owned(), |text| format!("some\n{text}"));
    let text = format!("{}\n{lines}\x0c{written}", answer.is_accepted);
    fs::write(&file, text).expect("answers can be kept");
    answer
}

fn parse_cached(text: &str) -> Option<Answer> {
    let (head, written) = text.split_once('\x0c')?;
    let (is_accepted, lines) = head.split_once('\n')?;
    Some(Answer {
        is_accepted: is_accepted == "true",
        lines: lines.lines().map(str::to_owned).collect(),
        written: written.strip_prefix("some\n").map(str::to_owned),
    })
}

fn hash(scene: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    (BEFORE, scene).hash(&mut hasher);
    hasher.finish()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("values")
        .join(name);
    fs::create_dir_all(&folder).expect("the folder for test files can be made");
    folder
}

/// Checks that both programs write the same `count` lines for a scene.
fn same(name: &str, body: &str, count: usize) {
    let expected = cached_answer(name, body);
    assert_eq!(expected.lines.len(), count, "POV-Ray wrote {expected:#?}");
    assert_eq!(answer("povr", name, body), expected);
}

/// Floats in seven digits, one line each.
fn same_floats(name: &str, expressions: &[&str]) {
    let body: String = expressions
        .iter()
        .enumerate()
        .map(|(i, expression)| {
            format!("#debug concat(\"= {i} \", str({expression}, 0, 7), \"\\n\")\n")
        })
        .collect();
    same(name, &body, expressions.len());
}

#[test]
fn precedence_is_that_of_pov_ray() {
    same_floats(
        "precedence",
        &[
            "1+2*3",
            "(1|0&0)",
            "(3>2>1)",
            "-<1,2,3>.y*2",
            "!0*5",
            "(!0*5)",
            "2*-3",
            "2--3",
            "(1<2)",
            "(1=1+1e-11)",
            "(1 ? 2 : 3)",
            "(0 ? 2 : 1 ? 5 : 6)",
            "<1,2,3>.z",
            "(<1,2,3>+1).x",
            "8/4/2",
            "8-4-2",
            "- -2",
            "+5",
            "(2!=3)",
            "(2>=2)",
            "(2<=1)",
            ".5e1",
            "5.",
            "1e2",
            "(<1,2>*<3,4,5>).z",
            "(<1,2>+<3,4,5,6>).t",
            "pi",
            "(true&false)",
            "yes",
            "off",
            "version",
            "clock",
            "image_width",
            "image_height",
        ],
    );
}

#[test]
fn float_functions_agree() {
    same_floats(
        "functions",
        &[
            "abs(-2)",
            "acos(.3)",
            "asin(.3)",
            "atan(2)",
            "atan2(1,-2)",
            "ceil(1.2)",
            "ceil(-1.2)",
            "cos(1)",
            "cosh(1)",
            "degrees(1)",
            "div(7,2)",
            "div(-7,2)",
            "exp(1)",
            "floor(-1.2)",
            "int(-1.7)",
            "int(1.7)",
            "log(100)",
            "ln(2)",
            "max(1,5,3)",
            "min(4,2,8)",
            "mod(7,3)",
            "mod(-7,3)",
            "mod(7.5,2)",
            "pow(2,10)",
            "radians(180)",
            "sin(1)",
            "sinh(1)",
            "sqrt(2)",
            "tan(1)",
            "tanh(1)",
            "asinh(1)",
            "acosh(2)",
            "atanh(.5)",
            "select(-1,2,3)",
            "select(0,2,3)",
            "select(1,2,3,4)",
            "vlength(<3,4,0>)",
            "vdot(<1,2,3>,<4,5,6>)",
            "strlen(\"abc\")",
            "asc(\"A\")",
            "val(\"1.5e2x\")",
            "strcmp(\"a\",\"b\")",
            "bitwise_and(12,10)",
            "bitwise_or(12,10)",
            "bitwise_xor(12,10)",
            "abs(1 ? -4 : 2)",
            "sin((1<2))",
        ],
    );
}

#[test]
fn random_streams_are_the_same_to_the_last_digit() {
    same(
        "random",
        "#declare S = seed(42); #declare T = seed(-7);
        #declare I = 0;
        #while (I < 8)
          #debug concat(\"= \", str(rand(S), 0, 12), \" \", str(rand(T), 0, 12), \"\\n\")
          #declare I = I + 1;
        #end",
        8,
    );
}

#[test]
fn vector_functions_agree() {
    let vectors = [
        "vcross(<1,2,3>,<4,5,6>)",
        "vnormalize(<1,2,2>)",
        "vrotate(<1,2,3>,<10,20,30>)",
        "vaxis_rotate(<1,2,3>,<1,1,0>,40)",
        "<1,2,3>/2",
        "2*x+3*y",
        "<1 2 3>",
        "(x+y)*z",
        "-<1,-2,3>",
    ];
    let body: String = vectors
        .iter()
        .map(|v| format!("#debug concat(\"= \", vstr(3, {v}, \",\", 0, 7), \"\\n\")\n"))
        .collect();
    same("vectors", &body, vectors.len());
}

#[test]
fn colours_have_five_components_in_every_form() {
    let colors = [
        "rgb <.1,.2,.3>",
        "rgb .5",
        "rgbf .5",
        "rgbt .5",
        "rgbft .5",
        "rgbf <1,2,3,4>",
        "rgbt <1,2,3,4>",
        "rgbft <1,2,3,4,5>",
        "color 0.5",
        "color <1,2,3>",
        "color red .3 filter .2",
        "rgb .5 green 1",
        "rgb <1,.5>",
        "color rgb 1 transmit .25",
        "rgb <1,1,1>*0.5",
        "srgb <.5,.5,.5>",
        "srgbt <.5,.25,.75,.5>",
    ];
    let body: String = colors
        .iter()
        .enumerate()
        .map(|(i, c)| format!("#declare C{i} = {c};\n#debug concat(\"= {i} \", vstr(5, C{i}, \",\", 0, 5), \"\\n\")\n"))
        .collect();
    same("colours", &body, colors.len());
}

#[test]
fn strings_agree() {
    same(
        "strings",
        "#declare S = \"abc\";
        #debug concat(\"= \", S, chr(65), substr(S, 2, 2), strupr(S), strlwr(\"DEF\"), \"\\n\")
        #debug concat(\"= [\", str(pi, 8, 2), \"] [\", str(pi, -8, 2), \"] [\", str(pi, 0, -1), \"]\\n\")
        #if (\"a\" = \"a\") #debug \"= equal\\n\" #end
        #if (\"a\" < \"b\") #debug \"= less\\n\" #end
        #if (concat(\"a\", \"b\") = \"ab\") #debug \"= joined\\n\" #end",
        5,
    );
}

#[test]
fn macros_are_text_and_take_identifiers_by_reference() {
    same(
        "macros",
        "#macro P() 1+2 #end
        #debug concat(\"= \", str(2*P(), 0, 3), \" \", str(P()*2, 0, 3), \"\\n\")
        #macro Set(A) #declare A = 9; #end
        #declare B = 1; Set(B)
        #debug concat(\"= \", str(B, 0, 3), \"\\n\")
        #declare C = 1; Set(C+0)
        #debug concat(\"= \", str(C, 0, 3), \"\\n\")
        #macro Two() 3, 4 #end
        #debug concat(\"= \", str(max(Two()), 0, 3), \"\\n\")
        #macro Inner() X #end
        #macro Outer() #local X = 5; Inner() #end
        #declare Z = Outer();
        #debug concat(\"= \", str(Z, 0, 3), \"\\n\")
        #macro Fac(N) #if (N <= 1) 1 #else N*Fac(N-1) #end #end
        #declare F = (Fac(5));
        #debug concat(\"= \", str(F, 0, 3), \"\\n\")
        #macro Open() ( #end
        #declare O = Open() 1+2)*3;
        #debug concat(\"= \", str(O, 0, 3), \"\\n\")",
        7,
    );
}

#[test]
fn loops_and_branches_run_alike() {
    same(
        "loops",
        "#for (I, 1, 3) #debug concat(\"= for \", str(I, 0, 1), \"\\n\") #end
        #debug concat(\"= after \", str(I, 0, 1), \"\\n\")
        #for (K, 3, 1, -1) #debug concat(\"= down \", str(K, 0, 1), \"\\n\") #end
        #for (K, 3, 1) #debug \"= never\\n\" #end
        #for (I, 1, 6) #declare I = I + 1; #debug concat(\"= skip \", str(I, 0, 1), \"\\n\") #end
        #declare W = 0;
        #while (W < 10) #if (W = 2) #break #end #debug concat(\"= while \", str(W, 0, 1), \"\\n\") #declare W = W + 1; #end
        #switch (2) #case (1) #debug \"= one\\n\" #break #case (2) #debug \"= two\\n\" #case (3) #debug \"= three\\n\" #break
          #range (4, 5) #debug \"= range\\n\" #break #else #debug \"= else\\n\" #end
        #switch (4.5) #case (1) #break #range (4, 5) #debug \"= in range\\n\" #break #end
        #switch (9) #case (1) #debug \"= one\\n\" #else #debug \"= other\\n\" #end
        #if (0) #debug \"= a\\n\" #elseif (1) #debug \"= b\\n\" #else #debug \"= c\\n\" #end
        #ifdef (NotThere) #debug \"= defined\\n\" #else #debug \"= undefined\\n\" #end
        #ifndef (W) #debug \"= no W\\n\" #else #debug \"= W\\n\" #end",
        19,
    );
}

#[test]
fn arrays_hold_values_of_any_dimension() {
    same(
        "arrays",
        "#declare A = array[3] { 1, 2, 3 }
        #declare A[1] = 7;
        #debug concat(\"= \", str(A[1] + A[2], 0, 2), \"\\n\")
        #declare B = array[2][2] { { 1, 2 }, { 3, 4 } }
        #debug concat(\"= \", str(B[1][0], 0, 2), \" \", str(dimension_size(B, 2), 0, 0), \" \", str(dimensions(B), 0, 0), \"\\n\")
        #declare V = array[2] { <1,2,3>, x }
        #debug concat(\"= \", str((V[0] + V[1]).x, 0, 2), \"\\n\")
        #declare S = array[2]; #declare S[0] = \"text\";
        #debug concat(\"= \", S[0], \"\\n\")
        #ifdef (S[1]) #debug \"= set\\n\" #else #debug \"= unset\\n\" #end",
        5,
    );
}

#[test]
fn a_local_name_ends_with_its_macro() {
    same(
        "scopes",
        "#declare A = 1;
        #macro M() #local A = 2; #local Only = 3; #debug concat(\"= \", str(A, 0, 1), \"\\n\") #end
        M()
        #debug concat(\"= \", str(A, 0, 1), \"\\n\")
        #ifdef (Only) #debug \"= leaks\\n\" #else #debug \"= gone\\n\" #end
        #macro D() #declare Made = 4; #end
        D()
        #debug concat(\"= \", str(Made, 0, 1), \"\\n\")
        #undef Made
        #ifdef (Made) #debug \"= still\\n\" #else #debug \"= undone\\n\" #end",
        5,
    );
}
