// A ball-and-stick ring of six with its side groups, over a dark mirror.
// size: 320x240
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.02, 0.03, 0.06> }
camera { location <1.5, 6, -9> look_at <0, 0.3, 0> angle 40 }
light_source { <-8, 12, -8>, rgb 1 }
light_source { <9, 4, -4>, rgb <0.3, 0.35, 0.5> }

#declare Gloss = finish { ambient 0.06 diffuse 0.65 specular 0.8 roughness 0.012 reflection { 0.02, 0.3 falloff 3 } };
#declare Carbon = texture { pigment { rgb <0.09, 0.1, 0.11> } finish { Gloss } };
#declare Oxygen = texture { pigment { rgb <0.75, 0.04, 0.03> } finish { Gloss } };
#declare Nitrogen = texture { pigment { rgb <0.05, 0.12, 0.7> } finish { Gloss } };
#declare Hydrogen = texture { pigment { rgb <0.85, 0.85, 0.82> } finish { Gloss } };
#declare Stick = texture { pigment { rgb <0.5, 0.42, 0.3> } finish { Gloss metallic } };

#macro Bond(A, B)
  cylinder { A, B, 0.11 texture { Stick } }
#end
#macro DoubleBond(A, B)
  #local Side = 0.13*vnormalize(vcross(B - A, y));
  cylinder { A + Side, B + Side, 0.07 texture { Stick } }
  cylinder { A - Side, B - Side, 0.07 texture { Stick } }
#end

#declare Ring = union {
  #for (I, 0, 5)
    #local Here = vrotate(1.4*x, 60*I*y);
    #local Next = vrotate(1.4*x, 60*(I + 1)*y);
    #local Out = vrotate(<2.6, 0.25*(1 - 2*mod(I, 2)), 0>, 60*I*y);
    #if (mod(I, 3) = 2)
      sphere { Here, 0.42 texture { Nitrogen } }
    #else
      sphere { Here, 0.45 texture { Carbon } }
    #end
    #if (mod(I, 2) = 0)
      DoubleBond(Here, Next)
    #else
      Bond(Here, Next)
    #end
    Bond(Here, Out)
    #switch (mod(I, 3))
      #case (0)
        sphere { Out, 0.4 texture { Oxygen } }
      #break
      #else
        sphere { Out, 0.28 texture { Hydrogen } }
    #end
  #end
};

object { Ring rotate <-18, 15, 8> translate 0.9*y }
plane { y, -1 pigment { rgb <0.01, 0.015, 0.03> } finish { ambient 0 diffuse 0.4 reflection { 0.15, 0.6 falloff 2 } } }
