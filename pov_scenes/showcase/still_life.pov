// A still life: turned wooden pieces and a glass ball on a board.
// size: 320x240
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
background { rgb <0.03, 0.04, 0.06> }
camera { location <-3.2, 3.3, -8.5> look_at <0.1, 0.75, 0> angle 36 }
light_source { <-9, 12, -6>, rgb <1.1, 1.0, 0.85> }
light_source { <8, 5, -9>, rgb <0.25, 0.3, 0.4> }

#declare Ivory = texture { pigment { rgb <0.85, 0.76, 0.58> } finish { ambient 0.05 diffuse 0.7 specular 0.5 roughness 0.02 reflection 0.03 } };
#declare Ebony = texture { pigment { rgb <0.07, 0.05, 0.045> } finish { ambient 0.05 specular 0.8 roughness 0.015 reflection 0.08 } };

#macro Foot(R)
  cylinder { 0, 0.16*y, R }
  torus { R - 0.08, 0.08 translate 0.18*y }
  cone { 0.2*y, R - 0.12, 0.55*y, R*0.45 }
#end

#declare Pawn = union {
  Foot(0.5)
  cone { 0.5*y, 0.25, 1.05*y, 0.14 }
  sphere { 0, 1 scale <0.27, 0.06, 0.27> translate 1.05*y }
  sphere { 1.3*y, 0.27 }
};
#declare Rook = union {
  Foot(0.58)
  cone { 0.5*y, 0.3, 1.3*y, 0.25 }
  difference {
    cylinder { 1.25*y, 1.75*y, 0.42 }
    cylinder { 1.5*y, 2*y, 0.29 }
    #for (I, 0, 2)
      box { <-1, 1.58, -0.07>, <1, 2, 0.07> rotate 60*I*y }
    #end
  }
};
#declare Bishop = union {
  Foot(0.55)
  cone { 0.5*y, 0.28, 1.5*y, 0.13 }
  sphere { 0, 1 scale <0.3, 0.06, 0.3> translate 1.45*y }
  difference {
    sphere { 0, 1 scale <0.27, 0.42, 0.27> translate 1.85*y }
    box { <-1, -0.035, -1>, <0, 0.035, 1> rotate -50*z translate <0.12, 1.98, 0> }
  }
  sphere { 2.3*y, 0.08 }
};

box { <-4, -0.3, -4>, <4, 0, 4>
  texture { pigment { checker rgb <0.55, 0.33, 0.16>, rgb <0.8, 0.65, 0.42> } finish { ambient 0.05 diffuse 0.6 reflection { 0.02, 0.25 falloff 2 } } }
}
box { <-4.35, -0.4, -4.35>, <4.35, -0.02, 4.35> texture { pigment { rgb <0.2, 0.1, 0.05> } finish { phong 0.3 } } }
plane { y, -0.4 pigment { rgb <0.12, 0.16, 0.2> } finish { ambient 0.05 reflection 0.04 } }

object { Rook translate <-1.5, 0.002, 1.5> texture { Ivory } }
object { Bishop rotate 40*y translate <0.5, 0.002, 1.5> texture { Ivory } }
object { Pawn translate <-1.5, 0.002, -0.5> texture { Ivory } }
object { Pawn translate <2.5, 0.002, 2.5> texture { Ebony } }
object { Rook rotate 30*y translate <2.5, 0.002, 0.5> texture { Ebony } }
object { Pawn rotate 90*z rotate 35*y translate <1.2, 0.52, -1.9> texture { Ebony } }
sphere { <-0.35, 0.652, -0.4>, 0.65
  texture { pigment { rgbf <0.94, 0.98, 0.96, 0.95> } finish { ambient 0 diffuse 0 specular 0.9 roughness 0.003 reflection { 0.02, 0.9 fresnel } conserve_energy } }
  interior { ior 1.5 }
}
