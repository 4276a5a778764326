// Without a background: what is black in a shadow is not told from the black behind everything.
// switches: +A0.3 +AM1 +R3 -J
// switches: +A0.3 +AM2 +R3 -J
// switches: +A0.1 +AM2 +R2
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 angle 45 }
light_source { <-20, 30, -15>, rgb 1 }
#for (I, 0, 60)
  sphere { <mod(I*7, 11) - 5, mod(I*5, 9) - 4, mod(I*3, 7) + 1>/3, 0.13
    pigment { rgb <0.9, 0.2 + 0.1*mod(I, 7), 0.3> } finish { ambient 0 } }
#end
