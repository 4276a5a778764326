// Three meshing gears cut from discs, with spokes, hubs and axles of brass and steel.
// size: 320x240
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.1, 0.11, 0.13> }
camera { location <2.2, 8, -9.5> look_at <0.25, 0, -0.75> angle 38 }
light_source { <-6, 12, -7>, rgb <1, 0.96, 0.88> }
light_source { <9, 7, -2>, rgb <0.25, 0.3, 0.4> }

#declare Brass = texture { pigment { rgb <0.72, 0.48, 0.16> } finish { ambient 0.06 diffuse 0.45 specular 0.7 roughness 0.03 metallic reflection { 0.2 metallic } } };
#declare Steel = texture { pigment { rgb <0.5, 0.53, 0.57> } finish { ambient 0.06 diffuse 0.4 specular 0.8 roughness 0.02 metallic reflection { 0.25 metallic } } };

// A gear of N teeth: its pitch radius is N/10.
#macro Gear(N)
  #local R = N/10;
  difference {
    union {
      cylinder { -0.2*y, 0.2*y, R - 0.1 }
      #for (I, 0, N - 1)
        intersection {
          box { <-0.2, -0.19, -0.3>, <0.15, 0.19, 0.3> }
          plane { z, 0.14 rotate 15*y }
          plane { -z, 0.14 rotate -15*y }
          translate R*x rotate I*360/N*y
        }
      #end
    }
    difference {
      cylinder { -y, y, R - 0.38 }
      cylinder { -2*y, 2*y, 0.36 }
      #for (I, 0, 2)
        box { <-R, -2, -0.13>, <R, 2, 0.13> rotate 60*I*y }
      #end
    }
    cylinder { -y, y, 0.17 }
  }
  torus { R - 0.24, 0.06 translate 0.2*y }
#end

union { Gear(20) rotate 12.68*y translate <-1.2, 0, 0.2> texture { Brass } }
union { Gear(12) rotate 9.68*y translate <2.02, 0, 0.5> texture { Steel } }
union { Gear(14) rotate 1.1*y translate <0.72, 0.02, -2.6> texture { Brass } }
#declare Axle = union { cylinder { -1.2*y, 0.55*y, 0.15 } sphere { 0.55*y, 0.15 } texture { Steel } };
object { Axle translate <-1.2, 0, 0.2> }
object { Axle translate <2.02, 0, 0.5> }
object { Axle translate <0.72, 0, -2.6> }
plane { y, -0.8 pigment { hexagon rgb <0.24, 0.26, 0.28>, rgb <0.2, 0.22, 0.25>, rgb <0.22, 0.24, 0.26> scale 0.8 } finish { ambient 0.05 diffuse 0.7 reflection 0.05 } }
