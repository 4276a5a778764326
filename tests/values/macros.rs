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

/// The macro may be left only behind the `;`, or behind the directives that follow the value.
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
