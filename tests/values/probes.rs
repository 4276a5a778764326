//! Ray and point queries on objects while the scene is read: `trace`, `inside`.

use crate::{agree, refused};

#[test]
fn rays_find_surfaces_and_normals() {
    agree(
        "probes/rays_find_surfaces_and_normals",
        &[
            r#"#macro T(S,O,A,B) #local N=<7,7,7>; #local P=trace(O,A,B,N); #debug concat("= ",S," ",vstr(3,P,",",0,6)," n ",vstr(3,N,",",0,6),"\n") #end
#declare S=sphere{0,1};
T("hit",S,<0,0,-3>,z)
T("long dir",S,<0,0,-3>,z*10)
T("short dir",S,<0,0,-3>,z*1e-3)
T("miss",S,<0,3,-3>,z)
T("inside",S,<0,0,0>,z)
T("on",S,<0,0,-1>,z)
T("on-1e-5",S,<0,0,-1-1e-5>,z)
T("on-5e-5",S,<0,0,-1-5e-5>,z)
T("on-1.1e-4",S,<0,0,-1-1.1e-4>,z)
T("on-1e-3",S,<0,0,-1-1e-3>,z)
T("exit",S,<0,0,1-5e-5>,z)
T("exit2",S,<0,0,1-2e-4>,z)
#declare S=object{S inverse}
T("inv",S,<0,0,-3>,z)
#declare S=object{sphere{0,1} scale <1,2,3> rotate 30*x translate 5}
T("moved",S,<5,5,-3>,<0.1,0.2,1>)
#declare D=difference{box{-1,1} sphere{<0,0,-1>,0.5}}
T("diff",D,<0.1,0,-3>,z)
T("diff2",D,<0.7,0,-3>,z)
#declare I=intersection{box{-1,1} sphere{<0,0,-1>,0.5}}
T("isect",I,<0.1,0,-3>,z)
#declare M=merge{box{-1,1} sphere{<0,0,-1>,0.5}}
T("merge",M,<0.1,0,-3>,z)
T("merge",M,<0.1,0,-0.9>,z)
#declare U=union{box{-1,1} sphere{<0,0,-1>,0.5}}
T("union in",U,<0.1,0,-0.9>,z)
#declare P=plane{y,1}
T("plane",P,<0.1,3,-0.9>,-y)
T("plane below",P,<0.1,-3,-0.9>,y)
#declare B=box{-1,1}
T("box",B,<0.1,0.2,-3>,z)
T("box on",B,<0.1,0.2,-1>,z)
T("box edge",B,<1,0.2,-3>,z)
#declare Tr=triangle{0,x,y}
T("tri front",Tr,<0.1,0.2,-3>,z)
T("tri back",Tr,<0.1,0.2,3>,-z)
T("tri on",Tr,<0.1,0.2,0>,-z)
#declare Sm=smooth_triangle{0,<0,0,-1>,x,<1,0,-1>,y,<0,1,-1>}
T("smooth",Sm,<0.1,0.2,-3>,z)
T("smooth back",Sm,<0.1,0.2,3>,-z)
#declare Me=mesh{smooth_triangle{0,<0,0,-1>,x,<1,0,-1>,y,<0,1,-1>}}
T("mesh",Me,<0.1,0.2,-3>,z)
T("mesh back",Me,<0.1,0.2,3>,-z)
#declare Me=mesh{triangle{0,x,y}}
T("mesh flat",Me,<0.1,0.2,-3>,z)
T("mesh back",Me,<0.1,0.2,3>,-z)
#declare Di=disc{0,z,1}
T("disc",Di,<0.1,0.2,-3>,z)
T("disc back",Di,<0.1,0.2,3>,-z)
#declare C=cylinder{0,y,1}
T("cyl",C,<0.1,0.2,-3>,z)
T("cyl cap",C,<0.1,3,0>,-y)
#declare C=cylinder{0,y,1 open}
T("cyl open",C,<0.1,3,0>,-y)
#declare C=cone{0,1,y,0}
T("cone",C,<0.1,0.2,-3>,z)
#declare C=torus{1,0.25}
T("torus",C,<0.1,0.1,-3>,z)
#declare S=sphere{0,1 no_image no_shadow}
T("no_image",S,<0,0,-3>,z)
#declare S=sphere{0,1 clipped_by{plane{z,0 inverse}}}
T("clipped",S,<0,0,-3>,z)
T("zero dir",B,<0.5,0,-3>,<0,0,0>)
#declare U=union{light_source{0,1} sphere{0,1}}
T("light",U,<0,0,-3>,z)"#,
            r#"#macro T(S,O,A,B) #local N=<7,7,7>; #local P=trace(O,A,B,N); #debug concat("= ",S," ",vstr(3,P,",",0,3)," n ",vstr(3,N,",",0,3),"\n") #end
#declare S=box{-1,1 inverse} T("box",S,<0.1,0.2,-3>,z)
#declare S=cylinder{0,y,1 inverse} T("cyl",S,<0.1,0.2,-3>,z) T("cyl",S,<0.1,3,0>,-y)
#declare S=cone{0,1,y,0 inverse} T("cone",S,<0.1,0.2,-3>,z)
#declare S=plane{y,0 inverse} T("plane",S,<0.1,0.2,-3>,-y)
#declare S=torus{1,.25 inverse} T("torus",S,<0.1,0.1,-3>,z)
#declare S=disc{0,y,1 inverse} T("disc",S,<0.1,0.2,.1>,-y)
#declare S=triangle{0,x,y inverse} T("tri",S,<0.1,0.2,-3>,z)
#declare S=mesh{triangle{0,x,y} inverse} T("mesh",S,<0.1,0.2,-3>,z)
#declare S=smooth_triangle{0,<0,0,-1>,x,<1,0,-1>,y,<0,1,-1> inverse} T("smooth",S,<0.1,0.2,-3>,z)
#declare S=union{box{-1,1} sphere{2*y,.5} inverse} T("union",S,<0.1,0.2,-3>,z) T("union",S,<0.1,2.2,-3>,z)
#declare S=difference{box{-1,1} union{sphere{0,.5} box{-.2,<.2,.2,-2>}}} T("diff",S,<0.1,0.1,-.1>,z) T("diff",S,<0.1,0.1,-.1>,x) T("diff",S,<0.1,0.1,-.7>,x) T("diff",S,<0.1,0.1,-4>,z)
#declare S=difference{box{-1,1} difference{sphere{0,.5} box{0,1}}} T("diff",S,<0.1,0.1,-.1>,z) T("diff",S,<0.1,0.1,-.1>,x) T("diff",S,<0.1,0.1,-.7>,x) T("diff",S,<0.1,0.1,-4>,z)
#declare S=difference{box{-1,1 clipped_by{sphere{0,1.1}}} box{0,3}} T("cl",S,<0.1,0.1,-4>,z)
#declare S=object{difference{box{-1,1} sphere{-z,.5}} scale <1,1,-1>} T("mir",S,<0.1,0.1,4>,-z)
#declare S=object{box{-1,1} scale <1,1,-1>} T("mir",S,<0.1,0.1,4>,-z)
#declare S=object{mesh{triangle{0,x,y}} scale <1,1,-2>} T("mir",S,<0.1,0.1,4>,-z)
#declare S=object{triangle{0,x,y} scale <1,-1,-2>} T("mir",S,<0.1,-0.1,4>,-z)
#declare S=object{smooth_triangle{0,<0,0,-1>,x,<1,0,-1>,y,<0,1,-1>} scale <1,-1,1>} T("mir",S,<0.1,-0.1,4>,-z)"#,
            r#"#declare N=array[3]{x,y,z}
#declare S=sphere{0,1}
#declare P=trace(S,<0,0,-3>,z,N[0]);
#debug concat("= ",vstr(3,N[0],",",0,3),"\n")"#,
            r#"#declare O=array[3]{sphere{0,1},sphere{0,2},sphere{0,3}}
#debug concat("= ",vstr(3,trace(O[1],-5*z,z),",",0,3),"\n")
#debug concat("= ",vstr(3,min_extent(O[1]),",",0,3),"\n")
#debug concat("= ",str(inside(O[1],1.1),0,3),"\n")"#,
        ],
    );
}

