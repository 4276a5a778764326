// Rows of lights that `orient` turns to what they shine on, along either side, and a single one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,2,-5> look_at 0 }
light_source { <1,5,-3>, rgb <0.5,0.1,0> area_light 2*x, 2*y, 1, 4 orient adaptive 0 }
light_source { <-1,5,-3>, rgb <0,0.5,0.1> area_light 2*x, 3*y, 4, 1 orient }
light_source { <0,4,-4>, rgb <0.1,0,0.5> area_light 2*x, 2*y, 1, 1 orient }
plane { y, -1 pigment { rgb 1 } }
box { <-1,-0.3,-0.1>, <1,1,0.1> rotate 13*y pigment { rgb 0.8 } }
