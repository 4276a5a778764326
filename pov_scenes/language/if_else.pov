// `#if`, `#else` and `#elseif`, at the top level and inside objects.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Kind = 2;
#if (Kind = 1) sphere { 0, 1 pigment { rgb 1 } }
#elseif (Kind = 2) box { -0.7, 0.7 #if (Kind > 5) rotate 90 #else rotate 30*y #end pigment { rgb <0.9, 0.6, 0.3> } }
#else plane { y, 0 } #end
#if (0) this is skipped: } { 'sphere' #if (1) nested #else too #end "a string #end" #end
