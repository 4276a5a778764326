// `max_extent` of a pigment, normal or density is the resolution of its image or density file.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare P = pigment { image_map { png "../texture/images/rgb.png" } scale 3 }
#declare N = normal { bump_map { png "../texture/images/grey.png" } 0.3 }
#declare D = density { density_file df3 "../pattern/densities/bytes.df3" }
#declare All = array mixed { P, N, D }
#for (I, 0, 2)
  #local E = max_extent(All[I]);
  box { 0, <0.1, 0.1, 0.3> * (E + 1) translate <I*2.5 - 3, -1, 0> pigment { rgb <E.x, E.y, E.z + 10>/40 } }
#end
