// Fine patterns on combinations: bricks, wood and marble, cut and drilled.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.4, -6> look_at <0, 0.4, 0> angle 42 }
light_source { <-5, 8, -6>, rgb 0.85 }
background { rgb <0.55, 0.65, 0.8> }
plane { y, -0.6 pigment { hexagon rgb 0.75, rgb <0.5, 0.35, 0.3>, rgb 0.35 scale 0.2 } finish { ambient 0.08 diffuse 0.75 } }
difference {
  box { <-2.2, -0.6, -0.3>, <-0.7, 1.4, 0.7> }
  cylinder { <-1.45, 0.3, -1>, <-1.45, 0.3, 1>, 0.5 }
  pigment { brick rgb 0.7, rgb <0.55, 0.2, 0.12> brick_size <0.3, 0.12, 0.2> mortar 0.02 }
  finish { ambient 0.08 diffuse 0.7 } rotate 12*y
}
intersection {
  sphere { <0.2, 0.2, 0>, 0.85 } box { <-0.5, -0.5, -0.7>, <0.9, 0.9, 0.7> }
  pigment { wood turbulence 0.05 color_map { [0 rgb <0.65, 0.45, 0.25>] [1 rgb <0.35, 0.2, 0.1>] } scale 0.12 rotate <20, 30, 0> }
  finish { ambient 0.08 diffuse 0.7 phong 0.3 phong_size 40 }
}
merge {
  cylinder { <1.8, -0.6, 0.2>, <1.8, 1.2, 0.2>, 0.35 } torus { 0.4, 0.12 translate <1.8, 1.2, 0.2> }
  pigment { marble turbulence 0.6 color_map { [0 rgb 0.85] [0.7 rgb 0.6] [1 rgb <0.15, 0.18, 0.25>] } scale 0.3 }
  finish { ambient 0.08 diffuse 0.7 specular 0.3 roughness 0.02 }
}
