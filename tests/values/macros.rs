//! Macros and their arguments.

use crate::{agree, refused};

#[test]
fn arguments() {
    agree(
        "macros/arguments",
        &[
            r#"#macro M(A B) #debug concat("= ",str(A,0,0),str(B,0,0),"\n") #end M(1 2)"#,
            r#"#macro M(A,) #debug concat("= ",str(A,0,0),"\n") #end M(1)"#,
            r#"#macro M(A) #debug concat("= ",A,"\n") #end M("x") M(concat("a","b"))"#,
            r#"#macro M(A) object{A} #end M(sphere{0,1}) 
#macro N(T) sphere{0,1 texture{T}} #end N(texture{pigment{rgb 1}}) N(texture{pigment{rgb 1}} texture{pigment{rgbt 1}})
#debug "= ok\n""#,
            r#"#macro M(A) sphere{0,1 pigment{A}} #end M(color rgb 1) M(rgb 1) M(rgbt <1,0,0,.5>)  M(color red 1 green .5)
#debug "= ok\n""#,
            r#"#macro M(A) #declare C=A; #debug concat("= ",vstr(5,C,",",0,2),"\n") #end M(color rgb 1) M(rgbt <1,0,0,.5>)  M(color red 1 green .5) M(red 1) M(<1,2,3>)"#,
        ],
    );
}

#[test]
fn arguments_refused() {
    refused(
        "macros/arguments_refused",
        &[
            r#"#macro M(A,B) #debug concat("= ",str(A,0,0),str(B,0,0),"\n") #end M(1 2) M(1,2) M(1,,2)"#,
            r#"#macro M(A,B) #end M(1)"#,
            r#"#macro M(A) #end M(1,2)"#,
        ],
    );
}

#[test]
fn definitions() {
    agree(
        "macros/definitions",
        &[
            r#"#macro A() 1 #end #macro A() 2 #end #debug concat("= ",str(A(),0,0),"\n")"#,
            r#"#macro Outer() #macro Inner() 5 #end #end Outer() #debug concat("= ",str(Inner(),0,0),"\n")"#,
        ],
    );
}

#[test]
fn macros_are_text() {
    agree(
        "macros/macros_are_text",
        &[
            r#"#macro F() 1+2 #end #debug concat("= ",str(F()*2,0,0)," ",str(2*F(),0,0),"\n")"#,
            r#"#macro F() 0, 1 #end sphere{F()} #declare A=<F(),3>; #debug concat("= ",vstr(3,A,",",0,0),"\n")"#,
            r#"#macro F() "1","2" #end #debug concat("= ","R",F(),"\n")"#,
            r#"#macro F() 3,4 #end #macro G(A,B) #debug concat("= ",str(A,0,0),str(B,0,0),"\n") #end G(F())"#,
            r#"#macro O() sphere { 0, #end O() 1 } #debug "= ok\n""#,
            r#"#macro P() ( #end #declare A=P() 1+2)*3; #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro F(A) A #end #declare B=F (3); #debug concat("= ",str(B,0,0),"\n")"#,
            r#"#declare P=<0,1,0>; #declare R=2; sphere{P (R+1)} #debug "= ok\n""#,
        ],
    );
}

