// `#declare` names numbers, vectors, colours, strings and objects.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Radius = 0.6;
#declare Place = <-1, 0, 0>;
#declare Tint = rgb <0.9, 0.5, 0.2>;
#declare Ball = sphere { Place, Radius }
object { Ball pigment { Tint } }
object { Ball pigment { color Tint*0.5 } translate 1.8*x scale 1.2 }
