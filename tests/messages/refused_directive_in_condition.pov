// doubts in lines 4, 8: a directive behind a number in parentheses
#declare Wide = 1;
#macro Size ()
  #if (Wide) 2 #else 1 #end
#end
#if (Size () > 1) sphere { 0, 1 pigment { rgb 1 } } #end
#if ((Size ()) > 1) sphere { 0, 1 pigment { rgb 1 } } #end
#while (0 #debug "a") #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
