// An igloo of bevelled wedges of snow, by the macros of bevel.inc.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "../include/bevel.inc"
camera { location <5, 3, -8.5> look_at <-0.1, 0.9, -0.8> angle 40 }
light_source { <-3, 9, -10> rgb <1, 0.93, 0.82> }
light_source { <9, 5, -5> rgb <0.15, 0.2, 0.3> shadowless }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.95, 0.8, 0.7>] [0.4 rgb <0.35, 0.55, 0.85>] } } }
plane { y, 0 pigment { rgb <0.92, 0.95, 1> } finish { ambient 0.15 } }

#declare Snow = texture { pigment { rgb <0.95, 0.97, 1> } finish { ambient 0.15 diffuse 0.75 } }
#declare Courses = 6;
#declare Radius = 2.2;
#declare Wall = 0.4;
#declare Gap = 0.02;

// A course of the dome from one height to the next, its blocks cut to the sphere and turned against those below.
#macro Course(Number)
  #local Y1 = Radius*sin(radians(14*Number));
  #local Y2 = Radius*sin(radians(14*(Number + 1)));
  #local Outer = Radius*cos(radians(14*Number + 7)) + 0.06;
  #local Inner = max(Outer - Wall, 0.15);
  #local Blocks = max(6, int(15*cos(radians(14*Number))));
  #local Arc = 360/Blocks;
  #local Slit = degrees(Gap/Outer);
  #for (Block, 0, Blocks - 1)
    #local From = Arc*(Block + 0.5*mod(Number, 2)) + Slit;
    object { Bevel_wedge(Y1 + Gap/2, Y2 - Gap/2, Inner, Outer, From, From + Arc - 2*Slit, 0.05) }
  #end
#end

#declare Dome = union {
  #for (Number, 0, Courses - 1) Course(Number) #end
  object { Bevel_cylinder(Radius*sin(radians(14*Courses)) - 0.12, Radius*sin(radians(14*Courses)) + 0.04, 0.42, 0.05) }
}
difference {
  object { Dome }
  cylinder { <0, 0.25, -4>, <0, 0.25, -1>, 0.62 }
  texture { Snow }
}
// The entrance: two arches of wedges, lying on their side, and bevelled blocks in front.
union {
  #for (Ring, 0, 1)
    #for (Block, 0, 4)
      object { Bevel_wedge(0.02, 0.5, 0.62, 0.95, 36*Block + 1, 36*Block + 35, 0.05) rotate -90*x translate <0, 0.25, -2 - 0.5*Ring> }
    #end
    object { Bevel_box(<-0.95, -0.3, -2.5 - 0.5*Ring + 0.02>, <-0.62, 0.24, -2 - 0.5*Ring>, 0.05) }
    object { Bevel_box(<0.62, -0.3, -2.5 - 0.5*Ring + 0.02>, <0.95, 0.24, -2 - 0.5*Ring>, 0.05) }
  #end
  texture { Snow }
}
object { Bevel_box(<0, 0, 0>, <0.9, 0.45, 0.5>, 0.06) texture { Snow } rotate 25*y translate <1.9, 0, -3.2> }
object { Bevel_box(<0, 0, 0>, <0.9, 0.45, 0.5>, 0.06) texture { Snow } rotate -50*y translate <2.9, 0, -2.4> }
