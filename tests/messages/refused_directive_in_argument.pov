// doubts in lines 3, 4: a directive behind a number as an argument
#macro Ball (Size) sphere { 0, Size pigment { rgb 1 } } #end
Ball (1 #debug "a")
Ball (#if (1) 1 #else 2 #end)
Ball ((#if (1) 1 #else 2 #end))
Ball (#if (0) #end 1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
