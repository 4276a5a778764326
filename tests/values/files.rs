//! Files that scenes write and read.

use crate::{agree, refused};

#[test]
fn values_are_written_as_by_c() {
    agree(
        "files/values_are_written_as_by_c",
        &[
            r#"#fopen F "out.txt" write
#write(F, 1,2)
#fclose F
#fopen F "out.txt" append
#write(F, "more", "\n")
#fclose F
#fopen F "out.txt" read
#debug "= opened\n"
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")"#,
            r#"#fopen F "out.txt" write
#write(F, "a, b, c")
#write(F)
#write(F,)
#fclose F"#,
            r#"#fopen F "out.txt" write
#declare A=array[2]{1,2}
#write(F, A[0],A[1], A[0]+1, "\n")
#declare S="abc";
#write(F, S, concat(S,S), "\n")
#declare B=array[2]{"u","v"}
#write(F, B[0],B[1],"\n")
#macro M() 1,2 #end
#write(F, M(),"\n")
#write(F, #local i=0; #while(i<3) i, " ", #local i=i+1; #end "\n")
#write(F, 1/0, "\n", -1/0, "\n", 0/0,"\n")"#,
            r#"#fopen F "out.txt" write
#write(F, 1 "a", "b" 2, "\n")"#,
            r#"#fopen F concat("out",".txt") write
#write(F, "b")"#,
            r#"#fopen F "out" write
#write(F, "b")"#,
        ],
    );
}

#[test]
fn faulty_file_directives_are_refused() {
    refused(
        "files/faulty_file_directives_are_refused",
        &[
            r#"#fopen F "out.txt" write
#write(G, "a, b, c")"#,
            r#"#fopen F "out.txt" write
#read(F, A)"#,
            r#"#fopen F "out.txt" read"#,
            r#"#fopen F "nodir/out.txt" write"#,
            r#"#fopen F "d.txt" read
#while(defined(F))
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")
#end
@@@ d.txt
1,foo,3"#,
            r#"#declare Arr=array[3];
#fopen F "d.txt" read
#read(F,Arr[0],Arr[1],Arr[2])
#debug concat("= ", str(Arr[0],0,3), str(Arr[1],0,3), str(Arr[2],0,3), "\n")
#ifdef(F) #debug "= def\n" #else #debug "= undef\n" #end
@@@ d.txt
1,2,3"#,
            r#"#fopen F "out.txt" write
#fopen F "out2.txt" write
#write(F, "F")
#fclose F"#,
            r#"#fopen F "out.txt" write
#write F "a""#,
            r#"#fopen F "out.txt" write;
#fclose F;
#debug "= x\n""#,
            r#"#fopen F "d" read
#read(F,A)
#debug concat("= ",str(A,0,0),"\n")
@@@ d.inc
5"#,
            r#"#fopen F "d.txt" read
#write(F,"new")
@@@ d.txt
old"#,
            r#"#fopen F "d.txt" rw"#,
            r#"#fopen F "d.txt""#,
            r#"#fopen sphere "d.txt" write"#,
            r#"#declare F=3;
#fopen F "d.txt" write"#,
            r#"#fopen F "d.txt" read
#declare O=sphere{0,1}
#read(F,O)
@@@ d.txt
1,2,"s\n\"q",3 4 <5,6,7> 8"#,
            r#"#fopen G "out.txt" write
#declare H=G;
#write(H,"a")"#,
            r#"#fopen G "out.txt" write
#fclose (G)"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ",vstr(3,A,",",0,3),"\n")
@@@ d.txt
-<1,2,1>"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ",str(A,0,3),"\n")
@@@ d.txt
pi"#,
        ],
    );
}

