// A room whose inside shares three faces with its outside: coincident faces leave a skin, so all walls stand.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <.3, .3, -.5> look_at <-1, -1, 1> angle 80 }
light_source { <.4, .6, -.6>, 1 }
background { rgb <.2, .3, .5> }
difference { box { 0, 2 scale 1.01 } box { 0, 2 } pigment { rgb <1, .5, .2> } translate -1 }
