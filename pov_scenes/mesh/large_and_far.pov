// A mesh in large units far from the origin keeps single precision corners.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh2 {
  vertex_vectors { 8, <-1000.1,-1000.1,-1000.1>, <1000.3,-1000.1,-1000.1>, <1000.3,1000.7,-1000.1>, <-1000.1,1000.7,-1000.1>, <-1000.1,-1000.1,1000.9>, <1000.3,-1000.1,1000.9>, <1000.3,1000.7,1000.9>, <-1000.1,1000.7,1000.9> }
  face_indices { 12, <0,1,2>, <0,2,3>, <4,6,5>, <4,7,6>, <0,4,5>, <0,5,1>, <3,2,6>, <3,6,7>, <0,3,7>, <0,7,4>, <1,5,6>, <1,6,2> }

  scale 0.0008 rotate 30*y
  pigment { checker rgb <0.9, 0.5, 0.2>, rgb 0.3 scale 0.3 }
}
