// doubts in lines 3, 4, 5: objects that POV-Ray does not clip by
#declare Cutter = sphere { x, 1 pigment { rgb 1 } }
sphere { 0, 1 pigment { rgb 1 } clipped_by { Cutter } }
sphere { 0, 1 pigment { rgb 1 } bounded_by { union { box { -1, 1 } box { -2, 1 pigment { rgb x } } } } }
sphere { 0, 1 pigment { rgb 1 } clipped_by { triangle { 0, x, y } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