#[test]
fn macros_are_text_refused() {
    refused(
        "macros/macros_are_text_refused",
        &[r#"#macro F() 1 #end #declare A=F;"#, r#"#macro F #end"#],
    );
}

/// The macro may be left only after the `;`, or after the directives that follow the value.
#[test]
fn a_value_that_ends_in_a_macro_belongs_to_the_name_outside() {
    agree(
        "macros/values_that_end_inside",
        &[
            r#"#macro In() 5; #end #macro Out() #local B = In() #debug concat("= ",str(B,0,0),"\n") #end Out()"#,
            r#"#macro In() #local B=3; 5; #end #macro Out() #local B = In() #debug concat("= ",str(B,0,0),"\n") #end Out()"#,
            r#"#macro In() #local A=3; 5; #end #declare A = In() #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#declare A=1; #macro In() #local A=3; 5; #end #declare A = In() #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro N() #declare A = In() #end #macro In() #local A=3; 5; #end
#macro M() #local A=2; N() #debug concat("= ",str(A,0,0),"\n") #end M()"#,
            r#"#macro In() #local A=3; A+2; #debug concat("= in ",str(A,0,0),"\n") #end #declare A = In() #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro In() #local A=3; #declare A=4; A+2; #debug concat("= in ",str(A,0,0),"\n") #end
#macro Out() #local A = In() #debug concat("= ",str(A,0,0),"\n") #end Out()"#,
            r#"#macro In() transform{translate x} #end #macro Out() #local A = In() sphere{0,1 transform A} #end Out() #debug "= ok\n""#,
            r#"#macro Deep(P) P+1; #declare P=9; #debug concat("= P ",str(P,0,0),"\n") #end
#macro In() #local A=3; Deep(A) #debug concat("= in ",str(A,0,0),"\n") #end
#declare A = In() #debug concat("= ",str(A,0,0),"\n")"#,
            r#"#macro S(T) sphere { 0, 1 texture { T } } #end
#declare T = texture { pigment { rgb 1 } }
S(T)
#debug "= ok\n""#,
        ],
    );
}

/// The declaration still looks for its `;` there.
#[test]
fn arguments_behind_a_declaration_without_a_semicolon() {
    agree(
        "macros/arguments_behind_a_declaration_without_a_semicolon",
        &[
            r#"#macro Half(A) #local B=A/2; B #end #macro M(A,B) #debug concat("= ",str(A+B,0,2),"\n") #end
#declare T=texture{pigment{rgb x}} M(Half(3),1)
#declare T=sphere{0,1} M(1,Half(Half(3)))
#declare T="a" M(Half(1),Half(2))
#declare T=array[2]{1,2} M(Half(T[0]),Half(T[1]))
#declare F=function(a){a} M(F(Half(1)),2)"#,
            r#"#macro M(A) #debug concat("= ",str(A,0,2),"\n") #end #declare T=texture{pigment{rgb x}} M(#local Q=3; Q) M(#declare R=2; Q+R)"#,
            r#"#macro Is(A) #local B=A; B #end #declare T=texture{pigment{rgb x}} #if(Is(1)) #debug "= yes\n" #end"#,
            r#"#macro Is(A) #local B=A; B #end #declare T=finish{ambient 1} #while(Is(1)) #debug "= yes\n" #break #end"#,
            r#"#macro T1() texture{pigment{rgb x}} #end #macro M(A) #local B=A; #ifdef(T) #debug "= yes\n" #end #end #declare T=texture{pigment{rgb y}} M(T1())"#,
        ],
    );
}

/// Before 3.5 a number needs no `;`, and has its value when a macro after it is called.
#[test]
fn calls_behind_a_number_of_before_3_5() {
    agree(
        "macros/calls_behind_a_number_of_before_3_5",
        &[
            r#"#version 3.1; #macro Twice(Of, Into) #declare Into = 2*Of #end #declare Other = 0;
#declare Size = 5
Twice(Size, Size)
#declare Size = Size + 1
Twice(Size + 1, Other)
#debug concat("= ",str(Size,0,1)," ",str(Other,0,1),"\n")"#,
            r#"#version 3.1; #macro M(A) #debug concat("= ",str(vlength(A*x),0,6),"\n") #end
#declare B=.5
M(B)
#declare C=sin(1)
M(C)
#declare D=<1,2,3>
M(D)
#declare E=D.y
M(E)
#declare F=(C<1?B:2)
M(F)
#declare G=array[2]
#declare G[1]=-3
M(G[1])"#,
            r#"#version 3.1; #macro M(A) #debug concat("= ",vstr(3,A*<1,1,1>,",",0,3),"\n") #end
#declare B=color red 1 green .5
M(B.red)
#declare C=rgb <1,.5,0>
M(C.green)
#declare D=C
M(D.green)"#,
        ],
    );
}

#[test]
fn calls_behind_a_number_of_before_3_5_refused() {
    refused(
        "macros/calls_behind_a_number_of_before_3_5_refused",
        &["#version 3.1; #macro Plus(A) +A #end\n#declare B=1 Plus(2)"],
    );
}
