// Lengths, comparisons and values of strings.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare S = concat("ball", str(2.5, 6, 2), chr(33));
sphere { <-1.5, 0, 0>, strlen(S)*0.05 pigment { rgb <0.9, 0.5, 0.3> } }
sphere { <0, strcmp("abc", "abd")*0.3, 0>, val("0.45") pigment { rgb <0.3, 0.9, 0.5> } }
sphere { <1.5, 0, 0>, val(substr("xx0.55yy", 3, 4)) pigment { rgb <asc("@")/128, 0.3, 0.9> } }
#if (strupr("aBc") = "ABC") sphere { <0, 1, 1>, 0.3 pigment { rgb 0.9 } } #end
sphere { <-1.2, 0.9, 0>, 0.3 + strlen(concat(substr(S, 0, strlen(S) + 1), substr(S, 0.5, 2)))/9 pigment { rgb <0.9, 0.9, 0.3> } }
