// doubts in lines 3, 4: `#fclose` of something else
#declare A = 1;
#fclose A
#fclose 1
sphere { 0, A pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
