// mistakes in lines 2, 3: keywords in capitals
#if (TRUE) sphere { 0, 1 } #end
#declare A = PI;