#[test]
fn rays_find_surfaces_and_normals_refused() {
    refused(
        "probes/rays_find_surfaces_and_normals_refused",
        &[r#"#declare S=sphere{0,1}
#declare P=trace(S,<0,0,-3>,z);
#debug concat("= ",vstr(3,P,",",0,3),"\n")
#debug concat("= ",vstr(3,trace(S,<0,0,-3> z),",",0,3),"\n")
#declare P=trace(sphere{0,1},<0,0,-3>,z);"#],
    );
}

#[test]
fn trace_needs_an_object_and_a_vector() {
    refused(
        "probes/trace_needs_an_object_and_a_vector_refused",
        &[
            r#"#declare S=sphere{0,1}
#declare P=trace(S,<0,0,-3>,z,N);"#,
            r#"#declare N=0;
#declare S=sphere{0,1}
#declare P=trace(S,<0,0,-3>,z,N);
#debug concat("= ",vstr(3,N,",",0,3),"\n")"#,
        ],
    );
}

#[test]
fn points_are_inside_of_solids() {
    agree(
        "probes/points_are_inside_of_solids",
        &[
            r#"#declare S=sphere{0,1}
#macro I(S,O,P) #debug concat("= ",S," ",str(inside(O,P),0,0),"\n") #end
I("in",S,0)
I("out",S,2)
I("on",S,x)
I("on-",S,x*(1-1e-7))
#declare B=box{-1,1} I("box on",B,x) I("box on",B,x*(1+1e-7)) I("box in",B,x*(1-1e-7))
#declare B=box{-1,1 inverse} I("inv",B,x*2)
#declare C=cylinder{0,y,1} I("cyl",C,y/2) I("cyl cap",C,y) I("side",C,x+y/2)
#declare C=cylinder{0,y,1 open} I("cyl open",C,y/2)
#declare P=plane{y,0} I("plane",P,-y) I("plane",P,y)  I("plane",P,0)
#declare D=difference{box{-1,1} sphere{0,0.5}} I("diff",D,0) I("diff",D,0.9)

#declare S=sphere{0,1 clipped_by{plane{z,0}}} I("clip",S,z/2) I("clip",S,-z/2)
#declare S=sphere{0,1 bounded_by{box{-0.1,0.1}}} I("bound",S,z/2) 

#declare S=object{sphere{0,1} rotate 30*x translate 5 scale 2} I("moved",S,10)"#,
            r#"#declare S=disc{0,y,1} #debug concat("= ",str(inside(S,-y),0,0),"\n")"#,
        ],
    );
}

#[test]
fn patches_have_no_inside() {
    agree(
        "probes/patches_have_no_inside",
        &[
            r#"#declare S=union{ sphere{0,1} union{sphere{0,1} plane{y,-3}}} #debug concat("= ",str(inside(S,-y*4),0,0),"\n")"#,
        ],
    );
}

#[test]
fn patches_have_no_inside_refused() {
    refused(
        "probes/patches_have_no_inside_refused",
        &[
            r#"#declare S=triangle{0,x,y} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=mesh{triangle{0,x,y}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=union{triangle{0,x,y} disc{0,y,1}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=difference{sphere{0,1} mesh{triangle{0,x,y}}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=light_source{0,1} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=bicubic_patch{type 0 <0,0,0><1,0,0><2,0,0><3,0,0><0,1,0><1,1,0><2,1,0><3,1,0><0,2,0><1,2,0><2,2,0><3,2,0><0,3,0><1,3,0><2,3,0><3,3,0>} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=merge{sphere{0,1} mesh{triangle{0,x,y}}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=merge{sphere{0,1} union{ triangle{0,x,y} triangle{0,x,z}}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=3; #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
            r#"#declare S=union{light_source{0,1} sphere{0,1}} #debug concat("= ",str(inside(S,0),0,0),"\n")"#,
        ],
    );
}
