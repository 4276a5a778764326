// Two meshes stand on one plane far away, and rays still see both faces of a thin clear box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -1000> look_at <0, 1, 0> angle 0.15 }
background { rgb 1 }
box { <-1, 0.5, 0>, <1, 1.5, 0.0005> pigment { rgbt <0, 0, 0, 0.5> } finish { ambient 0 diffuse 0 } }
mesh { triangle { <50, 0, 0>, <50, 1, 0>, <51, 0, 1> } pigment { rgb 1 } }
mesh { triangle { <60, 0, 0>, <60, 1, 0>, <61, 0, 1> } pigment { rgb 1 } }
