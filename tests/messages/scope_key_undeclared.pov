// mistake in line 4: a computed key that names nothing
#version 3.8;
#declare Name = "Radius";
sphere { 0, global[Name] }
