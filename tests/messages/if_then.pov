// mistake in line 2: then after a condition
#if (1) then sphere { 0, 1 } #end
