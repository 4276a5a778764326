// doubts in lines 3, 4, 5: old words, and a colour of an object
camera { location -5*z look_at 0 }
composite { sphere { 0, 1 } sphere { 1, 1 } }
fog { color rgb 1 10 }
#declare Red = rgb x; sphere { 0, 1 Red }
light_source { <4, 6, -8>, rgb 1 }
