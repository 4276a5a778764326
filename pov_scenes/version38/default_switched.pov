// `#version` switches the defaults to and fro as long as there is no `#default`.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Old = texture { finish { phong 0.5 } }
#version 3.8;
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1 texture { Old } }
sphere { 1.5*x, 1 }
