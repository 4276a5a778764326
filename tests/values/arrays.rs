//! Arrays, arrays of arrays, and their items as macro arguments.

use crate::{agree, refused};

#[test]
fn items_of_all_kinds() {
    agree(
        "arrays/items_of_all_kinds",
        &[
            r#"#declare A=array[2][3]{{1,2,3},{4,5,6}}
#declare B=A;
#declare B[0][1]=99;
#debug concat("= ",str(A[0][1],0,0)," ",str(B[0][1],0,0)," ",str(dimensions(A),0,0)," ",str(dimension_size(A,1),0,0)," ",str(dimension_size(A,2),0,0),"\n")
#declare C=array[2]{array[2]{1,2},array[2]{3,4}}
#debug concat("= ",str(C[1][0],0,0),"\n")"#,
            r#"#declare C=array[2];
#declare C[0]=array[2]{1,2}
#declare C[1]=array[3]{1,2,5}
#declare D=C[1];
#debug concat("= ",str(D[2],0,0),"\n")
#debug concat("= ",str(C[1][2],0,0),"\n")"#,
            r#"#declare C=array[2];
#declare C[0]=array[2]{1,2}
#declare C[0][1]=7;
#debug concat("= ",str(C[0][1],0,0),"\n")"#,
            r#"#declare A=array[2][2][2][2][2];
#declare A[1][1][1][1][1]=3;
#debug concat("= ",str(A[1][1][1][1][1],0,0),"\n")"#,
            r#"#declare B=array[2]{array[2]{1,2},array[2]{3,4}}
#declare B[1]=array[2]{8,9}
#debug concat("= ",str(B[1][0],0,0)," ",str(dimension_size(B,1),0,0)," ",str(dimensions(B),0,0),"\n")
#debug concat("= ",str(dimension_size(B[1],1),0,0),"\n")"#,
        ],
    );
}

#[test]
fn items_that_begin_an_object() {
    agree(
        "arrays/items_that_begin_an_object",
        &[
            r#"#declare Q = array[2] { <1, 2, 3>, <2, 2, 5> } #declare S = seed(1); #declare T = seed(1);
#declare A = sphere { Q[1], 0.5 }
#debug concat("= ", vstr(3, min_extent(A), " ", 0, 3), "\n")
#declare A = cylinder { Q[0] + x, Q[1], 1 }
#declare A = box { Q[rand(S)*2], Q[0] + 9 }
#debug concat("= ", vstr(3, min_extent(A), " ", 0, 3), " ", str(rand(S), 0, 6), "\n")
#declare O = array[1] { sphere { z, 2 } }
#declare A = sphere { O[0] translate x }
#debug concat("= ", vstr(3, min_extent(A), " ", 0, 3), "\n")"#,
        ],
    );
}

#[test]
fn macros_in_indices_run_once() {
    let begin = r#"#declare K = -1;
#macro N() #declare K = K + 1; K #end
#macro R() #declare K = K + 1; 1] #end
#declare S = seed(1);
#declare T = seed(1);
#declare A = array[4] { 3, 4, 5, 6 }
#declare V = array[3] { x, y, z }
#macro P(X) #debug concat("= ", str(X, 0, 0), " ") #end
"#;
    let scene = |text: &str| {
        let end = r#"#debug concat("= ", str(K, 0, 0), " ", str(rand(S), 0, 6), "\n")"#;
        format!("{begin}{text}\n{end}")
    };
    let scenes = [
        "P(A[N()])",
        "P(A[N()] + 1)",
        "P(A[N()] * A[N()])",
        "P(A[R() + 1)",
        "P(A[#declare K = K + 2; K] + 1)",
        "P(A[rand(S) * 3] + 1)",
        "#declare B = sphere { V[N()], 1 } #debug concat(\"= \", vstr(3, min_extent(B), \" \", 0, 3), \"\\n\")",
        "#declare B = box { V[N()], V[N()] + 2 } #debug concat(\"= \", vstr(3, max_extent(B), \" \", 0, 3), \"\\n\")",
        "#declare B = array[2]; #declare B[1] = 7; P(B[N() + 1] + 1)",
        "#declare B = array[2]; #declare B[1] = 7; #declare C = B[N() + 1] * 2; P(C)",
    ]
    .map(scene);
    agree(
        "arrays/macros_in_indices_run_once",
        &scenes.each_ref().map(String::as_str),
    );
}

#[test]
fn indices() {
    refused(
        "arrays/indices_refused",
        &[
            r#"#declare A=array[3]{1,2,3,4}"#,
            r#"#declare A=array[2]{1,2}
#declare A[0.9]=5;
#debug concat("= ",str(A[0],0,0),str(A[0.5+0.5],0,0),str(A[1.99],0,0),"\n")
#debug concat("= ",str(A[2],0,0),"\n")"#,
            r#"#declare A=array[2]{1,2}
#debug concat("= ",str(A[-1],0,0),"\n")"#,
            r#"#declare A=array[0];
#debug "= zero\n""#,
        ],
    );
}

