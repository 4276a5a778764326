// mistake in line 3: a local name without its sign
#macro M()
  #local N 1;
#end
M()
