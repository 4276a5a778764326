//! Build script: generates the enum `Word` (spellings and classes of the reserved words) from `grammar/words.pest`, and
//! passes the linker the order of functions that keeps the memory of a run small.

use std::fmt::Write as _;
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

/// Link options that reduce resident memory, of which the pages of the program itself are a part: a scene of one sphere
/// takes about 8 MB with them and 12 MB without. None is necessary; targets where they are not known to work go without.
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
    // A fixed address needs no relocations at start, which would copy a megabyte of pages.
    println!("cargo::rustc-link-arg-bins=-no-pie");
    // A page fault reads 64 KiB of the file: functions that run are laid side by side. Linkers without scripts do without.
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
        // Cold functions carry another section name.
        writeln!(script, "    *(.text.{name} .text.unlikely.{name})").expect("strings grow");
    }
    script.push_str("  }\n}\nINSERT BEFORE .text;\n");
    let file = out.join("order.ld");
    fs::write(&file, script).expect("OUT_DIR is writable");
    println!("cargo::rustc-link-arg-bins=-Wl,-T,{}", file.display());
}

/// Mangled names of functions in the order of the program; `tools/link_order` writes the file.
const ORDER: &str = "tools/build/link_order.txt";

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

/// Ending of the rules of words that POV-Ray 3.7 does not reserve. They are the last of the file.
const SINCE_3_8: &str = "_since_3_8";

fn table(words: &[(String, String)]) -> String {
    let old = words
        .iter()
        .filter(|(class, _)| !class.ends_with(SINCE_3_8));
    let old_count = old.count();
    let words: Vec<(&str, &str)> = words
        .iter()
        .map(|(class, word)| (class.trim_end_matches(SINCE_3_8), word.as_str()))
        .collect();
    let mut classes: Vec<&str> = Vec::new();
    for &(class, _) in &words {
        if !classes.contains(&class) {
            classes.push(class);
        }
    }
    let mut out = String::new();
    out.push_str("/// A reserved word of the scene language.\n");
    out.push_str(
        "#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]\n#[repr(u16)]\n",
    );
    out.push_str("pub enum Word {\n");
    for (_, word) in &words {
        writeln!(out, "    /// `{word}`\n    {},", camel(word)).expect("strings grow");
    }
    out.push_str("}\n\n/// The class under which `grammar/words.pest` lists a word.\n");
    out.push_str("#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]\npub enum Class {\n");
    for class in &classes {
        writeln!(out, "    /// `{class}`\n    {},", camel(class)).expect("strings grow");
    }
    out.push_str("}\n\nstatic WORDS: &[(Word, &str, Class)] = &[\n");
    for (class, word) in &words {
        writeln!(
            out,
            "    (Word::{}, \"{word}\", Class::{}),",
            camel(word),
            camel(class)
        )
        .expect("strings grow");
    }
    out.push_str("];\n");
    writeln!(out, "\n/// Number of words of POV-Ray 3.7, which come first.\nconst COUNT_3_7: usize = {old_count};")
        .expect("strings grow");
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
