// no_shadow, no_image and no_reflection of the parts of combinations: some count, most do not.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -11> look_at <0, 0, 0> angle 45 }
light_source { <4, 9, -5> rgb 1 }
background { rgb 0.3 }
plane { y, -1.2 pigment { rgb 0.8 } finish { reflection 0.4 } }
#declare Red = pigment { rgb <0.8, 0.3, 0.2> }
#declare Blue = pigment { rgb <0.2, 0.4, 0.9> }
#declare Ball = sphere { 0, 0.8 pigment { Red } }
#declare Block = box { <0, 0, -1>, 1 pigment { Blue } }
difference { object { Ball no_shadow } object { Block } translate <-4, 0, 2> }
difference { object { Ball no_image } object { Block } translate <-2, 0, 2> }
difference { object { Ball } object { Block no_image } translate <0, 0, 2> }
intersection { object { Ball no_reflection } object { Block } translate <2, 0, 2> }
merge { object { Ball no_image } object { Block translate <0.8, 0, 0> } translate <4, 0, 2> }
merge { object { Ball no_shadow } object { Block } translate <-4, 0, -0.5> }
merge { difference { object { Ball } object { Block } no_reflection } sphere { y, 0.4 pigment { Blue } } translate <-2, 0, -0.5> }
union { object { Ball no_image } object { Block } bounded_by { sphere { 0, 2 } } translate <0, 0, -0.5> }
union { object { Ball no_reflection } object { Block } clipped_by { sphere { 0, 2 } } translate <2, 0, -0.5> }
difference { union { object { Ball } sphere { x, 0.6 pigment { Red } } no_reflection } object { Block } translate <4, 0, -0.5> }
difference { object { Ball } object { Block } no_image translate <-1, 0, -3> }
union { object { Ball no_image } object { Block } translate <1, 0, -3> }
