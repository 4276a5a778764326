// doubts in lines 3, 3, 4: names of version 3.8
#declare Size = 1; #declare Ball = sphere { 0, 1 } #declare Sizes = array[1] { 1 }
sphere { 0, global.Size pigment { rgb 1 } } object { global.Ball pigment { rgb 1 } }
sphere { 0, global.Sizes[0] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
