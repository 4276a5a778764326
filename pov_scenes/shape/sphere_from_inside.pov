// A camera in a sphere sees its inner side, lit by a light that is inside too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -0.5> look_at <0.3, -0.2, 1> angle 90 }
light_source { <0.3, 0.4, -0.2>, rgb 1 }
sphere { 0, 1 pigment { checker rgb <0.9, 0.9, 0.5>, rgb <0.4, 0.2, 0.5> scale 0.4 } }
