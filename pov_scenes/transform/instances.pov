// One declared union stands in many places, each with its own transform.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Tree = union {
  cylinder { -0.5*y, 0, 0.08 pigment { rgb <0.5, 0.3, 0.1> } }
  cone { -0.2*y, 0.3, 0.6*y, 0 pigment { rgb <0.1, 0.5, 0.2> } }
};
#for (I, 0, 24)
  object { Tree scale 0.6 + 0.05*mod(I, 5) rotate 20*I*y translate <mod(I, 5)*0.9 - 1.8, -0.5, div(I, 5)*0.9 - 2> }
#end
