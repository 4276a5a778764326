//! The rows of the probe table of the language, one test each, as far as the other files do not cover them in full.

use crate::{agree, refused};

#[test]
fn comparisons_and_choices_are_no_part_of_a_plain_expression() {
    agree(
        "rows/comparisons",
        &[
            r#"#declare A = (1 < 2) + (2 > 1) + (1 <= 1) + (1 >= 2) + (1 = 1) + (1 != 1) + (1 & 0) + (1 | 0) + (0 ? 5 : 6);
#debug concat("= ", str(A, 0, 0), " ", str(abs(1 < 2), 0, 0), str(sin(0 ? 1 : 0), 0, 0), "\n")"#,
        ],
    );
    refused(
        "rows/comparisons_refused",
        &[
            "#declare A = 1 < 2;",
            "#declare A = 1 ? 2 : 3;",
            "#declare A = <1 = 1, 2, 3>;",
            "#macro M(P) #end M(1 > 2)",
            "#declare F = function(x) { x } #declare A = F(1 < 2);",
            "#declare B = array[2] { 1, 2 } #declare A = B[1 = 1];",
            "sphere { 0, 1 & 1 }",
        ],
    );
}

#[test]
fn and_and_or_bind_alike() {
    agree(
        "rows/and_or",
        &[
            r#"#debug concat("= ", str((1 | 0 & 0), 0, 0), str((0 & 0 | 1), 0, 0), str((1 | 1 & 0), 0, 0), str((0 & 1 | 1), 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn greater_or_equal_is_taken_whole() {
    refused(
        "rows/greedy_refused",
        &[
            "#declare A = 1; #declare B = (A=<1,2,3>=A);",
            "#declare B = (<1,2,3>=x);",
        ],
    );
}

#[test]
fn signs_join_numbers() {
    agree(
        "rows/signs",
        &[
            r#"#declare V = <1 -2 3>; #declare W = <1 2 3>; #declare U = <1, -2, 3>;
#debug concat("= ", str(vlength(V - <-1, 3>), 0, 3), " ", vstr(3, W, ",", 0, 0), " ", vstr(3, U, ",", 0, 0), "\n")
#declare P = <1,2,3>; #declare S = sphere { P -1, 1 } #debug concat("= ", vstr(3, min_extent(S), ",", 0, 1), "\n")"#,
        ],
    );
}

#[test]
fn a_macro_stands_for_its_tokens() {
    agree(
        "rows/macros",
        &[
            r#"#macro F() 1+2 #end #debug concat("= ", str(F()*2, 0, 0), str(2*F(), 0, 0), "\n")
#macro Two() 0, 1 #end #declare S = sphere { Two() } #debug concat("= ", vstr(3, max_extent(S), ",", 0, 0), "\n")
#declare V = <F(), 3>; #debug concat("= ", vstr(2, V, ",", 0, 0), concat("R", "S"), "\n")
#macro G(A, B) #debug concat("= ", str(A, 0, 0), str(B, 0, 0), "\n") #end G(Two())
#macro O() sphere { 0, #end #declare T = O() 4 } #debug concat("= ", vstr(3, max_extent(T), ",", 0, 0), "\n")
#macro P() ( #end #declare A = P() 1+2)*3; #debug concat("= ", str(A, 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn calls_have_parentheses_and_perhaps_commas() {
    agree(
        "rows/calls",
        &[
            r#"#macro F(A B) #debug concat("= ", str(A, 0, 0), str(B, 0, 0), "\n") #end F(3 4) F (3, 4)
#macro G(A) A #end #declare B = G (3); #debug concat("= ", str(B, 0, 0), "\n")"#,
        ],
    );
    refused(
        "rows/calls_refused",
        &["#macro F() 1 #end #declare A = F;", "#macro F 1 #end"],
    );
}

#[test]
fn a_bare_identifier_is_given_by_reference() {
    agree(
        "rows/references",
        &[
            r#"#macro F(A) #declare A = 9; #end #declare B = 1; F(B) #debug concat("= ", str(B, 0, 0), "\n")
#declare C = 1; F((C)) #debug concat("= ", str(C, 0, 0), "\n") F(C+0) F(+C) #debug concat("= ", str(C, 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn a_name_and_a_parenthesis_are_a_call_only_of_what_can_be_called() {
    agree(
        "rows/words_and_parentheses",
        &[
            r#"#declare P = <1,2,3>; #declare R = 2; #declare S = sphere { P (R+1) } #debug concat("= ", vstr(3, max_extent(S), ",", 0, 0), "\n")
#declare F = function(x) { x*2 } #debug concat("= ", str(F (R), 0, 0), "\n")
#declare Q = spline { linear_spline 0, 0*x, 1, x } #debug concat("= ", vstr(3, Q (0.5), ",", 0, 2), "\n")
#declare B = box { -1, 1 rotate (R+1)*y } #debug concat("= ", vstr(3, max_extent(B), ",", 0, 2), "\n")"#,
        ],
    );
}

#[test]
fn the_array_that_a_macro_names_takes_no_index() {
    refused(
        "rows/indices_refused",
        &["#declare A = array[2] { 1, 2 } #macro F() A #end #declare B = F()[1];"],
    );
}

#[test]
fn conditions_stand_in_the_middle_of_anything() {
    agree(
        "rows/conditions",
        &[
            r#"#declare F = function { x #declare I = 0; #while (I < 3) + x #declare I = I + 1; #end }
#debug concat("= ", str(F(2, 0, 0), 0, 0), "\n")
#declare A = (#if (1) 2 #else 3 #end + 1); #declare V = <1, #if (0) 2 #else 3 #end, 4>;
#debug concat("= ", str(A, 0, 0), vstr(3, V, ",", 0, 0), str(max(1, #if (1) 7 #end), 0, 0), "\n")
#declare S = sphere { 0, #if (1) 2 #else 3 #end } #debug concat("= ", vstr(3, max_extent(S), ",", 0, 0), "\n")
#declare B = #if (1) 7; #else 8; #end #debug concat("= ", str(B, 0, 0), "\n")"#,
        ],
    );
    refused(
        "rows/conditions_refused",
        &[
            "#declare B = #if (1) 7 #else 8 #end;",
            "#declare A = 5 #if (1) + 1 #end;",
        ],
    );
}

#[test]
fn numbers_end_with_a_semicolon_from_3_5_on() {
    refused(
        "rows/semicolons_refused",
        &[
            "#declare A = 1 #declare B = 2;",
            "#declare A = rgb 1 sphere { 0, 1 }",
        ],
    );
    agree(
        "rows/semicolons",
        &[
            r#"!#version 3.1; #declare A = 1 #declare B = 2 #debug concat("= ", str(A+B, 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn two_directives_need_no_hash() {
    agree(
        "rows/hashes",
        &[r#"declare A = 1; include "i.inc"
#  declare C = 3; #/* c */ declare D = 4; #debug concat("= ", str(A, 0, 0), str(B, 0, 0), str(C, 0, 0), str(D, 0, 0), "\n")
#include "open.inc" #debug "= inside\n" #end
@@@ i.inc
#declare B = 2;
@@@ open.inc
#if (1)"#],
    );
}

#[test]
fn skipped_text_is_still_tokenized() {
    agree(
        "rows/skipped",
        &[r#"#if (0) @ $ ~ ` ? sphere { #end #debug "= ok\n""#],
    );
    refused("rows/skipped_refused", &["#if (0) \"open #end"]);
}

#[test]
fn reserved_words_are_no_names() {
    refused(
        "rows/words_refused",
        &[
            "#declare red = 1;",
            "#macro F(x) #end",
            "#macro sphere() #end",
            "#local pi = 3;",
        ],
    );
    agree(
        "rows/words",
        &[
            r#"#declare Red = 1; #declare PI = 3; #macro Sphere() 2 #end #debug concat("= ", str(Red+PI+Sphere(), 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn only_textures_have_layers_as_values() {
    agree(
        "rows/layers",
        &[
            r#"#declare A = sphere { 0, 1 } sphere { 0, 2 } #debug concat("= ", vstr(3, max_extent(A), ",", 0, 0), "\n")
#declare T = texture { pigment { rgb 1 } } texture { pigment { rgbt 1 } } sphere { 0, 1 texture { T } } #debug "= ok\n""#,
        ],
    );
}

#[test]
fn numbers_have_many_forms() {
    agree(
        "rows/numbers",
        &[
            r#"#debug concat("= ", str(5., 0, 1), str(.5e2, 0, 1), str(1e, 0, 1), str(1.e1, 0, 1), str(2E-1, 0, 1), "\n")"#,
        ],
    );
    refused(
        "rows/numbers_refused",
        &[
            "#declare A = 0x10;",
            "#declare A = 2^3;",
            "#declare F = function(x) { x^2 }",
            "#declare A = 1.2.3;",
            "#declare A = 7 % 2;",
        ],
    );
}

#[test]
fn signs_bind_tighter_than_products_and_members_tighter_than_signs() {
    agree(
        "rows/tightness",
        &[
            r#"#declare V = <1,2,3>; #debug concat("= ", str((!0*5), 0, 0), " ", str(-<1,2,3>.y*2, 0, 0), " ", str((V).z, 0, 0), str(V . z, 0, 0), str(-V.x, 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn strings_go_over_lines_and_hold_quotes() {
    agree(
        "rows/strings",
        &[
            "#debug \"= one\ntwo \\\"quoted\\\"\\n\"",
            "// Gr\u{fc}n\n#debug \"= ok\\n\"",
        ],
    );
    refused(
        "rows/strings_refused",
        &["#declare Gr\u{fc}n = 1;", "#debug \"= open"],
    );
}

#[test]
fn semicolons_stand_behind_values_only() {
    agree("rows/double", &[r#"#declare A = 1;; #debug "= ok\n""#]);
    refused("rows/double_refused", &["sphere { 0, 1 };"]);
}

#[test]
fn functions_have_an_expression_of_their_own() {
    agree(
        "rows/functions",
        &[
            r#"#macro Twice() 2* #end #declare K = 3; #declare F = function(x, y) { Twice() x + K + y } #debug concat("= ", str(F(1, 5), 0, 0), "\n")
#declare G = function(x, y) { (x < y) + 2*(x >= y) + (x | y) + (x & y) } #debug concat("= ", str(G(1, 2), 0, 0), str(G(2, 1), 0, 0), "\n")"#,
        ],
    );
    refused(
        "rows/functions_refused",
        &[
            "#declare V = <1,2,3>; #declare F = function(x) { x*V.y }",
            "#declare F = function(x) { !x }",
        ],
    );
}
