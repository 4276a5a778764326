// doubt in line 2: a setting outside of its block
#max_trace_level 5
sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 } }
camera { location -5*z look_at 0 }
