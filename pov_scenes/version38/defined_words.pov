// `defined` and `#ifdef` are false for reserved words, as before.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#ifdef (sphere) sphere { -1.5*x, 1 } #else sphere { -1.5*x, 0.5 } #end
sphere { 1.5*x, 0.5 + 0.5 * defined(box) }
