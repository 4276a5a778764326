//! The statements of the fact sheet about the language, one test for each that the other files do not cover in full.

use crate::{agree, refused};

#[test]
fn comments_nest_and_names_are_case_sensitive() {
    agree(
        "facts/lexical",
        &[
            r#"/* a /* b */ c */ #declare A1_b = 1; #declare a1_B = 2; // end
#debug concat("= ", str(A1_b, 0, 0), str(a1_B, 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/lexical_refused",
        &["#declare sphere = 1;", "/* /* */ sphere { 0, 1 }"],
    );
}

#[test]
fn commas_are_optional() {
    agree(
        "facts/commas",
        &[
            r#"#declare S = sphere { <0 0 0> 1 } #macro M(A, B) #debug concat("= ", str(A, 0, 0), str(B, 0, 0), "\n") #end M(1 2)
#debug concat("= ", vstr(3, max_extent(S), ",", 0, 0), "\n")
#declare A = array[3] { 1 2 3 } #debug concat("= ", str(A[2], 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn operators_stand_in_eight_steps() {
    agree(
        "facts/operators",
        &[
            r#"#debug concat("= ", str((1 + 2 * 3 - 4 / 2), 0, 1), str((1 + 1 < 3), 0, 0), str((2 < 1 | 1), 0, 0), str((1 | 0 ? 4 : 5), 0, 0), str((3 > 2 > 1), 0, 0), str(-x.x, 0, 0), str(2*-3, 0, 0), "\n")
#debug concat("= ", str((1 = 1 = 1), 0, 0), str((2 = 2 = 2), 0, 0), str((8 / 4 / 2), 0, 1), str((8 - 4 - 2), 0, 0), str((1 < 2 = 1), 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/operators_refused",
        &["#declare A = (2 ^ 3);", "#declare A = (7 % 3);"],
    );
}

#[test]
fn functions_of_one_argument_take_any_expression() {
    agree(
        "facts/full_arguments",
        &[
            r#"#debug concat("= ", str(abs(1 < 2), 0, 0), str(sqrt(1 ? 4 : 9), 0, 0), str(int(1 | 0), 0, 0), "\n") #if (1 < 2 & 3 > 2) #debug "= yes\n" #end"#,
        ],
    );
    refused(
        "facts/full_arguments_refused",
        &[
            "#declare A = atan2(1 < 2, 1);",
            "#declare A = max(1 < 2, 1);",
            "#declare A = pow(2, 1 = 1);",
            "sphere { 0, 1 < 2 }",
        ],
    );
}

#[test]
fn shorter_vectors_are_filled() {
    agree(
        "facts/promotion",
        &[
            r#"#debug concat("= ", vstr(3, <1,2>*<3,4,5>, ",", 0, 0), " ", vstr(3, 2*<1,2,3>, ",", 0, 0), " ", vstr(4, <1,2,3>+<1,1,1,1>, ",", 0, 0), "\n")
#declare S = sphere { <1,2>, 1 } #debug concat("= ", vstr(3, max_extent(S), ",", 0, 0), "\n") #declare C = rgb <1,2>; #debug concat("= ", vstr(5, C, ",", 0, 0), "\n")
#declare B = box { 1, 2 } #debug concat("= ", vstr(3, min_extent(B), ",", 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/promotion_refused",
        &["sphere { <1,2,3,4>, 1 }", "sphere { 0, <1,2> }"],
    );
}

#[test]
fn values_within_1e_10_are_equal() {
    agree(
        "facts/tolerance",
        &[
            r#"#debug concat("= ", str((1 = 1 + 9e-11), 0, 0), str((1 = 1 + 1.1e-10), 0, 0), str((1e-11 | 0), 0, 0), str((1e-9 | 0), 0, 0), str((1 <= 1 - 5e-11), 0, 0), str((1 >= 1 + 5e-11), 0, 0), str((1 < 1 + 5e-11), 0, 0), str((1 > 1 - 5e-11), 0, 0), str(!1e-11, 0, 0), "\n")
#debug concat("= ", str(1/0, 0, 1), " ", str(-1/0, 0, 1), "\n")
#debug concat("= ", vstr(3, !<1,0,2>, ",", 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/tolerance_refused",
        &["#if (<1,2,3>) #end", "#while (x) #end"],
    );
}

#[test]
fn strings_are_compared_in_parentheses() {
    agree(
        "facts/strings",
        &[
            r#"#debug concat("= ", str(("a" = "a"), 0, 0), str(("a" < "b"), 0, 0), str(("b" > "a"), 0, 0), str(("a" != "a"), 0, 0), "\n") #if ("x" = "y") #else #debug "= no\n" #end"#,
        ],
    );
}

#[test]
fn predefined_names() {
    agree(
        "facts/names",
        &[
            r#"#debug concat("= ", vstr(3, x+2*y+3*z, ",", 0, 0), " ", vstr(2, u+2*v, ",", 0, 0), " ", vstr(4, t, ",", 0, 0), " ", str(pi, 0, 10), "\n")
#debug concat("= ", str(true+yes+on+false+no+off, 0, 0), str(clock, 0, 0), str(clock_delta, 0, 0), str(clock_on, 0, 0), str(final_clock, 0, 0), str(final_frame, 0, 0), str(frame_number, 0, 0), str(initial_clock, 0, 0), str(initial_frame, 0, 0), "\n")
#debug concat("= ", str(image_width, 0, 0), str(image_height, 0, 0), str((now > 0), 0, 0), str(version, 0, 2), "\n")
#debug concat("= ", input_file_name, "\n")"#,
        ],
    );
}

#[test]
fn each_function_of_floats() {
    let one = [
        "abs(-2.5)",
        "acos(.3)",
        "acosh(2)",
        "asin(.3)",
        "asinh(2)",
        "atan(2)",
        "atanh(.3)",
        "ceil(1.2)",
        "cos(2)",
        "cosh(2)",
        "degrees(2)",
        "exp(2)",
        "floor(-1.2)",
        "int(-1.9)",
        "ln(3)",
        "log(30)",
        "radians(50)",
        "sin(2)",
        "sinh(2)",
        "sqrt(3)",
        "tan(2)",
        "tanh(2)",
        "asc(\"a\")",
        "strlen(\"abc\")",
        "val(\"1.5e2\")",
        "val(\"-3x\")",
        "vlength(<1,2,3>)",
        "atan2(1, -2)",
        "div(-7, 2)",
        "mod(-7, 3)",
        "mod(7.5, 2)",
        "pow(2, -.5)",
        "max(1, 4, 2)",
        "min(3, -1, 2)",
        "bitwise_and(12, 10)",
        "bitwise_or(12, 10)",
        "bitwise_xor(12, 10)",
        "vdot(<1,2,3>, <4,5,6>)",
        "strcmp(\"a\", \"b\")",
        "strcmp(\"b\", \"a\")",
        "strcmp(\"a\", \"a\")",
        "select(-1, 2, 3)",
        "select(0, 2, 3)",
        "select(-1, 2, 3, 4)",
        "select(0, 2, 3, 4)",
        "select(1, 2, 3, 4)",
        "defined(Nothing)",
        "file_exists(\"no.inc\")",
        "file_exists(\"colors.inc\")",
    ];
    let lines: String = one
        .iter()
        .map(|call| format!("#debug concat(\"= \", str({call}, 0, 9), \"\\n\")\n"))
        .collect();
    agree("facts/floats", &[&lines]);
    refused(
        "facts/floats_refused",
        &[
            "#declare A = ln(0);",
            "#declare A = log(-1);",
            "#declare A = sqrt(-1);",
            "#declare A = pow(0, 0);",
            "#declare A = atan2(0, 0);",
            "#declare A = sqr(3);",
        ],
    );
}

#[test]
fn each_function_of_vectors() {
    agree(
        "facts/vectors",
        &[
            r#"#debug concat("= ", vstr(3, vaxis_rotate(<1,2,3>, <1,1,1>, 50), ",", 0, 9), " ", vstr(3, vcross(<1,2,3>, <4,5,7>), ",", 0, 9), "\n")
#debug concat("= ", vstr(3, vnormalize(<1,2,3>), ",", 0, 9), " ", vstr(3, vnormalize(0*x), ",", 0, 9), "\n") #debug concat("= ", vstr(3, vrotate(<1,2,3>, <10,20,30>), ",", 0, 9), "\n")
#debug concat("= ", vstr(3, vturbulence(2, .5, 6, <.3,.2,.1>), ",", 0, 9), "\n")"#,
        ],
    );
}

#[test]
fn random_numbers_are_the_same() {
    agree(
        "facts/random",
        &[
            r#"#declare S = seed(42); #declare T = seed(42.9); #declare U = seed(-1); #debug concat("= ", str(S, 0, 0), str(T, 0, 0), str(U, 0, 0), "\n")
#debug concat("= ", str(rand(S), 0, 12), " ", str(rand(S), 0, 12), " ", str(rand(T), 0, 12), "\n") #debug concat("= ", str(rand(S), 0, 12), " ", str(rand(S), 0, 12), " ", str(rand(U), 0, 12), "\n")"#,
        ],
    );
}

#[test]
fn boxes_of_objects() {
    let objects = [
        "difference { box { -1, 1 } sphere { 0, 2 } }",
        "union { box { -1, 1 } sphere { 2, 1 } }",
        "plane { y, 1 }",
        "superellipsoid { <.5, .5> }",
        "torus { 2, .5 }",
        "disc { 0, y, 1 }",
        "triangle { 0, x, y }",
        "blob { threshold .5 sphere { 0, 1, 1 } sphere { x, 1, 1 } }",
        "box { -1, 1 clipped_by { sphere { 0, .5 } } }",
        "box { -1, 1 bounded_by { sphere { 0, 5 } } }",
    ];
    let lines: String = objects
        .iter()
        .map(|object| {
            format!(
                "#declare O = {object} #debug concat(\"= \", vstr(3, min_extent(O), \",\", 0, 4), \"\\n\") #debug concat(\"= \", vstr(3, max_extent(O), \",\", 0, 4), \"\\n\")\n"
            )
        })
        .collect();
    agree("facts/boxes", &[&lines]);
}

#[test]
fn objects_answer_ray_and_point_queries() {
    agree(
        "facts/probes",
        &[
            r#"#declare S = sphere { 0, 1 } #declare N = 0*x; #declare P = trace(S, -3*z, z, N);
#debug concat("= ", vstr(3, P, ",", 0, 6), " ", vstr(3, N, ",", 0, 6), "\n") #declare P = trace(S, 3*y-3*z, z, N);
#debug concat("= ", vstr(3, P, ",", 0, 6), " ", vstr(3, N, ",", 0, 6), "\n") #declare I = object { S inverse } #declare P = trace(I, -3*z, z, N);
#debug concat("= ", vstr(3, P, ",", 0, 6), " ", vstr(3, N, ",", 0, 6), "\n")
#debug concat("= ", str(inside(S, 0), 0, 0), str(inside(S, 2), 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/probes_refused",
        &["#declare M = mesh { triangle { 0, x, y } } #declare A = inside(M, 0);"],
    );
}

#[test]
fn names_of_include_files_are_undeclared_without_them() {
    refused(
        "facts/includes_refused",
        &[
            "#declare A = f_sphere(0, 0, 0, 1);",
            "#declare P = pigment { rgb 1 } #declare A = eval_pigment(P, 0);",
        ],
    );
    agree(
        "facts/includes",
        &[
            r#"#include "functions.inc" #declare P = pigment { rgb <.25,.5,.75> } #declare C = eval_pigment(P, x);
#debug concat("= ", str(f_sphere(2, 0, 0, 1), 0, 6), " ", vstr(3, C, ",", 0, 4), "\n")"#,
        ],
    );
}

#[test]
fn strings_are_made_of_numbers() {
    agree(
        "facts/formats",
        &[
            r#"#debug concat("= [", str(pi, 8, 2), "][", str(pi, -8, 2), "][", str(pi, 0, -1), "][", str(-pi, -8, 3), "][", str(1e9, 0, 0), "]\n")
#debug concat("= ", vstr(3, <1,2,3>/3, "; ", 6, 3), "|", chr(65), "|", strlwr("ABc"), strupr("abC"), substr("abcdef", 2, 3), "\n")
#debug concat("= ", datetime(0, "%Y-%m-%d"), "\n")"#,
        ],
    );
}

#[test]
fn names_are_global_unless_they_resolve_to_a_local_one() {
    agree(
        "facts/scopes",
        &[
            r#"#macro M() #local A = 1; #declare A = 2; #declare B = 3; #end M() #debug concat("= ", str(defined(A), 0, 0), str(defined(B), 0, 0), "\n")
#macro N(P) #declare P = 5; #end #declare Q = 1; N(Q) #debug concat("= ", str(Q, 0, 0), "\n") #local L = 4; #debug concat("= ", str(L, 0, 0), "\n")
#declare Q = "text"; #debug concat("= ", Q, "\n") #undef Q #debug concat("= ", str(defined(Q), 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/scopes_refused",
        &[
            "#declare A = array[2] { 1, 2 } #declare A[0] = x;",
            "#declare A = array[2] { 1, 2 } #declare A[1] = \"text\";",
            "#declare F = function(x) { x } #declare F = function(x) { 2*x }",
        ],
    );
    agree(
        "facts/functions_again",
        &[
            r#"#declare F = function(x) { x } #undef F #declare F = function(x) { 2*x } #debug concat("= ", str(F(2), 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn every_kind_of_value_can_be_declared() {
    let values = [
        "1;",
        "<1,2>;",
        "<1,2,3,4,5>;",
        "rgbft 1;",
        "\"s\"",
        "sphere { 0, 1 }",
        "camera { location 1 }",
        "light_source { 0, rgb 1 }",
        "texture { pigment { rgb 1 } }",
        "pigment { rgb 1 }",
        "finish { phong 1 }",
        "normal { bumps 1 }",
        "color_map { [0 rgb 1] [1 rgb 0] }",
        "pigment_map { [0 rgb 1] [1 rgb 0] }",
        "normal_map { [0 bumps] [1 dents] }",
        "slope_map { [0 <0,1>] [1 <1,0>] }",
        "texture_map { [0 pigment { rgb 1 }] }",
        "density_map { [0 rgb 1] [1 rgb 0] }",
        "transform { translate x }",
        "interior { ior 2 }",
        "media { emission 1 }",
        "material { interior { ior 2 } }",
        "array[2] { 1, 2 }",
        "spline { 0, x, 1, y }",
        "function(x) { x }",
        "fog { distance 1 }",
        "rainbow { direction z angle 40 width 5 color_map { [0 rgb 1] } }",
        "sky_sphere { pigment { rgb 1 } }",
        "density { boxed }",
        "union { sphere { 0, 1 } box { 0, 1 } }",
        "finish { reflection { 0, 1 } }",
    ];
    let scenes: Vec<String> = values
        .iter()
        .map(|value| {
            format!("#declare A = {value}\n#debug concat(\"= \", str(defined(A), 0, 0), \"\\n\")")
        })
        .collect();
    agree(
        "facts/values",
        &scenes.iter().map(String::as_str).collect::<Vec<_>>(),
    );
}

#[test]
fn loops_and_choices() {
    agree(
        "facts/loops",
        &[
            r#"#for (I, 1, 3) #debug concat("= ", str(I, 0, 0), "\n") #end #debug concat("= ", str(I, 0, 0), "\n") #for (J, 0, 1, -1) #debug "= no\n" #end
#switch (2) #case (1) #debug "= 1\n" #case (2) #debug "= 2\n" #case (3) #debug "= 3\n" #break #else #debug "= e\n" #end
#declare A = array[2]; #declare A[1] = 5; #ifdef (A[0]) #debug "= 0\n" #else #debug "= not\n" #end #ifdef (A[1]) #debug "= 1\n" #end
#if (0) #elseif (1) #debug "= elseif\n" #else #end #ifndef (A) #else #debug "= A\n" #end #while (1) #debug "= once\n" #break #end"#,
        ],
    );
    refused(
        "facts/loops_refused",
        &[
            "#for (I, 0, 1, 0) #end",
            "#break",
            "#switch (1) sphere { 0, 1 } #case (1) #end #break",
        ],
    );
}

#[test]
fn macros_take_what_they_are_declared_with() {
    agree(
        "facts/macros",
        &[
            r#"#macro Sq(a1) a1+1 #end #debug concat("= ", str(2*Sq(3), 0, 0), "\n")
#macro Fac(N) #if (N < 2) 1 #else (N*Fac(N-1)) #end #end #declare F = (Fac(6)); #debug concat("= ", str(F, 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/macros_refused",
        &["#macro M(A, B) #end M(1)", "#macro M(A) #end M(1, 2)"],
    );
}

#[test]
fn arrays_have_up_to_five_dimensions() {
    agree(
        "facts/arrays",
        &[
            r#"#declare A = array[1][1][1][1][2] { { { { { 1, 2 } } } } } #debug concat("= ", str(A[0][0][0][0][1], 0, 0), str(dimensions(A), 0, 0), str(dimension_size(A, 5), 0, 0), "\n")"#,
        ],
    );
    refused(
        "facts/arrays_refused",
        &[
            "#declare A = array[1][1][1][1][1][1];",
            "#declare A = array[1] { 1, 2 }",
            "#declare A = array[2]; #declare B = A[0];",
            "#declare A = array[2] { 1, \"s\" }",
            "#declare A = array[2] { 1, x }",
        ],
    );
}

#[test]
fn files_are_written_and_read() {
    agree(
        "facts/files",
        &[
            r##"#fopen F "out.txt" write #write(F, 1.5, ",", <1,2,3>, ",", "text", "\n", 1/3, "\n") #fclose F"##,
            r##"#fopen F "d.txt" read #read(F, A, B, C) #debug concat("= ", str(A, 0, 2), vstr(3, B, ",", 0, 1), C, "\n")
#debug concat("= ", str(defined(F), 0, 0), "\n")
@@@ d.txt
1.5, <1,2,3>, "text""##,
        ],
    );
}

#[test]
fn an_error_ends_the_scene_and_a_warning_does_not() {
    refused("facts/error_refused", &["#error \"stop\""]);
    agree(
        "facts/warning",
        &["#warning \"careful\" #debug \"= on\\n\""],
    );
}

#[test]
fn versions_up_to_3_7() {
    refused("facts/version_refused", &["!#version 3.9; sphere { 0, 1 }"]);
    agree(
        "facts/version",
        &["#declare A = 1; #version 3.5; #debug concat(\"= \", str(version, 0, 1), \"\\n\")"],
    );
}

#[test]
fn include_files_resolve_with_and_without_their_extension() {
    agree(
        "facts/include",
        &[
            r#"#include "a" #include "b.txt" #include "colors" #debug concat("= ", str(A+B, 0, 0), vstr(3, Red, ",", 0, 0), "\n")
@@@ a.inc
#declare A = 1;
@@@ b.txt
#declare B = 2;"#,
        ],
    );
    refused("facts/include_refused", &["#include \"nowhere.inc\""]);
}

#[test]
fn there_are_no_words_of_later_versions() {
    refused(
        "facts/later_refused",
        &[
            "#declare D = dictionary { [\"a\"]: 1 }",
            "#declare A = array mixed [2] { 1, \"s\" }",
            "#declare (A, B) = (1, 2);",
        ],
    );
}

#[test]
fn functions_compute_as_they_say() {
    agree(
        "facts/functions",
        &[
            r#"#declare F = function { x + 10*y + 100*z } #declare G = function(a1, b1) { max(a1, b1, 3) - min(a1, b1, 3) }
#debug concat("= ", str(F(1, 2, 3), 0, 0), " ", str(G(1, 5), 0, 0), "\n") #declare H = function(n) { sum(i, 1, n, i*i) + prod(i, 1, n, i) }
#debug concat("= ", str(H(4), 0, 0), "\n") #declare I = function(x) { 1/x } #debug concat("= ", str(I(0), 0, 0), "\n")
#declare P = function { pattern { checker } } #declare Q = function { pigment { rgb <.25,.5,.75> } } #declare S = function { spline { 0, x, 1, y } } #declare T = function { transform { translate x } }
#debug concat("= ", str(P(.5, .5, .5), 0, 0), " ", str(Q(0, 0, 0).green, 0, 4), "\n")"#,
        ],
    );
    refused(
        "facts/functions_refused",
        &[
            "#declare F = function(x) { !x }",
            "#declare F = function(x) { x^2 }",
        ],
    );
}

#[test]
fn splines_go_through_their_points() {
    let kinds = [
        "",
        "linear_spline",
        "quadratic_spline",
        "cubic_spline",
        "natural_spline",
    ];
    let scenes: Vec<String> = kinds
        .iter()
        .map(|kind| {
            format!(
                "#declare S = spline {{ {kind} 0, x, 3, <0,2,5>, 1, y*3, 4, z, 2.5, <1,1,1> }} #declare I = -1; #while (I < 5.1) #debug concat(\"= \", vstr(3, S(I), \",\", 0, 6), \"\\n\") #declare I = I + .25; #end"
            )
        })
        .collect();
    agree(
        "facts/splines",
        &scenes.iter().map(String::as_str).collect::<Vec<_>>(),
    );
}

#[test]
fn statements_of_the_top_level() {
    agree(
        "facts/statements",
        &[
            r#"camera { location -3*z } light_source { 0, 1 } background { rgb 1 } fog { distance 100 } sky_sphere { pigment { rgb 1 } }
global_settings { max_trace_level 3 } #default { finish { ambient 0 } } sphere { 0, 1 } #declare S = sphere { 0, 1 } object { S } S sphere { S scale 2 } #debug "= ok\n""#,
            r#"#declare F = finish { phong 1 } #declare T = texture { finish { F ambient 0 } } sphere { 0, 1 texture { T finish { F phong_size 3 } } pigment { rgb 1 } } #debug "= ok\n""#,
            "",
        ],
    );
    refused(
        "facts/statements_refused",
        &["foo", "sphere { foo, 1 }", "sphere { 0, 1 } ;"],
    );
}
