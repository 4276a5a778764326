// Declared textures, pigments and finishes are extended in place.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Base = finish { phong 0.5 ambient 0.2 };
#declare Shiny = finish { Base reflection 0.2 }
#declare Check = pigment { checker rgb 0.9 rgb <0.7, 0.2, 0.2> };
sphere { <-1, 0, 0>, 0.8 pigment { Check scale 0.3 } finish { Shiny } }
sphere { <1, 0, 0>, 0.8 texture { pigment { Check rotate 45 scale 0.4 } finish { Base phong 1 } } }
