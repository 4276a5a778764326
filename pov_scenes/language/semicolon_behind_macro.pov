// The `;` of a number, and one more, may stand behind the macro or file that the number ends in.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Set(Into, Value) #declare Into = Value; #end
#macro Set_Open(Into, Value) #declare Into = Value + Value*0 #end
#macro Set_Deep(Into, Value) Set_Open(Into, Value) #end
#declare Size = 0;
#declare Place = 0*x;
#include "semicolon_behind_file.inc";
#for (I, -1, 1)
  Set(Place, I*1.5*x);
  Set_Deep(Size, 0.5 + I/5);;
  sphere { Place, Size Set_Open(Place, y); pigment { rgb Tone } }
#end