#[test]
fn values_are_read_up_to_the_end() {
    agree(
        "files/values_are_read_up_to_the_end",
        &[
            r#"#fopen F "d.txt" read
#while(defined(F))
#read(F,A,B,C)
#debug concat("= ", str(A,0,3), " ", vstr(3,B,",",0,3)," ", C, "\n")
#end
@@@ d.txt
1, <1,2,3>, "abc",
2, <4,5,6>, "def","#,
            r#"#fopen F "d.txt" read
#while(defined(F))
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")
#end
#ifdef(F) #debug "= def\n" #else #debug "= undef\n" #end
@@@ d.txt
1,2,3
4 5
-6, - 7, +8"#,
            r#"#fopen F "d.txt" read
#while(defined(F))
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")
#end
@@@ d.txt
1,2,3,"#,
            r#"#fopen F "d.txt" read
#read(F,A,B)
#ifdef(A) #debug concat("= ", str(A,0,3), "\n") #end
#ifdef(B) #debug concat("= ", str(B,0,3), "\n") #end
#ifdef(F) #debug "= def\n" #else #debug "= undef\n" #end
@@@ d.txt
1"#,
            r#"#fopen F "d.txt" read
#read(F,A,B)
#ifdef(F) #debug "= def\n" #else #debug "= undef\n" #end
@@@ d.txt"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")
@@@ d.txt
1+2"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ", str(A,0,3), "\n")
@@@ d.txt
1e1 // comment
, 2"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ",A,"\n")
#read(F,A)
#debug concat("= ",A,"\n")
@@@ d.txt
"s\n\"q","x\\y""#,
            r#"#fopen F "d.txt" read
#macro R(X) #read(F,X) #end
#declare Q=0;
R(Q)
#debug concat("= ",str(Q,0,0),"\n")
#macro R2() #local Z=0; #read(F,Z) #read(F,Y) #debug concat("= ",str(Z,0,0),str(Y,0,0),"\n") #end
R2()
#ifdef(Y) #debug "= Y global\n" #end
@@@ d.txt
1,2,3"#,
            r#"#fopen F "d.txt" read
#read(F,A,B) 
#debug concat("= ",str(A,0,0),str(B,0,0),"\n")
#fclose F
#fopen F "d.txt" read
#read(F,A B) 
#debug concat("= ",str(A,0,0),str(B,0,0),"\n")
@@@ d.txt
1,2,3"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#read(F,B)
#debug concat("= ",vstr(3,A,",",0,3),"\n")
#debug concat("= ",vstr(3,B,",",0,3),"\n")
@@@ d.txt
<1 2 3>,< 1 , -2, +3 >"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ",vstr(3,A,",",0,3),"\n")
@@@ d.txt
<1,2,1+2>"#,
            r#"#fopen F "d.txt" read
#read(F,A)
#debug concat("= ",str(A,0,3),"\n")
@@@ d.txt
1;2"#,
        ],
    );
}

#[test]
fn values_are_read_up_to_the_end_refused() {
    refused(
        "files/values_are_read_up_to_the_end_refused",
        &[r#"#fopen F "colors.inc" read
#read(F,A)
#debug concat("= ",str(A,0,0),"\n")"#],
    );
}

#[test]
fn what_was_written_can_be_read() {
    agree(
        "files/what_was_written_can_be_read",
        &[
            r#"#fopen F "out.txt" write
#write(F, "sphere{0,1 pigment{rgb 1}}")
#fclose F
#include "out.txt"
#debug "= ok\n""#,
            r##"#fopen F "out.txt" write
#write(F, "#debug \"= one\\n\"\n")
#fclose F
#include "out.txt"
#fopen F "out.txt" write
#write(F, "#debug \"= two\\n\"\n")
#fclose F
#include "out.txt""##,
            r#"#fclose F"#,
            r#"#fopen F "d.txt" append
#write(F,"new")
@@@ d.txt
old"#,
            r#"#fopen F "colors.inc" append
#write(F,"new")"#,
            r#"#macro M() #fopen F "out.txt" write #write(F,"a") #end
M()
#ifdef(F) #debug "= F is global\n" #end
#write(F,"b")
#fclose F"#,
            r#"#fopen G "out.txt" write
#local I=0;
#undef G
#fopen G "out.txt" append
#write(G,"a")"#,
        ],
    );
}

#[test]
fn files_are_found_by_their_whole_names() {
    agree(
        "files/files_are_found_by_their_whole_names",
        &[
            r#"#debug concat("= ", str(file_exists("/etc/hostname"),0,0), str(file_exists("/etc/povray/3.7/povray.ini"),0,0), str(file_exists("s.pov"),0,0), str(file_exists("colors.inc"),0,0), str(file_exists("colors"),0,0), str(file_exists("nix"),0,0),"\n")"#,
        ],
    );
}
