// `?:` chooses between two values, vectors too, and nests.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 4)
  sphere { (mod(I, 2) ? <I - 2, 0.4, 0> : <I - 2, -0.2, 0>), 0.4
    pigment { rgb (I < 2 ? <0.9, 0.3, 0.2> : (I > 2 ? <0.2, 0.4, 0.9> : <0.9, 0.9, 0.9>)) } }
#end
