// Names stand anywhere in a light group, also first, and one name alone is a group: none of the other lights shines on it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -10> look_at <0, 0.3, 0> angle 42 }
light_source { <-5, 6, -4>, rgb <0.7, 0.8, 1> }
plane { y, -1 pigment { rgb <0.8, 0.7, 0.6> } }
#declare Ring = torus { 0.7, 0.25 pigment { rgb <0.9, 0.4, 0.3> } }
#declare Ball = sphere { 0, 0.5 pigment { rgb <0.4, 0.9, 0.3> } }
#declare Red = light_source { <4, 7, -5>, rgb <1, 0.5, 0.5> }
#declare Balls = array[2] { sphere { 0.6*x, 0.4 pigment { rgb 1 } }, sphere { -0.6*x, 0.4 pigment { rgb 1 } } }
light_group { Ring translate -2.6*x }
light_group { Ring Ball global_lights on translate <-1, 0.2, 1.5> }
light_group { Ball box { <0.4, -0.5, -0.3>, <0.9, 0.7, 0.3> pigment { rgb <0.3, 0.6, 0.9> } } Red rotate 20*y translate 0.2*x }
#declare Group = light_group { Red #for (I, 0, 1) Balls[I] #end }
object { Group rotate -50*y translate 2.4*x }
light_group { Group Ball global_lights off translate <2, 0.3, 2.5> }
union { sphere { <-1.2, -0.6, -1.5>, 0.4 pigment { rgb 1 } } light_group { Ball translate <0, -0.6, -1.5> } Group translate <1, 0, -1> scale 0.8 }
