// A mesh_camera looks out of a declared mesh2 in another place.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare M = mesh2 {
  vertex_vectors { 19200*3, #for (I, 0, 19199) #local P = <mod(I, 160)/80 - 1, 0.75 - int(I/160)/80, 0>; P, P + 0.01*y, P + 0.01*x #end }
  face_indices { 19200, #for (I, 0, 19199) <3*I, 3*I + 1, 3*I + 2> #end }
}
camera { mesh_camera { 1 0 mesh { M rotate 10*x translate 0.3*y } } }
background { rgb <0.3, 0.4, 0.6> }
light_source { <3, 5, -4>, rgb 1 }
box { <-4, -1.5, 0.5>, <4, -1, 4> pigment { checker rgb <0.9, 0.8, 0.7>, rgb <0.2, 0.3, 0.5> scale 0.5 } }
sphere { <-0.4, -0.2, 1.5>, 0.6 pigment { rgb <0.8, 0.2, 0.1> } }
box { <0.3, -1, 1>, <0.9, 0.1, 2> pigment { rgb <0.2, 0.6, 0.3> } rotate 10*y }
