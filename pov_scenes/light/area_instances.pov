// An area light on copies of a union that share its ten thousand parts.
// size: 80x60
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, -0.2, 0> }
light_source { <2, 4, -6> rgb 1 area_light <6, 0, 0>, <0, 6, 0>, 3, 3 }
plane { y, -1.3 pigment { rgb 1 } }
#declare Cluster = union {
  #for (I, 1, 5000)
    sphere { <sin(I), cos(I), sin(7*I)>, 0.05 }
  #end
  pigment { rgb <1, 0.4, 0.2> }
}
object { Cluster translate -1.4*x }
object { Cluster rotate 50*y translate 1.4*x }
