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

#[test]
fn hashes_before_names() {
    agree(
        "lexical/hashes_before_names",
        &[
            r#"#declare V=<.5,0,0>; #declare W=#V; #debug concat("= ",str(#V.x+W.x+vlength(##V),0,1),"\n")"#,
            r#"#declare V=<.5,0,0>; #declare W=#
/* note */ V; #for(I,0,2) #declare W=#V*I+W; #debug concat("= ",str(W.x,0,1),"\n") #end"#,
            r#"#declare S="abc"; #declare C=rgb #x; #declare O=sphere{#(0)*x,1} #O object{#O #scale .5} #debug concat("= ",#S,str(C.red,0,1),"\n")"#,
            r#"#declare A=array[2]{x,y} #declare B=#A; #declare V=#A[1]; #debug concat("= ",str(V.y+#B[0].x,0,1),"\n")"#,
            r#"#declare F=function(#a){#a*2-#a} #declare G=#F; #debug concat("= ",str(#F(1)+G(2),0,1),"\n")"#,
            r#"#macro M(A) #A #end #declare V=#M(x); #declare O=sphere{0,1} #M(O) M(#O) #debug concat("= ",str(V.x,0,1),"\n")"#,
            r#"#ifdef(#A) #debug "= yes\n" #else #debug "= no\n" #end #declare A=1; #ifdef(#A) #debug "= yes\n" #else #debug "= no\n" #end"#,
            r#"#declare A=1; #declare B=array[3]; #debug concat("= ",str(defined(#A)+dimension_size(#B,1),0,1),"\n")"#,
            r#"#for(#I,0,1) #debug concat("= ",str(I,0,1),"\n") #end"#,
            r#"#declare O=sphere{#<0,0,0>#,#(1) pigment#{rgb x#}} #debug concat("= ",str(#x.x+#vnormalize(2*y).y+(#-1)+#t.t+#trace(O,-3*z,z).z,0,1),"\n")"#,
            r#"#if(0) #Foo # 0 #sin #; #end #debug "= ok\n""#,
        ],
    );
}

#[test]
fn hashes_before_names_refused() {
    refused(
        "lexical/hashes_before_names_refused",
        &[
            "sphere{# 0,1}",
            "sphere{0,#1}",
            "sphere{0,## .5}",
            "sphere{0,#sin(1)}",
            "sphere{0,#pi}",
            "sphere{0,#strlen(\"a\")}",
            "#declare R=1; sphere{0,#R}",
            "#declare A=array[1]{1} sphere{0,#A[0]}",
            "#macro M() 1 #end sphere{0,#M()}",
            "#macro M(A) sphere{0,#A} #end M(1)",
            "#declare F=function(a){# 2*a}",
            "#declare N=2; #declare F=function(a){#N*a}",
            "#declare A=1#;",
            "#Foo",
            "#declare #A=1;",
            "#declare A=x; #undef #A",
            "#macro #M() #end",
            "#macro M(#A) #end",
            "#declare I=1; #for(#I,0,1) #end",
            "#declare a=1; #declare F=function(#a){a}",
            "#macro M(A) #end M(#R)",
        ],
    );
}
