// Each layer has bumps of its own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
sphere { 0, 1
  texture { pigment { rgb <0.8, 0.6, 0.3> } normal { bumps 0.8 scale 0.3 } }
  texture { pigment { rgbt <0.2, 0.3, 1, 0.6> } normal { waves 0.4 scale 0.2 } finish { phong 0.8 } }
}
plane { y, -1.07 pigment { rgb 0.6 } }
