//! Texts that no author would write: the lexer neither panics nor takes more than linear time.

use super::corpus::assert_same_tokens;
use super::lex;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::time::{Duration, Instant};

fn runner(cases: u32) -> TestRunner {
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]))
}

#[test]
fn random_characters_are_read_as_by_hand() {
    let texts = proptest::collection::vec(any::<u8>(), 0..200);
    runner(3000)
        .run(&texts, |bytes| {
            assert_same_tokens(&String::from_utf8_lossy(&bytes), "random");
            Ok(())
        })
        .unwrap();
}

#[test]
fn random_pieces_of_tokens_are_read_as_by_hand() {
    let pieces = proptest::sample::select(vec![
        "#",
        "\"",
        "/*",
        "*/",
        "//",
        "\n",
        "\r",
        " ",
        "1",
        ".",
        "e",
        "E+",
        "-",
        "5.",
        ".5",
        "<",
        ">",
        "=",
        "!",
        "if",
        "end",
        "else",
        "#if",
        "#end",
        "#declare",
        "x",
        "A",
        "\\",
        "{",
        "}",
        "(",
        ",",
        "\0",
        "\u{feff}",
        "é",
        "vertex_vectors",
        "face_indices {",
        "\"s\"",
        "/",
        "*",
    ]);
    runner(6000)
        .run(&proptest::collection::vec(pieces, 0..60), |pieces| {
            assert_same_tokens(&pieces.concat(), "pieces");
            Ok(())
        })
        .unwrap();
}

/// The same pieces around the end of a slice.
#[test]
fn tokens_across_the_ends_of_slices_are_whole() {
    let tokens = [
        "#  /* c */ declare",
        "#/* /* */ */declare",
        "\"str\\\"ing\"",
        "<=",
        "1.5e-10",
        "/* c */",
        "/* /* */ */",
        "// note",
        "word_1",
        "é",
        "# ",
        "vertex_vectors{1,2,A,3}",
        "1<2>=3",
        "5.>",
    ];
    for token in tokens {
        for before in (1 << 15) - token.len()..=1 << 15 {
            let text = format!("{}{token}\n<1,2>", " ".repeat(before));
            assert_same_tokens(&text, token);
            let text = format!("a{token}\n<1,2>")
                .repeat(8)
                .replace('a', &"b ".repeat(before / 2));
            if before % 5 == 0 {
                assert_same_tokens(&text, token);
            }
        }
    }
}

/// Asserts that a text of four times the length takes about four times as long, in the best of several tries, since
/// other programs may take the processor away.
fn assert_linear(name: &str, text: impl Fn(usize) -> String) {
    let time = |count: usize| {
        let text = text(count);
        let start = Instant::now();
        drop(lex(&text));
        start.elapsed()
    };
    let mut tries = (0..4).map(|_| {
        let short = time(1 << 15).max(Duration::from_millis(4));
        (short, time(1 << 17))
    });
    let is_linear = tries.any(|(short, long)| long < 16 * short);
    assert!(is_linear, "{name}");
}

#[test]
fn time_is_linear_in_the_length() {
    for piece in [
        "#",
        "/*",
        "*/",
        "/* */",
        "/* /* */ */",
        "\"",
        "\"\"",
        "\\",
        "<",
        "1>=",
        "1 <",
        "1,",
        "1.",
        "1e",
        ".",
        "a",
        "a ",
        " ",
        "\n",
        "//",
        "//\n",
        "#if",
        "#if ",
        "#end ",
        "#if 1 #end ",
        "é",
        "{",
        "# /**/",
        "# /* /* */ */ ",
        "vertex_vectors",
        "vertex_vectors{1 ",
        "1 }",
        "uv_indices{1/",
        "1\"a\"",
        "#/*",
        "*",
    ] {
        assert_same_tokens(&piece.repeat(30_000 / piece.len()), piece);
        assert_linear(piece, |count| piece.repeat(count / piece.len()));
        assert_linear(piece, |count| {
            format!("{}\"", piece.repeat(count / piece.len()))
        });
    }
}

/// Repeated random tokens, so that segments of plain text are long enough to be read as such and to be cut.
#[test]
fn long_plain_text_is_read_as_by_hand() {
    let pieces = proptest::sample::select(vec![
        "1", ".5", "5.", "1e-3", "2e", "<", ">=", "=", "!", "x", "A_1", " ", "\n", "\t", "é", "\0",
        "{", ",", "-", "\u{feff}", "~", "vlong_",
    ]);
    let text = (
        proptest::collection::vec(pieces, 1..50),
        70_000_usize..1_200_000,
    );
    runner(6)
        .run(&text, |(pieces, length)| {
            let once = pieces.concat();
            let text = once.repeat(length / once.len());
            assert_same_tokens(&text, &once);
            assert_same_tokens(&format!("{text}#{text}/* */{text}\"a\""), &once);
            Ok(())
        })
        .unwrap();
}

#[test]
fn deep_nesting_is_no_danger() {
    let depth = 300_000;
    let closed = format!("{}{}x", "/*".repeat(depth), "*/".repeat(depth));
    assert_eq!(super::spellings(&closed), ["x"]);
    assert_eq!(lex(&"/*".repeat(depth)).unwrap_err().len(), 1);
    let groups = format!("{}{}", "#if(1)".repeat(depth), "#end ".repeat(depth));
    let (tokens, _) = lex(&groups).unwrap();
    assert_eq!(tokens.directives[0].next as usize, tokens.tokens.len() - 2);
    assert!(lex(&"{([".repeat(depth)).is_ok());
}
