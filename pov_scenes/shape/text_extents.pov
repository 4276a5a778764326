// The extents of texts place other objects.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare T = text { ttf "timrom.ttf" "Extents" 0.25, 0.05 }
#declare A = min_extent(T);
#declare B = max_extent(T);
object { T pigment { rgb <0.9, 0.7, 0.4> } translate x }
box { A - 0.01, B + 0.01 pigment { rgbt <0.3, 0.5, 1, 0.7> } translate x }
sphere { A + x, 0.1 pigment { rgb x } }
sphere { B + x, 0.1 pigment { rgb y } }
