// A table and chairs in a room with two lamps and a polished floor.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <-2.2, 2.2, -4.6> look_at <0.2, 0.7, 0> angle 58 }
light_source { <1, 3.3, -1>, rgb 0.55 }
light_source { <-2.5, 2.8, -3>, rgb <0.3, 0.28, 0.22> }
box { <-4, 0, -6>, <4, 3.6, 4> inverse pigment { rgb <0.75, 0.72, 0.65> } finish { ambient 0.1 diffuse 0.7 } }
plane { y, 0.001 pigment { checker rgb <0.55, 0.4, 0.28>, rgb <0.45, 0.3, 0.2> scale 0.5 } finish { ambient 0.05 diffuse 0.6 reflection 0.1 } }
#declare Wood = texture { pigment { rgb <0.5, 0.32, 0.18> } finish { ambient 0.06 diffuse 0.7 phong 0.3 phong_size 30 } }
#declare Chair = union {
  box { <-0.3, 0.55, -0.3>, <0.3, 0.62, 0.3> }
  #for (I, 0, 3) cylinder { <0.54*mod(I, 2) - 0.27, 0, 0.54*floor(I/2) - 0.27>, <0.54*mod(I, 2) - 0.27, 0.55, 0.54*floor(I/2) - 0.27>, 0.03 } #end
  #for (I, 0, 4) cylinder { <0.13*I - 0.26, 0.6, 0.28>, <0.13*I - 0.26, 1.3, 0.33>, 0.018 } #end
  box { <-0.32, 1.25, 0.29>, <0.32, 1.38, 0.36> }
}
#for (I, 0, 3) object { Chair translate 0.95*z rotate (90*I + 20)*y texture { Wood } } #end
difference {
  cylinder { <0, 0.92, 0>, <0, 1, 0>, 0.85 } torus { 0.85, 0.03 translate 0.96*y }
  texture { Wood }
}
cylinder { 0, 0.92*y, 0.08 texture { Wood } }
lathe { cubic_spline 6, <0, 0>, <0.12, 0.02>, <0.16, 0.2>, <0.06, 0.35>, <0.1, 0.45>, <0.1, 0.5> translate y
  pigment { rgb <0.2, 0.3, 0.6> } finish { ambient 0.06 diffuse 0.6 specular 0.6 roughness 0.01 } }
difference { box { <1.2, 1, 3.9>, <2.8, 2.6, 4.2> } box { <1.3, 1.1, 3.8>, <2.7, 2.5, 4.3> } pigment { rgb 0.85 } }
