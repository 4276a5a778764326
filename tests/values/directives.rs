//! Directives: conditions, loops, declarations, messages.

use crate::{agree, refused};

#[test]
fn deprecated_names() {
    agree(
        "directives/deprecated_names",
        &[
            r#"#declare deprecated A=3;
#debug concat("= ",str(A,0,3),"\n")"#,
            r#"#declare deprecated "use B" A=3;
#debug concat("= ",str(A,0,3),"\n")
#debug concat("= ",str(A,0,3),"\n")"#,
            r#"#declare deprecated once "use B" A=3;
#debug concat("= ",str(A,0,3),"\n")
#debug concat("= ",str(A,0,3),"\n")"#,
            r#"#declare deprecated once A=3;
#debug concat("= ",str(A,0,3),"\n")"#,
            r#"#local deprecated once "x" A=3;
#debug concat("= ",str(A,0,3),"\n")"#,
            r#"#declare deprecated "m" T=texture{pigment{rgb 1}}
sphere{0,1 texture{T}}
#debug "= ok\n""#,
        ],
    );
}

#[test]
fn deprecated_names_refused() {
    refused(
        "directives/deprecated_names_refused",
        &[r#"#macro deprecated M() 3 #end"#],
    );
}

#[test]
fn directives_without_a_hash() {
    agree(
        "directives/directives_without_a_hash",
        &[r#"declare A=3;
#debug concat("= ",str(A,0,3),"\n")
include "i.inc"
#debug concat("= ",str(B,0,3),"\n")
@@@ i.inc
#declare B=4;"#],
    );
}

#[test]
fn directives_without_a_hash_refused() {
    refused(
        "directives/directives_without_a_hash_refused",
        &[r#"local A=3;"#, r#"if(1) #debug "= x\n" #end"#],
    );
}

#[test]
fn conditions_across_files() {
    agree(
        "directives/conditions_across_files",
        &[
            r#"#if(1)
#include "i.inc"
#debug "= x\n"
@@@ i.inc
#debug "= in\n"
#end"#,
            r#"#include "i.inc"
#debug "= x\n"
#end
#debug "= y\n"
@@@ i.inc
#if(0)"#,
            r#"#include "i.inc"
#debug "= x\n"
#else
#debug "= z\n"
#end
#debug "= y\n"
@@@ i.inc
#if(0)
#debug "= i\n""#,
            r#"#include "i.inc"
#debug "= x\n"
#else
#debug "= z\n"
#end
#debug "= y\n"
@@@ i.inc
#if(1)
#debug "= i\n""#,
            r#"#macro M() #if(1) #end
M() #debug "= x\n" #end"#,
        ],
    );
}

#[test]
fn conditions_across_files_refused() {
    refused(
        "directives/conditions_across_files_refused",
        &[r#"#declare I=0;
#include "i.inc"
#debug concat("= x ",str(I,0,0),"\n")
#declare I=I+1;
#end
#debug "= y\n"
@@@ i.inc
#while(I<3)"#],
    );
}

#[test]
fn values_behind_directives() {
    agree(
        "directives/values_behind_directives",
        &[
            r#"#declare A = #if(1) 7; #else 8; #end
#debug concat("= ",str(A,0,0),"\n")"#,
            r#"#declare A =
#include "i.inc"
#debug concat("= ",str(A,0,0),"\n")
@@@ i.inc
3;"#,
            r#"#macro M() 3; #end
#declare A = M()
#debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro M(X) sphere{0,X} #end
#declare A = M(1)
object{A}
#declare B = union{M(1) M(2)}
#debug "= ok\n""#,
            r#"#declare A = #declare B=3; B*2;
#debug concat("= ",str(A,0,0),str(B,0,0),"\n")"#,
        ],
    );
}

#[test]
fn switches() {
    agree(
        "directives/switches",
        &[
            r#"#switch(3) #case(3) #debug "= 3\n" #case(4) #debug "= 4\n" #range(5,6) #debug "= r\n" #break #case(7) #debug "= 7\n" #else #debug "= e\n" #end"#,
            r#"#switch(8) #case(3) #debug "= 3\n" #range(5,6) #debug "= r\n" #else #debug "= e\n" #end"#,
            r#"#switch(5) #case(3) #debug "= 3\n" #range(5,6) #debug "= r\n" #else #debug "= e\n" #end"#,
            r#"#switch(5) #debug "= pre\n" #case(5) #debug "= 5\n" #end"#,
            r#"#switch(1+1) #case(1) #break #case(2) #while(1) #debug "= w\n" #break #end #debug "= after\n" #break #debug "= never\n" #end"#,
            r#"#switch(2) #case(1) #switch(1) #case(1) #debug "= no\n" #end #case(2) #debug "= 2\n" #switch(9) #case(1) #else #debug "= in\n" #end #case(3) #debug "= 3\n" #end"#,
            r#"#switch(2) #range(1,2) #debug "= r\n" #break #end #switch(2) #range(2,1) #debug "= x\n" #end #switch(-1) #case(-1) #debug "= neg\n" #end #switch(1/3) #case(0.33333333333) #debug "= eps\n" #end"#,
            r#"#switch(1) #case(1) #debug "= 1\n" #else #debug "= e\n" #end"#,
            r#"#switch(1) #case(1) #debug "= 1\n" #break #else #debug "= e\n" #end"#,
            r#"#switch(3) #case(1) #else #debug "= e\n" #break #debug "= no\n" #end #debug "= after\n""#,
        ],
    );
}

#[test]
fn loops() {
    agree(
        "directives/loops",
        &[
            r#"#for(I,0,1,0.25) #debug concat("= ",str(I,0,3),"\n") #end #debug concat("= end ",str(I,0,3),"\n")"#,
            r#"#for(I,1,0,-0.5) #debug concat("= ",str(I,0,3),"\n") #end #debug concat("= end ",str(I,0,3),"\n")"#,
            r#"#for(I,1,0) #debug concat("= ",str(I,0,3),"\n") #end #debug concat("= end ",str(I,0,3),"\n")"#,
            r#"#for(I,0,1,-1) #debug concat("= ",str(I,0,3),"\n") #end #debug concat("= end ",str(I,0,3),"\n")"#,
            r#"#for(I,0,1,0.1) #debug concat("= ",str(I,0,17),"\n") #if(I>.35) #break #end #end #debug concat("= end ",str(I,0,3),"\n")"#,
            r#"#for(I 0 2) #debug concat("= ",str(I,0,3),"\n") #end"#,
            r#"#macro M() #for(I,0,1) #debug concat("= ",str(I,0,0),"\n") #end #end
M()
#ifdef(I) #debug "= global\n" #else #debug "= gone\n" #end"#,
            r#"#macro M() #local K=5; #for(K,0,1) #debug concat("= ",str(K,0,0),"\n") #end #end
M()
#ifdef(K) #debug "= global\n" #else #debug "= gone\n" #end"#,
            r#"#declare I=77; #macro M() #for(I,0,1) #end #debug concat("= ",str(I,0,0),"\n") #end M() #debug concat("= ",str(I,0,0),"\n")"#,
            r#"#include "i.inc"
#ifdef(I) #debug concat("= ",str(I,0,0),"\n") #else #debug "= gone\n" #end
@@@ i.inc
#for(I,0,1) #end"#,
            r#"#for(I,0,3) #debug concat("= ",str(I,0,0),"\n") #declare I=I+1; #end"#,
            r#"#declare I="x"; #for(I,0,1) #debug concat("= ",str(I,0,0),"\n") #end"#,
            r#"#for(I,0,5) #if(I=2) #local I=4; #end #debug concat("= ",str(I,0,0),"\n") #end"#,
            r#"#macro M() #for(I,0,2) N() #debug concat("= m ",str(I,0,0),"\n") #end #end #macro N() #for(I,0,1) #debug concat("= n ",str(I,0,0),"\n") #end #end M()"#,
            r#"#for(I,0,1e-11,1) #debug concat("= ",str(I,0,0),"\n") #end"#,
            r#"#for(I,0,0.999999999999,0.333333333333333) #debug concat("= ",str(I,0,5),"\n") #end"#,
            r#"#for(I,0,(1<2)) #debug concat("= ",str(I,0,5),"\n") #end"#,
        ],
    );
}

#[test]
fn loops_refused() {
    refused(
        "directives/loops_refused",
        &[
            r#"#for(I,0,1,0) #end"#,
            r#"#for(I,0,1,1e-12) #break #end
#debug "= ok\n""#,
            r#"#for(I,0,1<2) #debug concat("= ",str(I,0,5),"\n") #end"#,
            r#"#for(I,<1,2,3>,4) #end"#,
            r#"#for(A[0],0,1) #end"#,
        ],
    );
}

#[test]
fn breaks() {
    agree(
        "directives/breaks",
        &[
            r#"#macro M() #debug "= a\n" #break #debug "= b\n" #end
M()
#debug "= c\n""#,
            r#"#macro M() #while(1) #if(1) #break #end #end #debug "= a\n" #end
M()
#debug "= c\n""#,
            r#"#while(1) #include "i.inc" #end
#debug "= c\n"
@@@ i.inc
#debug "= b\n"
#break
#debug "= d\n""#,
        ],
    );
}

#[test]
fn breaks_refused() {
    refused(
        "directives/breaks_refused",
        &[
            r#"#break"#,
            r#"#if(1) #break #end"#,
            r#"#include "i.inc"
#debug "= c\n"
@@@ i.inc
#debug "= b\n"
#break
#debug "= d\n""#,
        ],
    );
}

#[test]
fn messages() {
    agree(
        "directives/messages",
        &[
            r#"#render "= r\n"
#statistics "= s\n"
#warning "= w\n"
#debug "= d\n""#,
            r#"#render concat("= r","\n")"#,
        ],
    );
}

#[test]
fn messages_refused() {
    refused("directives/messages_refused", &[r#"#error "boom""#]);
}

#[test]
fn scopes() {
    agree(
        "directives/scopes",
        &[
            r#"#declare A=1; #undef A #ifdef(A) #debug "= y\n" #else #debug "= n\n" #end
#undef B
#debug "= ok\n""#,
            r#"#macro M() 1 #end #undef M #ifdef(M) #debug "= y\n" #else #debug "= n\n" #end"#,
            r#"#declare A=1; #macro M() #local A=2; #undef A #debug concat("= ",str(A,0,0),"\n") #end M()"#,
            r#"#macro M(P) #undef P #ifdef(P) #debug "= y\n" #else #debug "= n\n" #end #end
#declare Q=1; M(Q) #ifdef(Q) #debug "= y\n" #else #debug "= n\n" #end"#,
            r#"#macro M() #ifdef(L) #debug "= y\n" #else #debug "= n\n" #end #local L=1; #end M() M()"#,
            r#"#local A=1; #macro M() #declare A=2; #end M() #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro M() #local A=2; N() #debug concat("= ",str(A,0,0),"\n") #end #macro N() #declare A=3; #end M() #ifdef(A) #debug "= g\n" #end"#,
            r#"#include "i.inc"
#ifdef(L) #debug "= y\n" #else #debug "= n\n" #end
#debug concat("= ",str(D,0,0),"\n")
@@@ i.inc
#local L=1; #declare D=2;"#,
        ],
    );
}

#[test]
fn conditions() {
    agree(
        "directives/conditions",
        &[
            r#"#ifdef (sphere) #debug "= y\n" #end"#,
            r#"#debug concat("= ",str(defined(A),0,0),"\n") #declare A=1; #debug concat("= ",str(defined(A),0,0),"\n") #macro M() #end #debug concat("= ",str(defined(M),0,0),"\n")"#,
            r#"#if(1) #debug "= y\n" #elseif(1) #debug "= n\n" #else #debug "= n\n" #end #if(0) #elseif(0) #elseif(1) #debug "= 3\n" #elseif(1) #debug "= 4\n" #else #end"#,
            r#"#ifdef(X) #elseif(1) #debug "= e\n" #end"#,
            r#"#ifndef(X) #debug "= n\n" #else #debug "= y\n" #end"#,
            r#"#if("a"="a") #debug "= n\n" #end #if("a"!="b") #debug "= n\n" #end #if("a"<"b") #debug "= n\n" #end #if(strcmp("a","b")<0) #debug "= n\n" #end"#,
        ],
    );
}

#[test]
fn conditions_refused() {
    refused(
        "directives/conditions_refused",
        &[
            r#"#ifdef(A B) #end"#,
            r#"#if(0 "unclosed) #end"#,
            r#"#if(<1,2,3>) #end"#,
            r#"#if(1) "#,
            r#"#while(0) "x #end"#,
        ],
    );
}

#[test]
fn defaults() {
    agree(
        "directives/defaults",
        &[
            r#"#default{radiosity{importance .5}}
#debug "= ok\n""#,
            r#"#default{camera{location 0}}
#debug "= ok\n""#,
            r#"default{pigment{rgb 1}}
#debug "= ok\n""#,
        ],
    );
}

#[test]
fn defaults_refused() {
    refused(
        "directives/defaults_refused",
        &[r#"#default{interior{ior 1}}"#, r#"#default{texture{T}}"#],
    );
}

#[test]
fn versions_hold_at_once() {
    agree(
        "directives/versions_hold_at_once",
        &[
            r#"#version 3.0
#declare A=1
#declare B=2
#debug concat("= ",str(A+B,0,1)," ",str(version,0,2),"\n")"#,
            r#"#version 3.0 #debug concat("= ",str(version,0,2),"\n") #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#version 3.0 #version 3.1 #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#version 3.0 #version 3.6; #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#version 3.0 #version 3.1 #version 3.4 #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#version (3.0 + 2*.1)
#if(version<3.3) #debug "= old\n" #else #debug "= new\n" #end #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#if(version>3.5) #version 3.0 #end #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#macro V() #version 3.0 #end V(); #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#macro V() #version 3.0 #end V() #debug concat("= ",str(version,0,2),"\n")"#,
            r#"#include "v.inc" #debug concat("= ",str(version,0,2),"\n")
@@@ v.inc
#version 3.0"#,
            r#"#include "v.inc"; #debug concat("= ",str(version,0,2),"\n")
@@@ v.inc
#version 3.0"#,
            r#"#version 3.0
#include "v.inc"
#debug concat("= ",str(A,0,2),"\n")
@@@ v.inc
#declare A=version"#,
            r#"#declare Old=version; #version 3.0
#declare A=1
#version Old
#declare B=version; #debug concat("= ",str(B,0,2)," ",str(version,0,2),"\n")"#,
            r#"#version 3.0
#declare V=version #version 3.5; #debug concat("= ",str(V,0,2)," ",str(version,0,2),"\n")"#,
            r#"#version 3.0
#while(version>3.5) #debug "= new\n" #break #end #debug "= end\n""#,
        ],
    );
}

#[test]
fn versions_hold_at_once_refused() {
    refused(
        "directives/versions_hold_at_once_refused",
        &[
            "#version 3.5 #declare A=1\nsphere{0,1}",
            "#version 3.0 #declare A=1; + .5;",
            "#version 3.0 #if(1) + .5 #end;",
            "#if(1) #version 3.0 #end;",
            "#version #if(1) 3.0 #end;",
            "#version 3.9;",
        ],
    );
}
