// Material_map with a palette: the index is the number of the texture, interpolated like a colour. Numbers beyond the
// textures start again, but the number of textures itself is the last.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
#declare A = texture { pigment { rgb <0.9, 0.2, 0.1> } finish { phong 0.5 } }
#declare B = texture { pigment { rgb <0.2, 0.8, 0.3> } }
#declare C = texture { pigment { rgb <0.2, 0.3, 0.9> } finish { specular 0.5 } }
sphere { 0, 1 texture { material_map { png "images/palette.png" map_type 1 texture { A } texture { B } texture { C } } } }
plane { y, -1.07 texture { material_map { png "images/palette.png" interpolate 4 texture { A } texture { B } } rotate 90*x scale 1.37 } }
plane { z, 4 texture { material_map { gif "images/palette.gif" interpolate 3 texture { A } texture { C } texture { B } } scale 2.3 translate 0.4 } }
