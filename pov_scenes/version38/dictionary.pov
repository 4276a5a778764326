// A dictionary maps keys to values of any kinds, written `["key"]` or `.key`.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary { ["ball"]: sphere { -2*x, 0.8 }, .tint: rgb <1, 0.5, 0.2>, ["extent"]: 0.6, .At: <2, 0, 0> }
object { D.ball pigment { color D["tint"] } }
sphere { D.At, D["extent"] pigment { color D.tint * 0.6 } }
sphere { D.At.x * y * 0.5, D.extent / 2 }
