// mistakes in lines 3: braces instead of #end
#declare A = 1;
#if (A = 1) { #end
