// An object that light is projected through is in the dark itself where it faces the light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at <0, 1, 0> angle 40 }
plane { y, 0 pigment { rgb 1 } }
#declare Ring = torus { 1, 0.2 rotate <100, 10, 0> translate 1.5*y }
object { Ring pigment { rgb <0.6, 0.8, 0.2> } }
light_source { <0, 4, -5>, rgb 1 projected_through { Ring } }
