// Meshes flush with boxes and planes at heights that single precision rounds: where a ray enters a box decides.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 2.3, -4.4> look_at <0, 0.3, 0> angle 42 }
light_source { <20, 40, -30>, 1 }
background { rgb <0.4, 0.5, 0.7> }
#declare Hs = array[6] { 0.1, 0.3, 0.4, 0.5, 0.7, 0.9 }
#macro Top(A, B, H) mesh { triangle { <A.x, H, A.y>, <A.x, H, B.y>, <B.x, H, B.y> } triangle { <A.x, H, A.y>, <B.x, H, B.y>, <B.x, H, A.y> } } #end
#for(I, 0, 5)
  #local H = Hs[I];
  box { <-1.5 + 0.5*I, -1, -0.4>, <-1.1 + 0.5*I, H, 0.4> pigment { rgb x } }
  object { Top(<-1.6 + 0.5*I, -0.3>, <-1.3 + 0.5*I, 0.1>, H) pigment { rgb y } }
  object { Top(<-0.35, 0.05>, <-0.05, 0.2>, H) rotate 20*y translate <-1 + 0.5*I, 0, 0> pigment { rgb <1, 1, 0> } }
#end
plane { y, 0.1 pigment { rgb 0.6 } }
