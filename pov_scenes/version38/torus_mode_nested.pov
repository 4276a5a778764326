// Torus modes in a union that is scaled and turned.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
union { torus { 0.5, 0.9 difference } torus { 0.4, 0.8 intersection translate 1.8*x } torus { 0.5, 0.9 merge translate -1.9*x } scale <1, 0.8, 1.1> rotate <20, 30, 10> pigment { rgb <0.6, 0.8, 0.4> } finish { specular 0.4 } }
