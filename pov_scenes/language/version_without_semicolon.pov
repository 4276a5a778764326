// A version holds at once, also for the directive behind a `#version` without `;`. Before 3.5 numbers need none.
#version 3.0
#declare Size = 0.7
#if (version < 3.1) #declare Tone = color rgb <0.9, 0.4, 0.3> #else #declare Tone = color rgb <0.3, 0.4, 0.9> #end
#declare Old = version
#version 3.7
#declare New = version;
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { -Old/2*x, Size pigment { color Tone } }
sphere { New/2*x, Size pigment { color Tone } }
