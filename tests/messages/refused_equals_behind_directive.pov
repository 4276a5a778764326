// doubt in line 2: a directive between a name and its `=`
#declare Size #debug "a" = 1;
sphere { 0, Size pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
