//! Constructs of the standard includes and the example scenes that no tree of blocks can represent: directives open
//! blocks that others close.

use crate::{agree, refused};

#[test]
fn a_block_is_opened_by_one_of_two_branches() {
    agree(
        "tables/branches",
        &[
            r#"#macro M(Use) #if (Use) merge { #else union { #end sphere { 0, 1 } sphere { x, 1 } } #end
#declare A = M(1) #declare B = M(0)
#debug concat("= ", vstr(3, max_extent(A), ",", 0, 2), " ", vstr(3, max_extent(B), ",", 0, 2), "\n")"#,
            r#"#macro M(Angle) #if (abs(Angle) >= 180) merge { #end sphere { 0, 1 } #if (abs(Angle) >= 180) sphere { y, 1 } } #end #end
#declare A = M(200) #declare B = M(20)
#debug concat("= ", vstr(3, max_extent(A), ",", 0, 2), " ", vstr(3, max_extent(B), ",", 0, 2), "\n")"#,
            r#"#macro M(ToFile) #if (ToFile) #fopen F "out.txt" write #else union { #end
#local I = 0; #while (I < 3) #if (ToFile) #write(F, "sphere{", I*x, ",1}\n") #else sphere { I*x, 1 } #end #local I = I + 1; #end
#if (ToFile) #fclose F #else } #end #end
M(1)
#declare A = M(0) #declare B = union { #include "out.txt" }
#debug concat("= ", vstr(3, max_extent(A), ",", 0, 2), " ", vstr(3, max_extent(B), ",", 0, 2), "\n")"#,
        ],
    );
}

#[test]
fn blocks_are_filled_by_loops_and_closed_elsewhere() {
    agree(
        "tables/write",
        &[r#"#fopen F "out.txt" write
#declare Write = 1;
#if (Write) #write(F, "mesh2{ vertex_vectors{ 3, ", #end
#declare I = 0; #while (I < 3) #if (Write) <I, I*I, 0> #end #declare I = I + 1; #end
#if (Write) "}\n") #end
#fclose F"#],
    );
}

#[test]
fn a_directive_stands_between_a_name_and_its_value() {
    agree(
        "tables/values",
        &[
            r#"#declare T = #ifdef (X) sphere { 0, 1 } #else sphere { 0, 2 } #end
#debug concat("= ", vstr(3, max_extent(T), ",", 0, 2), "\n")"#,
            r#"#declare File = "ball.inc"; #declare M = #include File
#debug concat("= ", vstr(3, max_extent(M), ",", 0, 2), "\n")
@@@ ball.inc
sphere { 0, 3 }"#,
            r#"#declare deprecated once "old" Name = 3;
#debug concat("= ", str(Name, 0, 0), str(Name, 0, 0), "\n")"#,
        ],
    );
}

#[test]
fn a_lone_hash_is_passed_over() {
    agree("tables/hash", &[r##"sphere { 0, 1 #} #debug "= read\n""##]);
}

#[test]
fn words_of_functions_stand_without_parentheses() {
    agree(
        "tables/words",
        &[
            r#"#declare A = text { internal 1 "P" 0.25, 0 }
#debug concat("= ", str(max_extent(A).z, 0, 3), "\n")"#,
            r#"#declare A = julia_fractal { <-0.08, 0, -0.83, -0.025> quaternion sqr max_iteration 8 precision 15 }
#debug concat("= ", vstr(3, max_extent(A), ",", 0, 3), "\n")"#,
        ],
    );
}

#[test]
fn two_dots_are_no_size() {
    refused("tables/dots", &["#declare A = array[..];"]);
}

#[test]
fn hexadecimal_numbers_are_not_supported() {
    refused("tables/numbers", &["#declare A = 0x10;"]);
}
