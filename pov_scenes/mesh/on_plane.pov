// A clear mesh and clear triangles that stand on a plane, turned: roundings decide what shows through them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 2.3, -4.4> look_at 0.2*y angle 42 }
light_source { <20, 40, -30>, 1 }
background { rgb <0.4, 0.5, 0.7> }
plane { y, 0 pigment { checker rgb <1, 1, 0.6>, rgb <0.3, 0.3, 0.6> scale 0.31 } }
#declare Clear = pigment { rgbf <0.8, 1, 0.9, 0.8> }
#macro Sides()
  triangle { <-1, 0, -0.7>, <-1, 0, 0.5>, <-1, 0.6, 0.5> } triangle { <-1, 0, -0.7>, <-1, 0.6, 0.5>, <-1, 0.6, -0.7> }
  triangle { <0.5, 0, -0.7>, <0.5, 0, 0.5>, <0.5, 0.6, 0.5> } triangle { <0.5, 0, -0.7>, <0.5, 0.6, 0.5>, <0.5, 0.6, -0.7> }
  triangle { <-1, 0, -0.7>, <-1, 0, 0.5>, <0.5, 0, 0.5> } triangle { <-1, 0, -0.7>, <0.5, 0, 0.5>, <0.5, 0, -0.7> }
  triangle { <-1, 0.6, -0.7>, <-1, 0.6, 0.5>, <0.5, 0.6, 0.5> } triangle { <-1, 0.6, -0.7>, <0.5, 0.6, 0.5>, <0.5, 0.6, -0.7> }
  triangle { <-1, 0, -0.7>, <-1, 0.6, -0.7>, <0.5, 0.6, -0.7> } triangle { <-1, 0, -0.7>, <0.5, 0.6, -0.7>, <0.5, 0, -0.7> }
  triangle { <-1, 0, 0.5>, <-1, 0.6, 0.5>, <0.5, 0.6, 0.5> } triangle { <-1, 0, 0.5>, <0.5, 0.6, 0.5>, <0.5, 0, 0.5> }
#end
mesh { Sides() rotate 20*y translate <-0.5, 0, 0.2> pigment { Clear } }
union { Sides() rotate -35*y scale 0.8 translate <1.3, 0, 0> pigment { Clear } }
