// Two cylinders or cones whose sides coincide, of unequal length: POV-Ray shows the one that it rounds to be nearer.
// compare: channel<=110 pixels<=0.01% because "one pixel of a ring on a disc is rounded the other way"
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.4 diffuse 0.6 } }
camera { location <0.3, 2, -9> look_at <0, 0.2, 0> angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Random = seed(3);
#declare I = 0;
#while (I < 7)
  union {
    cylinder { 0, 1.5*y, 0.25 pigment { rgb <0.9, 0.2, 0.2> } }
    cylinder { 0, (1.6 + 0.1*I)*y, 0.25 pigment { rgb <0.9, 0.8, 0.6> } }
    translate -0.8*y
    rotate <rand(Random)*40 - 20, rand(Random)*90, rand(Random)*60 - 30>
    translate <0.85*(I - 3), 1.1, 0>
  }
  union {
    cone { -0.6*y, 0.45, 0.9*y, 0 pigment { rgb <0.2, 0.4, 0.9> } }
    cone { -0.6*y, 0.45, 0.4*y, 0.15 pigment { rgb <0.9, 0.9, 0.2> } }
    rotate <rand(Random)*40 - 20, rand(Random)*90, rand(Random)*60 - 30>
    translate <0.85*(I - 3), -0.6, -0.3>
  }
  #declare I = I + 1;
#end
// Seen from below: a ring that lies on a disc.
union {
  cone { 0, 0.5, 0.3*y, 0.7 pigment { rgb <0.3, 0.8, 0.3> } }
  cylinder { 0.3*y, 0.5*y, 0.62 pigment { rgb <0.8, 0.3, 0.8> } }
  translate <-1.1, 2.3, 1>
}
