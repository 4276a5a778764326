// A union completed under another version: its parts take the defaults of the place where the union ends.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare Part = sphere { -1.5*x, 1 }
#version 3.8;
union { object { Part } sphere { 1.5*x, 1 } }
