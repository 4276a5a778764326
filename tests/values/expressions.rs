//! Expressions outside and inside of parentheses, members, numbers.

use crate::{agree, refused};

#[test]
fn members() {
    agree(
        "expressions/members",
        &[
            r#"#declare C=rgb <1,2,3>; #debug concat("= ",str(C.gray,0,5)," ",str(C.red,0,1)," ",str(C.filter,0,1),"\n")
#debug concat("= ",str(<1,2,3>.gray,0,5),"\n")
#debug concat("= ",str(<1,2>.u,0,5),str(<1,2>.v,0,5),str(<1,2,3,4>.t,0,1),"\n")"#,
            r#"#declare F=3; #debug concat("= ",str(F.x,0,5),"\n")"#,
            r#"#debug concat("= ",str((1+2*x).y,0,5),"\n")"#,
        ],
    );
}

#[test]
fn members_refused() {
    refused(
        "expressions/members_refused",
        &[
            r#"#declare A=<1,2,3>.gray; #declare B=(rgb <1,2,3>); "#,
            r#"#debug concat("= ",str(<1,2,3>.t,0,5),"\n")"#,
            r#"#debug concat("= ",str(x.filter,0,5),"\n")"#,
            r#"#debug concat("= ",str(3.x,0,5),"\n")"#,
        ],
    );
}

#[test]
fn vectors() {
    agree(
        "expressions/vectors",
        &[
            r#"#declare V=<1 -2 3>; #debug concat("= ",vstr(3,V,",",0,1),"\n") #declare W=<1 2 3>; #debug concat("= ",vstr(3,W,",",0,1),"\n")"#,
        ],
    );
}

#[test]
fn comparisons_need_parentheses() {
    agree(
        "expressions/comparisons_need_parentheses",
        &[
            r#"#declare A=(1<2)+(3&0)+(3|0)+(0?5:6); #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#debug concat("= ",str((1|0&0),0,0),str((0&0|1),0,0),str((1=1=1),0,0),str((2=2=2),0,0),str((1?0:1?2:3),0,0),"\n")"#,
        ],
    );
}

#[test]
fn comparisons_need_parentheses_refused() {
    refused(
        "expressions/comparisons_need_parentheses_refused",
        &[
            r#"#declare A=1<2;"#,
            r#"#declare A=<1<2,2,3>;"#,
            r#"#declare A=array[2]{1,2} #declare B=A[0<1];"#,
            r#"#macro M(A) #end M(1<2)"#,
            r#"#declare A=(<1,2,3>=<1,0,3>); #debug concat("= ",vstr(3,A,",",0,1),"\n") #declare A=(<1,2,3> < 2); #debug concat("= ",vstr(3,A,",",0,1),"\n")"#,
        ],
    );
}

#[test]
fn signs_and_nots() {
    agree(
        "expressions/signs_and_nots",
        &[
            r#"#declare A=!<1,0,2>; #debug concat("= ",vstr(3,A,",",0,1),"\n") #declare B=!!3; #declare D=-!0; #debug concat("= ",str(B,0,0),str(D,0,0),"\n") "#,
            r#"#declare A=!-4; #declare B=-!-0; #debug concat("= ",str(A,0,0),str(B,0,0)," ",vstr(3,!-<0,2,0>,",",0,0),"\n") "#,
        ],
    );
}

#[test]
fn numbers() {
    agree(
        "expressions/numbers",
        &[
            r#"#declare A=1e; #declare B=5.; #declare C=.5e2; #declare D=1.e1; #declare E=1E+2; #debug concat("= ",str(A,0,1),str(B,0,1),str(C,0,1),str(D,0,1),str(E,0,1),"\n")"#,
        ],
    );
}

#[test]
fn numbers_refused() {
    refused(
        "expressions/numbers_refused",
        &[
            r#"#declare A=1.2.3;"#,
            r#"#declare A=2^3;"#,
            r#"#declare A=7%3;"#,
        ],
    );
}

#[test]
fn semicolons() {
    agree(
        "expressions/semicolons",
        &[
            r#"#declare A=1;; #debug "= ok\n""#,
            r#"!#version 3.1;
#declare A=5
#declare B=<1,2,3>
#declare C=rgb 1
#debug concat("= ",str(A,0,0),vstr(3,B,",",0,0),"\n")"#,
            r#"#declare A="a" #declare B="b"; #declare C=sphere{0,1} #declare D=array[2]{1,2} #declare E=texture{pigment{rgb 1}} #debug "= ok\n""#,
        ],
    );
}

#[test]
fn semicolons_refused() {
    refused(
        "expressions/semicolons_refused",
        &[r#"sphere{0,1};"#, r#"#declare A=<1,2,3> #declare B=2;"#],
    );
}

#[test]
fn more_than_one_value() {
    agree(
        "expressions/more_than_one_value",
        &[
            r#"#declare A = sphere{0,1} sphere{0,2}
#debug concat("= ",vstr(3,max_extent(A),",",0,1),"\n")"#,
            r#"#declare A = texture{pigment{rgb 1}} texture{pigment{rgbt 1}}
sphere{0,1 texture{A}}
#debug "= ok\n""#,
        ],
    );
}

#[test]
fn conditions_in_expressions() {
    agree(
        "expressions/conditions_in_expressions",
        &[
            r#"#declare A=3; #declare B=(#if(A=3) 5 #else 6 #end)*2; #debug concat("= ",str(B,0,0),"\n")"#,
            r#"#declare A=<#if(1) 5 #else 6 #end, 1, 2>; #debug concat("= ",vstr(3,A,",",0,0),"\n")"#,
            r#"#debug concat(#if(1) "= y" #else "= n" #end, "\n")"#,
            r#"#declare V=<1,2,3>; sphere { V -1, 1 } #debug "= ok\n""#,
        ],
    );
}

#[test]
fn conditions_in_expressions_refused() {
    refused(
        "expressions/conditions_in_expressions_refused",
        &[
            r#"#macro F() A #end #declare A=array[2]{1,2} #declare B=F()[1];"#,
            r#"#declare A=5 B=6;"#,
        ],
    );
}
