//! Makes the table of reserved words from `words.pest`: the enum `Word`, its spellings and its classes.

use std::fmt::Write as _;
use std::{env, fs, path::Path};

fn main() {
    println!("cargo::rerun-if-changed=grammar/words.pest");
    println!("cargo::rerun-if-changed=grammar/pov.pest");
    let text = fs::read_to_string("grammar/words.pest").expect("grammar/words.pest is readable");
    let words = words_by_class(&text);
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("words.rs"), table(&words)).expect("OUT_DIR is writable");
}

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
