// Small combinations with planes, half of them clipped, a few of parts joined before they are cut.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.6 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare R = seed(5);
#for (I, 0, 29)
  #declare Where = <mod(I, 6) - 2.5, div(I, 6)*0.7 - 1.4, 0>;
  #switch (mod(I, 5))
    #case (0) intersection { sphere { 0, 0.35 } plane { y, 0.1 } #break
    #case (1) difference { sphere { 0, 0.35 } sphere { 0, 0.3 } plane { -y, -0.1 } #break
    #case (2) sphere { 0, 0.35 clipped_by { plane { y, 0.1 } } #break
    #case (3) merge { box { -0.25, 0.25 } cylinder { -0.4*x, 0.4*x, 0.15 } #break
    #else difference { union { box { -0.25, 0.25 } sphere { 0, 0.3 } } merge { cylinder { -x, x, 0.1 } box { <-0.3, 0, -0.3>, 0 } }
  #end
    rotate <rand(R), rand(R), rand(R)>*180 translate Where pigment { rgb <rand(R), rand(R), 0.6> }
  }
#end
