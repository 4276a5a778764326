// The last digits of hits on meshes, whose planes are stored in single precision; where the nearest hit is too near, there is none.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -10*z look_at 0 right 16*x up 12*y }
#default { finish { ambient 1 diffuse 0 } }
#declare S = seed(7);
#macro Any(A) (<rand(S), rand(S), rand(S)> - 0.5)*A #end
#macro Digits(V) <mod(abs(V.x)*3e7, 1), mod(abs(V.y)*3e7, 1), mod(abs(V.z)*3e7, 1)> #end
#for (X, 0, 15)
  #for (Y, 0, 11)
    #local A = Any(2) + z*3;
    #local B = Any(2) + z*3;
    #local C = Any(2) + z*3;
    #if (Y < 6)
      #local M = mesh { triangle { A, B, C } };
    #else
      #local M = mesh2 { vertex_vectors { 3, A, B, C } face_indices { 1, <0, 1, 2> } };
    #end
    #local From = Any(0.5);
    #local N = <0, 0, 0>;
    #local P = trace(M, From, (A + B + C)/3 - From, N);
    box { <X - 8, Y - 6, 0>, <X - 7, Y - 5.5, 1> pigment { rgb Digits(P) } }
    #local Two = mesh {
      triangle { <-9, -9, 1>, <9, -9, 1>, <0, 9, 1> }
      triangle { <-9, -9, 2>, <9, -9, 2>, <0, 9, 2> }
    };
    #local P = trace(Two, (1 - pow(10, -X/2))*z, z);
    box { <X - 8, Y - 5.5, 0>, <X - 7, Y - 5, 1> pigment { rgb P.z/3 } }
  #end
#end
