// mistake in line 4: no closing quote in the last string
sphere { 0, 1 }
camera { location -5*z look_at 0 }
#debug "done
