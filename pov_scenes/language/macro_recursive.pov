// A macro that calls itself draws a tree.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at <0, 0.5, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Branch(Depth, Size)
  cone { 0, Size*0.1, Size*y, Size*0.07 }
  #if (Depth > 0)
    union { Branch(Depth - 1, Size*0.72) rotate 32*z rotate 40*y translate Size*y }
    union { Branch(Depth - 1, Size*0.66) rotate -36*z rotate 65*y translate Size*y }
  #end
#end
union { Branch(6, 0.8) translate -y pigment { rgb <0.6, 0.45, 0.25> } }
