// doubts in lines 2, 3, 4: the old form of the entries of a colour map
sphere { 0, 1 pigment { bozo color_map { [0 1 rgb x rgb y] } } }
sphere { 0, 1 pigment { bozo color_map { [0 1, color rgb x color rgb y] } } }
sphere { 0, 1 pigment { bozo color_map { [0 <1, 0, 0, 0, 0>] [1 rgb 1] } } }
sphere { 0, 1 pigment { bozo color_map { [0 1 rgb x color rgb y] } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