#[test]
fn items_by_reference() {
    agree(
        "arrays/items_by_reference",
        &[
            r#"#declare A=array[2]{1,2}
#local A[0]=3;
#macro M(P) #declare P[1]=7; #local P[0]=8; #end
M(A)
#debug concat("= ",str(A[0],0,0),str(A[1],0,0),"\n")
#macro N() #declare A[0]=9; #local A[1]=10; #end
N()
#debug concat("= ",str(A[0],0,0),str(A[1],0,0),"\n")
#macro Q(X) #declare X=55; #end
Q(A[1])
#debug concat("= ",str(A[1],0,0),"\n")"#,
            r#"#macro N() #declare A[0]=9; #local A[1]=10; #debug concat("= in ",str(A[0],0,0),str(A[1],0,0),"\n") #end
#declare A=array[2]{1,2}
N()
#debug concat("= ",str(A[0],0,0),str(A[1],0,0),"\n")"#,
            r#"#macro Q(X) #declare A[1]=3; #debug concat("= ",str(X,0,0),"\n") #local X=5; #debug concat("= ",str(A[1],0,0),"\n") #end
#declare A=array[2]{1,2}
Q(A[1])
#debug concat("= ",str(A[1],0,0),"\n")
#declare B=array[2]{array[2]{1,2},array[2]{3,4}}
#macro R(X) #declare X[0]=77; #end
R(B[1])
#debug concat("= ",str(B[1][0],0,0),"\n")"#,
        ],
    );
}

#[test]
fn items_by_reference_refused() {
    refused(
        "arrays/items_by_reference_refused",
        &[
            r#"#macro Q(X) #debug concat("= ",str(defined(X),0,0),"\n") #declare X=55; #end
#declare A=array[2];
Q(A[1])
#debug concat("= ",str(A[1],0,0),"\n")"#,
        ],
    );
}

#[test]
fn functions_as_items() {
    agree(
        "arrays/functions_as_items",
        &[
            r#"#declare A=array[2]; #declare A[0]=function(a){a*2} #declare A[1]=A[0]; #declare F=A[1]; #local G=A[0];
#debug concat("= ",str(F(1)+G(2)+A[1](3),0,1),"\n")"#,
            r#"#declare F=function(a){a} #declare A=array[1]{F} #declare B=array[2][2]{{A[0],F},{F,A[0]}} #declare G=B[1][1];
#debug concat("= ",str(G(1)+B[0][0](2),0,1),"\n")"#,
            r#"#declare F=function(a){a} #declare A=array[2]{F,F} #declare S=seed(1); #declare G=A[int(rand(S)*2)]; #declare H=A[F(1)];
#debug concat("= ",str(G(rand(S))+H(1),0,6),"\n")"#,
            r#"#declare A=array[2]; #declare A[0]=spline{0,x 1,2*x} #declare A[1]=A[0]; #declare B=array[1]{A[1]} #declare G=B[0];
#debug concat("= ",str(G(.2).x,0,6),"\n")"#,
            r#"#declare F=function(a){a} #declare A=array[1]{F} #declare G=1; #declare G=A[0]; #declare H=sphere{0,1} #declare H=F; #debug concat("= ",str(G(1)+H(2),0,1),"\n")"#,
            r#"#declare A=array[1]{function{pigment{gradient x}}} #declare G=A[0]; #debug concat("= ",str(G(.2,0,0).red,0,6),"\n")"#,
            r#"#declare A=array[4]; #declare B=array[4]; #for(I,0,3) #declare A[I]=function(a){a*I} #declare B[I]=A[I]; #end
#debug concat("= ",str(B[3](2)+B[1](5),0,1),"\n")"#,
            r#"#declare A=array[2]; #declare A[0]=function(a){a*2} #macro G(I) A[I] #end #declare F=G(0);
#macro M(X,Y) #declare Y[1]=X[0]; #end M(A,A) #debug concat("= ",str(F(1)+A[1](1),0,1),"\n")"#,
            r#"#declare F=function(a){a} #declare A=array[2]{F,F} #macro M(Q,P) #debug concat("= ",str(Q(P),0,1),"\n") #end M(A[0],1) M(A[1] 2)"#,
            r#"#declare F=function(a){a} #declare A=array[1]{F} #declare N=A[0](3)+1; #version 3.1; #declare G=A[0] sphere{0,1} #debug concat("= ",str(N+G(1),0,1),"\n")"#,
        ],
    );
}

#[test]
fn functions_as_items_refused() {
    refused(
        "arrays/functions_as_items_refused",
        &[
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=A[0]*2;",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=A[0]; #declare G=A[0];",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=(A[0]);",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=function{A[0]}",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=A[0] sphere{0,1}",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=A[0], sphere{0,1}",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=A[0] #if(1) ; #end",
            "#declare F=function(a){a} #declare A=array[1]{F} #declare G=(1?A[0]:A[0]);",
            "#declare F=function(a){a} #declare A=array[2]; #declare A[0]=F; #declare G=A[1];",
            "#declare F=function(a){a} #declare A=array[2]; #declare A[0]=F; #declare A[1]=2;",
        ],
    );
}
