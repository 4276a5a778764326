//! Makes the table of reserved words from `words.pest`: the enum `Word`, its spellings and its classes. And tells the
//! linker how the program takes little memory.

use std::fmt::Write as _;
use std::process::Command;
use std::{env, fs, path::Path};

fn main() {
    println!("cargo::rerun-if-changed=grammar/words.pest");
    println!("cargo::rerun-if-changed=grammar/pov.pest");
    let text = fs::read_to_string("grammar/words.pest").expect("grammar/words.pest is readable");
    let words = words_by_class(&text);
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("words.rs"), table(&words)).expect("OUT_DIR is writable");
    link_for_little_memory(Path::new(&out));
}

/// What a program reads of its own file counts as its memory: one sphere takes 12 MB in all without this, and about 8 so.
/// All of it can be done without, and is left out where it is not known to work.
fn link_for_little_memory(out: &Path) {
    println!("cargo::rerun-if-changed={ORDER}");
    let setting = |name: &str| env::var(name).unwrap_or_default();
    let is_linux =
        setting("CARGO_CFG_TARGET_OS") == "linux" && setting("CARGO_CFG_TARGET_ENV") == "gnu";
    let is_static = setting("CARGO_CFG_TARGET_FEATURE")
        .split(',')
        .any(|feature| feature == "crt-static");
    if !is_linux || is_static || setting("PROFILE") != "release" {
        return;
    }
    // At a fixed address no pointer in it need be changed when it is loaded, which would copy a MB.
    println!("cargo::rustc-link-arg-bins=-no-pie");
    // Of the C++ library little is needed, and the shared one takes 1.5 MB when it is loaded.
    if setting("TARGET") == setting("HOST")
        && let Some(library) = static_cpp_library()
    {
        let folder = out.join("cpp");
        fs::create_dir_all(&folder).expect("OUT_DIR is writable");
        let text = format!("INPUT ( \"{library}\" )\n");
        fs::write(folder.join("libstdc++.a"), text).expect("OUT_DIR is writable");
        println!("cargo::rustc-link-search=native={}", folder.display());
    }
    // The system reads 64 KiB wherever a program goes first: where it goes is laid side by side. Linkers that know no
    // scripts do without.
    let is_ours = |flag: &str| flag.contains("fuse-ld") || flag.contains("linker");
    if setting("CARGO_ENCODED_RUSTFLAGS")
        .split('\u{1f}')
        .any(is_ours)
        || env::var("RUSTC_LINKER").is_ok()
    {
        return;
    }
    let names = fs::read_to_string(ORDER).expect("the order of functions is readable");
    let mut script =
        "SECTIONS {\n  .text.first : {\n    *(.text.startup .text.startup.*)\n".to_owned();
    for name in names.lines().filter(|line| line.starts_with('_')) {
        // Those that seldom run have another name.
        writeln!(script, "    *(.text.{name} .text.unlikely.{name})").expect("strings grow");
    }
    script.push_str("  }\n}\nINSERT BEFORE .text;\n");
    let file = out.join("order.ld");
    fs::write(&file, script).expect("OUT_DIR is writable");
    println!("cargo::rustc-link-arg-bins=-Wl,-T,{}", file.display());
}

/// Where the C++ compiler has the library for programs that carry it with them.
fn static_cpp_library() -> Option<String> {
    println!("cargo::rerun-if-env-changed=CXX");
    let compiler = env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let told = Command::new(compiler)
        .arg("-print-file-name=libstdc++.a")
        .output()
        .ok()?;
    let file = String::from_utf8(told.stdout).ok()?.trim().to_owned();
    (Path::new(&file).is_absolute() && Path::new(&file).is_file()).then_some(file)
}

/// Functions in the order in which they are to lie in the program, as the linker knows them: `tools/link_order` writes it.
const ORDER: &str = "grammar/link_order.txt";

/// Pairs of class and word, in the order of the file.
fn words_by_class(text: &str) -> Vec<(String, String)> {
    let rules: String = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect();
    let mut words = Vec::new();
    for rule in rules.split('}') {
        let Some((class, body)) = rule.split_once('=') else {
            continue;
        };
        for word in body.split('"').skip(1).step_by(2) {
            words.push((class.trim().to_owned(), word.to_owned()));
        }
    }
    words
}

fn table(words: &[(String, String)]) -> String {
    let mut classes: Vec<&str> = words.iter().map(|(class, _)| class.as_str()).collect();
    classes.dedup();
    let mut out = String::new();
    out.push_str("/// A reserved word of the scene language.\n");
    out.push_str(
        "#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]\n#[repr(u16)]\n",
    );
    out.push_str("pub enum Word {\n");
    for (_, word) in words {
        writeln!(out, "    /// `{word}`\n    {},", camel(word)).expect("strings grow");
    }
    out.push_str("}\n\n/// The class under which `grammar/words.pest` lists a word.\n");
    out.push_str("#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]\npub enum Class {\n");
    for class in &classes {
        writeln!(out, "    /// `{class}`\n    {},", camel(class)).expect("strings grow");
    }
    out.push_str("}\n\nstatic WORDS: &[(Word, &str, Class)] = &[\n");
    for (class, word) in words {
        writeln!(
            out,
            "    (Word::{}, \"{word}\", Class::{}),",
            camel(word),
            camel(class)
        )
        .expect("strings grow");
    }
    out.push_str("];\n");
    out
}

fn camel(word: &str) -> String {
    word.split('_')
        .map(|part| {
            let mut letters = part.chars();
            letters.next().map_or(String::new(), |first| {
                first.to_ascii_uppercase().to_string() + letters.as_str()
            })
        })
        .collect()
}
