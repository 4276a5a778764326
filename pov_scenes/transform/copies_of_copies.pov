// Copies of copies of copies: each level turns and shrinks the one before, and some have looks of their own.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 4, -8> look_at <0, 1, 0> angle 45 }
light_source { <20, 30, -25>, rgb 1 }
#macro Twig(What)
  union {
    cylinder { 0, 2 * y, 0.06 }
    #for (I, 0, 4)
      object {
        What
        scale 0.55
        rotate <0, 0, 45>
        rotate 72 * I * y
        translate (1 + 0.25 * I) * y
        #if (I = 2) pigment { rgb <0.9, 0.5, 0.1> } #end
      }
    #end
  }
#end
#declare Leaf = union {
  sphere { 0, 0.3 scale <1, 2, 0.4> translate 0.6 * y pigment { rgb <0.2, 0.7, 0.2> } }
  cylinder { 0, 0.3 * y, 0.05 }
  sphere { 1.2 * y, 0.1 }
  box { -0.05, 0.05 translate 1.4 * y }
}
#declare A = Twig(Leaf)
#declare B = Twig(A)
#declare C = Twig(B)
#declare D = Twig(C)
#declare E = Twig(D)
object { E pigment { rgb <0.6, 0.4, 0.25> } }
plane { y, 0 pigment { checker rgb 0.9, rgb 0.6 } }
