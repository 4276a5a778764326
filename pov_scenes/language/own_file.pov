// Shows that a scene reads what it has written: values with #read, objects with #include.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 1 }
#fopen Out "own_file_values.txt" write
#for (I, 0, 5) #write(Out, <I - 2.5, sin(I), 0>, ", ", 0.2 + I / 20, ", \"ball ", I, "\"") #if (I < 5) #write(Out, ",\n") #end #end
#fclose Out
#fopen In "own_file_values.txt" read
#fopen Out "own_file_objects.inc" write
#while (defined(In))
  #read (In, Place, Radius, Name)
  #write(Out, "sphere { ", Place, ", ", Radius, " pigment { rgb <1, ", strlen(Name) / 10, ", ", val(substr(Name, 6, 1)) / 5, "> } }\n")
#end
#fclose Out
#include "own_file_objects.inc"
