// Finishes with `ior` change the one interior that all parts without their own share; the last one counts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 6, -24> look_at 0 angle 40 }
light_source { <-20, 30, -40>, rgb 1 }
plane { y, -3 pigment { checker rgb 1, rgb <0.2, 0.3, 0.6> scale 1.5 } }
#macro Glass(Settings)
  texture { pigment { rgbf <1, 0.95, 0.9, 0.9> } finish { ambient 0 diffuse 0.1 refraction 1 ior Settings } }
#end
#declare Clear = texture { pigment { rgbf 0.95 } finish { ambient 0 diffuse 0 } }
union {
  sphere { <-6, 0, 0>, 1.2 Glass(1.2) }
  sphere { <-3, 0, 0>, 1.2 texture { Clear } }
  sphere { <-6, 2.6, 0>, 1.2 Glass(1.5) }
}
union {
  sphere { <0, 0, 0>, 1.2 Glass(1.5) }
  sphere { <0, 2.6, 0>, 1.2 }
  union { sphere { <2.6, 2.6, 0>, 1.2 texture { Clear } } sphere { <2.6, 0, 0>, 1.2 interior { ior 1.1 } } }
  Glass(1.3)
}
difference { box { <4, -1, -1>, <6, 1, 1> texture { Clear } } sphere { <4, 1, -1>, 1 Glass(1.4) } }
intersection { box { <4, 1.5, -1>, <6, 4, 1> Glass(1.4) } sphere { <5, 2.5, 0>, 1.4 texture { Clear } } }
merge { sphere { <7.5, 0, 0>, 1 Glass(1.6) } sphere { <8.2, 0.8, 0>, 1 texture { Clear } } }
