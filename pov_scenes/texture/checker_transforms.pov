// The checker's own steps: scaled unevenly, turned, moved.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.2 pigment { checker rgb 0.9, rgb <0.2, 0.3, 0.7> scale <0.2, 0.5, 1> rotate <30, 0, 40> translate <0.1, 0.07, 0.3> } }
