// A drilled block, a ring, mirrors, thin poles and a chequered plain to the horizon: what antialiasing finds hard.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 }
camera { location <0, 2.2, -7> look_at <0, 0.6, 0> angle 46 }
light_source { <-6, 9, -8>, rgb 0.7 }
light_source { <7, 5, -4>, rgb <0.25, 0.22, 0.2> }
background { rgb <0.35, 0.5, 0.7> }
plane { y, -0.5
  pigment { checker rgb 0.8, rgb <0.2, 0.3, 0.4> }
  finish { ambient 0.05 diffuse 0.7 reflection 0.08 }
}
#declare Drilled = difference {
  intersection { box { -0.9, 0.9 } sphere { 0, 1.2 } }
  cylinder { -2*x, 2*x, 0.45 }
  cylinder { -2*y, 2*y, 0.45 }
  cylinder { -2*z, 2*z, 0.45 }
  pigment { rgb <0.7, 0.35, 0.15> }
  finish { ambient 0.05 diffuse 0.6 phong 0.4 phong_size 60 reflection 0.1 }
}
object { Drilled rotate <25, 35, 10> translate <-1.4, 0.8, 0> }
torus { 0.8, 0.22
  rotate <65, 0, 25> translate <1.3, 0.7, -0.4>
  pigment { rgb <0.2, 0.45, 0.3> } finish { ambient 0.05 diffuse 0.6 specular 0.4 roughness 0.02 reflection 0.15 }
}
sphere { <0.1, 0, -1.6>, 0.45 pigment { rgb <0.1, 0.1, 0.15> } finish { diffuse 0.2 reflection 0.5 } }
#for (I, 0, 23)
  cylinder { <-4.6 + 0.4*I, -0.5, 3 + 0.15*mod(I*7, 5)>, <-4.6 + 0.4*I + 0.1, 2.6, 3 + 0.1*mod(I*3, 7)>, 0.012
    pigment { rgb <0.75, 0.7, 0.6> } finish { ambient 0.1 diffuse 0.7 } }
#end
