// `local["Name"]` and `global["Name"]` are `local.Name` and `global.Name`.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare global["Size"] = 1;
#macro Ball(At, optional Paint)
  #declare local["Size"] = 0.5;
  sphere { At, local.Size #ifdef (local["Paint"]) pigment { Paint } #end }
  sphere { At + 1.4*y, global["Size"] * 0.4 }
  #declare global["Last"] = At;
#end
Ball(-2*x,)
Ball(0, pigment { rgb <1, 0.5, 0.2> })
sphere { Last + 2*x, Size }
