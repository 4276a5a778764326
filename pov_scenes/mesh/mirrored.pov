// A mesh mirrored, squeezed and turned, its normals with it.
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
mesh2 {
  Ball(7, 11, yes)
  pigment { rgb <0.6, 0.6, 0.9> } finish { specular 0.5 }
  scale <-1.5, 0.6, 0.8> rotate <20, 40, -15>
}
