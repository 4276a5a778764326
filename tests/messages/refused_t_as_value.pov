// doubts in lines 3, 4: a value that begins with `t`
#macro Ball (Four) sphere { 0, Four.t pigment { rgb 1 } } #end
#declare Last = t;
Ball (t*2)
Ball ((t) + Last)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
