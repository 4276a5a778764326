//! Names, words, strings, marks.

use crate::{agree, refused};

#[test]
fn names() {
    agree(
        "lexical/names",
        &[
            r#"#declare Sphere=1; #declare SPHERE=2; #debug concat("= ",str(Sphere,0,0),str(SPHERE,0,0),"\n")"#,
        ],
    );
}

#[test]
fn names_refused() {
    refused(
        "lexical/names_refused",
        &[r#"#declare red=3;"#, r#"#macro F(x) #end"#],
    );
}

#[test]
fn hashes_and_comments() {
    agree(
        "lexical/hashes_and_comments",
        &[
            r#"#  declare A=1; #/* c */ declare B=2; # // x
declare C=3; #debug concat("= ",str(A,0,0),str(B,0,0),str(C,0,0),"\n")"#,
            r#"#if(0) @ $ ~ ` ' ? #end #debug "= ok\n""#,
            r#"sphere{0,1 #}
#debug "= ok\n""#,
        ],
    );
}

#[test]
fn strings() {
    agree(
        "lexical/strings",
        &[r#"#debug "= two
lines\n""#],
    );
}

#[test]
fn strings_refused() {
    refused(
        "lexical/strings_refused",
        &[r#"#debug "= a\tb\\c\"d\'e\x\n""#],
    );
}
