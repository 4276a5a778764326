// A mesh that mirrors itself and the floor.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
// A ball of N by M cells around <0,0,0>, its corners on radius 1.
#macro Ball(N, M, WithNormals)
  vertex_vectors { N*M + 2, <0, 1, 0>, <0, -1, 0>
    #for (I, 1, N) #for (J, 0, M - 1)
      , <sin(pi*I/(N + 1))*cos(2*pi*J/M), cos(pi*I/(N + 1)), sin(pi*I/(N + 1))*sin(2*pi*J/M)>
    #end #end
  }
  #if (WithNormals)
    normal_vectors { N*M + 2, <0, 1, 0>, <0, -1, 0>
      #for (I, 1, N) #for (J, 0, M - 1)
        , <sin(pi*I/(N + 1))*cos(2*pi*J/M), cos(pi*I/(N + 1)), sin(pi*I/(N + 1))*sin(2*pi*J/M)>
      #end #end
    }
  #end
  face_indices { 2*N*M
    #for (J, 0, M - 1)
      , <0, 2 + J, 2 + mod(J + 1, M)>, <1, 2 + (N - 1)*M + J, 2 + (N - 1)*M + mod(J + 1, M)>
      #for (I, 0, N - 2)
        , <2 + I*M + J, 2 + (I + 1)*M + J, 2 + (I + 1)*M + mod(J + 1, M)>
        , <2 + I*M + J, 2 + (I + 1)*M + mod(J + 1, M), 2 + I*M + mod(J + 1, M)>
      #end
    #end
  }
#end
mesh2 { Ball(4, 6, no) pigment { rgb 0.2 } finish { reflection 0.7 } translate -1.05*x }
mesh2 { vertex_vectors { 8, <-1,-1,-1>, <1,-1,-1>, <1,1,-1>, <-1,1,-1>, <-1,-1,1>, <1,-1,1>, <1,1,1>, <-1,1,1> }
  face_indices { 12, <0,1,2>, <0,2,3>, <4,6,5>, <4,7,6>, <0,4,5>, <0,5,1>, <3,2,6>, <3,6,7>, <0,3,7>, <0,7,4>, <1,5,6>, <1,6,2> }
  scale 0.7 rotate 30*y translate 1.1*x pigment { rgb <0.5, 0.1, 0.1> } finish { reflection 0.4 } }
