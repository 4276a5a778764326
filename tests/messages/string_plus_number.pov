// mistake in line 2: a string and a number with a plus
#declare N = 3; #debug "N = " + N
