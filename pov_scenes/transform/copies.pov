// A thousand copies of one union of twelve parts, turned, stretched, sheared and mirrored, each with a colour of its own.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 6, -14> look_at <0, 0, 0> angle 50 }
light_source { <20, 30, -25>, rgb 1 }
#declare Part = union {
  #for (I, 0, 5)
    sphere { <cos(I), 0.2 * I, sin(I)>, 0.25 }
  #end
  box { -0.3, 0.3 rotate 20 * y }
  cylinder { -y, y, 0.15 }
  torus { 0.8, 0.1 rotate 30 * x }
  cone { 0, 0.3, 1.4 * x, 0 }
  difference { sphere { -0.6 * y, 0.5 } box { 0, 1 translate <-0.5, -1.1, -1> } }
  intersection { sphere { 0.9 * y, 0.5 } sphere { 1.2 * y, 0.5 } }
}
#declare R = seed(3);
#for (I, 0, 999)
  #declare C = <rand(R), rand(R), rand(R)>;
  #declare T = <14 * rand(R) - 7, 5 * rand(R) - 3, 14 * rand(R) - 6>;
  object {
    Part
    pigment { rgb C }
    scale <0.2 + 0.2 * rand(R), 0.3, select(mod(I, 3) - 1, -0.3, 0.2, 0.3)>
    rotate 360 * C
    #if (mod(I, 4) = 0) matrix <1, 0, 0, 0.4, 1, 0, 0, 0, 1, 0, 0, 0> #end
    translate T
  }
#end
plane { y, -4 pigment { rgb <0.3, 0.4, 0.5> } finish { reflection 0.3 } }
