// A number of photons for merged boxes: the spacing that follows from it counts to the last digit.
#version 3.7;
global_settings { assumed_gamma 1 photons { count 20000 autostop 0 } }
camera { location <3, 4, -3> look_at <-3, 0, 1> }
light_source { <-5.7, 4.5, 11.5>, <1, 0.9, 0.7> }
#declare S = seed(44);
merge {
  #declare I = 0; #while (I < 30) box { -1, 1 rotate 360*<rand(S), rand(S), rand(S)> } #declare I = I + 1; #end
  pigment { rgbt <0.5, 1, 0.5, 0.9> } finish { ambient 0 diffuse 0 } interior { ior 1.8 }
  photons { target refraction on reflection on } translate <-3.5, 1, 5.5>
}
plane { y, 0 pigment { rgb 0.8 } }
