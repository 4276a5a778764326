// min_extent and max_extent give an object's box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Thing = union { sphere { <-0.5, 0, 0>, 0.5 } box { <0.3, -0.5, -0.3>, <0.7, 0.9, 0.2> } rotate 20*z };
object { Thing pigment { rgb <0.9, 0.6, 0.4> } }
#declare A = min_extent(Thing);
#declare B = max_extent(Thing);
#for (I, 0, 7)
  sphere { <select(bitwise_and(I, 1) - 0.5, A.x, B.x), select(bitwise_and(I, 2) - 0.5, A.y, B.y), select(bitwise_and(I, 4) - 0.5, A.z, B.z)>, 0.07 pigment { rgb <0.2, 0.4, 0.9> } }
#end
