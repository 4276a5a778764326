// doubts in lines 5, 6: a macro call behind a number, in a condition and as an argument
#macro Nothing () #end
#macro Ball (Size) sphere { 0, Size pigment { rgb 1 } } #end
#declare Size = 1;
#if (Size Nothing ()) Ball (1) #end
Ball (2 Nothing ())
Ball ((3 Nothing ()))
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
