// `#ifdef` and `defined` ask for a key, and `#undef` removes it.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary { .A: 0.8, .B: 0.5 }
#undef D.A
#ifdef (D.A) sphere { -2*x, 1 } #else sphere { -2*x, 0.4 } #end
#ifdef (D["B"]) sphere { 0, D.B } #end
sphere { 2*x, 0.3 + 0.5 * defined(D.B) + 0.1 * defined(D.C) }
