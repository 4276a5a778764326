// Many items of a finish at once.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.2
  pigment { rgb <0.6, 0.4, 0.2> }
  finish { ambient rgb <0.05, 0.1, 0.15> diffuse 0.5 brilliance 1.5 phong 0.3 phong_size 12 specular 0.6 roughness 0.01 metallic 0.7 reflection { 0.05, 0.5 falloff 2 metallic 0.5 } }
}
