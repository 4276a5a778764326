//! Bytes outside the character set of the language. `\u{f7XX}` stands for the byte `XX` alone (see `bytes`).

use crate::{agree, each, refused};

#[test]
fn nul_and_end_of_file_are_blanks() {
    agree(
        "bytes/blanks",
        &[
            "#declare\u{1a} A\u{1a}=\u{1a} 5\u{1a};\n#debug concat(\"= \", str(A, 0, 0), \"\\n\")",
            "#declare\0 A\0=\0 5\0;\n#debug concat(\"= \", str(A, 0, 0), \"\\n\")",
            "#declare A = 1;\0\u{1a}\n#debug concat(\"= \", str(A, 0, 0), \"\\n\")",
        ],
    );
    refused(
        "bytes/blanks_refused",
        &[
            "#declare A\0B = 5;",
            "#declare A\u{1a}B = 5;",
            "#decl\0are A = 5;",
            "#declare A = 1\u{1a}2;",
        ],
    );
}

#[test]
fn a_byte_order_mark_may_begin_a_scene() {
    agree(
        "bytes/mark",
        &["!\u{feff}#version 3.7; global_settings { assumed_gamma 1 }\n#debug \"= read\\n\""],
    );
    // POV-Ray takes it for a letter at the start of an include file, povr skips it.
    let include =
        "#include \"marked.inc\" #debug \"= read\\n\"\n@@@ marked.inc\n\u{feff}#declare A = 1;";
    each("bytes/mark_of_an_include", &[include], |_, povray, povr| {
        assert!(!povray.is_accepted);
        assert_eq!(
            (povr.is_accepted, &*povr.lines),
            (true, &["= read".to_owned()][..])
        );
    });
}

#[test]
fn letters_beyond_ascii_stand_in_comments_and_in_no_name() {
    agree(
        "bytes/latin",
        &[
            "// caf\u{f7e9} \u{f7b0}\n/* \u{f7e9} */ #debug \"= read\\n\"",
            "// café\n/* é */ #debug concat(\"= \", str(strlen(\"é\"), 0, 0), \"\\n\")",
        ],
    );
    refused(
        "bytes/latin_refused",
        &["#declare caf\u{f7e9} = 1;", "#declare café = 1;"],
    );
}

#[test]
fn a_letter_of_one_byte_is_one_blank() {
    agree(
        "bytes/latin_in_strings",
        &[
            "#debug concat(\"= \", str(strlen(\"\u{f7e9}\"), 0, 0), \" \", str(asc(\"\u{f7e9}\"), 0, 0), \"\\n\")",
            "#debug concat(\"= \", str(strlen(\"\u{f7e9}\u{f7e9}a\"), 0, 0), substr(\"a\u{f7e9}b\", 3, 1), \"\\n\")",
            "#debug concat(\"= \", strupr(\"a\u{f7e9}b\"), \"|\\n\")",
        ],
    );
}

#[test]
fn a_string_ends_at_a_code_of_zero() {
    agree(
        "bytes/nul_in_strings",
        &[
            "#debug concat(\"= \", str(strlen(concat(\"a\", chr(0), \"b\")), 0, 0), \"\\n\")",
            "#debug concat(\"= \", concat(\"a\", chr(0), \"b\"), \"|\\n\")",
            "#debug concat(\"= \", str(strlen(\"a\\u0000b\"), 0, 0), \" \", str(asc(chr(0)), 0, 0), \"\\n\")",
            "#debug concat(\"= \", str(val(concat(\"1\", chr(0), \"2\")), 0, 0), strlwr(concat(\"A\", chr(0), \"B\")), \"\\n\")",
            "#debug concat(\"= \", str(strcmp(concat(\"a\", chr(0), \"b\"), \"ab\"), 0, 0), \"\\n\")",
        ],
    );
    refused("bytes/nul_refused", &["#debug substr(\"a\\u0000b\", 3, 1)"]);
}

#[test]
fn lines_may_end_as_on_an_old_macintosh() {
    agree(
        "bytes/returns",
        &[
            "// a\r#debug \"= one\\n\"\r#declare A = 2;\r#debug concat(\"= \", str(A, 0, 0), \"\\n\")\r",
        ],
    );
}
