// The words of 3.8 may stand before `#version 3.8`: POV-Ray 3.8 knows them in every version.
#declare Balls = array mixed[2][2] { { -1.5*x, 1 }, { 1.5*x, 0.8 } }
#macro Ball(Which, optional Paint) sphere { Balls[Which][0], Balls[Which][1] #ifdef (Paint) pigment { Paint } #end } #end
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
Ball(0,)
Ball(1, pigment { rgb <1, 0.5, 0.2> })
