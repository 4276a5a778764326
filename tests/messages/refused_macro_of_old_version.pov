// doubts in lines 3, 4: a macro before version 3.1
#version 3.0
#macro Ball () sphere { 0, 1 pigment { rgb 1 } } #end
Ball ()
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
