// A mode changes nothing of a torus with a hole.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
torus { 1, 0.5 difference sturm translate -x }
torus { 1, 0.5 merge rotate 70*x translate x pigment { rgb <1, 0.7, 0.3> } }
