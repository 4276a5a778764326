// Shadows of meshes and blobs that are clear inside alone, beside clear triangles and a sphere.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,0.5,-6> look_at 0 angle 50 }
light_source { <-4,6,-8>, 1 }
plane { z, 3 pigment { checker rgb 0.9, rgb 0.2 } }
#declare Opaque = texture { pigment { rgb 0.7 } }
#declare Clear = texture { pigment { rgbt <1,0.5,0.5,0.5> } }
#declare Left = mesh { triangle { <-1,-1,0>,<1,-1,0>,<0,1,0> } }
#declare Right = mesh { triangle { <1,-1,0>,<-1,-1,0>,<0,1,0> } }
#declare Half = blob { threshold 0.5 sphere { 0, 1, 1 } clipped_by { plane { z, 0 } } }
object { Left scale 0.6 translate <-1.9,1,0> texture { Opaque } interior_texture { Clear } }
object { Right scale 0.6 translate <-0.6,1,0> texture { Opaque } interior_texture { Clear } }
object { Left scale 0.6 translate <0.7,1,0> texture { Clear } interior_texture { Opaque } }
mesh {
  triangle { <-1,-1,0>,<0,-1,0>,<0,1,0> texture { Opaque } }
  triangle { <1,-1,0>,<0,-1,0>,<0,1,0> }
  scale 0.6 translate <2,1,0> texture { Clear } interior_texture { Clear }
}
object { Half translate <-1.9,-0.8,0> texture { Opaque } interior_texture { Clear } }
object { Half rotate 180*y translate <-0.6,-0.8,0> texture { Opaque } interior_texture { Clear } }
intersection {
  blob { threshold 0.5 sphere { 0, 1, 1 } } plane { z, 0 texture { Clear } }
  translate <0.7,-0.8,0> texture { Opaque } interior_texture { Clear }
}
sphere { <2,-0.8,0>, 0.55 clipped_by { plane { z, 0 } } texture { Opaque } interior_texture { Clear } }
