// A surface within 0.001 of another casts a shadow once it has blocked the light elsewhere; each reflection has a memory of its own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <8, 10, 6> direction -y right 16*x up 12*z }
light_source { <8, 1000, 6> rgb 1 parallel point_at <8, 0, 6> area_light x/100, z/100, 2, 2 jitter }
#default { pigment { rgb 1 } finish { ambient 0 diffuse 0.8 } }
plane { y, 0 pigment { checker rgb 1 rgb 0.7 } }
// Steps down from left to right, seen through a plate that bends light in the lower rows, and in others that does not.
#macro Step(X, Y, Z1, Z2)
  triangle { <X, Y, Z1>, <X + 1, Y, Z1>, <X, Y, Z2> }
  triangle { <X + 1, Y, Z1>, <X + 1, Y, Z2>, <X, Y, Z2> }
#end
mesh {
  #for (I, 0, 15)
    Step(I, pow(10, -I/3), 1, 11)
  #end
  no_image no_reflection
}
mesh {
  #for (I, 3, 12, 3)
    Step(I, 0.0004, 11.1, 11.8)
    Step(I, 2, 11.1, 11.8)
  #end
  no_image
}
box { <-1, 5, 0>, <9, 6, 3> pigment { rgbt 1 } interior { ior 1.3 } no_shadow }
box { <6, 5, 3.5>, <17, 6, 6> pigment { rgbt 1 } interior { ior 1.3 } no_shadow }
box { <-1, 5, 6.5>, <17, 6, 8> pigment { rgbt 1 } no_shadow }
