// The names of a tuple may be entries of dictionaries.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary;
#declare (D.Size, D.Place) = (0.8, <-1.5, 0, 0>);
sphere { D.Place, D.Size pigment { rgb <1, 0.5, 0.2> } }
