// mistake in line 2: return in a macro
#macro Double(X) return X*2; #end
#declare B = Double(1);
