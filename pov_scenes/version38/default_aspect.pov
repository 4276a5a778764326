// From version 3.8 on the camera's `right` has the aspect ratio of the picture by default.
// size: 200x100
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location -6*z look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 }
sphere { 4*x, 1 }
