//! The `;` after declarations, which may stand after the macro or file in which the value ends.

use crate::{agree, refused};

#[test]
fn a_number_takes_two() {
    agree(
        "semicolons/a_number_takes_two",
        &[
            r#"#declare A=1;; #declare V=x;; #declare C=rgb x;; #declare R=array[1]; #declare R[0]=2;;
#debug concat("= ",str(A+V.x+C.red+R[0],0,1),"\n")"#,
            r#"#macro M() #declare A=1; #end M(); #debug concat("= ",str(A,0,1),"\n")"#,
            r#"#macro M() #declare A=1; // note
/* note */ #end M() ; #debug concat("= ",str(A,0,1),"\n")"#,
            r#"#macro M(Q) #declare Q=1; #end #macro N(Q) M(Q) #end #declare R=2; N(R); #debug concat("= ",str(R,0,1),"\n")"#,
            r#"#macro M() #declare Q=color red 1; #end M(); #debug concat("= ",str(Q.red,0,1),"\n")"#,
            r#"#macro M() 1; #end #declare B=M(); #debug concat("= ",str(B,0,1),"\n")"#,
            r#"#macro M() #declare A=0.5; #end sphere{0,0.5 M(); pigment{rgb x}} #debug concat("= ",str(A,0,1),"\n")"#,
            r#"#include "a.inc"; #debug concat("= ",str(A,0,1),"\n")
@@@ a.inc
#declare A=1;
// the end"#,
            r#"#include "b.inc"
; #debug concat("= ",str(A,0,1),"\n")
@@@ a.inc
#declare A=1;
@@@ b.inc
#include "a.inc""#,
            r#"#macro M() #include "a.inc" #end M(); #debug concat("= ",str(A,0,1),"\n")
@@@ a.inc
#declare A=1;"#,
            r#"#macro M() #declare A=1; #end
#include "a.inc"; #debug concat("= ",str(A,0,1),"\n")
@@@ a.inc
M()"#,
            r#"#declare F=function(a){a} #declare G=F;; #declare A=array[1]{F} #declare H=A[0];;
#debug concat("= ",str(G(1)+H(2),0,1),"\n")"#,
        ],
    );
}

#[test]
fn a_number_takes_two_refused() {
    refused(
        "semicolons/a_number_takes_two_refused",
        &[
            "#declare A=1;;;",
            "#declare A=sphere{0,1};;",
            r#"#declare A="a";;"#,
            "#declare F=function(a){a};;",
            "#macro M() #declare A=1;; #end M();",
            "#macro M() #declare A=1; #end M();;",
            "#macro M() #declare A=1; #end #macro N() M(); #end N();",
            "#macro M() #declare A=sphere{0,1}; #end M();",
            "#macro M() #if(1) #declare A=1; #end #end M();",
            "#if(1) #declare A=1; #end ;",
            r#"#declare A=1; #debug "x" ;"#,
            "#include \"a.inc\";;\n@@@ a.inc\n#declare A=1;",
            "#include \"a.inc\";\n@@@ a.inc\n#declare A=sphere{0,1};",
        ],
    );
}

#[test]
fn the_only_one_behind_a_macro_or_file() {
    agree(
        "semicolons/the_only_one_behind_a_macro_or_file",
        &[
            r#"#macro M(Q) #declare Q=1 #end #declare R=2; M(R); #debug concat("= ",str(R,0,1),"\n")"#,
            r#"#macro M(Q) #declare Q=1 #end #declare R=2; M(R);; #debug concat("= ",str(R,0,1),"\n")"#,
            r#"#macro M(Q) #declare Q=x*2 #end #macro N(Q) M(Q) #end #declare R=y; N(R); #debug concat("= ",str(R.x,0,1),"\n")"#,
            r#"#macro M(Q) #declare Q[0]=sin(1)+(1-0.8) #end #declare R=array[1]; M(R); #debug concat("= ",str(R[0],0,6),"\n")"#,
            r#"#macro M() #local Q=1 #end M(); #ifdef(Q) #debug "= yes\n" #else #debug "= no\n" #end"#,
            r#"#macro M() #declare Q=color red 1 #end M(); #debug concat("= ",str(Q.red,0,1),"\n")"#,
            r#"#declare F=function(a){a} #macro M(Q,I) #declare Q=F(I) #end #declare R=2; #for(I,0,3) M(R,I); #debug concat("= ",str(R,0,1),"\n") #end"#,
            r#"#macro N() 3 #end #macro M(Q) #declare Q=N() #end #declare R=2; #for(I,0,3) M(R); #debug concat("= ",str(R,0,1),"\n") #end"#,
            r#"#macro M(Q,I) #local B=I*2; #declare Q=B; #end #declare R=2; #declare I=0; #while(I<4) M(R,I); #declare I=I+1; #end #debug concat("= ",str(R,0,1),"\n")"#,
            r#"#include "a.inc"; #ifdef(Q) #debug "= yes\n" #else #debug "= no\n" #end
@@@ a.inc
#local Q=1"#,
            r#"#include "a.inc" +1; #debug concat("= ",str(Q,0,1),"\n")
@@@ a.inc
#declare Q=1"#,
            r#"#version 3.1; #macro M(Q) #declare Q=1 #end #declare R=2; M(R) #debug concat("= ",str(R,0,1),"\n")"#,
            r#"#version 3.1; #macro M(Q) #declare Q=1 #end #declare R=2; M(R) sphere{0,1} #debug concat("= ",str(R,0,1),"\n")"#,
        ],
    );
}

#[test]
fn the_only_one_behind_a_macro_or_file_refused() {
    refused(
        "semicolons/the_only_one_behind_a_macro_or_file_refused",
        &[
            "#macro M(Q) #declare Q=1 #end #declare R=2; M(R) sphere{0,1}",
            "#macro M(Q) #declare Q=1 #end #declare R=2; M(R);;;",
            "#declare F=function(a){a} #macro M() #declare G=F #end M() sphere{0,1}",
            "#declare F=function(a){a} #declare G=F sphere{0,1}",
        ],
    );
}
