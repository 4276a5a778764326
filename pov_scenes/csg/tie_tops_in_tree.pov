// Tops of thirty boxes in one plane, entered at one distance: the order of POV-Ray's tree of boxes decides which is seen.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 10, 0> direction -y right 16*x up 12*z }
light_source { <0, 100, 0>, rgb 1 }
#default { finish { ambient 1 diffuse 0 } }
#declare R = seed(12);
#for (I, 0, 29)
  #declare A = <rand(R)*13 - 8, -1, rand(R)*9 - 6>;
  box { A, <A.x + 0.5 + rand(R)*4, 0, A.z + 0.5 + rand(R)*4> pigment { rgb <mod(I, 6)/5, int(I/6)/5, 0.5> } }
#end
