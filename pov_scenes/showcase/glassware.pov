// Glass and coloured light: a bowl, a lens, a prism and a solid knot of rings on a white table.
// size: 320x240
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
background { rgb <0.35, 0.42, 0.5> }
camera { location <0.5, 4.2, -8.5> look_at <0, 0.5, 0> angle 38 }
light_source { <-6, 9, -3>, rgb 1.1 }
light_source { <7, 8, 5>, rgb <0.35, 0.4, 0.5> }

#declare Shine = finish { ambient 0 diffuse 0.05 specular 0.8 roughness 0.004 reflection { 0, 1 fresnel } conserve_energy };
#macro Glass(C)
  texture { pigment { color C filter 0.95 } finish { Shine } }
  interior { ior 1.5 fade_distance 1.5 fade_power 1001 fade_color C }
#end

difference {
  intersection { sphere { 0.95*y, 1 } plane { y, 1.25 } }
  sphere { 1.05*y, 0.88 }
  Glass(rgb <0.45, 0.8, 0.95>)
  translate <-1.6, 0, 0.5>
}
union {
  sphere { <-1.75, 0.52, 0.4>, 0.26 }
  sphere { <-1.3, 0.55, 0.7>, 0.22 }
  sphere { <-1.45, 0.48, 0.1>, 0.2 }
  pigment { rgb <0.85, 0.2, 0.08> }
  finish { ambient 0.08 specular 0.5 }
}
intersection {
  plane { -y, 0 }
  plane { <0.87, 0.5, 0>, 0.55 }
  plane { <-0.87, 0.5, 0>, 0.55 }
  plane { z, 0.8 }
  plane { -z, 0.8 }
  Glass(rgb <0.95, 0.97, 0.9>)
  rotate -55*y translate <0.6, 0.003, -1.5>
}
merge {
  torus { 0.6, 0.16 }
  torus { 0.6, 0.16 rotate 90*x }
  torus { 0.6, 0.16 rotate 90*z }
  Glass(rgb <0.95, 0.6, 0.25>)
  rotate <25, 30, 10> translate <1.9, 0.78, 0.5>
}
cylinder { <0.1, 0.003, 2.4>, <0.1, 2.2, 2.4>, 0.5 Glass(rgb <0.5, 0.9, 0.5>) }
plane { y, 0 pigment { checker rgb <0.92, 0.9, 0.86>, rgb <0.62, 0.66, 0.72> scale 0.7 rotate 30*y } finish { ambient 0.12 diffuse 0.7 } }
