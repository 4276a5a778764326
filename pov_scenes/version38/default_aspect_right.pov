// A `right` in the camera replaces the aspect ratio of the picture, and `angle` works with either.
// size: 200x100
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location -6*z right 1.2*x angle 50 look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 }
sphere { 2*x, 0.5 }
