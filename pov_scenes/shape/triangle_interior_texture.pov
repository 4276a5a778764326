// Triangles, turned and moved, with `interior_texture`: each transform winds the corners anew, and so turns some over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <4, 3, -20> right 8*x up 6*y direction z }
light_source { <20, 40, -300>, 1 }
#declare R = seed(3);
#macro Corner() <rand(R), rand(R), rand(R) - 0.5> #end
#for(I, 0, 7) #for(J, 0, 5)
  triangle { Corner(), Corner(), Corner()
    texture { pigment { rgb x } } interior_texture { pigment { rgb y } }
    #switch(mod(I, 4)) #case(1) translate 0.01*x #break #case(2) rotate 40*y #break
    #case(3) rotate 30*x matrix <1, 0, 0.3, 0, 1, 0, -0.8, 0.2, 0.4, 0, 0, 0> rotate 130*y scale <1, 1.2, 1> #end
    translate <I, J, 0> }
#end #end
