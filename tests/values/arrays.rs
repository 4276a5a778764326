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
