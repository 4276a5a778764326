// An orthographic camera of version 3.8 takes the aspect ratio of the picture as well.
// size: 150x100
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -4*z look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 }
sphere { 2*x, 0.5 }
