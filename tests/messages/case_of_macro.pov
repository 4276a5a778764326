// mistake in line 3: a macro in other capitals
#macro Leg(R) sphere { 0, R } #end
leg(1)
