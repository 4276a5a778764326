// doubt in line 4: `declare` without `#`, which ends the loop all the same
#declare I = 0;
#while (I < 5) sphere { I*x, 0.3 pigment { rgb 1 } }
  declare I = I + 1;
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
