// A blob and a wavy mesh.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.5, -6> look_at <0, 0.2, 0> angle 42 }
light_source { <-4, 7, -6>, rgb 0.8 }
light_source { <5, 3, -2>, rgb <0.25, 0.22, 0.2> }
background { rgb <0.3, 0.35, 0.45> }
blob {
  threshold 0.55
  #for (I, 0, 6) sphere { <1.3*cos(I*1.7), 0.55 + 0.45*sin(I*2.3), 0.9*sin(I*1.1)>, 0.9, 1 } #end
  cylinder { <-1.5, 0.2, 0>, <1.5, 0.4, 0>, 0.5, 0.8 }
  pigment { rgb <0.75, 0.3, 0.2> } finish { ambient 0.08 diffuse 0.65 specular 0.5 roughness 0.02 reflection 0.05 }
}
#declare Height = function(x, z) { 0.15*sin(3*x)*cos(2.5*z) - 0.8 }
mesh {
  #for (I, -20, 19) #for (J, -20, 19)
    #local A = <I*0.2, Height(I*0.2, J*0.2), J*0.2>;
    #local B = <I*0.2 + 0.2, Height(I*0.2 + 0.2, J*0.2), J*0.2>;
    #local C = <I*0.2, Height(I*0.2, J*0.2 + 0.2), J*0.2 + 0.2>;
    #local D = <I*0.2 + 0.2, Height(I*0.2 + 0.2, J*0.2 + 0.2), J*0.2 + 0.2>;
    triangle { A, B, C } triangle { D, B, C }
  #end #end
  pigment { rgb <0.35, 0.55, 0.5> } finish { ambient 0.08 diffuse 0.7 }
}
