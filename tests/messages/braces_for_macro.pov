// mistake in line 2: braces around a macro
#macro A(X) { #end
A(0)
