// Thin films under an area light with area_illumination.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,1,-5> look_at 0 }
light_source { <-4,6,-5>, 1 area_light x*5, y*5, 3, 3 adaptive 1 area_illumination }
sphere { <-1,0,0>, 1 pigment { rgb 0.7 } finish { irid { 0.5 thickness 0.6 } } }
sphere { <1.1,0,0>, 1 pigment { rgb <0.6,0.3,0.2> } finish { specular 0.5 irid { 0.4 thickness 0.4 } } }
plane { y, -1 pigment { rgb 0.7 } finish { irid { 0.4 thickness 0.3 } } }
