// A sphere of negative radius looks like one of the positive radius while the scene has fewer than three things.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
sphere { <0.3, 0, 0>, -0.9 pigment { checker rgb <0.2, 0.6, 0.3>, rgb 0.8 scale 0.4 } finish { ambient 1 } }
