// Radiosity: with `media on` rays that gather light meet fog and media.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 40 recursion_limit 1 media on } }
background { rgb .5 }
camera { location <0, 2, -6> look_at <0, 1, 0> }
plane { y, 0 hollow pigment { rgb <.8, .6, .4> } finish { diffuse .7 } }
box { <1, 0, 0>, <2, 2, 1> pigment { rgb <1, .2, .2> } finish { diffuse .7 emission .8 } }
media { emission <.02, .05, .05> absorption .03 }
fog { distance 20 rgb <1, 0, 0> }
