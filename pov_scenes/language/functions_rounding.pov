// Rounding functions shown as bars: floor, ceil, int, div, mod, abs on -2.7, 2.7 and 7.5.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Show = <0, 0, 0>;
#macro Bar(I, H)
  box { <I*0.34 - 2.2, 0, 0>, <I*0.34 - 1.95, H*0.15 + 0.01, 0.3> pigment { rgb <0.4 + mod(I, 3)*0.25, 0.6, 0.9 - mod(I, 2)*0.5> } }
#end
Bar(0, floor(-2.7)) Bar(1, floor(2.7)) Bar(2, ceil(-2.7)) Bar(3, ceil(2.7)) Bar(4, int(-2.7)) Bar(5, int(2.7))
Bar(6, div(7.5, 2)) Bar(7, div(-7.5, 2)) Bar(8, mod(7.5, 2)) Bar(9, mod(-7.5, 2)) Bar(10, abs(-2.7)) Bar(11, max(1, 4, 2)) Bar(12, min(-3, -1))
