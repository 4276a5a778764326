// A part without a texture takes the finish of the combination with the texture: its `ior` changes the interior again.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 6, -24> look_at 0 angle 40 }
light_source { <-20, 30, -40>, rgb 1 }
plane { y, -3 pigment { checker rgb 1, rgb <0.2, 0.3, 0.6> scale 1.5 } }
#macro Glass(Settings)
  texture { pigment { rgbf <1, 0.95, 0.9, 0.9> } finish { ambient 0 diffuse 0.1 refraction 1 ior Settings } }
#end
#declare Clear = texture { pigment { rgbf 0.95 } finish { ambient 0 diffuse 0 } }
intersection { sphere { <-4, 0, 0>, 1.5 Glass(1.5) } box { <-5.2, -1.2, -1.2>, <-2.8, 1.2, 1.2> } Glass(1.3) }
difference { box { <-1.2, -1.2, -1.2>, <1.2, 1.2, 1.2> Glass(1.5) } sphere { <1, 1, -1>, 1 } Glass(1.2) }
intersection { sphere { <4, 0, 0>, 1.5 } box { <2.8, -1.2, -1.2>, <5.2, 1.2, 1.2> Glass(1.5) } Glass(1.3) }
