// doubts in lines 2, 3: a directive or a name between the layers of a declared texture
#declare T = texture { pigment { rgb 1 } } #debug "a" texture { pigment { rgbt 1 } }
#declare G = texture { pigment { rgbt 1 } } #declare U = texture { pigment { rgb 1 } } G
sphere { 0, 1 texture { T } }
sphere { x, 1 texture { pigment { rgb 1 } } #debug "a" texture { pigment { rgbt 1 } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
