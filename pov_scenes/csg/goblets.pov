// Merged, united and cut away: parts between planes that have boxes of their own, though their surfaces have no end.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0.4, 4, -15> look_at 1.4*y angle 42 }
light_source { <-8, 9, -9>, 0.9 }
light_source { <6, 12, -5>, 0.4 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, -2 pigment { checker rgb 0.9 rgb <0.3, 0.5, 0.4> scale 0.7 } finish { reflection 0.1 } }
#declare Cone = quadric { <1, -1, 1>, 0, 0, 0 }
#declare Foot = object { Cone clipped_by { plane { y, 0 } plane { -y, 1 } } scale <1.5, 0.5, 1.5> translate 0.5*y }
#declare Bowl = intersection {
  plane { y, 1 } object { Cone } object { Cone scale <0.9, 1, 0.9> inverse } plane { -y, 0 }
  scale 1.5 translate 1.8*y
}
#declare Rim = torus { 1.5, 0.1 clipped_by { plane { -y, 0 } } translate 3.27*y }
#declare Knot = intersection { box { -0.35, 0.35 } sphere { 0, 0.45 } plane { x + y, 0.3 } rotate 30 translate 1.1*y }
merge {
  object { Foot } cylinder { 0.1*y, 2*y, 0.15 } object { Bowl } object { Rim } object { Knot }
  pigment { rgbf <0.9, 1, 0.95, 0.9> } finish { ambient 0 diffuse 0.1 phong 0.5 reflection 0.1 } interior { ior 1.4 }
  rotate <20, 30, 10> translate <-3.6, -1, 0>
}
union {
  object { Foot } cylinder { 0.1*y, 2*y, 0.15 } object { Bowl } object { Rim } object { Knot }
  clipped_by { plane { x + 0.2*z, 0.9 } }
  pigment { rgb <0.9, 0.7, 0.3> } finish { specular 0.5 } rotate -50*y translate -y
}
difference {
  cylinder { -0.5*y, 4*y, 1.7 }
  object { Foot } cylinder { 0.1*y, 2*y, 0.15 } object { Bowl } object { Knot } box { <-2, -1, -2>, <2, 5, 0> }
  pigment { rgb <0.6, 0.4, 0.7> } rotate <-10, 20, 0> translate <3.8, -1.2, 0>
}
