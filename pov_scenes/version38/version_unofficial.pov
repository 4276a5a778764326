// `#version unofficial 3.8` is version 3.8.
#version unofficial 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, version - 2.8 }
