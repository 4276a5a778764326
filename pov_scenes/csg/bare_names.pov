// Behind the first part of a combination names stand for objects without `object { }`: of shapes, combinations, items of arrays, macros and their parameters.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -9> look_at 0 angle 45 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Ball = sphere { 0, 0.8 pigment { rgb <0.9, 0.3, 0.2> } }
#declare Rod = cylinder { -1.2*y, 1.2*y, 0.25 }
#declare Cross = union { object { Rod } Rod rotate 90*z pigment { rgb <0.3, 0.3, 0.9> } }
#declare Knobs = array[2] { sphere { x, 0.4 }, sphere { -x, 0.4 pigment { rgb <0.9, 0.8, 0.2> } } }
#macro Cube(Size) #local Made = box { -Size, Size } Made #end
#macro Same(Thing) Thing #end
difference { box { -0.7, 0.7 pigment { rgb <0.2, 0.8, 0.3> } } Ball Cross box { <0, 0, -1>, 1 } rotate <20, 30, 0> translate <-2.2, 1.2, 0> }
intersection { object { Ball scale 1.1 } Cube(0.7) Same(Cross) rotate <20, 30, 0> translate <0, 1.2, 0> }
merge { sphere { 0, 0.6 } Knobs[0] Same(Knobs[1]) Rod pigment { rgb <0.6, 0.9, 0.9> } rotate <20, 30, 20> translate <2.2, 1.2, 0> }
union { torus { 0.7, 0.2 } #for (I, 0, 1) Knobs[I] #end Cross pigment { rgb 0.9 } rotate <-50, 0, 20> translate <-2.2, -1.2, 0> }
union { Cross scale 0.8 rotate 30*y translate -1.2*y }
union { difference { object { Cube(0.6) } Ball } intersection { box { -0.5, 0.5 } Ball Rod } rotate <20, 30, 0> translate <2.2, -1.2, 0> pigment { rgb <0.9, 0.6, 0.8> } }
